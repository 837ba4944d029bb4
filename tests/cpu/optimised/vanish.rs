//! Does an effect whose constant is 0 leave nothing behind, as if its file had never been written?
//!
//! The entry point with the constant frozen to 0 is held against the one whose effect file is replaced by its stub.

use std::fs;
use std::path::Path;

use tempfile::TempDir;

use super::remains::{Remains, remains};
use super::stub::stub;

/// Fails unless `effect_file` of `folder` (a path inside it) leaves nothing in `entry` where the constant
/// `constant_name` is 0, and something where it is 1. `others` are frozen beside it.
#[track_caller]
pub fn assert_vanishes(
    folder: &Path,
    entry: &str,
    effect_file: &str,
    constant_name: &str,
    others: &[(&str, i32)],
) {
    let left = what_is_left(folder, entry, effect_file, constant_name, others);
    assert!(
        left.is_empty(),
        "{entry}, {effect_file} with {constant_name} = 0 and {others:?}:\n{}\n",
        left.join("\n")
    );
}

/// One line for each difference between the effect that is off and its stub; none where it vanishes.
#[track_caller]
pub fn what_is_left(
    folder: &Path,
    entry: &str,
    effect_file: &str,
    constant_name: &str,
    others: &[(&str, i32)],
) -> Vec<String> {
    let with = |value| remains(folder, entry, &[others, &[(constant_name, value)]].concat());
    let (off, on) = (with(0), with(1));

    let copy = TempDir::new().expect("a temporary folder");
    copy_folder(folder, copy.path());
    let path = copy.path().join(effect_file);
    let source = fs::read_to_string(&path).unwrap_or_else(|error| panic!("{effect_file}: {error}"));
    fs::write(&path, stub(&source)).expect("a written stub");
    let stubbed = remains(copy.path(), entry, others);

    let mut lines = differences(&off, &stubbed);
    if on == off {
        lines.push(format!(
            "{constant_name} = 1 changes nothing: is a hook called, and does it ask?"
        ));
    }
    lines
}

/// What `off` has beyond `stubbed`, and the other way round.
fn differences(off: &Remains, stubbed: &Remains) -> Vec<String> {
    let mut lines = Vec::new();
    for (what, off, stubbed) in [
        ("function", &off.functions, &stubbed.functions),
        ("variable", &off.variables, &stubbed.variables),
    ] {
        lines.extend(
            off.difference(stubbed)
                .map(|name| format!("{what} {name} is left")),
        );
        let missing = stubbed.difference(off);
        lines.extend(missing.map(|name| format!("{what} {name} is in the stub's shader only")));
    }
    for (binding, name) in &off.bindings {
        if !stubbed.bindings.contains_key(binding) {
            lines.push(format!("binding {binding}, {name}, is left"));
        }
    }
    let unlike = off.code.iter().zip(&stubbed.code).find(|(a, b)| a != b);
    if let Some((off, stubbed)) = unlike {
        lines.push(format!(
            "`{off}` stands where the stub's shader has `{stubbed}`"
        ));
    }
    if off.opcodes != stubbed.opcodes {
        let count = |remains: &Remains, opcode| remains.opcodes.get(opcode).copied().unwrap_or(0);
        let all = off.opcodes.keys().chain(stubbed.opcodes.keys());
        let mut changed: Vec<String> = all
            .map(|opcode| (opcode, count(off, opcode), count(stubbed, opcode)))
            .filter(|(_, off, stubbed)| off != stubbed)
            .map(|(opcode, off, stubbed)| format!("{opcode} {off} (stub {stubbed})"))
            .collect();
        changed.sort();
        changed.dedup();
        lines.push(format!(
            "{} instructions, and {} with the stub: {}",
            off.instructions,
            stubbed.instructions,
            changed.join(", ")
        ));
    }
    lines
}

fn copy_folder(from: &Path, to: &Path) {
    fs::create_dir_all(to).expect("a folder");
    for item in fs::read_dir(from).expect("a readable folder") {
        let path = item.expect("a name").path();
        let copy = to.join(path.file_name().expect("a name"));
        if path.is_dir() {
            copy_folder(&path, &copy);
        } else {
            fs::copy(&path, &copy).expect("a copied file");
        }
    }
}
