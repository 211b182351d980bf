//! Where one structure overtakes another: the table on which the constants of
//! `tui/src/structure/choose.rs` rest, and what their choice costs over the best one.
//! `cargo run --release -p spherule-tui --example crossover [LEVEL]`.
//!
//! One thread; clouds of spheres that fill a seventh of a cube; nearest hits by `Exact`, for a
//! camera's rays in the order of a picture, and for rays from anywhere to anywhere. The structures
//! are timed in turns, medians of several rounds of the thread's own clock.

use rustix::time::{ClockId, clock_gettime};
use spherule_kernel::camera::Projection;
use spherule_kernel::dispatch::{Level, LevelName, Packet};
use spherule_kernel::tiles::Viewpoint;
use spherule_kernel::{Camera, Exact, HitPacket, Lanes, Ray, RayPacket, Spheres, Vec3};
use spherule_tui::draw::tile_order;
use spherule_tui::structure::{
    RaysKind, SceneStructures, Search, Structure, TileLists, TreeMemory, Workload, choose,
};
use spherule_tui::threads::Threads;
use std::hint::black_box;

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
        "{:10} {:>8} {:>10} {:>8} {:>8} {:>7} {:>7} {:>9} {:>9} {:>8} {:>8}   {:11}   without end",
        "rays",
        "spheres",
        "brute",
        "tiles",
        "bvh",
        "sort",
        "build",
        "tiles/t",
        "bvh/t",
        "sort/t",
        "build/t",
        "one"
    );
    for kind in [RaysKind::Coherent, RaysKind::Incoherent] {
        for count in SPHERES {
            measure(kind, count, level);
        }
    }
}

/// Nanoseconds that this thread has had a CPU: others share the machine.
fn cpu_ns() -> f64 {
    let time = clock_gettime(ClockId::ThreadCPUTime);
    time.tv_sec as f64 * 1e9 + time.tv_nsec as f64
}

/// Numbers in [-1, 1) (splitmix64).
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f32 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 40) as f32 / (1 << 23) as f32 - 1.0
    }

    fn vector(&mut self) -> Vec3 {
        Vec3::new(self.next(), self.next(), self.next())
    }
}

/// A camera's rays of a square picture from outside the cube, or rays in the cube.
fn rays(kind: RaysKind, count: usize) -> Vec<RayPacket<Packet>> {
    if kind == RaysKind::Incoherent {
        let mut numbers = Numbers(7);
        let rays: Vec<_> =
            (0..count).map(|_| Ray::new(numbers.vector(), numbers.vector())).collect();
        return rays.chunks(Packet::COUNT).map(RayPacket::<Packet>::new).collect();
    }
    let side = (count as f32).sqrt() as u32;
    let step = 2.0 * 0.364 / side as f32;
    let camera = Camera {
        projection: Projection::Perspective { eye: EYE },
        corner: Vec3::new(-0.364, 0.364, -1.0),
        step_x: Vec3::new(step, 0.0, 0.0),
        step_y: Vec3::new(0.0, -step, 0.0),
    };
    let (across, down) = Camera::tile::<Packet>();
    tile_order(side / across, side / down)
        .map(|(x, y)| camera.packet::<Packet>(x * across, y * down, side, side))
        .collect()
}

fn measure(kind: RaysKind, count: usize, level: Level) {
    let mut numbers = Numbers(3);
    let size = (count as f32).powf(-1.0 / 3.0);
    let columns: [Vec<f32>; 3] = [(); 3].map(|()| (0..count).map(|_| numbers.next()).collect());
    let radii: Vec<f32> = (0..count).map(|_| size * (0.5 + 0.25 * numbers.next())).collect();
    let [x, y, z] = &columns;
    let spheres = Spheres::new(x, y, z, &radii).expect("as many of each");
    let rays = rays(kind, RAYS);
    // Brute force takes a part, from the middle, where most spheres are.
    let part = (MOST_TESTS / count / Packet::COUNT).clamp(16, rays.len());
    let middle = (rays.len() - part) / 2;
    let few = &rays[middle..middle + part];

    let threads = Threads::default();
    let mut times = Times::default();
    let mut hits = vec![HitPacket::<Packet>::none(); rays.len()];
    let mut lists = TileLists::default();
    for _ in 0..ROUNDS {
        let mut memory = TreeMemory::default();
        let mut structures = SceneStructures::new(spheres, &threads, &mut memory);
        let mut time = |search: Search<'_>, rays: &[RayPacket<Packet>]| {
            let start = cpu_ns();
            for (rays, hits) in rays.chunks(BAND).zip(hits.chunks_mut(BAND)) {
                search.nearest::<Exact>(level, kind, rays, &mut lists, hits);
            }
            black_box(&hits);
            (cpu_ns() - start) / (rays.len() * Packet::COUNT) as f64
        };
        times.brute.push(time(Search::brute(spheres), few));
        let viewpoint = (kind == RaysKind::Coherent).then_some(Viewpoint::Origin(EYE));
        let start = cpu_ns();
        let order = structures.search(Structure::Tiles, viewpoint).expect("memory");
        times.sort.push((cpu_ns() - start) / count as f64);
        let part = if viewpoint.is_some() { &rays } else { few };
        times.tiles.push(time(order, part));
        let start = cpu_ns();
        let tree = structures.search(Structure::Bvh, None).expect("memory");
        times.build.push((cpu_ns() - start) / count as f64);
        times.bvh.push(time(tree, &rays));
    }
    times.print(kind, count);
}

/// Nanoseconds, a round each: a ray, or a sphere of the sort and of the build.
#[derive(Default)]
struct Times {
    brute: Vec<f64>,
    tiles: Vec<f64>,
    bvh: Vec<f64>,
    sort: Vec<f64>,
    build: Vec<f64>,
}

impl Times {
    fn print(&mut self, kind: RaysKind, count: usize) {
        let median = |list: &mut Vec<f64>| {
            list.sort_by(f64::total_cmp);
            list[list.len() / 2]
        };
        let (brute, tiles, bvh) =
            (median(&mut self.brute), median(&mut self.tiles), median(&mut self.bvh));
        let (sort, build) = (median(&mut self.sort), median(&mut self.build));
        let test = brute / count as f64;
        // What was chosen, and how much longer it takes than the best.
        let choice = |pictures: f64| {
            let chosen = choose(count, &Workload { rays: PICTURE, pictures, kind });
            let a_ray = count as f64 / PICTURE as f64;
            let taken = |structure| match structure {
                Structure::Brute => brute,
                Structure::Tiles if kind == RaysKind::Incoherent => brute,
                Structure::Tiles => tiles + sort * a_ray,
                Structure::Bvh => bvh + build * a_ray / pictures,
            };
            let best = Structure::ALL.map(taken).into_iter().fold(f64::INFINITY, f64::min);
            format!("{:5} x{:.2}", chosen.as_str(), taken(chosen) / best)
        };
        println!(
            "{:10} {count:8} {brute:10.2} {tiles:8.2} {bvh:8.2} {sort:7.1} {build:7.1} {:9.1} \
             {:9.1} {:8.1} {:8.1}   {}   {}",
            format!("{kind:?}").to_lowercase(),
            tiles / test,
            bvh / test,
            sort / test,
            build / test,
            choice(1.0),
            choice(f64::INFINITY)
        );
    }
}
