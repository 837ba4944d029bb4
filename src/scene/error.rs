//! What went wrong while a scene was read, where, and with which exit code does the program end?

use std::fmt;
use std::path::{Path, PathBuf};

use super::quote;

/// A scene that could not be read. Its text says what is wrong, where, and what to do about it.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// A `--set` that cannot be obeyed.
    #[error("--set '{text}': {message}")]
    Override { text: String, message: String },
    /// A file that is missing, unreadable or wrong.
    #[error("{place}: {message}")]
    File { place: Place, message: String },
}

impl Error {
    /// The program's exit code: 2 (usage) for a bad `--set`, 6 (file) for the rest.
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Override { .. } => 2,
            Self::File { .. } => 6,
        }
    }

    /// A fault of the file as a whole.
    pub(super) fn file(path: &Path, message: impl Into<String>) -> Self {
        Self::File {
            place: Place::file(path),
            message: message.into(),
        }
    }

    /// A fault in one line of a text file; lines count from 1.
    pub(super) fn line(path: &Path, line: usize, message: impl Into<String>) -> Self {
        let mut place = Place::file(path);
        place.line = Some(line);
        Self::File {
            place,
            message: message.into(),
        }
    }

    /// What is wrong, without the place.
    pub(super) fn into_message(self) -> String {
        match self {
            Self::Override { message, .. } | Self::File { message, .. } => message,
        }
    }

    /// A fault of a file that the system would not give.
    pub(super) fn io(path: &Path, error: &std::io::Error) -> Self {
        Self::file(path, format!("cannot be read: {error}"))
    }
}

/// A file, and where it is text, a line and column in it, both counted from 1.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    pub path: PathBuf,
    pub line: Option<usize>,
    pub column: Option<usize>,
}

impl Place {
    /// The file as a whole.
    pub(super) fn file(path: &Path) -> Self {
        Self {
            path: path.to_path_buf(),
            line: None,
            column: None,
        }
    }

    /// The byte `offset` of the file's `text`.
    pub(super) fn offset(path: &Path, text: &str, offset: usize) -> Self {
        // An offset inside a character belongs to that character.
        let mut offset = offset.min(text.len());
        while !text.is_char_boundary(offset) {
            offset -= 1;
        }
        let before = &text[..offset];
        let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
        Self {
            path: path.to_path_buf(),
            line: Some(before.matches('\n').count() + 1),
            column: Some(before[line_start..].chars().count() + 1),
        }
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&quote::path(&self.path))?;
        if let Some(line) = self.line {
            write!(f, ":{line}")?;
        }
        if let Some(column) = self.column {
            write!(f, ":{column}")?;
        }
        Ok(())
    }
}
