//! Whether an answer is right, before it is timed.
//!
//! Two witnesses that share no code: the kernel's own one-lane form, which every width must equal
//! bit for bit, and a solution in double precision written here, which every tier and every peer
//! must come near to. A fast wrong answer is no answer.

use crate::workload::packets;
use spherule_kernel::{Accuracy, Hit, HitPacket, Lanes, Ray, Sphere, Spheres, nearest};

/// How far answers may be from those in double precision.
#[derive(Clone, Copy, Debug)]
pub struct Tolerance {
    /// Rays of 1024 whose hit is a miss, whose miss a hit, or who met another sphere.
    pub wrong: usize,
    /// The relative error of `t` where the decision is right.
    pub relative: f64,
}

impl Tolerance {
    /// The textbook form in single precision: p.p - r^2 cancels some thousandfold here.
    pub const TEXTBOOK: Self = Self { wrong: 8, relative: 1e-3 };
    /// The same for the lecture's form, where a list has a ground: r^2 = 1e6 is known to some 0.1,
    /// which is some 1e-4 of length, and some of the rays start as near to the ground as 0.1.
    pub const TEXTBOOK_OVER_GROUND: Self = Self { wrong: 8, relative: 1e-2 };
    /// The closest-point form: right on all these rays; grazing ones lose a few bits of t.
    pub const CLOSEST_POINT: Self = Self { wrong: 0, relative: 4e-6 };
    /// The same, where a list has a ground. Its discriminant may cancel to a 32nd of its terms and
    /// the root to an 8th of half the chord before the tier reaches for two-term arithmetic: 6 u of
    /// the terms (u = 2^-24) are 96 u of half the chord, and 768 u of the root.
    pub const CLOSEST_POINT_OVER_GROUND: Self = Self { wrong: 0, relative: 4.6e-5 };
    /// Correctly rounded: half an ulp, and the reference's own error.
    pub const EXACT: Self = Self { wrong: 0, relative: 6.0e-8 };
}

/// The nearest hit of every ray in double precision: closest point first, the smaller root.
#[must_use]
pub fn reference(rays: &[Ray], spheres: &[Sphere]) -> Vec<Option<(f64, u32)>> {
    rays.iter().map(|ray| reference_hit(ray, spheres)).collect()
}

fn reference_hit(ray: &Ray, spheres: &[Sphere]) -> Option<(f64, u32)> {
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let o = ray.origin.to_array().map(f64::from);
    let d = ray.direction.to_array().map(f64::from);
    let a = dot(d, d);
    let mut best = None;
    for (index, sphere) in spheres.iter().enumerate() {
        let c = sphere.center.to_array().map(f64::from);
        let p = [c[0] - o[0], c[1] - o[1], c[2] - o[2]];
        let middle = dot(p, d) / a;
        let q = [p[0] - middle * d[0], p[1] - middle * d[1], p[2] - middle * d[2]];
        let radius = f64::from(sphere.radius);
        let half = ((radius * radius - dot(q, q)) / a).sqrt();
        let accepted = |t: f64| f64::from(ray.t_min) <= t && t <= f64::from(ray.t_max);
        let roots = [middle - half, middle + half];
        let Some(t) = roots.into_iter().find(|&t| accepted(t)) else { continue };
        if best.is_none_or(|(nearest, _)| t < nearest) {
            best = Some((t, index as u32));
        }
    }
    best
}

/// The nearest hit of every ray, by the kernel in lanes of `L`.
#[must_use]
pub fn kernel_hits<A: Accuracy, L: Lanes<Token = ()>>(
    rays: &[Ray],
    spheres: Spheres<'_>,
) -> Vec<Option<Hit>> {
    let packets = packets::<L>(rays);
    let mut hits = vec![HitPacket::<L>::none(); packets.len()];
    nearest::<A, L>((), &packets, spheres, &mut hits);
    let all = hits.iter().flat_map(|packet| (0..L::COUNT).map(|lane| packet.hit(lane)));
    all.take(rays.len()).collect()
}

/// Asserts that lanes of `L` answer with the bits of one lane.
///
/// # Panics
/// Where they do not.
pub fn same_bits<A: Accuracy, L: Lanes<Token = ()>>(rays: &[Ray], spheres: Spheres<'_>) {
    let bits = |hit: Option<Hit>| hit.map(|hit| (hit.t.to_bits(), hit.sphere));
    let single = kernel_hits::<A, f32>(rays, spheres);
    let wide = kernel_hits::<A, L>(rays, spheres);
    for (index, (&single, &wide)) in single.iter().zip(&wide).enumerate() {
        assert_eq!(
            bits(wide),
            bits(single),
            "{}, {} lanes, ray {index}: {wide:?} for {single:?}",
            A::NAME,
            L::COUNT
        );
    }
}

/// Asserts that `answers` are the reference's within `tolerance`.
///
/// # Panics
/// Where they are not, or where there are not as many.
pub fn near_reference(
    name: &str,
    answers: &[Option<Hit>],
    reference: &[Option<(f64, u32)>],
    tolerance: Tolerance,
) {
    assert_eq!(answers.len(), reference.len(), "{name}");
    let mut wrong = 0;
    for (index, (answer, truth)) in answers.iter().zip(reference).enumerate() {
        match (answer, truth) {
            (None, None) => {}
            (Some(hit), Some((t, sphere))) if hit.sphere == *sphere => {
                let error = ((f64::from(hit.t) - t) / t).abs();
                assert!(
                    error <= tolerance.relative,
                    "{name}, ray {index}: t = {}, off by {error:e}",
                    hit.t
                );
            }
            _ => wrong += 1,
        }
    }
    assert!(wrong <= tolerance.wrong, "{name}: {wrong} wrong answers of {}", answers.len());
}

/// The largest relative error of `t` where the decision is right.
#[must_use]
pub fn worst(answers: &[Option<Hit>], reference: &[Option<(f64, u32)>]) -> f64 {
    let both = answers.iter().zip(reference).filter_map(|(hit, truth)| (*hit).zip(*truth));
    let same_sphere = both.filter(|(hit, (_, sphere))| hit.sphere == *sphere);
    let errors = same_sphere.map(|(hit, (t, _))| ((f64::from(hit.t) - t) / t).abs());
    errors.fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::workload::{Cloud, Kind};

    #[test]
    #[should_panic(expected = "wrong answers")]
    fn a_wrong_sphere_is_seen() {
        let (cloud, rays) = (Cloud::new(64), Kind::Camera.rays());
        let truth = reference(&rays, &cloud.list());
        let answers: Vec<_> = truth
            .iter()
            .map(|hit| hit.map(|(t, sphere)| Hit { t: t as f32, sphere: sphere + 1 }))
            .collect();
        near_reference("shifted", &answers, &truth, Tolerance::TEXTBOOK);
    }

    #[test]
    #[should_panic(expected = "off by")]
    fn a_wrong_t_is_seen() {
        let (cloud, rays) = (Cloud::new(64), Kind::Incoherent.rays());
        let truth = reference(&rays, &cloud.list());
        let answers: Vec<_> = truth
            .iter()
            .map(|hit| hit.map(|(t, sphere)| Hit { t: t as f32 * 1.01, sphere }))
            .collect();
        near_reference("stretched", &answers, &truth, Tolerance::TEXTBOOK);
    }

    #[test]
    fn there_is_something_to_hit() {
        let list = Cloud::new(64).list();
        for kind in Kind::ALL {
            let hits = reference(&kind.rays(), &list).into_iter().flatten().count();
            assert!((40..900).contains(&hits), "{}: {hits}", kind.name());
        }
    }
}
