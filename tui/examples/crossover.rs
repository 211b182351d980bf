//! Where one structure overtakes another. The constants of `tui/src/structure/choose.rs` rest on this table, which also
//! says what their choice costs compared with the best one.
//! `cargo run --release -p spherule --example crossover [LEVEL]`.
//!
//! One thread traces clouds of spheres that fill a seventh of a cube. It finds closest hits by `Exact`, for a camera's
//! rays in the order of a picture, and for rays from anywhere to anywhere. The structures are timed in turns; each
//! figure is the median of several rounds by the thread's own clock.

use clap::ValueEnum;
use rustix::time::{ClockId, clock_gettime};
use spherule::choice::name;
use spherule::structure::Structure;
use spherule::structure::choose::{Workload, choose};
use spherule::structure::scene::SceneStructures;
use spherule::structure::search::{Scratch, Search, Tracing};
use spherule::threads::Threads;
use spherule_kernel::{
    Camera, CameraTiles, Coherence, HitPacket, Level, LevelName, Projection, Ray, RayPacket,
    Sphere, SphereList, Tier, Vec3, Viewpoint,
};
use spherule_referee::random::Random;
use std::hint::black_box;
use std::ops::Range;
use std::sync::Arc;

/// How many spheres.
const SPHERES: [usize; 14] =
    [1, 4, 8, 16, 32, 64, 128, 256, 512, 1024, 4096, 16_384, 131_072, 1_048_576];
/// Where the camera is.
const EYE: Vec3 = Vec3::new(0.0, 0.0, 4.0);
/// Packets that are traced together, as those of a band of a picture.
const BAND: usize = 128;
/// Rays of the pictures that are chosen for: 80 x 24 cells of 4 samples.
const PICTURE: usize = 7680;
/// Rounds of the structures in turns.
const ROUNDS: usize = 9;
/// Rays of a cloud, and of a cloud of so many spheres that brute force would take for ever.
const RAYS: usize = 1 << 16;
const MOST_TESTS: usize = 1 << 28;

fn main() {
    let word = std::env::args().nth(1).unwrap_or_default();
    let named = LevelName::ALL.into_iter().find(|name| name.as_str() == word);
    let level = named.and_then(Level::named).unwrap_or_else(Level::best);
    println!(
        "{}: ns a ray, ns a sphere; the same in tests of brute force; what is chosen for pictures \
         of {PICTURE} rays",
        level.name().as_str()
    );
    println!(
        "{:10} {:>8} {:>10} {:>8} {:>8} {:>7} {:>7} {:>9} {:>9} {:>8} {:>8}   {:16}   without end",
        "rays",
        "spheres",
        "brute",
        "depth",
        "bvh",
        "sort",
        "build",
        "depth/t",
        "bvh/t",
        "sort/t",
        "build/t",
        "one"
    );
    for coherent in [true, false] {
        for count in SPHERES {
            measure(coherent, count, level);
        }
    }
}

/// CPU time of this thread in nanoseconds: others share the machine.
fn cpu_ns() -> f64 {
    let time = clock_gettime(ClockId::ThreadCPUTime);
    time.tv_sec as f64 * 1e9 + time.tv_nsec as f64
}

/// Rays in the cube.
fn rays_in_cube() -> Vec<RayPacket> {
    let mut random = Random::seeded(7);
    let mut ray = || Ray::new(random.in_cube(1.0), random.in_cube(1.0));
    let rays: Vec<_> = (0..RAYS).map(|_| ray()).collect();
    rays.chunks(RayPacket::COUNT).map(RayPacket::new).collect()
}

/// A square picture of `RAYS` rays, from outside the cube.
fn camera() -> (Camera, u32) {
    let side = (RAYS as f32).sqrt() as u32;
    let step = 2.0 * 0.364 / side as f32;
    let camera = Camera {
        projection: Projection::Perspective { eye: EYE },
        corner: Vec3::new(-0.364, 0.364, -1.0),
        step_x: Vec3::new(step, 0.0, 0.0),
        step_y: Vec3::new(0.0, -step, 0.0),
    };
    (camera, side)
}

fn measure(coherent: bool, count: usize, level: Level) {
    let mut random = Random::seeded(3);
    let size = (count as f32).powf(-1.0 / 3.0);
    let mut sphere = || {
        let center = random.in_cube(1.0);
        Sphere { center, radius: size * random.between(0.25, 0.75) }
    };
    let list: SphereList = (0..count).map(|_| sphere()).collect();
    // A camera makes its rays with the clock running, as it does for a picture.
    let mut rays = rays_in_cube();
    let (camera, side) = camera();
    let corners: Vec<_> = Camera::tile_corners::<[f32; 16]>(side, side).collect();
    // Brute force traces a part of the rays, from the middle, where most spheres are.
    let part = (MOST_TESTS / count / RayPacket::COUNT).clamp(16, rays.len());
    let middle = (rays.len() - part) / 2;
    let (few, all) = (middle..middle + part, 0..rays.len());

    let coherence = if coherent { Coherence::Coherent } else { Coherence::Incoherent };
    let tracing = Tracing { tier: Tier::Exact, level, coherence };
    let threads = Threads::default();
    let mut times = Times::default();
    let mut hits = vec![HitPacket::none(); rays.len()];
    let mut scratch = Scratch::default();
    for _ in 0..ROUNDS {
        let mut structures = SceneStructures::new(&Arc::new(list.clone()), &threads);
        let mut time = |search: Search<'_>, packets: &Range<usize>| {
            let start = cpu_ns();
            for from in packets.clone().step_by(BAND) {
                let band = from..packets.end.min(from + BAND);
                let (rays, hits) = (&mut rays[band.clone()], &mut hits[band.clone()]);
                if coherent {
                    let corners = &corners[band];
                    let tiles = CameraTiles { camera, size: (side, side), corners };
                    search.tile_hits(tracing, (&mut scratch, &threads), tiles, rays, hits);
                } else {
                    search.closest_hits(tracing, &mut scratch, rays, hits);
                }
            }
            black_box(&hits);
            (cpu_ns() - start) / (packets.len() * RayPacket::COUNT) as f64
        };
        times.brute.push(time(Search::Brute(list.spheres()), &few));
        let viewpoint = coherent.then_some(Viewpoint::Origin(EYE));
        let start = cpu_ns();
        let sorted = structures.search(Structure::DepthList, viewpoint).expect("memory");
        times.sort.push((cpu_ns() - start) / count as f64);
        let part = if coherent { &all } else { &few };
        times.depth_list.push(time(sorted, part));
        let start = cpu_ns();
        let tree = structures.search(Structure::Bvh, None).expect("memory");
        times.build.push((cpu_ns() - start) / count as f64);
        times.bvh.push(time(tree, &all));
    }
    times.print(coherent, count);
}

/// Nanoseconds of each round: per ray, or per sphere for the sort and the build.
#[derive(Default)]
struct Times {
    brute: Vec<f64>,
    depth_list: Vec<f64>,
    bvh: Vec<f64>,
    sort: Vec<f64>,
    build: Vec<f64>,
}

impl Times {
    fn print(&mut self, coherent: bool, count: usize) {
        let median = |list: &mut Vec<f64>| {
            list.sort_by(f64::total_cmp);
            list[list.len() / 2]
        };
        let (brute, depth_list, bvh) =
            (median(&mut self.brute), median(&mut self.depth_list), median(&mut self.bvh));
        let (sort, build) = (median(&mut self.sort), median(&mut self.build));
        let test = brute / count as f64;
        // What was chosen, and how much longer it takes than the best.
        let choice = |pictures: f64| {
            let chosen = Workload::of_pictures(pictures, PICTURE, count);
            let chosen = choose(count, &Workload { coherent, ..chosen }, 1, false);
            let a_ray = count as f64 / PICTURE as f64;
            let taken = |structure| match structure {
                Structure::Brute => brute,
                Structure::DepthList if !coherent => brute,
                Structure::DepthList => depth_list + sort * a_ray,
                Structure::Bvh => bvh + build * a_ray / pictures,
            };
            let all = Structure::value_variants().iter();
            let best = all.map(|&structure| taken(structure)).fold(f64::INFINITY, f64::min);
            format!("{:10} x{:.2}", name(&chosen), taken(chosen) / best)
        };
        println!(
            "{:10} {count:8} {brute:10.2} {depth_list:8.2} {bvh:8.2} {sort:7.1} {build:7.1} {:9.1} \
             {:9.1} {:8.1} {:8.1}   {}   {}",
            if coherent { "coherent" } else { "incoherent" },
            depth_list / test,
            bvh / test,
            sort / test,
            build / test,
            choice(1.0),
            choice(f64::INFINITY)
        );
    }
}
