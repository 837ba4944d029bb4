//! Does what is switched off vanish from a shader, and would it be noticed if it did not?
//!
//! An effect is one file with a constant, whose value 0 says never, 1 always, and -1 that the material decides. For
//! each effect call [`assert_vanishes`].

use std::fs;
use std::path::{Path, PathBuf};

use tempfile::TempDir;

mod remains;
mod stub;
mod vanish;

pub use remains::remains;
pub use vanish::{assert_vanishes, what_is_left};

use remains::{Remains, made};
use stub::stub;

const SHADERS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/shaders-glsl");

fn surface(frozen: &[(&str, i32)]) -> Remains {
    remains(Path::new(SHADERS), "surface.frag", frozen)
}

#[test]
fn phong_keeps_nothing_of_the_other_models() {
    let (phong, corrected) = (surface(&[("LIGHTING", 0)]), surface(&[("LIGHTING", 2)]));
    assert!(phong.functions.contains("PhongSpecular"), "{phong:?}");
    assert!(
        corrected.functions.contains("cook_torrance_facets"),
        "{corrected:?}"
    );
    for name in phong.names() {
        let name = name.to_lowercase();
        for other in ["cook", "torrance", "oren", "nayar", "coupled", "beckmann"] {
            assert!(!name.contains(other), "{name} is left");
        }
    }
    assert!(phong.instructions < corrected.instructions);
    assert_eq!(phong.instructions, phong.opcodes.values().sum::<usize>());
}

#[test]
fn what_remains_is_the_same_each_time() {
    let once = surface(&[("LIGHTING", 1)]);
    assert_eq!(once, surface(&[("LIGHTING", 1)]));
    // The default is frozen too.
    assert_eq!(surface(&[]), surface(&[("LIGHTING", 2)]));
}

#[test]
fn without_terms_the_lights_are_walked_for_nothing() {
    let none = surface(&[
        ("TERM_AMBIENT", 0),
        ("TERM_DIFFUSE", 0),
        ("TERM_SPECULAR", 0),
    ]);
    for gone in ["cook_torrance_facets", "oren_nayar", "hemisphere_diffuse"] {
        assert!(!none.functions.contains(gone), "{gone} is left");
    }
    assert!(none.instructions < surface(&[]).instructions);
    // spirv-opt does not prove that the loop ends, so it keeps the loop and with it the lights.
    assert_eq!(
        none.bindings.get(&3).map(String::as_str),
        Some("LightBlock")
    );
}

#[test]
fn what_cannot_be_had_is_told_in_one_line() {
    let why = made("spirv-none", &[], b"").expect_err("no such tool");
    assert!(
        why.starts_with("spirv-none is not here: `make test` installs it"),
        "{why}"
    );
    assert!(!why.contains('\n'));
    let why = made("spirv-opt", &[], b"no module").expect_err("no module");
    assert!(why.starts_with("spirv-opt: "), "{why}");
}

#[test]
#[should_panic(expected = "surface.frag: no constant_id belongs to LIGHTNING")]
fn an_unknown_constant_is_refused() {
    surface(&[("LIGHTNING", 0)]);
}

const ENTRY: &str = "#version 460\n// Which colour?\n\
    #include \"surface.glsl\"\n#include \"effects/glow.glsl\"\n\
    layout(location = 0) flat in uint in_effects;\nlayout(location = 1) in vec3 in_normal;\n\
    layout(location = 0) out vec4 colour;\n\
    void main() {\n\
        Surface surface = Surface(in_normal, vec3(0.5));\n\
        Material material = Material(vec3(0.1), in_effects);\n\
        glow_bends(surface, material);\n\
        vec3 sum = surface.N * surface.albedo;\n\
        for (uint i = 0u; i < in_effects; i++) {\n\
            if (sum[i % 3u] < 0.0) {\n                continue;\n            }\n\
            vec3 one = surface.albedo * float(i);\n\
            glow_adds(one, surface, material);\n\
            sum += one;\n        }\n\
        colour = vec4(sum, 1.0);\n\
    }\n";

const SHARED: &str = "// What do all effects share?\n\
    struct Surface { vec3 N; vec3 albedo; };\nstruct Material { vec3 albedo; uint effects; };\n\
    bool called_for(int effect, uint word, uint bit) {\n\
        if (effect >= 0) {\n        return effect != 0;\n    }\n    return (word & bit) != 0u;\n}\n";

/// All that the convention allows, with early returns inside the hooks beside the guard.
const GLOW: &str = "// Does it glow?\n\
    #include \"surface.glsl\"\n\
    layout(constant_id = 9) const int EFFECT_GLOW = -1; // -1: the material decides\n\
    layout(set = 0, binding = 6, std430) readonly buffer GlowBlock {\n    vec4 glows[];\n};\n\
    struct Ember { vec3 colour; float heat; };\n\
    const float GLOW_TABLE[3] = float[3](0.1, 0.2, 0.3);\n\
    const uint GLOW_BIT = 4u;\n\
    vec3 glow_scratch = vec3(0.25);\n\
    Ember ember_of(vec3 N) {\n\
        vec4 found = glows[int(abs(N.x) * 8.0)];\n\
        if (found.w < 0.0) {\n        return Ember(vec3(0.0), 0.0);\n    }\n\
        for (int i = 0; i < 3; i++) {\n            found += GLOW_TABLE[i] * sin(found);\n        }\n\
        return Ember(found.rgb, found.a);\n\
    }\n\
    void glow_bends(inout Surface surface, Material material) {\n\
        if (!called_for(EFFECT_GLOW, material.effects, GLOW_BIT)) return;\n\
        Ember ember = ember_of(surface.N);\n\
        if (ember.heat > 7.0) {\n            return;\n        }\n\
        surface.N = normalize(surface.N + ember.colour);\n\
    }\n\
    void glow_adds(\n    inout vec3 sum, // so far\n    Surface surface, /* bent; */ Material material\n) {\n\
        if (!called_for(EFFECT_GLOW, material.effects, GLOW_BIT)) {\n            return;\n        }\n\
        for (int i = 0; i < 4; i++) {\n            if (sum[i % 3] > 9.0) {\n                return;\n            }\n        }\n\
        glow_scratch += ember_of(surface.N).colour;\n\
        sum += glow_scratch * cross(surface.N, sum);\n\
    }\n";

/// A shader folder with one effect.
fn folder(glow: &str) -> (TempDir, PathBuf) {
    let folder = TempDir::new().expect("a temporary folder");
    let path = folder.path().to_owned();
    fs::create_dir(path.join("effects")).expect("a folder");
    for (file, text) in [
        ("x.frag", ENTRY),
        ("surface.glsl", SHARED),
        ("effects/glow.glsl", glow),
    ] {
        fs::write(path.join(file), text).expect("a written file");
    }
    (folder, path)
}

/// What is left of an effect like GLOW, but with `new` in the place of `old`.
fn left_with(old: &str, new: &str) -> String {
    assert!(GLOW.contains(old), "{old} is not in the effect");
    let (_kept, path) = folder(&GLOW.replace(old, new));
    what_is_left(&path, "x.frag", "effects/glow.glsl", "EFFECT_GLOW", &[]).join("\n")
}

#[test]
fn an_effect_that_keeps_the_convention_vanishes() {
    let (_kept, path) = folder(GLOW);
    assert_vanishes(&path, "x.frag", "effects/glow.glsl", "EFFECT_GLOW", &[]);
    let with = |value| remains(&path, "x.frag", &[("EFFECT_GLOW", value)]);
    let (off, on, asked) = (with(0), with(1), with(-1));
    assert_eq!(off.functions.iter().collect::<Vec<_>>(), ["main"]);
    assert!(off.bindings.is_empty(), "{off:?}");
    for name in ["ember_of", "glow_bends", "glow_adds"] {
        assert!(on.functions.contains(name), "{name}: {on:?}");
    }
    assert!(asked.functions.contains("called_for"), "{asked:?}");
    assert_eq!(on.bindings.get(&6).map(String::as_str), Some("GlowBlock"));
    assert!(off.instructions < on.instructions && on.instructions < asked.instructions);
}

const GUARD: &str = "if (!called_for(EFFECT_GLOW, material.effects, GLOW_BIT)) return;\n";

#[test]
fn a_hook_that_writes_before_its_guard_is_seen() {
    let left = left_with(GUARD, &format!("surface.N *= 2.0;\n{GUARD}"));
    assert!(left.contains("function glow_bends is left"), "{left}");
    assert!(left.contains("instructions, and"), "{left}");
    assert!(left.contains("OpVectorTimesScalar 2 (stub 1)"), "{left}");
}

/// It leaves as many instructions as the stub: only a number is another.
#[test]
fn a_hook_that_changes_a_constant_before_its_guard_is_seen() {
    let left = left_with(GUARD, &format!("surface.albedo = vec3(0.75);\n{GUARD}"));
    assert!(left.contains("0.75"), "{left}");
    assert!(!left.contains("instructions, and"), "{left}");
}

#[test]
fn a_hook_that_reads_a_binding_before_its_guard_is_seen() {
    let left = left_with(GUARD, &format!("surface.albedo += glows[0].rgb;\n{GUARD}"));
    for part in [
        "variable GlowBlock is left",
        "binding 6, GlowBlock, is left",
    ] {
        assert!(left.contains(part), "{left}");
    }
}

#[test]
fn a_helper_without_a_guard_is_named() {
    let left = left_with(GUARD, "");
    for part in ["function ember_of is left", "function glow_bends is left"] {
        assert!(left.contains(part), "{left}");
    }
    assert!(!left.contains("glow_adds"), "{left}");
}

#[test]
fn a_switch_that_the_constant_does_not_turn_is_seen() {
    let left = left_with("GLOW_BIT = 4u", "GLOW_BIT = 4u, GLOW_IT = 4u");
    assert_eq!(left, "", "a constant more is nothing");
    // The constant -1 for both, so that the material decides whatever the variant says.
    let left = left_with(
        "called_for(EFFECT_GLOW,",
        "called_for(min(EFFECT_GLOW, -1),",
    );
    assert!(left.contains("function called_for is left"), "{left}");
    assert!(left.contains("EFFECT_GLOW = 1 changes nothing"), "{left}");
}

#[test]
#[should_panic(expected = "function glow_bends is left")]
fn a_leak_fails() {
    let (_kept, path) = folder(&GLOW.replace(GUARD, &format!("surface.N *= 2.0;\n{GUARD}")));
    assert_vanishes(&path, "x.frag", "effects/glow.glsl", "EFFECT_GLOW", &[]);
}

#[test]
fn a_stub_keeps_hooks_and_includes() {
    let want = "#include \"surface.glsl\"\n\
        void glow_bends(inout Surface surface, Material material) {}\n\
        void glow_adds(\n    inout vec3 sum,  \n    Surface surface,   Material material\n) {}\n";
    assert_eq!(stub(GLOW), want);
    assert_eq!(stub(want), want);
}

#[test]
fn a_stub_is_made_of_any_source() {
    for (source, want) in [
        ("", ""),
        ("// void f() { }\n", ""),
        ("/* void f() {} */ void g() { /* } */ }", "void g() {}\n"),
        (
            "void f(int a);\nvoid f(int a) { if (a > 0) { return; } }",
            "void f(int a) {}\n",
        ),
        (
            "PRECISE void f(inout vec3 v) { v /= 2.0; }",
            "PRECISE void f(inout vec3 v) {}\n",
        ),
        ("void\nf\n(\nint a\n)\n{ }", "void\nf\n(\nint a\n) {}\n"),
        (
            "float f() { return 1.0 / 2.0; } void g() { f(); }",
            "void g() {}\n",
        ),
        ("struct S { int a; } s; void g() {}", "void g() {}\n"),
        ("const int a[2] = { 1, 2 }; void g() {}", "void g() {}\n"),
        ("#define F(x) { \\\n  x ( \nvoid g() {}", "void g() {}\n"),
        ("  # include \"a.glsl\" // why\n", "# include \"a.glsl\"\n"),
        ("void g() { // }\n", "void g() {}\n"),
        ("float voided() { return 1.0; }", ""),
        ("/* never closed", ""),
    ] {
        assert_eq!(stub(source), want, "{source}");
    }
}
