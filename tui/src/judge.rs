//! `spherule judge`: another program's answers, from files, against exact truth.
//!
//! Files are read side by side, some rows at a time, so that memory does not grow with the number of rays; with
//! `--pairs` it does not grow with the number of spheres either. Nothing is printed before all rows are judged.

mod arrays;
mod asked_again;
mod command;
mod report;

use crate::error::{Error, cause, place_in, write_stdout};
use crate::npy::ray;
use arrays::{Answers, Array, DTYPE_F4, DTYPE_U1, paired_rows};
use asked_again::make_smaller;
use clap::Args;
use report::Report;
use serde::Deserialize;
use spherule_kernel::{Ray, Sphere};
use spherule_referee::failure::Failure;
use spherule_referee::families::FAMILIES;
use spherule_referee::judge::Judge;
use spherule_referee::rules::{Precision, Rules};
use spherule_referee::truth::Shared;
use spherule_referee::verdict::Kind;
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};
use toml::de::{DeTable, Deserializer};

/// Rows that are read at once.
const ROWS: usize = 1 << 14;
/// The most bytes of rules. Parsed, they may take 540 times the memory.
const LONGEST_RULES: usize = 64 << 10;

/// Rays, spheres and answers.
#[derive(Args, Clone, Debug)]
pub struct JudgeArguments {
    /// Spheres: .npy, float32, (N, 4): centre xyz, radius
    #[arg(long, value_name = "S.npy")]
    pub spheres: PathBuf,
    /// Rays: .npy, float32, (M, 8): origin xyz, direction xyz, t_min, t_max
    #[arg(long, value_name = "R.npy")]
    pub rays: PathBuf,
    /// Answers: .npy, float32 or float64, (M,), +inf if a ray has no hit
    #[arg(long, value_name = "T.npy")]
    pub t: PathBuf,
    /// The spheres that were answered: .npy, int32, int64 or uint32, (M,), -1 if a ray has no hit
    #[arg(long, value_name = "I.npy")]
    pub id: Option<PathBuf>,
    /// Test ray i against sphere i
    #[arg(long)]
    pub pairs: bool,
    /// The family of each ray, as spherule cases writes them: .npy, uint8, (M,)
    #[arg(long, value_name = "F.npy")]
    pub family: Option<PathBuf>,
    /// Where the program's rules are not Spherule's: a .toml file
    #[arg(long, value_name = "FILE")]
    pub rules: Option<PathBuf>,
    /// A command that answers other pairs: it is called with the names of S.npy and R.npy, which it reads, and T.npy, which it
    /// writes; so the smallest failures are made smaller
    #[arg(long, value_name = "COMMAND", requires = "pairs")]
    pub again: Option<String>,
    /// Report as a JSON object
    #[arg(long, conflicts_with = "chart")]
    pub json: bool,
    /// Show where in each family answers are wrong
    #[arg(long)]
    pub chart: bool,
}

/// Judges the answers that `arguments` name, and prints the counts, the worst failures and the simplest.
///
/// # Errors
/// [`Error::Input`] if a file is not what it should be, or t and id contradict each other; [`Error::Running`], behind the report, if
/// the command of `--again` does not answer.
pub fn judge(arguments: &JudgeArguments) -> Result<(), Error> {
    let mut spheres = Array::open(&arguments.spheres, &[DTYPE_F4], Some(4))?;
    let mut rays = Array::open(&arguments.rays, &[DTYPE_F4], Some(8))?;
    let mut answers = Answers::open(&arguments.t, arguments.id.as_deref())?;
    let mut families =
        arguments.family.as_deref().map(|path| Array::open(path, &[DTYPE_U1], None)).transpose()?;
    answers.check_rows(&rays)?;
    families.iter().try_for_each(|families| paired_rows(families, &rays))?;
    if arguments.pairs {
        paired_rows(&spheres, &rays)?;
    }
    let rules = rules(arguments.rules.as_deref(), &answers)?;

    let mut judge = Judge::new(rules, arguments.chart || arguments.json);
    let (count_of_rays, count_of_spheres) = (rays.rows(), spheres.rows());
    let all = if arguments.pairs { Vec::new() } else { read_spheres(&mut spheres)? };
    let shared = Shared::new(&all);
    let mut from = 0;
    while from < count_of_rays {
        let count = rows_at_once(count_of_rays - from);
        let some: Vec<Ray> = rays.read_rows(count)?.into_iter().map(ray).collect();
        let numbers = match &mut families {
            Some(families) => read_families(families, from, count)?,
            None => Vec::new(),
        };
        if arguments.pairs {
            let own: Vec<Sphere> =
                spheres.read_rows::<4>(count)?.into_iter().map(Sphere::from).collect();
            let found = answers.read(from, count, None)?;
            judge.pairs(&some, &own, &found, &numbers);
        } else {
            let found = answers.read(from, count, Some(count_of_spheres))?;
            judge.shared(&shared, &some, &found, &numbers);
        }
        from += count as u64;
    }
    for array in [Some(&mut rays), Some(&mut spheres), families.as_mut()].into_iter().flatten() {
        array.check_end()?;
    }
    answers.check_end()?;
    let mut smallest: Vec<Failure> =
        Kind::ALL.iter().filter_map(|&kind| judge.simplest(kind).cloned()).collect();
    let asked = arguments.again.as_ref().map_or(Ok(()), |command| {
        smallest.iter_mut().try_for_each(|failure| make_smaller(command, failure, rules))
    });
    let report = Report {
        judge: &judge,
        smallest: &smallest,
        rays: count_of_rays,
        spheres: count_of_spheres,
        pairs: arguments.pairs,
    };
    let text = if arguments.json { report.json() } else { report.text(arguments.chart) };
    write_stdout(text.as_bytes())?;
    asked
}

/// How many rows are read next, if so many are left.
fn rows_at_once(left: u64) -> usize {
    usize::try_from(left).map_or(ROWS, |left| left.min(ROWS))
}

/// Reads all spheres. Memory grows with what is there: the header of a pipe may claim anything.
fn read_spheres(spheres: &mut Array) -> Result<Vec<Sphere>, Error> {
    let (mut all, mut left) = (Vec::new(), spheres.rows());
    while left > 0 {
        let count = rows_at_once(left);
        all.extend(spheres.read_rows::<4>(count)?.into_iter().map(Sphere::from));
        left -= count as u64;
    }
    Ok(all)
}

/// Reads the numbers of families; an unknown family is an error.
fn read_families(families: &mut Array, from: u64, count: usize) -> Result<Vec<u8>, Error> {
    let numbers = families.read(count)?.to_vec();
    match numbers.iter().position(|&number| usize::from(number) >= FAMILIES.len()) {
        None => Ok(numbers),
        Some(place) => {
            let (row, number) = (from + place as u64, numbers[place]);
            let last = FAMILIES.len() - 1;
            let what =
                format!("row {row}: no family has the number {number}; numbers are 0 to {last}");
            Err(families.wrong(&what))
        }
    }
}

/// The rules of the file. Where it states no precision, it is that of the answers.
fn rules(path: Option<&Path>, answers: &Answers) -> Result<Rules, Error> {
    let usual = if answers.are_double() { Precision::F64 } else { Precision::F32 };
    let Some(path) = path else { return Ok(Rules { precision: usual, ..Rules::CONTRACT }) };
    let wrong = |what: &str| Error::Input(format!("{}: {what}", path.display()));
    let text = rules_text(path).map_err(|what| wrong(&what))?;
    let in_a_line = |error| in_a_line(path, &text, &error);
    let table = DeTable::parse(&text).map_err(in_a_line)?;
    let states_precision = table.get_ref().contains_key("precision");
    let mut rules = Rules::deserialize(Deserializer::from(table)).map_err(in_a_line)?;
    if !states_precision {
        rules.precision = usual;
    }
    if rules.precision == Precision::F64 && !answers.are_double() {
        return Err(wrong("precision = \"f64\", and the answers are float32"));
    }
    rules.consistent().map_err(|why| wrong(&why.to_string()))
}

/// The text of a file of rules.
fn rules_text(path: &Path) -> Result<String, String> {
    let mut bytes = Vec::new();
    let read = File::open(path)
        .and_then(|file| file.take(LONGEST_RULES as u64 + 1).read_to_end(&mut bytes));
    read.map_err(|error| cause(&error))?;
    if bytes.len() > LONGEST_RULES {
        return Err(format!("rules have at most {} KiB", LONGEST_RULES >> 10));
    }
    String::from_utf8(bytes).map_err(|_| "not valid UTF-8".to_owned())
}

/// The place of the error in the file, and the first line of its message.
fn in_a_line(path: &Path, text: &str, error: &toml::de::Error) -> Error {
    let (line, column) = place_in(text, error.span().map_or(0, |span| span.start));
    let what = error.message().lines().next().unwrap_or_default();
    Error::Input(format!("{}:{line}:{column}: {what}", path.display()))
}
