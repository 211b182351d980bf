//! The work is the same in every unit, and grows little where sizes are mixed.
//!
//! `cargo test -p spherule-proofs scales -- --nocapture` writes the highest figures of every way, and what they are of.

use super::climb::Random;
use super::work::Work;
use crate::coherent::packet_source::PacketSource;
use crate::coherent::tree_source::Ways;
use crate::dispatch::compiled::Compiled;
use crate::query::{AnyHit, ClosestHit};
use crate::{
    Bvh, Coherence, DepthList, Level, LevelName, Ray, RayPacket, Sphere, SphereTree, Tier, Trace,
    Vec3, Viewpoint,
};
use std::borrow::ToOwned;
use std::string::String;
use std::vec::Vec;
use std::{format, println, vec};

/// Exponents of scenes. Bounds would see 2^-40 to 2^41 if they did not scale.
const SCENES: [i32; 9] = [-100, -75, -60, -41, 0, 41, 64, 75, 100];
/// Exponents of directions; squares overflow from 2^64 on, and underflow below 2^-63.
const LENGTHS: [i32; 7] = [-110, -100, -51, 0, 51, 100, 126];

/// How many spheres most scenes have.
const SPHERES: usize = 10_000;

/// In [-1, 1).
fn number(random: &mut Random) -> f32 {
    random.below(1 << 24) as f32 / (1 << 23) as f32 - 1.0
}

pub(super) fn point(random: &mut Random) -> Vec3 {
    Vec3::new(number(random), number(random), number(random))
}

/// Centres in [-1, 1]^3, some four radii apart.
fn uniform(count: usize) -> Vec<Sphere> {
    let mut random = Random(70);
    let radius = 0.5 / (count as f32).cbrt();
    let mut sphere = || Sphere {
        center: point(&mut random),
        radius: radius * (1.0 + 0.5 * number(&mut random)),
    };
    (0..count).map(|_| sphere()).collect()
}

/// A picture of 16 x 16 pixels, so narrow that the rays of a group meet the same spheres: tile by tile, a packet each.
fn camera() -> Vec<Ray> {
    let eye = Vec3::new(0.3, 0.4, 4.0);
    let way = -eye.normalize();
    let right = way.cross(Vec3::Y).normalize();
    let up = right.cross(way);
    let slope = |pixel: usize| (pixel as f32 - 7.5) / 256.0;
    let ray = |number: usize| {
        let (tile, within) = (number / 16, number % 16);
        let (x, y) = (tile % 4 * 4 + within % 4, tile / 4 * 4 + within / 4);
        Ray::new(eye, way + slope(x) * right + slope(y) * up)
    };
    (0..256).map(ray).collect()
}

/// Rays that have nothing in common.
fn diffuse() -> Vec<Ray> {
    let mut random = Random(100);
    (0..256).map(|_| Ray::new(point(&mut random), point(&mut random))).collect()
}

fn power_of_two(exponent: i32) -> f32 {
    2.0_f64.powi(exponent) as f32
}

fn scaled(sphere: &Sphere, exponent: i32) -> Sphere {
    let factor = power_of_two(exponent);
    Sphere { center: sphere.center * factor, radius: sphere.radius * factor }
}

fn scaled_all(spheres: &[Sphere], exponent: i32) -> Vec<Sphere> {
    spheres.iter().map(|sphere| scaled(sphere, exponent)).collect()
}

/// Multiplies origins by one power of two, and directions by another.
fn scaled_rays(rays: &[Ray], exponent: i32, length: i32) -> Vec<Ray> {
    let [origin, direction] = [exponent, length].map(power_of_two);
    rays.iter().map(|ray| Ray::new(ray.origin * origin, ray.direction * direction)).collect()
}

/// The ways to answer rays. Of a tree, what it is told of them.
const WAYS: [&str; 4] = ["list", "depth list", "coherent", "incoherent"];

/// The work of every way, for closest hits and for any hits.
type Costs = [[f64; 4]; 2];

/// The work of answering rays, for which a depth list is sorted from where the first begins.
fn costs(tier: Tier, spheres: &[Sphere], rays: &[Ray]) -> Costs {
    let tree = SphereTree::new(spheres);
    let mut memory = vec![0.0; DepthList::needed(spheres.len())];
    let viewpoint = Viewpoint::Origin(rays[0].origin);
    let list = tree.list().spheres();
    let depth_list = DepthList::sort(list, viewpoint, &mut memory).expect("enough memory");
    let packets: Vec<RayPacket> = rays.chunks(RayPacket::COUNT).map(RayPacket::new).collect();
    let bvh = tree.bvh();
    [
        works::<ClosestHit>(tier, &bvh, &depth_list, &packets),
        works::<AnyHit>(tier, &bvh, &depth_list, &packets),
    ]
}

/// The work of a query in every way.
fn works<Q: Compiled>(
    tier: Tier,
    bvh: &Bvh<'_>,
    depth_list: &DepthList<'_>,
    packets: &[RayPacket],
) -> [f64; 4] {
    // The same instructions on every machine.
    let level = Level::named(LevelName::Baseline).unwrap_or(Level::best());
    let mut answers = vec![Q::none::<[f32; 16]>(); packets.len()];
    let mut scratch = vec![0.0; DepthList::scratch(bvh.spheres.len())];
    let list = Work::of(|| Q::list(level, tier, bvh.spheres, packets, &mut answers));
    let mut trace = Trace::new();
    let memory = (&mut scratch[..], &mut trace.learnt);
    let by_depth =
        Work::of(|| Q::depth_list(level, tier, depth_list, memory, packets, &mut answers));
    let [together, apart] = [Coherence::Coherent, Coherence::Incoherent].map(|coherence| {
        let mut trace = Trace::new();
        let (kept, learnt) = (&mut trace.kept, &mut trace.learnt);
        // No packet is left to the caller: its rays would go one by one, and little of that is counted.
        let ways = Ways { coherence, lent: None, kept, learnt, alone: None };
        let source = PacketSource::Packets(packets);
        Work::of(|| Q::tree(level, tier, bvh, ways, source, &mut answers))
    });
    [list, by_depth, together, apart].map(|work| work.units())
}

/// For every way the most work, as a multiple of other work, and what it is of.
#[derive(Default)]
struct Most([(f64, String); 4]);

impl Most {
    fn take(&mut self, of: &str, costs: Costs, others: Costs) {
        for (costs, others) in costs.into_iter().zip(others) {
            for (most, (cost, other)) in self.0.iter_mut().zip(costs.into_iter().zip(others)) {
                if cost / other > most.0 {
                    *most = (cost / other, of.to_owned());
                }
            }
        }
    }

    /// Fails if a way takes more than its limit; writes the figures first.
    fn assert_within(&self, limits: [f64; 4]) {
        for (way, (most, of)) in WAYS.iter().zip(&self.0) {
            println!("{way}: {most:.3} times the work, {of}");
        }
        for ((way, limit), (most, of)) in WAYS.iter().zip(limits).zip(&self.0) {
            assert!(*most <= limit, "{way}: {most:.3} times the work, {of}");
        }
    }
}

/// The list's work instead of that of every way.
fn of_list(costs: Costs) -> Costs {
    costs.map(|[list, ..]| [list; 4])
}

#[test]
fn every_scale_costs_the_same() {
    let spheres = uniform(SPHERES);
    let mut most = Most::default();
    for (name, rays) in [("a camera", camera()), ("diffuse", diffuse())] {
        let plain = [Tier::Exact, Tier::Stable].map(|tier| (tier, costs(tier, &spheres, &rays)));
        for exponent in SCENES {
            let spheres = scaled_all(&spheres, exponent);
            for length in LENGTHS {
                // Otherwise every t is infinite, or zero.
                if (exponent - length).abs() > 120 {
                    continue;
                }
                let rays = scaled_rays(&rays, exponent, length);
                for (tier, plain) in plain {
                    // Other scenes are outside of the domain of `Stable`.
                    if tier == Tier::Stable && exponent != 0 {
                        continue;
                    }
                    let of = format!("{tier:?}, {name}, scene 2^{exponent}, |d| 2^{length}");
                    most.take(&of, costs(tier, &spheres, &rays), plain);
                }
            }
        }
    }
    most.assert_within([1.02; 4]);
}

/// Every t is infinite, or zero, so that no bound can order the hits: a tree still does a part of the work of its list.
#[test]
fn no_scale_costs_what_brute_force_does() {
    let (spheres, rays) = (uniform(4 * SPHERES), camera());
    let mut most = Most::default();
    for (exponent, length) in [(-100, 100), (100, -100), (-75, 126), (100, -149)] {
        let rays = scaled_rays(&rays, exponent, length);
        let costs = costs(Tier::Exact, &scaled_all(&spheres, exponent), &rays);
        let of = format!("scene 2^{exponent}, |d| 2^{length}");
        most.take(&of, costs, of_list(costs));
    }
    // Nothing is promised of a depth list.
    most.assert_within([1.01, f64::INFINITY, 0.7, 0.7]);
}

/// Scenes of many sizes; in the first three one sphere has another size than all others.
fn mixed() -> [(&'static str, Vec<Sphere>); 7] {
    let with = |sphere: Sphere| {
        let mut spheres = uniform(SPHERES);
        spheres.insert(SPHERES / 2, sphere);
        spheres
    };
    let half = |exponent: i32| {
        let mut spheres = uniform(SPHERES);
        for sphere in spheres.iter_mut().step_by(2) {
            *sphere = scaled(sphere, exponent);
        }
        spheres
    };
    let ground = Sphere { center: Vec3::new(0.0, -1.5, 0.0), radius: 1.0 };
    let tiny = Sphere { center: Vec3::ZERO, radius: 1e-30 };
    let mut random = Random(102);
    let any = |sphere: &Sphere| scaled(sphere, random.below(241) as i32 - 120);
    [
        ("one of 2^60", with(scaled(&ground, 60))),
        ("one of 2^100", with(scaled(&ground, 100))),
        ("one of 2^-100", with(tiny)),
        ("half 2^60 times as large", half(60)),
        ("half 2^100 times as large", half(100)),
        ("half 2^-100 times as large", half(-100)),
        ("every size", uniform(SPHERES).iter().map(any).collect()),
    ]
}

#[test]
fn mixed_sizes_cost_little_more_than_a_list() {
    let mut most = Most::default();
    for (name, spheres) in mixed() {
        for exponent in [0, 60, 100, -100] {
            let costs = costs(Tier::Exact, &spheres, &scaled_rays(&camera(), exponent, 0));
            most.take(&format!("{name}, rays at 2^{exponent}"), costs, of_list(costs));
        }
    }
    most.assert_within([1.01, 1.01, 1.1, 1.1]);
}

/// A sphere that no bound covers costs what it costs in a list: the others are not tested one by one because of it.
#[test]
fn one_large_sphere_leaves_the_others_in_the_tree() {
    let rays = camera();
    let plain = costs(Tier::Exact, &uniform(SPHERES), &rays);
    let mut most = Most::default();
    for (name, spheres) in mixed().into_iter().take(3) {
        most.take(name, costs(Tier::Exact, &spheres, &rays), plain);
    }
    most.assert_within([1.1; 4]);
}

/// The control of the counts: large spheres that are more than the others do leave these out of the tree.
#[test]
fn spheres_outside_of_the_tree_are_seen() {
    let rays = camera();
    let plain = costs(Tier::Exact, &uniform(SPHERES), &rays);
    let mut spheres = uniform(SPHERES);
    spheres.extend(scaled_all(&uniform(SPHERES + 1), 100));
    let mut most = Most::default();
    most.take("outside", costs(Tier::Exact, &spheres, &rays), plain);
    most.assert_within([f64::INFINITY; 4]);
    assert!(most.0.iter().skip(1).all(|(most, _)| *most > 2.0));
}
