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

/// The one name of a place, whatever the user calls it: links are followed, and of a file that is not
/// there yet the folder is.
fn place(path: &Path) -> io::Result<PathBuf> {
    if let Ok(known) = path.canonicalize() {
        return Ok(known);
    }
    if path.is_symlink() {
        let message = "it is a link that points to nothing";
        return Err(io::Error::new(io::ErrorKind::NotFound, message));
    }
    let name = path.file_name().ok_or(io::ErrorKind::InvalidFilename)?;
    let folder = folder_of(path)
        .canonicalize()
        .map_err(|error| match error.kind() {
            io::ErrorKind::NotFound => io::Error::new(error.kind(), "there is no such folder"),
            _ => error,
        })?;
    Ok(folder.join(name))
}

fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    }
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
        let path = place(path)?;
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
        !self.is_special && place(other).is_ok_and(|other| other == self.path)
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
        let mut builder = tempfile::Builder::new();
        builder.prefix(".umber-");
        // A temporary file is the owner's alone by default; an output has the rights that any new
        // file gets here.
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
        builder
            .tempfile_in(folder_of(&self.path))
            .map_err(|error| match error.kind() {
                io::ErrorKind::NotFound => io::Error::new(error.kind(), "there is no such folder"),
                io::ErrorKind::PermissionDenied => {
                    io::Error::new(error.kind(), "the folder may not be written to")
                }
                kind => kind.into(),
            })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    type Tested = Result<(), Box<dyn std::error::Error>>;

    /// One row of pixels.
    fn row(pixels: &[[f32; 4]]) -> Picture {
        Picture {
            width: pixels.len() as u32,
            height: 1,
            pixels: pixels.to_vec(),
        }
    }

    const ODD: [[f32; 4]; 4] = [
        [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1.0],
        [f32::MAX, f32::MIN_POSITIVE, -1.0, 0.5],
        [1e-45, -0.0, f32::MIN, 0.0],
        [1.0, 0.25, 3e38, 1.0],
    ];

    fn encoded(format: PictureFormat) -> image::ImageResult<Vec<u8>> {
        encode(&row(&ODD), format, 0.0, ToneMapping::Neutral)
    }

    #[test]
    fn an_exr_keeps_every_bit() -> Tested {
        let bytes = encoded(PictureFormat::Exr)?;
        let read = image::load_from_memory(&bytes)?.to_rgba32f().into_raw();
        let bits = |values: &[f32]| values.iter().map(|v| v.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(&read), bits(ODD.as_flattened()));
        Ok(())
    }

    #[test]
    fn an_hdr_holds_what_rgbe_can_and_nothing_else() -> Tested {
        let bytes = encoded(PictureFormat::Hdr)?;
        let read = image::load_from_memory(&bytes)?.to_rgb32f().into_raw();
        // The largest number is 255/256 of 2^127; a pixel's three channels share its exponent.
        let largest = 255.0 / 256.0 * 127_f32.exp2();
        let want = [
            0.0, largest, 0.0, largest, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, largest,
        ];
        for (got, want) in read.iter().zip(want) {
            let near = (got - want).abs() <= want / 100.0;
            assert!(near, "{got:e} for {want:e}: {read:?}");
        }
        assert_eq!(read.len(), want.len());
        Ok(())
    }

    #[test]
    fn a_png_takes_any_value() -> Tested {
        let read = image::load_from_memory(&encoded(PictureFormat::Png)?)?.to_rgb8();
        // A NaN, and an infinity, whose glare makes the third channel white as well.
        assert_eq!(read.get_pixel(0, 0).0, [0, 255, 255]);
        assert_eq!(read.dimensions(), (4, 1));
        Ok(())
    }

    #[test]
    fn the_ending_names_the_format_in_any_case() {
        for (name, format) in [
            ("a.png", Some(PictureFormat::Png)),
            ("x/a.b.EXR", Some(PictureFormat::Exr)),
            ("a.Hdr", Some(PictureFormat::Hdr)),
            ("a.jpg", None),
            ("png", None),
            (".png", None),
            ("a.png/", Some(PictureFormat::Png)),
            ("", None),
        ] {
            assert_eq!(PictureFormat::of(Path::new(name)), format, "{name}");
        }
    }

    fn names(folder: &Path) -> io::Result<Vec<std::ffi::OsString>> {
        let mut names = std::fs::read_dir(folder)?
            .map(|entry| entry.map(|entry| entry.file_name()))
            .collect::<io::Result<Vec<_>>>()?;
        names.sort();
        Ok(names)
    }

    #[test]
    fn a_file_is_absent_until_it_is_whole() -> Tested {
        let folder = tempfile::tempdir()?;
        let path = folder.path().join("a.png");
        let output = OutputFile::create(&path)?;
        assert!(names(folder.path())?.is_empty(), "the place was only tried");
        drop(output);
        assert!(names(folder.path())?.is_empty());
        OutputFile::create(&path)?.commit(b"one")?;
        assert_eq!(std::fs::read(&path)?, b"one");
        let output = OutputFile::create(&path)?;
        assert_eq!(
            std::fs::read(&path)?,
            b"one",
            "the old one stays until then"
        );
        output.commit(b"another")?;
        assert_eq!(std::fs::read(&path)?, b"another");
        assert_eq!(names(folder.path())?, ["a.png"]);
        Ok(())
    }

    #[test]
    fn a_place_that_went_away_is_an_error_and_leaves_nothing() -> Tested {
        let root = tempfile::tempdir()?;
        let folder = root.path().join("sub");
        std::fs::create_dir(&folder)?;
        let output = OutputFile::create(&folder.join("a.png"))?;
        std::fs::remove_dir(&folder)?;
        let error = output.commit(b"text").expect_err("the folder is gone");
        assert!(!error.to_string().contains(".umber-"), "{error}");
        let output = OutputFile::create(&root.path().join("b.png"))?;
        std::fs::create_dir(root.path().join("b.png"))?;
        let error = output
            .commit(b"text")
            .expect_err("a folder has taken its place");
        assert!(!error.to_string().contains(".umber-"), "{error}");
        assert_eq!(names(root.path())?, ["b.png"]);
        Ok(())
    }

    #[test]
    fn a_place_that_cannot_be_written_is_refused_at_once() -> Tested {
        let folder = tempfile::tempdir()?;
        let refused = |path: &Path| OutputFile::create(path).err().map(|error| error.kind());
        assert_eq!(refused(folder.path()), Some(io::ErrorKind::IsADirectory));
        let missing = folder.path().join("missing").join("a.png");
        assert_eq!(refused(&missing), Some(io::ErrorKind::NotFound));
        let path = folder.path().join("a.png");
        std::fs::write(&path, "precious")?;
        let mut rights = std::fs::metadata(&path)?.permissions();
        rights.set_readonly(true);
        std::fs::set_permissions(&path, rights)?;
        assert_eq!(refused(&path), Some(io::ErrorKind::PermissionDenied));
        assert_eq!(std::fs::read(&path)?, b"precious");
        assert_eq!(names(folder.path())?, ["a.png"]);
        Ok(())
    }

    #[test]
    #[cfg(unix)]
    fn a_link_is_followed_and_one_file_is_known_by_all_its_names() -> Tested {
        let folder = tempfile::tempdir()?;
        let at = |name: &str| folder.path().join(name);
        std::fs::create_dir(at("there"))?;
        std::fs::write(at("there/real"), "old")?;
        std::os::unix::fs::symlink("there/real", at("link"))?;
        let output = OutputFile::create(&at("link"))?;
        for same in ["link", "there/real", "there/../link"] {
            assert!(output.is(&at(same)), "{same}");
        }
        assert!(!output.is(&at("there/other")));
        output.commit(b"new")?;
        assert!(std::fs::symlink_metadata(at("link"))?.is_symlink());
        assert_eq!(std::fs::read(at("there/real"))?, b"new");
        assert_eq!(names(&at("there"))?, ["real"]);
        Ok(())
    }

    #[test]
    fn a_file_that_is_not_there_yet_is_known_by_all_its_names() -> Tested {
        let folder = tempfile::tempdir()?;
        std::fs::create_dir(folder.path().join("sub"))?;
        let output = OutputFile::create(&folder.path().join("a.png"))?;
        for same in ["a.png", "./a.png", "sub/../a.png"] {
            assert!(output.is(&folder.path().join(same)), "{same}");
        }
        assert!(!output.is(&folder.path().join("sub/a.png")));
        Ok(())
    }

    #[test]
    #[cfg(target_os = "linux")]
    fn a_device_is_written_to_as_it_is() -> Tested {
        OutputFile::create(Path::new("/dev/null"))?.commit(b"text")?;
        let full = OutputFile::create(Path::new("/dev/full"))?.commit(b"text");
        assert_eq!(full.map_err(|e| e.kind()), Err(io::ErrorKind::StorageFull));
        Ok(())
    }
}
