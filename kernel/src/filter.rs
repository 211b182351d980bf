//! The miss filter: eight operations a ray and sphere that rule out nearly every miss, and
//! nothing else.
//!
//! # Method
//!
//! Shift space by some point K near the spheres and scale the direction to unit length. With
//! c = centre - K, o = origin - K and e = d.o, f = 2 o, all known before the loop, the
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
//! The bound, kappa = 104 u, and the sizes for which it holds, are proven in `docs/numerics.md`;
//! `filter/worst.rs` climbs towards it. A sphere outside of those sizes passes always (w = +inf), as does a
//! ray (threshold -inf); an invalid sphere never does, and an inactive ray only beside a sphere out of
//! range. Within those rules no NaN can arise, so the maximum of four means what it says.

use crate::accuracy::RayLanes;
use crate::geometry::sphere::{Sphere, Spheres};
use crate::lanes::{LaneMask, Lanes};
use crate::numeric::axes::{axes, dot};

/// How many spheres share one branch.
pub(crate) const GROUP: usize = 4;
/// How many groups are prepared at a time: 2 KiB of stack, and 3 % of the loop spent on rays.
const BLOCK: usize = 32;
/// How many spheres are prepared at a time.
pub(crate) const BLOCK_SPHERES: usize = BLOCK * GROUP;

/// 104 u.
const KAPPA: f32 = 104.0 / 16_777_216.0;
/// 2^40: above it a coordinate or radius is not judged.
const LARGEST: f32 = 1_099_511_627_776.0;
/// 2^-60: no sphere counts as smaller than this squared size.
const LEAST_SIZE: f32 = 1.0 / (1_073_741_824.0 * 1_073_741_824.0);
/// 2^100: above it a squared direction is not judged.
const LONGEST: f32 = LARGEST * LARGEST * 1_048_576.0;
/// 2^-60: below it a squared direction is not judged. (2^-100 dropped hits that `Fast` owes to
/// underflow.)
const SHORTEST: f32 = LEAST_SIZE;

/// Four spheres as the filter reads them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FilterGroup {
    center: [[f32; GROUP]; 3],
    /// r^2 - |c|^2, raised by the bound; `-inf` never passes, `+inf` always.
    excess: [f32; GROUP],
}

impl FilterGroup {
    const EMPTY: Self = Self { center: [[0.0; GROUP]; 3], excess: [f32::NEG_INFINITY; GROUP] };

    #[inline(always)]
    fn put(&mut self, slot: usize, sphere: &Sphere, shift: [f32; 3], kappa: f32) {
        if !sphere.is_valid() {
            return;
        }
        if sphere.center.abs().max_element().max(sphere.radius) > LARGEST {
            self.excess[slot] = f32::INFINITY;
            return;
        }
        let [x, y, z] = axes!(i => sphere.center[i] - shift[i]);
        self.center[0][slot] = x;
        self.center[1][slot] = y;
        self.center[2][slot] = z;
        self.excess[slot] = excess([x, y, z], sphere.radius, kappa);
    }
}

/// r^2 - |c|^2, raised by the bound.
#[inline(always)]
fn excess<L: Lanes>(c: [L; 3], r: L, kappa: f32) -> L {
    let (cc, rr) = (dot(c, c), r * r);
    (rr - cc) + r.like(kappa) * (cc + rr).filter_max(r.like(LEAST_SIZE))
}

/// The next spheres of a list, prepared on the stack.
#[derive(Clone, Debug)]
pub(crate) struct FilterBlock {
    groups: [FilterGroup; BLOCK],
    count: usize,
    shift: [f32; 3],
}

impl FilterBlock {
    /// Spheres `first ..` of the list, as many as a block takes.
    pub(crate) fn new(spheres: &Spheres<'_>, first: usize) -> Self {
        Self::widened(spheres, first, KAPPA)
    }

    #[inline(always)]
    fn widened(spheres: &Spheres<'_>, first: usize, kappa: f32) -> Self {
        let shift = middle(spheres, first);
        let mut groups = [FilterGroup::EMPTY; BLOCK];
        let mut count = 0;
        for (group, start) in groups.iter_mut().zip((first..spheres.len()).step_by(GROUP)) {
            for slot in 0..GROUP {
                if let Some(sphere) = spheres.get(start + slot) {
                    group.put(slot, &sphere, shift, kappa);
                }
            }
            count += 1;
        }
        Self { groups, count, shift }
    }

    /// The groups, in the order of the list.
    #[inline(always)]
    pub(crate) fn groups(&self) -> &[FilterGroup] {
        self.groups.get(..self.count).unwrap_or(&[])
    }
}

/// A point among the spheres of a block, that one sphere far away cannot move far: coordinate by
/// coordinate the median of three of them. Any finite point would be right.
fn middle(spheres: &Spheres<'_>, first: usize) -> [f32; 3] {
    let count = (spheres.len() - first).min(BLOCK_SPHERES);
    let [a, b, c] = [0, count / 2, count.saturating_sub(1)].map(|offset| {
        spheres.get(first + offset).map_or([0.0; 3], |sphere| sphere.center.to_array())
    });
    [0, 1, 2].map(|axis| {
        let median = a[axis].max(b[axis]).min(a[axis].min(b[axis]).max(c[axis]));
        if median.abs() <= LARGEST { median } else { 0.0 }
    })
}

/// The rays of a packet as the filter reads them, for one block.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FilterRays<L: Lanes> {
    /// d, of unit length up to 4.5 u.
    direction: [L; 3],
    /// 2 o.
    twice_origin: [L; 3],
    /// -d.o.
    minus_along: L,
    /// |o|^2, lowered by the bound; what passes lies above.
    threshold: L,
}

impl<L: Lanes> FilterRays<L> {
    #[inline(always)]
    pub(crate) fn new(token: L::Token, rays: &RayLanes<L>, block: &FilterBlock) -> Self {
        Self::widened(token, rays, block, KAPPA)
    }

    #[inline(always)]
    fn widened(token: L::Token, rays: &RayLanes<L>, block: &FilterBlock, kappa: f32) -> Self {
        // Rays that the bound does not cover are replaced by one that it does.
        let a = dot(rays.direction, rays.direction);
        let far = rays.origin[0].abs().filter_max(rays.origin[1].abs());
        let far = far.filter_max(rays.origin[2].abs());
        let judged =
            rays.live & a.like(SHORTEST).le(a) & a.le(a.like(LONGEST)) & far.le(a.like(LARGEST));
        let (zero, one) = (a.like(0.0), a.like(1.0));
        let per_length = one / L::select(judged, a, one).sqrt();
        let direction = axes!(i => L::select(judged, rays.direction[i] * per_length, zero));
        let origin = axes!(i => {
            let shifted = rays.origin[i] - L::splat(token, block.shift[i]);
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
    fn raised(&self, group: &FilterGroup, slot: usize) -> L {
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

#[cfg(test)]
mod derived;
#[cfg(test)]
mod toy;
#[cfg(test)]
mod worst;
