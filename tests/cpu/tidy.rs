//! Does the tree keep the rules of the house, and is each rule seen failing?

use std::fs;
use std::path::Path;

#[path = "tidy/rules.rs"]
mod rules;
#[path = "tidy/source.rs"]
mod source;

use rules::{
    Tree, check_dependencies, check_file, check_homes, check_question, check_top_level, is_entry,
    is_glsl, is_rust, read_tree,
};

#[test]
fn the_tree_keeps_the_rules() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut tree = Tree::new();
    read_tree(root, root, &mut tree).expect("a readable tree");
    let names: Vec<String> = fs::read_dir(root)
        .expect("a readable folder")
        .map(|item| {
            item.expect("a name")
                .file_name()
                .to_string_lossy()
                .into_owned()
        })
        .collect();
    let ignored = fs::read_to_string(root.join(".gitignore")).unwrap_or_default();
    let mut findings = check_top_level(&names, &ignored);
    findings.extend(check_homes(&tree));
    for (path, text) in &tree {
        findings.extend(check_file(path, text));
    }
    assert!(tree.len() > 10, "the tree was not found: {:?}", tree.keys());
    assert!(findings.is_empty(), "\n{}\n", findings.join("\n"));
}

/// The line numbers of the findings in a file which is fit but for `rest`, from its second line.
fn lines(path: &str, rest: &str) -> Vec<usize> {
    let head = match path {
        path if is_entry(path) => "#version 460\n// What?\n",
        path if is_rust(path) => "//! What?\n",
        path if is_glsl(path) => "// What?\n",
        _ => "\n",
    };
    check_file(path, &format!("{head}{rest}"))
        .iter()
        .filter_map(|found| found.split(':').nth(1)?.parse().ok())
        .collect()
}

#[test]
fn unsafe_and_vulkan_stay_in_gpu() {
    for bad in [
        "unsafe { x() }\n",
        "use ash::vk;\n",
        "let x = ash::vk::A;\n",
        "use gpu_allocator as g;\n",
    ] {
        assert_eq!(lines("src/scene/a.rs", bad), [2], "{bad}");
        assert_eq!(lines("tests/gpu/a.rs", bad), [2], "{bad}");
        assert_eq!(lines("src/gpu/a.rs", bad), [0_usize; 0], "{bad}");
    }
    assert_eq!(
        lines(
            "src/scene/a.rs",
            "let ash = 1; // unsafe, ash::vk\nlet s = \"unsafe\";\n"
        ),
        [0_usize; 0]
    );
}

#[test]
fn floors_point_one_way() {
    let bad = [
        ("src/gpu/a.rs", "use crate::render::Frame;\n"),
        ("src/gpu.rs", "use super::cli;\n"),
        ("src/gpu/mod.rs", "use super::scene;\n"),
        ("src/gpu/a/b.rs", "use super::super::super::scene;\n"),
        ("src/math/a.rs", "use crate::reference::x;\n"),
        (
            "src/render/a.rs",
            "use crate::{\n    gpu::{Device, studies},\n    cli,\n};\n",
        ),
        ("src/scene/mod.rs", "use umber::report;\n"),
        ("src/reference/a.rs", "fn f() { crate::gpu::x() }\n"),
    ];
    for (path, text) in bad {
        assert_eq!(lines(path, text), [2], "{path} {text}");
    }
    let good = [
        ("src/cli/a.rs", "use crate::{render, studies};\n"),
        (
            "src/gpu/a.rs",
            "use super::scene;\nuse crate::gpu::scene;\n",
        ),
        (
            "src/render/mod.rs",
            "use super::gpu;\nuse crate::scene::x;\n",
        ),
        ("src/main.rs", "use umber::cli;\n"),
    ];
    for (path, text) in good {
        assert_eq!(lines(path, text), [0_usize; 0], "{path} {text}");
    }
    assert_eq!(
        lines("src/attic/a.rs", "\n"),
        [1],
        "a floor that nobody knows"
    );
    assert_eq!(
        lines("src/reference/a.rs", "use crate::interface;\n"),
        [2, 2]
    );
}

#[test]
fn files_begin_with_their_question() {
    for path in [
        "src/gpu/a.rs",
        "shaders-glsl/math/a.glsl",
        "shaders-glsl/a.frag",
        "tests/cpu/a.rs",
    ] {
        for bad in [
            "",
            "fn f() {}\n",
            "// This is a file.\n",
            "#version 460\n\n// What?\n",
        ] {
            assert_eq!(check_question(path, bad).len(), 1, "{path} {bad}");
        }
    }
    assert_eq!(
        check_question("shaders-glsl/a.vert", "#version 460\n// What?\n").len(),
        0
    );
    assert_eq!(check_question("shaders-glsl/a.vert", "// What?\n").len(), 1);
    assert_eq!(check_question("src/lib.rs", "//! What?\n").len(), 0);
}

#[test]
fn nothing_is_left_over() {
    let marks = [concat!("// TO", "DO x\n"), concat!("// FIX", "ME\n")];
    for bad in marks.iter().chain(&[
        "fn f() { todo!() }\n",
        "dbg!(x);\n",
        "#[ignore]\n",
        "#[ignore = \"slow\"]\n",
    ]) {
        assert_eq!(lines("src/gpu/a.rs", bad), [2], "{bad}");
    }
    assert_eq!(lines("README.md", marks[0]), [2]);
    assert_eq!(
        lines(
            "src/gpu/a.rs",
            "// todo!() and #[ignore] in prose\nlet ignore = 1;\n"
        ),
        [0_usize; 0]
    );
}

#[test]
fn spaces_are_tidy() {
    assert_eq!(lines("src/gpu/a.rs", "x \n"), [2]);
    assert_eq!(lines("shaders-glsl/math/a.glsl", "\tx\n"), [2]);
    assert_eq!(lines("scenes/a.toml", "a =\t1\n"), [2]);
    assert_eq!(
        lines("Makefile", "\tx\n"),
        [0_usize; 0],
        "make asks for tabs"
    );
    assert_eq!(lines("src/gpu/a.rs", "x"), [2], "no end of line");
}

#[test]
fn nothing_is_too_long() {
    let body = |lines: usize| format!("() {{\n{}}}\n", "x;\n".repeat(lines - 2));
    assert_eq!(lines("src/gpu/a.rs", &format!("fn f{}", body(71))), [2]);
    assert_eq!(
        lines("src/gpu/a.rs", &format!("fn f{}", body(70))),
        [0_usize; 0]
    );
    assert_eq!(
        lines("shaders-glsl/math/a.glsl", &format!("void f{}", body(71))),
        [2]
    );
    assert_eq!(lines("src/gpu/a.rs", &"x;\n".repeat(600)), [601]);
    assert_eq!(lines("src/gpu/a.rs", &"x;\n".repeat(599)), [0_usize; 0]);
}

#[test]
fn shaders_do_not_ask_for_nan() {
    assert_eq!(
        lines("shaders-glsl/math/a.glsl", "x = isnan(y) || isinf(y);\n"),
        [2, 2]
    );
    assert_eq!(
        lines("shaders-glsl/math/a.glsl", "// isnan is folded away\n"),
        [0_usize; 0]
    );
    assert_eq!(lines("src/gpu/a.rs", "isnan(x)\n"), [0_usize; 0]);
}

#[test]
fn models_have_all_their_homes() {
    let tree = |paths: &[&str]| {
        paths
            .iter()
            .map(|path| ((*path).into(), String::new()))
            .collect()
    };
    let brdf = "shaders-glsl/brdf/a.glsl";
    assert_eq!(check_homes(&tree(&[brdf])).len(), 2);
    assert_eq!(check_homes(&tree(&[brdf, "src/reference/a.rs"])).len(), 1);
    assert_eq!(
        check_homes(&tree(&[brdf, "src/reference/a.rs", "tests/cpu/a.rs"])).len(),
        0
    );
    let slides = "shaders-glsl/slides/b.glsl";
    assert_eq!(check_homes(&tree(&[slides])).len(), 1);
    assert_eq!(
        check_homes(&tree(&[slides, "src/reference/slides/b.rs"])).len(),
        0
    );
    assert_eq!(check_homes(&tree(&["shaders-glsl/math/c.glsl"])).len(), 0);
}

#[test]
fn dependencies_say_why() {
    let toml = "[package]\nname = \"x\"\n[dependencies]\n# Why.\na = \"1\"\nb = \"1\"\n\n[dev-dependencies]\nc = \"1\"\n[profile.dev]\nopt-level = 1\n";
    let found = check_dependencies("Cargo.toml", toml);
    let found: Vec<bool> = found
        .iter()
        .map(|f| f.contains(":6:") || f.contains(":9:"))
        .collect();
    assert_eq!(found, [true, true]);
}

#[test]
fn the_top_level_is_closed() {
    let names = ["src", "out", "zoo.png", "notes.txt"].map(str::to_owned);
    let found = check_top_level(&names, "/target\n/out\n/*.png\n");
    assert_eq!(found.len(), 1);
    assert!(found[0].starts_with("notes.txt:"), "{found:?}");
}
