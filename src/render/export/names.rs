//! How do functions, fields and parameters get their own names back from naga's text?
//!
//! naga makes every name of a module unique, and appends `_` to one that ends in a digit: of two functions that take `f0`,
//! one takes `f0_` and the next `f0_1`. For the program it is the same; for who reads a signature it is not.

use std::collections::HashSet;

use naga::{Module, TypeInner};

use super::sources::words;

/// The text with the names that its GLSL has, wherever they are still free.
pub fn restored(text: &str, module: &Module) -> String {
    let used: HashSet<&str> = words(text).collect();
    let mut text = text.to_owned();
    for name in shared(module) {
        if name.ends_with(|c: char| c.is_ascii_digit()) && !used.contains(name.as_str()) {
            text = replaced(&text, &format!("{name}_"), &name);
        }
    }
    for (_, function) in module.functions.iter() {
        let wanted = function.arguments.iter().filter_map(|a| a.name.as_deref());
        let wanted: Vec<&str> = wanted.collect();
        if let (Some(name), true) = (&function.name, wanted.len() == function.arguments.len()) {
            text = with_parameters(&text, name, &wanted).unwrap_or(text);
        }
    }
    text
}

/// Names of functions, structs, their fields, and constants.
fn shared(module: &Module) -> HashSet<String> {
    let functions = module.functions.iter().filter_map(|(_, f)| f.name.clone());
    let constants = module.constants.iter().filter_map(|(_, c)| c.name.clone());
    let mut names: HashSet<String> = functions.chain(constants).collect();
    for (_, ty) in module.types.iter() {
        names.extend(ty.name.clone());
        if let TypeInner::Struct { members, .. } = &ty.inner {
            names.extend(members.iter().filter_map(|member| member.name.clone()));
        }
    }
    names
}

/// The text with a function's parameters under the names `wanted`, where nothing else in it has them; `None` where it
/// is not found.
fn with_parameters(text: &str, function: &str, wanted: &[&str]) -> Option<String> {
    let start = start_of(text, function)?;
    let end = start + text[start..].find("\n}\n")?;
    let open = start + text[start..].find('(')?;
    let close = open + text[open..].find(')')?;
    let given = text[open + 1..close].split(',').map(parameter);
    let given: Vec<String> = given
        .map(|name| name.unwrap_or_default().to_owned())
        .collect();
    if given.len() != wanted.len() {
        return None;
    }
    let mut own = text[start..end].to_owned();
    for (given, wanted) in given.iter().zip(wanted) {
        let digits = given
            .strip_prefix(wanted)
            .and_then(|rest| rest.strip_prefix('_'));
        let numbered = digits.is_some_and(|digits| digits.bytes().all(|b| b.is_ascii_digit()));
        // `half_` is a keyword's neighbour, and keeps its dash.
        let is_keyword = |name: &str| {
            !name.ends_with(|c: char| c.is_ascii_digit())
                && words(text).any(|w| w == format!("{name}_"))
        };
        if numbered && !is_keyword(wanted) && !words(&own).any(|word| word == *wanted) {
            own = replaced(&own, given, wanted);
        }
    }
    Some(format!("{}{own}{}", &text[..start], &text[end..]))
}

/// Where the line begins that defines a function.
pub fn start_of(text: &str, function: &str) -> Option<usize> {
    let mut at = 0;
    for line in text.split_inclusive('\n') {
        let before = line.split_once('(').map_or("", |(before, _)| before);
        let is_top = !line.starts_with([' ', '\t', '/']);
        if is_top && words(before).last() == Some(function) {
            return Some(at);
        }
        at += line.len();
    }
    None
}

/// The name in `name: type` or `type name`.
fn parameter(text: &str) -> Option<&str> {
    match text.split_once(':') {
        // `metal::float3 N` has a colon too.
        Some((name, rest)) if !rest.starts_with(':') => words(name).last(),
        _ => words(text).last(),
    }
}

/// The text with another word in place of each word `from`.
fn replaced(text: &str, from: &str, to: &str) -> String {
    let mut result = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(place) = rest.find(from) {
        let end = place + from.len();
        let is_word = |c: char| c.is_ascii_alphanumeric() || c == '_';
        let alone = !rest[..place].ends_with(is_word) && !rest[end..].starts_with(is_word);
        result.push_str(&rest[..place]);
        result.push_str(if alone { to } else { from });
        rest = &rest[end..];
    }
    result + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_words_are_replaced() {
        assert_eq!(
            replaced("m2_ + m2_1 + am2_ + m2_", "m2_", "m2"),
            "m2 + m2_1 + am2_ + m2"
        );
        assert_eq!(replaced("", "a", "b"), "");
    }

    #[test]
    fn parameters_of_three_languages_are_found() {
        assert_eq!(parameter("f0_: vec3<f32>"), Some("f0_"));
        assert_eq!(parameter(" float3 f0_1"), Some("f0_1"));
        assert_eq!(parameter("\n    metal::float3 f0_1"), Some("f0_1"));
    }

    #[test]
    fn a_parameter_gets_its_name_where_it_is_free() {
        let text = "fn g(m2_: f32) -> f32 {\n    return m2_;\n}\nfn f(m2_1: f32, half_1: f32, x_2: f32) -> f32 {\n    \
                    var x = half_;\n    return m2_1 + x_2;\n}\n";
        let got = with_parameters(text, "f", &["m2", "half", "x"]).expect("a function");
        let want = "fn f(m2: f32, half_1: f32, x_2: f32) -> f32 {\n    var x = half_;\n    return m2 + x_2;\n}\n";
        assert!(got.ends_with(want), "{got}");
        assert!(got.starts_with("fn g(m2_: f32)"), "{got}");
        assert_eq!(with_parameters(text, "h", &["m2"]), None);
    }
}
