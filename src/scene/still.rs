//! Which picture does a file hold that is looked at, and not a texture?

use std::path::Path;

use super::error::Error;
use super::image_file::{ImageFile, Picture};
use super::texture::{Data, MAX_TEXTURE_PIXELS};

/// A picture from a file. Row 0 is its top.
#[derive(Clone, Debug, PartialEq)]
pub struct Still {
    /// Pixels a row, 1 to [`MAX_TEXTURE_SIDE`](super::MAX_TEXTURE_SIDE).
    pub width: u32,
    /// Rows, as many at most.
    pub height: u32,
    /// Row by row.
    pub pixels: StillPixels,
}

/// What its numbers are. Grey is red, green and blue alike.
#[derive(Clone, Debug, PartialEq)]
pub enum StillPixels {
    /// Of PNG and JPEG: sRGB codes, 0 to 255, in 257ths where the file has 16 bits. What is transparent lies over black, and is
    /// blended as screens do it: code times alpha.
    Codes(Vec<[f32; 3]>),
    /// Of EXR and HDR: the numbers as they are, linear, premultiplied by alpha; a NaN or an infinity too.
    Linear(Vec<[f32; 4]>),
}

impl Still {
    /// Reads a PNG, JPEG, HDR or EXR file, told by its content.
    ///
    /// # Errors
    /// The file is missing, unreadable, of another kind, damaged, cut short, or larger than what textures may be.
    pub fn read(path: &Path) -> Result<Self, Error> {
        let picture = ImageFile::open(path)?.decode_as_it_is(MAX_TEXTURE_PIXELS)?;
        Ok(Self {
            width: picture.width,
            height: picture.height,
            pixels: match &picture.data {
                Data::U8(data) => codes(&picture, |place| f32::from(data[place])),
                Data::U16(data) => codes(&picture, |place| f32::from(data[place]) / 257.0),
                Data::F32(data) => linear(&picture, data),
            },
        })
    }
}

/// Where a pixel's red, green and blue are, and its alpha.
fn places(picture: &Picture, pixel: usize) -> ([usize; 3], Option<usize>) {
    let first = pixel * picture.channels;
    match picture.channels {
        1 => ([first; 3], None),
        2 => ([first; 3], Some(first + 1)),
        3 => ([first, first + 1, first + 2], None),
        _ => ([first, first + 1, first + 2], Some(first + 3)),
    }
}

fn codes(picture: &Picture, code: impl Fn(usize) -> f32) -> StillPixels {
    let pixels = (0..picture.data.len() / picture.channels).map(|pixel| {
        let (rgb, alpha) = places(picture, pixel);
        let alpha = alpha.map_or(255.0, &code);
        rgb.map(|place| match alpha {
            255.0 => code(place),
            alpha => code(place) * alpha / 255.0,
        })
    });
    StillPixels::Codes(pixels.collect())
}

fn linear(picture: &Picture, data: &[f32]) -> StillPixels {
    let pixels = (0..data.len() / picture.channels).map(|pixel| {
        let (rgb, alpha) = places(picture, pixel);
        let [r, g, b] = rgb.map(|place| data[place]);
        [r, g, b, alpha.map_or(1.0, |place| data[place])]
    });
    StillPixels::Linear(pixels.collect())
}
