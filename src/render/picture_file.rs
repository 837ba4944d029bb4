//! How does a picture become a file, whole or absent?

use std::io::{self, Cursor, Write};
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
    /// Radiance RGBE, linear, cd/m^2, 8-bit mantissas and no sign: a NaN or a negative value becomes 0,
    /// and an infinity the largest number there is.
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
                .map(|[r, g, b, _]| image::Rgb([r, g, b].map(|value| rgbe_range(*value))))
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

/// What RGBE can hold. Its exponent has 8 bits with a bias of 128 for a mantissa in [0.5, 1): the largest
/// power that still fits is 2^127, and below 2^-127 there is only 0.
fn rgbe_range(value: f32) -> f32 {
    // 255/256 of 2^127: the largest 8-bit mantissa of the largest exponent.
    const LARGEST: f32 = 1.694_881_9e38;
    if value.is_nan() || value < f32::MIN_POSITIVE {
        return 0.0;
    }
    value.min(LARGEST)
}

/// A file that is written beside its place and renamed, so that it is whole or absent.
pub struct OutputFile {
    /// Where it goes; a link is followed to what it points at.
    path: PathBuf,
    /// A device or a pipe cannot be renamed to, and is written as it is.
    is_special: bool,
}

impl OutputFile {
    /// Makes sure that the place can be written, before any work is done for it. Leaves nothing there.
    ///
    /// # Errors
    /// The folder is missing or read-only, or the place is a folder or a read-only file.
    pub fn create(path: &Path) -> io::Result<Self> {
        let path = path.canonicalize().unwrap_or_else(|_| path.to_owned());
        let found = std::fs::metadata(&path).ok();
        let is_special = match &found {
            Some(found) if found.is_dir() => return Err(io::ErrorKind::IsADirectory.into()),
            Some(found) if found.permissions().readonly() => {
                return Err(io::Error::new(
                    io::ErrorKind::PermissionDenied,
                    "the file is read-only",
                ));
            }
            Some(found) => !found.is_file(),
            None => false,
        };
        let output = Self { path, is_special };
        if !is_special {
            output.beside()?;
        }
        Ok(output)
    }

    /// Whether two outputs, or an output and an input, are one file.
    pub fn is(&self, other: &Path) -> bool {
        let other = other.canonicalize().unwrap_or_else(|_| other.to_owned());
        !self.is_special && self.path == other
    }

    /// Writes the content and puts it in its place.
    ///
    /// # Errors
    /// The disk is full, or the place has changed since.
    pub fn commit(self, bytes: &[u8]) -> io::Result<()> {
        if self.is_special {
            let mut file = std::fs::OpenOptions::new().write(true).open(&self.path)?;
            return file.write_all(bytes);
        }
        let mut beside = self.beside()?;
        beside.write_all(bytes)?;
        // On the disk before the name points at it: whole or absent holds for a power cut too.
        beside.as_file().sync_all()?;
        beside.persist(&self.path)?;
        Ok(())
    }

    /// A file in the same folder, which goes when it is dropped. Errors name no temporary file.
    fn beside(&self) -> io::Result<tempfile::NamedTempFile> {
        let folder = match self.path.parent() {
            Some(folder) if folder != Path::new("") => folder,
            _ => Path::new("."),
        };
        let mut builder = tempfile::Builder::new();
        builder.prefix(".umber-");
        // A temporary file is the owner's alone by default; an output has the rights that any new
        // file gets here.
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
        builder
            .tempfile_in(folder)
            .map_err(|error| match error.kind() {
                io::ErrorKind::NotFound => io::Error::new(error.kind(), "there is no such folder"),
                io::ErrorKind::PermissionDenied => {
                    io::Error::new(error.kind(), "the folder may not be written to")
                }
                kind => kind.into(),
            })
    }
}
