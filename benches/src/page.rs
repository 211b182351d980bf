//! Pages in Markdown: the parts that they share.

pub(crate) mod calls;
pub(crate) mod cameras;
pub(crate) mod orders;
pub(crate) mod scales;
pub(crate) mod structures;
pub(crate) mod surfaces;
pub(crate) mod tiers;

use crate::engine::Query;
use spherule::machine::{RUSTC, cpu};
use std::fmt::{Display, Write};
use std::path::Path;
use std::process::Command;

/// Where figures come from, in one line: CPU, compiler, instructions, commit and date.
pub(crate) fn origin() -> String {
    let here = Path::new(".");
    let commit = commit(here).unwrap_or_default();
    let changes = if has_changes(here) == Some(true) { "+changes" } else { "" };
    let date = output_of(here, "date", &["-u", "+%Y-%m-%d %H:%M UTC"]).unwrap_or_default();
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    format!(
        "{}, {threads} threads; {RUSTC}, {} build; commit {commit}{changes}; {date}",
        cpu(),
        build()
    )
}

/// Why pages that are measured in a folder would not name the commit of what was measured, if so.
pub(crate) fn refusal(folder: &Path) -> Option<&'static str> {
    match (commit(folder), has_changes(folder)) {
        (Some(_), Some(false)) => None,
        (Some(_), Some(true)) => Some(
            "the working tree has changes beside docs/benchmarks, and pages name a commit: commit first",
        ),
        _ => Some(
            "pages name a commit, and git tells none: it is absent or fails, or this is no repository",
        ),
    }
}

/// The commit of a folder; `None` if git fails or is absent.
fn commit(folder: &Path) -> Option<String> {
    output_of(folder, "git", &["describe", "--always", "--exclude=*"])
}

/// Whether the working tree of a folder differs from its commit, except for the pages, of which a report writes several; `None` if git
/// fails or is absent.
fn has_changes(folder: &Path) -> Option<bool> {
    let arguments = [
        "status",
        "--porcelain",
        "--untracked-files=normal",
        "--",
        ":/",
        ":(top,exclude)docs/benchmarks",
    ];
    output_of(folder, "git", &arguments).map(|changes| !changes.is_empty())
}

/// What a program prints in a folder; `None` if it fails or is absent.
fn output_of(folder: &Path, program: &str, arguments: &[&str]) -> Option<String> {
    let output = Command::new(program).args(arguments).current_dir(folder).output().ok()?;
    output.status.success().then(|| String::from_utf8_lossy(&output.stdout).trim().to_owned())
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

fn query_name(query: Query) -> &'static str {
    if query == Query::AnyHit { "any" } else { "closest" }
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
    use crate::engine::kernel;
    use crate::orders;
    use std::{env, fs, process};

    /// A page that is older than the code may name a way that is gone, if it says so.
    #[test]
    fn pages_name_ways_that_there_are() {
        use kernel::Way;
        let of_kernel = [Way::BruteForce, Way::RayByRay, Way::Stream, Way::Packets, Way::DepthList];
        let ways = of_kernel.map(Way::as_str).into_iter();
        let ways: Vec<_> = ways.chain(orders::Way::ALL.map(orders::Way::as_str)).collect();
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/benchmarks");
        let mut seen = 0;
        for page in fs::read_dir(folder).expect("a folder of pages") {
            let page = page.expect("a page").path();
            let text = fs::read_to_string(&page).expect("text");
            let mut column = None;
            for line in text.lines() {
                let cells: Vec<_> = line.split('|').map(str::trim).collect();
                let is_way = |cell: &&str| ["way", "the best way"].contains(cell);
                let header = cells.iter().position(is_way);
                column = if cells.len() < 3 { None } else { header.or(column) };
                let (Some(column), None) = (column, header) else { continue };
                let way = cells[column];
                let is_known = ways.contains(&way) || text.contains(&format!("*{way}* is gone"));
                assert!(is_known || way.starts_with("--"), "{}: {way}", page.display());
                seen += 1;
            }
        }
        assert!(seen > 100, "{seen} ways on the pages");
    }

    #[test]
    fn pages_are_no_changes_and_name_a_commit() {
        let folder = env::temp_dir().join(format!("spherule-benches-{}", process::id()));
        let pages = folder.join("docs/benchmarks");
        fs::create_dir_all(&pages).expect("a folder");
        output_of(&folder, "git", &["init"]);
        let has_git = folder.join(".git").is_dir();
        let changes = |file: &Path| {
            fs::write(file, "").expect("written");
            has_changes(&pages)
        };
        let (page, code) = (changes(&pages.join("orders.md")), changes(&folder.join("code.rs")));
        // Nothing was committed there.
        let refusal = refusal(&pages).expect("no commit");
        fs::remove_dir_all(&folder).expect("removed");
        assert!(refusal.contains("git tells none"), "{refusal}");
        if !has_git {
            println!("skipped: no git");
            return;
        }
        assert_eq!((page, code), (Some(false), Some(true)));
    }

    #[test]
    fn bars_in_names_do_not_end_cells_and_numbers_have_three_digits() {
        let mut table = Table::new(1, "regime | n");
        table.row(["|d| 2^60", &number(Some(0.018_74))]);
        assert_eq!(table.0, "| regime | n |\n|---|--:|\n| \\|d\\| 2^60 | 0.019 |\n");
        assert_eq!([187.4, 18.74, 1.874].map(|x| number(Some(x))), ["187", "18.7", "1.87"]);
        assert_eq!(number(None), "");
    }
}
