//! How is text from a file shown in a message?

use std::path::Path;

/// Characters of a name that a message shows; longer names end in an ellipsis.
const SHOWN: usize = 64;

/// The longest message of a parser that is passed on, in characters: a few names and their frame.
const MESSAGE: usize = 400;

/// `text` as a message quotes it: at most 64 characters, with a mark for each control character. A
/// terminal would obey those, and a name may be as long as its file.
pub(super) fn short(text: &str) -> String {
    cut(text, SHOWN)
}

/// A parser's message, which may quote a file: on one line, without control characters.
pub(super) fn message(text: &str) -> String {
    cut(&text.lines().collect::<Vec<_>>().join("; "), MESSAGE)
}

/// The path of a value in a scene, `light.sun.color`, with each key cut as `short` does.
pub(super) fn key(path: &[&str]) -> String {
    let keys: Vec<String> = path.iter().map(|key| short(key)).collect();
    keys.join(".")
}

/// A file's whole path, since its end says most, with a mark for each control character.
pub(super) fn path(path: &Path) -> String {
    path.to_string_lossy().chars().map(mark).collect()
}

/// Bytes of a file as text of at most 255 characters, without control characters; what is not UTF-8
/// becomes a mark.
pub(super) fn text(bytes: &[u8]) -> String {
    // A character has four bytes at most: no more than these can be shown.
    let bytes = &bytes[..bytes.len().min(4 * LONGEST_NAME)];
    let shown = String::from_utf8_lossy(bytes);
    let shown: String = shown.chars().map(mark).take(LONGEST_NAME).collect();
    shown.trim().to_owned()
}

/// Bytes of a file as a whole text, without control characters.
pub(super) fn whole(bytes: &[u8]) -> String {
    let shown: String = String::from_utf8_lossy(bytes).chars().map(mark).collect();
    shown.trim().to_owned()
}

/// The name of a material as `text` has it. A longer one is refused: cut, two would become one.
pub(super) fn material_name(bytes: &[u8]) -> Result<String, String> {
    let bytes = bytes.trim_ascii();
    let length = String::from_utf8_lossy(bytes).chars().count();
    if length > LONGEST_NAME {
        return Err(format!(
            "a name of {length} characters: at most {LONGEST_NAME} are possible"
        ));
    }
    Ok(text(bytes))
}

/// The longest name that is kept, in characters: each part of a model holds a copy.
const LONGEST_NAME: usize = 255;

fn cut(text: &str, length: usize) -> String {
    let mut shown: String = text.chars().take(length).map(mark).collect();
    if text.chars().nth(length).is_some() {
        shown.push('\u{2026}');
    }
    shown
}

fn mark(c: char) -> char {
    if c.is_control() { '\u{fffd}' } else { c }
}
