//! What are the rules of the house, and what does one do about a breach?

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use super::source::{code_of, functions, is_word, line_at, outer_blocks, words};

/// Path from the root, with `/`, and text; bytes that are no UTF-8 are replaced.
pub type Tree = BTreeMap<String, String>;

/// The modules at the root of the crate, lowest first: each may use those before it.
const FLOORS: &[&str] = &[
    "math",
    "reference",
    "interface",
    "shader_build",
    "gpu",
    "scene",
    "render",
    "report",
    "studies",
    "viewer",
    "cli",
];

/// What may lie at the top, beside what `.gitignore` names.
const TOP_LEVEL: &[&str] = &[
    ".ci",
    ".git",
    ".gitignore",
    "Cargo.lock",
    "Cargo.toml",
    "LICENSE-APACHE",
    "LICENSE-MIT",
    "Makefile",
    "README.md",
    "build.rs",
    "fuzz",
    "rustfmt.toml",
    "scenes",
    "shaders-glsl",
    "src",
    "tests",
];

/// Files of `shaders-glsl/brdf` that are no lighting model of their own: nothing in `reference/` has
/// their name.
const BRDF_HELPERS: &[&str] = &[];

const LONGEST_FUNCTION: usize = 70;
const LONGEST_FILE: usize = 600;

fn finding(path: &str, line: usize, what: &str) -> String {
    format!("{path}:{line}: {what}")
}

pub fn is_rust(path: &str) -> bool {
    path.ends_with(".rs")
}

pub fn is_entry(path: &str) -> bool {
    [".vert", ".frag", ".comp"]
        .iter()
        .any(|end| path.ends_with(end))
}

pub fn is_glsl(path: &str) -> bool {
    path.ends_with(".glsl") || is_entry(path)
}

/// The module at the root of the crate to which a source file belongs.
fn floor_of(path: &str) -> Option<&str> {
    let inside = path.strip_prefix("src/")?;
    let name = inside.split('/').next()?.trim_end_matches(".rs");
    (!matches!(name, "lib" | "main")).then_some(name)
}

/// `unsafe` and the Vulkan crates stay where someone looks for them.
fn check_unsafe(path: &str, code: &str) -> Vec<String> {
    if !is_rust(path) || path.starts_with("src/gpu/") {
        return Vec::new();
    }
    words(code)
        .filter_map(|(at, word)| {
            let before = code[..at].trim_end();
            let after = code[at + word.len()..].trim_start();
            let krate =
                after.starts_with("::") || before.ends_with("use") || before.ends_with("crate");
            let what = match word {
                "unsafe" => "`unsafe` belongs in src/gpu/: offer a safe function there",
                "ash" | "gpu_allocator" if krate => {
                    "only src/gpu/ speaks to Vulkan: ask it instead"
                }
                _ => return None,
            };
            Some(finding(path, line_at(code, at), what))
        })
        .collect()
}

/// The truth must not inherit a shader's mistake.
fn check_reference(path: &str, code: &str) -> Vec<String> {
    if floor_of(path) != Some("reference") {
        return Vec::new();
    }
    words(code)
        .filter(|(_, word)| *word == "interface")
        .map(|(at, _)| {
            let what = "reference/ never sees interface: state the formula from its paper";
            finding(path, line_at(code, at), what)
        })
        .collect()
}

/// Floors use only what is below them.
fn check_floors(path: &str, code: &str) -> Vec<String> {
    let Some(floor) = floor_of(path) else {
        return Vec::new();
    };
    let rank = |name: &str| FLOORS.iter().position(|floor| *floor == name);
    let Some(own) = rank(floor) else {
        let what = format!("`{floor}` is on no floor: give it one in FLOORS of tests/cpu/tidy");
        return vec![finding(path, 1, &what)];
    };
    // How many `super::` lead to the root of the crate.
    let depth = path.matches('/').count() - usize::from(path.ends_with("/mod.rs"));
    let to_root = "super::".repeat(depth);
    let mut findings = Vec::new();
    for root in ["crate::", "umber::", &to_root] {
        for (at, _) in code.match_indices(root) {
            if code[..at].ends_with(|c: char| is_word(c) || c == ':') {
                continue;
            }
            for used in path_heads(&code[at + root.len()..]) {
                if rank(used).is_some_and(|used| used > own) {
                    let what = format!("{floor}/ may not use {used}/: move what it needs down");
                    findings.push(finding(path, line_at(code, at), &what));
                }
            }
        }
    }
    findings
}

/// The first names of a path, several where it begins with a group in braces.
fn path_heads(after: &str) -> Vec<&str> {
    let head = |text| words(text).next().map(|(_, word)| word);
    let Some(group) = after.strip_prefix('{') else {
        return head(after).into_iter().collect();
    };
    let mut heads = Vec::new();
    let mut depth = 0;
    let mut start = 0;
    for (at, c) in group.char_indices() {
        match c {
            '{' => depth += 1,
            '}' | ',' if depth == 0 => {
                heads.extend(head(&group[start..at]));
                start = at + 1;
                if c == '}' {
                    break;
                }
            }
            '}' => depth -= 1,
            _ => {}
        }
    }
    heads
}

/// A file answers one question, and says it in its first line.
pub fn check_question(path: &str, text: &str) -> Vec<String> {
    let mut lines = text.lines();
    let mut number = 1;
    if is_entry(path) {
        if lines.next() != Some("#version 460") {
            return vec![finding(path, 1, "the first line must be `#version 460`")];
        }
        number = 2;
    }
    let mark = match path {
        path if is_rust(path) => "//! ",
        path if is_glsl(path) => "// ",
        _ => return Vec::new(),
    };
    match lines.next() {
        Some(line) if line.starts_with(mark) && line.contains('?') => Vec::new(),
        _ => {
            let what = format!("begin with `{mark}` and the question that the file answers");
            vec![finding(path, number, &what)]
        }
    }
}

/// What is unfinished, or left from debugging.
fn check_leftovers(path: &str, text: &str, code: &str) -> Vec<String> {
    let mut findings = Vec::new();
    for (at, word) in words(text) {
        if [concat!("TO", "DO"), concat!("FIX", "ME")].contains(&word) {
            findings.push(finding(
                path,
                line_at(text, at),
                "do it now, or open an issue",
            ));
        }
    }
    if !is_rust(path) {
        return findings;
    }
    for (at, word) in words(code) {
        let (before, after) = (&code[..at], &code[at + word.len()..]);
        let what = match word {
            "todo" | "unimplemented" if after.starts_with('!') => "write it, or leave it out",
            "dbg" if after.starts_with('!') => "take the debugging print out",
            "ignore" if before.ends_with("#[") => "a test runs or goes: nothing is ignored",
            _ => continue,
        };
        findings.push(finding(path, line_at(code, at), what));
    }
    findings
}

/// Spaces as an editor should leave them.
fn check_spaces(path: &str, text: &str) -> Vec<String> {
    let no_tabs = is_rust(path) || is_glsl(path) || path.ends_with(".toml");
    let mut findings = Vec::new();
    for (number, line) in (1..).zip(text.lines()) {
        if line.ends_with([' ', '\t']) {
            findings.push(finding(
                path,
                number,
                "take the space at the end of the line away",
            ));
        }
        if no_tabs && line.contains('\t') {
            findings.push(finding(path, number, "write the tab as spaces"));
        }
    }
    if !text.is_empty() && !text.ends_with('\n') {
        findings.push(finding(path, text.lines().count(), "end the last line"));
    }
    findings
}

/// What is too long to hold in the head.
fn check_lengths(path: &str, code: &str) -> Vec<String> {
    let blocks = match path {
        path if is_rust(path) => functions(code),
        path if is_glsl(path) => outer_blocks(code),
        _ => return Vec::new(),
    };
    let mut findings = Vec::new();
    for (first, last) in blocks {
        let lines = last - first + 1;
        if lines > LONGEST_FUNCTION {
            let what = format!("{lines} lines: split it, {LONGEST_FUNCTION} are the most");
            findings.push(finding(path, first, &what));
        }
    }
    let lines = code.lines().count();
    if lines > LONGEST_FILE {
        let what = format!("{lines} lines: split the file, {LONGEST_FILE} are the most");
        findings.push(finding(path, LONGEST_FILE + 1, &what));
    }
    findings
}

/// A driver may fold these away, so no shader relies on them.
fn check_folded(path: &str, code: &str) -> Vec<String> {
    if !is_glsl(path) {
        return Vec::new();
    }
    words(code)
        .filter(|(_, word)| matches!(*word, "isnan" | "isinf"))
        .map(|(at, word)| {
            let what = format!("a driver may fold `{word}` away: test a range instead");
            finding(path, line_at(code, at), &what)
        })
        .collect()
}

/// A lighting model's homes share a name.
pub fn check_homes(tree: &Tree) -> Vec<String> {
    let mut findings = Vec::new();
    for path in tree.keys() {
        let Some(inside) = path.strip_prefix("shaders-glsl/") else {
            continue;
        };
        let homes = match inside.trim_end_matches(".glsl").split_once('/') {
            Some(("brdf", name)) if !BRDF_HELPERS.contains(&name) => {
                vec![
                    format!("src/reference/{name}.rs"),
                    format!("tests/cpu/{name}.rs"),
                ]
            }
            Some(("slides", name)) => vec![format!("src/reference/slides/{name}.rs")],
            _ => continue,
        };
        for home in homes.into_iter().filter(|home| !tree.contains_key(home)) {
            findings.push(finding(
                path,
                1,
                &format!("{home} is missing: each model has its truth and test"),
            ));
        }
    }
    findings
}

/// Each dependency says what it is for.
pub fn check_dependencies(path: &str, text: &str) -> Vec<String> {
    let mut findings = Vec::new();
    let mut inside = false;
    let mut before = "";
    for (number, line) in (1..).zip(text.lines()) {
        if line.starts_with('[') {
            inside = line.trim_end_matches(']').ends_with("dependencies");
        } else if inside && line.starts_with(is_word) && !before.starts_with('#') {
            findings.push(finding(
                path,
                number,
                "say in a comment line above what it is for",
            ));
        }
        before = line;
    }
    findings
}

/// The top level is short enough to be read.
pub fn check_top_level(names: &[String], ignored: &str) -> Vec<String> {
    let ignores = |name: &str| {
        ignored.lines().any(|line| {
            let pattern = line.trim_matches('/');
            let ending = pattern.strip_prefix('*');
            pattern == name || ending.is_some_and(|ending| name.ends_with(ending))
        })
    };
    names
        .iter()
        .filter(|name| !TOP_LEVEL.contains(&name.as_str()) && !ignores(name))
        .map(|name| {
            finding(
                name,
                1,
                "does not belong at the top: move it, or list it in TOP_LEVEL of tests/cpu/tidy",
            )
        })
        .collect()
}

/// All findings in one file.
pub fn check_file(path: &str, text: &str) -> Vec<String> {
    let code = code_of(text);
    let mut findings = check_unsafe(path, &code);
    findings.extend(check_reference(path, &code));
    findings.extend(check_floors(path, &code));
    findings.extend(check_question(path, text));
    findings.extend(check_leftovers(path, text, &code));
    findings.extend(check_spaces(path, text));
    findings.extend(check_lengths(path, &code));
    findings.extend(check_folded(path, &code));
    if path.ends_with("Cargo.toml") {
        findings.extend(check_dependencies(path, text));
    }
    findings
}

/// Reads the text files under `folder` into `tree`; pictures and meshes have no house style.
pub fn read_tree(root: &Path, folder: &Path, tree: &mut Tree) -> std::io::Result<()> {
    const TEXT: &[&str] = &[
        "rs", "glsl", "vert", "frag", "comp", "toml", "md", "sh", "Makefile", "need", "as-user",
        "run",
    ];
    for item in fs::read_dir(folder)? {
        let path = item?.path();
        let name = path
            .file_name()
            .map(|name| name.to_string_lossy().into_owned());
        let name = name.unwrap_or_default();
        if path.is_dir() {
            if !matches!(name.as_str(), ".git" | "target" | "out") {
                read_tree(root, &path, tree)?;
            }
        } else if TEXT.contains(&name.rsplit('.').next().unwrap_or_default()) {
            let inside = path.strip_prefix(root).unwrap_or(&path);
            let inside = inside.to_string_lossy().replace('\\', "/");
            tree.insert(
                inside,
                String::from_utf8_lossy(&fs::read(&path)?).into_owned(),
            );
        }
    }
    Ok(())
}
