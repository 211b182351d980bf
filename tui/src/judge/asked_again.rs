//! Failures made smaller: the program that was judged is asked about simpler cases, by its command.

use super::arrays::Answers;
use super::command;
use crate::error::Error;
use crate::npy::{bytes_of_row, header};
use spherule_referee::case::Case;
use spherule_referee::failure::Failure;
use spherule_referee::judge::Judge;
use spherule_referee::rules::Rules;
use spherule_referee::shrink::{Candidate, shrink};
use spherule_referee::verdict::Kind;
use std::fs;
use std::io;
use std::ops::Range;
use std::path::Path;
use std::time::Duration;

/// How long the smallest case of a kind is looked for.
const SHRINKING: Duration = Duration::from_secs(5);
/// How long the command may take.
const PATIENCE: Duration = Duration::from_secs(10);
/// The most cases of one call: more than a case has simpler ones, since a call may be dear.
const AT_ONCE: usize = 4096;

/// Makes the failure smaller, one of its kind, as long as the command answers.
///
/// # Errors
/// [`Error`] if the command cannot be asked, fails, hangs, or answers something else than its cases.
pub(super) fn make_smaller(
    command: &str,
    failure: &mut Failure,
    rules: Rules,
) -> Result<(), Error> {
    let mut wrong = None;
    *failure = shrink(failure, (SHRINKING, AT_ONCE), |candidates| {
        if wrong.is_some() {
            return Vec::new();
        }
        failures(command, candidates, rules).unwrap_or_else(|error| {
            wrong = Some(error);
            Vec::new()
        })
    });
    wrong.map_or(Ok(()), Err)
}

/// How each case fails, if it does; cases of several spheres are left out.
fn failures(
    command: &str,
    candidates: &[Candidate],
    rules: Rules,
) -> Result<Vec<Option<Failure>>, Error> {
    let alone = |(ray, spheres): &Candidate| match spheres[..] {
        [sphere] => Some(Case { ray: *ray, sphere }),
        _ => None,
    };
    let alone: Vec<Case> = candidates.iter().filter_map(alone).collect();
    if alone.is_empty() {
        return Ok(Vec::new());
    }
    let failed = |error: io::Error| Error::of_output("--again", &error);
    let folder = tempfile::tempdir().map_err(failed)?;
    let [spheres, rays, t] = ["S.npy", "R.npy", "T.npy"].map(|name| folder.path().join(name));
    let rows = alone.len();
    let write = |path: &Path, columns: Range<usize>| {
        let mut bytes = header("<f4", &[rows as u64, columns.len() as u64]);
        alone.iter().for_each(|case| bytes.extend(bytes_of_row(&case.numbers()[columns.clone()])));
        fs::write(path, bytes).map_err(failed)
    };
    write(&spheres, 8..12)?;
    write(&rays, 0..8)?;
    command::run(command, [&spheres, &rays, &t], PATIENCE)?;
    let mut answers = Answers::open(&t, None)?;
    if answers.rows() != rows as u64 {
        let what = format!("--again: {} answers to {rows} cases", answers.rows());
        return Err(Error::Running(what));
    }
    let answers = answers.read(0, rows, None)?;
    let judged = |(case, answer): (&Case, _)| {
        let mut judge = Judge::new(rules, false);
        judge.pairs(&[case.ray], &[case.sphere], &[answer], &[]);
        Kind::ALL.into_iter().find_map(|kind| judge.worst(kind).cloned())
    };
    Ok(alone.iter().zip(answers).map(judged).collect())
}
