//! How does the host see the shaders: as which Rust constants?
//!
//! `spirv` holds the modules; `reflected` holds what `agree!` compares the host's structs with.

use std::collections::BTreeMap;
use std::fmt::{Display, Write as _};

use super::Entry;
use super::reflect::{Integer, Reflection, Struct};

/// The text of `shaders.rs`.
#[must_use]
pub fn rust(entries: &[Entry], all: &Reflection) -> String {
    let mut text = String::from(
        "// Made from the GLSL sources by the build script; names are the shaders' own.\n\
         /// The SPIR-V modules, one for each entry point.\npub mod spirv {\n",
    );
    for entry in entries {
        let constant = entry.name.replace(['.', '-'], "_").to_uppercase();
        line(&mut text, format_args!("    /// `{}`", entry.name));
        line(
            &mut text,
            format_args!("    pub const {constant}: &[u32] = &["),
        );
        for words in entry.words.chunks(12) {
            let row: Vec<String> = words.iter().map(|word| format!("{word},")).collect();
            line(&mut text, format_args!("        {}", row.join(" ")));
        }
        text.push_str("    ];\n");
    }
    text.push_str(
        "}\n/// Offsets, sizes (bytes), bindings, locations and constants, as the shaders have them.\n\
         #[allow(non_snake_case, non_upper_case_globals, dead_code, missing_docs)]\n\
         pub mod reflected {\n",
    );
    for (name, layout) in &all.structs {
        one_struct(&mut text, name, layout);
    }
    numbers(
        &mut text,
        "bindings",
        "numbers in their descriptor set",
        &all.bindings,
    );
    numbers(&mut text, "vertex_inputs", "locations", &all.vertex_inputs);
    numbers(
        &mut text,
        "constants",
        "ids of specialization constants",
        &all.specialization,
    );
    text.push_str(
        "    /// Integer constants, as the shaders declare them.\n    pub mod values {\n",
    );
    for (name, value) in &all.integers {
        let (ty, value) = match value {
            Integer::Signed(value) => ("i32", value.to_string()),
            Integer::Unsigned(value) => ("u32", value.to_string()),
        };
        line(
            &mut text,
            format_args!("        pub const {name}: {ty} = {value};"),
        );
    }
    text.push_str("    }\n}\n");
    text
}

/// `Fields` mirrors the member names, so that rustc can tell which one a list lacks.
fn one_struct(text: &mut String, name: &str, layout: &Struct) {
    line(text, format_args!("    pub mod {name} {{"));
    line(
        text,
        format_args!("        pub const SIZE: usize = {};", layout.size),
    );
    for member in &layout.members {
        line(
            text,
            format_args!(
                "        pub const {}: usize = {};",
                member.name, member.offset
            ),
        );
    }
    text.push_str("        pub mod sizes {\n");
    for member in &layout.members {
        line(
            text,
            format_args!(
                "            pub const {}: usize = {};",
                member.name, member.size
            ),
        );
    }
    text.push_str("        }\n        pub struct Fields {\n");
    for member in &layout.members {
        line(text, format_args!("            pub {}: (),", member.name));
    }
    text.push_str("        }\n    }\n");
}

fn numbers(text: &mut String, module: &str, what: &str, map: &BTreeMap<String, u32>) {
    line(
        text,
        format_args!("    /// By name: {what}.\n    pub mod {module} {{"),
    );
    for (name, number) in map {
        line(
            text,
            format_args!("        pub const {name}: u32 = {number};"),
        );
    }
    text.push_str("    }\n");
}

fn line(text: &mut String, line: impl Display) {
    // Writing to a String cannot fail.
    let _ = writeln!(text, "{line}");
}
