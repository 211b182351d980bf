//! From candidates to answers: where the tier is asked.
//!
//! Candidates of any rays wait until there is one for every lane; then the tier is asked about all
//! of them at once.

use super::answers::Answers;
use super::{BvhLeaf, WIDTH};
use crate::accuracy::RayLanes;
use crate::axes::axes;
use crate::{Accuracy, Hit, LaneArray, Lanes, RayPacket, Sphere};
use glam::Vec3;

/// A ray of a list of packets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct RayPlace {
    pub(super) packet: usize,
    pub(super) lane: usize,
}

impl RayPlace {
    pub(super) const FIRST: Self = Self { packet: 0, lane: 0 };
}

/// Rays and spheres that the tier will be asked about, one of each a lane.
pub(super) struct Questions<L: Lanes> {
    rays: RayPacket<L>,
    center: [L::Array; 3],
    radius: L::Array,
    index: <L::Array as LaneArray>::Ids,
    whose: <L::Array as LaneArray>::Each<RayPlace>,
    count: usize,
}

impl<L: Lanes> Questions<L> {
    #[inline(always)]
    pub(super) fn none() -> Self {
        Self {
            rays: RayPacket::<L>::inactive(),
            center: Default::default(),
            radius: Default::default(),
            index: Default::default(),
            whose: L::Array::each(RayPlace::FIRST),
            count: 0,
        }
    }

    /// Adds a ray and the sphere at `place` in the leaves; asks, where that makes as many as there
    /// are lanes.
    #[inline(always)]
    pub(super) fn add<A: Accuracy>(
        &mut self,
        token: L::Token,
        (packets, whose): (&[RayPacket<L>], RayPlace),
        (leaves, place): (&[BvhLeaf], u32),
        answers: &mut impl Answers<L>,
    ) {
        let (Some(packet), Some((sphere, index))) =
            (packets.get(whose.packet), sphere_at(leaves, place))
        else {
            return;
        };
        let lane = self.count;
        for axis in 0..3 {
            copy(&packet.origin[axis], whose.lane, &mut self.rays.origin[axis], lane);
            copy(&packet.direction[axis], whose.lane, &mut self.rays.direction[axis], lane);
            put(&mut self.center[axis], lane, sphere.center[axis]);
        }
        copy(&packet.t_min, whose.lane, &mut self.rays.t_min, lane);
        copy(&packet.t_max, whose.lane, &mut self.rays.t_max, lane);
        put(&mut self.radius, lane, sphere.radius);
        if let (Some(number), Some(place)) =
            (self.index.as_mut().get_mut(lane), self.whose.as_mut().get_mut(lane))
        {
            (*number, *place) = (index, whose);
            self.count += 1;
        }
        if self.count == L::COUNT {
            self.ask::<A>(token, answers);
        }
    }

    /// Asks the tier about what there is, and hands its answers on.
    #[inline(always)]
    pub(super) fn ask<A: Accuracy>(&mut self, token: L::Token, answers: &mut impl Answers<L>) {
        if self.count == 0 {
            return;
        }
        let asked = (1_u64 << self.count) - 1;
        self.count = 0;
        let rays = RayLanes::load(token, &self.rays);
        let asked = rays.live & L::mask(token, asked as u32);
        let center = axes!(i => L::load(token, &self.center[i]));
        let radius = L::load(token, &self.radius);
        let t = ask::<A, L>(&rays, center, radius, asked, L::splat(token, f32::INFINITY)).store();
        let indices = self.index.as_ref().iter().zip(self.whose.as_ref());
        for (&t, (&sphere, whose)) in t.as_ref().iter().zip(indices) {
            if t < f32::INFINITY {
                answers.take(whose.packet, whose.lane, Hit { t, sphere });
            }
        }
    }
}

#[inline(always)]
fn put<A: LaneArray>(array: &mut A, lane: usize, value: f32) {
    if let Some(element) = array.as_mut().get_mut(lane) {
        *element = value;
    }
}

#[inline(always)]
fn copy<A: LaneArray>(from: &A, there: usize, to: &mut A, here: usize) {
    if let Some(value) = from.as_ref().get(there) {
        put(to, here, *value);
    }
}

/// The sphere at a place in the leaves, and its index.
#[inline(always)]
pub(super) fn sphere_at(leaves: &[BvhLeaf], place: u32) -> Option<(Sphere, u32)> {
    let (leaf, lane) = (leaves.get(place as usize / WIDTH)?, place as usize % WIDTH);
    let [x, y, z] = axes!(i => leaf.center[i][lane]);
    Some((Sphere { center: Vec3::new(x, y, z), radius: leaf.radius[lane] }, leaf.index[lane]))
}

/// Asks the tier about one sphere a lane: t where there is a hit in a lane that is `asked`, else
/// `+inf`.
///
/// The one place where the tree does so, and a function of its own: a tier is long, and would be
/// compiled into every walk several times.
#[inline(always)]
pub(crate) fn ask<A: Accuracy, L: Lanes>(
    rays: &RayLanes<L>,
    center: [L; 3],
    radius: L,
    asked: L::Mask,
    limit: L,
) -> L {
    L::out_of_line(
        limit.token(),
        #[inline(always)]
        || {
            let t = A::first_root(rays, &A::prepare(rays), center, radius, asked, limit);
            L::select(asked, t, limit.like(f32::INFINITY))
        },
    )
}

/// Asks about spheres that every ray must be tested against, for the rays of a packet in `lanes`.
#[inline(always)]
pub(super) fn settle_outside<A: Accuracy, L: Lanes>(
    rays: &RayLanes<L>,
    outside: &[BvhLeaf],
    lanes: u32,
    packet: usize,
    answers: &mut impl Answers<L>,
) {
    let token = rays.t_min.token();
    let asked = rays.live & L::mask(token, lanes);
    for leaf in outside {
        for place in 0..WIDTH {
            if leaf.radius[place] >= 0.0 {
                let center = axes!(i => L::splat(token, leaf.center[i][place]));
                let radius = L::splat(token, leaf.radius[place]);
                let limit = L::splat(token, f32::INFINITY);
                let t = ask::<A, L>(rays, center, radius, asked, limit).store();
                for (lane, &t) in t.as_ref().iter().enumerate() {
                    if t < f32::INFINITY {
                        answers.take(packet, lane, Hit { t, sphere: leaf.index[place] });
                    }
                }
            }
        }
    }
}
