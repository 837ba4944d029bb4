//! Which functions, structs and constants are in the lighting library's GLSL, and what do they need of each other?
//!
//! The files keep the style of the house: a question and what follows it at the top; over each item its comment, without an empty
//! line between them; and a closing bracket at the left margin.

use std::collections::HashSet;
use std::sync::LazyLock;

include!(concat!(env!("OUT_DIR"), "/sources.rs"));

/// A GLSL file.
#[derive(Debug)]
pub struct File {
    /// Where it is in the shader folder.
    pub path: &'static str,
    /// The lines of comment at its top: its question, and what follows.
    pub head: Vec<&'static str>,
    /// What it defines, in order.
    pub items: Vec<Item>,
}

/// What a file defines.
#[derive(Debug)]
pub struct Item {
    /// Its name.
    pub name: &'static str,
    /// What it is.
    pub kind: Kind,
    /// The lines of comment right above it.
    pub comment: Vec<&'static str>,
    /// Its text.
    pub code: &'static str,
}

/// What an item is.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Kind {
    /// `float f(...) { ... }`
    Function,
    /// `struct S { ... };`
    Struct,
    /// Anything else: a constant, or what a function is bound to.
    Value,
}

/// The files, each after those that it includes.
pub static FILES: LazyLock<Vec<File>> = LazyLock::new(|| {
    let mut files = Vec::new();
    for (path, _) in SOURCES {
        push(path, &mut files);
    }
    files
});

fn push(path: &str, files: &mut Vec<File>) {
    let source = SOURCES.iter().find(|(known, _)| *known == path);
    let Some((path, text)) = source else {
        return;
    };
    if files.iter().any(|file| file.path == *path) {
        return;
    }
    for line in text.lines().filter(|line| line.starts_with("#include")) {
        if let Some(included) = line.split('"').nth(1) {
            push(included, files);
        }
    }
    files.push(File::of(path, text));
}

impl File {
    fn of(path: &'static str, text: &'static str) -> Self {
        let is_comment = |line: &&str| line.starts_with("//");
        let head: Vec<_> = text.lines().take_while(is_comment).collect();
        let mut items = Vec::new();
        let mut comment = Vec::new();
        let mut rest = text;
        while let Some(line) = rest.lines().next() {
            let length = match line {
                line if line.starts_with("//") => {
                    comment.push(line);
                    line.len() + 1
                }
                line if line.is_empty() || line.starts_with("#include") => {
                    comment.clear();
                    line.len() + 1
                }
                _ => {
                    let length = item_length(rest);
                    items.push(Item::of(std::mem::take(&mut comment), &rest[..length]));
                    length
                }
            };
            rest = rest.get(length..).unwrap_or_default();
        }
        Self { path, head, items }
    }

    /// `brdf/schlick.glsl` has the stem `schlick`.
    pub fn stem(&self) -> &'static str {
        let name = self.path.rsplit('/').next().unwrap_or_default();
        name.trim_end_matches(".glsl")
    }

    /// Whether it lies in that folder.
    pub fn is_in(&self, folder: &str) -> bool {
        self.path.split('/').next() == Some(folder)
    }

    /// The functions that it defines.
    pub fn functions(&self) -> impl Iterator<Item = &Item> {
        self.items.iter().filter(|item| item.kind == Kind::Function)
    }
}

/// How much of a text its first item is: up to the line in which its brackets are closed and it ends.
fn item_length(text: &str) -> usize {
    let mut length = 0;
    let mut depth = 0_i32;
    for line in text.split_inclusive('\n') {
        length += line.len();
        let code = uncommented(line).trim_end();
        depth += code.matches(['(', '[', '{']).count() as i32;
        depth -= code.matches([')', ']', '}']).count() as i32;
        if depth <= 0 && (code.starts_with('#') || code.ends_with([';', '}'])) {
            break;
        }
    }
    length
}

fn uncommented(line: &str) -> &str {
    line.split_once("//").map_or(line, |(code, _)| code)
}

impl Item {
    fn of(comment: Vec<&'static str>, code: &'static str) -> Self {
        let plain = after_layout(code);
        let end = plain.find(['(', '=', ';', '[', '{']).unwrap_or(plain.len());
        let (before, after) = plain.split_at(end);
        let name = words(before).last().unwrap_or_default();
        let kind = match after.chars().next() {
            _ if plain.starts_with("struct") => Kind::Struct,
            Some('(') => Kind::Function,
            _ => Kind::Value,
        };
        Self {
            name,
            kind,
            comment,
            code,
        }
    }

    /// The words of its code, comments left out.
    pub fn words(&self) -> HashSet<&'static str> {
        self.code
            .lines()
            .flat_map(|line| words(uncommented(line)))
            .collect()
    }

    /// Whether it says PRECISE: it computes with what rounding loses.
    pub fn is_precise(&self) -> bool {
        self.words().contains("PRECISE")
    }
}

/// What follows a `layout(...)`.
fn after_layout(code: &'static str) -> &'static str {
    let rest = code
        .strip_prefix("layout")
        .and_then(|rest| rest.split_once(')'));
    rest.map_or(code, |(_, rest)| rest)
}

/// The names, numbers and keywords in a text.
pub fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| !(c.is_ascii_alphanumeric() || c == '_'))
        .filter(|word| !word.is_empty())
}

/// Those items, and all that they need: in the order of the files.
pub fn with_needs(wanted: &[&str]) -> Vec<(&'static File, Vec<&'static Item>)> {
    let files: &'static [File] = &FILES;
    let all = || files.iter().flat_map(|file| &file.items);
    let mut chosen: HashSet<&str> = HashSet::new();
    let mut open: Vec<&Item> = all().filter(|item| wanted.contains(&item.name)).collect();
    while let Some(item) = open.pop() {
        if chosen.insert(item.name) {
            let words = item.words();
            open.extend(all().filter(|other| words.contains(other.name)));
        }
    }
    let of_file = |file: &'static File| {
        let items = file.items.iter().filter(|item| chosen.contains(item.name));
        let items: Vec<&Item> = items.collect();
        (!items.is_empty()).then_some((file, items))
    };
    files.iter().filter_map(of_file).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "// What?\n// More.\n\n#include \"a/b.glsl\"\n\n// Far above.\n\n// One.\n// Two.\n\
        const float K = 1.0; // trailing (\nfloat f(\n    float x\n) {\n    if (x > 0.0) {\n        return K;\n    }\n\
        \u{20}   return x;\n}\nstruct S {\n    float a; // }\n};\nlayout(set = 0) uniform texture2D t;\n";

    #[test]
    fn a_file_is_its_head_and_its_items() {
        let file = File::of("brdf/one_two.glsl", TEXT);
        assert_eq!(file.head, ["// What?", "// More."]);
        assert_eq!(file.stem(), "one_two");
        assert!(file.is_in("brdf") && !file.is_in("one_two.glsl"));
        let names: Vec<_> = file
            .items
            .iter()
            .map(|item| (item.name, item.kind))
            .collect();
        let want = [
            ("K", Kind::Value),
            ("f", Kind::Function),
            ("S", Kind::Struct),
            ("t", Kind::Value),
        ];
        assert_eq!(names, want);
        assert_eq!(file.items[0].comment, ["// One.", "// Two."]);
        assert!(file.items[1].comment.is_empty());
        let texts: String = file.items.iter().map(|item| item.code).collect();
        assert!(TEXT.ends_with(&texts), "{texts}");
        assert!(file.items[1].words().contains("K"));
        assert!(!file.items[0].words().contains("trailing"));
    }
}
