//! Which pictures does an MTL material name, and with which options?
//!
//! * `map_Kd` base colour, `map_Pr` roughness, `map_Pm` metalness, `map_Ke` emission, `map_d` alpha
//!   mask, `map_ao` occlusion, `norm` normals. `map_Bump` and `bump`: a grey picture holds heights, a
//!   colour one normals; `norm` beside them wins. Of two lines for one slot the last counts.
//! * Heights: white stands above black by 1/100 of the picture's width, times `-bm`.
//! * `map_Ka` is passed over, in silence where it repeats `map_Kd`.
//! * `-s` is the repeat: a material has one, that of its base colour or else of its first map.
//!   `-imfchan` picks the channel. The other options are read and have no effect; what a picture of
//!   their default would not show has a warning.
//! * A name is the rest of the line, so it may hold spaces; `\` separates folders as `/` does.

use super::description::{Channel, MapText, MaterialText, Pair};
use super::maps::Slot;

/// A line that names a picture.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Line<'a> {
    /// Each option with its values.
    pub options: Vec<(&'a str, Vec<&'a str>)>,
    pub file: String,
}

/// How many values an option has, at least and at most; beyond the least, only numbers count.
fn values(option: &str) -> Option<(usize, usize)> {
    Some(match option {
        "-o" | "-s" | "-t" => (1, 3),
        "-mm" => (2, 2),
        "-blendu" | "-blendv" | "-bm" | "-boost" | "-cc" | "-clamp" | "-colorspace"
        | "-imfchan" | "-texres" | "-type" => (1, 1),
        _ => return None,
    })
}

/// Splits the rest of a line into options and the file's name, which is empty where there is none.
pub(super) fn parse(rest: &str) -> Line<'_> {
    let mut line = Line::default();
    let mut rest = rest.trim();
    while let Some((least, most)) = values(first(rest)) {
        let option = take(&mut rest);
        let mut list = Vec::new();
        while list.len() < most && !rest.is_empty() {
            let word = first(rest);
            // The last word is the name, were it a number.
            let last = word.len() == rest.len();
            if list.len() >= least && (last || word.parse::<f32>().is_err()) {
                break;
            }
            list.push(take(&mut rest));
        }
        line.options.push((option, list));
    }
    let name = rest.strip_prefix('"').and_then(|r| r.strip_suffix('"'));
    line.file = name.unwrap_or(rest).replace('\\', "/");
    line
}

fn first(rest: &str) -> &str {
    rest.split_whitespace().next().unwrap_or_default()
}

fn take<'a>(rest: &mut &'a str) -> &'a str {
    let (word, after) = rest.split_at(first(rest).len());
    *rest = after.trim_start();
    word
}

/// The slot of a key.
pub(super) fn slot(key: &str) -> Option<Slot> {
    Some(match key {
        "map_Kd" => Slot::BaseColor,
        "map_Pr" => Slot::Roughness,
        "map_Pm" => Slot::Metalness,
        "map_Ke" => Slot::Emission,
        "map_d" => Slot::AlphaMask,
        "map_ao" | "map_AO" | "map_Ao" => Slot::Occlusion,
        "norm" | "map_Bump" | "map_bump" | "bump" => Slot::Normal,
        _ => return None,
    })
}

/// The channel that `-imfchan` names: None for luminance, an error for depth and what is unknown.
pub(super) fn channel(word: &str) -> Result<Option<Channel>, ()> {
    Ok(Some(match word {
        "r" => Channel::Red,
        "g" => Channel::Green,
        "b" => Channel::Blue,
        "m" => Channel::Alpha,
        "l" => return Ok(None),
        _ => return Err(()),
    }))
}

/// True where an option without effect would change the picture: an offset of 0 would not.
pub(super) fn changes(option: &str, words: &[&str]) -> bool {
    let are = |default: f32| words.iter().all(|word| word.parse() == Ok(default));
    match option {
        "-o" | "-t" | "-boost" => !are(0.0),
        "-mm" => words
            .iter()
            .map(|word| word.parse())
            .ne([Ok(0.0_f32), Ok(1.0)]),
        "-clamp" | "-cc" => words != ["off"],
        "-type" => true,
        // Filters and sizes: the renderer's own.
        _ => false,
    }
}

/// The pictures of one material.
#[derive(Debug, Default)]
pub(super) struct MaterialMaps {
    list: Vec<Entry>,
    /// The file of `map_Ka`, and the line.
    pub ambient: Option<(String, usize)>,
}

#[derive(Debug)]
struct Entry {
    slot: Slot,
    map: MapText,
    repeat: [f32; 2],
}

impl MaterialMaps {
    /// Puts a picture into its slot, unless a stronger one is there.
    pub(super) fn add(&mut self, slot: Slot, map: MapText, repeat: [f32; 2]) {
        let heights = |map: &MapText| map.origin.as_ref().is_some_and(|o| o.bump.is_some());
        let entry = Entry { slot, map, repeat };
        match self.list.iter_mut().find(|old| old.slot == slot) {
            Some(old) if heights(&entry.map) && !heights(&old.map) => {}
            Some(old) => *old = entry,
            None => self.list.push(entry),
        }
    }

    /// True where there is none.
    pub(super) fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// The picture of a slot.
    pub(super) fn get(&self, slot: Slot) -> Option<&MapText> {
        let entry = self.list.iter().find(|entry| entry.slot == slot)?;
        Some(&entry.map)
    }

    /// The repeat that the base colour or else the first map has.
    fn repeat(&self) -> Option<[f32; 2]> {
        let base = self.list.iter().find(|entry| entry.slot == Slot::BaseColor);
        Some(base.or(self.list.first())?.repeat)
    }

    /// The line and slot of a map with another repeat than the material's.
    pub(super) fn odd_repeat(&self) -> Option<(usize, Slot)> {
        let repeat = self.repeat()?;
        let odd = self.list.iter().find(|entry| entry.repeat != repeat)?;
        Some((odd.map.origin.as_ref()?.line, odd.slot))
    }

    /// The line of a `map_Ka` that is no copy of `map_Kd`.
    pub(super) fn odd_ambient(&self) -> Option<usize> {
        let (file, line) = self.ambient.as_ref()?;
        let base = self.get(Slot::BaseColor).and_then(|map| map.file.as_ref());
        (base != Some(file)).then_some(*line)
    }

    /// Writes the pictures into a material.
    pub(super) fn fill(&self, material: &mut MaterialText) {
        let get = |slot| self.get(slot).cloned();
        material.base_color_map = get(Slot::BaseColor);
        material.roughness_map = get(Slot::Roughness);
        material.metalness_map = get(Slot::Metalness);
        material.normal_map = get(Slot::Normal);
        material.emission_map = get(Slot::Emission);
        material.occlusion_map = get(Slot::Occlusion);
        material.alpha_mask = get(Slot::AlphaMask);
        material.map_repeat = self.repeat().map(|repeat| Pair(repeat.map(f64::from)));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn options_end_where_the_name_begins() {
        for (text, options, file) in [
            (" wood.png ", 0, "wood.png"),
            (" old wood 2.png", 0, "old wood 2.png"),
            (" -s 2 3 4 a b.png", 1, "a b.png"),
            (" -s 2 3 a.png", 1, "a.png"),
            (" -s 2 a.png", 1, "a.png"),
            (" -o 0 0 0 -s 1 1 1 -bm 0.5 7", 3, "7"),
            (" -o 1 2", 1, "2"),
            (
                " -mm 0 1 -clamp on -imfchan r -type sphere a.png",
                4,
                "a.png",
            ),
            (
                " -blendu off -blendv off -cc on -texres 512 -boost 2 -t 1 1 1 a",
                6,
                "a",
            ),
            (
                " -colorspace sRGB textures\\old wall.png",
                1,
                "textures/old wall.png",
            ),
            (" \"quoted name.png\"", 0, "quoted name.png"),
            (" -unknown.png", 0, "-unknown.png"),
            (" -bm", 1, ""),
            ("", 0, ""),
        ] {
            let line = parse(text);
            assert_eq!(
                (line.options.len(), line.file.as_str()),
                (options, file),
                "{text}"
            );
        }
        let line = parse("-s 2 3 x.png");
        assert_eq!(line.options, [("-s", vec!["2", "3"])]);
    }
}
