//! Which image files do the tests make, good and bad?

use std::io::Cursor;

use exr::prelude::{Image, SpecificChannels, WritableImage};
use image::{DynamicImage, ImageFormat, Rgb32FImage};

/// The picture as a file of the given format.
pub fn file(image: impl Into<DynamicImage>, format: ImageFormat) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    let image: DynamicImage = image.into();
    image.write_to(&mut bytes, format).expect("a written image");
    bytes.into_inner()
}

/// A colour picture of the given numbers.
pub fn floats(width: u32, pixels: &[[f32; 3]], format: ImageFormat) -> Vec<u8> {
    let height = pixels.len() as u32 / width;
    let image = Rgb32FImage::from_raw(width, height, pixels.concat()).expect("all pixels");
    file(image, format)
}

/// An EXR of one channel.
pub fn grey_exr(name: &str, value: f32) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    let channels = SpecificChannels::build()
        .with_channel(name)
        .with_pixel_fn(|_| (value,));
    let image = Image::from_channels((2, 1), channels);
    image
        .write()
        .to_buffered(&mut bytes)
        .expect("a written image");
    bytes.into_inner()
}

fn crc(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0, |crc, &byte| {
        (0..8).fold(crc ^ u32::from(byte), |crc, _| {
            (crc >> 1) ^ (0xedb8_8320 & (crc & 1).wrapping_neg())
        })
    })
}

/// A chunk of a PNG.
pub fn chunk(kind: &[u8; 4], data: &[u8]) -> Vec<u8> {
    let body = [kind, data].concat();
    let length = (data.len() as u32).to_be_bytes();
    [&length, &body[..], &crc(&body).to_be_bytes()].concat()
}

/// A PNG by hand: `header` is bit depth and colour type, `chunks` stand before the data.
pub fn png(size: [u32; 2], header: [u8; 2], chunks: &[Vec<u8>], raw: &[u8]) -> Vec<u8> {
    let (mut a, mut b) = (1_u32, 0_u32);
    for &byte in raw {
        a = (a + u32::from(byte)) % 65521;
        b = (b + a) % 65521;
    }
    let length = raw.len() as u16;
    let zlib = [
        &[0x78, 0x01, 0x01][..],
        &length.to_le_bytes(),
        &(!length).to_le_bytes(),
        raw,
        &(b << 16 | a).to_be_bytes(),
    ];
    let sides = size.map(u32::to_be_bytes).concat();
    let ihdr = [&sides[..], &header, &[0, 0, 0]].concat();
    [
        b"\x89PNG\r\n\x1a\n".to_vec(),
        chunk(b"IHDR", &ihdr),
        chunks.concat(),
        chunk(b"IDAT", &zlib.concat()),
        chunk(b"IEND", &[]),
    ]
    .concat()
}

/// A JPEG of 8 x 8 pixels of cyan, magenta, yellow and black, each 128: all coefficients are 0.
pub fn cmyk_jpeg() -> Vec<u8> {
    let segment = |marker: u8, data: &[u8]| {
        let length = (data.len() as u16 + 2).to_be_bytes();
        [&[0xff, marker], &length[..], data].concat()
    };
    let components: Vec<u8> = (1..=4).flat_map(|id| [id, 0x11, 0]).collect();
    let scans: Vec<u8> = (1..=4).flat_map(|id| [id, 0]).collect();
    // One code of one bit, for "no difference" and "end of block".
    let table = |class: u8| [&[class, 1][..], &[0; 15], &[0]].concat();
    [
        vec![0xff, 0xd8],
        segment(0xdb, &[&[0][..], &[1; 64]].concat()),
        segment(0xc0, &[&[8, 0, 8, 0, 8, 4][..], &components].concat()),
        segment(0xc4, &table(0x00)),
        segment(0xc4, &table(0x10)),
        segment(0xda, &[&[4][..], &scans, &[0, 63, 0]].concat()),
        vec![0, 0xff, 0xd9],
    ]
    .concat()
}

/// An EXR whose header claims 30000 x 30000 pixels.
pub fn exr_bomb() -> Vec<u8> {
    let mut bytes = floats(1, &[[0.5; 3]], ImageFormat::OpenExr);
    for name in [&b"dataWindow\0box2i\0"[..], b"displayWindow\0box2i\0"] {
        let place = bytes.windows(name.len()).position(|part| part == name);
        let corner = place.expect("the attribute") + name.len() + 4 + 8;
        bytes[corner..corner + 8].copy_from_slice(&[29999_i32.to_le_bytes(); 2].concat());
    }
    bytes
}
