//! Where does a value come from: the material library, the scene's text, or a `--set`?

use std::path::{Path, PathBuf};

use toml::de::{DeTable, DeValue};
use toml::{Table, Value};

use super::description::Description;
use super::error::{Error, Place};
use super::suggest;

/// One text of keys and values, checked against the schema on its own.
#[derive(Clone)]
pub(super) struct Layer {
    origin: Origin,
    pub(super) table: Table,
}

/// Where a layer was written.
#[derive(Clone)]
enum Origin {
    /// A file and its text.
    File(PathBuf, String),
    /// The text of one `--set`.
    Set(String),
    /// Made by the program: nothing that a message could point at.
    Made,
}

impl Layer {
    /// A scene file's text. Syntax errors, wrong types and unknown keys carry line and column.
    pub(super) fn file(path: &Path, text: String) -> Result<Self, Error> {
        let table = parse(&text).map_err(|error| Error::File {
            place: match error.span() {
                Some(span) => Place::offset(path, &text, span.start),
                None => Place::file(path),
            },
            message: suggest::reword(error.message()),
        })?;
        Ok(Self {
            origin: Origin::File(path.to_path_buf(), text),
            table,
        })
    }

    /// The text of one `--set`: a line of TOML, `KEY = VALUE`.
    pub(super) fn set(text: &str) -> Result<Self, Error> {
        let refuse = |message: String| Error::Override {
            text: text.to_owned(),
            message,
        };
        if text.contains(['\n', '\r']) {
            return Err(refuse("must be one line, KEY=VALUE".to_owned()));
        }
        if let Err(error) = text.parse::<Table>() {
            let message = suggest::reword(error.message());
            return Err(refuse(format!(
                "{message}; write KEY=VALUE as in a scene file, with text in quotes: \
                 material.gold.roughness=0.3 or camera.projection=\"orthographic\""
            )));
        }
        let table = parse(text).map_err(|error| refuse(suggest::reword(error.message())))?;
        Ok(Self {
            origin: Origin::Set(text.to_owned()),
            table,
        })
    }

    /// A layer made by the program from a description.
    pub(super) fn made(description: &Description) -> Self {
        Self {
            origin: Origin::Made,
            // A description holds only numbers, text and tables with text keys, all of which TOML
            // has; should that change, the layer is empty and the scene lacks its defaults.
            table: Table::try_from(description).unwrap_or_default(),
        }
    }

    /// Where the value at `path` stands in this layer, or the nearest table above it, and how many
    /// of the path's keys were found.
    fn locate(&self, path: &[&str]) -> (usize, usize) {
        let text = match &self.origin {
            Origin::File(_, text) | Origin::Set(text) => text,
            Origin::Made => return (0, 0),
        };
        let Ok(root) = DeTable::parse(text) else {
            return (0, 0);
        };
        let mut table = root.get_ref();
        let (mut depth, mut offset) = (0, 0);
        for key in path {
            let Some((_, value)) = table.iter().find(|(name, _)| name.get_ref() == key) else {
                break;
            };
            depth += 1;
            offset = value.span().start;
            match value.get_ref() {
                DeValue::Table(inner) => table = inner,
                _ => break,
            }
        }
        (depth, offset)
    }
}

/// Parses `text` and checks every key and type against the schema.
fn parse(text: &str) -> Result<Table, toml::de::Error> {
    toml::from_str::<Description>(text)?;
    text.parse()
}

/// Layers in order: a later one wins, key by key.
#[derive(Default)]
pub(super) struct Layers {
    list: Vec<Layer>,
    /// What messages name when no text holds the value.
    path: PathBuf,
}

impl Layers {
    /// No layer yet; `path` is the file that messages name when no text holds a value.
    pub(super) fn new(path: &Path) -> Self {
        Self {
            list: Vec::new(),
            path: path.to_path_buf(),
        }
    }

    /// Puts a layer on top.
    pub(super) fn push(&mut self, layer: Layer) {
        self.list.push(layer);
    }

    /// Puts all layers of `upper` on top.
    pub(super) fn append(&mut self, upper: Self) {
        self.list.extend(upper.list);
    }

    /// All layers merged into one description.
    pub(super) fn merged(&self) -> Result<Description, Error> {
        let mut all = Table::new();
        for layer in &self.list {
            merge(&mut all, &layer.table);
        }
        all.try_into()
            .map_err(|error: toml::de::Error| self.error(&[], suggest::reword(error.message())))
    }

    /// An error about the value at `path`, placed where the topmost layer states it, or where the
    /// nearest table above it stands.
    pub(super) fn error(&self, path: &[&str], message: impl Into<String>) -> Error {
        let message = message.into();
        let mut best: Option<(usize, usize, &Layer)> = None;
        for layer in &self.list {
            let (depth, offset) = layer.locate(path);
            // At equal depth the upper layer is the one in force.
            if depth > 0 && best.is_none_or(|(deepest, ..)| depth >= deepest) {
                best = Some((depth, offset, layer));
            }
        }
        match best.map(|(_, offset, layer)| (offset, &layer.origin)) {
            Some((_, Origin::Set(text))) => Error::Override {
                text: text.clone(),
                message,
            },
            Some((offset, Origin::File(path, text))) => Error::File {
                place: Place::offset(path, text, offset),
                message,
            },
            Some((_, Origin::Made)) | None => Error::file(&self.path, message),
        }
    }
}

/// Lays `over` on `under`: tables key by key, any other value as a whole.
fn merge(under: &mut Table, over: &Table) {
    for (key, value) in over {
        match (under.get_mut(key), value) {
            (Some(Value::Table(below)), Value::Table(above)) => merge(below, above),
            _ => {
                under.insert(key.clone(), value.clone());
            }
        }
    }
}
