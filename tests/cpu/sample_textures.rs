//! Are the sample textures what their functions say?
//!
//! Each file is made by the functions of this folder and compared with them, texel by texel. A
//! missing or changed one fails; `BLESS_TEXTURES=name[,name]` writes files by name, one look each (other
//! tests may read them half-written in that run).

mod codes;
mod grid;
mod patterns;
mod properties;
mod stuffs;
mod torus;

use std::path::PathBuf;

use grid::{Relief, sample};
use torus::Point;

use crate::tolerances;

/// All of them together, so that a clone of the project stays small.
const MAX_BYTES: u64 = 1_500_000;

/// What a file holds, and of what.
enum Content {
    /// A factor on the albedo, or an emission, sRGB-encoded.
    Color(fn(Point) -> [f64; 3]),
    /// A number.
    Grey(fn(Point) -> f64),
    /// The normals of a height.
    Normal(fn(Point) -> f64),
    /// The open share of the sky above a height.
    Occlusion(fn(Point) -> f64),
    /// Linear, above 1 as well.
    Radiance(fn(Point) -> [f64; 3]),
}

struct Sample {
    /// From `scenes`; its stem is its name. The ending says how it is encoded.
    file: &'static str,
    size: [u32; 2],
    content: Content,
    /// The mean of its linear numbers; a single channel's three times, of normals the vectors'.
    mean: [f64; 3],
}

const fn of(file: &'static str, size: [u32; 2], content: Content, mean: [f64; 3]) -> Sample {
    Sample {
        file,
        size,
        content,
        mean,
    }
}

use Content::{Color, Grey, Normal, Occlusion, Radiance};

const SAMPLES: &[Sample] = &[
    of(
        "textures/wood_base_color.jpg",
        [256, 512],
        Color(stuffs::wood_color),
        [0.77, 0.74, 0.70],
    ),
    of(
        "textures/wood_roughness.png",
        [128, 512],
        Grey(stuffs::wood_roughness),
        [0.81, 0.81, 0.81],
    ),
    of(
        "textures/wood_normal.png",
        [256, 512],
        Normal(stuffs::wood_height),
        [0.00, 0.00, 0.99],
    ),
    of(
        "textures/carpet_base_color.jpg",
        [384; 2],
        Color(stuffs::carpet_color),
        [0.76, 0.76, 0.76],
    ),
    of(
        "textures/carpet_normal.png",
        [320; 2],
        Normal(stuffs::carpet_height),
        [0.00, 0.00, 0.89],
    ),
    of(
        "textures/dirt_base_color.jpg",
        [512; 2],
        Color(stuffs::dirt_color),
        [0.68, 0.63, 0.58],
    ),
    of(
        "textures/dirt_roughness.png",
        [256; 2],
        Grey(stuffs::dirt_roughness),
        [0.95, 0.95, 0.95],
    ),
    of(
        "textures/dirt_normal.png",
        [256; 2],
        Normal(stuffs::dirt_height),
        [0.00, 0.00, 0.88],
    ),
    of(
        "textures/plaster_base_color.png",
        [128; 2],
        Color(stuffs::plaster_color),
        [0.95, 0.95, 0.95],
    ),
    of(
        "textures/plaster_roughness.png",
        [128; 2],
        Grey(stuffs::plaster_roughness),
        [0.90, 0.90, 0.90],
    ),
    of(
        "textures/plaster_normal.png",
        [256; 2],
        Normal(stuffs::plaster_height),
        [0.00, 0.00, 1.00],
    ),
    of(
        "effects/textures/tile_base_color.jpg",
        [256; 2],
        Color(patterns::tile_color),
        [0.61, 0.61, 0.64],
    ),
    of(
        "effects/textures/damask_roughness.png",
        [256; 2],
        Grey(patterns::damask_roughness),
        [0.34, 0.34, 0.34],
    ),
    of(
        "effects/textures/inlay_metalness.png",
        [256; 2],
        Grey(patterns::inlay_metalness),
        [0.26, 0.26, 0.26],
    ),
    of(
        "effects/textures/stud_normal.png",
        [128; 2],
        Normal(patterns::stud_height),
        [0.00, 0.00, 0.81],
    ),
    of(
        "effects/textures/stud_occlusion.png",
        [128; 2],
        Occlusion(patterns::stud_height),
        [0.81, 0.81, 0.81],
    ),
    of(
        "effects/textures/sign_emission.png",
        [256, 128],
        Color(patterns::sign_emission),
        [0.06, 0.03, 0.03],
    ),
    of(
        "effects/textures/ember_emission.hdr",
        [128; 2],
        Radiance(patterns::ember_emission),
        [2.24, 0.47, 0.07],
    ),
    of(
        "effects/textures/lace_alpha.png",
        [256; 2],
        Grey(patterns::lace_alpha),
        [0.46, 0.46, 0.46],
    ),
];

impl Sample {
    fn path(&self) -> PathBuf {
        let scenes = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("scenes");
        scenes.join(self.file)
    }

    fn name(&self) -> &'static str {
        let name = self.file.rsplit('/').next().unwrap_or(self.file);
        name.split('.').next().unwrap_or(name)
    }

    /// The numbers that its functions give, three a texel or one, as a file holds them.
    fn made(&self) -> Vec<f64> {
        let clamped = |x: f64| x.clamp(0.0, 1.0);
        match self.content {
            Color(color) => sample(self.size, color)
                .into_iter()
                .flatten()
                .map(|x| codes::encode_srgb(clamped(x)))
                .collect(),
            Radiance(radiance) => sample(self.size, radiance).into_iter().flatten().collect(),
            Grey(grey) => sample(self.size, grey).into_iter().map(clamped).collect(),
            Normal(height) => Relief::new(self.size, height)
                .normals()
                .into_iter()
                .flatten()
                .map(|x| 0.5 * x + 0.5)
                .collect(),
            Occlusion(height) => Relief::new(self.size, height).occlusion(),
        }
    }

    fn channels(&self) -> usize {
        match self.content {
            Color(_) | Normal(_) | Radiance(_) => 3,
            Grey(_) | Occlusion(_) => 1,
        }
    }

    /// Compares the file with what its functions give.
    fn compare(&self) -> Result<(), String> {
        let (name, file) = (self.name(), self.file);
        let kept = codes::read(self)?;
        let made = self.made();
        let wrong = if file.ends_with(".hdr") {
            codes::compare_radiance(&kept, &made)
        } else if file.ends_with(".jpg") {
            codes::compare_codes(
                &kept,
                &made,
                tolerances::SAMPLE_JPEG_CODES,
                tolerances::JPEG_MEAN,
            )
        } else {
            codes::compare_codes(&kept, &made, tolerances::PNG_CODES, tolerances::PNG_MEAN)
        };
        wrong.map_err(|what| {
            format!("scenes/{file}: {what}; BLESS_TEXTURES={name} writes it anew; look at it then")
        })
    }
}

/// The samples named in `BLESS_TEXTURES`. By name only: whoever accepts one has looked at it.
fn blessing(text: &str) -> Result<Vec<&'static Sample>, String> {
    let names = text.split(',').filter(|name| !name.is_empty());
    let known = |name: &str| SAMPLES.iter().find(|sample| sample.name() == name);
    let sample = |name: &str| {
        known(name).ok_or_else(|| {
            let all: Vec<_> = SAMPLES.iter().map(Sample::name).collect();
            format!(
                "BLESS_TEXTURES={name}: textures are written by name, with a look at each: {}",
                all.join(", ")
            )
        })
    };
    names.map(sample).collect()
}

#[test]
fn textures_are_as_their_functions_say() {
    let text = std::env::var("BLESS_TEXTURES").unwrap_or_default();
    let blessed = blessing(&text).unwrap_or_else(|message| panic!("{message}"));
    let written = blessed.into_iter().map(codes::write);
    let compared = SAMPLES.iter().map(Sample::compare);
    let failures: Vec<_> = written.chain(compared).filter_map(Result::err).collect();
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn textures_are_written_by_name_only() {
    let names = |text: &str| -> Result<Vec<_>, String> {
        Ok(blessing(text)?.into_iter().map(Sample::name).collect())
    };
    assert_eq!(names(""), Ok(vec![]));
    assert_eq!(
        names("wood_normal,lace_alpha"),
        Ok(vec!["wood_normal", "lace_alpha"])
    );
    for wrong in ["all", "1", "*", "wood", "wood_normal,all"] {
        let message = names(wrong).expect_err(wrong);
        assert!(message.contains("by name") && message.contains("dirt_normal"));
    }
}

#[test]
fn a_missing_texture_says_how_it_is_made() {
    let sample = of(
        "textures/moss_normal.png",
        [8; 2],
        Normal(stuffs::dirt_height),
        [0.0; 3],
    );
    let message = sample.compare().expect_err("missing");
    for words in [
        "scenes/textures/moss_normal.png: there is none",
        "BLESS_TEXTURES=moss_normal",
    ] {
        assert!(message.contains(words), "no '{words}': {message}");
    }
}
