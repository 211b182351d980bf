//! Prints the rates of every traversal, one line each: level, structure and rays, query, form of the
//! rays; million rays a second.
//!
//! `compare` builds this program in several profiles, or with an earlier kernel, and compares rates.

use rustix::time::{ClockId, clock_gettime};
use spherule_kernel::{
    Accuracy, Bvh, Camera, CameraTiles, DepthList, Exact, Fast, Hit, HitPacket, Intersect, Level,
    LevelName, Projection, Ray, RayPacket, SphereList, SphereTree, Trace, Vec3, Viewpoint,
};
use std::hint::black_box;
use std::thread;

const SIDE: u32 = 64;
const EYE: Vec3 = Vec3::new(0.0, 0.0, -3.0);

/// A number in [-1, 1), from a linear congruence.
fn number(state: &mut u64) -> f32 {
    *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*state >> 40) as f32 / (1 << 23) as f32 - 1.0
}

fn point(state: &mut u64) -> Vec3 {
    Vec3::new(number(state), number(state), number(state))
}

fn cloud(count: usize, radius: f32) -> SphereList {
    let mut state = 1;
    (0..count).map(|_| (point(&mut state), radius * (1.5 + number(&mut state)))).collect()
}

/// The rays of a camera, packet by packet, each a tile of the picture.
fn primary() -> Vec<RayPacket> {
    let step = 1.0 / SIDE as f32;
    let camera = Camera {
        projection: Projection::Perspective { eye: EYE },
        corner: Vec3::new(-0.5, -0.5, 1.2),
        step_x: Vec3::new(step, 0.0, 0.0),
        step_y: Vec3::new(0.0, step, 0.0),
    };
    let (width, height) = Camera::tile::<[f32; 16]>();
    let columns =
        move |y| (0..SIDE).step_by(width as usize).map(move |x| camera.packet(x, y, SIDE, SIDE));
    (0..SIDE).step_by(height as usize).flat_map(columns).collect()
}

/// Rays that have nothing in common.
fn diffuse() -> Vec<RayPacket> {
    let mut state = 2;
    let rays: Vec<Ray> =
        (0..SIDE * SIDE).map(|_| Ray::new(point(&mut state), point(&mut state))).collect();
    rays.chunks(RayPacket::COUNT).map(RayPacket::new).collect()
}

/// Rays in both forms that many are traced in.
struct Rays {
    packets: Vec<RayPacket>,
    single: Vec<Ray>,
}

impl Rays {
    fn new(packets: Vec<RayPacket>) -> Self {
        let lanes = |packet: &RayPacket| {
            let packet = *packet;
            (0..RayPacket::COUNT).map(move |lane| packet.ray(lane))
        };
        Self { single: packets.iter().flat_map(lanes).collect(), packets }
    }
}

/// Prints the best of some rates of either query, by packets and by slices.
fn race(
    name: &str,
    tier: impl Accuracy,
    mut trace: Trace<'_>,
    structure: &impl Intersect,
    rays: &Rays,
) {
    let Rays { packets, single } = rays;
    let (mut of_packets, mut hits) =
        (vec![HitPacket::none(); packets.len()], vec![None; single.len()]);
    let by_packets = best(|| {
        structure.closest_hit_packets(tier, &mut trace, black_box(packets), &mut of_packets);
    });
    let by_slices = best(|| {
        structure.closest_hits_with(tier, &mut trace, black_box(single), &mut hits);
    });
    assert!(of_packets.iter().flat_map(HitPacket::hits).eq(hits.iter().copied()));
    print(name, "closest", by_packets, by_slices, single.len());

    let (mut lanes, mut occluded) = (vec![0; packets.len()], vec![false; single.len()]);
    let by_packets = best(|| {
        structure.any_hit_packets(tier, &mut trace, black_box(packets), &mut lanes);
    });
    let by_slices = best(|| {
        structure.any_hits_with(tier, &mut trace, black_box(single), &mut occluded);
    });
    assert!(hits.iter().map(Option::is_some).eq(occluded.iter().copied()));
    let lane_of = |ray: usize| lanes[ray / RayPacket::COUNT] >> (ray % RayPacket::COUNT) & 1 == 1;
    assert!((0..single.len()).map(lane_of).eq(occluded.iter().copied()));
    print(name, "any", by_packets, by_slices, single.len());
}

/// Prints the rate of one ray a call, nothing said.
fn race_one_by_one(name: &str, structure: &impl Intersect, rays: &Rays) {
    let mut hits = vec![None::<Hit>; rays.single.len()];
    let time = best(|| {
        for (ray, hit) in black_box(&rays.single).iter().zip(&mut hits) {
            *hit = structure.closest_hit(Exact, ray);
        }
    });
    println!("{name}/closest/calls {:.4}", rays.single.len() as f64 / 1e6 / time);
}

fn print(name: &str, query: &str, by_packets: f64, by_slices: f64, rays: usize) {
    let million = rays as f64 / 1e6;
    println!("{name}/{query}/packets {:.4}", million / by_packets);
    println!("{name}/{query}/slices {:.4}", million / by_slices);
}

/// The least of some times of a pass, in seconds.
fn best(mut pass: impl FnMut()) -> f64 {
    let mut best = f64::INFINITY;
    for _ in 0..7 {
        let (start, mut passes) = (seconds(), 0_u32);
        while passes == 0 || seconds() - start < 4e-3 {
            pass();
            passes += 1;
        }
        best = best.min((seconds() - start) / f64::from(passes));
    }
    best
}

/// The thread's own time, which stands still while others use the CPU.
fn seconds() -> f64 {
    let now = clock_gettime(ClockId::ThreadCPUTime);
    now.tv_sec as f64 + now.tv_nsec as f64 * 1e-9
}

/// Shuffled rays in a tree take the most stack, no more than `Intersect` says to provide: with less, the process ends.
fn stack_suffices(tree: &SphereTree, provided: usize) {
    let mut state = 3;
    let mut away = || Ray::new(EYE, point(&mut state) - EYE);
    let rays: Vec<Ray> = (0..40_000).map(|_| away()).collect();
    let packets: Vec<RayPacket> = rays.chunks(RayPacket::COUNT).map(RayPacket::new).collect();
    for level in LevelName::ALL.into_iter().filter_map(Level::named) {
        let (mut hits, mut occluded) = (vec![None; rays.len()], vec![false; rays.len()]);
        let mut of_packets = vec![HitPacket::none(); packets.len()];
        let call = || {
            tree.any_hits_with(Fast, &mut Trace::new().at(level), &rays, &mut occluded);
            tree.closest_hits_with(Fast, &mut Trace::new().at(level), &rays, &mut hits);
            tree.closest_hits_with(Exact, &mut Trace::new().at(level), &rays, &mut hits);
            // Tiles so far apart that their rays have little in common; packets after them, by the same trace.
            let mut trace = Trace::new().at(level);
            let (mut tiles, mut seen) = ([RayPacket::inactive(); 64], [HitPacket::none(); 65]);
            tree.closest_hit_tiles(Exact, &mut trace, apart(), &mut tiles, &mut seen);
            assert!(seen[64] == HitPacket::none() && seen[..64] != [HitPacket::none(); 64]);
            tree.closest_hit_packets(Exact, &mut trace, &packets, &mut of_packets);
        };
        thread::scope(|scope| {
            let thread = thread::Builder::new().stack_size(provided).spawn_scoped(scope, call);
            thread.expect("a thread").join().expect("no panic");
        });
        assert!(of_packets.iter().flat_map(HitPacket::hits).eq(hits.iter().copied()));
    }
}

/// Tiles of a camera whose pixels are as far apart as the spheres.
fn apart() -> CameraTiles<'static> {
    const CORNERS: [(u32, u32); 64] = {
        let (mut corners, mut place) = ([(0, 0); 64], 0);
        while place < 64 {
            corners[place] = (place as u32 % 8 * 4, place as u32 / 8 * 4);
            place += 1;
        }
        corners
    };
    let camera = Camera {
        projection: Projection::Perspective { eye: EYE },
        corner: Vec3::new(-1.0, 1.0, 3.0),
        step_x: Vec3::new(1.0 / 16.0, 0.0, 0.0),
        step_y: Vec3::new(0.0, -1.0 / 16.0, 0.0),
    };
    CameraTiles { camera, size: (32, 32), corners: &CORNERS }
}

fn main() {
    let (few, many) = (cloud(64, 0.1), cloud(10_000, 0.02));
    let tree = SphereTree::new(many.clone());
    // `compare` says so to a program that is not optimised.
    if std::env::args().nth(1).is_some_and(|argument| argument == "stack") {
        return stack_suffices(&tree, 1 << 20);
    }
    stack_suffices(&tree, if cfg!(debug_assertions) { 512 << 10 } else { 256 << 10 });
    let mut memory = vec![0.0; DepthList::needed(many.len())];
    let mut scratch = vec![0.0; DepthList::scratch(many.len())];
    let sorted = DepthList::sort(many.spheres(), Viewpoint::Origin(EYE), &mut memory)
        .expect("memory as long as it is needed");
    let tree: Bvh<'_> = tree.bvh();
    let (primary, diffuse) = (Rays::new(primary()), Rays::new(diffuse()));
    for level in LevelName::ALL.into_iter().filter_map(Level::named) {
        let name = |row: &str| format!("{}/{row}", level.name().as_str());
        let plain = || Trace::new().at(level);
        let sorting = plain().coherent().with_scratch(&mut scratch);
        race(&name("list"), Exact, plain().coherent(), &few, &primary);
        race(&name("depth-list"), Exact, sorting, &sorted, &primary);
        race(&name("camera"), Exact, plain(), &tree, &primary);
        race(&name("camera-said"), Exact, plain().coherent(), &tree, &primary);
        race(&name("camera-fast"), Fast, plain(), &tree, &primary);
        race(&name("diffuse"), Exact, plain(), &tree, &diffuse);
        race(&name("diffuse-said"), Exact, plain().incoherent(), &tree, &diffuse);
        race(&name("diffuse-fast"), Fast, plain(), &tree, &diffuse);
    }
    race_one_by_one("best/camera", &tree, &primary);
    race_one_by_one("best/diffuse", &tree, &diffuse);
}
