//! The checks before the clock: our structures are held against brute force bit for bit, others
//! against ours within what single precision can do.

use crate::structures::contender::{Tier, Way};
use crate::structures::ours::{Answers, Rays, Search, Structures, sample};
use spherule_kernel::dispatch::Level;
use spherule_kernel::{Hit, Question, Ray, Sphere, Spheres};

/// Tests of brute force that a check may cost, in some of which all is a candidate.
const TESTS: usize = 1 << 26;

/// Asserts that every way answers as brute force: nearest hits bit for bit, any hit likewise.
///
/// `Fast` is not held to it: it may lose false hits of its textbook form.
///
/// # Panics
/// Where one does not.
pub fn ours(name: &str, rays: &[Ray], level: Level, structures: Structures<'_>) {
    let count = (TESTS / structures.spheres.len().max(1)).min(1 << 16);
    let rays = Rays::new(&sample(rays, count));
    let mut answers = Answers::new(rays.count());
    let mut search = |question, way, tier| {
        Search { question, way, tier, level }.run(structures, &rays, &mut answers);
        match question {
            Question::Nearest => {
                let bits = |hit: Hit| (hit.t.to_bits(), hit.sphere);
                answers.nearest().into_iter().map(|hit| hit.map(bits)).collect::<Vec<_>>()
            }
            // A hit that has a place is more than was asked for.
            Question::Any => answers.any().into_iter().map(|met| met.then_some((0, 0))).collect(),
        }
    };
    for tier in [Tier::Stable, Tier::Exact] {
        let nearest = search(Question::Nearest, Way::Brute, tier);
        for way in Way::ALL.into_iter().filter(|&way| structures.have(way)) {
            let own = search(Question::Nearest, way, tier);
            let met = search(Question::Any, way, tier);
            let who = format!("{name}, {}, {}, {level:?}", way.as_str(), tier.as_str());
            for index in 0..nearest.len() {
                assert_eq!(own[index], nearest[index], "{who}, ray {index}: nearest");
                let (met, any) = (met[index].is_some(), nearest[index].is_some());
                assert_eq!(met, any, "{who}, ray {index}: any hit");
            }
        }
    }
}

/// How far answers of others were from `Exact`'s.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Agreement {
    /// Rays that were compared.
    pub rays: usize,
    /// Rays that hit something.
    pub hits: usize,
    /// Where one hit and the other did not, or t differed by 1e-3, and single precision cannot tell:
    /// the sphere was grazed, the ray started on it, or t hangs on cancelled digits.
    pub by_little: usize,
    /// The same, without such a reason.
    pub wrong: usize,
    /// Where the question for any hit was answered otherwise.
    pub any: usize,
}

impl Agreement {
    /// Nearest hits and answers to the question for any, held against `truth`.
    ///
    /// # Panics
    /// Where there are not as many.
    #[must_use]
    pub fn of(
        rays: &[Ray],
        spheres: Spheres<'_>,
        truth: &[Option<Hit>],
        nearest: &[Option<Hit>],
        any: &[Option<Hit>],
    ) -> Self {
        assert!([truth.len(), nearest.len(), any.len()].iter().all(|&len| len == rays.len()));
        let mut agreement = Self { rays: rays.len(), ..Self::default() };
        for (((ray, truth), nearest), any) in rays.iter().zip(truth).zip(nearest).zip(any) {
            agreement.hits += usize::from(truth.is_some());
            agreement.any += usize::from(truth.is_some() != any.is_some());
            let agrees = match (truth, nearest) {
                (None, None) => true,
                (Some(truth), Some(nearest)) => (nearest.t - truth.t).abs() <= 1e-3 * truth.t,
                _ => false,
            };
            if agrees {
                continue;
            }
            // The nearer of the two is there or not there by little.
            let both = [*truth, *nearest].into_iter().flatten();
            let nearer = both.min_by(|a, b| a.t.total_cmp(&b.t));
            let sphere = nearer.and_then(|hit| spheres.get(hit.sphere as usize));
            // Where there are not two, a difference is no little one.
            let t = |hit: &Option<Hit>| hit.map_or(f64::INFINITY, |hit| f64::from(hit.t));
            let difference = (t(truth) - t(nearest)).abs();
            if sphere.is_some_and(|sphere| by_little(ray, &sphere, difference)) {
                agreement.by_little += 1;
            } else {
                agreement.wrong += 1;
            }
        }
        agreement
    }

    /// Asserts that at most `share` of the rays was answered wrongly.
    ///
    /// # Panics
    /// Where more were.
    #[must_use]
    pub fn within(self, share: f64, name: &str) -> Self {
        let most = (share * self.rays as f64) as usize;
        assert!(self.wrong <= most && self.any <= most + self.by_little, "{name}: {self:?}");
        self
    }
}

/// Whether single precision may be wrong about a ray and a sphere: the line grazes the sphere, the
/// ray starts on it, or t cannot be told more closely than by `difference`.
fn by_little(ray: &Ray, sphere: &Sphere, difference: f64) -> bool {
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let [o, d, c] = [ray.origin, ray.direction, sphere.center].map(|v| v.to_array().map(f64::from));
    let p = [c[0] - o[0], c[1] - o[1], c[2] - o[2]];
    let a = dot(d, d);
    let middle = dot(p, d) / a;
    let q = [p[0] - middle * d[0], p[1] - middle * d[1], p[2] - middle * d[2]];
    let (radius, distance) = (f64::from(sphere.radius), dot(p, p).sqrt());
    // What the point closest to the centre may be off by, and the discriminant with it.
    let off = 8.0 * f64::from(f32::EPSILON) * (distance + radius);
    let doubt = off * (2.0 * radius + off);
    let discriminant = radius * radius - dot(q, q);
    let grazes = discriminant.abs() <= doubt;
    let starts_on_it = (dot(p, p) - radius * radius).abs() <= doubt;
    grazes || starts_on_it || difference <= doubt / (2.0 * (discriminant * a).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;
    use spherule_kernel::Vec3;

    /// A unit sphere 3 away, and a ray past its middle at `height`.
    fn agreement(height: f32, answer: Option<f32>) -> Agreement {
        let ray = Ray::new(Vec3::new(0.0, height, -3.0), Vec3::Z);
        let spheres = Spheres::new(&[0.0], &[0.0], &[0.0], &[1.0]).expect("one");
        let hit = |t: f32| Hit { t, sphere: 0 };
        let truth = [(height <= 1.0).then(|| hit(3.0 - (1.0 - height * height).sqrt()))];
        let answer = [answer.map(hit)];
        Agreement::of(&[ray], spheres, &truth, &answer, &answer)
    }

    #[test]
    fn a_wrong_answer_is_told_from_a_close_call() {
        assert_eq!((agreement(0.0, Some(2.0)).wrong, agreement(0.0, Some(2.0)).by_little), (0, 0));
        assert_eq!((agreement(0.0, None).wrong, agreement(0.0, None).any), (1, 1));
        assert_eq!(agreement(0.0, Some(2.01)).wrong, 1);
        assert_eq!(agreement(1.0, None).by_little, 1);
        assert_eq!(agreement(1.000_001, Some(3.0)).by_little, 1);
        assert_eq!(agreement(1.01, Some(3.0)).wrong, 1);
    }
}
