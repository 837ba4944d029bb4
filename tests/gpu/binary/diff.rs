//! Does `umber diff` tell pictures apart, and end with the code that it promises?

use image::{ImageFormat, Rgb32FImage, RgbImage};
use serde_json::Value;

use super::{Place, Tested};

/// A picture of 8 x 8 pixels of one code, but for one.
fn png(place: &Place, name: &str, other: u8) -> image::ImageResult<()> {
    let mut picture = RgbImage::from_pixel(8, 8, image::Rgb([100, 150, 200]));
    picture.put_pixel(2, 5, image::Rgb([100, other, 200]));
    picture.save(place.path(name))
}

/// A linear picture of 8 x 8 pixels of one value, but for one.
fn floats(place: &Place, name: &str, other: f32) -> image::ImageResult<()> {
    let mut picture = Rgb32FImage::from_pixel(8, 8, image::Rgb([120.0, 240.0, 60.0]));
    picture.put_pixel(3, 1, image::Rgb([120.0, other, 60.0]));
    let format = match name.ends_with("exr") {
        true => ImageFormat::OpenExr,
        false => ImageFormat::Hdr,
    };
    picture.save_with_format(place.path(name), format)
}

fn json(place: &Place, arguments: &[&str]) -> Result<Value, Box<dyn std::error::Error>> {
    let run = place.umber(&[&["diff", "--json"], arguments].concat())?;
    Ok(serde_json::from_slice(&run.ends(0, &[]).stdout)?)
}

#[test]
fn pictures_are_told_apart_in_words_and_as_json() -> Tested {
    let place = Place::empty()?;
    png(&place, "a.png", 150)?;
    png(&place, "b.png", 157)?;
    let words = ["a.png, b.png (8 x 8)", "FLIP", "dB", "7 at column 2, row 5"];
    place.umber(&["diff", "a.png", "b.png"])?.ends(0, &words);
    place
        .umber(&["diff", "a.png", "a.png"])?
        .ends(0, &["no code differs"]);
    let report = json(&place, &["a.png", "b.png"])?;
    assert_eq!(report["schema"], "umber.diff/1");
    assert_eq!(
        (&report["width"], &report["codes"]["largest"]),
        (&8.into(), &7.0.into())
    );
    assert_eq!(report["codes"]["at"], serde_json::json!([2, 5]));
    assert_eq!(report["codes"]["mean"], 7.0 / 192.0);
    assert!(
        report["display"].is_null() && report["linear"].is_null(),
        "{report}"
    );
    let flip = report["flip"]["mean"].as_f64().ok_or("a number")?;
    assert!(flip > 0.0 && flip < 0.1, "{flip}");
    let same = json(&place, &["a.png", "a.png"])?;
    assert!(same["psnr_db"].is_null());
    assert_eq!(same["flip"]["largest"], 0.0);
    Ok(())
}

#[test]
fn every_pairing_of_formats_is_brought_to_one_space() -> Tested {
    let place = Place::new()?;
    for name in ["a.png", "a.exr", "a.hdr"] {
        place
            .render(&["scene.toml", "--size", "16x16", "-o", name])?
            .ends(0, &[]);
    }
    // The scene's exposure is 0: what was written as a PNG is what is shown.
    let report = json(&place, &["a.png", "a.exr", "--exposure", "0"])?;
    assert_eq!(
        (&report["codes"]["largest"], &report["flip"]["mean"]),
        (&0.0.into(), &0.0.into())
    );
    assert_eq!(report["display"]["tone_mapping"], "neutral");
    assert_eq!(report["display"]["chosen"], false);
    let report = json(
        &place,
        &[
            "a.exr",
            "a.png",
            "--exposure",
            "0",
            "--tone-mapping",
            "none",
        ],
    )?;
    assert!(report["codes"]["largest"].as_f64() > Some(1.0), "{report}");
    // RGBE keeps 8 bits.
    let report = json(&place, &["a.exr", "a.hdr"])?;
    assert!(
        report["linear"]["largest"].as_f64() < Some(0.05),
        "{report}"
    );
    assert_eq!(report["display"]["chosen"], true);
    for pair in [["a.png", "a.exr"], ["a.hdr", "a.png"]] {
        let run = place.umber(&[&["diff"], &pair[..]].concat())?;
        run.ends(2, &["--exposure"]);
    }
    Ok(())
}

#[test]
fn a_threshold_that_is_passed_ends_with_1() -> Tested {
    let place = Place::empty()?;
    png(&place, "a.png", 150)?;
    png(&place, "b.png", 157)?;
    let diff = |rest: &[&str]| place.umber(&[&["diff", "a.png", "b.png"], rest].concat());
    diff(&["--max-difference", "7"])?.ends(0, &[]);
    diff(&["--max-difference", "6.5"])?.ends(1, &["7 sRGB codes, more than 6.5", "row 5"]);
    diff(&["--max-flip", "0"])?.ends(1, &["the mean of FLIP is"]);
    diff(&["--max-flip", "0", "--max-difference", "0"])?.ends(1, &["FLIP is", "; the largest"]);
    diff(&["--max-flip", "1", "--json"])?.ends(0, &[]);
    place
        .umber(&[
            "diff",
            "a.png",
            "a.png",
            "--max-flip",
            "0",
            "--max-difference",
            "0",
        ])?
        .ends(0, &[]);
    floats(&place, "a.exr", 240.0)?;
    floats(&place, "b.exr", 240.5)?;
    let linear = ["diff", "a.exr", "b.exr", "--max-difference"];
    place.umber(&[&linear[..], &["0.5"]].concat())?.ends(0, &[]);
    place
        .umber(&[&linear[..], &["0.4"]].concat())?
        .ends(1, &["0.5, more than 0.4", "column 3, row 1"]);
    for wrong in ["-1", "nan", "inf", "x", ""] {
        diff(&["--max-difference", wrong])?.ends(2, &["at least 0"]);
        diff(&["--max-flip", wrong])?.ends(2, &["from 0 to 1"]);
    }
    diff(&["--max-flip", "1.5"])?.ends(2, &["from 0 to 1"]);
    Ok(())
}

#[test]
fn what_is_no_number_ends_with_5_and_its_pixel() -> Tested {
    let place = Place::empty()?;
    floats(&place, "a.exr", 240.0)?;
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        floats(&place, "bad.exr", bad)?;
        let words = ["1 pixels with a NaN or an infinity", "column 3, row 1"];
        place
            .umber(&["diff", "a.exr", "bad.exr"])?
            .ends(5, &["second", words[0], words[1]]);
        place
            .umber(&["diff", "bad.exr", "a.exr"])?
            .ends(5, &["first", words[0], words[1]]);
        let onto = ["diff", "bad.exr", "bad.exr", "-o", "map.png"];
        place.umber(&onto)?.ends(5, &words);
    }
    assert!(!place.path("map.png").exists());
    Ok(())
}

#[test]
fn what_cannot_be_compared_is_refused() -> Tested {
    let place = Place::empty()?;
    png(&place, "a.png", 150)?;
    RgbImage::new(8, 9).save(place.path("tall.png"))?;
    place.write("text.png", "no picture")?;
    place.write("empty.exr", "")?;
    let whole = std::fs::read(place.path("a.png"))?;
    std::fs::write(place.path("cut.png"), &whole[..whole.len() - 20])?;
    let diff = |rest: &[&str]| place.umber(&[&["diff"], rest].concat());
    diff(&["a.png", "tall.png"])?.ends(1, &["a.png, tall.png", "8 x 8", "8 x 9"]);
    diff(&["a.png", "text.png"])?.ends(6, &["text.png", "no picture of a known kind"]);
    diff(&["empty.exr", "a.png"])?.ends(6, &["empty.exr", "is empty"]);
    diff(&["a.png", "cut.png"])?.ends(6, &["cut.png", "damaged or cut short"]);
    diff(&["a.png", "none.png"])?.ends(6, &["none.png: there is no such file"]);
    diff(&["a.png", "."])?.ends(6, &["is a folder"]);
    diff(&["a.png"])?.ends(2, &["Usage"]);
    Ok(())
}

#[test]
fn the_map_shows_where_and_overwrites_nothing() -> Tested {
    let place = Place::empty()?;
    png(&place, "a.png", 150)?;
    png(&place, "b.png", 255)?;
    let diff = |rest: &[&str]| place.umber(&[&["diff", "a.png", "b.png"], rest].concat());
    diff(&["-o", "map.png"])?.ends(0, &[]);
    let map = image::open(place.path("map.png"))?.into_rgb8();
    assert_eq!(map.dimensions(), (8, 8));
    let red = |x, y| map.get_pixel(x, y).0[0];
    assert!(
        red(2, 5) > 100 && red(2, 5) > red(7, 0),
        "{} {}",
        red(2, 5),
        red(7, 0)
    );
    let cases: &[(&[&str], &str)] = &[
        (&["-o", "a.png"], "overwritten"),
        (&["-o", "./b.png"], "overwritten"),
        (&["--json=a.png"], "overwritten"),
        (&["-o", "map.png", "--json=map.png"], "same place"),
        (&["-o", "map.exr"], ".png"),
        (&["-o", "-"], ".png"),
    ];
    for (arguments, expected) in cases {
        diff(arguments)?.ends(2, &[expected]);
    }
    diff(&["-o", "none/map.png"])?.ends(6, &["none/map.png"]);
    assert_eq!(place.names()?, ["a.png", "b.png", "map.png"]);
    Ok(())
}
