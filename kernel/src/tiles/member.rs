//! A packet of a group, and one sphere before its rays.

use super::answer::Answer;
use super::view::View;
use crate::accuracy::RayLanes;
use crate::axes::{axes, dot};
use crate::bvh::resolve::ask;
use crate::bvh::slabs::{LONGEST, raised};
use crate::{Accuracy, Hit, HitPacket, LaneMask, Lanes, RayPacket, Sphere};

/// A packet of a group: its rays with directions of unit length.
#[derive(Clone, Copy)]
pub(super) struct Member<L: Lanes> {
    pub(super) rays: RayLanes<L>,
    /// From where the viewpoint is.
    pub(super) origin: [L; 3],
    direction: [L; 3],
    /// |d|: t times it is s.
    length: L,
    /// How deep the rays start.
    pub(super) depth: L,
    /// The start of the interval: an s.
    pub(super) start: L,
    /// No hit beyond counts any more: an s, `-inf` where none counts.
    pub(super) best: L,
    /// How deep the rays still go, raised by the margin; `-inf` where nothing counts.
    deepest: L,
}

impl<L: Lanes> Member<L> {
    #[inline(always)]
    pub(super) fn new<V: View>(token: L::Token, view: &V, packet: &RayPacket<L>) -> Self {
        let rays = RayLanes::<L>::load(token, packet);
        let a = dot(rays.direction, rays.direction);
        let one = a.like(1.0);
        // What the bounds do not cover is not live in a group.
        let judged = rays.live & a.like(1.0 / LONGEST).le(a) & a.le(a.like(LONGEST));
        let length = L::select(judged, a, one).sqrt();
        let per_length = one / length;
        let none = a.like(f32::NEG_INFINITY);
        let (start, end) = (rays.t_min * length, rays.t_max * length);
        Self {
            origin: view.origin(&rays),
            direction: axes!(i => rays.direction[i] * per_length),
            length,
            depth: view.depth(&rays),
            start: -raised(-start),
            best: L::select(rays.live, raised(end), none),
            deepest: none,
            rays,
        }
    }

    /// Whether any ray goes as deep as `depth`.
    #[inline(always)]
    pub(super) fn goes_to(&self, depth: f32) -> bool {
        self.best.like(depth).le(self.deepest).any()
    }

    /// Which rays may meet the sphere, whose reach is that for the group.
    #[inline(always)]
    pub(super) fn may_meet<V: View>(&self, view: &V, center: [f32; 3], reach: f32) -> L::Mask {
        let f = view.seen(center, self.origin);
        let n = self.direction;
        let middle = f[2].filter_mul_add(n[2], f[1].filter_mul_add(n[1], f[0] * n[0]));
        let back = -middle;
        let q = axes!(i => back.filter_mul_add(n[i], f[i]));
        let ll = q[2].filter_mul_add(q[2], q[1].filter_mul_add(q[1], q[0] * q[0]));
        let (reach, most) = (middle.like(reach), middle.like(reach * reach));
        self.rays.live
            & ll.le(most)
            & (middle - reach).le(self.best)
            & self.start.le(middle + reach)
    }

    /// Asks the tier about a sphere, of the rays `asked`.
    #[inline(always)]
    pub(super) fn meet<A: Accuracy>(
        &self,
        sphere: &Sphere,
        index: u32,
        asked: L::Mask,
        hit: &mut HitPacket<L>,
    ) {
        // Another list than the order was made from may have anything there.
        if !sphere.is_valid() {
            return;
        }
        let token = self.length.token();
        let center = axes!(i => L::splat(token, sphere.center[i]));
        let radius = L::splat(token, sphere.radius);
        let limit = L::load(token, &hit.t);
        let t = ask::<A, L>(&self.rays, center, radius, asked, limit);
        let mut nearer = (t.le(limit) & t.lt(t.like(f32::INFINITY))).bits();
        let t = t.store();
        while nearer != 0 {
            let lane = nearer.trailing_zeros() as usize;
            nearer &= nearer - 1;
            if let Some(&t) = t.as_ref().get(lane) {
                hit.take(lane, Hit { t, sphere: index });
            }
        }
    }

    /// Takes the hits so far as the ends of the rays.
    #[inline(always)]
    pub(super) fn shorten<R: Answer<L>>(&mut self, slack: f32, hit: &HitPacket<L>) {
        let t = L::load(self.length.token(), &hit.t);
        let infinity = t.like(f32::INFINITY);
        if R::ANY {
            let met = t.lt(infinity);
            self.rays.live = self.rays.live & !met;
            self.best = L::select(met, -infinity, self.best);
        } else {
            self.best = -(-self.best).filter_max(-raised(t * self.length));
        }
        self.deepest = self.best + self.depth + t.like(slack);
    }
}
