//! `spherule trace`: rays and spheres from files, hits to files, and how fast that was.
//!
//! Values are not judged: NaN, infinities and negative radii have the kernel's answers.

mod batches;
mod passes;
mod report;

use crate::arguments::{ComputingArguments, TraceArguments};
use crate::draw::AccuracyChoice;
use crate::failure::{Failure, write_stdout};
use crate::npy;
use crate::structure::{SceneStructures, Structure, StructureChoice, TreeMemory};
use crate::threads::{Threads, packets_a_task};
use batches::{batches, runs, workload};
use passes::{Met, Passes, Question};
use report::Report;
use spherule_kernel::dispatch::{Level, Packet};
use spherule_kernel::{Exact, Fast, Lanes, Ray, Spheres, Stable, Vec3};

/// Traces what `arguments` say, writes the hits, and prints a line about it.
///
/// # Errors
/// [`Failure::Input`] where a file is not what it should be, [`Failure::Running`] where an output
/// cannot be written, or there is no memory or no thread.
pub fn trace(arguments: &TraceArguments) -> Result<(), Failure> {
    let ComputingArguments { structure, threads, level } = arguments.computing;
    let question = match (arguments.pairs, arguments.any) {
        (true, _) => Question::Pairs,
        (false, true) => Question::Any,
        (false, false) => Question::Nearest,
    };
    let structure = match (question, structure) {
        (Question::Pairs, StructureChoice::Auto) => StructureChoice::Only(Structure::Brute),
        (Question::Pairs, StructureChoice::Only(other)) if other != Structure::Brute => {
            let what = format!("--pairs with --structure {}: auto or brute", other.as_str());
            return Err(Failure::Input(what));
        }
        (_, choice) => choice,
    };
    let columns = SphereColumns::from_rows(&npy::read_rows(&arguments.spheres, 4)?);
    let rays: Vec<Ray> = npy::read_rows(&arguments.rays, 8)?.chunks_exact(8).map(ray).collect();
    check_counts(arguments, columns.r.len(), rays.len())?;

    let spheres = columns.list().map_err(|error| Failure::Input(error.to_string()))?;
    let threads = Threads::new(threads)?;
    let level = level.unwrap_or_else(Level::best);
    let runs = runs::<Packet>(&rays);
    let mut memory = TreeMemory::default();
    let mut structures = SceneStructures::new(spheres, &threads, &mut memory);
    let workload = workload::<Packet>(&runs, arguments.repeat);
    let structure = structures.structure(structure, &workload);
    let batches = batches(&runs, structure, packets_a_task(rays.len().div_ceil(Packet::COUNT)));
    let repeat = arguments.repeat;
    let passes = Passes { level, threads: &threads, batches: &batches, question, repeat };
    let met = match arguments.accuracy {
        AccuracyChoice::Fast => passes.run::<Fast>(&mut structures, spheres, &rays),
        AccuracyChoice::Stable => passes.run::<Stable>(&mut structures, spheres, &rays),
        AccuracyChoice::Exact => passes.run::<Exact>(&mut structures, spheres, &rays),
    }?;
    // The first batch is that of the structure, if there is one.
    let structure = batches.first().map_or(structure, |batch| batch.structure);

    let id = |(index, &sphere): (usize, &u32)| match (sphere, arguments.any) {
        (Met::NOTHING, false) => -1,
        (_, true) => i32::from(sphere != Met::NOTHING),
        // The sphere of a pair is the ray's own; the kernel names its lane.
        _ if arguments.pairs => index as i32,
        (sphere, false) => sphere as i32,
    };
    if let Some(path) = &arguments.out_t {
        npy::write_column(path, "<f4", met.t.iter().copied())?;
    }
    if let Some(path) = &arguments.out_id {
        npy::write_column(path, "<i4", met.sphere.iter().enumerate().map(id))?;
    }
    let report = Report {
        rays: rays.len(),
        spheres: spheres.len(),
        hits: met.sphere.iter().filter(|&&sphere| sphere != Met::NOTHING).count(),
        structure,
        accuracy: arguments.accuracy,
        level: level.name(),
        lanes: Packet::COUNT,
        threads: threads.count(),
        build: structures.build_time(),
        passes: met.passes,
    };
    let text = if arguments.json { report.json() } else { report.line() };
    write_stdout(text.as_bytes())
}

/// Whether there are as many spheres and rays as can be.
fn check_counts(arguments: &TraceArguments, spheres: usize, rays: usize) -> Result<(), Failure> {
    if arguments.pairs && spheres != rays {
        let what = format!("{rays} rays and {spheres} spheres are no pairs");
        return Err(Failure::Input(format!("{}: {what}", arguments.rays.display())));
    }
    // A hit is written as an int32.
    if spheres.max(rays) > i32::MAX as usize {
        let what = format!("{}: more than 2^31 - 1 rows", arguments.spheres.display());
        return Err(Failure::Input(what));
    }
    Ok(())
}

/// The ray of a row of eight.
fn ray(row: &[f32]) -> Ray {
    Ray {
        origin: Vec3::new(row[0], row[1], row[2]),
        direction: Vec3::new(row[3], row[4], row[5]),
        t_min: row[6],
        t_max: row[7],
    }
}

/// Spheres as the kernel reads them.
struct SphereColumns {
    x: Vec<f32>,
    y: Vec<f32>,
    z: Vec<f32>,
    r: Vec<f32>,
}

impl SphereColumns {
    /// From rows of four.
    fn from_rows(rows: &[f32]) -> Self {
        let column = |index: usize| rows.chunks_exact(4).map(|row| row[index]).collect();
        Self { x: column(0), y: column(1), z: column(2), r: column(3) }
    }

    fn list(&self) -> Result<Spheres<'_>, spherule_kernel::SpheresError> {
        Spheres::new(&self.x, &self.y, &self.z, &self.r)
    }
}
