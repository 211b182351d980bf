//! What is asked of a ray: its nearest hit, or whether there is any.

use crate::{Accuracy, HitPacket, LaneMask, Lanes, RayPacket, Spheres};

/// What a packet's rays are answered with.
pub(super) trait Answer<L: Lanes>: Sized {
    /// Whether a ray that has met something is done.
    const ANY: bool;

    /// From the hits that were found.
    fn from_hits(token: L::Token, hits: &HitPacket<L>) -> Self;

    /// Tests all rays against all spheres.
    fn by_brute_force<A: Accuracy>(
        token: L::Token,
        rays: &[RayPacket<L>],
        spheres: Spheres<'_>,
        answers: &mut [Self],
    );
}

impl<L: Lanes> Answer<L> for HitPacket<L> {
    const ANY: bool = false;

    #[inline(always)]
    fn from_hits(_: L::Token, hits: &HitPacket<L>) -> Self {
        *hits
    }

    #[inline(always)]
    fn by_brute_force<A: Accuracy>(
        token: L::Token,
        rays: &[RayPacket<L>],
        spheres: Spheres<'_>,
        answers: &mut [Self],
    ) {
        crate::nearest::<A, L>(token, rays, spheres, answers);
    }
}

impl<L: Lanes> Answer<L> for u32 {
    const ANY: bool = true;

    #[inline(always)]
    fn from_hits(token: L::Token, hits: &HitPacket<L>) -> Self {
        L::load(token, &hits.t).lt(L::splat(token, f32::INFINITY)).bits()
    }

    #[inline(always)]
    fn by_brute_force<A: Accuracy>(
        token: L::Token,
        rays: &[RayPacket<L>],
        spheres: Spheres<'_>,
        answers: &mut [Self],
    ) {
        crate::any::<A, L>(token, rays, spheres, answers);
    }
}
