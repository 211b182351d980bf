//! The packets whose rays are under way, and how the next ray begins.

use super::answers::Answers;
use super::ray_walk::Walk;
use super::resolve::{RayPlace, settle_outside};
use super::slabs::Slabs;
use super::{Bvh, NO_CHILD};
use crate::accuracy::RayLanes;
use crate::{Accuracy, Hit, HitPacket, LaneArray, LaneMask, Lanes, RayPacket, Spheres};

/// The packets whose rays are under way.
pub(super) struct Packets<L: Lanes> {
    slabs: <L::Array as LaneArray>::Each<Slabs<L>>,
    /// How many rays of each have not ended.
    under_way: <L::Array as LaneArray>::Each<u32>,
    /// The one that rays begin from, and which rays of it have yet to.
    current: u32,
    waiting: u32,
    /// The packet that comes next.
    next: usize,
}

impl<L: Lanes> Packets<L> {
    #[inline(always)]
    pub(super) fn none() -> Self {
        let (slabs, under_way) = (L::Array::each(Slabs::none()), L::Array::each(0));
        Self { slabs, under_way, current: 0, waiting: 0, next: 0 }
    }

    #[inline(always)]
    pub(super) fn slabs(&self, walk: &Walk) -> Option<&Slabs<L>> {
        self.slabs.as_ref().get(walk.slabs as usize)
    }

    /// Begins the next ray, if there is any.
    #[inline(always)]
    pub(super) fn begin<A: Accuracy>(
        &mut self,
        token: L::Token,
        (packets, spheres, bvh): (&[RayPacket<L>], Spheres<'_>, &Bvh<'_>),
        walk: &mut Walk,
        answers: &mut impl Answers<L>,
    ) -> bool {
        while self.waiting == 0 {
            let Some(rays) = packets.get(self.next) else { return false };
            // One is free: this ray's place is, and as many others there are as rays under way.
            for (number, under_way) in self.under_way.as_ref().iter().enumerate() {
                if *under_way == 0 {
                    self.current = number as u32;
                }
            }
            if let (Some(slabs), Some(under_way)) = (
                self.slabs.as_mut().get_mut(self.current as usize),
                self.under_way.as_mut().get_mut(self.current as usize),
            ) {
                begin::<A, L>(token, (rays, self.next), (spheres, bvh), slabs, answers);
                self.waiting = slabs.judged;
                *under_way = slabs.judged.count_ones();
            }
            self.next += 1;
        }
        let lane = self.waiting.trailing_zeros() as usize;
        let ray = RayPlace { packet: self.next - 1, lane };
        self.waiting &= self.waiting - 1;
        if let Some(slabs) = self.slabs.as_ref().get(self.current as usize) {
            walk.begin(slabs, self.current, ray, bvh.root);
        }
        true
    }

    /// Counts a ray that has ended; its walk is nobody's then.
    #[inline(always)]
    pub(super) fn end(&mut self, walk: &mut Walk) {
        let ended = core::mem::replace(&mut walk.slabs, Walk::NEW.slabs);
        if let Some(under_way) = self.under_way.as_mut().get_mut(ended as usize) {
            *under_way = under_way.saturating_sub(1);
        }
    }
}

/// Makes a packet's rays ready, and answers for those that do not go into the tree.
#[inline(always)]
pub(super) fn begin<A: Accuracy, L: Lanes>(
    token: L::Token,
    (packet, place): (&RayPacket<L>, usize),
    (spheres, bvh): (Spheres<'_>, &Bvh<'_>),
    slabs: &mut Slabs<L>,
    answers: &mut impl Answers<L>,
) {
    answers.clear(place);
    let rays = RayLanes::<L>::load(token, packet);
    slabs.take::<A>(&rays, bvh.extent);
    let rest = rays.live.bits() & !slabs.judged;
    if rest != 0 {
        meet_all::<A, L>(token, packet, place, spheres, rest, answers);
    }
    if !bvh.outside.is_empty() {
        L::out_of_line(
            token,
            #[inline(always)]
            || settle_outside::<A, L>(&rays, bvh.outside, slabs.judged, place, answers),
        );
        for lane in 0..L::COUNT {
            slabs.shorten(lane, answers.limit(place, lane));
        }
    }
    if bvh.root == NO_CHILD {
        slabs.judged = 0;
    }
}

/// Rays that the bounds do not cover, those in `lanes`, against all spheres.
#[inline(always)]
fn meet_all<A: Accuracy, L: Lanes>(
    token: L::Token,
    packet: &RayPacket<L>,
    place: usize,
    spheres: Spheres<'_>,
    lanes: u32,
    answers: &mut impl Answers<L>,
) {
    let asked = L::mask(token, lanes);
    let mut rays = *packet;
    let never = L::splat(token, f32::NAN);
    rays.t_min = L::select(asked, L::load(token, &rays.t_min), never).store();
    let mut found = [HitPacket::<L>::none()];
    crate::nearest::<A, L>(token, &[rays], spheres, &mut found);
    for (lane, (&t, &sphere)) in found[0].t().iter().zip(found[0].spheres()).enumerate() {
        if lanes >> lane & 1 == 1 && t < f32::INFINITY {
            answers.take(place, lane, Hit { t, sphere });
        }
    }
}
