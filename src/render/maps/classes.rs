//! How large are the arrays that a format's textures lie in?

use crate::scene::Texture;

/// Arrays for each format: what `sample_map` in `shaders-glsl/maps/sample.glsl` tells apart.
pub const SIZE_CLASSES: usize = 3;

/// The largest side that is kept, texels; what is larger is made smaller. Every Vulkan device has it.
const LARGEST_SIDE: u32 = 4096;

/// The side that a texture wants: the power of two that loses none of its texels.
pub fn side_of(texture: &Texture) -> u32 {
    let longer = texture.width().max(texture.height());
    longer.next_power_of_two().min(LARGEST_SIDE)
}

/// What the arrays of one format may take so that there are fewer of them, texels of their largest level: 64 MiB at four
/// bytes. A class more costs every sample a question, and on a driver that does not branch a sample.
const CHEAP_TEXELS: u64 = 16 << 20;

/// The sides of the arrays, small to large, for textures that want these: the sides themselves, of which the smallest are
/// merged into the next larger while that is cheap, or while there are too many, since there growing costs least.
pub fn classes(wanted: impl Iterator<Item = u32>) -> Vec<u32> {
    let mut wanted: Vec<_> = wanted.collect();
    wanted.sort_unstable();
    let mut sides = wanted.clone();
    sides.dedup();
    while sides.len() > 1 {
        let texels = |sides: &[u32]| -> u64 {
            let side = |wanted: &u32| u64::from(sides[class_of(*wanted, sides)]);
            wanted.iter().map(|wanted| side(wanted).pow(2)).sum()
        };
        if sides.len() <= SIZE_CLASSES && texels(&sides[1..]) > CHEAP_TEXELS {
            break;
        }
        sides.remove(0);
    }
    sides
}

/// The class of a texture that wants `side`: the smallest array that is large enough.
pub fn class_of(side: u32, classes: &[u32]) -> usize {
    let found = classes.iter().position(|class| *class >= side);
    found.unwrap_or(classes.len().saturating_sub(1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_textures_share_one_array() {
        assert_eq!(classes([].into_iter()), [0_u32; 0]);
        assert_eq!(classes([64, 1, 64].into_iter()), [64]);
        assert_eq!(classes([512, 64, 256, 512].into_iter()), [512]);
    }

    #[test]
    fn large_ones_keep_their_sizes_up_to_three() {
        // Twenty of 1024 would be 320 MiB at 4096.
        let wanted = [[1024; 20].as_slice(), &[4096, 4096]].concat();
        let sides = classes(wanted.iter().copied());
        assert_eq!(sides, [1024, 4096]);
        assert_eq!(class_of(1024, &sides), 0);
        assert_eq!(class_of(4096, &sides), 1);
        let wanted: Vec<_> = [256, 512, 1024, 2048]
            .iter()
            .flat_map(|side| [*side; 40])
            .collect();
        let sides = classes(wanted.into_iter());
        assert_eq!(sides, [512, 1024, 2048]);
        assert_eq!(
            [256, 512, 2048].map(|side| class_of(side, &sides)),
            [0, 0, 2]
        );
    }
}
