//! How an answer is wrong.

use crate::aim::double;
use crate::answer::Answer;
use crate::middle::is_at_the_other_root;
use crate::random::dot;
use crate::ulp::ulp_between;
use spherule_kernel::{Hit, Ray, Sphere, discriminant};

/// A way to be wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A hit that is a miss in truth.
    FalseHit,
    /// A miss that is a hit in truth.
    LostHit,
    /// The right sphere, but t is off by more ulp than the rules allow, and nearer to its other root.
    OtherRoot,
    /// Another sphere than the closest.
    OtherSphere,
    /// The right root, but t is off by more ulp than the rules allow.
    T,
    /// NaN, an infinite t, or a sphere that does not exist.
    NoAnswer,
}

impl Kind {
    /// All of them.
    pub const ALL: [Self; 6] = [
        Self::FalseHit,
        Self::LostHit,
        Self::OtherRoot,
        Self::OtherSphere,
        Self::T,
        Self::NoAnswer,
    ];

    /// The name of the kind.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::FalseHit => "false hit",
            Self::LostHit => "lost hit",
            Self::OtherRoot => "other root",
            Self::OtherSphere => "other sphere",
            Self::T => "t off",
            Self::NoAnswer => "no answer",
        }
    }
}

/// The verdict on an answer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Verdict {
    /// The answer is right, with t off by so many ulp, no more than the rules allow.
    Right {
        /// How many ulp; `None` for a miss.
        ulp: Option<u64>,
    },
    /// Wrong.
    Wrong {
        /// In which way.
        kind: Kind,
        /// How wrong: ulp of t; for false and lost hits |D| / (a r^2), the relative margin by which the line passes.
        severity: f64,
    },
}

/// Judges an answer against the true hit. `is_true_sphere` says whether the answered sphere may stand for the true one. `sphere` is the
/// true sphere, or for a false hit the answered one.
#[must_use]
pub fn verdict(
    ray: &Ray,
    sphere: Option<&Sphere>,
    truth: Option<Hit>,
    answer: Option<Answer>,
    (is_true_sphere, most_ulp): (bool, u64),
) -> Verdict {
    let margin = || sphere.map_or(f64::INFINITY, |sphere| margin(ray, sphere).abs());
    let wrong = |kind, severity| Verdict::Wrong { kind, severity };
    match (truth, answer) {
        (_, Some(answer)) if !answer.t.is_finite() => wrong(Kind::NoAnswer, f64::INFINITY),
        (None, None) => Verdict::Right { ulp: None },
        (None, Some(_)) => wrong(Kind::FalseHit, margin()),
        (Some(_), None) => wrong(Kind::LostHit, margin()),
        (Some(truth), Some(answer)) => {
            let ulp = ulp_between(answer.t as f32, truth.t);
            if !is_true_sphere {
                return wrong(Kind::OtherSphere, ulp as f64);
            }
            if ulp <= most_ulp {
                return Verdict::Right { ulp: Some(ulp) };
            }
            let is_elsewhere =
                sphere.is_some_and(|sphere| is_at_the_other_root(ray, sphere, answer.t, truth.t));
            wrong(if is_elsewhere { Kind::OtherRoot } else { Kind::T }, ulp as f64)
        }
    }
}

/// D / (a r^2) = 1 - l^2 / r^2, with l the distance of the line from the centre: above zero where the line meets the sphere,
/// near zero where it grazes it. NaN for invalid input, and for points.
#[must_use]
pub fn margin(ray: &Ray, sphere: &Sphere) -> f64 {
    let Some((d, _)) = discriminant(ray, sphere) else { return f64::NAN };
    let (direction, r) = (double(ray.direction), f64::from(sphere.radius));
    d / (dot(direction, direction) * r * r)
}

#[cfg(test)]
mod tests {
    use super::*;
    use spherule_kernel::{Exact, Vec3, roots};

    #[test]
    fn what_the_rules_allow_is_right_even_at_the_other_root() {
        let ray = Ray::new(Vec3::ZERO, Vec3::Z);
        let sphere = Sphere::from([0.0, 0.0, 8_388_616.0, 1.0]);
        let [near, far] = roots(Exact, &ray, &sphere).expect("a hit");
        assert_eq!(ulp_between(near, far), 2);
        let truth = Some(Hit { t: near, sphere: 0 });
        let judged =
            |most_ulp| verdict(&ray, Some(&sphere), truth, Some(Answer::at(far)), (true, most_ulp));
        assert_eq!(judged(4), Verdict::Right { ulp: Some(2) });
        assert_eq!(judged(1), Verdict::Wrong { kind: Kind::OtherRoot, severity: 2.0 });
    }

    /// The textbook's t where D is lost: on this side of the middle, and nearer to the other root as that is rounded.
    #[test]
    fn roots_are_told_apart_by_the_middle() {
        let origin = Vec3::new(115.54503, 93.65253, 1990.1035);
        let ray = Ray::new(origin, Vec3::new(-0.060_130_928, -0.045_098_197, -0.997_171_2));
        let sphere = Sphere::from([-4.4, 1.8, 0.0, 1.9]);
        let near = roots(Exact, &ray, &sphere).expect("a hit")[0];
        let truth = Some(Hit { t: near, sphere: 0 });
        for (t, expected) in
            [(1995.8287_f32, Kind::OtherRoot), (1995.8287_f32.next_down(), Kind::T)]
        {
            let judged = verdict(&ray, Some(&sphere), truth, Some(Answer::at(t)), (true, 4));
            assert!(
                matches!(judged, Verdict::Wrong { kind, .. } if kind == expected),
                "{t}: {judged:?}"
            );
        }
    }
}
