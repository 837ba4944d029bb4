//! What may `--set KEY=VALUE` change?
//!
//! Any number of a scene, by the path it has in a scene file: `material.gold.roughness=0.3`. Only
//! what exists: the schema refuses unknown keys when the text is read, and `check` refuses names of
//! lights, materials and models that the scene does not have.

use toml::Value;

use super::error::Error;
use super::layers::Layer;
use super::suggest;

/// One `--set`, split into what the checks look at.
pub(super) struct Override {
    text: String,
    /// The first key: `camera`, `ambient`, `light`, `material` or `model`.
    head: String,
    /// The names below it, where `head` is a table of named things.
    names: Vec<String>,
    pub(super) layer: Layer,
}

impl Override {
    /// Reads `KEY = VALUE` and checks it against the schema.
    pub(super) fn parse(text: &str) -> Result<Self, Error> {
        let layer = Layer::set(text)?;
        let Some((head, value)) = layer.table.iter().next().filter(|(_, value)| says(value)) else {
            return Err(Error::Override {
                text: text.to_owned(),
                message: "changes nothing: write KEY=VALUE".to_owned(),
            });
        };
        let named = ["light", "material", "model"].contains(&head.as_str());
        let names = match value {
            Value::Table(table) if named => table.keys().cloned().collect(),
            _ => Vec::new(),
        };
        Ok(Self {
            text: text.to_owned(),
            head: head.clone(),
            names,
            layer,
        })
    }

    /// Refuses a name under `head` that is not `known`; other heads pass.
    pub(super) fn check<'a>(
        &self,
        head: &str,
        known: impl Iterator<Item = &'a str> + Clone,
    ) -> Result<(), Error> {
        if self.head != head {
            return Ok(());
        }
        for name in &self.names {
            if !known.clone().any(|candidate| candidate == name) {
                return Err(Error::Override {
                    text: self.text.clone(),
                    message: suggest::unknown(head, name, known),
                });
            }
        }
        Ok(())
    }
}

/// True where `value` is more than empty tables.
fn says(value: &Value) -> bool {
    match value {
        Value::Table(table) => table.values().any(says),
        _ => true,
    }
}
