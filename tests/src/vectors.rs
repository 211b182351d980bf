//! The 100,000 hard cases that come with the project, made by another hand than ours.
//!
//! They are no part of the repository. If `SPHERULE_VECTORS` is set, it names their folder, and their absence is a
//! failure. Otherwise they are looked for in `shared/vectors` beside the workspace; a test that does not find them says
//! so and goes on.

use spherule_referee::case::Case;
use std::fs::File;
use std::io::{BufReader, Write};
use std::path::{Path, PathBuf};

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

/// All cases in the order of the files; `None` if there is no [`folder`].
///
/// # Panics
/// If the folder is there and cannot be read as documented, or if it must be there.
#[must_use]
pub fn read() -> Option<Vec<Vector>> {
    let folder = folder(std::env::var_os(FOLDER_VARIABLE).map(PathBuf::from))?;
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

/// The named folder, or else the one beside the workspace. Prints a skip and returns `None` if that is absent.
///
/// # Panics
/// If the named folder is absent.
#[must_use]
pub fn folder(named: Option<PathBuf>) -> Option<PathBuf> {
    if let Some(folder) = named {
        assert!(folder.is_dir(), "{FOLDER_VARIABLE}: no folder {}", folder.display());
        return Some(folder);
    }
    let beside = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/vectors");
    if !beside.is_dir() {
        // Written past the test harness's capture; a closed standard error loses nothing else.
        let _ = writeln!(std::io::stderr(), "skipped: no vectors in shared/vectors");
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
