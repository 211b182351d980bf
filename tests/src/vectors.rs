//! The 100,000 hard cases that come with the project, made by another hand than ours.
//!
//! They are no part of the repository: they lie in `shared/vectors` beside the workspace. Where
//! they are absent a test says so, counts the skip and goes on. `SPHERULE_VECTORS` names another
//! folder; where it is set, absence is a failure: so a machine that has them cannot skip
//! silently.

use crate::case::Case;
use std::fs::File;
use std::io::{BufReader, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

/// The environment variable that names the folder, and forbids the skip.
pub const FOLDER_VARIABLE: &str = "SPHERULE_VECTORS";

/// A case with its answer.
#[derive(Clone, Copy, Debug)]
pub struct Vector {
    /// Which of the regimes it belongs to.
    pub regime: u8,
    /// Ray and sphere.
    pub case: Case,
    /// The t of the hit.
    pub expected: Option<f32>,
}

/// All cases in the order of the files; nothing, after a printed and counted skip, where they
/// are absent and [`FOLDER_VARIABLE`] is not set.
///
/// # Panics
/// Where the folder is there and cannot be read as documented, or where it must be there.
#[must_use]
pub fn read() -> Option<Vec<Vector>> {
    let folder = find(std::env::var_os(FOLDER_VARIABLE).map(PathBuf::from))?;
    let rays: Vec<f32> = read_array(&folder.join("rays.npy"), Some(8));
    let spheres: Vec<f32> = read_array(&folder.join("spheres.npy"), Some(4));
    let regimes: Vec<u8> = read_array(&folder.join("regime.npy"), None);
    let hits: Vec<u8> = read_array(&folder.join("expect_hit.npy"), None);
    let ts: Vec<f32> = read_array(&folder.join("expect_t.npy"), None);
    let cases = regimes.len();
    let lengths = [rays.len(), spheres.len(), hits.len(), ts.len()];
    assert_eq!(lengths, [cases * 8, cases * 4, cases, cases], "the files differ in length");

    let vectors = rays.chunks_exact(8).zip(spheres.chunks_exact(4)).enumerate();
    let vectors = vectors.map(|(index, (ray, sphere))| {
        let numbers = core::array::from_fn(|i| if i < 8 { ray[i] } else { sphere[i - 8] });
        let expected = (hits[index] != 0).then_some(ts[index]);
        Vector { regime: regimes[index], case: Case::from_numbers(numbers), expected }
    });
    Some(vectors.collect())
}

/// The folder that was asked for, or else the one beside the workspace if it is there.
fn find(asked: Option<PathBuf>) -> Option<PathBuf> {
    if let Some(folder) = asked {
        assert!(folder.is_dir(), "{FOLDER_VARIABLE}: no folder {}", folder.display());
        return Some(folder);
    }
    let beside = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/vectors");
    if !beside.is_dir() {
        skip("the vectors are absent: no folder shared/vectors beside the workspace");
        return None;
    }
    Some(beside)
}

/// The numbers of one file, in C order, of one dimension or of rows of `columns`.
fn read_array<T: npyz::Deserialize>(path: &Path, columns: Option<u64>) -> Vec<T> {
    let name = path.display();
    let file = File::open(path).unwrap_or_else(|error| panic!("{name}: {error}"));
    let array =
        npyz::NpyFile::new(BufReader::new(file)).unwrap_or_else(|error| panic!("{name}: {error}"));
    assert_eq!(array.order(), npyz::Order::C, "{name}: not in C order");
    assert_eq!(array.shape().get(1).copied(), columns, "{name}: wrong shape");
    array.into_vec().unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// Says, past the test harness's capture, that something was not tested, and how many times
/// this test binary has said so.
pub fn skip(reason: &str) {
    static SKIPS: AtomicUsize = AtomicUsize::new(0);
    let count = SKIPS.fetch_add(1, Ordering::Relaxed) + 1;
    // Nothing is lost where standard error is closed.
    let _ = writeln!(std::io::stderr(), "SKIPPED ({count}): {reason}");
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[should_panic(expected = "SPHERULE_VECTORS: no folder")]
    fn what_must_be_there_is_not_skipped() {
        let _ = find(Some(PathBuf::from("no/such/folder")));
    }

    #[test]
    fn every_regime_has_its_cases() {
        let Some(vectors) = read() else { return };
        assert_eq!(vectors.len(), 100_000);
        for regime in crate::regimes::REGIMES {
            let cases = vectors.iter().filter(|vector| vector.regime == regime.number).count();
            assert!(cases > 1000, "{regime:?}: {cases} cases");
        }
    }
}
