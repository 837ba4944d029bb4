//! Do scene files and MTL files put pictures where they say, and are bad names told?

use std::fs;
use std::path::Path;

use image::{GrayImage, ImageFormat, Luma, Rgb, RgbImage};
use umber::scene::{self, LoadOptions, Maps, Material, Scene, Slot};

use crate::textures::files::file;
use crate::tolerances::TEXEL;

/// A grey, a colour and a normal picture.
fn pictures(folder: &Path) {
    let grey = GrayImage::from_fn(4, 4, |x, _| Luma([if x == 1 { 255 } else { 0 }]));
    for (name, bytes) in [
        ("grey.png", file(grey, ImageFormat::Png)),
        (
            "a b.png",
            file(
                RgbImage::from_pixel(1, 1, Rgb([255, 51, 0])),
                ImageFormat::Png,
            ),
        ),
        (
            "n.png",
            file(
                RgbImage::from_pixel(1, 1, Rgb([128, 128, 255])),
                ImageFormat::Png,
            ),
        ),
        ("cut.png", b"\x89PNG\r\n\x1a\n\0\0".to_vec()),
        ("text.tga", b"no picture".to_vec()),
    ] {
        fs::write(folder.join(name), bytes).expect("a written file");
    }
    fs::create_dir(folder.join("folder.png")).expect("a folder");
}

/// A sphere of material `m` and the scene's other text.
fn load(text: &str, overrides: &[&str]) -> Result<Scene, scene::Error> {
    let folder = tempfile::tempdir().expect("a temporary folder");
    pictures(folder.path());
    let path = folder.path().join("scene.toml");
    let model = "[model.ball]\nshape = \"plane\"\nmaterial = \"m\"\n";
    fs::write(&path, format!("{model}{text}")).expect("a written file");
    let overrides = overrides.iter().map(|&line| line.to_owned()).collect();
    scene::load(
        &path,
        &LoadOptions {
            overrides,
            ..LoadOptions::default()
        },
    )
}

const EVERY: &str = r#"
[material.base]
base_color_map = "a b.png"
roughness_map = { file = "a b.png", channel = "g" }
metalness_map = { file = "a b.png", channel = "b" }
normal_map = "n.png"
emission_map = { file = "a b.png" }
occlusion_map = "grey.png"
alpha_mask = "grey.png"
map_repeat = [2, 3.5]
metalness = 0.5
normal_scale = 4
alpha_cutoff = 0.25
two_sided = false
[material.m]
like = "base"
"#;

#[test]
fn every_key_reaches_the_material_by_like_too() {
    let scene = load(EVERY, &[]).expect("a good scene");
    let material = &scene.materials[0];
    assert_eq!(material.name, "m");
    assert_eq!(scene.textures.len(), 7);
    for slot in Slot::ALL {
        let texture = material.maps.get(slot).expect("a texture");
        assert_eq!(scene.textures[texture].slot(), slot);
    }
    let green = scene.textures[material.maps.roughness.expect("a texture")].texel(0, 0);
    assert!((f64::from(green[0]) - 0.2).abs() < TEXEL);
    assert_eq!(material.maps.repeat, [2.0, 3.5]);
    assert_eq!((material.metalness, material.normal_scale), (0.5, 4.0));
    assert_eq!((material.alpha_cutoff, material.two_sided), (0.25, false));
    assert!(!scene.meshes[0].coordinates.is_empty() && !scene.meshes[0].tangents.is_empty());
}

#[test]
fn a_material_without_maps_is_the_default_one() {
    let scene = load("[material.m]\nmap_repeat = 4\n", &[]).expect("a good scene");
    let wanted = Material {
        name: "m".to_owned(),
        maps: Maps {
            repeat: [4.0; 2],
            ..Maps::default()
        },
        ..Material::default()
    };
    assert_eq!(scene.materials[0], wanted);
    assert!(scene.materials[0].maps.is_empty() && scene.textures.is_empty());
    assert!(scene.meshes[0].coordinates.is_empty());
}

#[test]
fn a_file_in_one_slot_is_one_texture() {
    let text = "[material.m]\nbase_color_map = \"a b.png\"\n[material.n]\n\
                base_color_map = \"./a b.png\"\n[model.other]\nshape = \"cube\"\nmaterial = \"n\"\n";
    let scene = load(text, &[]).expect("a good scene");
    assert_eq!(scene.textures.len(), 1);
    assert_eq!(scene.materials[1].maps.base_color, Some(0));
}

#[test]
fn overrides_change_maps() {
    let text = "[material.m]\nroughness_map = \"grey.png\"\n";
    let set = |line: &str| load(text, &[line]);
    let scene = set("material.m.roughness_map = \"a b.png\"").expect("a good scene");
    assert_eq!(scene.textures[0].name(), "a b.png");
    let scene = set("material.m.base_color_map = \"a b.png\"").expect("a good scene");
    assert_eq!(scene.textures.len(), 2);
    for (line, wanted) in [
        (
            "material.m.roughness_map = \"no.png\"",
            "is missing: no such file",
        ),
        (
            "material.m.roughness_map = \"../no.png\"",
            "leads out of the folder",
        ),
        (
            "material.m.roughness_map.channel = \"g\"",
            "material.m.roughness_map has no file",
        ),
        ("material.m.roughness_map = 3", "image file"),
    ] {
        let error = set(line).map(drop).expect_err("a bad override");
        assert_eq!(error.exit_code(), 2, "{error}");
        assert!(error.to_string().contains(wanted), "{error}");
    }
}

/// Lines of a material, and the place and the message after `scene.toml:5:`.
const MISTAKES: &[(&str, &str)] = &[
    (
        "base_color_map = \"no.png\"",
        "18: material.m.base_color_map = 'no.png' is missing: no such file in '",
    ),
    (
        "alpha_mask = \"../x.png\"",
        "14: material.m.alpha_mask = '../x.png' leads out of the folder",
    ),
    (
        "alpha_mask = \"/etc/passwd\"",
        "14: material.m.alpha_mask = '/etc/passwd' leads out",
    ),
    (
        "alpha_mask = \"\"",
        "14: material.m.alpha_mask = '' the name is empty",
    ),
    (
        "normal_map = { file = \"n.png\", channel = \"g\" }",
        "14: material.m.normal_map: a normal map has no channel",
    ),
    (
        "roughness_map = { file = \"a b.png\", channel = \"a\" }",
        "17: material.m.roughness_map = 'a b.png' has no alpha channel",
    ),
    (
        "roughness_map = { file = \"n.png\", channel = \"x\" }",
        "unknown value 'x'",
    ),
    (
        "roughness_map = { files = \"n.png\" }",
        "unknown key 'files'; the nearest known one is 'file'",
    ),
    (
        "roughness_map = { channel = \"g\" }",
        "17: material.m.roughness_map has no file",
    ),
    (
        "roughness_map = \"text.tga\"",
        "17: material.m.roughness_map = 'text.tga' is no picture",
    ),
    (
        "map_repeat = 0",
        "14: material.m.map_repeat = 0: must be at least 0.001",
    ),
    ("map_repeat = [1, 2, 3]", "array of two numbers"),
    (
        "normal_scale = 11",
        "16: material.m.normal_scale = 11: must be",
    ),
    ("alpha_cutoff = nan", "16: material.m.alpha_cutoff = NaN"),
    ("metalness = -1", "13: material.m.metalness = -1"),
    ("two_sided = 1", "13: "),
];

#[test]
fn mistakes_have_line_and_column() {
    let head = "scene.toml:5:";
    for (line, wanted) in MISTAKES {
        let error = load(&format!("[material.m]\n{line}\n"), &[])
            .map(drop)
            .expect_err("a mistake");
        assert_eq!(error.exit_code(), 6, "{error}");
        let error = error.to_string();
        assert!(
            error.contains(head) && error.contains(wanted),
            "{error}\n  wanted {wanted}"
        );
    }
    for (name, wanted) in [
        ("cut.png", "cut.png: is damaged"),
        ("folder.png", "folder.png: is a folder"),
    ] {
        let error = load(&format!("[material.m]\nocclusion_map = \"{name}\"\n"), &[]);
        let error = error.map(drop).expect_err("a bad file").to_string();
        assert!(error.contains(wanted), "{error}");
    }
    let unused = load("[material.m]\n[material.n]\nnormal_map = \"no.png\"\n", &[]);
    assert!(unused.is_err(), "a material that nothing is made of");
}

#[test]
#[cfg(unix)]
fn a_link_that_leads_out_is_refused() {
    let (outside, folder) = (
        tempfile::tempdir().expect("a folder"),
        tempfile::tempdir().expect("a folder"),
    );
    pictures(outside.path());
    std::os::unix::fs::symlink(outside.path().join("n.png"), folder.path().join("n.png"))
        .expect("a link");
    let path = folder.path().join("scene.toml");
    let text =
        "[material.m]\nnormal_map = \"n.png\"\n[model.a]\nshape = \"cube\"\nmaterial = \"m\"\n";
    fs::write(&path, text).expect("a written file");
    let error = scene::load(&path, &LoadOptions::default())
        .map(drop)
        .expect_err("a link");
    assert!(
        error.to_string().contains("is a link that leads out"),
        "{error}"
    );
    fs::write(folder.path().join("m.mtl"), "newmtl m\nnorm n.png\n").expect("written");
    let obj = folder.path().join("m.obj");
    fs::write(
        &obj,
        "mtllib m.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
    )
    .expect("written");
    let scene = scene::load(&obj, &LoadOptions::default()).expect("a good model");
    assert!(scene.textures.is_empty() && scene.warnings[0].contains("m.mtl:2: 'n.png' is a link"));
}

#[test]
fn a_light_casts_shadows_if_it_says_so() {
    let text = "[material.m]\n[light.a]\nkind = \"point\"\nposition = [0, 2, 0]\nintensity = 1\n";
    assert!(!load(text, &[]).expect("a good scene").lights[0].shadow);
    let scene = load(&format!("{text}shadow = true\n"), &[]).expect("a good scene");
    assert!(scene.lights[0].shadow);
}

/// A triangle of the MTL material `m`.
fn model(lines: &str) -> Result<Scene, scene::Error> {
    let folder = tempfile::tempdir().expect("a temporary folder");
    pictures(folder.path());
    fs::write(folder.path().join("m.mtl"), format!("newmtl m\n{lines}")).expect("written");
    let path = folder.path().join("m.obj");
    fs::write(
        &path,
        "mtllib m.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
    )
    .expect("written");
    scene::load(&path, &LoadOptions::default())
}

#[test]
fn every_map_of_an_mtl_has_its_slot() {
    let lines = "map_Kd a b.png\nmap_Ka a b.png\nmap_Pr grey.png\nmap_Pm grey.png\nmap_Ke a b.png\n\
                 map_ao grey.png\nmap_d grey.png\nnorm n.png\nmap_Bump grey.png\nPm 0.5\n";
    let scene = model(lines).expect("a good model");
    assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);
    let material = &scene.materials[0];
    for slot in Slot::ALL {
        assert!(material.maps.get(slot).is_some(), "{}", slot.name());
    }
    let normal = &scene.textures[material.maps.normal.expect("a texture")];
    assert_eq!(normal.name(), "n.png", "norm wins");
    assert_eq!(
        (material.albedo, material.f0),
        ([1.0; 3], [0.04; 3]),
        "factors of the maps"
    );
    assert_eq!((material.roughness, material.metalness), (1.0, 0.5));
    assert!((material.emission[0] - 1228.8).abs() < 1e-3);
}

#[test]
fn factors_beside_maps() {
    let of = |lines: &str| model(lines).expect("a good model").materials.remove(0);
    assert_eq!(
        of("map_Kd n.png\nKd 0 0 0\nKs 1 1 1\n").albedo,
        [1.0; 3],
        "black is no factor"
    );
    assert_eq!(of("map_Kd n.png\nKd 0.5 0.25 1\n").albedo, [0.5, 0.25, 1.0]);
    assert_eq!(of("map_Pr grey.png\nPr 0.25\nNs 10\n").roughness, 0.25);
    assert_eq!(of("map_Pr no.png\nNs 0\n").maps, Maps::default());
}

#[test]
fn a_grey_bump_is_heights_and_a_coloured_one_normals() {
    let scene = model("map_Bump -bm 25 grey.png\n").expect("a good model");
    let texture = &scene.textures[scene.materials[0].maps.normal.expect("a texture")];
    assert_eq!(texture.slot(), Slot::Normal);
    // White in column 1 of 4 stands 25 / 100 of the width high: a step of 1 over two texels is a
    // slope of half a texel's height over a texel, which is 1 texel x 0.5.
    let [x, _, z, _] = texture.texel(0, 2).map(f64::from);
    assert!((x / z + 0.5).abs() < TEXEL, "rises to the right: {x} {z}");
    let [x, y, z, _] = texture.texel(2, 0).map(f64::from);
    assert!(
        (x / z - 0.5).abs() < TEXEL && y.abs() < TEXEL,
        "falls: {x} {z}"
    );
    assert_eq!(texture.texel(3, 0), [0.0, 0.0, 1.0, 1.0]);
    let scene = model("bump n.png\n").expect("a good model");
    let texture = &scene.textures[scene.materials[0].maps.normal.expect("a texture")];
    assert!(texture.texel(0, 0)[2] > 0.9999);
}

/// Lines of an MTL material, and the warning.
const OPTIONS: &[(&str, &str)] = &[
    (
        "map_Kd -o 0.5 0 0 a b.png",
        "m.mtl:2: map_Kd -o is not used yet",
    ),
    (
        "map_Kd -clamp on a b.png",
        "m.mtl:2: map_Kd -clamp is not used yet",
    ),
    (
        "map_Pr -imfchan z a b.png",
        "m.mtl:2: map_Pr -imfchan z is not used yet",
    ),
    (
        "map_Kd -s 0 1 1 a b.png",
        "m.mtl:2: map_Kd -s = 0 is taken as 0.001",
    ),
    (
        "map_Kd a b.png\nmap_Pr -s 4 4 grey.png",
        "m.mtl:3: the roughness map has an -s of its own",
    ),
    (
        "map_Kd a b.png\nmap_Ka n.png",
        "m.mtl:3: map_Ka is not used yet",
    ),
    ("map_Ks grey.png", "m.mtl:2: map_Ks is not used yet"),
    ("map_Kd", "m.mtl:2: map_Kd names no file"),
    (
        "map_Kd -s 2 3 no such.png",
        "m.mtl:2: 'no such.png' is missing",
    ),
    ("map_Kd C:\\art\\wood.png", "m.mtl:2: 'C:/art/wood.png' "),
    (
        "map_Kd /etc/passwd",
        "m.mtl:2: '/etc/passwd' leads out of the folder",
    ),
    (
        "map_Kd ..\\wood.png",
        "m.mtl:2: '../wood.png' leads out of the folder",
    ),
    (
        "map_Kd text.tga",
        "m.mtl:2: 'text.tga' is no picture of a known kind",
    ),
    (
        "map_d -imfchan m a b.png",
        "m.mtl:2: 'a b.png' has no alpha channel",
    ),
];

#[test]
fn options_of_maps() {
    let scene = model(
        "map_Kd -s 2 3 1 -o 0 0 0 -blendu on -texres 512 a b.png\nmap_Pr -s 2 3 -imfchan g a b.png\n",
    );
    let scene = scene.expect("a good model");
    assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);
    assert_eq!(scene.materials[0].maps.repeat, [2.0, 3.0]);
    let green = scene.textures[scene.materials[0].maps.roughness.expect("a texture")].texel(0, 0);
    assert!((f64::from(green[0]) - 0.2).abs() < TEXEL);
    for (line, wanted) in OPTIONS {
        let scene = model(&format!("{line}\n")).expect("a good model");
        assert!(
            scene.warnings.iter().any(|w| w.contains(wanted)),
            "{wanted}: {:?}",
            scene.warnings
        );
    }
    for (line, wanted) in [
        ("map_Kd -s nan a b.png", "m.mtl:2: map_Kd -s is nan"),
        (
            "map_Bump -bm x a b.png",
            "m.mtl:2: map_Bump -bm: 'x' is not a number",
        ),
        ("map_Kd cut.png", "cut.png: is damaged or cut short"),
        ("map_Kd folder.png", "folder.png: is a folder"),
    ] {
        let error = model(&format!("{line}\n"))
            .map(drop)
            .expect_err("a bad map")
            .to_string();
        assert!(error.contains(wanted), "{error}\n  wanted {wanted}");
    }
}

#[test]
fn a_second_definition_has_its_own_maps() {
    let scene = model("map_Kd n.png\nnewmtl m\nmap_Pr grey.png\n").expect("a good model");
    let maps = &scene.materials[0].maps;
    assert!(
        maps.base_color.is_none() && maps.roughness.is_some(),
        "{maps:?}"
    );
}
