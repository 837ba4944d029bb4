//! Where does what naga drops, the comments, stand in the text that it writes?

use std::collections::BTreeMap;

use super::names::start_of;
use super::sources::{File, Item, Kind, words};
use super::{heading, lines};

/// The text with each item's comment over it, and each file's heading over the first of its functions.
///
/// # Errors
/// An item is not in the text.
pub fn put_back(
    text: &str,
    chosen: &[(&'static File, Vec<&'static Item>)],
) -> Result<String, String> {
    let mut over: BTreeMap<usize, String> = BTreeMap::new();
    for (file, items) in chosen {
        let mut heading = Some(heading(file));
        let has_function = items.iter().any(|item| item.kind == Kind::Function);
        for item in items {
            let place = place_of(text, item)
                .ok_or_else(|| format!("it left out {} of {}", item.name, file.path))?;
            let comment = over.entry(place).or_default();
            if item.kind == Kind::Function || !has_function {
                let heading = heading.take().unwrap_or_default();
                comment.extend(heading.iter().map(|line| format!("{line}\n")));
                comment.push_str(if heading.is_empty() { "" } else { "\n" });
            }
            comment.push_str(&lines(&item.comment));
            comment.extend(fields(item));
        }
    }
    let mut result = String::from("\n");
    let mut done = 0;
    for (place, comment) in over {
        result.push_str(&text[done..place]);
        result.push_str(&comment);
        done = place;
    }
    Ok(result + &text[done..])
}

/// What a struct says of its fields.
fn fields(item: &Item) -> Vec<String> {
    if item.kind != Kind::Struct {
        return Vec::new();
    }
    let told = |line: &str| {
        let (code, comment) = line.split_once("//")?;
        let field = words(code).last()?;
        Some(format!("// {field}: {}\n", comment.trim()))
    };
    item.code.lines().filter_map(told).collect()
}

/// Where the line begins that defines an item: at the left margin.
fn place_of(text: &str, item: &Item) -> Option<usize> {
    if item.kind == Kind::Function {
        return start_of(text, item.name);
    }
    let mut at = 0;
    for line in text.split_inclusive('\n') {
        let before = line.split(['=', ':', '{', ';']).next().unwrap_or_default();
        let is_top = !line.starts_with([' ', '\t', '/', '}', '#']);
        if is_top && words(before).last() == Some(item.name) {
            return Some(at);
        }
        at += line.len();
    }
    None
}
