//! Pages in Markdown: the parts that they share.

pub(crate) mod calls;
pub(crate) mod cameras;
pub(crate) mod orders;
pub(crate) mod scales;
pub(crate) mod structures;
pub(crate) mod surfaces;
pub(crate) mod tiers;

use spherule::machine::{RUSTC, cpu};
use std::fmt::{Display, Write};
use std::process::Command;

/// Where figures come from, in one line: CPU, compiler, instructions, commit and date.
pub(crate) fn origin() -> String {
    // What a program prints; empty if it fails or is absent.
    let output_of = |program: &str, arguments: &[&str]| {
        let output = Command::new(program).args(arguments).output().ok();
        output.map_or_else(String::new, |output| {
            String::from_utf8_lossy(&output.stdout).trim().to_owned()
        })
    };
    let commit = output_of("git", &["describe", "--always", "--exclude=*", "--dirty=+changes"]);
    let date = output_of("date", &["-u", "+%Y-%m-%d %H:%M UTC"]);
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    format!("{}, {threads} threads; {RUSTC}, {} build; commit {commit}; {date}", cpu(), build())
}

/// Who made the CPU, in small letters: the limits of trees differ between makers.
pub(crate) fn maker() -> &'static str {
    let cpu = cpu();
    ["AMD", "Intel"]
        .into_iter()
        .zip(["amd", "intel"])
        .find(|(name, _)| cpu.contains(name))
        .map_or("other", |(_, file)| file)
}

/// Whether the whole build has the instructions that the kernel otherwise detects at run time.
pub(crate) const fn build() -> &'static str {
    if cfg!(target_feature = "avx2") { "native" } else { "plain" }
}

/// A table.
struct Table(String);

impl Table {
    /// Names of columns, with bars between them. Columns after the first `words` are aligned to the right.
    fn new(words: usize, columns: &str) -> Self {
        let rule =
            (0..columns.split(" | ").count()).map(|i| if i < words { "---|" } else { "--:|" });
        Self(format!("| {columns} |\n|{}\n", rule.collect::<String>()))
    }

    fn row<C: Display>(&mut self, cells: impl IntoIterator<Item = C>) {
        self.0.push('|');
        for cell in cells {
            // Escapes a bar in a name, which would end the cell.
            let _ = write!(self.0, " {} |", cell.to_string().replace('|', "\\|"));
        }
        self.0.push('\n');
    }
}

/// Three digits; an empty cell if nothing was measured.
fn number(value: Option<f64>) -> String {
    let Some(value) = value else { return String::new() };
    let digits = [100.0, 10.0, 1.0].iter().filter(|&&least| value < least).count();
    format!("{value:.digits$}")
}

/// The value as it displays; an empty cell if nothing was measured.
fn cell(value: Option<impl Display>) -> String {
    value.map_or_else(String::new, |value| value.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bars_in_names_do_not_end_cells_and_numbers_have_three_digits() {
        let mut table = Table::new(1, "regime | n");
        table.row(["|d| 2^60", &number(Some(0.018_74))]);
        assert_eq!(table.0, "| regime | n |\n|---|--:|\n| \\|d\\| 2^60 | 0.019 |\n");
        assert_eq!([187.4, 18.74, 1.874].map(|x| number(Some(x))), ["187", "18.7", "1.87"]);
        assert_eq!(number(None), "");
    }
}
