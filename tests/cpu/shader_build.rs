//! Does the shader builder place its errors, rebuild only what changed, and reflect what is declared?

use std::fs;
use std::path::{Path, PathBuf};

use tempfile::TempDir;

use crate::shader_builder::reflect::{Integer, Reflection};
use crate::shader_builder::{
    Error, Report, Stage, agreement, build, compile::compile, include::expand, reflect::reflect,
};

const FRAGMENT: &str = "#version 460\n// Which colour?\nlayout(location = 0) out vec4 colour;\n";

/// A shader folder `glsl` and an output folder `out`, gone at the end.
struct Folder(TempDir);

impl Folder {
    fn new(files: &[(&str, &str)]) -> Self {
        let folder = Self(TempDir::new().expect("a temporary folder"));
        fs::create_dir(folder.0.path().join("out")).expect("a folder");
        for (path, text) in files {
            folder.write(path, text);
        }
        folder
    }

    fn write(&self, path: &str, text: &str) {
        let path = self.glsl().join(path);
        fs::create_dir_all(path.parent().expect("a parent")).expect("a folder");
        fs::write(path, text).expect("a written file");
    }

    fn glsl(&self) -> PathBuf {
        self.0.path().join("glsl")
    }

    fn out(&self) -> PathBuf {
        self.0.path().join("out")
    }

    fn build(&self) -> Result<Report, Vec<Error>> {
        build(&self.glsl(), &self.out(), "test")
    }

    fn reflect(&self, entry: &str) -> Result<Reflection, Vec<Error>> {
        let stage = Stage::of(entry).expect("a stage");
        reflect(&expand(&self.glsl(), entry).expect("an expansion"), stage)
    }

    /// Asserts that the first error stands at `file:line` and says `part`, and that none is told twice.
    fn fails_at(&self, file: &str, line: usize, part: &str) {
        let errors = self.build().expect_err("the build should fail");
        let twice = |(i, error)| errors[..i].contains(error);
        assert!(!errors.iter().enumerate().any(twice), "{errors:?}");
        assert_at(&errors[0], &self.glsl().join(file), line, part);
    }
}

fn assert_at(error: &Error, file: &Path, line: usize, part: &str) {
    let place = (file.display().to_string(), line);
    assert_eq!((error.file.clone(), error.line), place, "{error}");
    assert!(error.message.contains(part), "{error} lacks {part:?}");
}

fn fragment(rest: &str) -> String {
    format!("{FRAGMENT}{rest}")
}

fn names(list: &[&str]) -> Vec<String> {
    list.iter().map(|name| (*name).to_owned()).collect()
}

#[test]
fn an_error_in_an_include_names_its_file_and_line_for_glslang() {
    let main =
        fragment("#include \"a.glsl\"\n#include \"b/c.glsl\"\nvoid main() { colour = f(); }\n");
    let folder = Folder::new(&[
        ("x.frag", &main),
        ("a.glsl", "// What?\n\n\n"),
        (
            "b/c.glsl",
            "// What?\n#include \"a.glsl\"\nvec4 f() {\n    return missing;\n}\n",
        ),
    ]);
    folder.fails_at("b/c.glsl", 4, "'missing' : undeclared identifier");
}

#[test]
fn an_error_after_an_include_names_the_outer_line() {
    let main = fragment("#include \"a.glsl\"\nvoid main() { colour = missing; }\n");
    let folder = Folder::new(&[("x.frag", &main), ("a.glsl", "// What?\n\n\n\n\n")]);
    folder.fails_at("x.frag", 5, "undeclared identifier");
}

#[test]
fn an_error_in_an_include_names_its_file_and_line_for_naga() {
    // glslang knows `precise`, naga does not: this one passes the first compiler.
    let main = fragment("#include \"a.glsl\"\nvoid main() { colour = f(); }\n");
    let body = "// What?\nvec4 f() {\n    precise vec4 v = vec4(1.0);\n    return v;\n}\n";
    let folder = Folder::new(&[("x.frag", &main), ("a.glsl", body)]);
    folder.fails_at("a.glsl", 3, "naga: ");
}

#[test]
fn an_error_that_two_entries_share_is_told_once() {
    let main = fragment("#include \"a.glsl\"\nvoid main() { colour = f(); }\n");
    let folder = Folder::new(&[
        ("x.frag", &main),
        ("y.frag", &main),
        ("a.glsl", "// What?\nvec4 f() { return missing; }\n"),
    ]);
    folder.fails_at("a.glsl", 2, "missing");
}

#[test]
fn a_bad_include_is_refused_where_it_stands() {
    let cases = [
        ("#include \"none.glsl\"", "there is no such file"),
        ("#include \"../out.glsl\"", "plain names"),
        ("#include \"/etc/passwd\"", "plain names"),
        ("#include <a.glsl>", "write it as"),
        ("#include \"a.glsl", "write it as"),
        ("#line 7", "#line is refused"),
    ];
    for (line, part) in cases {
        let main = fragment(&format!("{line}\nvoid main() {{ colour = vec4(1.0); }}\n"));
        Folder::new(&[("x.frag", &main), ("../out.glsl", "")]).fails_at("x.frag", 4, part);
    }
}

#[cfg(unix)]
#[test]
fn a_link_out_of_the_folder_is_refused() {
    let main = fragment("#include \"a.glsl\"\nvoid main() { colour = vec4(1.0); }\n");
    let folder = Folder::new(&[("x.frag", &main), ("../secret", "// What?\n")]);
    let link = folder.glsl().join("a.glsl");
    std::os::unix::fs::symlink("../secret", link).expect("a link");
    folder.fails_at("x.frag", 4, "outside the shader folder");
}

#[test]
fn a_cycle_is_refused_where_it_closes() {
    let main = fragment("#include \"a.glsl\"\nvoid main() { colour = vec4(1.0); }\n");
    let folder = Folder::new(&[
        ("x.frag", &main),
        ("a.glsl", "// What?\n#include \"b.glsl\"\n"),
        ("b.glsl", "// What?\n\n#include \"a.glsl\"\n"),
    ]);
    folder.fails_at("b.glsl", 3, "includes itself");
}

#[test]
fn a_file_is_included_once() {
    let main = fragment(
        "#include \"a.glsl\"\n#include \"b.glsl\"\n#include \"a.glsl\"\nvoid main() { colour = f() + g(); }\n",
    );
    let folder = Folder::new(&[
        ("x.frag", &main),
        ("a.glsl", "// What?\nvec4 f() { return vec4(1.0); }\n"),
        (
            "b.glsl",
            "// What?\n#include \"a.glsl\"\nvec4 g() { return f(); }\n",
        ),
    ]);
    assert_eq!(
        folder.build().expect("a build").compiled,
        names(&["x.frag"])
    );
    let text = expand(&folder.glsl(), "x.frag").expect("an expansion").text;
    assert_eq!(text.matches("vec4 f()").count(), 1);
}

#[test]
fn an_entry_point_opens_with_its_version() {
    let folder = Folder::new(&[("x.frag", "// What?\n#version 460\nvoid main() {}\n")]);
    folder.fails_at("x.frag", 1, "#version 460");
    let folder = Folder::new(&[("x.frag", "#version 460\n// What?\0\nvoid main() {}\n")]);
    folder.fails_at("x.frag", 0, "NUL");
}

#[test]
fn a_folder_without_entry_points_is_an_error() {
    let folder = Folder::new(&[("a.glsl", "// What?\n")]);
    let errors = folder.build().expect_err("nothing to build");
    assert_at(&errors[0], &folder.glsl(), 0, "no *.vert");
}

#[test]
fn a_missing_main_is_told_at_the_entry_point() {
    Folder::new(&[("x.frag", FRAGMENT)]).fails_at("x.frag", 1, "glslang: ");
}

#[test]
fn editing_a_file_recompiles_only_what_includes_it() {
    let x = fragment("#include \"a.glsl\"\nvoid main() { colour = f(); }\n");
    let y = fragment("#include \"b.glsl\"\nvoid main() { colour = g(); }\n");
    let folder = Folder::new(&[
        ("x.frag", &x),
        ("y.frag", &y),
        ("a.glsl", "// What?\nvec4 f() { return vec4(1.0); }\n"),
        ("b.glsl", "// What?\nvec4 g() { return vec4(1.0); }\n"),
    ]);
    let built = |compiled: &[&str], reused: &[&str]| {
        let report = folder.build().expect("a build");
        assert_eq!(
            (report.compiled, report.reused),
            (names(compiled), names(reused))
        );
        fs::read(folder.out().join("shaders.rs")).expect("shaders.rs")
    };
    let first = built(&["x.frag", "y.frag"], &[]);
    assert_eq!(built(&[], &["x.frag", "y.frag"]), first);
    folder.write("b.glsl", "// What?\nvec4 g() { return vec4(2.0); }\n");
    assert_ne!(built(&["y.frag"], &["x.frag"]), first);
    folder.write("b.glsl", "// What?\nvec4 g() { return missing; }\n");
    folder.build().expect_err("an error is not kept for done");
    folder.write("b.glsl", "// What?\nvec4 g() { return vec4(1.0); }\n");
    assert_eq!(built(&["y.frag"], &["x.frag"]), first);
    let other = build(&folder.glsl(), &folder.out(), "another compiler").expect("a build");
    assert_eq!(other.compiled, names(&["x.frag", "y.frag"]));
}

#[test]
fn precise_reaches_glslang_and_is_hidden_from_naga() {
    let with = |word: &str| {
        let body =
            format!("void main() {{ {word} vec4 v = gl_FragCoord; v = v * v + v; colour = v; }}\n");
        let folder = Folder::new(&[("x.frag", &fragment(&body))]);
        folder.build().expect("a build");
        let expanded = expand(&folder.glsl(), "x.frag").expect("an expansion");
        compile(&expanded, Stage::Fragment).expect("SPIR-V")
    };
    // OpDecorate (71), four words with header excluded: target, NoContraction (42).
    let contractions = |words: &[u32]| {
        words
            .windows(3)
            .filter(|w| w[0] == (3 << 16 | 71) && w[2] == 42)
            .count()
    };
    assert_eq!(contractions(&with("")), 0);
    assert!(contractions(&with("PRECISE")) >= 2, "one for *, one for +");
}

/// A struct that packs a vec3 with a float, and arrays, in a block of the given layout.
fn packed(layout: &str) -> Reflection {
    let block = match layout {
        "std140" => "uniform Block { P p; }",
        _ => "readonly buffer Block { P p; }",
    };
    let body = format!(
        "struct P {{ vec3 a; float b; vec3 c; vec2 d; float e[3]; vec4 f; mat3 g; uint h; }};\n\
         layout(set = 0, binding = 5, {layout}) {block};\n\
         void main() {{ colour = p.f; }}\n"
    );
    let folder = Folder::new(&[("x.frag", &fragment(&body))]);
    folder.build().expect("naga and glslang should agree");
    folder.reflect("x.frag").expect("a reflection")
}

#[test]
fn offsets_follow_std140_and_std430() {
    // OpenGL 4.6, 7.6.2.2: e's stride is 16 in std140 and 4 in std430; all else is alike.
    let cases = [
        ("std140", [0, 12, 16, 32, 48, 96, 112, 160], 48, 176),
        ("std430", [0, 12, 16, 32, 40, 64, 80, 128], 12, 144),
    ];
    for (layout, offsets, array, size) in cases {
        let reflection = packed(layout);
        let found = &reflection.structs["P"];
        let found_offsets: Vec<u32> = found.members.iter().map(|m| m.offset).collect();
        assert_eq!(found_offsets, offsets, "{layout}");
        assert_eq!(found.members[4].size, array, "{layout}: float[3]");
        assert_eq!(found.members[0].size, 12, "{layout}: vec3");
        assert_eq!(found.size, size, "{layout}");
        assert_eq!(reflection.bindings["Block"], 5);
    }
}

#[test]
fn a_nested_struct_that_needs_padding_is_refused() {
    // std140 aligns a nested struct to 16; naga 30 leaves it at 4, and its validation says so.
    let body = "struct Q { float a; };\nstruct P { float b; Q c; };\n\
                layout(set = 0, binding = 0, std140) uniform Block { P p; };\n\
                void main() { colour = vec4(p.c.a); }\n";
    let folder = Folder::new(&[("x.frag", &fragment(body))]);
    folder.fails_at("x.frag", 6, "not a multiple of the required alignment 16");
}

#[test]
fn a_layout_that_the_two_compilers_see_differently_is_refused() {
    let body = "struct Q { vec4 a; vec4 b; };\n\
                layout(set = 0, binding = 3, std430) readonly buffer Qs { Q list[]; };\n\
                void main() { colour = list[0].b; }\n";
    let folder = Folder::new(&[("x.frag", &fragment(body))]);
    let expanded = expand(&folder.glsl(), "x.frag").expect("an expansion");
    let words = compile(&expanded, Stage::Fragment).expect("SPIR-V");
    let truth = reflect(&expanded, Stage::Fragment).expect("a reflection");
    assert_eq!(agreement::check(&truth, &words), Ok(()));
    let told = |change: &dyn Fn(&mut Reflection)| {
        let mut reflection = truth.clone();
        change(&mut reflection);
        agreement::check(&reflection, &words).expect_err("a difference")
    };
    let moved = told(&|r| r.structs.get_mut("Q").expect("Q").members[1].offset = 12);
    assert!(
        moved.starts_with("Q.b: naga puts it at 12, glslang at 16"),
        "{moved}"
    );
    let renamed = told(&|r| r.structs.get_mut("Q").expect("Q").members[1].name = "c".into());
    assert!(renamed.starts_with("Q.c: "), "{renamed}");
    let longer = told(&|r| r.structs.get_mut("Q").expect("Q").size = 48);
    assert!(
        longer.starts_with("Q: naga counts 48 bytes, glslang's arrays step 32"),
        "{longer}"
    );
    let bound = told(&|r| *r.bindings.get_mut("Qs").expect("Qs") = 4);
    assert!(
        bound.starts_with("Qs: naga has binding 4, glslang 3"),
        "{bound}"
    );
}

#[test]
fn a_struct_in_two_layouts_is_refused() {
    let body = "struct P { float a[2]; };\n\
                layout(set = 0, binding = 0, std140) uniform U { P u; };\n\
                layout(set = 0, binding = 1, std430) readonly buffer S { P s; };\n\
                void main() { colour = vec4(u.a[0] + s.a[0]); }\n";
    let folder = Folder::new(&[("x.frag", &fragment(body))]);
    folder.fails_at("x.frag", 1, "struct P");
}

#[test]
fn a_third_set_is_refused() {
    let body = "layout(set = 2, binding = 0, std140) uniform U { vec4 u; };\nvoid main() { colour = u; }\n";
    Folder::new(&[("x.frag", &fragment(body))]).fails_at("x.frag", 1, "set 2");
}

#[test]
fn entry_points_that_disagree_are_refused() {
    let with = |member: &str| {
        fragment(&format!(
            "struct P {{ vec4 a; {member} }};\n\
             layout(set = 0, binding = 0, std140) uniform U {{ P u; }};\nvoid main() {{ colour = u.a; }}\n"
        ))
    };
    let folder = Folder::new(&[("x.frag", &with("vec4 b;")), ("y.frag", &with("vec4 c;"))]);
    folder.fails_at("y.frag", 0, "struct P has `c` (16 bytes) at 16 and not `b`");
}

#[test]
fn constants_inputs_and_bindings_are_reflected() {
    let vertex = "#version 460\n// Where?\n\
        layout(constant_id = 3) const int KIND = 2;\n\
        layout(constant_id = 4) const bool FLAG = true;\n\
        const int KIND_A = 0;\nconst int KIND_B = KIND_A - 1;\nconst uint COUNT = 7u;\n\
        struct I { vec4 x; };\n\
        layout(set = 0, binding = 1, std430) readonly buffer Is { I list[]; };\n\
        layout(location = 0) in vec3 position;\nlayout(location = 2) in vec2 uv;\n\
        void main() { const int local = 9; gl_Position = vec4(position, uv.x) + list[gl_InstanceIndex].x\
         + float(FLAG && KIND == KIND_B ? local : COUNT); }\n";
    let fragment = fragment(
        "layout(set = 0, binding = 7) uniform texture2DArray pages;\n\
         layout(set = 0, binding = 8) uniform sampler smooth_sampler;\n\
         void main() { colour = texture(sampler2DArray(pages, smooth_sampler), vec3(0.0)); }\n",
    );
    let folder = Folder::new(&[("x.vert", vertex), ("x.frag", &fragment)]);
    folder.build().expect("a build");
    let found = folder.reflect("x.vert").expect("a reflection");
    let map = |pairs: &[(&str, u32)]| pairs.iter().map(|(n, v)| ((*n).to_owned(), *v)).collect();
    assert_eq!(found.vertex_inputs, map(&[("position", 0), ("uv", 2)]));
    assert_eq!(found.specialization, map(&[("KIND", 3), ("FLAG", 4)]));
    assert_eq!(found.bindings, map(&[("Is", 1)]));
    assert_eq!(found.structs["I"].size, 16);
    assert!(!found.structs.contains_key("Is"), "it has no size");
    let integers = [
        ("KIND_A", Integer::Signed(0)),
        ("KIND_B", Integer::Signed(-1)),
        ("COUNT", Integer::Unsigned(7)),
    ];
    let integers = integers
        .map(|(name, value)| (name.to_owned(), value))
        .into();
    assert_eq!(found.integers, integers);
    let found = folder.reflect("x.frag").expect("a reflection");
    assert_eq!(found.bindings, map(&[("pages", 7), ("smooth_sampler", 8)]));
    let text = fs::read_to_string(folder.out().join("shaders.rs")).expect("shaders.rs");
    for part in [
        "pub const X_VERT: &[u32]",
        "pub const KIND_B: i32 = -1;",
        "pub const pages: u32 = 7;",
    ] {
        assert!(text.contains(part), "{part}");
    }
}

#[test]
fn a_module_that_is_cut_short_is_told() {
    let folder = Folder::new(&[("x.frag", &fragment("void main() { colour = vec4(1.0); }\n"))]);
    let expanded = expand(&folder.glsl(), "x.frag").expect("an expansion");
    let words = compile(&expanded, Stage::Fragment).expect("SPIR-V");
    agreement::check(&Reflection::default(), &words).expect("a whole module");
    let cut = &words[..6];
    agreement::check(&Reflection::default(), cut).expect_err("a module cut short");
    agreement::check(&Reflection::default(), &[0; 6]).expect_err("no module");
}

#[test]
fn the_shaders_that_ship_build() {
    let sources = Path::new(env!("CARGO_MANIFEST_DIR")).join("shaders-glsl");
    let out = TempDir::new().expect("a temporary folder");
    let report = build(&sources, out.path(), "test").unwrap_or_else(|errors| {
        let lines: Vec<String> = errors.iter().map(ToString::to_string).collect();
        panic!("{}", lines.join("\n"))
    });
    assert!(
        report.compiled.contains(&"surface.vert".to_owned()),
        "{report:?}"
    );
    assert!(
        report.compiled.contains(&"surface.frag".to_owned()),
        "{report:?}"
    );
}
