//! Reads a projection from its word: for an enum, toml would also take a table, and its errors would not name the words.

use crate::view::LensKind;
use serde::Deserialize;
use serde::de::value::StrDeserializer;
use serde::de::{Deserializer, Error, Visitor};
use std::fmt;

/// Reads the word.
pub(super) fn projection<'de, D: Deserializer<'de>>(deserializer: D) -> Result<LensKind, D::Error> {
    deserializer.deserialize_any(ProjectionVisitor)
}

struct ProjectionVisitor;

impl Visitor<'_> for ProjectionVisitor {
    type Value = LensKind;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("\"perspective\" or \"parallel\"")
    }

    fn visit_str<E: Error>(self, word: &str) -> Result<LensKind, E> {
        LensKind::deserialize(StrDeserializer::new(word))
    }
}
