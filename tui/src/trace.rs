//! `spherule trace`: rays and spheres from files, hits to files, and how fast that was.
//!
//! Values are not judged: NaN, infinities and negative radii have the kernel's answers.

mod report;

use crate::arguments::TraceArguments;
use crate::draw::AccuracyChoice;
use crate::failure::{Failure, write_stdout};
use crate::npy;
use report::Report;
use spherule_kernel::dispatch::{Level, Packet, any, nearest, pairs};
use spherule_kernel::{
    Accuracy, Exact, Fast, HitPacket, Lanes, Ray, RayPacket, Sphere, SpherePacket, Spheres, Stable,
    Vec3,
};
use std::time::{Duration, Instant};

/// What the rays met.
struct Met {
    /// A t a ray, `+inf` where nothing was hit; none where only any hit was asked for.
    t: Vec<f32>,
    /// A sphere a ray, -1 where nothing was hit; where any hit was asked for, 1 or 0.
    id: Vec<i32>,
    /// How long the kernel took, a pass.
    passes: Vec<Duration>,
}

/// Traces what `arguments` say, writes the hits, and prints a line about it.
///
/// # Errors
/// [`Failure::Input`] where a file is not what it should be, [`Failure::Running`] where an output
/// cannot be written.
pub fn trace(arguments: &TraceArguments) -> Result<(), Failure> {
    let spheres = SphereColumns::from_rows(&npy::read_rows(&arguments.spheres, 4)?);
    let rays = npy::read_rows(&arguments.rays, 8)?;
    let rays: Vec<Ray> = rays.chunks_exact(8).map(ray).collect();
    if arguments.pairs && spheres.r.len() != rays.len() {
        let (spheres, rays) = (spheres.r.len(), rays.len());
        let what = format!("{rays} rays and {spheres} spheres are no pairs");
        return Err(Failure::Input(format!("{}: {what}", arguments.rays.display())));
    }
    // A hit is written as an int32.
    if spheres.r.len().max(rays.len()) > i32::MAX as usize {
        let what = format!("{}: more than 2^31 - 1 rows", arguments.spheres.display());
        return Err(Failure::Input(what));
    }

    let start = Instant::now();
    let list = spheres.list().map_err(|error| Failure::Input(error.to_string()))?;
    let build = start.elapsed();
    let level = arguments.level.unwrap_or_else(Level::best);
    let met = match arguments.accuracy {
        AccuracyChoice::Fast => trace_as::<Fast>(arguments, level, list, &rays),
        AccuracyChoice::Stable => trace_as::<Stable>(arguments, level, list, &rays),
        AccuracyChoice::Exact => trace_as::<Exact>(arguments, level, list, &rays),
    };

    if let Some(path) = &arguments.out_t {
        npy::write_column(path, "<f4", met.t.iter().copied())?;
    }
    if let Some(path) = &arguments.out_id {
        npy::write_column(path, "<i4", met.id.iter().copied())?;
    }
    let misses = if arguments.any { 0 } else { -1 };
    let report = Report {
        rays: rays.len(),
        spheres: list.len(),
        hits: met.id.iter().filter(|&&id| id != misses).count(),
        accuracy: arguments.accuracy,
        level: level.name(),
        lanes: Packet::COUNT,
        build,
        passes: met.passes,
    };
    let text = if arguments.json { report.json() } else { report.line() };
    write_stdout(text.as_bytes())
}

/// Traces with one tier. Packets are made once; only the kernel's calls are timed.
fn trace_as<A: Accuracy>(
    arguments: &TraceArguments,
    level: Level,
    spheres: Spheres<'_>,
    rays: &[Ray],
) -> Met {
    let packets: Vec<RayPacket<Packet>> =
        rays.chunks(Packet::COUNT).map(RayPacket::<Packet>::new).collect();
    let mut hits = vec![HitPacket::<Packet>::none(); packets.len()];
    let mut met = vec![0; packets.len()];
    let mut passes = Vec::new();
    let mut repeat = |pass: &mut dyn FnMut()| {
        for _ in 0..arguments.repeat {
            let start = Instant::now();
            pass();
            passes.push(start.elapsed());
        }
    };
    if arguments.pairs {
        let spheres: Vec<Sphere> = spheres.iter().collect();
        let sphere_packets: Vec<SpherePacket<Packet>> =
            spheres.chunks(Packet::COUNT).map(SpherePacket::<Packet>::new).collect();
        repeat(&mut || pairs::<A>(level, &packets, &sphere_packets, &mut hits));
    } else if arguments.any {
        repeat(&mut || any::<A>(level, &packets, spheres, &mut met));
    } else {
        repeat(&mut || nearest::<A>(level, &packets, spheres, &mut hits));
    }

    let hit = |index: usize| hits[index / Packet::COUNT].hit(index % Packet::COUNT);
    let mut t = Vec::new();
    let id = if arguments.any {
        let any = |index: usize| match arguments.pairs {
            true => hit(index).is_some(),
            false => met[index / Packet::COUNT] >> (index % Packet::COUNT) & 1 == 1,
        };
        (0..rays.len()).map(|index| i32::from(any(index))).collect()
    } else {
        t = (0..rays.len()).map(|index| hit(index).map_or(f32::INFINITY, |hit| hit.t)).collect();
        let id = |index: usize| match hit(index) {
            None => -1,
            // The sphere of a pair is the ray's own; the kernel names its lane.
            Some(_) if arguments.pairs => index as i32,
            Some(hit) => hit.sphere as i32,
        };
        (0..rays.len()).map(id).collect()
    };
    Met { t, id, passes }
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
