//! GROMACS's compressed trajectory, decompressed by the crate `molly`, behind checks that it does not make.
//!
//! It holds positions only: another file says what the particles are.

use super::Context;
use super::gro::ANGSTROM;
use crate::error::caught::catch;
use crate::scene::Scene;
use crate::scene::fixed::Fixed;
use crate::scene::input::Input;
use crate::scene::particles::Particles;
use crate::scene::read_error::ReadError;
use glam::DVec3;
use molly::{Frame, XTCReader};
use spherule_kernel::{Sphere, Vec3};

/// Magic, atoms, step, time, box, atoms again.
const HEADER: usize = 56;
/// What follows if there are more than nine atoms: precision, least and most coordinates, the index of the small
/// differences.
const COMPRESSED: usize = 32;
/// An atom takes two bits at least: one of its place, where all are at one point, and one that says whether a run follows.
const MOST_ATOMS_A_BYTE: u64 = 4;
/// Of more atoms each takes a byte at least: nine bits in a run, or as many as tell so many places apart. (The crate takes memory
/// for all of them before it decodes one.)
const MANY_ATOMS: u64 = 1_000_000;

/// Reads the next frame.
///
/// # Errors
/// [`ReadError`] if it is no valid frame, or has another number of particles than the topology.
pub(super) fn frame(input: &mut Input, context: &mut Context) -> Result<Option<Scene>, ReadError> {
    if input.is_over()? {
        return Ok(None);
    }
    let source = input.source().to_owned();
    let wrong = |what: String| ReadError::whole(&source, what);
    let bytes = raw(input)?;
    let mut frame = Frame::default();
    decoded(&bytes, &mut frame).map_err(|what| wrong(format!("a damaged frame: {what}")))?;
    let centers = frame.coords().map(|point| Vec3::from_array(point) * ANGSTROM);
    let centers: Vec<Vec3> = centers.collect();
    if centers.is_empty() {
        return Err(wrong("a frame without atoms".to_owned()).of_empty_frame());
    }
    if !centers.iter().all(|center| center.is_finite()) {
        return Err(wrong("an atom that is not at a finite point".to_owned()));
    }
    let Some(topology) = &context.topology else {
        context.notes.note("positions alone: --topology FILE says what the particles are");
        let fixed = Fixed { origin: Some(DVec3::ZERO), ..context.fixed };
        let particles = Particles { centers, ..Particles::from(fixed) };
        return particles.finish(&mut context.notes, &source).map(Some);
    };
    let spheres = topology.spheres();
    if spheres.len() != centers.len() {
        let (atoms, known) = (centers.len(), spheres.len());
        return Err(wrong(format!("{atoms} atoms in a frame; the topology has {known}")));
    }
    let list = spheres.iter().zip(centers).map(|(sphere, center)| Sphere { center, ..sphere });
    // The numbers of this format are of single precision already.
    Ok(Some(Scene { origin: DVec3::ZERO, ..topology.moved(list.collect()) }))
}

/// The bytes of a frame.
fn raw(input: &mut Input) -> Result<Vec<u8>, ReadError> {
    let wrong = |input: &Input, what: String| Err(ReadError::whole(input.source(), what));
    let mut bytes = vec![0; HEADER];
    input.exactly(&mut bytes)?;
    let word = |bytes: &[u8], at: usize| {
        u32::from_be_bytes([bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]])
    };
    let (magic, atoms) = (word(&bytes, 0), u64::from(word(&bytes, 4)));
    if ![1995, 2023].contains(&magic) {
        return wrong(input, format!("a frame begins with {magic}, not with 1995 or 2023"));
    }
    if u64::from(word(&bytes, HEADER - 4)) != atoms {
        return wrong(input, "a frame that states two numbers of atoms".to_owned());
    }
    let rest = if atoms <= 9 {
        12 * atoms
    } else {
        let size = if magic == 2023 { 8 } else { 4 };
        let from = bytes.len();
        bytes.resize(from + COMPRESSED + size, 0);
        input.exactly(&mut bytes[from..])?;
        let length =
            bytes[from + COMPRESSED..].iter().fold(0, |sum, &byte| sum << 8 | u64::from(byte));
        let most = if atoms > MANY_ATOMS { 1 } else { MOST_ATOMS_A_BYTE };
        match length.checked_next_multiple_of(4) {
            Some(padded) if atoms <= length.saturating_mul(most) => padded,
            _ => return wrong(input, format!("a frame of {atoms} atoms in {length} bytes")),
        }
    };
    let from = bytes.len();
    // Memory grows with what is there.
    input.up_to(rest, &mut bytes)?;
    if ((bytes.len() - from) as u64) < rest {
        return Err(ReadError::whole(input.source(), "the file ends within a frame").of_end());
    }
    Ok(bytes)
}

/// Decodes a frame. The crate panics where bits run out: that is an error here.
fn decoded(bytes: &[u8], frame: &mut Frame) -> Result<(), String> {
    let read = catch(|| XTCReader::new(bytes).read_frame(frame));
    read.ok_or("its bits run out")?.map_err(|error| error.to_string())
}
