//! Does an MTL file become the materials that it means, and are its faults told?

use std::fs;

use proptest::prelude::*;
use tempfile::TempDir;
use umber::scene::{self, LoadOptions, Material, Scene};

use crate::mutation;

/// A triangle of material `m` beside an MTL file with the given bytes.
fn load(mtl: &[u8]) -> (TempDir, Result<Scene, scene::Error>) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("model.obj");
    fs::write(folder.path().join("model.mtl"), mtl).expect("a written file");
    let obj = "mtllib model.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    fs::write(&path, obj).expect("a written file");
    let scene = scene::load(&path, &LoadOptions::default());
    (folder, scene)
}

/// The material that `lines` make, and the warnings.
fn material(lines: &str) -> (Material, Vec<String>) {
    let (_folder, scene) = load(format!("newmtl m\n{lines}").as_bytes());
    let mut scene = scene.expect("a good material");
    (scene.materials.remove(0), scene.warnings)
}

fn close(found: [f32; 3], wanted: [f64; 3]) {
    for (found, wanted) in found.into_iter().zip(wanted) {
        assert!(
            (f64::from(found) - wanted).abs() < 1e-6,
            "{found} for {wanted}"
        );
    }
}

#[test]
fn the_classic_keys() {
    let (m, warnings) = material("Kd 0.8 0.4 0.2\nNs 98\nNi 2\nd 0.25\nKe 1 0.5 0\n");
    assert!(warnings.is_empty(), "{warnings:?}");
    close(m.albedo, [0.8, 0.4, 0.2]);
    close(m.f0, [1.0 / 9.0; 3]);
    // sqrt(2 / (98 + 2))
    assert!((f64::from(m.roughness) - 0.02_f64.sqrt()).abs() < 1e-6);
    assert_eq!(m.shininess, 98.0);
    assert_eq!(m.opacity, 0.25);
    // White at EV 10: 1.2 * 1024 cd/m^2.
    assert!((m.emission[0] - 1228.8).abs() < 1e-3 && (m.emission[1] - 614.4).abs() < 1e-3);
}

#[test]
fn the_pbr_keys() {
    let (m, _) = material("Kd 0.8 0.4 0.2\nPm 0.75\nPr 0.5\nNi 1.5\nKs 1 1 1\nTr 0.25\n");
    close(m.albedo, [0.2, 0.1, 0.05]);
    close(m.f0, [0.61, 0.31, 0.16]);
    assert_eq!(m.roughness, 0.5);
    // 2 / 0.5^2 - 2
    assert_eq!(m.shininess, 6.0);
    assert_eq!(m.opacity, 0.75);
}

#[test]
fn specular_colour_is_a_reflectance_only_without_a_diffuse_one() {
    let (mirror, _) = material("Kd 0 0 0\nKs 0.9 0.8 0.7\n");
    close(mirror.f0, [0.9, 0.8, 0.7]);
    let (plastic, _) = material("Kd 0.5 0.5 0.5\nKs 0.5 0.5 0.5\n");
    close(plastic.f0, [0.04; 3]);
    let (indexed, _) = material("Kd 0.5 0.5 0.5\nKs 0.5 0.5 0.5\nNi 1.4\n");
    close(indexed.f0, [1.0 / 36.0; 3]);
    let (vacuum, _) = material("Kd 0.5 0.5 0.5\nKs 1 1 1\nNi 1\n");
    close(vacuum.f0, [0.08; 3]);
}

#[test]
fn one_number_is_grey_and_absent_ones_have_defaults() {
    let (m, warnings) = material("Kd 0.25\n");
    assert!(warnings.is_empty(), "{warnings:?}");
    close(m.albedo, [0.25; 3]);
    let (m, _) = material("illum 2000\nKa 1 1\nsharpness x\n");
    close(m.albedo, [0.5; 3]);
    close(m.f0, [0.04; 3]);
    assert_eq!((m.roughness, m.opacity), (0.5, 1.0));
}

#[test]
fn what_is_not_used_is_said_once() {
    let (_, warnings) = material(
        "Kd 1 1 1\nmap_Ks wood.png\nmap_Ks wood.png\nmap_Ns\ndisp n.png\nPs 1\nPc 1\nPcr 0\naniso 0\n",
    );
    for key in ["map_Ks", "map_Ns", "disp", "Ps", "Pc", "Pcr", "aniso"] {
        let said = warnings
            .iter()
            .filter(|w| w.contains(&format!(": {key} is not used yet")));
        assert_eq!(said.count(), 1, "{key}: {warnings:?}");
    }
    assert!(
        warnings
            .iter()
            .any(|w| w.contains("model.mtl:3: map_Ks") && w.contains("2 times"))
    );
}

#[test]
fn numbers_out_of_range_are_clamped_with_a_warning() {
    let (m, warnings) = material("Kd 2 -1 0.5\nNs -3\nd 7\nNs 1e6\n");
    close(m.albedo, [1.0, 0.0, 0.5]);
    assert_eq!(m.shininess, 10_000.0);
    assert_eq!(m.opacity, 1.0);
    for wanted in [
        ":2: Kd = 2 is taken as 1",
        ":2: Kd = -1 is taken as 0",
        ":3: Ns = -3 is taken as 0",
        ":4: d = 7",
    ] {
        assert!(
            warnings.iter().any(|w| w.contains(wanted)),
            "{wanted}: {warnings:?}"
        );
    }
}

#[test]
fn warnings_without_end_are_counted() {
    let (_, warnings) = material(&"d 2\n".repeat(1000));
    assert_eq!(warnings.len(), 101);
    assert_eq!(warnings[100], "and 900 more warnings");
}

#[test]
fn faults_have_their_line() {
    for (lines, wanted) in [
        ("Kd 1 1\n", "model.mtl:2: Kd needs one or three numbers"),
        ("Kd\n", "model.mtl:2: Kd needs one or three numbers"),
        (
            "Kd 1 nan 1\n",
            "model.mtl:2: Kd is nan: NaN and infinity have no place",
        ),
        ("\nNs inf\n", "model.mtl:3: Ns is inf"),
        ("Ns\n", "model.mtl:2: Ns needs a number"),
        ("d half\n", "model.mtl:2: d: 'half' is not a number"),
        ("newmtl\n", "model.mtl:2: newmtl without a name"),
        ("Kd \0\n", "model.mtl:2: holds a zero byte"),
    ] {
        let (_folder, scene) = load(format!("newmtl m\n{lines}").as_bytes());
        let error = scene.expect_err("a file that is wrong");
        assert_eq!(error.exit_code(), 6);
        let error = error.to_string();
        assert!(error.contains(wanted), "{error}\n  wanted {wanted}");
    }
}

#[test]
fn missing_files_and_names_are_warnings_and_the_default_material() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("model.obj");
    let write = |head: &str| {
        fs::write(&path, format!("{head}v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")).expect("written");
        scene::load(&path, &LoadOptions::default()).expect("a good model")
    };
    let scene = write("mtllib absent.mtl\nusemtl m\n");
    assert_eq!(scene.materials[0].name, "default");
    assert_eq!(scene.warnings.len(), 2, "{:?}", scene.warnings);
    assert!(scene.warnings[0].contains("model.obj:1: mtllib absent.mtl: no such file"));
    assert!(scene.warnings[1].contains("model.obj:2: no MTL has a material 'm'"));
    let plain = write("");
    assert_eq!(
        (plain.materials[0].name.as_str(), plain.warnings.len()),
        ("default", 0)
    );
    let unnamed = write("usemtl\n");
    assert!(unnamed.warnings[0].contains("model.obj:1: usemtl without a name"));
    fs::write(folder.path().join("my file.mtl"), "newmtl a b\nKd 0 1 0\n").expect("written");
    let spaced = write("mtllib my file.mtl\nusemtl a b\n");
    assert_eq!(spaced.materials[0].albedo, [0.0, 1.0, 0.0]);
    fs::create_dir(folder.path().join("folder.mtl")).expect("a folder");
    fs::write(&path, "mtllib folder.mtl\n").expect("written");
    let error = scene::load(&path, &LoadOptions::default())
        .expect_err("a folder")
        .to_string();
    assert!(error.contains("folder.mtl: is a folder"), "{error}");
}

#[test]
#[cfg(unix)]
fn a_link_that_leads_out_is_refused() {
    let outside = tempfile::tempdir().expect("a temporary folder");
    fs::write(outside.path().join("secret.mtl"), "newmtl m\n").expect("written");
    let folder = tempfile::tempdir().expect("a temporary folder");
    let link = folder.path().join("link.mtl");
    std::os::unix::fs::symlink(outside.path().join("secret.mtl"), link).expect("a link");
    let path = folder.path().join("model.obj");
    fs::write(&path, "mtllib link.mtl\n").expect("written");
    let error = scene::load(&path, &LoadOptions::default())
        .expect_err("a link")
        .to_string();
    assert!(
        error.contains("model.obj:1: mtllib link.mtl: is a link that leads out"),
        "{error}"
    );
}

/// What an OBJ with the given lines before its triangle becomes, beside the given MTL files.
fn beside(files: &[(&str, &str)], lines: &str) -> Result<Scene, scene::Error> {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for (name, text) in files {
        fs::write(folder.path().join(name), text).expect("a written file");
    }
    let path = folder.path().join("model.obj");
    let text = format!("{lines}v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    fs::write(&path, text).expect("a written file");
    scene::load(&path, &LoadOptions::default())
}

#[test]
fn a_library_is_loaded_once_however_often_it_is_named() {
    let lines = format!(
        "{}mtllib ./a.mtl\nmtllib a.mtl b.mtl\nmtllib b.mtl a.mtl\nusemtl m\n",
        "mtllib a.mtl\n".repeat(100)
    );
    let files = [
        ("a.mtl", "newmtl m\nKd 2 1 1\n"),
        ("b.mtl", "newmtl n\nKd 3 1 1\n"),
    ];
    let scene = beside(&files, &lines).expect("a good model");
    assert_eq!(scene.warnings.len(), 2, "{:?}", scene.warnings);
    assert_eq!(scene.materials[0].name, "m");
}

#[test]
fn libraries_are_bounded_together() {
    let text = format!("#{}\n", "x".repeat(33 << 20));
    let files = [("a.mtl", text.as_str()), ("b.mtl", text.as_str())];
    let error = beside(&files, "mtllib a.mtl\nmtllib b.mtl\n").expect_err("too much");
    let error = error.to_string();
    let wanted = "b.mtl: is too large: the material libraries of an OBJ may have 64 MiB together";
    assert!(error.contains(wanted), "{error}");
    let names = |count: usize| -> String {
        let lines = (0..count).map(|i| format!("mtllib {i}.mtl\n"));
        lines.collect()
    };
    beside(&[], &names(1024)).expect("a good model");
    let error = beside(&[], &names(1025)).expect_err("too many").to_string();
    let wanted = "model.obj:1025: names more than 1024 material libraries";
    assert!(error.contains(wanted), "{error}");
}

#[test]
fn a_long_line_of_libraries_is_read_to_its_end() {
    let line: String = (0..60).map(|i| format!(" absent{i}.mtl")).collect();
    let files = [("last.mtl", "newmtl m\nKd 0 1 0\n")];
    let scene = beside(&files, &format!("mtllib{line} last.mtl\nusemtl m\n"));
    assert_eq!(
        scene.expect("a good model").materials[0].albedo,
        [0.0, 1.0, 0.0]
    );
    let line = "x".repeat(70_000);
    let error = beside(&[], &format!("mtllib {line}\n")).expect_err("too long");
    assert!(
        error
            .to_string()
            .contains("model.obj:1: mtllib: the line is longer than 64 KiB")
    );
}

#[test]
fn long_names_of_materials_do_not_merge() {
    let (a, b) = (
        format!("{}a", "n".repeat(255)),
        format!("{}b", "n".repeat(255)),
    );
    let library = format!("newmtl {a}\nKd 1 0 0\nnewmtl {b}\nKd 0 1 0\n");
    let error = beside(&[("a.mtl", &library)], "mtllib a.mtl\n").expect_err("too long");
    let wanted = "a.mtl:1: newmtl: a name of 256 characters: at most 255 are possible";
    assert!(error.to_string().contains(wanted), "{error}");
    let error = beside(&[], &format!("usemtl {a}\n")).expect_err("too long");
    let wanted = "model.obj:1: usemtl: a name of 256 characters";
    assert!(error.to_string().contains(wanted), "{error}");
    let fits = "\u{e9}".repeat(255);
    let library = format!("newmtl {fits}\nKd 1 0 0\n");
    let lines = format!("mtllib a.mtl\nusemtl {fits}\n");
    let scene = beside(&[("a.mtl", &library)], &lines).expect("a good model");
    assert_eq!(scene.materials[0].name, fits);
}

#[test]
fn a_mtllib_line_without_a_file_has_its_line() {
    let scene = beside(&[], "mtllib\n").expect("a good model");
    assert_eq!(scene.warnings.len(), 1, "{:?}", scene.warnings);
    assert!(scene.warnings[0].contains("model.obj:1: mtllib without a name"));
    let error = beside(&[], "mtllib .\n").expect_err("a folder").to_string();
    assert!(
        error.contains("model.obj:1: mtllib .: is a folder"),
        "{error}"
    );
}

#[test]
fn a_byte_order_mark_is_passed_over() {
    let (_folder, scene) = load("\u{feff}newmtl m\nKd 0 1 0\n".as_bytes());
    let scene = scene.expect("a good material");
    assert_eq!(scene.materials[0].albedo, [0.0, 1.0, 0.0]);
}

#[test]
fn numbers_before_the_first_name_are_told_of_once() {
    let (_folder, scene) = load(b"# x\nKd 1 0 0\nmap_Kd a.png\nKa 1 1 1\nnewmtl m\nKd 0 1 0\n");
    let scene = scene.expect("a good material");
    assert_eq!(scene.warnings.len(), 1, "{:?}", scene.warnings);
    let wanted = "model.mtl:2: Kd and 1 more lines stand before the first newmtl: left out";
    assert!(scene.warnings[0].ends_with(wanted), "{}", scene.warnings[0]);
    assert_eq!(scene.materials[0].albedo, [0.0, 1.0, 0.0]);
}

#[test]
fn values_in_messages_are_cut() {
    let long = "n".repeat(250);
    let (_folder, scene) = load(format!("newmtl m\nNs {long}\n").as_bytes());
    let error = scene.expect_err("a file that is wrong").to_string();
    assert!(!error.contains(&long[..65]), "{error}");
}

const RICH: &str = "newmtl m\nKa 1 1 1\nKd 0.8 0.4 0.2\nKs 0.5\nKe 1 0 0\nNs 10.5\nNi 1.45\nd 0.5\n\
                    Tr 0.5\nPr 0.5\nPm 1\nPs 0\nPc 0\naniso 0\nillum 2\nmap_Kd -s 1 1 1 a b.png\n";

proptest! {
    #![proptest_config(mutation::cases(1000))]

    /// Whatever happens to the text, there is a material in range or a message.
    #[test]
    fn mutated_text_never_panics(bytes in mutation::mutated(RICH, b"- 9\nKNPe.#")) {
        let (_folder, scene) = load(&bytes);
        match scene {
            Err(error) => prop_assert!(error.to_string().contains("model.mtl"), "{}", error),
            Ok(scene) => for m in &scene.materials {
                let unit = |x: &f32| (0.0..=1.0).contains(x);
                prop_assert!(m.albedo.iter().chain(&m.f0).all(unit), "{:?}", m);
                prop_assert!(unit(&m.roughness) && unit(&m.opacity), "{:?}", m);
                prop_assert!((0.0..=10_000.0).contains(&m.shininess), "{:?}", m);
                prop_assert!(m.emission.iter().all(|x| x.is_finite() && *x >= 0.0), "{:?}", m);
            }
        }
    }
}
