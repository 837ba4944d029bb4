//! What is code in a Rust or GLSL file, and what is comment or text?

/// The file with the insides of comments, strings and characters blanked, line by line as it was.
pub fn code_of(text: &str) -> String {
    let mut blanker = Blanker {
        rest: text,
        code: String::with_capacity(text.len()),
    };
    while let Some(first) = blanker.rest.chars().next() {
        let rest = blanker.rest;
        let length = if rest.starts_with("//") {
            rest.find('\n').unwrap_or(rest.len())
        } else if rest.starts_with("/*") {
            block_comment(rest)
        } else if let Some(length) = raw_string(rest, &blanker.code) {
            length
        } else if first == '"' {
            quoted(rest)
        } else if first == '\'' {
            character(rest).unwrap_or(0)
        } else {
            0
        };
        match length {
            0 => blanker.keep(first.len_utf8()),
            length => blanker.blank(length),
        }
    }
    blanker.code
}

struct Blanker<'a> {
    rest: &'a str,
    code: String,
}

impl Blanker<'_> {
    fn keep(&mut self, length: usize) {
        let (kept, rest) = self.rest.split_at(length);
        self.code.push_str(kept);
        self.rest = rest;
    }

    fn blank(&mut self, length: usize) {
        let (blanked, rest) = self.rest.split_at(length);
        self.code
            .extend(blanked.chars().map(|c| if c == '\n' { c } else { ' ' }));
        self.rest = rest;
    }
}

/// The length of a block comment, which Rust lets nest.
fn block_comment(text: &str) -> usize {
    let mut depth = 0;
    let mut at = 0;
    while at < text.len() {
        if text[at..].starts_with("/*") {
            depth += 1;
            at += 2;
        } else if text[at..].starts_with("*/") {
            depth -= 1;
            at += 2;
            if depth == 0 {
                return at;
            }
        } else {
            at += text[at..].chars().next().map_or(1, char::len_utf8);
        }
    }
    text.len()
}

/// The length of `r"..."` or `r#"..."#`, where one begins here and `before` ends no longer word.
fn raw_string(text: &str, before: &str) -> Option<usize> {
    let body = text.strip_prefix('r')?;
    let hashes = body.len() - body.trim_start_matches('#').len();
    if !body[hashes..].starts_with('"') || before.ends_with(|c: char| c != 'b' && is_word(c)) {
        return None;
    }
    let start = 1 + hashes + 1;
    let end = format!("\"{}", "#".repeat(hashes));
    let length = text[start..].find(&end)?;
    Some(start + length + end.len())
}

/// The length of a string with escapes.
fn quoted(text: &str) -> usize {
    let mut escaped = false;
    for (at, c) in text.char_indices().skip(1) {
        match c {
            _ if escaped => escaped = false,
            '\\' => escaped = true,
            '"' => return at + 1,
            _ => {}
        }
    }
    text.len()
}

/// The length of a character literal; `None` for a lifetime.
fn character(text: &str) -> Option<usize> {
    let body = &text[1..];
    if let Some(escape) = body.strip_prefix('\\') {
        let skipped = escape.chars().next()?.len_utf8();
        return Some(2 + skipped + escape[skipped..].find('\'')? + 1);
    }
    let c = body.chars().next()?;
    body[c.len_utf8()..]
        .starts_with('\'')
        .then(|| 2 + c.len_utf8())
}

/// Whether a character can be part of an identifier.
pub fn is_word(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

/// Each identifier, number or keyword with the byte at which it begins.
pub fn words(code: &str) -> impl Iterator<Item = (usize, &str)> {
    let mut at = 0;
    std::iter::from_fn(move || {
        let start = at + code[at..].find(is_word)?;
        let rest = &code[start..];
        at = start + rest.find(|c| !is_word(c)).unwrap_or(rest.len());
        Some((start, &code[start..at]))
    })
}

/// The line (from 1) on which a byte stands.
pub fn line_at(text: &str, byte: usize) -> usize {
    text[..byte].matches('\n').count() + 1
}

/// First and last line of each function with a body.
pub fn functions(code: &str) -> Vec<(usize, usize)> {
    let mut found = Vec::new();
    for (at, word) in words(code) {
        // `fn(` without a name is a type.
        let named = code[at + word.len()..].trim_start().starts_with(is_word);
        if word == "fn"
            && named
            && let Some(end) = body_end(&code[at..])
        {
            found.push((line_at(code, at), line_at(code, at + end)));
        }
    }
    found
}

/// First and last line of each outermost block in braces: GLSL's functions, structs and blocks.
pub fn outer_blocks(code: &str) -> Vec<(usize, usize)> {
    let mut found = Vec::new();
    let mut depth = 0;
    let mut start = 0;
    for (at, c) in code.char_indices() {
        match c {
            '{' => {
                if depth == 0 {
                    start = at;
                }
                depth += 1;
            }
            '}' => {
                depth -= 1;
                if depth == 0 {
                    found.push((line_at(code, start), line_at(code, at)));
                }
            }
            _ => {}
        }
    }
    found
}

/// Where the body that follows a function's head ends; `None` where a `;` comes first.
fn body_end(code: &str) -> Option<usize> {
    let mut depth = 0;
    let mut brackets = 0;
    for (at, c) in code.char_indices() {
        match c {
            '(' | '[' => brackets += 1,
            ')' | ']' => brackets -= 1,
            ';' if depth == 0 && brackets == 0 => return None,
            '{' => depth += 1,
            '}' => {
                depth -= 1;
                if depth == 0 && brackets == 0 {
                    return Some(at);
                }
            }
            _ => {}
        }
    }
    None
}

#[test]
fn comments_strings_and_characters_are_blanked() {
    let cases = [
        ("a // b\nc", "a     \nc"),
        ("a /* b /* c */ d */ e", "a                   e"),
        (r#"f("x\"y", 'z', '\'')"#, r"f(      ,    ,     )"),
        ("r#\"a\"b\"# + br\"c\"", "         + b    "),
        ("fn f<'a>(x: &'a str)", "fn f<'a>(x: &'a str)"),
        ("'é' \"é\" /*é*/ x", "              x"),
        ("\"open", "     "),
        ("for_r\"x\"", "for_r   "),
    ];
    for (text, code) in cases {
        assert_eq!(code_of(text), code, "{text}");
    }
}

#[test]
fn functions_are_found_with_their_ends() {
    let code = "fn a() {\n  if x { y }\n}\ntrait T { fn b(&self); }\nfn c(\n  x: [u8; 3],\n) -> fn(u8) {\n}\n";
    assert_eq!(functions(code), [(1, 3), (5, 8)]);
    assert_eq!(
        outer_blocks("void f()\n{\n { }\n}\nint x;\nvoid g() { }"),
        [(2, 4), (6, 6)]
    );
}
