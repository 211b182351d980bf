//! How far an answer may be trusted, as a type: the tiers.
//!
//! | tier | promise |
//! |---|---|
//! | [`Fast`] | the textbook form in single precision; wrong where that is wrong |
//! | [`Stable`] | the best form that plain single precision allows |
//! | [`Exact`] | decided as in real arithmetic, t correctly rounded, for every input |
//!
//! A tier says where a line meets a sphere; validity, interval, order and ties are the same code
//! for all of them, in [`nearest`](crate::nearest) and its companions.

mod beyond;
mod exact;
mod fast;
mod stable;

pub use exact::Exact;
pub use fast::Fast;
pub use stable::Stable;

use crate::axes::axes;
use crate::{Lanes, Ray, RayPacket, Sphere};

mod sealed {
    #[cfg(not(feature = "dispatch"))]
    pub trait Sealed {}
    #[cfg(feature = "dispatch")]
    pub trait Sealed: crate::dispatch::Compiled {}
}

/// The rays of a packet in registers, as the tiers read them.
#[derive(Clone, Copy, Debug)]
pub struct RayLanes<L: Lanes> {
    pub(crate) origin: [L; 3],
    pub(crate) direction: [L; 3],
    pub(crate) t_min: L,
    pub(crate) t_max: L,
    /// Rule 1 for rays, and an interval that is not empty.
    pub(crate) live: L::Mask,
}

impl<L: Lanes> RayLanes<L> {
    #[inline(always)]
    pub(crate) fn load(token: L::Token, packet: &RayPacket<L>) -> Self {
        let origin = axes!(i => L::load(token, &packet.origin[i]));
        let direction = axes!(i => L::load(token, &packet.direction[i]));
        let (t_min, t_max) = (L::load(token, &packet.t_min), L::load(token, &packet.t_max));

        let zero = L::splat(token, 0.0);
        let along = axes!(i => direction[i].lt(zero) | zero.lt(direction[i]));
        let directed = along[0] | along[1] | along[2];
        let live = all_finite(origin) & all_finite(direction) & directed & t_min.le(t_max);
        Self { origin, direction, t_min, t_max, live }
    }

    /// Rule 3.
    #[inline(always)]
    fn accept(&self, t: L) -> L::Mask {
        self.t_min.le(t) & t.le(self.t_max) & t.abs().le(t.like(f32::MAX))
    }
}

/// Neither NaN nor infinite in any component.
#[inline(always)]
pub(crate) fn all_finite<L: Lanes>(v: [L; 3]) -> L::Mask {
    let largest = v[0].like(f32::MAX);
    v[0].abs().le(largest) & v[1].abs().le(largest) & v[2].abs().le(largest)
}

/// Where the lines of a packet meet a sphere, as a tier computed it.
#[derive(Clone, Copy, Debug)]
struct Roots<L: Lanes> {
    /// Whether the line meets the sphere at all; tangents do.
    meets: L::Mask,
    /// The smaller root; unspecified where the line does not meet the sphere.
    near: L,
    /// The larger root.
    far: L,
}

impl<L: Lanes> Roots<L> {
    /// The accepted t of rules 2 to 4, `+inf` where there is none.
    #[inline(always)]
    fn first_accepted(&self, rays: &RayLanes<L>) -> L {
        // Adding zero turns -0 into +0.
        let zero = self.near.like(0.0);
        let (near, far) = (self.near + zero, self.far + zero);
        let far = L::select(self.meets & rays.accept(far), far, zero.like(f32::INFINITY));
        L::select(self.meets & rays.accept(near), near, far)
    }
}

/// A tier. Sealed: the scene structures prove their bounds tier by tier.
pub trait Accuracy: sealed::Sealed + Copy + core::fmt::Debug {
    /// The tier's name on the command line and in reports.
    const NAME: &'static str;

    /// How far off a tier may be beside the few ulp of s that are allowed to all: as if r^2
    /// were changed by up to (`SPREAD` (|p| + r))^2. Zero but for [`Fast`].
    const SPREAD: f32 = 0.0;

    /// What the tier computes once a packet.
    type Prepared<L: Lanes>: Copy;

    /// Computes what depends on the rays alone.
    fn prepare<L: Lanes>(rays: &RayLanes<L>) -> Self::Prepared<L>;

    /// The t of rules 2 to 4 for one sphere a lane, `+inf` where there is none.
    ///
    /// Read only in the lanes `asked`, where ray and sphere are valid; may be `+inf` where t is
    /// larger than `limit`. Every bit pattern must return.
    fn first_root<L: Lanes>(
        rays: &RayLanes<L>,
        prepared: &Self::Prepared<L>,
        center: [L; 3],
        radius: L,
        asked: L::Mask,
        limit: L,
    ) -> L;

    /// Both roots of the line of a valid ray and a valid sphere, the smaller first, never -0.
    fn line_roots(ray: &Ray, sphere: &Sphere) -> Option<[f32; 2]>;
}

/// [`Accuracy::line_roots`] by the lanes of a tier that computes both roots always.
#[inline(always)]
fn line_roots_of(roots: impl Fn(&RayLanes<f32>) -> Roots<f32>, ray: &Ray) -> Option<[f32; 2]> {
    let roots = roots(&RayLanes::load((), &RayPacket::<f32>::new(&[*ray])));
    roots.meets.then_some([roots.near + 0.0, roots.far + 0.0])
}
