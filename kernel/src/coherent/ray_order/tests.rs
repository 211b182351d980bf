//! What rays have in common.

extern crate std;

mod sorted;

use super::*;
use crate::proofs::climb::Random;
use std::vec;
use std::vec::Vec;

const GAIN: GainByOrder = GainByOrder { in_groups: true, is_far: true, is_any: false, radius: 2.0 };

pub(crate) fn point(random: &mut Random) -> Vec3 {
    let mut coordinate = || random.below(1 << 20) as f32 / (1 << 19) as f32 - 1.0;
    Vec3::new(coordinate(), coordinate(), coordinate())
}

pub(crate) fn rays(count: usize, mut ray: impl FnMut(&mut Random) -> Ray) -> Vec<Ray> {
    let mut random = Random(71);
    (0..count).map(|_| ray(&mut random)).collect()
}

pub(crate) const EYE: Vec3 = Vec3::new(0.2, -0.1, -3.0);

/// Rays of a camera's pixels in the order of a file: lines of 256.
fn scan_lines() -> Vec<Ray> {
    let pixel = |number: usize| {
        let [x, y] = [number % 256, number / 256].map(|pixel| pixel as f32 / 256.0 - 0.5);
        Ray::new(EYE, Vec3::new(x, y, 1.5))
    };
    (0..1 << 16).map(pixel).collect()
}

fn shuffled(mut rays: Vec<Ray>) -> Vec<Ray> {
    let mut random = Random(73);
    for end in (1..rays.len()).rev() {
        rays.swap(end, random.below(end as u64 + 1) as usize);
    }
    rays
}

pub(crate) fn beam(count: usize) -> Vec<Ray> {
    let along = Vec3::new(0.1, 0.3, -1.0);
    rays(count, |random| Ray::new(point(random) - 4.0 * along, along))
}

fn to_a_light(count: usize) -> Vec<Ray> {
    rays(count, |random| {
        let from = point(random);
        Ray { t_max: 1.0, ..Ray::new(from, Vec3::new(0.3, 5.0, 1.0) - from) }
    })
}

fn diffuse(count: usize) -> Vec<Ray> {
    rays(count, |random| Ray::new(point(random), point(random)))
}

fn space_of(rays: &[Ray], gain: GainByOrder) -> Option<Space> {
    RayKeys::of(&ManyRays::Slice(rays), gain).map(|order| order.space)
}

#[test]
fn rays_are_sorted_by_what_they_have_in_common() {
    let near = GainByOrder { is_far: false, ..GAIN };
    let incoherent = GainByOrder { in_groups: false, ..GAIN };
    let any = GainByOrder { is_any: true, ..incoherent };
    let (camera, many) = (shuffled(scan_lines()), FEWEST_IN_GROUPS);
    let cases = [
        (&camera[..], [Some(Space::Direction), Some(Space::Direction), Some(Space::Start), None]),
        (&to_a_light(many), [Some(Space::Direction), None, Some(Space::Start), Some(Space::Start)]),
        (&beam(many), [Some(Space::Crossing), Some(Space::Crossing), Some(Space::Start), None]),
        (&diffuse(many), [Some(Space::Start), None, Some(Space::Start), None]),
        // Too few for groups.
        (&beam(many - 1), [Some(Space::Start), None, Some(Space::Start), None]),
        (&[], [None; 4]),
    ];
    for (number, (rays, expected)) in cases.iter().enumerate() {
        let keys = [GAIN, near, incoherent, any].map(|gain| space_of(rays, gain));
        // Sorting by start brings nothing to rays of one start.
        let expected = if number == 0 { [expected[0], expected[1], None, None] } else { *expected };
        assert_eq!(keys, expected, "case {number}");
    }
}

#[test]
fn rays_are_parallel_within_a_sixteenth_of_their_mean() {
    for (aside, expected) in [(0.063, Some(Space::Crossing)), (0.069, None)] {
        let mut is_left = false;
        let rays = rays(FEWEST_IN_GROUPS, |random| {
            is_left = !is_left;
            let aside = if is_left { aside } else { -aside };
            Ray::new(point(random), Vec3::new(aside, 0.0, 1.0))
        });
        assert_eq!(space_of(&rays, GainByOrder { is_far: false, ..GAIN }), expected, "{aside}");
    }
}

/// Rays of two cameras, as many of each, which take turns of `run` rays.
fn two_cameras(run: usize, lines: &[Ray]) -> Vec<Ray> {
    let [mut one, mut other] = [lines[..1 << 15].iter(), lines[1 << 15..].iter()];
    let ray = |number: usize| {
        let is_other = number / run % 2 == 1;
        let ray = if is_other { other.next() } else { one.next() }.expect("as many of each");
        let looks_back = Ray { origin: -EYE, direction: -ray.direction, ..*ray };
        if is_other { looks_back } else { *ray }
    };
    (0..1 << 16).map(ray).collect()
}

/// By turns, shuffled, and with some other rays among them. Each gets all cells of a grid of its own.
#[test]
fn two_cameras_are_sorted_one_after_the_other() {
    let lines = scan_lines();
    let mut others = two_cameras(1, &lines);
    for (ray, other) in others.iter_mut().step_by(19).zip(diffuse(1 << 16)) {
        *ray = other;
    }
    let near = GainByOrder { is_far: false, ..GAIN };
    for rays in
        [two_cameras(1, &lines), two_cameras(2, &lines), shuffled(two_cameras(1, &lines)), others]
    {
        for gain in [GAIN, near] {
            let order = RayKeys::of(&ManyRays::Slice(&rays), gain).expect("in no order");
            assert!(order.space == Space::Direction && order.second.is_some(), "{order:?}");
            let of = |eye: Vec3| rays.iter().filter(move |ray| ray.origin == eye);
            let mut cells =
                [EYE, -EYE].map(|eye| of(eye).map(|ray| order.key(ray)).collect::<Vec<_>>());
            let is_apart = |cells: &[Vec<u32>; 2]| cells[0].iter().max() < cells[1].iter().min();
            let swapped = [cells[1].clone(), cells[0].clone()];
            assert!(is_apart(&cells) || is_apart(&swapped));
            for cells in &mut cells {
                cells.sort_unstable();
                cells.dedup();
                assert!(cells.len() > 1500, "{} cells", cells.len());
            }
        }
    }
    // The eyes of a stereoscope are as one camera.
    for (apart, is_sorted) in [(0.24, false), (0.26, true)] {
        let mut eyes = two_cameras(1, &lines);
        for (number, ray) in eyes.iter_mut().enumerate() {
            let side = if number % 2 == 0 { -0.5 } else { 0.5 };
            *ray = Ray { origin: EYE + side * apart * Vec3::X, ..lines[number] };
        }
        assert_eq!(space_of(&eyes, near).is_some(), is_sorted, "{apart}");
    }
    // Of three cameras there are not two points that most rays start in.
    let mut three = two_cameras(1, &lines);
    for ray in three.iter_mut().step_by(3) {
        ray.origin = Vec3::new(0.0, 3.0, 0.0);
    }
    assert_eq!(space_of(&three, near), None);
}

#[test]
fn rays_in_order_are_left_as_they_are() {
    let lines = scan_lines();
    assert_eq!(space_of(&lines, GAIN), None);
    assert_eq!(space_of(&lines.iter().rev().copied().collect::<Vec<_>>(), GAIN), None);
    // So are two cameras one after the other, and by turns of packets; and what has been sorted.
    for run in [1 << 15, 64, 16] {
        assert_eq!(space_of(&two_cameras(run, &lines), GAIN), None, "{run}");
    }
    let two = two_cameras(1, &lines);
    for rays in [shuffled(lines), beam(1 << 16), diffuse(1 << 16), two] {
        let order = RayKeys::of(&ManyRays::Slice(&rays), GAIN).expect("in no order");
        let (mut numbers, mut others) = (vec![0; rays.len()], vec![0; rays.len()]);
        order.write_keys::<wide::f32x16>((), &ManyRays::Slice(&rays), &mut numbers);
        sort(&mut numbers, &mut others);
        let sorted: Vec<_> = numbers.iter().map(|&place| rays[number_of(place)]).collect();
        assert_eq!(space_of(&sorted, GAIN), None, "{order:?}");
    }
}

#[test]
fn neither_units_nor_places_matter() {
    for (rays, expected) in [
        (shuffled(scan_lines()), Space::Direction),
        (beam(1 << 15), Space::Crossing),
        (to_a_light(1 << 15), Space::Direction),
        (diffuse(1 << 15), Space::Start),
    ] {
        let order = RayKeys::of(&ManyRays::Slice(&rays), GAIN).expect("in no order");
        for [place, length] in
            [[2_f32.powi(90), 1.0], [2_f32.powi(-90), 1.0], [1.0, 2_f32.powi(50)]]
        {
            let scaled = |ray: &Ray| Ray {
                origin: ray.origin * place,
                direction: ray.direction * (place * length),
                t_max: ray.t_max / length,
                ..*ray
            };
            let those: Vec<_> = rays.iter().map(scaled).collect();
            let gain = GainByOrder { radius: GAIN.radius * place, ..GAIN };
            let other = RayKeys::of(&ManyRays::Slice(&those), gain).expect("in no order");
            let keys = |order: RayKeys, rays: &[Ray]| {
                rays.iter().map(|ray| order.key(ray)).collect::<Vec<_>>()
            };
            assert!(keys(order, &rays) == keys(other, &those), "{expected:?}, {place}, {length}");
        }
        let moved =
            |ray: &Ray| Ray { origin: ray.origin + Vec3::new(300.0, -2000.0, 77.0), ..*ray };
        let gain = GainByOrder { radius: 4096.0, ..GAIN };
        assert_eq!(space_of(&rays.iter().map(moved).collect::<Vec<_>>(), gain), Some(expected));
    }
}
