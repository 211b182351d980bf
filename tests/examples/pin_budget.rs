//! Measures every tier on every regime, writes `tests/src/budget/table.rs` again and prints it
//! as Markdown. Rows of the vectors are kept as they are where the vectors are absent.

use spherule_tests::budget::{self, Set};
use std::path::Path;

fn main() -> std::io::Result<()> {
    let sets = [Set::Measured, Set::Hard, Set::Vectors];
    let fresh: Vec<_> = sets.into_iter().filter_map(budget::measure).flatten().collect();
    let table = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/budget/table.rs");
    std::fs::write(table, budget::source(&fresh))?;
    println!("{}", budget::markdown(&fresh));
    Ok(())
}
