//! The page.

use super::row::Row;

/// The page, in Markdown.
pub(crate) fn page(_rows: &[Row], _chafa: Option<&str>) -> String {
    String::new()
}
