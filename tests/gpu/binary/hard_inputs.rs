//! Is a picture finite whatever its materials, textures, normals and lamps hold, and is what was passed over told by name?

use std::io::Cursor;

use image::{ImageFormat, Rgb, Rgb32FImage};

use super::{Place, SQUARE, Tested};

/// Two triangles whose corners have no normal, one with a normal along them, and one without an area.
const OBJ: &str = "v -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nvn 0 0 0\nvn 1 0 0\n\
                   f 1//1 3//1 2//1\nf 1//2 4//2 3//1\nf 1//1 1//1 1//1\n";

/// Lamps: without light, the brightest, on the surface, and of no size that could be seen.
const LAMPS: &str = r#"
[light.dark]
kind = "point"
position = [0, 1, 0]
intensity = 0

[light.black]
kind = "directional"
direction = [0, -1, 0]
illuminance = 1
color = 0

[light.brightest]
kind = "point"
position = [0.3, 0.001, 0.3]
intensity = 1e12

[light.touching]
kind = "point"
position = [0, 0, 0]
intensity = 1

[light.grazing]
kind = "directional"
direction = [1, 0, 0]
illuminance = 1000
angular_diameter_degrees = 0.001
"#;

/// Materials at the ends of every range.
const MATERIALS: [&str; 5] = [
    "roughness = 0\nf0 = 1\nalbedo = 1",
    "roughness = 1\nf0 = 0\nalbedo = 0",
    "roughness = 0\nf0 = [1e-7, 1, 1e-6]\nalbedo = [1e-30, 1, 0]",
    "roughness = 1e-30\nmetal = \"gold\"",
    "n = [0.01, 100, 1]\nk = [100, 0, 1e-30]\nroughness = 1",
];

/// An EXR whose numbers lie below, within and far above what a material may have.
fn wild() -> Result<Vec<u8>, image::ImageError> {
    let values = [-1.0_f32, -0.0, 1e-38, 0.5, 1.0, 2.0, 1e30, f32::MAX];
    let picture = Rgb32FImage::from_fn(8, 8, |x, y| {
        let at = |i: u32| values[((x + y + i) % 8) as usize];
        Rgb([at(0), at(1), at(2)])
    });
    let mut bytes = Cursor::new(Vec::new());
    picture.write_to(&mut bytes, ImageFormat::OpenExr)?;
    Ok(bytes.into_inner())
}

fn scene(material: &str) -> String {
    let maps = "base_color_map = \"wild.exr\"\nroughness_map = \"wild.exr\"\nnormal_map = \"wild.exr\"\n\
                metalness_map = \"wild.exr\"\nemission_map = \"wild.exr\"\n";
    format!(
        "{SQUARE}{LAMPS}\n[material.hard]\n{material}\n\n[material.mapped]\n{maps}\n\
         [model.quad]\nfile = \"quad.obj\"\nmaterial = \"hard\"\n\n\
         [model.ball]\nshape = \"sphere\"\nmaterial = \"mapped\"\nscale = 0.1\n"
    )
}

#[test]
fn the_picture_is_finite_and_what_is_passed_over_is_named() -> Tested {
    let place = Place::empty()?;
    std::fs::write(place.path("wild.exr"), wild()?)?;
    place.write("quad.obj", OBJ)?;
    let told = [
        "light.dark gives no light: its intensity is 0",
        "light.black gives no light: its color is 0",
        "quad.obj:5: a normal without a direction",
        "wild.exr: 96 numbers of the base colour map lie outside",
        "wild.exr: 40 numbers of the roughness map lie outside",
    ];
    for material in MATERIALS {
        place.write("scene.toml", &scene(material))?;
        for lighting in ["best", "corrected", "phong"] {
            let run = place.render(&[
                "scene.toml",
                "--check",
                "--size",
                "48x27",
                "--lighting",
                lighting,
                "--output",
                "hard.exr",
            ])?;
            run.ends(0, &told);
        }
    }
    Ok(())
}

#[test]
fn what_is_no_number_is_refused_by_name() -> Tested {
    let place = Place::empty()?;
    for (line, words) in [
        ("[material.bad]\nroughness = nan", "material.bad.roughness"),
        ("[material.bad]\nf0 = inf", "material.bad.f0"),
        ("[material.bad]\nalbedo = -0.1", "material.bad.albedo"),
        ("[material.bad]\nemission = 1e13", "material.bad.emission"),
        (
            "[light.bad]\nkind = \"directional\"\ndirection = [0, -1, 0]\nilluminance = inf",
            "light.bad.illuminance",
        ),
        (
            "[light.bad]\nkind = \"point\"\nposition = [0, nan, 0]\nintensity = 1",
            "light.bad.position",
        ),
    ] {
        place.write("scene.toml", &format!("{SQUARE}\n{line}\n"))?;
        place
            .render(&["scene.toml", "--size", "16x9"])?
            .ends(6, &[words]);
    }
    assert_eq!(place.names()?, ["scene.toml"]);
    Ok(())
}
