//! Does an image file become the numbers that it means, and is each bad one refused by name?

use std::fs;

use image::{
    GrayAlphaImage, GrayImage, ImageBuffer, ImageFormat, Luma, LumaA, Rgb, RgbImage, Rgba,
    RgbaImage,
};
use proptest::prelude::*;
use tempfile::TempDir;
use umber::scene::{
    self, LoadOptions, MAX_TEXEL_EMISSION, MAX_TEXTURE_SIDE, MAX_TEXTURES, Scene, Slot, Texture,
};

use crate::mutation;
use crate::tolerances::{JPEG_CODES, TEXEL};

#[path = "textures/files.rs"]
pub mod files;

use ImageFormat::{Hdr, Jpeg, OpenExr, Png};
use files::{chunk, cmyk_jpeg, exr_bomb, file, floats, grey_exr, png};

/// A cube of material `m` with the given lines, beside the given files.
pub fn load(list: &[(&str, &[u8])], lines: &str) -> (TempDir, Result<Scene, scene::Error>) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for (name, bytes) in list {
        fs::write(folder.path().join(name), bytes).expect("a written file");
    }
    let path = folder.path().join("scene.toml");
    let text = format!("[material.m]\n{lines}\n[model.box]\nshape = \"cube\"\nmaterial = \"m\"\n");
    fs::write(&path, text).expect("a written file");
    let scene = scene::load(&path, &LoadOptions::default());
    (folder, scene)
}

/// The only texture that `value` after `key` gives, and the warnings.
fn texture(bytes: &[u8], key: &str, value: &str) -> (Texture, Vec<String>) {
    let (_folder, scene) = load(&[("a.img", bytes)], &format!("{key} = {value}"));
    let mut scene = scene.expect("a good picture");
    assert_eq!(scene.textures.len(), 1);
    (scene.textures.remove(0), scene.warnings)
}

fn plain(bytes: &[u8], key: &str) -> Texture {
    let (texture, warnings) = texture(bytes, key, "\"a.img\"");
    assert!(warnings.is_empty(), "{warnings:?}");
    texture
}

fn message(bytes: &[u8], lines: &str) -> String {
    let (_folder, scene) = load(&[("a.img", bytes)], lines);
    let error = scene.map(drop).expect_err("a bad picture");
    assert_eq!(error.exit_code(), 6, "{error}");
    error.to_string()
}

fn close(found: [f32; 4], wanted: [f64; 3]) {
    for (found, wanted) in found.into_iter().zip(wanted) {
        assert!(
            (f64::from(found) - wanted).abs() < TEXEL,
            "{found} for {wanted}"
        );
    }
    assert_eq!(found[3], 1.0);
}

/// The sRGB curve, in f64.
fn linear(code: f64) -> f64 {
    if code <= 0.04045 {
        code / 12.92
    } else {
        ((code + 0.055) / 1.055).powf(2.4)
    }
}

#[test]
fn integers_are_srgb_where_they_are_colours_and_linear_elsewhere() {
    let bytes = file(RgbImage::from_pixel(2, 1, Rgb([188, 55, 5])), Png);
    let colour = [188.0, 55.0, 5.0].map(|x: f64| linear(x / 255.0));
    close(plain(&bytes, "base_color_map").texel(1, 0), colour);
    close(plain(&bytes, "emission_map").texel(0, 0), colour);
    let stored = 0.2126 * 188.0 + 0.7152 * 55.0 + 0.0722 * 5.0;
    for key in [
        "roughness_map",
        "metalness_map",
        "occlusion_map",
        "alpha_mask",
    ] {
        // Kept with 16 bits.
        let found = f64::from(plain(&bytes, key).texel(0, 0)[1]);
        assert!(
            (found - stored / 255.0).abs() < 0.5 / 65535.0 + TEXEL,
            "{key}: {found}"
        );
    }
    let deep: ImageBuffer<Rgb<u16>, _> = ImageBuffer::from_pixel(1, 1, Rgb([40_000, 1, 65_535]));
    let colour = [40_000.0, 1.0, 65_535.0].map(|x: f64| linear(x / 65_535.0));
    close(
        plain(&file(deep, Png), "base_color_map").texel(0, 0),
        colour,
    );
}

#[test]
fn a_jpeg_keeps_its_colour() {
    let bytes = file(RgbImage::from_pixel(16, 16, Rgb([188, 55, 5])), Jpeg);
    let texel = plain(&bytes, "base_color_map").texel(7, 7);
    for (found, code) in texel.into_iter().zip([188.0, 55.0, 5.0]) {
        let bounds = [code - JPEG_CODES, code + JPEG_CODES].map(|code| linear(code / 255.0));
        assert!(
            (bounds[0]..=bounds[1]).contains(&f64::from(found)),
            "{found} for {code}"
        );
    }
}

#[test]
fn too_many_textures_and_too_large_files_are_refused() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let picture = file(RgbaImage::from_pixel(1, 1, Rgba([9; 4])), Png);
    let slots = [
        "roughness_map",
        "metalness_map",
        "occlusion_map",
        "alpha_mask",
    ];
    let mut text = String::new();
    for number in 0..=MAX_TEXTURES / slots.len() {
        let (name, channel) = (number / 4, ["r", "g", "b", "a"][number % 4]);
        fs::write(folder.path().join(format!("{name}.png")), &picture).expect("a written file");
        text.push_str(&format!("[material.m{number}]\n"));
        for slot in slots {
            text.push_str(&format!(
                "{slot} = {{ file = \"{name}.png\", channel = \"{channel}\" }}\n"
            ));
        }
        text.push_str(&format!(
            "[model.m{number}]\nshape = \"plane\"\nmaterial = \"m{number}\"\n"
        ));
    }
    let path = folder.path().join("scene.toml");
    fs::write(&path, text).expect("a written file");
    let error = scene::load(&path, &LoadOptions::default()).map(drop);
    let error = error.expect_err("too many").to_string();
    assert!(
        error.contains("more than 4096 textures: use fewer pictures"),
        "{error}"
    );

    let large = fs::File::create(folder.path().join("a.png")).expect("a file");
    large.set_len((256 << 20) + 1).expect("a file with a hole");
    let text =
        "[material.m]\nroughness_map = \"a.png\"\n[model.a]\nshape = \"plane\"\nmaterial = \"m\"\n";
    fs::write(&path, text).expect("a written file");
    let error = scene::load(&path, &LoadOptions::default()).map(drop);
    let error = error.expect_err("too large").to_string();
    assert!(error.contains("a.png: is larger than 256 MiB"), "{error}");
}

#[test]
fn floats_are_linear_everywhere() {
    for format in [Hdr, OpenExr] {
        let bytes = floats(1, &[[0.5, 0.25, 0.125]], format);
        close(
            plain(&bytes, "base_color_map").texel(0, 0),
            [0.5, 0.25, 0.125],
        );
        let bytes = floats(1, &[[64.0, 2.0, 0.5]], format);
        close(plain(&bytes, "emission_map").texel(0, 0), [64.0, 2.0, 0.5]);
    }
    close(
        plain(&grey_exr("Y", 0.375), "roughness_map").texel(1, 0),
        [0.375; 3],
    );
}

#[test]
fn rows_begin_at_the_top() {
    let mut image = GrayImage::new(2, 3);
    image.put_pixel(1, 0, Luma([255]));
    for bytes in [file(image.clone(), Png), file(image, Jpeg)] {
        let texture = plain(&bytes, "roughness_map");
        assert_eq!((texture.width(), texture.height()), (2, 3));
        assert!(texture.texel(1, 0)[0] > 0.9 && texture.texel(1, 2)[0] < 0.1);
        assert_eq!(texture.texel(9, 9), texture.texel(1, 2), "beyond the edge");
        assert_eq!((texture.name(), texture.slot()), ("a.img", Slot::Roughness));
    }
}

#[test]
fn every_layout_of_png_is_read() {
    let grey_alpha = GrayAlphaImage::from_pixel(1, 1, LumaA([51, 102]));
    close(
        plain(&file(grey_alpha.clone(), Png), "roughness_map").texel(0, 0),
        [0.2; 3],
    );
    close(
        plain(&file(grey_alpha, Png), "alpha_mask").texel(0, 0),
        [0.4; 3],
    );
    let deep: ImageBuffer<LumaA<u16>, _> = ImageBuffer::from_pixel(1, 1, LumaA([13_107, 9]));
    close(
        plain(&file(deep, Png), "roughness_map").texel(0, 0),
        [0.2; 3],
    );
    // Two entries of a palette, two bits each; the second is translucent.
    let palette = [
        chunk(b"PLTE", &[255, 0, 0, 0, 255, 0]),
        chunk(b"tRNS", &[255, 51]),
    ];
    let bytes = png([2, 1], [2, 3], &palette, &[0, 0b0001_0000]);
    let color = plain(&bytes, "base_color_map");
    close(color.texel(0, 0), [1.0, 0.0, 0.0]);
    close(color.texel(1, 0), [0.0, 1.0, 0.0]);
    close(plain(&bytes, "alpha_mask").texel(1, 0), [0.2; 3]);
}

#[test]
fn a_channel_is_picked_by_name_and_alpha_only_where_it_says_something() {
    let image = RgbaImage::from_pixel(1, 1, Rgba([51, 102, 153, 204]));
    let bytes = file(image, Png);
    for (channel, wanted) in [("r", 0.2), ("g", 0.4), ("b", 0.6), ("a", 0.8)] {
        let value = format!("{{ file = \"a.img\", channel = \"{channel}\" }}");
        let (texture, _) = texture(&bytes, "roughness_map", &value);
        close(texture.texel(0, 0), [wanted; 3]);
    }
    close(plain(&bytes, "alpha_mask").texel(0, 0), [0.8; 3]);
    let opaque = file(RgbaImage::from_pixel(1, 1, Rgba([51, 51, 51, 255])), Png);
    close(plain(&opaque, "alpha_mask").texel(0, 0), [0.2; 3]);
}

#[test]
fn cmyk_is_converted_and_an_animation_stands_still() {
    // As Adobe writes it: 128 x 128 / 255 in each channel.
    close(
        plain(&cmyk_jpeg(), "base_color_map").texel(0, 0),
        [linear(64.0 / 255.0); 3],
    );
    let control = chunk(b"acTL", &[0, 0, 0, 1, 0, 0, 0, 0]);
    let bytes = png([1, 1], [8, 0], &[control], &[0, 51]);
    let (texture, warnings) = texture(&bytes, "roughness_map", "\"a.img\"");
    close(texture.texel(0, 0), [0.2; 3]);
    assert!(
        warnings[0].ends_with("a.img: is animated: its still picture is taken"),
        "{warnings:?}"
    );
}

#[test]
fn normals_are_unit_vectors_that_point_out() {
    let pixels = [[128, 128, 255], [255, 128, 128], [0, 0, 0], [128, 128, 0]];
    let image = RgbImage::from_fn(4, 1, |x, _| Rgb(pixels[x as usize]));
    let (texture, warnings) = texture(&file(image, Png), "normal_map", "\"a.img\"");
    assert!(
        warnings.is_empty(),
        "half of them are normals: {warnings:?}"
    );
    for x in 0..4 {
        let [a, b, c, _] = texture.texel(x, 0).map(f64::from);
        assert!(
            (a * a + b * b + c * c - 1.0).abs() < TEXEL && c >= 0.0,
            "{a} {b} {c}"
        );
    }
    assert!(texture.texel(0, 0)[2] > 0.9999 && texture.texel(1, 0)[0] > 0.9999);
    close(texture.texel(2, 0), [-0.5_f64.sqrt(), -0.5_f64.sqrt(), 0.0]);
    let zero = floats(1, &[[0.5, 0.5, 0.5], [0.5, 0.5, 0.0]], OpenExr);
    let (texture, _) = self::texture(&zero, "normal_map", "\"a.img\"");
    close(texture.texel(0, 0), [0.0, 0.0, 1.0]);
    close(texture.texel(0, 1), [0.0, 0.0, 1.0]);
}

#[test]
fn another_picture_in_place_of_normals_is_told_of() {
    let wood = file(RgbImage::from_pixel(4, 4, Rgb([120, 80, 40])), Png);
    let (_, warnings) = texture(&wood, "normal_map", "\"a.img\"");
    assert_eq!(warnings.len(), 1);
    assert!(
        warnings[0].contains("a.img: is used as a normal map"),
        "{warnings:?}"
    );
}

#[test]
fn numbers_out_of_range_are_clamped_with_one_warning() {
    let bytes = floats(2, &[[2.0, -1.0, 0.5], [-0.5, 0.5, 0.5]], OpenExr);
    let (texture, warnings) = texture(&bytes, "base_color_map", "\"a.img\"");
    close(texture.texel(0, 0), [1.0, 0.0, 0.5]);
    assert_eq!(warnings.len(), 1);
    let wanted = "a.img: 3 numbers of the base colour map lie outside 0 to 1 and are clamped";
    assert!(warnings[0].ends_with(wanted), "{warnings:?}");
    let bytes = floats(1, &[[1e30, 1.0, 1.0]], OpenExr);
    let (texture, _) = self::texture(&bytes, "emission_map", "\"a.img\"");
    assert_eq!(texture.texel(0, 0)[0], MAX_TEXEL_EMISSION);
}

#[test]
fn bad_pictures_are_refused_by_name() {
    let line = "base_color_map = \"a.img\"";
    let nan = floats(2, &[[1.0; 3], [1.0, f32::NAN, 1.0]], OpenExr);
    let infinite = floats(1, &[[f32::INFINITY, 1.0, 1.0]], OpenExr);
    let header = |width, height| png([width, height], [8, 2], &[], &[0]);
    let hdr = |sides: &str| format!("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n{sides}\n").into_bytes();
    for (bytes, wanted) in [
        (
            nan,
            "a.img: channel G of the pixel in column 1, row 0 (from 0, at the top left) is NaN",
        ),
        (
            infinite,
            "a.img: channel R of the pixel in column 0, row 0 (from 0, at the top left) is inf",
        ),
        (
            header(16_384, 1),
            "a.img: has 16384 x 1 pixels: 8192 a side are the most",
        ),
        (
            header(1, 8_193),
            "a.img: has 1 x 8193 pixels: 8192 a side are the most",
        ),
        (
            header(30_000, 30_000),
            "a.img: has 30000 x 30000 pixels: 8192 a side",
        ),
        (
            header(2_147_483_647, 2_147_483_647),
            "a.img: needs too much memory: 8192 pixels a side",
        ),
        (header(0, 5), "a.img: is damaged or cut short"),
        (header(5, 5), "a.img: is damaged or cut short"),
        (hdr("-Y 0 +X 5"), "a.img: has no pixels (5 x 0)"),
        (
            hdr("-Y 9000 +X 9000"),
            "a.img: has 9000 x 9000 pixels: 8192 a side",
        ),
        (hdr("-Y 5 +X 5"), "a.img: is damaged or cut short"),
        (exr_bomb(), "a.img: has 30000 x 30000 pixels: 8192 a side"),
        (grey_exr("Z", 1.0), "a.img: has neither R, G and B nor Y"),
        (
            Vec::new(),
            "'a.img' is empty: save it as PNG, JPEG, HDR or EXR",
        ),
        (
            b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n".to_vec(),
            "'a.img' is no picture of a known kind",
        ),
        (
            b"GIF89a\x01\0\x01\0\0\0\0".to_vec(),
            "'a.img' is a picture of the kind Gif",
        ),
    ] {
        let found = message(&bytes, line);
        assert!(found.contains(wanted), "{found}\n  wanted {wanted}");
    }
}

#[test]
fn a_picture_that_is_cut_short_is_refused_wherever_it_ends() {
    let noise = |x: u32, y: u32| Rgb([(x * 37 % 256) as u8, (y * 91 % 256) as u8, (x * y) as u8]);
    let image = RgbImage::from_fn(24, 24, noise);
    let float: Vec<[f32; 3]> = image
        .pixels()
        .map(|p| p.0.map(|x| f32::from(x) / 255.0))
        .collect();
    // A small picture in the picture has an end marker of its own.
    let jpeg = file(image.clone(), Jpeg);
    let small = [&jpeg[..2], &[0xff, 0xe1, 0, 4, 0xff, 0xd9], &jpeg[2..]].concat();
    plain(&small, "base_color_map");
    for (format, bytes, needless) in [
        (Jpeg, jpeg, 0),
        (Jpeg, small, 0),
        // The last chunk holds nothing.
        (Png, file(image, Png), 12),
        (Hdr, floats(24, &float, Hdr), 0),
        (OpenExr, floats(24, &float, OpenExr), 0),
    ] {
        let last = bytes.len() - needless;
        // All of the end, where a decoder may believe that it has seen everything.
        for length in (1..last).filter(|length| length % 13 == 0 || length + 90 > last) {
            let (_folder, scene) =
                load(&[("a.img", &bytes[..length])], "base_color_map = \"a.img\"");
            assert!(
                scene.is_err(),
                "{format:?} cut to {length} of {}",
                bytes.len()
            );
        }
    }
}

#[test]
fn all_textures_together_are_bounded() {
    let small = file(GrayImage::new(1, 1), Png);
    let large = png([8192, 8192], [8, 0], &[], &[0]);
    let lines = "base_color_map = \"a.png\"\nroughness_map = \"b.png\"";
    let (_folder, scene) = load(&[("a.png", &small), ("b.png", &large)], lines);
    let error = scene.map(drop).expect_err("too much").to_string();
    let wanted =
        "b.png: has 8192 x 8192 pixels, and the textures of a scene may have 64 Mi together";
    assert!(error.contains(wanted), "{error}");
}

#[test]
fn made_textures_keep_their_promises() {
    let made = |slot, texel: [f32; 4]| Texture::from_linear("made", slot, 1, 1, &[texel]);
    let texel = |slot, numbers| made(slot, numbers).expect("a texture").texel(0, 0);
    assert_eq!(
        texel(Slot::BaseColor, [0.5, 2.0, -1.0, 0.3]),
        [0.5, 1.0, 0.0, 1.0]
    );
    assert_eq!(
        texel(Slot::Emission, [5.0, 1e9, 0.0, 1.0]),
        [5.0, MAX_TEXEL_EMISSION, 0.0, 1.0]
    );
    assert_eq!(
        texel(Slot::Normal, [0.0, 3.0, 0.0, 1.0]),
        [0.0, 1.0, 0.0, 1.0]
    );
    assert_eq!(
        texel(Slot::Normal, [0.0, 0.0, -1.0, 1.0]),
        [0.0, 0.0, 1.0, 1.0]
    );
    assert_eq!(
        texel(Slot::Roughness, [0.25, 0.5, 0.5, 1.0]),
        [0.25, 0.25, 0.25, 1.0]
    );
    assert!(made(Slot::Roughness, [f32::NAN; 4]).is_none());
    let sized =
        |w, h, n: usize| Texture::from_linear("x", Slot::Occlusion, w, h, &vec![[0.0; 4]; n]);
    assert!(sized(2, 3, 6).is_some() && sized(2, 3, 5).is_none());
    assert!(sized(0, 3, 0).is_none() && sized(MAX_TEXTURE_SIDE + 1, 1, 8193).is_none());
}

/// Loads the bytes into every kind of slot; whatever they are, there is a scene or a message.
fn survives(bytes: &[u8]) -> Result<(), TestCaseError> {
    let lines = "base_color_map = \"a.img\"\nnormal_map = \"a.img\"\nalpha_mask = \"a.img\"\n";
    let (_folder, scene) = load(&[("a.img", bytes)], lines);
    match scene {
        Err(error) => prop_assert!(error.to_string().contains("a.img"), "{}", error),
        Ok(scene) => {
            for texture in &scene.textures {
                let texel = texture.texel(0, 0);
                prop_assert!(texel.iter().all(|x| x.abs() <= 1.0), "{:?}", texel);
            }
        }
    }
    Ok(())
}

fn sample() -> RgbImage {
    RgbImage::from_fn(9, 5, |x, y| Rgb([(x * 20) as u8, (y * 40) as u8, 128]))
}

fn sample_floats(format: ImageFormat) -> Vec<u8> {
    let pixels: Vec<[f32; 3]> = sample()
        .pixels()
        .map(|p| p.0.map(|x| f32::from(x) / 255.0))
        .collect();
    floats(9, &pixels, format)
}

proptest! {
    #![proptest_config(mutation::cases(500))]

    #[test]
    fn mutated_png_never_panics(bytes in mutation::mutated(file(sample(), Png), b"\0\xff\x01I")) {
        survives(&bytes)?;
    }

    #[test]
    fn mutated_jpeg_never_panics(bytes in mutation::mutated(file(sample(), Jpeg), b"\0\xff\xd8\xda")) {
        survives(&bytes)?;
    }

    #[test]
    fn mutated_hdr_never_panics(bytes in mutation::mutated(sample_floats(Hdr), b"\0\xff\x02-9\n")) {
        survives(&bytes)?;
    }

    #[test]
    fn mutated_exr_never_panics(bytes in mutation::mutated(sample_floats(OpenExr), b"\0\xff\x01\x7f")) {
        survives(&bytes)?;
    }
}
