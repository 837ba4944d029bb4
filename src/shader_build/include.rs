//! What does an entry point read once each `#include` is replaced by the file it names?
//!
//! A path is relative to the shader folder, wherever the directive stands. A file is included once; a
//! repeated directive leaves an empty line. Directives are found line by line, in comments too.

use std::fs;
use std::path::Path;

use super::{Error, file_error};

/// The text that the compilers see, and where each of its lines comes from.
#[derive(Debug, Clone)]
pub struct Expanded {
    /// The source with every include in its place.
    pub text: String,
    files: Vec<String>,
    lines: Vec<(usize, usize)>,
}

impl Expanded {
    /// An error at a line of the expanded text (from 1), told as the file's own line.
    #[must_use]
    pub fn error(&self, line: usize, message: impl Into<String>) -> Error {
        let last = self.lines.len().saturating_sub(1);
        let (file, line) = self
            .lines
            .get(line.saturating_sub(1).min(last))
            .copied()
            .unwrap_or((0, 0));
        Error {
            file: self.files.get(file).cloned().unwrap_or_default(),
            line,
            message: message.into(),
        }
    }
}

/// Expands the entry point `entry` of `folder`.
///
/// # Errors
///
/// A file that is missing, unreadable or outside the folder; a file that includes itself; a `#line`,
/// which would hide where a line comes from; an entry point that does not open with `#version 450` or
/// `460`. Each names the file and line of the directive.
pub fn expand(folder: &Path, entry: &str) -> Result<Expanded, Error> {
    let mut expander = Expander {
        folder,
        open: Vec::new(),
        result: Expanded {
            text: String::new(),
            files: Vec::new(),
            lines: Vec::new(),
        },
    };
    let text = read(&folder.join(entry)).map_err(|why| file_error(&folder.join(entry), why))?;
    if !matches!(text.lines().next(), Some("#version 450" | "#version 460")) {
        let mut error = file_error(&folder.join(entry), "the first line must be `#version 460`");
        error.line = 1;
        return Err(error);
    }
    expander.file(entry, &text)?;
    Ok(expander.result)
}

struct Expander<'a> {
    folder: &'a Path,
    /// Indices of the files whose expansion has begun and not ended.
    open: Vec<usize>,
    result: Expanded,
}

impl Expander<'_> {
    fn file(&mut self, path: &str, text: &str) -> Result<(), Error> {
        let file = self.result.files.len();
        self.result.files.push(self.shown(path));
        self.open.push(file);
        for (index, line) in text.lines().enumerate() {
            let number = index + 1;
            match directive(line).map_err(|why| self.error(file, number, why))? {
                Some(included) => self.include(file, number, included)?,
                None => self.line(file, number, line),
            }
        }
        self.open.pop();
        Ok(())
    }

    fn include(&mut self, file: usize, number: usize, path: &str) -> Result<(), Error> {
        let shown = self.shown(path);
        if let Some(seen) = self.result.files.iter().position(|known| *known == shown) {
            if self.open.contains(&seen) {
                let why = format!("`{path}` includes itself by way of this line");
                return Err(self.error(file, number, why));
            }
            self.line(file, number, "");
            return Ok(());
        }
        let text = self
            .inside(path)
            .map_err(|why| self.error(file, number, format!("#include \"{path}\": {why}")))?;
        self.file(path, &text)
    }

    /// Reads a file, if it lies inside the folder, links followed.
    fn inside(&self, path: &str) -> Result<String, String> {
        let plain = |part: &str| !matches!(part, "" | "." | "..") && !part.contains(['\\', ':']);
        if !path.split('/').all(plain) {
            return Err("the path must lead down from the shader folder, by plain names".into());
        }
        let target = self.folder.join(path);
        let text = read(&target)?;
        match (target.canonicalize(), self.folder.canonicalize()) {
            (Ok(target), Ok(folder)) if target.starts_with(&folder) => Ok(text),
            _ => Err("the file lies outside the shader folder".into()),
        }
    }

    fn line(&mut self, file: usize, number: usize, line: &str) {
        self.result.text.push_str(line);
        self.result.text.push('\n');
        self.result.lines.push((file, number));
    }

    fn shown(&self, path: &str) -> String {
        self.folder.join(path).display().to_string()
    }

    fn error(&self, file: usize, line: usize, message: impl Into<String>) -> Error {
        Error {
            file: self.result.files.get(file).cloned().unwrap_or_default(),
            line,
            message: message.into(),
        }
    }
}

/// The path of an `#include` line; `None` for any other line.
pub(super) fn directive(line: &str) -> Result<Option<&str>, String> {
    let Some(rest) = line.trim_start().strip_prefix('#') else {
        return Ok(None);
    };
    let rest = rest.trim_start();
    if rest.starts_with("line") {
        return Err("#line is refused: errors could no longer name their file".into());
    }
    let Some(rest) = rest.strip_prefix("include") else {
        return Ok(None);
    };
    let path = rest.trim_start().strip_prefix('"');
    match path.and_then(|path| path.split_once('"')) {
        Some((path, after)) if after.trim().is_empty() || after.trim().starts_with("//") => {
            Ok(Some(path))
        }
        _ => Err("write it as #include \"folder/file.glsl\"".into()),
    }
}

/// Reads a source file. glslang takes a C string, so a NUL byte cannot pass.
fn read(path: &Path) -> Result<String, String> {
    let text = fs::read_to_string(path).map_err(|error| match error.kind() {
        std::io::ErrorKind::NotFound => "there is no such file".to_owned(),
        _ => error.to_string(),
    })?;
    if text.contains('\0') {
        return Err("the file holds a NUL byte".into());
    }
    Ok(text)
}
