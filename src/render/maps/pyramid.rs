//! What do a texture's levels hold, from its full size down to one texel?
//!
//! Everything is done on linear values: means of sRGB codes are too dark.

use glam::{Vec3, Vec4};

use crate::scene::{Slot, Texture};

/// One level: rows from the top of `side` texels each.
pub struct Level {
    pub side: usize,
    pub texels: Vec<Vec4>,
}

/// The levels of a texture that fills a square of `side` texels, a power of two; the largest first.
pub fn pyramid(texture: &Texture, side: u32) -> impl Iterator<Item = Level> {
    let slot = texture.slot();
    let first = resized(texture, side as usize);
    std::iter::successors(Some(first), move |level| {
        (level.side > 1).then(|| halved(level, slot))
    })
}

/// Each texel the mean of the four that it stands for.
fn halved(level: &Level, slot: Slot) -> Level {
    let side = level.side / 2;
    let at = |x: usize, y: usize| level.texels[y * level.side + x];
    let texel = |x: usize, y: usize| {
        let (x, y) = (2 * x, 2 * y);
        let sum = at(x, y) + at(x + 1, y) + at(x, y + 1) + at(x + 1, y + 1);
        of_unit_length(sum * 0.25, slot)
    };
    Level {
        side,
        texels: (0..side)
            .flat_map(|y| (0..side).map(move |x| (x, y)))
            .map(|(x, y)| texel(x, y))
            .collect(),
    }
}

/// A mean of normals is shorter than they are; where they cancel, the surface is flat from afar.
fn of_unit_length(texel: Vec4, slot: Slot) -> Vec4 {
    match slot {
        Slot::Normal => texel.truncate().normalize_or(Vec3::Z).extend(1.0),
        _ => texel,
    }
}

/// The texture stretched or shrunk to a square.
fn resized(texture: &Texture, side: usize) -> Level {
    let (width, height) = (texture.width() as usize, texture.height() as usize);
    let columns = weights(width, side);
    let rows = weights(height, side);
    let mut wide = Vec::with_capacity(side * height);
    let mut row = Vec::with_capacity(width);
    for y in 0..height {
        row.clear();
        // Texture sides are at most 8192.
        row.extend((0..width).map(|x| Vec4::from_array(texture.texel(x as u32, y as u32))));
        wide.extend(columns.iter().map(|taps| taps.sum(|x| row[x])));
    }
    let texels = if height == side {
        wide
    } else {
        rows.iter()
            .flat_map(|taps| {
                let wide = &wide;
                (0..side).map(move |x| taps.sum(|y| wide[y * side + x]))
            })
            .collect()
    };
    let slot = texture.slot();
    let texels = match (width == side && height == side, slot) {
        (false, Slot::Normal) => texels
            .into_iter()
            .map(|t| of_unit_length(t, slot))
            .collect(),
        _ => texels,
    };
    Level { side, texels }
}

/// The texels of a row that make one of another row, and their weights, which sum to 1.
struct Taps(Vec<(usize, f32)>);

impl Taps {
    fn sum(&self, texel: impl Fn(usize) -> Vec4) -> Vec4 {
        match self.0[..] {
            // A copy, bit for bit.
            [(i, _)] => texel(i),
            _ => self.0.iter().map(|(i, weight)| texel(*i) * *weight).sum(),
        }
    }
}

/// How `from` texels in a row become `to`: by what each new one covers, or, where they grow, by the two that it lies
/// between, around the edge, since textures repeat.
fn weights(from: usize, to: usize) -> Vec<Taps> {
    let scale = from as f64 / to as f64;
    let taps = |i: usize| -> Vec<(usize, f32)> {
        if from == to {
            return vec![(i, 1.0)];
        }
        if from > to {
            let (start, end) = (i as f64 * scale, (i + 1) as f64 * scale);
            return (start.floor() as usize..(end.ceil() as usize).min(from))
                .map(|j| {
                    let covered = end.min(j as f64 + 1.0) - start.max(j as f64);
                    (j, (covered / scale) as f32)
                })
                .collect();
        }
        let middle = (i as f64 + 0.5) * scale - 0.5;
        let share = (middle - middle.floor()) as f32;
        let first = middle.floor().rem_euclid(from as f64) as usize;
        vec![(first, 1.0 - share), ((first + 1) % from, share)]
    };
    (0..to).map(|i| Taps(taps(i))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texture(slot: Slot, width: u32, height: u32, of: impl Fn(u32, u32) -> [f32; 3]) -> Texture {
        let texels: Vec<_> = (0..height)
            .flat_map(|y| (0..width).map(move |x| (x, y)))
            .map(|(x, y)| {
                let [r, g, b] = of(x, y);
                [r, g, b, 1.0]
            })
            .collect();
        match Texture::from_linear("test", slot, width, height, &texels) {
            Some(texture) => texture,
            None => panic!("no texture"),
        }
    }

    fn mean(level: &Level) -> Vec4 {
        level.texels.iter().copied().sum::<Vec4>() / level.texels.len() as f32
    }

    fn noise(x: u32, y: u32) -> [f32; 3] {
        [0, 1, 2].map(|k| ((x * 31 + y * 17 + k * 7) % 64) as f32 / 63.0)
    }

    #[test]
    fn a_texture_of_its_own_size_is_copied_bit_by_bit() {
        let texture = texture(Slot::BaseColor, 8, 8, noise);
        let Some(level) = pyramid(&texture, 8).next() else {
            panic!("no level");
        };
        for (i, texel) in (0..).zip(&level.texels) {
            assert_eq!(texel.to_array(), texture.texel(i % 8, i / 8));
        }
    }

    #[test]
    fn levels_halve_down_to_one_texel_and_keep_the_mean() {
        let texture = texture(Slot::Emission, 16, 16, noise);
        let levels: Vec<_> = pyramid(&texture, 16).collect();
        let sides: Vec<_> = levels.iter().map(|level| level.side).collect();
        assert_eq!(sides, [16, 8, 4, 2, 1]);
        for level in &levels {
            assert_eq!(level.texels.len(), level.side * level.side);
            assert!(mean(level).abs_diff_eq(mean(&levels[0]), 1e-6));
        }
    }

    #[test]
    fn what_is_shrunk_or_grown_keeps_its_mean_and_its_place() {
        for (width, height, side) in [(20, 12, 8), (5, 7, 16), (3, 100, 32), (1, 1, 4)] {
            let texture = texture(Slot::Emission, width, height, noise);
            let whole: Vec4 = (0..height)
                .flat_map(|y| (0..width).map(move |x| (x, y)))
                .map(|(x, y)| Vec4::from_array(texture.texel(x, y)))
                .sum();
            let want = whole / (width * height) as f32;
            let Some(level) = pyramid(&texture, side).next() else {
                panic!("no level");
            };
            let got = mean(&level);
            assert!(
                got.abs_diff_eq(want, 0.02),
                "{width}x{height}: {got} for {want}"
            );
        }
        // A dark left half stays left.
        let halves = texture(Slot::Emission, 6, 6, |x, _| {
            [if x < 3 { 0.0 } else { 1.0 }; 3]
        });
        let Some(level) = pyramid(&halves, 8).next() else {
            panic!("no level");
        };
        assert!(level.texels[1].x < 0.01 && level.texels[6].x > 0.99);
        // Around the edge the two halves meet.
        assert!(level.texels[0].x > 0.0 && level.texels[7].x < 1.0);
    }

    #[test]
    fn normals_stay_unit_vectors_on_every_level() {
        let texture = texture(Slot::Normal, 8, 8, |x, y| {
            [if x % 2 == 0 { 0.9 } else { -0.9 }, y as f32 * 0.1, 0.4]
        });
        for level in pyramid(&texture, 16) {
            for texel in &level.texels {
                assert!((texel.truncate().length() - 1.0).abs() < 1e-5, "{texel}");
            }
        }
    }
}
