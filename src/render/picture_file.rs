//! How does a picture become a file, whole or absent?

use std::io::{Cursor, Write};
use std::path::{Path, PathBuf};

use image::{ExtendedColorType, ImageEncoder, ImageError};

use super::picture::Picture;
use super::tone_mapping::{ToneMapping, srgb_codes};

/// The formats, by the ending of the file's name.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum PictureFormat {
    /// 8-bit sRGB over black, exposed and tone-mapped.
    Png,
    /// 32-bit float, linear, premultiplied alpha, cd/m^2: what was rendered, to the bit.
    Exr,
    /// Radiance RGBE, linear, cd/m^2, 8-bit mantissas.
    Hdr,
}

impl PictureFormat {
    /// Every format.
    pub const ALL: &'static [Self] = &[Self::Png, Self::Exr, Self::Hdr];

    /// The ending, without its dot.
    pub fn ending(self) -> &'static str {
        match self {
            Self::Png => "png",
            Self::Exr => "exr",
            Self::Hdr => "hdr",
        }
    }

    /// The format that a file's name asks for, in any case.
    pub fn of(path: &Path) -> Option<Self> {
        let ending = path.extension()?.to_str()?.to_lowercase();
        Self::ALL.iter().copied().find(|f| f.ending() == ending)
    }
}

/// The bytes of the file.
///
/// # Errors
/// The encoder refuses the picture: it is too large for the format.
pub fn encode(
    picture: &Picture,
    format: PictureFormat,
    ev100: f32,
    tone_mapping: ToneMapping,
) -> Result<Vec<u8>, ImageError> {
    let mut bytes = Cursor::new(Vec::new());
    let (width, height) = (picture.width, picture.height);
    match format {
        PictureFormat::Png => {
            let codes = srgb_codes(picture, ev100, tone_mapping);
            image::codecs::png::PngEncoder::new(&mut bytes).write_image(
                &codes,
                width,
                height,
                ExtendedColorType::Rgb8,
            )?;
        }
        PictureFormat::Exr => {
            let texels: &[u8] = bytemuck::cast_slice(&picture.pixels);
            image::codecs::openexr::OpenExrEncoder::new(&mut bytes).write_image(
                texels,
                width,
                height,
                ExtendedColorType::Rgba32F,
            )?;
        }
        PictureFormat::Hdr => {
            let pixels: Vec<_> = picture
                .pixels
                .iter()
                .map(|[r, g, b, _]| image::Rgb([*r, *g, *b]))
                .collect();
            image::codecs::hdr::HdrEncoder::new(&mut bytes).encode(
                &pixels,
                width as usize,
                height as usize,
            )?;
        }
    }
    Ok(bytes.into_inner())
}

/// A file that is written beside its place and renamed, so that it is whole or absent.
pub struct OutputFile {
    path: PathBuf,
    /// `None` for what cannot be renamed to: a device, a pipe.
    beside: Option<tempfile::NamedTempFile>,
}

impl OutputFile {
    /// Makes sure that the place can be written, before any work is done for it.
    ///
    /// # Errors
    /// The folder is missing or read-only, or the place is a folder.
    pub fn create(path: &Path) -> std::io::Result<Self> {
        let special = match std::fs::metadata(path) {
            Ok(found) if found.is_dir() => {
                return Err(std::io::Error::new(
                    std::io::ErrorKind::IsADirectory,
                    "it is a folder",
                ));
            }
            Ok(found) => !found.is_file(),
            Err(_) => false,
        };
        let folder = match path.parent() {
            Some(folder) if folder != Path::new("") => folder,
            _ => Path::new("."),
        };
        let beside = if special {
            None
        } else {
            Some(new_file_beside(folder)?)
        };
        Ok(Self {
            path: path.to_owned(),
            beside,
        })
    }

    /// Writes the content and puts it in its place.
    ///
    /// # Errors
    /// The disk is full, or the place has changed since.
    pub fn commit(self, bytes: &[u8]) -> std::io::Result<()> {
        let Some(mut beside) = self.beside else {
            return std::fs::OpenOptions::new()
                .write(true)
                .open(&self.path)?
                .write_all(bytes);
        };
        beside.write_all(bytes)?;
        beside.persist(&self.path)?;
        Ok(())
    }
}

fn new_file_beside(folder: &Path) -> std::io::Result<tempfile::NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".umber-");
    // A temporary file is the owner's alone by default; an output has the rights that any new file
    // gets here.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    builder.tempfile_in(folder)
}
