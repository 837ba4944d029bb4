//! What does a Wavefront MTL file say about its materials, and which numbers does that make?
//!
//! tobj 4.0.5 panics on a colour of fewer than three numbers and gives up a whole file for one odd
//! value, so each line is checked first, and only sound ones reach it. A number that is NaN,
//! infinite or no number is refused with its line; a finite one out of range is clamped, with a
//! warning.

use std::collections::BTreeMap;
use std::io::Read;
use std::path::Path;

use indexmap::IndexMap;

use super::camera::DEFAULT_EV100;
use super::checks::BRIGHTEST;
use super::description::{MapText, MaterialText, MtlOrigin, Triple};
use super::error::Error;
use super::maps::Slot;
use super::materials::{
    DEFAULT_ALBEDO, DEFAULT_ROUGHNESS, DIELECTRIC_F0, MAX_SHININESS, roughness_from_shininess,
    shininess_from_roughness,
};
use super::mtl_maps::{self, MaterialMaps};
use super::paths::BYTE_ORDER_MARK;
use super::quote;
use super::quote::{material_name, text};
use super::warnings::Warnings;

/// One MTL file as tobj reads it.
pub(super) struct Library {
    pub materials: Vec<tobj::Material>,
    /// The pictures of each material.
    pub maps: Vec<MaterialMaps>,
    /// The file's size.
    pub bytes: u64,
    pub warnings: Vec<String>,
}

/// The most bytes that are read of one OBJ's MTL files together: a hundred thousand materials.
pub(super) const LARGEST: u64 = 64 << 20;

/// The repeats of a picture, as a scene file may have them.
const MAP_REPEAT: (f64, f64) = (1e-3, 1e6);
/// The largest factor of heights: white stands as high as the picture is wide.
const MOST_BUMP: f64 = 100.0;

/// What a key's values are.
enum Kind {
    /// Three numbers (or one for all three) up to the given one.
    Color(f64),
    /// One number, between the given ones.
    Number(f64, f64),
    /// A picture.
    Map(Slot),
    /// The picture that exporters write a second time.
    AmbientMap,
    /// Known, but without effect so far: named once in a warning.
    Unused,
}

/// The keys that mean something here; all others are passed over in silence.
fn kind(key: &str) -> Option<Kind> {
    Some(match key {
        "Kd" | "Ks" => Kind::Color(1.0),
        "Ke" => Kind::Color(BRIGHTEST),
        "Ns" => Kind::Number(0.0, 1e6),
        "Ni" => Kind::Number(0.0, 100.0),
        "d" | "Tr" | "Pr" | "Pm" => Kind::Number(0.0, 1.0),
        "map_Ka" => Kind::AmbientMap,
        "Ps" | "Pc" | "Pcr" | "aniso" | "anisor" | "disp" | "decal" | "refl" => Kind::Unused,
        _ if let Some(slot) = mtl_maps::slot(key) => Kind::Map(slot),
        _ if key.starts_with("map_") => Kind::Unused,
        _ => return None,
    })
}

/// Reads an MTL file of at most `room` bytes; `path` is for messages.
pub(super) fn load(path: &Path, file: impl Read, room: u64) -> Result<Library, Error> {
    let mut bytes = Vec::new();
    file.take(room + 1)
        .read_to_end(&mut bytes)
        .map_err(|error| Error::io(path, &error))?;
    if bytes.len() as u64 > room {
        return Err(Error::file(
            path,
            "is too large: the material libraries of an OBJ may have 64 MiB together",
        ));
    }
    parse(path, &bytes)
}

/// Reads the text of an MTL file; `path` is for messages.
fn parse(path: &Path, bytes: &[u8]) -> Result<Library, Error> {
    let mut clean = Clean {
        path,
        line: 0,
        ready: String::new(),
        unused: BTreeMap::new(),
        homeless: None,
        warnings: Warnings::default(),
        names: IndexMap::new(),
        maps: Vec::new(),
    };
    let text = bytes.strip_prefix(BYTE_ORDER_MARK).unwrap_or(bytes);
    for raw in text.split(|&byte| byte == b'\n') {
        clean.line += 1;
        clean.pass(raw)?;
    }
    clean.report();
    let (materials, _) = tobj::load_mtl_buf(&mut clean.ready.as_bytes())
        .map_err(|error| Error::file(path, quote::message(&error.to_string())))?;
    Ok(Library {
        materials,
        maps: clean.maps,
        bytes: bytes.len() as u64,
        warnings: clean.warnings.into_text(),
    })
}

/// The sound lines of an MTL file.
struct Clean<'a> {
    path: &'a Path,
    line: usize,
    ready: String,
    /// Per unused key: its first line and how often it stands.
    unused: BTreeMap<String, (usize, usize)>,
    /// Of the keys before the first `newmtl`: the first, its line, and how many they are.
    homeless: Option<(String, usize, usize)>,
    warnings: Warnings,
    names: IndexMap<String, usize>,
    /// One for each `newmtl`.
    maps: Vec<MaterialMaps>,
}

impl Clean<'_> {
    fn pass(&mut self, raw: &[u8]) -> Result<(), Error> {
        let line = raw.trim_ascii();
        if line.contains(&0) {
            return Err(self.refuse("holds a zero byte: this is not an MTL file"));
        }
        let split = line
            .iter()
            .position(u8::is_ascii_whitespace)
            .unwrap_or(line.len());
        let (key, rest) = (text(&line[..split]), &line[split..]);
        if key == "newmtl" {
            return self.begin(rest);
        }
        let kind = kind(&key);
        if kind.is_some() && self.names.is_empty() {
            let entry = self.homeless.get_or_insert((key, self.line, 0));
            entry.2 += 1;
            return Ok(());
        }
        match kind {
            None => Ok(()),
            Some(Kind::Unused) => {
                self.unused(key, self.line);
                Ok(())
            }
            Some(Kind::Map(slot)) => self.map(&key, slot, &String::from_utf8_lossy(rest)),
            Some(Kind::AmbientMap) => {
                let file = mtl_maps::parse(&String::from_utf8_lossy(rest)).file;
                if let Some(maps) = self.maps.last_mut() {
                    maps.ambient = Some((file, self.line));
                }
                Ok(())
            }
            Some(Kind::Color(high)) => self.color(&key, &text(rest), high),
            Some(Kind::Number(low, high)) => self.scalar(&key, &text(rest), low, high),
        }
    }

    fn begin(&mut self, rest: &[u8]) -> Result<(), Error> {
        let name = material_name(rest).map_err(|fault| self.refuse(format!("newmtl: {fault}")))?;
        if name.is_empty() {
            return Err(self.refuse("newmtl without a name"));
        }
        if let Some(earlier) = self.names.insert(name.clone(), self.line) {
            let name = quote::short(&name);
            self.warn(format!(
                "material '{name}' was defined in line {earlier} already; this one counts"
            ));
        }
        self.ready.push_str(&format!("newmtl {name}\n"));
        self.end_material();
        self.maps.push(MaterialMaps::default());
        Ok(())
    }

    /// Tells of what the maps of the last material say and what is not obeyed.
    fn end_material(&mut self) {
        let Some(maps) = self.maps.last() else {
            return;
        };
        if let Some(line) = maps.odd_ambient() {
            self.unused("map_Ka".to_owned(), line);
        }
        if let Some(maps) = self.maps.last()
            && let Some((line, slot)) = maps.odd_repeat()
        {
            let name = slot.name();
            let message = format!(
                "the {name} map has an -s of its own: it repeats as the material's first map does"
            );
            self.warn_at(line, message);
        }
    }

    /// Notes a key without effect.
    fn unused(&mut self, key: String, line: usize) {
        self.unused.entry(key).or_insert((line, 0)).1 += 1;
    }

    /// A line that names a picture.
    fn map(&mut self, key: &str, slot: Slot, rest: &str) -> Result<(), Error> {
        let line = mtl_maps::parse(rest);
        if line.file.is_empty() {
            self.warn(format!("{key} names no file"));
            return Ok(());
        }
        let (mut repeat, mut bump, mut channel) = ([1.0; 2], 1.0, None);
        for (option, words) in &line.options {
            match (*option, &words[..]) {
                ("-s", words) => {
                    for (to, word) in repeat.iter_mut().zip(words) {
                        *to =
                            self.number(&format!("{key} -s"), word, MAP_REPEAT.0, MAP_REPEAT.1)?;
                    }
                }
                ("-bm", [word]) => {
                    bump = self.number(&format!("{key} -bm"), word, -MOST_BUMP, MOST_BUMP)?;
                }
                ("-imfchan", [word]) => match mtl_maps::channel(word) {
                    Ok(found) => channel = found,
                    Err(()) => self.unused(format!("{key} -imfchan {word}"), self.line),
                },
                (option, words) if mtl_maps::changes(option, words) => {
                    self.unused(format!("{key} {option}"), self.line);
                }
                _ => {}
            }
        }
        let map = MapText {
            file: Some(line.file),
            channel,
            origin: Some(MtlOrigin {
                path: self.path.to_path_buf(),
                line: self.line,
                bump: (slot == Slot::Normal && key != "norm").then_some(bump),
            }),
        };
        if let Some(maps) = self.maps.last_mut() {
            maps.add(slot, map, repeat);
        }
        Ok(())
    }

    fn color(&mut self, key: &str, rest: &str, high: f64) -> Result<(), Error> {
        let words: Vec<&str> = values(rest);
        if matches!(words.first(), Some(&("spectral" | "xyz"))) {
            self.warn(format!("{key} {}: only RGB is read; left out", words[0]));
            return Ok(());
        }
        let words = match words[..] {
            [grey] => [grey; 3],
            [r, g, b, ..] => [r, g, b],
            _ => return Err(self.refuse(format!("{key} needs one or three numbers"))),
        };
        let mut line = key.to_owned();
        for word in words {
            let value = self.number(key, word, 0.0, high)?;
            line.push_str(&format!(" {value}"));
        }
        self.ready.push_str(&line);
        self.ready.push('\n');
        Ok(())
    }

    fn scalar(&mut self, key: &str, rest: &str, low: f64, high: f64) -> Result<(), Error> {
        // The last word: `d -halo 0.5` has an option before the number.
        let Some(word) = values(rest).pop() else {
            return Err(self.refuse(format!("{key} needs a number")));
        };
        let value = self.number(key, word, low, high)?;
        self.ready.push_str(&format!("{key} {value}\n"));
        Ok(())
    }

    fn number(&mut self, key: &str, word: &str, low: f64, high: f64) -> Result<f32, Error> {
        let value: f32 = word
            .parse()
            .map_err(|_| self.refuse(format!("{key}: '{}' is not a number", quote::short(word))))?;
        if !value.is_finite() {
            let word = quote::short(word);
            return Err(self.refuse(format!("{key} is {word}: NaN and infinity have no place")));
        }
        let clamped = f64::from(value).clamp(low, high);
        if clamped != f64::from(value) {
            let word = quote::short(word);
            self.warn(format!("{key} = {word} is taken as {clamped}"));
        }
        Ok(clamped as f32)
    }

    fn report(&mut self) {
        self.end_material();
        if let Some((key, line, count)) = self.homeless.take() {
            self.line = line;
            self.warn(match count {
                1 => format!(
                    "{} stands before the first newmtl: left out",
                    quote::short(&key)
                ),
                _ => format!(
                    "{} and {} more lines stand before the first newmtl: left out",
                    quote::short(&key),
                    count - 1
                ),
            });
        }
        for (key, (line, count)) in std::mem::take(&mut self.unused) {
            let key = quote::short(&key);
            let message = match count {
                1 => format!("{key} is not used yet"),
                _ => format!("{key} is not used yet ({count} times, here first)"),
            };
            self.warn_at(line, message);
        }
    }

    fn refuse(&self, message: impl Into<String>) -> Error {
        Error::line(self.path, self.line, message)
    }

    fn warn(&mut self, message: String) {
        self.warn_at(self.line, message);
    }

    fn warn_at(&mut self, line: usize, message: String) {
        let place = format!("{}:{line}", quote::path(self.path));
        self.warnings.push(format!("{place}: {message}"));
    }
}

/// A line's words up to a comment.
fn values(rest: &str) -> Vec<&str> {
    rest.split_whitespace()
        .take_while(|word| !word.starts_with('#'))
        .collect()
}

/// Below this largest channel a diffuse colour is black, and the surface is taken for a metal.
const BLACK: f64 = 0.04;
/// Disney's and Blender's `specular` from 0 to 1 spans f0 from 0 to 0.08 (Burley 2012, section 5.4);
/// their default 0.5 is f0 0.04.
const SPECULAR_F0: f64 = 0.08;
/// Ke has no unit. Ke 1 becomes the luminance that the default exposure shows as white, cd/m^2:
/// 1.2 * 2^EV100.
const WHITE: f64 = 1.2 * (1_u32 << DEFAULT_EV100 as u32) as f64;

/// The numbers of an MTL material.
///
/// * albedo = Kd (1 - Pm), f0 = mix(F0, Kd, Pm), where F0 = ((Ni - 1) / (Ni + 1))^2 if Ni > 1, else
///   0.04.
/// * Where neither Pm nor an Ni above 1 is given, Ks gives f0: as it stands where Kd is black (a
///   metal or mirror), else 0.08 Ks. Exporters write Ks 0.5 or 1 for any plastic, far above the
///   0.17 of diamond, so with a diffuse colour it is a strength and no reflectance.
/// * roughness = Pr, else sqrt(2 / (Ns + 2)), else 0.5; shininess = Ns, else 2 / roughness^2 - 2.
/// * opacity = d, else 1 - Tr; emission = Ke times 1229 cd/m^2, white at the default exposure.
/// * Where a picture multiplies a number that is absent, the number is 1; so is a black Kd or Ke,
///   which exporters write beside a picture. With a map_Pm, Pm multiplies it, and the surface decides
///   between metal and not.
pub(super) fn convert(material: &tobj::Material, maps: &MaterialMaps) -> MaterialText {
    let extra = |key: &str| {
        let word = material.unknown_param.get(key)?;
        word.parse::<f64>().ok()
    };
    let wide = |color: [f32; 3]| color.map(f64::from);
    let has = |slot| maps.get(slot).is_some();
    let given = |color: Option<[f32; 3]>, slot, default: f64| match color.map(wide) {
        None | Some([0.0, 0.0, 0.0]) if has(slot) => [1.0; 3],
        color => color.unwrap_or([default; 3]),
    };
    let diffuse = given(material.diffuse, Slot::BaseColor, DEFAULT_ALBEDO);
    let metalness = extra("Pm");
    let metal = metalness.filter(|_| !has(Slot::Metalness));
    let index = material.optical_density.map(f64::from).filter(|&n| n > 1.0);
    let dielectric = index.map(|n| ((n - 1.0) / (n + 1.0)).powi(2));
    let f0 = match (metal, dielectric, material.specular.map(wide)) {
        (None, None, Some(ks)) if diffuse.iter().all(|&x| x < BLACK) => ks,
        (None, None, Some(ks)) => ks.map(|x| SPECULAR_F0 * x),
        (metal, dielectric, _) => {
            let (metal, base) = (metal.unwrap_or(0.0), dielectric.unwrap_or(DIELECTRIC_F0));
            diffuse.map(|kd| base + (kd - base) * metal)
        }
    };
    let exponent = material.shininess.map(f64::from);
    let roughness = extra("Pr")
        .or(exponent
            .filter(|_| !has(Slot::Roughness))
            .map(roughness_from_shininess))
        .unwrap_or(if has(Slot::Roughness) {
            1.0
        } else {
            DEFAULT_ROUGHNESS
        });
    let shininess = exponent.unwrap_or_else(|| shininess_from_roughness(roughness));
    let opacity = material.dissolve.map(f64::from);
    let opacity = opacity.or(extra("Tr").map(|tr| 1.0 - tr)).unwrap_or(1.0);
    let emission = given(material.emissive, Slot::Emission, 0.0);
    let mut text = MaterialText {
        like: None,
        albedo: Some(Triple(diffuse.map(|kd| kd * (1.0 - metal.unwrap_or(0.0))))),
        f0: Some(Triple(f0)),
        roughness: Some(roughness),
        opacity: Some(opacity),
        emission: Some(Triple(emission.map(|ke| (ke * WHITE).min(BRIGHTEST)))),
        shininess: Some(shininess.min(f64::from(MAX_SHININESS))),
        metalness,
        ..MaterialText::default()
    };
    maps.fill(&mut text);
    text
}
