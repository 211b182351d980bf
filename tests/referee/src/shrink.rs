//! Finds the smallest case that fails in the same way: one sphere if one does, small integers, few digits.
//!
//! Starting from a case that fails, simpler cases are tried, the simplest first. The first that fails is the next to start from, until none
//! fails or the time is over. Many cases are tried in one call, since a call of the judged code may be expensive.

use crate::failure::{Failure, PLAINLY_OFF};
use crate::simplicity::weight;
use crate::verdict::Kind;
use spherule_kernel::{Ray, Sphere, Vec3};
use std::time::{Duration, Instant};

/// How many bits of a significand are kept.
const BITS: [u32; 12] = [1, 2, 3, 4, 5, 6, 8, 10, 12, 15, 18, 21];

/// The place of the first sphere among the numbers of a case, which begin with the ray's.
const SPHERES: usize = 8;

/// A ray and its spheres.
pub type Candidate = (Ray, Vec<Sphere>);

/// Returns the simplest case, found within a time, that fails as `failure` does.
///
/// `failures` judges up to `at_once` cases: it returns one entry for each, `None` where the answer is right, or fewer if its own time is
/// over. If t is off, a case counts only if its t is plainly off, or off by as much as the first was.
pub fn shrink(
    failure: &Failure,
    (time, at_once): (Duration, usize),
    mut failures: impl FnMut(&[Candidate]) -> Vec<Option<Failure>>,
) -> Failure {
    let (start, mut best) = (Instant::now(), failure.clone());
    let least = if failure.kind == Kind::T { failure.severity.min(PLAINLY_OFF) } else { 0.0 };
    let is_alike = |found: &Failure| {
        found.kind == failure.kind && (failure.kind != Kind::T || found.severity >= least)
    };
    loop {
        let mut simpler = candidates(&best);
        simpler.sort_by_key(|(ray, spheres)| weight(ray, spheres));
        simpler.dedup();
        let mut next = None;
        for some in simpler.chunks(at_once.max(1)) {
            if start.elapsed() >= time {
                return best;
            }
            next = failures(some).into_iter().flatten().find(is_alike);
            if next.is_some() {
                break;
            }
        }
        match next {
            Some(found) => best = Failure { family: failure.family, row: None, ..found },
            None => return best,
        }
    }
}

/// Cases simpler than this one.
fn candidates(failure: &Failure) -> Vec<Candidate> {
    let Failure { ray, spheres, .. } = failure;
    let now = weight(ray, spheres);
    let mut all: Vec<Candidate> = Vec::new();
    if spheres.len() > 1 {
        for index in 0..spheres.len() {
            all.push((*ray, vec![spheres[index]]));
            let others = spheres.iter().enumerate().filter(|(other, _)| *other != index);
            all.push((*ray, others.map(|(_, sphere)| *sphere).collect()));
        }
    }
    let numbers = numbers_of(ray, spheres);
    let mut push = |change: &dyn Fn(usize, f32) -> f32| {
        let changed = numbers.iter().enumerate().map(|(place, &x)| change(place, x));
        all.push(case_of(&changed.collect::<Vec<_>>()));
    };
    // Changes one number.
    for (place, &number) in numbers.iter().enumerate() {
        for simple in simpler_numbers(number, place) {
            push(&|other, x| if other == place { simple } else { x });
        }
    }
    // Scales all lengths, or the direction, or both by a power of two; cuts all numbers to fewer bits.
    let is_length = |place: usize| !(3..SPHERES).contains(&place);
    let is_direction = |place: usize| (3..6).contains(&place);
    for exponent in [-64, -16, -4, -1, 1, 4, 16, 64] {
        let scale = |x: f32| (f64::from(x) * 2.0_f64.powi(exponent)) as f32;
        push(&|place, x| if is_length(place) { scale(x) } else { x });
        push(&|place, x| if is_length(place) || is_direction(place) { scale(x) } else { x });
        push(&|place, x| if is_direction(place) { scale(x) } else { x });
    }
    for bits in BITS {
        push(&|_, x| with_bits(x, bits));
    }
    push(&|_, x| if x.is_finite() { x.round() } else { x });
    // Moves an axis so that the ray or a sphere is at its zero; puts the direction along an axis.
    for axis in 0..3 {
        let is_of_axis =
            |place: usize| place == axis || place >= SPHERES && (place - SPHERES) % 4 == axis;
        for zero in [axis, SPHERES + axis] {
            push(&|place, x| if is_of_axis(place) { x - numbers[zero] } else { x });
        }
        push(&|place, x| if is_direction(place) && place != 3 + axis { 0.0 } else { x });
    }
    all.retain(|(ray, spheres)| weight(ray, spheres) < now);
    all
}

/// Simpler numbers to replace `x`.
fn simpler_numbers(x: f32, place: usize) -> Vec<f32> {
    let mut simple = vec![0.0, 1.0, -1.0, 2.0, 3.0, -x];
    // This place is t_max.
    if place == 7 {
        simple.push(f32::INFINITY);
    }
    if x.is_finite() {
        simple.extend([x.round(), x.trunc(), x / 2.0, x * 2.0, x - 1.0, x + 1.0]);
        simple.extend(BITS.map(|bits| with_bits(x, bits)));
        let exponent = x.abs().log2();
        if exponent.is_finite() {
            let half = 2.0_f64.powi(-(exponent / 2.0) as i32);
            simple.push((f64::from(x) * half) as f32);
        }
    }
    simple
}

/// The number cut to `bits` bits of the significand.
fn with_bits(x: f32, bits: u32) -> f32 {
    if x.is_finite() { f32::from_bits(x.to_bits() & (u32::MAX << (24 - bits.min(24)))) } else { x }
}

fn numbers_of(ray: &Ray, spheres: &[Sphere]) -> Vec<f32> {
    let (origin, direction) = (ray.origin.to_array(), ray.direction.to_array());
    let spheres = spheres.iter().flat_map(|sphere| sphere.center.extend(sphere.radius).to_array());
    let ends = [ray.t_min, ray.t_max];
    origin.into_iter().chain(direction).chain(ends).chain(spheres).collect()
}

fn case_of(numbers: &[f32]) -> Candidate {
    let vector = |from: usize| Vec3::from_slice(&numbers[from..from + 3]);
    let ray = Ray { origin: vector(0), direction: vector(3), t_min: numbers[6], t_max: numbers[7] };
    (ray, numbers[SPHERES..].as_chunks::<4>().0.iter().map(|&row| row.into()).collect())
}
