//! How are the numbers of a texture written to a file and read back, and how far may they differ?

use std::fs::{self, File};
use std::io::BufWriter;

use image::codecs::hdr::HdrEncoder;
use image::codecs::jpeg::JpegEncoder;
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ColorType, ExtendedColorType, ImageEncoder, Rgb};

use super::Sample;
use crate::tolerances;

/// Above 90 a JPEG of noise grows fast and looks the same.
const JPEG_QUALITY: u8 = 90;

/// The sRGB code of a linear number (IEC 61966-2-1), 0..1.
pub fn encode_srgb(x: f64) -> f64 {
    if x <= 0.003_130_8 {
        12.92 * x
    } else {
        1.055 * x.powf(1.0 / 2.4) - 0.055
    }
}

/// Its inverse.
pub fn decode_srgb(x: f64) -> f64 {
    if x <= 0.04045 {
        x / 12.92
    } else {
        ((x + 0.055) / 1.055).powf(2.4)
    }
}

/// Writes what the functions of a sample give.
pub fn write(sample: &Sample) -> Result<(), String> {
    let made = sample.made();
    let path = sample.path();
    let text = |error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder).map_err(|e| text(&e))?;
    }
    let file = BufWriter::new(File::create(&path).map_err(|e| text(&e))?);
    let [width, height] = sample.size;
    let codes: Vec<u8> = made.iter().map(|x| (x * 255.0).round() as u8).collect();
    let color = match sample.channels() {
        1 => ExtendedColorType::L8,
        _ => ExtendedColorType::Rgb8,
    };
    if sample.file.ends_with(".hdr") {
        let [r, g, b] = [0, 1, 2].map(|k| move |texel: &[f64]| texel[k] as f32);
        let texels: Vec<_> = made
            .chunks_exact(3)
            .map(|texel| Rgb([r(texel), g(texel), b(texel)]))
            .collect();
        HdrEncoder::new(file).encode(&texels, width as usize, height as usize)
    } else if sample.file.ends_with(".jpg") {
        JpegEncoder::new_with_quality(file, JPEG_QUALITY).write_image(&codes, width, height, color)
    } else {
        PngEncoder::new_with_quality(file, CompressionType::Best, FilterType::Adaptive)
            .write_image(&codes, width, height, color)
    }
    .map_err(|e| text(&e))
}

/// The numbers of a sample's file, integers as 0..1.
pub fn read(sample: &Sample) -> Result<Vec<f64>, String> {
    let text = |error: &dyn std::fmt::Display| format!("scenes/{}: {error}", sample.file);
    let path = sample.path();
    if !path.exists() {
        let name = sample.name();
        let what = format!("there is none: BLESS_TEXTURES={name} writes it; look at it then");
        return Err(text(&what));
    }
    let picture = image::open(path).map_err(|e| text(&e))?;
    if [picture.width(), picture.height()] != sample.size {
        return Err(text(&"another size"));
    }
    let wanted = match (sample.file.ends_with(".hdr"), sample.channels()) {
        (true, _) => ColorType::Rgb32F,
        (false, 1) => ColorType::L8,
        (false, _) => ColorType::Rgb8,
    };
    if picture.color() != wanted {
        return Err(text(&format!("{:?}, not {wanted:?}", picture.color())));
    }
    Ok(match wanted {
        ColorType::Rgb32F => picture.to_rgb32f().iter().map(|x| f64::from(*x)).collect(),
        _ => picture
            .as_bytes()
            .iter()
            .map(|x| f64::from(*x) / 255.0)
            .collect(),
    })
}

/// Compares 8-bit codes, of which each may be `most` away, and `mean` on the average.
pub fn compare_codes(kept: &[f64], made: &[f64], most: f64, mean: f64) -> Result<(), String> {
    let code = |x: &f64| (x * 255.0).round();
    let steps = || {
        kept.iter()
            .zip(made)
            .map(|(a, b)| (code(a) - code(b)).abs())
    };
    let largest = steps().fold(0.0, f64::max);
    let average = steps().sum::<f64>() / kept.len().max(1) as f64;
    if largest <= most && average <= mean {
        return Ok(());
    }
    Err(format!(
        "codes differ by up to {largest}, {average:.2} in the mean"
    ))
}

/// Compares texels of one exponent for three mantissas.
pub fn compare_radiance(kept: &[f64], made: &[f64]) -> Result<(), String> {
    for (n, (a, b)) in kept.chunks_exact(3).zip(made.chunks_exact(3)).enumerate() {
        let largest = b.iter().copied().fold(0.0, f64::max);
        let step = a
            .iter()
            .zip(b)
            .map(|(a, b)| (a - b).abs())
            .fold(0.0, f64::max);
        if step > tolerances::RGBE_STEP * largest {
            return Err(format!("texel {n} is {a:?}, not {b:?}"));
        }
    }
    Ok(())
}
