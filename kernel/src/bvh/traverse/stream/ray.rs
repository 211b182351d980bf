//! A ray of a stream: what nodes and leaves ask of it, and what it has found.

use crate::accuracy::Accuracy;
use crate::bvh::leaf::Leaf;
use crate::bvh::node::octant_of;
use crate::bvh::traverse::boxes::BoxProbe;
use crate::bvh::traverse::deferred::RayPlace;
use crate::bvh::traverse::prepared_packet::PreparedPacket;
use crate::bvh::traverse::ray_time::RayTime;
use crate::bvh::traverse::root_interval::RayProbe;
use crate::count::count;
use crate::lanes::{LaneArray, Lanes};
use crate::numeric::axes::axes;

/// Memory for a ray of a stream. 128 bytes: a cache line that nodes read, and one that leaves read besides.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub struct StreamRay {
    /// As in [`PreparedPacket`].
    inverse: [f32; 3],
    minus_inverse: [f32; 3],
    minus_near: [f32; 3],
    far: [f32; 3],
    /// The s from which, and up to which, boxes matter.
    start_of_boxes: f32,
    pub(super) end_of_boxes: f32,
    /// The sphere that may be the closest, by its place in the leaves, and an s that none of its answers is below,
    /// or NaN if there is no such sphere.
    pub(super) place: u32,
    pub(super) entry: f32,

    /// As in [`PreparedPacket`].
    origin: [f32; 3],
    direction: [f32; 3],
    start: [f32; 2],
    end: f32,
    absolute_error: f32,
    time: RayTime<f32>,
    spread: f32,
    /// An s that some answer, or the end of the interval, is not above.
    pub(super) best: f32,
    /// Its number among the rays that go down together; [`NO_RAY`](Self::NO_RAY) if it is not in the stream.
    number: u32,
}

impl StreamRay {
    /// No ray: what memory for a stream is filled with.
    pub const EMPTY: Self = Self {
        inverse: [0.0; 3],
        minus_inverse: [0.0; 3],
        minus_near: [0.0; 3],
        far: [0.0; 3],
        start_of_boxes: 0.0,
        end_of_boxes: 0.0,
        place: 0,
        entry: f32::NAN,
        origin: [0.0; 3],
        direction: [0.0; 3],
        start: [0.0; 2],
        end: 0.0,
        absolute_error: 0.0,
        time: RayTime { per_t: 0.0, shift: 0.0, length: 0.0 },
        spread: 0.0,
        best: 0.0,
        number: Self::NO_RAY,
    };

    /// The number of a lane that is in no stream.
    const NO_RAY: u32 = u32::MAX;

    /// Takes lane `lane` of a prepared packet.
    #[inline(always)]
    pub(super) fn begin<A: LaneArray>(
        &mut self,
        prepared: &PreparedPacket<A>,
        lane: usize,
        number: u32,
    ) {
        let spread = prepared.spread.get(lane);
        let (start, best) = (prepared.start[0].get(lane), prepared.end[1].get(lane));
        self.inverse = axes!(i => prepared.inverse[i].get(lane));
        self.minus_inverse = axes!(i => prepared.minus_inverse[i].get(lane));
        self.minus_near = axes!(i => prepared.minus_near[i].get(lane));
        self.far = axes!(i => prepared.far[i].get(lane));
        self.start_of_boxes = start - spread;
        self.end_of_boxes = best + spread;
        self.entry = f32::NAN;
        self.origin = axes!(i => prepared.origin[i].get(lane));
        self.direction = axes!(i => prepared.direction[i].get(lane));
        self.start = [start, prepared.start[1].get(lane)];
        self.end = prepared.end[0].get(lane);
        self.absolute_error = prepared.absolute_error.get(lane);
        self.time = prepared.time(lane);
        self.spread = spread;
        self.best = best;
        self.number = number;
    }

    /// Makes it no ray of the stream.
    #[inline(always)]
    pub(super) fn leave_out(&mut self) {
        (self.number, self.entry) = (Self::NO_RAY, f32::NAN);
    }

    /// The octant of its direction; 8 if it is not in the stream.
    #[inline(always)]
    pub(super) fn octant(&self) -> u32 {
        let octant = octant_of(axes!(i => self.inverse[i].is_sign_negative()));
        if self.number == Self::NO_RAY { 8 } else { octant }
    }

    /// Where its answer goes, if the first of the rays that are numbered is of packet `first`.
    #[inline(always)]
    pub(super) fn whose<A: LaneArray>(&self, first: usize) -> RayPlace {
        let number = self.number as usize;
        RayPlace { packet: first + number / A::COUNT, lane: number % A::COUNT }
    }

    /// The ray in all lanes, as boxes see it.
    #[inline(always)]
    pub(super) fn box_probe<L: Lanes>(&self, token: L::Token) -> BoxProbe<L> {
        BoxProbe {
            inverse: axes!(i => L::splat(token, self.inverse[i])),
            minus_inverse: axes!(i => L::splat(token, self.minus_inverse[i])),
            minus_near: axes!(i => L::splat(token, self.minus_near[i])),
            far: axes!(i => L::splat(token, self.far[i])),
            start: L::splat(token, self.start_of_boxes),
            minus_end: L::splat(token, -self.end_of_boxes),
        }
    }

    /// The ray in all lanes, as leaves see it.
    #[inline(always)]
    pub(super) fn probe<L: Lanes>(&self, token: L::Token, tier: impl Accuracy) -> RayProbe<L> {
        RayProbe {
            origin: axes!(i => L::splat(token, self.origin[i])),
            direction: axes!(i => L::splat(token, self.direction[i])),
            start: [L::splat(token, self.start[0]), L::splat(token, self.start[1])],
            end: [L::splat(token, self.end), L::splat(token, self.best)],
            absolute_error: L::splat(token, self.absolute_error),
            raise: L::splat(token, self.time.raise(tier)),
            spread: tier.spread(),
        }
    }

    /// Which spheres of a leaf to look at, a bit each.
    #[inline(always)]
    pub(super) fn may_hit<L: Lanes, const SPREADS: bool>(
        &self,
        token: L::Token,
        tier: impl Accuracy,
        leaf: &Leaf<'_>,
    ) -> u32 {
        count!(StreamLeaf);
        self.probe::<L>(token, tier).may_hit::<SPREADS>(leaf)
    }

    /// Takes a t that the tier has answered: `-inf` if the ray is done, `+inf` if there is no hit.
    #[inline(always)]
    pub(super) fn take_answer(&mut self, t: f32) {
        if t < f32::INFINITY {
            self.shorten(self.time.after(t));
        }
    }

    /// Takes an s that some answer is not above, if it is less than what is known.
    #[inline(always)]
    pub(super) fn shorten(&mut self, bound: f32) {
        if bound < self.best {
            self.best = bound;
            self.end_of_boxes = bound + self.spread;
        }
    }
}
