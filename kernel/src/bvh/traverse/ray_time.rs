//! A ray's parameter as bounds see it: from t, in multiples of its direction, to s, a length in the units of a structure, and what is
//! known of either. `prepared_ray.rs` says how s is made.

use crate::Accuracy;
use crate::lanes::Lanes;
use crate::numeric::rounding::{lowered, raised};
use crate::scale::rays::step_of;

/// From t to s.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RayTime<L> {
    /// f; NaN where nothing can be said of t.
    pub(crate) per_t: L,
    /// tau.
    pub(crate) shift: L,
    /// |d|.
    pub(crate) length: L,
}

impl<L: Lanes> RayTime<L> {
    /// What the s of an answer may be off, for all spheres alike: 4 u T. (When it is kept in memory instead, a packet's beginning
    /// loses what its hits gain.)
    #[inline(always)]
    pub(super) fn t_error(&self) -> L {
        self.shift * self.length * self.shift.like(4.0 * L::UNIT_ROUNDOFF)
    }

    /// Where something can be said of t.
    #[inline(always)]
    pub(super) fn is_known(&self) -> L::Mask {
        self.per_t.lt(self.per_t.like(f32::INFINITY))
    }

    /// What a bound that the root of one sphere sets is raised by: twice the t error, from root to answer and from
    /// answer to root, unless the tier orders the roots themselves.
    #[inline(always)]
    pub(crate) fn raise(&self, tier: impl Accuracy) -> L {
        self.shift * self.length * self.shift.like(tier.answer_error())
    }

    /// An s that is at least that of a root that is answered by t.
    #[inline(always)]
    pub(crate) fn after(&self, t: L) -> L {
        raised(
            (t * self.per_t - self.shift) * self.length,
            self.t_error() + step_of(self.per_t) * self.length,
        )
    }

    /// The least and the greatest s of a root that is answered by t, for both ends of an interval, given what s may be off.
    #[inline(always)]
    pub(super) fn around(&self, [t_min, t_max]: [L; 2], error: L) -> [[L; 2]; 2] {
        // A t that is NaN or infinite is no hit.
        let most = error.like(f32::MAX);
        let (t_min, t_max) = (t_min.filter_max(-most), L::select(t_max.lt(most), t_max, most));
        let [start, end] = [t_min, t_max];
        let start = (start * self.per_t - self.shift) * self.length;
        let end = (end * self.per_t - self.shift) * self.length;
        [[lowered(start, error), raised(start, error)], [lowered(end, error), raised(end, error)]]
    }
}
