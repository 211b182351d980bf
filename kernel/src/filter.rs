//! The miss filter: a discriminant that costs little and drops nothing.

use crate::accuracy::RayLanes;
use crate::{LaneMask, Lanes, Sphere, Spheres};

/// How many spheres share one branch.
pub(crate) const GROUP: usize = 4;
/// How many groups are prepared on the stack at a time.
pub(crate) const BLOCK: usize = 32;

/// Four spheres as the filter reads them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FilterGroup {
    x: [f32; GROUP],
    y: [f32; GROUP],
    z: [f32; GROUP],
    /// The widened r^2; `-inf` never passes, `+inf` always.
    r2: [f32; GROUP],
}

const LARGEST: f32 = 1.099_511_6e12; // 2^40
const LARGEST_SQUARE: f32 = LARGEST * LARGEST;
const SMALLEST_SQUARE: f32 = 1.0 / LARGEST_SQUARE / LARGEST_SQUARE * LARGEST; // 2^-120
const WIDENING: f32 = 88.0 * 5.960_464_5e-8; // 88 u

impl FilterGroup {
    pub(crate) const EMPTY: Self =
        Self { x: [0.0; GROUP], y: [0.0; GROUP], z: [0.0; GROUP], r2: [f32::NEG_INFINITY; GROUP] };

    /// Spheres `first ..` of the list, as many as there are.
    #[inline(always)]
    pub(crate) fn prepare(spheres: &Spheres<'_>, first: usize) -> Self {
        let mut group = Self::EMPTY;
        for slot in 0..GROUP {
            let Some(Sphere { center, radius }) = spheres.get(first + slot) else { break };
            let valid = Sphere { center, radius }.is_valid();
            let reach = center.abs().max_element().max(radius);
            let size =
                center.x * center.x + center.y * center.y + center.z * center.z + radius * radius;
            if valid && reach <= LARGEST {
                group.x[slot] = center.x;
                group.y[slot] = center.y;
                group.z[slot] = center.z;
                group.r2[slot] = radius * radius + WIDENING * size.max(SMALLEST_SQUARE);
            } else if valid {
                group.r2[slot] = f32::INFINITY;
            }
        }
        group
    }
}

/// The rays of a packet as the filter reads them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FilterRays<L: Lanes> {
    origin: [L; 3],
    direction: [L; 3],
    a: L,
    threshold: L,
}

impl<L: Lanes> FilterRays<L> {
    #[inline(always)]
    pub(crate) fn new(token: L::Token, rays: &RayLanes<L>) -> Self {
        let (zero, one) = (L::splat(token, 0.0), L::splat(token, 1.0));
        let dot = |v: [L; 3]| v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
        let (a, oo) = (dot(rays.direction), dot(rays.origin));
        let judged = rays.live
            & L::splat(token, 1.0 / LARGEST).le(a)
            & a.le(L::splat(token, LARGEST))
            & oo.le(L::splat(token, LARGEST_SQUARE));
        let slack = L::splat(token, -WIDENING) * a * oo;
        let otherwise = L::select(
            rays.live,
            L::splat(token, f32::NEG_INFINITY),
            L::splat(token, f32::INFINITY),
        );
        Self {
            origin: rays.origin.map(|o| L::select(judged, o, zero)),
            direction: rays.direction.map(|d| L::select(judged, d, one)),
            a: L::select(judged, a, one + one + one),
            threshold: L::select(judged, slack, otherwise),
        }
    }

    #[inline(always)]
    fn discriminant(&self, group: &FilterGroup, slot: usize) -> L {
        let token = self.a.token();
        let [ox, oy, oz] = self.origin;
        let [dx, dy, dz] = self.direction;
        let x = L::splat(token, group.x[slot]) - ox;
        let y = L::splat(token, group.y[slot]) - oy;
        let z = L::splat(token, group.z[slot]) - oz;
        let b = z.filter_mul_add(dz, y.filter_mul_add(dy, x * dx));
        let minus_r2 = L::splat(token, -group.r2[slot]);
        let c = z.filter_mul_add(z, y.filter_mul_add(y, x.filter_mul_add(x, minus_r2)));
        b.filter_mul_add(b, -(self.a * c))
    }

    /// Whether any lane may meet any sphere of the group.
    #[inline(always)]
    pub(crate) fn may_meet_any(&self, group: &FilterGroup) -> bool {
        let m01 = self.discriminant(group, 0).filter_max(self.discriminant(group, 1));
        let m23 = self.discriminant(group, 2).filter_max(self.discriminant(group, 3));
        self.threshold.le(m01.filter_max(m23)).any()
    }

    /// Whether any lane may meet sphere `slot` of the group.
    #[inline(always)]
    pub(crate) fn may_meet(&self, group: &FilterGroup, slot: usize) -> bool {
        self.threshold.le(self.discriminant(group, slot)).any()
    }
}
