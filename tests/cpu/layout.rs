//! Does a host struct that disagrees with the shader's stop the build, and is the field named?

use std::env;
use std::fs;
use std::process::Command;

use tempfile::TempDir;

/// Compiles a struct `Light` against the shader's `Light { vec4 position; vec3 colour; uint kind; }`,
/// as the build script would reflect it. Returns rustc's errors, empty where it compiles.
fn compile(host: &str) -> String {
    const REFLECTED: &str = "
        #[allow(non_snake_case, non_upper_case_globals, dead_code)]
        mod reflected {
            pub mod Light {
                pub const SIZE: usize = 32;
                pub const position: usize = 0;
                pub const colour: usize = 16;
                pub const kind: usize = 28;
                pub mod sizes {
                    pub const position: usize = 16;
                    pub const colour: usize = 12;
                    pub const kind: usize = 4;
                }
                pub struct Fields { pub position: (), pub colour: (), pub kind: () }
            }
        }";
    let folder = TempDir::new().expect("a temporary folder");
    let source = folder.path().join("host.rs");
    let agree = concat!(env!("CARGO_MANIFEST_DIR"), "/src/interface/agree.rs");
    let text = format!("#[path = {agree:?}]\nmod agree;\nuse agree::agree;\n{REFLECTED}\n{host}\n");
    fs::write(&source, text).expect("a written file");
    let rustc = env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let output = Command::new(rustc)
        .args([
            "--edition",
            "2024",
            "--crate-type",
            "lib",
            "--emit=metadata",
        ])
        .arg("--out-dir")
        .arg(folder.path())
        .arg(&source)
        .output()
        .expect("rustc should start: it built this test");
    let errors = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(
        output.status.success(),
        !errors.contains("error"),
        "{errors}"
    );
    if output.status.success() {
        String::new()
    } else {
        errors
    }
}

/// Asserts that the build stops and that the message names the struct and the field.
fn refused(host: &str, field: &str, part: &str) {
    let errors = compile(host);
    assert!(errors.contains("Light"), "no struct named in: {errors}");
    assert!(errors.contains(field), "no {field} in: {errors}");
    assert!(errors.contains(part), "no {part:?} in: {errors}");
}

const AGREE: &str = "agree!(Light { position, colour, kind });";

fn host(fields: &str) -> String {
    format!("#[repr(C)]\npub struct Light {{ {fields} }}\n{AGREE}")
}

#[test]
fn a_struct_that_agrees_compiles() {
    let errors = compile(&host(
        "pub position: [f32; 4], pub colour: [f32; 3], pub kind: u32",
    ));
    assert_eq!(errors, "");
}

#[test]
fn swapped_fields_are_named() {
    let swapped = host("pub position: [f32; 4], pub kind: u32, pub colour: [f32; 3]");
    refused(&swapped, "Light.colour", "its offset is not the shader's");
    refused(&swapped, "Light.kind", "its offset is not the shader's");
}

#[test]
fn a_wrong_size_is_named() {
    let narrow = host("pub position: [f32; 4], pub colour: [f32; 3], pub kind: u16");
    refused(&narrow, "Light.kind", "its size is not the shader's");
    let wide = host("pub position: [f32; 4], pub colour: [f32; 4], pub kind: u32");
    refused(&wide, "Light.colour", "its size is not the shader's");
    refused(&wide, "Light", "Light: its size is not the shader's");
}

#[test]
fn a_missing_field_is_named() {
    let missing = host("pub position: [f32; 4], pub colour: [f32; 3]");
    refused(&missing, "kind", "error");
}

#[test]
fn a_field_that_the_list_forgets_is_named() {
    let fields = "pub position: [f32; 4], pub colour: [f32; 3], pub kind: u32";
    let list = "agree!(Light { position, colour });";
    let forgotten = format!("#[repr(C)]\npub struct Light {{ {fields} }}\n{list}");
    refused(&forgotten, "`kind`", "missing field");
}

#[test]
fn a_field_that_only_one_side_has_is_named() {
    let fields = "pub position: [f32; 4], pub colour: [f32; 3], pub kind: u32, pub extra: u32";
    let list = "agree!(Light { position, colour, kind, extra });";
    let extra = format!("#[repr(C)]\npub struct Light {{ {fields} }}\n{list}");
    refused(&extra, "`extra`", "has no field named");
    let list = "agree!(Light { position, colour });";
    let lacking = format!(
        "#[repr(C)]\npub struct Light {{ pub position: [f32; 4], pub colour: [f32; 3] }}\n{list}"
    );
    refused(&lacking, "`kind`", "missing field");
}
