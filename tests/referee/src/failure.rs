//! Wrong answers: of each kind the worst and the simplest are kept.

use crate::aim::double;
use crate::answer::Answer;
use crate::random::dot;
use crate::simplicity::weight;
use crate::verdict::Kind;
use spherule_kernel::{Hit, Ray, Sphere};

/// A t that is off by less makes no good example, since half of its digits are right.
pub const PLAINLY_OFF: f64 = 4096.0;
/// A failure keeps all spheres if there are no more than this.
const FEW_SPHERES: usize = 16;

/// An answer that is wrong under an intersector's own rules.
#[derive(Clone, Debug, PartialEq)]
pub struct Failure {
    /// In which way the answer is wrong.
    pub kind: Kind,
    /// How wrong the answer is, as [`Verdict::Wrong`](crate::verdict::Verdict::Wrong) says.
    pub severity: f64,
    /// The ray.
    pub ray: Ray,
    /// The spheres: all if they are few, else the true one and the answered one, or, if neither is known, the one that is nearest to the
    /// answered point.
    pub spheres: Vec<Sphere>,
    /// The answer; its sphere is an index into `spheres`.
    pub answer: Option<Answer>,
    /// The truth; its sphere is an index into `spheres`.
    pub truth: Option<Hit>,
    /// The number of the family, if it is known.
    pub family: Option<u8>,
    /// The number of the ray; `None` once the failure has been shrunk.
    pub row: Option<u64>,
}

/// A failure before it is decided whether it is kept. It has all spheres, and its indices are theirs.
pub(crate) struct NewFailure<'a> {
    pub(crate) kind: Kind,
    pub(crate) severity: f64,
    pub(crate) ray: &'a Ray,
    pub(crate) spheres: &'a [Sphere],
    pub(crate) answer: Option<Answer>,
    pub(crate) truth: Option<Hit>,
    pub(crate) family: Option<u8>,
    pub(crate) row: u64,
}

/// The failures that are kept, by kind.
#[derive(Clone, Debug, Default)]
pub(crate) struct Failures {
    pub(crate) worst: [Option<Failure>; Kind::ALL.len()],
    pub(crate) simplest: [Option<Failure>; Kind::ALL.len()],
}

impl Failures {
    /// Keeps a failure if it is the worst of its kind so far, or the simplest.
    pub(crate) fn add(&mut self, new: &NewFailure<'_>) {
        let worst = &mut self.worst[new.kind as usize];
        let simplest = &mut self.simplest[new.kind as usize];
        let is_worst = worst.as_ref().is_none_or(|worst| new.is_worse(worst));
        let is_simplest = simplest.as_ref().is_none_or(|simplest| new.is_simpler(simplest));
        if is_worst {
            *worst = Some(new.kept());
        }
        if is_simplest {
            *simplest = Some(new.kept());
        }
    }
}

impl NewFailure<'_> {
    fn is_worse(&self, than: &Failure) -> bool {
        // A severity of NaN counts as the least.
        let size = |severity: f64| if severity.is_nan() { -1.0 } else { severity };
        size(self.severity) > size(than.severity)
    }

    fn is_simpler(&self, than: &Failure) -> bool {
        let faint = |severity: f64| self.kind == Kind::T && severity < PLAINLY_OFF;
        let weight =
            |ray: &Ray, spheres: &[Sphere]| weight(ray, &spheres[..spheres.len().min(FEW_SPHERES)]);
        (faint(self.severity), weight(self.ray, self.spheres))
            < (faint(than.severity), weight(&than.ray, &than.spheres))
    }

    /// The failure with all spheres if they are few, else with those that it names.
    fn kept(&self) -> Failure {
        let named = self.answer.and_then(|answer| answer.sphere);
        let indices = [self.truth.map(|hit| hit.sphere), named];
        let (spheres, [truth, named]) = relevant(self.spheres, indices, || self.nearest());
        Failure {
            kind: self.kind,
            severity: self.severity,
            ray: *self.ray,
            spheres,
            answer: self.answer.map(|answer| Answer { sphere: named, ..answer }),
            truth: self.truth.zip(truth).map(|(hit, sphere)| Hit { sphere, ..hit }),
            family: self.family,
            row: Some(self.row),
        }
    }

    /// The sphere whose surface is nearest to the answered point.
    fn nearest(&self) -> Option<u32> {
        let t = self.answer?.t;
        let (o, d) = (double(self.ray.origin), double(self.ray.direction));
        let point: [f64; 3] = core::array::from_fn(|i| o[i] + t * d[i]);
        let distance = |sphere: &Sphere| {
            let c = double(sphere.center);
            let p = core::array::from_fn(|i| point[i] - c[i]);
            // NaN is farther than any number.
            (dot(p, p).sqrt() - f64::from(sphere.radius)).abs()
        };
        let all = (0..).zip(self.spheres);
        all.min_by(|(_, a), (_, b)| distance(a).total_cmp(&distance(b))).map(|(index, _)| index)
    }
}

/// The spheres of a failure, and the places of the indexed ones among them. If none of these exists, `other` is kept.
fn relevant(
    spheres: &[Sphere],
    indices: [Option<u32>; 2],
    other: impl FnOnce() -> Option<u32>,
) -> (Vec<Sphere>, [Option<u32>; 2]) {
    if spheres.len() <= FEW_SPHERES {
        return (spheres.to_vec(), indices);
    }
    let there = |index: &u32| spheres.get(*index as usize).copied();
    let mut kept: Vec<u32> = indices.into_iter().flatten().collect();
    if !kept.iter().any(|index| there(index).is_some()) {
        kept.extend(other());
    }
    kept.sort_unstable();
    kept.dedup();
    let place = |index: u32| kept.iter().position(|&kept| kept == index).map(|place| place as u32);
    let places = indices.map(|index| index.and_then(place));
    (kept.iter().filter_map(there).collect(), places)
}

#[cfg(test)]
mod tests {
    use super::*;
    use spherule_kernel::Vec3;

    /// Beside a ray, the last one the nearest.
    fn many() -> Vec<Sphere> {
        let mut spheres: Vec<_> =
            (0..20).map(|i| Sphere::from([9.0 + i as f32, 0.0, 50.0, 1.0])).collect();
        spheres.push(Sphere::from([1.25, 0.0, 50.0, 1.0]));
        spheres
    }

    #[test]
    fn a_false_hit_without_a_sphere_keeps_the_nearest() {
        let (ray, spheres) = (Ray::new(Vec3::ZERO, Vec3::Z), many());
        for (sphere, kind) in [(None, Kind::FalseHit), (Some(99), Kind::NoAnswer)] {
            let new = NewFailure {
                kind,
                severity: 1.0,
                ray: &ray,
                spheres: &spheres,
                answer: Some(Answer { t: 50.0, sphere }),
                truth: None,
                family: None,
                row: 0,
            };
            let kept = new.kept();
            assert_eq!(kept.spheres, [spheres[20]]);
            // A sphere that does not exist is none of those that are kept.
            assert_eq!(kept.answer.and_then(|answer| answer.sphere), sphere.map(|_| 1));
        }
    }
}
