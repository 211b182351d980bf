//! The miss filter: eight operations a ray and sphere that rule out nearly every miss, and
//! nothing else.
//!
//! # Method
//!
//! Scale space by a power of two, shift it by some point K near the spheres and scale the direction to
//! unit length. With c = centre - K, o = origin - K and e = d.o, f = 2 o, all known before the loop, the
//! discriminant over d.d is
//!
//! ```text
//! D/a = (d.(c - o))^2 - (|c - o|^2 - r^2) = (d.c - e)^2 + (f.c + w) - |o|^2,   w = r^2 - |c|^2
//! ```
//!
//! so that seven multiply-adds give D/a + |o|^2, and a miss is ruled out where the largest of
//! four such numbers lies below |o|^2. The subtractions c - o, and the multiplication by a, have
//! left the loop. What this form cancels is covered by widening: w is raised by
//! kappa (|c|^2 + r^2), once a sphere, and |o|^2 lowered by kappa |o|^2, once a ray, so that the bound
//! costs the loop no operation, and a huge or far sphere widens no bound but its own.
//!
//! The bound, kappa = 114 u, and the sizes for which it holds, are proven in `docs/numerics.md`;
//! `tests/proofs` climbs towards it. Sizes are those in the units of a block of spheres; and where a tier's own
//! squares underflow, what it finds is left to it. A sphere outside of those sizes passes always (w = +inf), as does a
//! ray (threshold -inf); an invalid sphere never does, and an inactive ray only beside a sphere out of
//! range. Within those rules no NaN can arise, so the maximum of four means what it says.

use crate::accuracy::{RayLanes, Underflow};
use crate::geometry::sphere::Sphere;
use crate::geometry::sphere_run::SphereRun;
use crate::lanes::{LaneMask, Lanes};
use crate::numeric::axes::{axes, dot};
use crate::numeric::power_of_two::inverse_powers_of_two;
use crate::numeric::rounding::{LARGEST, LONGEST};
use crate::scale::rays::largest;
use crate::scale::scene::{size, to_one};

/// How many spheres share one branch.
pub(crate) const GROUP: usize = 4;
/// How many groups are prepared at a time: 2 KiB of stack, and 3 % of the loop spent on rays.
const BLOCK: usize = 32;
/// How many spheres are prepared at a time.
pub(crate) const BLOCK_SPHERES: usize = BLOCK * GROUP;

/// 114 u.
pub(crate) const KAPPA: f32 = 114.0 / 16_777_216.0;
/// 2^-60: no sphere counts as smaller.
pub(crate) const LEAST_SIZE: f32 = 1.0 / (1_u64 << 60) as f32;
/// 2^-60: a squared direction below, or above 2^100, is not used: the direction is scaled before.
const SHORTEST: f32 = 1.0 / (1_u64 << 60) as f32;

/// Four spheres as the filter reads them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FilterGroup {
    pub(crate) center: [[f32; GROUP]; 3],
    /// r^2 - |c|^2, raised by the bound; `-inf` never passes, `+inf` always.
    pub(crate) excess: [f32; GROUP],
}

impl FilterGroup {
    pub(crate) const EMPTY: Self =
        Self { center: [[0.0; GROUP]; 3], excess: [f32::NEG_INFINITY; GROUP] };

    #[inline(always)]
    fn put(&mut self, slot: usize, sphere: &Sphere, frame: &Frame, kappa: f32) {
        if !sphere.is_valid() {
            return;
        }
        if size(sphere) * frame.scale > LARGEST {
            self.excess[slot] = f32::INFINITY;
            return;
        }
        let center = sphere.center();
        let [x, y, z] = axes!(i => center[i] * frame.scale - frame.shift[i]);
        let radius = sphere.radius * frame.scale;
        self.center[0][slot] = x;
        self.center[1][slot] = y;
        self.center[2][slot] = z;
        self.excess[slot] = excess([x, y, z], radius, kappa, frame.least_size);
    }
}

/// r^2 - |c|^2, raised by the bound.
#[inline(always)]
pub(crate) fn excess<L: Lanes>(c: [L; 3], r: L, kappa: f32, least_size: f32) -> L {
    let (cc, rr) = (dot(c, c), r * r);
    (rr - cc) + r.like(kappa) * (cc + rr).filter_max(r.like(least_size * least_size))
}

/// The space that a block of spheres, or a ball, is seen in.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frame {
    /// The power of two that lengths are multiplied by.
    pub(crate) scale: f32,
    /// K, scaled.
    pub(crate) shift: [f32; 3],
    /// No sphere counts as smaller, scaled. (As a square it was seen that the compiler multiplies it by itself beside what
    /// is needed, to a subnormal number: half of the time of `Fast`.)
    pub(crate) least_size: f32,
    /// A direction without a larger component is not judged.
    pub(crate) least_length: f32,
}

impl Frame {
    /// Around a point among the spheres of a block, that one sphere far away cannot move far: coordinate by
    /// coordinate the median of three of them; scaled so that the median of their sizes is some 1, or, if rays that
    /// start at `far` would be out of range then, so that `far` is. Any finite point, and any scale, would be right.
    pub(crate) fn of(
        spheres: &(impl SphereRun + ?Sized),
        first: usize,
        underflow: Underflow,
        far: f32,
    ) -> Self {
        let count = (spheres.count() - first).min(BLOCK_SPHERES);
        let offsets = [0, count / 2, count.saturating_sub(1)];
        // Where an index into an array is a closure's, a check that it is in bounds may stay, and with it a panic.
        let samples = axes!(i => match spheres.sphere(first + offsets[i]) {
            Some(sphere) => sphere,
            None => Sphere::from([0.0; 4]),
        });
        let sizes = axes!(i => size(&samples[i]));
        let typical = median(sizes);
        let largest = sizes[0].max(sizes[1]).max(sizes[2]);
        let scale = match (typical > 0.0, largest > 0.0) {
            (true, _) => to_one(typical),
            (_, true) => to_one(largest),
            _ => 1.0,
        };
        let scale = if far * scale <= LARGEST { scale } else { to_one(far) };
        let shift = axes!(axis => {
            let middle = median(axes!(i => samples[i].center()[axis] * scale));
            if middle.abs() <= LARGEST { middle } else { 0.0 }
        });
        let least_size = (underflow.size * scale).max(LEAST_SIZE);
        Self { scale, shift, least_size, least_length: underflow.length }
    }
}

/// The median of three numbers.
fn median([a, b, c]: [f32; 3]) -> f32 {
    a.max(b).min(a.min(b).max(c))
}

/// The next spheres of a list, prepared on the stack.
#[derive(Clone, Debug)]
pub(crate) struct FilterBlock {
    groups: [FilterGroup; BLOCK],
    count: usize,
    pub(crate) frame: Frame,
    /// Whether it is seen in the units of rays that start far away.
    from_afar: bool,
}

impl FilterBlock {
    /// Spheres `first ..` of the list, as many as a block takes.
    pub(crate) fn new(
        spheres: &(impl SphereRun + ?Sized),
        first: usize,
        underflow: Underflow,
    ) -> Self {
        Self::in_frame(spheres, first, Frame::of(spheres, first, underflow, 0.0), KAPPA)
    }

    /// Whether rays, those that live, may see the block better than it is now: they start out of its range, or others
    /// did.
    #[inline(always)]
    pub(crate) fn is_elsewhere<L: Lanes>(&self, rays: &RayLanes<L>) -> bool {
        let far = largest(rays.origin);
        let near = (far * far.like(self.frame.scale)).le(far.like(LARGEST));
        self.from_afar || (rays.live & !near).any()
    }

    /// Prepares the block once more, as these rays are to see it.
    #[inline(always)]
    pub(crate) fn see<L: Lanes>(
        &mut self,
        spheres: &(impl SphereRun + ?Sized),
        first: usize,
        underflow: Underflow,
        rays: &RayLanes<L>,
    ) {
        let frame = Frame::of(spheres, first, underflow, farthest(rays));
        if frame.scale < self.frame.scale || self.frame.scale < frame.scale {
            let usual = Frame::of(spheres, first, underflow, 0.0);
            *self = Self::in_frame(spheres, first, frame, KAPPA);
            self.from_afar = frame.scale < usual.scale;
        }
    }

    pub(crate) fn in_frame(
        spheres: &(impl SphereRun + ?Sized),
        first: usize,
        frame: Frame,
        kappa: f32,
    ) -> Self {
        let mut groups = [FilterGroup::EMPTY; BLOCK];
        let mut count = 0;
        for (group, start) in groups.iter_mut().zip((first..spheres.count()).step_by(GROUP)) {
            for slot in 0..GROUP {
                if let Some(sphere) = spheres.sphere(start + slot) {
                    group.put(slot, &sphere, &frame, kappa);
                }
            }
            count += 1;
        }
        Self { groups, count, frame, from_afar: false }
    }

    /// The groups, in the order of the list.
    #[inline(always)]
    pub(crate) fn groups(&self) -> &[FilterGroup] {
        self.groups.get(..self.count).unwrap_or(&[])
    }
}

/// The rays of a packet as the filter reads them, for one block.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FilterRays<L: Lanes> {
    /// d, of unit length up to 4.5 u.
    pub(crate) direction: [L; 3],
    /// 2 o.
    pub(crate) twice_origin: [L; 3],
    /// -d.o.
    pub(crate) minus_along: L,
    /// |o|^2, lowered by the bound; what passes lies above.
    pub(crate) threshold: L,
}

impl<L: Lanes> FilterRays<L> {
    #[inline(always)]
    pub(crate) fn new(token: L::Token, rays: &RayLanes<L>, block: &FilterBlock) -> Self {
        Self::widened(token, rays, &block.frame, KAPPA)
    }

    #[inline(always)]
    pub(crate) fn widened(token: L::Token, rays: &RayLanes<L>, frame: &Frame, kappa: f32) -> Self {
        let Frame { scale, shift, least_length, .. } = *frame;
        let (mut direction, mut a) = (rays.direction, dot(rays.direction, rays.direction));
        // Rays that the bound does not cover are replaced by one that it does.
        let mut judged = rays.live & (largest(rays.origin) * a.like(scale)).le(a.like(LARGEST));
        let usual = a.like(SHORTEST).le(a) & a.le(a.like(LONGEST));
        if (rays.live & !usual).any() {
            let longest = largest(direction);
            let to_one = inverse_powers_of_two(longest);
            direction = axes!(i => direction[i] * to_one);
            a = dot(direction, direction);
            judged = judged & a.like(least_length).le(longest);
        }
        let (zero, one) = (a.like(0.0), a.like(1.0));
        let per_length = one / L::select(judged, a, one).sqrt();
        let direction = axes!(i => L::select(judged, direction[i] * per_length, zero));
        let origin = axes!(i => {
            let shifted = rays.origin[i] * a.like(scale) - L::splat(token, shift[i]);
            L::select(judged, shifted, zero)
        });
        let along = dot(direction, origin);
        let oo = dot(origin, origin);
        let otherwise = L::select(rays.live, a.like(f32::NEG_INFINITY), a.like(f32::INFINITY));
        Self {
            direction,
            twice_origin: axes!(i => origin[i] + origin[i]),
            minus_along: -along,
            threshold: L::select(judged, oo - oo.like(kappa) * oo, otherwise),
        }
    }

    /// Lets nothing pass any more in lanes that are not `live`.
    #[inline(always)]
    pub(crate) fn keep(&mut self, live: L::Mask) {
        let never = L::splat(self.threshold.token(), f32::INFINITY);
        self.threshold = L::select(live, self.threshold, never);
    }

    /// D/a + |o|^2, raised by the bound.
    #[inline(always)]
    pub(crate) fn raised(&self, group: &FilterGroup, slot: usize) -> L {
        let token = self.threshold.token();
        let [dx, dy, dz] = self.direction;
        let [fx, fy, fz] = self.twice_origin;
        let [x, y, z] = axes!(i => L::splat(token, group.center[i][slot]));
        let w = L::splat(token, group.excess[slot]);
        let b = x.filter_mul_add(dx, y.filter_mul_add(dy, z.filter_mul_add(dz, self.minus_along)));
        let c = x.filter_mul_add(fx, y.filter_mul_add(fy, z.filter_mul_add(fz, w)));
        b.filter_mul_add(b, c)
    }

    /// Whether any lane may meet any sphere of the group.
    #[inline(always)]
    pub(crate) fn may_meet_any(&self, group: &FilterGroup) -> bool {
        let low = self.raised(group, 0).filter_max(self.raised(group, 1));
        let high = self.raised(group, 2).filter_max(self.raised(group, 3));
        self.threshold.le(low.filter_max(high)).any()
    }

    /// Which lanes may meet sphere `slot` of the group.
    #[inline(always)]
    pub(crate) fn may_meet(&self, group: &FilterGroup, slot: usize) -> L::Mask {
        self.threshold.le(self.raised(group, slot))
    }
}

/// The largest coordinate of the origins of those that live.
#[inline(always)]
fn farthest<L: Lanes>(rays: &RayLanes<L>) -> f32 {
    let far = largest(rays.origin);
    L::select(rays.live, far, far.like(0.0)).filter_greatest()
}

/// Which rays may come within `radius` of the coordinates' origin, from however far away.
#[inline(always)]
pub(crate) fn may_come_near<L: Lanes>(token: L::Token, rays: &RayLanes<L>, radius: f32) -> L::Mask {
    let ball = Sphere::from([0.0, 0.0, 0.0, radius]);
    if !ball.is_valid() {
        return rays.live;
    }
    let scale = to_one(farthest(rays));
    let frame = Frame { scale, shift: [0.0; 3], least_size: LEAST_SIZE, least_length: 0.0 };
    let mut group = FilterGroup::EMPTY;
    group.put(0, &ball, &frame, KAPPA);
    FilterRays::widened(token, rays, &frame, KAPPA).may_meet(&group, 0)
}
