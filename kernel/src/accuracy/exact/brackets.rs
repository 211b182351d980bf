//! Between which numbers the roots of a packet and a sphere lie, by double precision with a proven bound.

use super::estimate::Estimate;
use crate::accuracy::roots::RayLanes;
use crate::geometry::ray::Ray;
use crate::lanes::{DoubleLanes, LaneArray, LaneMask, Lanes};
use crate::numeric::axes::axes;

/// The least and the greatest `f32` that each root can round to, in every lane. Both are `+inf` where the line surely
/// misses; they are `-inf` and `+inf` where it is not known to meet the sphere.
pub(crate) struct Brackets<L: Lanes> {
    token: L::Token,
    near: [L::Array; 2],
    far: [L::Array; 2],
}

/// What a bracket tells of a root.
struct Judged<L: Lanes> {
    /// The lower end.
    t: L,
    /// The bracket is one number, which rule 3 accepts.
    hit: L::Mask,
    /// The bracket is one number, or no number in it matters.
    known: L::Mask,
}

impl<L: Lanes> Brackets<L> {
    #[inline(always)]
    pub(crate) fn new(rays: &RayLanes<L>, center: [L; 3], radius: L, active: L::Mask) -> Self {
        let mut brackets = Self {
            token: radius.token(),
            near: [L::Array::filled(0.0); 2],
            far: [L::Array::filled(0.0); 2],
        };
        let active = active.bits();
        for part in 0..L::PARTS {
            let first = part * L::Double::COUNT;
            if (active >> first) & ((1 << L::Double::COUNT) - 1) != 0 {
                brackets.fill(
                    part,
                    axes!(i => rays.origin[i].widen(part)),
                    axes!(i => rays.direction[i].widen(part)),
                    axes!(i => center[i].widen(part)),
                    radius.widen(part),
                );
            }
        }
        brackets
    }

    #[inline(always)]
    fn fill(
        &mut self,
        part: usize,
        origin: [L::Double; 3],
        d: [L::Double; 3],
        center: [L::Double; 3],
        radius: L::Double,
    ) {
        let proven = &Estimate::<L::Double>::PROVEN;
        let estimate = Estimate::new(origin, d, center, radius, proven);
        let Estimate { discriminant, error, near, far } = estimate;
        let meets = error.lt(discriminant);
        let misses = discriminant.lt(-error);
        let infinity = error.like(f64::INFINITY);
        let low_otherwise = L::Double::select(misses, infinity, -infinity);
        for (bracket, (t, bound)) in [(&mut self.near, near), (&mut self.far, far)] {
            let [low, high] = bracket;
            L::narrow(low, part, L::Double::select(meets, t - bound, low_otherwise));
            L::narrow(high, part, L::Double::select(meets, t + bound, infinity));
        }
    }

    /// The t of rules 2 to 4, and the lanes in which that is the answer.
    #[inline(always)]
    pub(crate) fn decide(&self, rays: &RayLanes<L>, limit: L) -> (L, L::Mask) {
        let near = self.judge(self.near, rays, limit);
        let far = self.judge(self.far, rays, limit);
        // The far root does not matter where the near one is taken, or lies past the limit.
        let infinity = limit.like(f32::INFINITY);
        let t = L::select(near.hit, near.t, L::select(far.hit, far.t, infinity));
        (t, near.known & (near.hit | far.known | limit.lt(near.t)))
    }

    /// Returns a t from the bracket of a root if the ray in `lane` accepts all numbers of that bracket: the root is one of
    /// them.
    pub(super) fn surely_accepted(&self, lane: usize, ray: &Ray) -> Option<f32> {
        let accepts = |t: f32| ray.t_min <= t && t <= ray.t_max && t.is_finite();
        let ends = |[low, high]: &[L::Array; 2]| [low.get(lane), high.get(lane)];
        let surely = |ends: &[f32; 2]| ends.iter().all(|&t| accepts(t));
        [&self.near, &self.far].map(ends).iter().find(|ends| surely(ends)).map(|[low, _]| *low)
    }

    /// Says what the bracket of a root tells. The bracket of a root past the limit counts as known, since nothing asks
    /// for that root.
    #[inline(always)]
    fn judge(&self, [low, high]: [L::Array; 2], rays: &RayLanes<L>, limit: L) -> Judged<L> {
        let (low, high) = (L::load(self.token, &low), L::load(self.token, &high));
        let settled = high.le(low);
        let out = high.lt(rays.t_min) | rays.t_max.lt(low) | limit.lt(low);
        Judged { t: low, hit: settled & rays.accept(low), known: settled | out }
    }
}
