//! numpy's arrays as spheres: rows of x, y, z, and perhaps a radius.

use crate::npy::Array;
use crate::scene::Scene;
use crate::scene::input::Input;
use crate::scene::notes::Notes;
use crate::scene::particles::Particles;
use crate::scene::read_error::ReadError;
use glam::DVec3;

/// Reads the array. Memory grows with the file, not with what its header claims.
///
/// # Errors
/// [`ReadError`] if it is no array of rows of three or four numbers, or one of them is not finite.
pub(super) fn read(input: &mut Input, notes: &mut Notes) -> Result<Scene, ReadError> {
    let source = input.source().to_owned();
    let wrong = |what: String| ReadError::whole(&source, what);
    let array = Array::of(input).map_err(wrong)?;
    let (rows, width) = array.shape();
    if width != 3 && width != 4 {
        return Err(wrong(format!("shape ({rows}, {width}): spheres are (N, 3) or (N, 4)")));
    }
    if rows == 0 {
        return Err(wrong("an array without rows".to_owned()));
    }
    /// Memory that is not written to is none yet; a header may claim more.
    const MOST_AT_ONCE: u64 = 1 << 26;
    let mut particles = Particles::default();
    let room = rows.min(MOST_AT_ONCE) as usize;
    // Where there is less, memory grows as rows come.
    let _ = particles.centers.try_reserve_exact(room);
    if width == 4 {
        let _ = particles.radii.try_reserve_exact(room);
    }
    array
        .each(input, |index, row| {
            let added = particles.sphere(DVec3::new(row[0], row[1], row[2]), row.get(3).copied());
            added.map_err(|what| format!("row {index} {what}"))
        })
        .map_err(wrong)?;
    particles.finish(notes, &source)
}
