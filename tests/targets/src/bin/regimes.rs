//! Prints a digest of every tier's answers in every lane width, which no build may change.
//!
//! The cases are those of `tests/cases/regimes.txt`, given as bits, and others a few ulp away; only the kernel computes
//! with floats here. The digest has the bits of every t and every index: of the pairs, of the closest hits in the list
//! of all spheres and the surfaces there, and of both roots. An argument changes one bit of the radius of the first
//! sphere that is hit.

#[path = "regimes/cases.rs"]
mod cases;

use spherule_kernel::{
    HitColumns, HitPacket, Intersect, Lanes, Ray, RayColumns, RayPacket, Sphere, SpherePacket,
    Spheres, SurfacePacket, Tier, Trace, f32x4, f32x8, f32x16, pair_lanes, roots, surface_lanes,
};
use spherule_targets::cases::Case;
use spherule_targets::digest::Fnv;
use std::process::ExitCode;

/// The digest of a tier in a width. Leaves out the index of a pair's sphere, since that is its lane.
fn digest<L: Lanes<Token = ()>>(tier: Tier, cases: &[Case]) -> u64 {
    let mut fnv = Fnv::new(false);
    for cases in cases.chunks(L::COUNT) {
        let rays: Vec<_> = cases.iter().map(|case| case.ray).collect();
        let spheres: Vec<Sphere> = cases.iter().map(|case| case.sphere).collect();
        let (rays, spheres) = (RayPacket::new(&rays), SpherePacket::new(&spheres));
        let hits = pair_lanes::<L>(tier, (), &rays, &spheres);
        hits.t().iter().take(cases.len()).for_each(|&t| fnv.number(t));
    }

    let kept = &cases[..cases::KEPT];
    let column = |get: fn(&Sphere) -> f32| kept.iter().map(|c| get(&c.sphere)).collect::<Vec<_>>();
    let (x, y) = (column(|s| s.center.x), column(|s| s.center.y));
    let (z, r) = (column(|s| s.center.z), column(|s| s.radius));
    let Ok(list) = Spheres::new(&x, &y, &z, &r) else { return 0 };
    // Spheres like those of the regimes, and a list that holds them all.
    for first in (0..kept.len()).step_by(60) {
        let end = first + 60;
        let part = Spheres::new(&x[first..end], &y[first..end], &z[first..end], &r[first..end]);
        lists::<L>(&mut fnv, tier, &kept[first..end], part.unwrap_or(list));
    }
    lists::<L>(&mut fnv, tier, kept, list);
    fnv.digest
}

fn lists<L: Lanes<Token = ()>>(fnv: &mut Fnv, tier: Tier, cases: &[Case], spheres: Spheres<'_>) {
    let rays: Vec<_> = cases.iter().map(|case| case.ray).collect();
    let packets: Vec<_> = rays.chunks(L::COUNT).map(RayPacket::<L::Array>::new).collect();
    // Slices and columns go at the best level that the CPU has, whatever L is.
    let (mut slice, mut occluded) = (vec![None; rays.len()], vec![false; rays.len()]);
    spheres.closest_hits(tier, &rays, &mut slice);
    spheres.any_hits(tier, &rays, &mut occluded);
    let column = |get: fn(&Ray) -> f32| rays.iter().map(get).collect::<Vec<_>>();
    let origin = [column(|r| r.origin.x), column(|r| r.origin.y), column(|r| r.origin.z)];
    let direction =
        [column(|r| r.direction.x), column(|r| r.direction.y), column(|r| r.direction.z)];
    let columns = RayColumns {
        origin: origin.each_ref().map(Vec::as_slice),
        direction: direction.each_ref().map(Vec::as_slice),
        t_min: &column(|r| r.t_min),
        t_max: &column(|r| r.t_max),
    };
    let (mut t, mut sphere) = (vec![0.0; rays.len()], vec![0; rays.len()]);
    let found = HitColumns { t: &mut t, sphere: &mut sphere };
    spheres.closest_hit_columns(tier, &mut Trace::new(), columns, found);
    for ray in 0..rays.len() {
        fnv.hit(slice[ray]);
        fnv.word(u32::from(occluded[ray]));
        fnv.number(t[ray]);
        fnv.word(sphere[ray]);
    }

    let (mut hits, mut occluded) = (vec![HitPacket::none(); packets.len()], vec![0; packets.len()]);
    spheres.closest_hit_lanes::<L>(tier, (), &mut Trace::new(), &packets, &mut hits);
    spheres.any_hit_lanes::<L>(tier, (), &mut Trace::new(), &packets, &mut occluded);
    let mut surfaces = SurfacePacket::none();
    // Ray by ray, since packet by packet would be another order in every width.
    for ray in 0..rays.len() {
        let (packet, lane) = (ray / L::COUNT, ray % L::COUNT);
        fnv.number(hits[packet].t()[lane]);
        fnv.word(hits[packet].spheres()[lane]);
        fnv.word(occluded[packet] >> lane & 1);
        let (rays, hits) = (&packets[packet], &hits[packet]);
        if lane == 0 {
            surfaces = surface_lanes::<L>(tier, (), spheres, rays, hits);
        }
        let (normal, point) = (surfaces.normal(lane), surfaces.point(lane));
        normal.to_array().into_iter().chain(point.to_array()).for_each(|x| fnv.number(x));
    }
}

/// Prints the digests of all widths, and returns whether they are equal.
fn widths(tier: Tier, cases: &[Case]) -> bool {
    let name = tier.as_str();
    let digests = [
        digest::<f32>(tier, cases),
        digest::<f32x4>(tier, cases),
        digest::<f32x8>(tier, cases),
        digest::<f32x16>(tier, cases),
    ];
    for (lanes, digest) in [1, 4, 8, 16].into_iter().zip(digests) {
        println!("{name} {lanes} lanes {digest:016x}");
    }
    let mut fnv = Fnv::new(false);
    for case in cases {
        match roots(tier, &case.ray, &case.sphere) {
            Some(roots) => roots.into_iter().for_each(|t| fnv.number(t)),
            None => fnv.word(0),
        }
    }
    println!("{name} roots {:016x}", fnv.digest);
    digests.iter().all(|digest| *digest == digests[0])
}

fn main() -> ExitCode {
    let mut cases = cases::all();
    if std::env::args().len() > 1 {
        let hit = cases.iter_mut().find(|c| roots(Tier::Exact, &c.ray, &c.sphere).is_some());
        let radius = &mut hit.expect("a hit").sphere.radius;
        *radius = f32::from_bits(radius.to_bits() ^ 1 << 12);
    }
    let agree =
        [Tier::Fast, Tier::Stable, Tier::Exact, Tier::Geometric].map(|tier| widths(tier, &cases));
    if agree.contains(&false) {
        eprintln!("FAILED: a lane width differs from another");
        return ExitCode::FAILURE;
    }
    ExitCode::SUCCESS
}
