//! `spherule trace`: rays and spheres from files, hits to files, and how fast that was.
//!
//! Values are not judged: NaN, infinities and negative radii have the kernel's answers.

mod batches;
mod passes;
mod report;

use crate::arguments::{ComputingArguments, TraceArguments};
use crate::choice::name;
use crate::error::{Error, write_stdout};
use crate::npy::{self, Output};
use crate::structure::Structure;
use crate::structure::scene::SceneStructures;
use crate::structure::search::Tracing;
use crate::threads::{Threads, packets_a_task, packets_a_tree_task};
use crate::whole_file::{check_outputs, is_stdout};
use batches::{batches, runs, workload};
use passes::{Passes, Query};
use report::Report;
use spherule_kernel::{Coherence, Hit, Level, RayPacket, SphereList};
use std::path::Path;
use std::sync::Arc;

/// Traces the rays that `arguments` name, writes the hits, and prints a line about it.
///
/// # Errors
/// [`Error::Input`] if a file is not what it should be, [`Error::Running`] if an output cannot be
/// written, or there is no memory or no thread.
pub fn trace(arguments: &TraceArguments) -> Result<(), Error> {
    let ComputingArguments { structure, threads, level } = arguments.computing;
    check_files(arguments)?;
    let query = match (arguments.pairs, arguments.any) {
        (true, _) => Query::Pairs,
        (false, true) => Query::Any,
        (false, false) => Query::Closest,
    };
    let structure = match (query, structure) {
        (Query::Pairs, None) => Some(Structure::Brute),
        (Query::Pairs, Some(other)) if other != Structure::Brute => {
            let what = format!(
                "--pairs with --structure {}: pairs need no structure; say auto or brute",
                name(&other)
            );
            return Err(Error::Input(what));
        }
        (_, choice) => choice,
    };
    let list = Arc::new(SphereList::from(npy::read_rows::<4>(&arguments.spheres)?));
    let rays: Vec<_> = npy::read_rows(&arguments.rays)?.into_iter().map(npy::ray).collect();
    check_counts(arguments, list.len(), rays.len())?;

    let threads = Threads::new(threads)?;
    let level = level.unwrap_or_else(Level::best);
    let runs = runs(&rays);
    let mut structures = SceneStructures::new(&list, &threads);
    let workload = workload(&runs, arguments.repeat);
    let structure = structures.structure(structure, &workload);
    let packets = rays.len().div_ceil(RayPacket::COUNT);
    let longest = match structure {
        Structure::Bvh => packets_a_tree_task(packets),
        _ => packets_a_task(packets),
    };
    let batches = batches(&runs, structure, longest);
    // The kernel finds out whether rays are coherent, as the runs do, in no time that can be
    // measured.
    let tracing = Tracing { tier: arguments.accuracy, level, coherence: Coherence::Detect };
    let repeat = arguments.repeat;
    let passes = Passes { tracing, threads: &threads, batches: &batches, query, repeat };
    let (hits, passes) = passes.run(&mut structures, &list, &rays)?;

    let id = |(index, hit): (usize, &Option<Hit>)| match hit {
        hit if arguments.any => i32::from(hit.is_some()),
        None => -1,
        // The sphere of a pair is the ray's own; the kernel names its lane.
        Some(_) if arguments.pairs => index as i32,
        Some(hit) => hit.sphere as i32,
    };
    let t = hits.iter().map(|hit| hit.map_or(f32::INFINITY, |hit| hit.t).to_le_bytes());
    let ids = hits.iter().enumerate().map(|hit| id(hit).to_le_bytes());
    let out_t = arguments.out_t.as_ref().map(|path| written(path, "<f4", t)).transpose()?;
    let out_id = arguments.out_id.as_ref().map(|path| written(path, "<i4", ids)).transpose()?;
    // Both files are whole before one of them gets its name.
    [out_t, out_id].into_iter().flatten().try_for_each(Output::finish)?;
    let report = Report {
        rays: rays.len(),
        spheres: list.len(),
        hits: hits.iter().flatten().count(),
        // The first batch is that of the structure, if there is one.
        structure: batches.first().map_or(structure, |batch| batch.structure),
        accuracy: arguments.accuracy,
        level: level.name(),
        lanes: RayPacket::COUNT,
        threads: threads.count(),
        build: structures.build_time(),
        passes,
    };
    let text = if arguments.json { report.json() } else { report.line() };
    write_stdout(text.as_bytes())
}

/// An array of one dimension, of numbers of four bytes, which is whole on the disk.
fn written(
    path: &Path,
    dtype: &str,
    mut numbers: impl ExactSizeIterator<Item = [u8; 4]>,
) -> Result<Output, Error> {
    let mut output = Output::create(path, dtype, &[numbers.len() as u64])?;
    numbers.try_for_each(|number| output.write(&number))?;
    output.written()?;
    Ok(output)
}

/// Refuses arrays on standard output, which has the line about them, two of them in one file, and one in place of an input.
fn check_files(arguments: &TraceArguments) -> Result<(), Error> {
    let TraceArguments { out_t, out_id, spheres, rays, .. } = arguments;
    let outputs = [("--out-t", out_t), ("--out-id", out_id)];
    let outputs: Vec<(&str, &Path)> =
        outputs.into_iter().filter_map(|(option, path)| Some((option, path.as_deref()?))).collect();
    for (option, path) in &outputs {
        if is_stdout(path) {
            let what = "standard output has the report; name a file";
            let what = format!("{option} {}: {what}", path.display());
            return Err(Error::Input(what));
        }
    }
    check_outputs(&outputs, &[("--spheres", spheres.as_path()), ("--rays", rays.as_path())])
}

/// Checks that there are not too many spheres and rays, and as many of each for pairs.
fn check_counts(arguments: &TraceArguments, spheres: usize, rays: usize) -> Result<(), Error> {
    if arguments.pairs && spheres != rays {
        let what = format!("{rays} rays, {spheres} spheres; --pairs needs as many of each");
        return Err(Error::Input(format!("{}: {what}", arguments.rays.display())));
    }
    // A hit is written as an int32.
    if spheres.max(rays) > i32::MAX as usize {
        let what = format!(
            "{}: too many rows; at most 2^31 - 1, since an index is an int32",
            arguments.spheres.display()
        );
        return Err(Error::Input(what));
    }
    Ok(())
}
