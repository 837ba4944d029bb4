//! Is an OBJ file read as it is meant, and does each fault get its own message and line?

use std::fs;
use std::path::PathBuf;

use proptest::prelude::*;
use tempfile::TempDir;
use umber::scene::{self, LoadOptions, Scene};

use crate::mutation;

fn folder(bytes: &[u8]) -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("model.obj");
    fs::write(&path, bytes).expect("a written file");
    (folder, path)
}

fn load(text: &str) -> Result<Scene, scene::Error> {
    let (_folder, path) = folder(text.as_bytes());
    scene::load(&path, &LoadOptions::default())
}

fn message(bytes: &[u8]) -> String {
    let (_folder, path) = folder(bytes);
    let loaded = scene::load(&path, &LoadOptions::default());
    let error = loaded.map(drop).expect_err("a file that is wrong");
    assert_eq!(error.exit_code(), 6, "{error}");
    let error = error.to_string();
    let start = error.find("model.obj").expect("the file's name");
    error[start..].to_owned()
}

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

/// What follows three vertices, and how its message begins.
const FAULTS: &[(&str, &str)] = &[
    (
        "f 1 2 4\n",
        "model.obj:4: a face names vertex 4, out of range: 3 vertices stand before this line",
    ),
    (
        "f 1 2 -4\n",
        "model.obj:4: a face names vertex -4, out of range",
    ),
    (
        "f 0 1 2\n",
        "model.obj:4: a face names vertex 0: they count from 1",
    ),
    (
        "f 1 2 9223372036854775807\n",
        "model.obj:4: a face names vertex 9223372036854775807, out of range",
    ),
    (
        "f 1 2 -9223372036854775808\n",
        "model.obj:4: a face names vertex -9223372036854775808, out of range",
    ),
    (
        "f 1//1 2//1 3//1\n",
        "model.obj:4: a face names normal 1, out of range: 0 normals stand before this line",
    ),
    (
        "vn 0 0 1\nf 1//0 2//1 3//1\n",
        "model.obj:5: a face names normal 0: they count from 1",
    ),
    (
        "f 1 2\n",
        "model.obj:4: a face needs three vertices, this one has 2",
    ),
    (
        "f\n",
        "model.obj:4: a face needs three vertices, this one has 0",
    ),
    ("f 1 2 x\n", "model.obj:4: 'x' is not a face's corner"),
    (
        "vt 0 0\nf 1 2 3/1/1/1\n",
        "model.obj:5: a face names normal 1, out of range",
    ),
    (
        "f 1/1 2/1 3/1\n",
        "model.obj:4: a face names texture coordinate 1, out of range: 0 texture coordinates stand before this line",
    ),
    (
        "vt 0 nan\n",
        "model.obj:4: a texture coordinate is nan: NaN and infinity have no place",
    ),
    ("vt inf\n", "model.obj:4: a texture coordinate is inf"),
    (
        "vt\n",
        "model.obj:4: a texture coordinate needs two numbers",
    ),
    (
        "vt 0 1e13\n",
        "model.obj:4: the texture coordinate 1e13 is above 1e12",
    ),
    (
        "f 1 2 18446744073709551616\n",
        "model.obj:4: '18446744073709551616' is not a face's corner",
    ),
    (
        "v 1 nan 2\n",
        "model.obj:4: a coordinate is nan: NaN and infinity have no place",
    ),
    (
        "v 1 2 -inf\n",
        "model.obj:4: a coordinate is -inf: NaN and infinity",
    ),
    (
        "v 1 2 1e99\n",
        "model.obj:4: a coordinate is 1e99: NaN and infinity",
    ),
    (
        "v 1 2 1e30\n",
        "model.obj:4: the coordinate 1e30 is farther than 1e12 m from the origin",
    ),
    ("v 1 2 3 0\n", "model.obj:4: a vertex of weight 0"),
    (
        "v 1 2 3 1e-38\n",
        "model.obj:4: the coordinate 1 is farther than",
    ),
    ("v 1 2\n", "model.obj:4: a vertex needs three coordinates"),
    ("v 1 2 three\n", "model.obj:4: 'three' is not a number"),
    ("vn 0 0\n", "model.obj:4: a normal needs three components"),
    ("vn 0 nan 1\n", "model.obj:4: a normal's component is nan"),
    (
        "",
        "model.obj: has no faces in its 3 lines: there is nothing to draw",
    ),
    ("l 1 2 3\n", "model.obj: has no faces in its 4 lines"),
    (
        "f 1 1 2\nf 1 2 2\n",
        "model.obj: has no face with an area: there is nothing to draw",
    ),
    (
        "mtllib ../other.mtl\n",
        "model.obj:4: mtllib ../other.mtl: leads out of the folder",
    ),
    (
        "mtllib /etc/passwd\n",
        "model.obj:4: mtllib /etc/passwd: leads out of the folder",
    ),
];

#[test]
fn each_fault_has_its_message_and_line() {
    for (rest, wanted) in FAULTS {
        let found = message(format!("{TRIANGLE}{rest}").as_bytes());
        assert!(found.starts_with(wanted), "{found}\n  wanted {wanted}");
    }
}

#[test]
fn what_is_no_obj_file_is_told_so() {
    assert!(message(b"").starts_with("model.obj: is empty"));
    let garbage: Vec<u8> = (0..5000_u32)
        .map(|x| (x.wrapping_mul(2_654_435_761) >> 13) as u8)
        .collect();
    let found = message(&garbage);
    assert!(
        found.contains("zero byte") || found.contains("no faces"),
        "{found}"
    );
    assert!(message(b"\x7fELF\0\0\0\n").starts_with("model.obj:1: holds a zero byte"));
    let long = vec![b'x'; 33 << 20];
    assert!(message(&long).starts_with("model.obj:1: the line is too long"));
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("dir.obj");
    fs::create_dir(&path).expect("a folder");
    let error = scene::load(&path, &LoadOptions::default())
        .expect_err("a folder")
        .to_string();
    assert!(error.contains("dir.obj: is a folder"), "{error}");
}

#[test]
fn polygons_negative_indices_and_odd_spelling_are_read() {
    let scene = load(
        "# caf\u{e9}\r\nv 0 0 0 0.5 0.5 0.5\r\n  v 1 0 0\r\nv 1 1 0 # corner\r\nv 0 1 0\r\nv 0 0 1\r\n\
         vt 0 0\r\nf -5/1 -4/1/ 3 \\\r\n 4\r\ng\r\ns off\r\nf 1 2 5\r\nl 1 2 3\r\np 1\r\ncurv2 1 2\r\n",
    )
    .expect("a good model");
    assert_eq!(
        scene.triangle_count(),
        3,
        "a quad and a triangle, and no triangle from a line"
    );
    let bounds = scene.bounds();
    assert_eq!(bounds.min.to_array(), [0.0; 3]);
    assert_eq!(bounds.max.to_array(), [1.0; 3]);
}

#[test]
fn a_byte_that_is_not_utf8_is_passed_over_in_comments_and_names() {
    let (_folder, path) = folder(b"# caf\xe9\no caf\xe9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    let scene = scene::load(&path, &LoadOptions::default()).expect("a good model");
    assert_eq!(scene.meshes[0].name, "caf\u{fffd}");
}

#[test]
fn triangles_without_an_area_are_dropped_with_a_warning() {
    let scene = load(&format!("{TRIANGLE}f 1 2 3\nf 1 1 2\nf 1 2 2\n")).expect("a good model");
    assert_eq!(scene.triangle_count(), 1);
    assert_eq!(scene.warnings.len(), 1);
    assert!(scene.warnings[0].contains("2 triangles have no area and are left out"));
}

#[test]
fn objects_and_materials_become_meshes() {
    let (folder, path) = folder(
        b"mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n\
          o left\nusemtl red\nf 1 2 3\nusemtl blue\nf 1 2 4\nusemtl red\nf 1 3 4\no right\nf 2 3 4\n",
    );
    fs::write(
        folder.path().join("a.mtl"),
        "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n",
    )
    .expect("a written file");
    let scene = scene::load(&path, &LoadOptions::default()).expect("a good model");
    let objects: Vec<(&str, &str, usize)> = scene
        .objects
        .iter()
        .map(|object| {
            let mesh = &scene.meshes[object.mesh];
            let material = &scene.materials[object.material].name;
            (
                object.name.as_str(),
                material.as_str(),
                mesh.triangle_count(),
            )
        })
        .collect();
    let wanted = [
        ("model/left", "red", 2),
        ("model/left", "blue", 1),
        ("model/right", "red", 1),
    ];
    assert_eq!(objects, wanted);
    assert_eq!(scene.triangle_count(), 4);
}

#[test]
fn a_large_object_handed_on_in_pieces_stays_one_mesh() {
    // 2 x 400 x 400 triangles: more than one piece of 262 144.
    let side = 400;
    let mut text = String::new();
    for row in 0..=side {
        for column in 0..=side {
            text.push_str(&format!("v {column} 0 {row}\n"));
        }
    }
    for row in 0..side {
        for column in 0..side {
            let a = row * (side + 1) + column + 1;
            let c = a + side + 1;
            text.push_str(&format!("f {a} {c} {} {}\n", c + 1, a + 1));
        }
    }
    let scene = load(&text).expect("a good model");
    assert_eq!(scene.meshes.len(), 1);
    assert_eq!(scene.triangle_count(), 2 * side * side);
    let mesh = &scene.meshes[0];
    assert_eq!(
        mesh.positions.len(),
        (side + 1) * (side + 1),
        "welded again"
    );
    assert!(mesh.normals.iter().all(|normal| *normal == [0.0, 1.0, 0.0]));
}

#[test]
fn too_many_objects_are_refused() {
    let count = 1 << 20;
    let mut text = TRIANGLE.to_owned();
    for _ in 0..=count + 1 {
        text.push_str("o\nf 1 2 3\n");
    }
    let found = message(text.as_bytes());
    // Three vertices, then two lines for each object; the last one is refused.
    let line = 3 + 2 * (count + 2);
    let wanted = format!("model.obj:{line}: begins more than 1048576 objects");
    assert!(found.starts_with(&wanted), "{found}\n  wanted {wanted}");
}

#[test]
fn a_scene_names_an_obj_and_its_materials() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let write = |name: &str, text: &str| {
        fs::write(folder.path().join(name), text).expect("a written file");
    };
    write("a.mtl", "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n");
    write(
        "a.obj",
        &format!("mtllib a.mtl\n{TRIANGLE}v 0 0 1\nusemtl red\nf 1 2 3\nusemtl blue\nf 1 2 4\n"),
    );
    let load = |text: &str| {
        write("scene.toml", text);
        let scene = scene::load(&folder.path().join("scene.toml"), &LoadOptions::default());
        scene.expect("a good scene")
    };
    let names = |scene: &Scene| -> Vec<String> {
        let names = scene
            .objects
            .iter()
            .map(|o| scene.materials[o.material].name.clone());
        names.collect()
    };
    let own = load("[model.a]\nfile = \"a.obj\"\n[material.'a.obj:red']\nroughness = 0.2\n");
    assert_eq!(names(&own), ["a.obj:red", "a.obj:blue"]);
    assert_eq!(own.materials[0].roughness, 0.2);
    assert_eq!(own.materials[0].albedo, [1.0, 0.0, 0.0]);
    let all =
        load("[model.a]\nfile = \"a.obj\"\nmaterial = \"gold\"\n[model.b]\nfile = \"a.obj\"\n");
    assert_eq!(names(&all), ["gold", "gold", "a.obj:red", "a.obj:blue"]);
    assert_eq!(all.meshes.len(), 2, "loaded once");
    let part = load("[model.a]\nfile = \"a.obj\"\nmaterials = { blue = \"gold\" }\n");
    assert_eq!(names(&part), ["a.obj:red", "gold"]);
}

#[test]
fn a_byte_order_mark_is_passed_over() {
    let marked = format!("\u{feff}{TRIANGLE}f 1 2 3\n");
    let scene = load(&marked).expect("a good model");
    assert_eq!(scene.triangle_count(), 1);
    assert!(message(b"\xef\xbb\xbf").starts_with("model.obj: has no faces in its 1 lines"));
}

#[test]
fn a_comment_ends_with_its_line() {
    let text = format!("# made in C:\\tmp\\\nv 0 0 0\n  # \\\n{TRIANGLE}f 2 3 4\n");
    let scene = load(&text).expect("a good model");
    assert_eq!(scene.triangle_count(), 1);
}

#[test]
#[cfg(unix)]
fn a_link_on_the_command_line_is_followed_and_what_it_names_is_confined() {
    let inside = tempfile::tempdir().expect("a temporary folder");
    let target = inside.path().join("target");
    fs::write(inside.path().join("a.mtl"), "newmtl red\nKd 1 0 0\n").expect("a written file");
    let elsewhere = tempfile::tempdir().expect("a temporary folder");
    let link = elsewhere.path().join("link.obj");
    std::os::unix::fs::symlink(&target, &link).expect("a link");
    let load = |library: &str| {
        let text = format!("mtllib {library}\n{TRIANGLE}usemtl red\nf 1 2 3\n");
        fs::write(&target, text).expect("a written file");
        scene::load(&link, &LoadOptions::default())
    };
    let scene = load("a.mtl").expect("a good model");
    assert_eq!(scene.materials[0].albedo, [1.0, 0.0, 0.0]);
    assert_eq!(scene.objects[0].name, "link");
    let secret = elsewhere.path().join("secret.mtl");
    fs::write(&secret, "newmtl red\n").expect("a written file");
    std::os::unix::fs::symlink(&secret, inside.path().join("out.mtl")).expect("a link");
    let error = load("out.mtl")
        .expect_err("a link that leads out")
        .to_string();
    let wanted = "link.obj:1: mtllib out.mtl: is a link that leads out of the folder";
    assert!(error.contains(wanted), "{error}\n  wanted {wanted}");
}

#[test]
fn models_too_large_or_too_small_are_blamed_and_not_the_camera() {
    for (size, wanted) in [
        (
            "9e11",
            "model.obj: the models are too large or too far away to be framed",
        ),
        (
            "1e-7",
            "model.obj: the models are too small, or too small for",
        ),
    ] {
        let text = format!("v 0 0 0\nv {size} 0 0\nv 0 {size} 0\nf 1 2 3\n");
        let found = message(text.as_bytes());
        assert!(found.starts_with(wanted), "{found}\n  wanted {wanted}");
    }
}

#[test]
fn names_in_messages_are_cut_and_have_no_control_characters() {
    let long = "n".repeat(1 << 16);
    for text in [
        format!("{TRIANGLE}f 1 2 {long}\n"),
        format!("v 1 2 {long}\n"),
        format!("mtllib ../{}\n", &long[..4000]),
        format!("usemtl {long}\n"),
        "f 1 2 \x1b[31m\n".to_owned(),
        "mtllib ../\x1b[31m\n".to_owned(),
    ] {
        let found = message(text.as_bytes());
        assert!(found.len() < 300, "{} bytes", found.len());
        assert!(!found.contains(char::is_control), "{found:?}");
    }
    let text = format!("{TRIANGLE}usemtl \x1b[31m\nmtllib \x1b[31m\nf 1 2 3\n");
    let scene = load(&text).expect("a good model");
    assert_eq!(scene.warnings.len(), 2, "{:?}", scene.warnings);
    assert!(!scene.warnings.concat().contains(char::is_control));
}

/// An OBJ text that has everything.
const RICH: &str = "mtllib a.mtl\no a\nv 0 0 0\nv 1.5 0 -2e-1 1\nv 0 1 0\nv 0 0 1 1 0 0\nvn 0 0 1\n\
                    vt 0 0\nusemtl red\nf 1 2 3\ng b\nf 1//1 2/1/1 -1\nf -4 -3 -2 -1\ns 1\nl 1 2\n";

proptest! {
    #![proptest_config(mutation::cases(1000))]

    /// Whatever happens to the text, there is a model with sound numbers or a message.
    #[test]
    fn mutated_text_never_panics(bytes in mutation::mutated(RICH, b"-/ 9\nfv0e.\\")) {
        let (_folder, path) = folder(&bytes);
        match scene::load(&path, &LoadOptions::default()) {
            Err(error) => prop_assert!(error.to_string().contains("model.obj"), "{}", error),
            Ok(scene) => {
                for mesh in &scene.meshes {
                    prop_assert_eq!(mesh.normals.len(), mesh.positions.len());
                    prop_assert!(mesh.positions.iter().flatten().all(|x| x.is_finite()));
                    prop_assert!(mesh.normals.iter().flatten().all(|x| x.is_finite()));
                    prop_assert!(mesh.indices.iter().all(|&i| (i as usize) < mesh.positions.len()));
                }
            }
        }
    }
}
