//! Sorting keeps all rays, and brings together those that are near each other.

use super::*;
use crate::proofs::work::Work;
use crate::{
    Exact, Hit, HitPacket, Intersect, RayColumns, RayPacket, SphereList, SphereTree, Trace,
};

/// One ray in sixteen is broken.
fn broken(mut rays: Vec<Ray>) -> Vec<Ray> {
    let odd = [f32::NAN, f32::INFINITY, f32::MAX, 0.0, -f32::MAX, 1e-45];
    for (number, ray) in rays.iter_mut().enumerate().filter(|(number, _)| number % 16 == 5) {
        let value = odd[number / 16 % odd.len()];
        match number / 96 % 4 {
            0 => ray.origin.x = value,
            1 => ray.direction = Vec3::splat(value),
            2 => ray.t_max = value,
            _ => (ray.origin, ray.direction) = (Vec3::splat(value), Vec3::splat(value)),
        }
    }
    rays
}

#[test]
fn every_ray_keeps_its_place_among_the_answers() {
    let mut random = Random(79);
    let spheres: SphereList = (0..1000).map(|_| (point(&mut random), 0.02)).collect();
    let tree = SphereTree::new(spheres);
    let (mut met, mut kept) = (0, 0);
    // The second is sorted in two parts.
    for rays in [broken(shuffled(scan_lines())), broken(beam(70_000)), broken(diffuse(30_000))] {
        let bits = |hit: Option<Hit>| hit.map(|hit| (hit.t.to_bits(), hit.sphere));
        let one = rays.iter().map(|ray| bits(tree.closest_hit(Exact, ray))).collect::<Vec<_>>();
        let column = |of: &dyn Fn(&Ray) -> f32| rays.iter().map(of).collect::<Vec<_>>();
        let origin = [0, 1, 2].map(|axis: usize| column(&|ray| ray.origin[axis]));
        let direction = [0, 1, 2].map(|axis: usize| column(&|ray| ray.direction[axis]));
        let columns = RayColumns {
            origin: origin.each_ref().map(Vec::as_slice),
            direction: direction.each_ref().map(Vec::as_slice),
            t_min: &column(&|ray| ray.t_min),
            t_max: &column(&|ray| ray.t_max),
        };
        let mut trace = Trace::new();
        let (mut hits, mut occluded) = (vec![None; rays.len()], vec![false; rays.len()]);
        tree.closest_hits_with(Exact, &mut trace, &rays, &mut hits);
        tree.any_hits_with(Exact, &mut trace, &rays, &mut occluded);
        kept += usize::from(!trace.kept.take_numbers().is_empty());
        assert!(hits.iter().zip(&one).all(|(hit, one)| bits(*hit) == *one));
        assert!(occluded.iter().zip(&one).all(|(hit, one)| *hit == one.is_some()));
        let mut of_columns = (vec![0.0; rays.len()], vec![0; rays.len()]);
        let into = crate::HitColumns { t: &mut of_columns.0, sphere: &mut of_columns.1 };
        tree.closest_hit_columns(Exact, &mut Trace::new(), columns, into);
        let hits = of_columns.0.iter().zip(&of_columns.1);
        assert!(hits.zip(&one).all(|((t, sphere), one)| match one {
            Some(one) => (t.to_bits(), *sphere) == *one,
            None => *t == f32::INFINITY,
        }));
        // What the memory held before is no answer.
        let packets = rays.chunks(RayPacket::COUNT).map(RayPacket::new).collect::<Vec<_>>();
        let mut trace = Trace::new();
        let mut before = HitPacket::none();
        (before.t, before.sphere) = ([1e-9; 16], [7; 16]);
        let (mut hits, mut bits_of) = (vec![before; packets.len()], vec![!0; packets.len()]);
        tree.closest_hit_packets(Exact, &mut trace, &packets, &mut hits);
        tree.any_hit_packets(Exact, &mut trace, &packets, &mut bits_of);
        kept += usize::from(!trace.kept.take_numbers().is_empty());
        assert!(bits_of.iter().all(|bits| bits >> 16 == 0), "packets have sixteen lanes");
        for lane in 0..16 * packets.len() {
            let (hit, one) = (hits[lane / 16].hit(lane % 16), one.get(lane).copied().flatten());
            assert!(
                bits(hit) == one
                    && bits_of[lane / 16] >> (lane % 16) & 1 == u32::from(one.is_some())
            );
        }
        met += one.iter().flatten().count();
    }
    assert!(met > 10_000 && kept == 4, "{met} hits, {kept} of two were sorted, twice");
}

/// Shuffled rays of a camera and of a beam go together as if they were not shuffled, in packets, too. The work is measured by that of
/// ray by ray.
#[test]
fn shuffled_rays_take_half_the_work_of_ray_by_ray() {
    let mut random = Random(97);
    let spheres: SphereList = (0..10_000).map(|_| (point(&mut random), 0.02)).collect();
    let tree = SphereTree::new(spheres);
    for (rays, most) in [(shuffled(scan_lines()), 0.4), (beam(1 << 16), 0.5)] {
        let (mut hits, mut occluded) = (vec![None; rays.len()], vec![false; rays.len()]);
        let packets = rays.chunks(RayPacket::COUNT).map(RayPacket::new).collect::<Vec<_>>();
        let mut of_packets = (vec![HitPacket::none(); packets.len()], vec![0; packets.len()]);
        let mut works = |mut trace: Trace<'_>| {
            let (hits_of, bits) = &mut of_packets;
            [
                Work::of(|| tree.closest_hits_with(Exact, &mut trace, &rays, &mut hits)).units(),
                Work::of(|| tree.any_hits_with(Exact, &mut trace, &rays, &mut occluded)).units(),
                Work::of(|| tree.closest_hit_packets(Exact, &mut trace, &packets, hits_of)).units(),
                Work::of(|| tree.any_hit_packets(Exact, &mut trace, &packets, bits)).units(),
            ]
        };
        let [plain, apart] = [works(Trace::new()), works(Trace::new().incoherent())];
        for (plain, apart) in plain.iter().zip(apart) {
            assert!(plain / apart < most, "{} times the work", plain / apart);
        }
    }
}

/// Returns how wide the widest group on trial is, in either of two coordinates of its rays.
fn widest(rays: &[Ray], coordinates: impl Fn(&Ray) -> Vec3) -> f32 {
    let many = ManyRays::Slice(rays);
    let order = RayKeys::of(&many, GAIN).expect("in no order");
    let mut places = vec![0; rays.len()];
    order.write_keys::<wide::f32x16>((), &many, &mut places);
    let mut groups = [[Ray::new(Vec3::ZERO, Vec3::ZERO); RAYS_OF_A_GROUP]; GROUPS_TRIED];
    gather_some(&many, &places, &mut groups);
    let mut widest = 0.0_f32;
    for group in groups {
        let filled = group.iter().filter(|ray| ray.is_live()).map(&coordinates).collect::<Vec<_>>();
        assert!(filled.len() > RAYS_OF_A_GROUP / 4, "{} rays", filled.len());
        for axis in 0..2 {
            let at = filled.iter().map(|place| place[axis]);
            let [low, high] = [at.clone().fold(9.0, f32::min), at.fold(-9.0, f32::max)];
            widest = widest.max(high - low);
        }
    }
    widest
}

#[test]
fn groups_that_are_tried_are_of_rays_that_would_come_together() {
    // A cell of sixteen pixels by sixteen at most.
    let widest = widest(&shuffled(scan_lines()), |ray| ray.direction);
    assert!(widest < 16.0 / 256.0, "{}", 256.0 * widest);
}

/// Of 2^16 rays, too, a group has rays of one cell, not of two.
#[test]
fn groups_of_the_most_rays_are_of_one_cell_each() {
    // Where each crosses the plane z = 0: in a square of 2.8 by 2.8 at most.
    let crossing = |ray: &Ray| ray.origin - ray.direction * (ray.origin.z / ray.direction.z);
    let widest = widest(&beam(MOST), crossing);
    assert!(widest < 0.25, "{widest}");
}
