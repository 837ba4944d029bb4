//! Which picture does an image file hold?
//!
//! PNG (8 and 16 bits, grey, palette, alpha), JPEG (grey, colour, CMYK), Radiance HDR and OpenEXR
//! (R, G, B or Y, and A), told by their content and not by their names. Of an animated PNG the still
//! picture is taken; profiles, gammas and turns (EXIF) are not looked at. Every size is read from
//! the header and checked before anything is unpacked, and a file that ends early is refused.

use std::io::{Cursor, Read};
use std::path::{Path, PathBuf};

use exr::prelude::{FlatSamples, ReadChannels, ReadLayers};
use image::codecs::{hdr::HdrDecoder, png::PngDecoder};
use image::{DynamicImage, ImageDecoder, ImageFormat, Limits};
use zune_jpeg::JpegDecoder;
use zune_jpeg::zune_core::bytestream::ZCursor;
use zune_jpeg::zune_core::colorspace::ColorSpace;
use zune_jpeg::zune_core::options::DecoderOptions;

use super::error::Error;
use super::texture::{Data, MAX_TEXTURE_PIXELS, MAX_TEXTURE_SIDE};
use super::{paths, quote};

/// The largest image file, bytes: a PNG of the longest sides with 3 x 8 bits that does not compress
/// has 192 MiB.
const LARGEST_FILE: u64 = 256 << 20;
/// The most memory that a decoder may take: the most pixels with four f32 each.
const MOST_MEMORY: u64 = MAX_TEXTURE_PIXELS * 16;

/// A decoded picture: 1 (grey), 2 (grey, alpha), 3 (colour) or 4 (colour, alpha) numbers per pixel,
/// row by row from the top.
pub(super) struct Picture {
    pub width: u32,
    pub height: u32,
    pub channels: usize,
    pub data: Data,
    /// Only its still picture was taken.
    pub animated: bool,
}

/// The bytes of a file whose kind is known.
pub(super) struct ImageFile {
    path: PathBuf,
    bytes: Vec<u8>,
    format: Option<ImageFormat>,
}

impl ImageFile {
    /// Reads the file.
    pub(super) fn open(path: &Path) -> Result<Self, Error> {
        let file = paths::open(path)?;
        let size = file.metadata().map_or(0, |facts| facts.len());
        let mut bytes = Vec::new();
        if size <= LARGEST_FILE {
            // A file may grow while it is read.
            file.take(LARGEST_FILE + 1)
                .read_to_end(&mut bytes)
                .map_err(|error| Error::io(path, &error))?;
        }
        if size.max(bytes.len() as u64) > LARGEST_FILE {
            let message = "is larger than 256 MiB, the most that an image file may have";
            return Err(Error::file(path, message));
        }
        Ok(Self {
            path: path.to_path_buf(),
            format: image::guess_format(&bytes).ok(),
            bytes,
        })
    }

    /// What is wrong with the kind of file, if it is none that is read here.
    pub(super) fn foreign(&self) -> Option<String> {
        use ImageFormat::{Hdr, Jpeg, OpenExr, Png};
        let what = match self.format {
            Some(Png | Jpeg | Hdr | OpenExr) => return None,
            Some(other) => format!("is a picture of the kind {other:?}"),
            None if self.bytes.is_empty() => "is empty".to_owned(),
            None => "is no picture of a known kind".to_owned(),
        };
        Some(format!("{what}: save it as PNG, JPEG, HDR or EXR"))
    }

    /// Unpacks the picture, which may have `room` pixels; one that holds a NaN or an infinity is refused.
    pub(super) fn decode(self, room: u64) -> Result<Picture, Error> {
        let picture = self.decode_as_it_is(room)?;
        self.finite(&picture)?;
        Ok(picture)
    }

    /// Unpacks the picture, which may have `room` pixels and hold anything that a float can.
    pub(super) fn decode_as_it_is(&self, room: u64) -> Result<Picture, Error> {
        let fit = |width: usize, height: usize| self.fit(width, height, room);
        match self.format {
            Some(ImageFormat::Png) => self.png(fit),
            Some(ImageFormat::Jpeg) => self.jpeg(fit),
            Some(ImageFormat::Hdr) => self.hdr(fit),
            Some(ImageFormat::OpenExr) => self.exr(fit),
            _ => Err(self.refuse(self.foreign().unwrap_or_default())),
        }
    }

    fn refuse(&self, message: impl Into<String>) -> Error {
        Error::file(&self.path, message)
    }

    fn damaged(&self, error: &impl std::fmt::Display) -> Error {
        let error = quote::message(&error.to_string());
        self.refuse(format!(
            "is damaged or cut short: {error}: save or copy it anew"
        ))
    }

    /// Refuses a picture that is empty or too large.
    fn fit(&self, width: usize, height: usize, room: u64) -> Result<(), Error> {
        if width == 0 || height == 0 {
            return Err(self.refuse(format!("has no pixels ({width} x {height})")));
        }
        if width.max(height) > MAX_TEXTURE_SIDE as usize {
            return Err(self.refuse(format!(
                "has {width} x {height} pixels: {MAX_TEXTURE_SIDE} a side are the most; scale it down"
            )));
        }
        if (width * height) as u64 > room {
            return Err(self.refuse(format!(
                "has {width} x {height} pixels, and the textures of a scene may have {} Mi together: \
                 scale them down",
                MAX_TEXTURE_PIXELS >> 20
            )));
        }
        Ok(())
    }

    fn png(&self, fit: impl Fn(usize, usize) -> Result<(), Error>) -> Result<Picture, Error> {
        let mut limits = Limits::no_limits();
        limits.max_alloc = Some(MOST_MEMORY);
        let source = Cursor::new(&self.bytes);
        let decoder =
            PngDecoder::with_limits(source, limits).map_err(|error| self.library(&error))?;
        let animated = decoder.is_apng().unwrap_or(false);
        let picture = self.still(decoder, fit)?;
        Ok(Picture {
            animated,
            ..picture
        })
    }

    fn hdr(&self, fit: impl Fn(usize, usize) -> Result<(), Error>) -> Result<Picture, Error> {
        let decoder =
            HdrDecoder::new(Cursor::new(&self.bytes)).map_err(|error| self.library(&error))?;
        self.still(decoder, fit)
    }

    /// Decodes by the image crate, whose colour types all have one number per channel.
    fn still(
        &self,
        decoder: impl ImageDecoder,
        fit: impl Fn(usize, usize) -> Result<(), Error>,
    ) -> Result<Picture, Error> {
        let (width, height) = decoder.dimensions();
        fit(width as usize, height as usize)?;
        let channels = usize::from(decoder.color_type().channel_count());
        let image = DynamicImage::from_decoder(decoder).map_err(|error| self.library(&error))?;
        let data = match image {
            DynamicImage::ImageLuma8(image) => Data::U8(image.into_raw()),
            DynamicImage::ImageLumaA8(image) => Data::U8(image.into_raw()),
            DynamicImage::ImageRgb8(image) => Data::U8(image.into_raw()),
            DynamicImage::ImageRgba8(image) => Data::U8(image.into_raw()),
            DynamicImage::ImageLuma16(image) => Data::U16(image.into_raw()),
            DynamicImage::ImageLumaA16(image) => Data::U16(image.into_raw()),
            DynamicImage::ImageRgb16(image) => Data::U16(image.into_raw()),
            DynamicImage::ImageRgba16(image) => Data::U16(image.into_raw()),
            DynamicImage::ImageRgb32F(image) => Data::F32(image.into_raw()),
            DynamicImage::ImageRgba32F(image) => Data::F32(image.into_raw()),
            _ => return Err(self.refuse("has channels of an unknown kind: save it as RGB or RGBA")),
        };
        Ok(Picture {
            width,
            height,
            channels,
            data,
            animated: false,
        })
    }

    /// A fault that the image crate found.
    fn library(&self, error: &image::ImageError) -> Error {
        match error {
            image::ImageError::Limits(_) => self.refuse(format!(
                "needs too much memory: {MAX_TEXTURE_SIDE} pixels a side are the most; scale it down"
            )),
            _ => self.damaged(error),
        }
    }

    fn jpeg(&self, fit: impl Fn(usize, usize) -> Result<(), Error>) -> Result<Picture, Error> {
        // A JPEG's sides have 16 bits: the header is read whatever they are.
        let options = DecoderOptions::default()
            .set_strict_mode(true)
            .set_max_width(usize::from(u16::MAX))
            .set_max_height(usize::from(u16::MAX));
        let mut decoder = JpegDecoder::new_with_options(ZCursor::new(&self.bytes), options);
        decoder
            .decode_headers()
            .map_err(|error| self.damaged(&error))?;
        let (width, height) = decoder.dimensions().unwrap_or_default();
        fit(width, height)?;
        let (space, channels) = match decoder.input_colorspace() {
            Some(ColorSpace::Luma) => (ColorSpace::Luma, 1),
            _ => (ColorSpace::RGB, 3),
        };
        decoder.set_options(options.jpeg_set_out_colorspace(space));
        let data = decoder.decode().map_err(|error| self.damaged(&error))?;
        if !jpeg_ends(&self.bytes) {
            return Err(self.damaged(&"it has no end marker"));
        }
        if data.len() != width * height * channels {
            return Err(self.refuse("has channels of an unknown kind: save it as RGB"));
        }
        Ok(Picture {
            width: width as u32,
            height: height as u32,
            channels,
            data: Data::U8(data),
            animated: false,
        })
    }

    fn exr(&self, fit: impl Fn(usize, usize) -> Result<(), Error>) -> Result<Picture, Error> {
        let window = self.exr_window(fit)?;
        let source = Cursor::new(&self.bytes);
        let image = exr::prelude::read()
            .no_deep_data()
            .largest_resolution_level()
            .all_channels()
            .first_valid_layer()
            .all_attributes()
            .non_parallel()
            .from_buffered(source)
            .map_err(|error| self.damaged(&error))?;
        let layer = image.layer_data;
        let find = |name: &str| {
            let mut list = layer.channel_data.list.iter();
            let channel = list.find(|channel| channel.name.eq_case_insensitive(name))?;
            Some(&channel.sample_data)
        };
        let color = [find("R"), find("G"), find("B")].into_iter().collect();
        let color: Option<Vec<&FlatSamples>> = color;
        let Some(mut channels) = color.or(find("Y").map(|grey| vec![grey])) else {
            return Err(self.refuse("has neither R, G and B nor Y: save it as an RGB picture"));
        };
        channels.extend(find("A"));
        let offset = layer.attributes.layer_position - window.position;
        let [x0, y0] = [offset.x(), offset.y()].map(i64::from);
        let (inner, outer) = (layer.size, window.size);
        let mut data = vec![0.0; outer.area() * channels.len()];
        for (number, samples) in channels.iter().enumerate() {
            for (place, value) in samples.values_as_f32().enumerate() {
                let x = x0 + (place % inner.width()) as i64;
                let y = y0 + (place / inner.width()) as i64;
                let (Ok(x), Ok(y)) = (usize::try_from(x), usize::try_from(y)) else {
                    continue;
                };
                if x < outer.width() && y < outer.height() {
                    data[(y * outer.width() + x) * channels.len() + number] = value;
                }
            }
        }
        Ok(Picture {
            width: outer.width() as u32,
            height: outer.height() as u32,
            channels: channels.len(),
            data: Data::F32(data),
            animated: false,
        })
    }

    /// Which part of the plane an EXR file shows. Refuses one whose headers would take too much
    /// memory: the decoder believes them.
    fn exr_window(
        &self,
        fit: impl Fn(usize, usize) -> Result<(), Error>,
    ) -> Result<exr::prelude::IntegerBounds, Error> {
        let meta = exr::meta::MetaData::read_from_buffered(Cursor::new(&self.bytes), false)
            .map_err(|error| self.damaged(&error))?;
        for header in &meta.headers {
            let window = header.shared_attributes.display_window;
            let tile = header.max_block_pixel_size();
            for size in [header.layer_size, window.size, tile] {
                fit(size.width(), size.height())?;
            }
            let pixel = header.channels.bytes_per_pixel as u64;
            if header.layer_size.area() as u64 * pixel > MOST_MEMORY {
                return Err(self.refuse("has too many channels: save it as an RGB picture"));
            }
        }
        let first = meta.headers.iter().find(|header| !header.deep);
        first
            .map(|header| header.shared_attributes.display_window)
            .ok_or_else(|| self.refuse("has only deep data: save it as an RGB picture"))
    }

    /// Refuses a picture that holds a NaN or an infinity.
    fn finite(&self, picture: &Picture) -> Result<(), Error> {
        let Data::F32(data) = &picture.data else {
            return Ok(());
        };
        let Some(place) = data.iter().position(|x| !x.is_finite()) else {
            return Ok(());
        };
        let (pixel, channel) = (place / picture.channels, place % picture.channels);
        let width = picture.width as usize;
        let names = match picture.channels {
            1 | 2 => ["Y", "A", "", ""],
            _ => ["R", "G", "B", "A"],
        };
        Err(self.refuse(format!(
            "channel {} of the pixel in column {}, row {} (from 0, at the top left) is {}: NaN and \
             infinity have no place",
            names[channel],
            pixel % width,
            pixel / width,
            data[place]
        )))
    }
}

/// True where a JPEG has its end marker, which the decoder does not ask for if only the last rows
/// are missing. Markers inside segments belong to small pictures in the picture.
fn jpeg_ends(bytes: &[u8]) -> bool {
    let mut at = 2;
    while let Some(&[byte, marker]) = bytes.get(at..at + 2).and_then(|two| two.first_chunk()) {
        at += match (byte, marker) {
            (0xff, 0xd9) => return true,
            // Fill bytes; a byte of 255 in the data; restarts, which have no length.
            (0xff, 0xff) => 1,
            (0xff, 0x00 | 0x01 | 0xd0..=0xd7) => 2,
            (0xff, _) => {
                let length = bytes.get(at + 2..at + 4).and_then(|two| two.first_chunk());
                2 + length.map_or(0, |&length| usize::from(u16::from_be_bytes(length)))
            }
            // The data of a scan.
            _ => 1,
        };
    }
    false
}
