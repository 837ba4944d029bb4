//! What is left of an effect's source when it does nothing at all?
//!
//! The hooks, `void` functions whose results go through `inout` parameters, with empty bodies; and the `#include`
//! lines. Constants, bindings, structs, prototypes and helpers go; so a hook's signature may only name what other
//! files declare, and its parameters are never `out`, which an empty body would leave without a value. All other
//! directives go too: nothing in an effect's file stands under an `#if`.

/// The stub of the source of an effect. A helper that returns `void` counts as a hook.
pub fn stub(source: &str) -> String {
    let (includes, code) = without_directives(&without_comments(source));
    let mut stub = includes;
    let mut rest = code.as_str();
    while let Some(at) = end_of_head(rest) {
        let (head, tail) = rest.split_at(at);
        rest = &tail[1..];
        if tail.starts_with(';') {
            continue;
        }
        rest = after_block(rest);
        if is_hook(head) {
            stub.push_str(&format!("{} {{}}\n", head.trim()));
        } else if !head.trim_end().ends_with(')') {
            // A struct, a block or a list of values ends with a semicolon, not with its brace.
            rest = rest.split_once(';').map_or("", |(_, rest)| rest);
        }
    }
    stub
}

/// Each comment replaced by a space, or by the line breaks in it.
fn without_comments(source: &str) -> String {
    let mut code = String::new();
    let mut rest = source;
    while let Some(at) = rest.find('/') {
        code.push_str(&rest[..at]);
        rest = &rest[at..];
        let length = if rest.starts_with("//") {
            rest.find('\n').unwrap_or(rest.len())
        } else if let Some(inside) = rest.strip_prefix("/*") {
            inside.find("*/").map_or(rest.len(), |end| end + 4)
        } else {
            code.push('/');
            rest = &rest[1..];
            continue;
        };
        code.push(' ');
        code.extend(rest[..length].chars().filter(|c| *c == '\n'));
        rest = &rest[length..];
    }
    code + rest
}

/// The `#include` lines, and the text without any directive.
fn without_directives(code: &str) -> (String, String) {
    let (mut includes, mut text) = (String::new(), String::new());
    let mut continued = false;
    for line in code.lines() {
        let directive = line.trim_start().strip_prefix('#');
        if directive.is_some_and(|rest| rest.trim_start().starts_with("include")) {
            includes.push_str(line.trim());
            includes.push('\n');
        } else if directive.is_none() && !continued {
            text.push_str(line);
            text.push('\n');
        }
        continued = (continued || directive.is_some()) && line.ends_with('\\');
    }
    (includes, text)
}

/// Where the next declaration ends or its braces begin: a `;` or `{` outside parentheses.
fn end_of_head(code: &str) -> Option<usize> {
    let mut depth = 0;
    for (at, c) in code.char_indices() {
        match c {
            '(' => depth += 1,
            ')' => depth -= 1,
            ';' | '{' if depth == 0 => return Some(at),
            _ => {}
        }
    }
    None
}

/// What follows the `}` of a block whose `{` is already behind.
fn after_block(code: &str) -> &str {
    let mut depth = 1;
    for (at, c) in code.char_indices() {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return &code[at + 1..];
        }
    }
    ""
}

/// Whether the text before a `{` is `void name(...)`.
fn is_hook(head: &str) -> bool {
    let before = head.split('(').next().unwrap_or_default();
    let words: Vec<&str> = before.split_whitespace().collect();
    head.trim_end().ends_with(')') && matches!(words[..], [.., "void", _])
}
