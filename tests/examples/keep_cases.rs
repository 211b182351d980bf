//! Writes `tests/cases/regimes.txt` again, from the generator and the oracle.

use spherule_tests::kept;

fn main() -> std::io::Result<()> {
    std::fs::write(kept::path(), kept::write())
}
