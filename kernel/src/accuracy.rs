//! How far an answer may be trusted, as a type: the tiers.
//!
//! | tier | promise |
//! |---|---|
//! | [`Fast`] | the textbook form in single precision; wrong where that is wrong |
//! | [`Stable`] | the best form that plain single precision allows |
//!
//! A tier says where a line meets a sphere; validity, interval, order and ties are the same code
//! for all of them, in [`nearest`](crate::nearest) and its companions.

mod fast;
mod stable;

pub use fast::Fast;
pub use stable::Stable;

use crate::{Lanes, RayPacket};

mod sealed {
    pub trait Sealed {}
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
        let load3 = |arrays: &[L::Array; 3]| arrays.each_ref().map(|array| L::load(token, array));
        let (origin, direction) = (load3(&packet.origin), load3(&packet.direction));
        let (t_min, t_max) = (L::load(token, &packet.t_min), L::load(token, &packet.t_max));

        let (zero, largest) = (L::splat(token, 0.0), L::splat(token, f32::MAX));
        let finite =
            |v: [L; 3]| v[0].abs().le(largest) & v[1].abs().le(largest) & v[2].abs().le(largest);
        let finite = finite(origin) & finite(direction);
        let along = direction.map(|d| d.lt(zero) | zero.lt(d));
        let directed = along[0] | along[1] | along[2];
        Self { origin, direction, t_min, t_max, live: finite & directed & t_min.le(t_max) }
    }
}

/// Where the lines of a packet meet a sphere.
#[derive(Clone, Copy, Debug)]
pub struct Roots<L: Lanes> {
    /// Whether the line meets the sphere at all; tangents do.
    pub meets: L::Mask,
    /// The smaller root; unspecified where the line does not meet the sphere.
    pub near: L,
    /// The larger root.
    pub far: L,
}

/// A tier. Sealed: the scene structures prove their bounds tier by tier.
pub trait Accuracy: sealed::Sealed + Copy + core::fmt::Debug {
    /// The tier's name on the command line and in reports.
    const NAME: &'static str;

    /// What the tier computes once a packet.
    type Prepared<L: Lanes>: Copy;

    /// Computes what depends on the rays alone.
    fn prepare<L: Lanes>(rays: &RayLanes<L>) -> Self::Prepared<L>;

    /// Where the rays' lines meet one sphere a lane.
    ///
    /// Called only where the sphere is valid, and read only in lanes whose ray is; every bit
    /// pattern must return.
    fn roots<L: Lanes>(rays: &Self::Prepared<L>, center: [L; 3], radius: L) -> Roots<L>;
}
