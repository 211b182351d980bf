//! How far the rays of a group reach to the sides, where they start and where they end.

use super::member::Member;
use super::view::{Heading, View, fits};
use super::walk::{LARGE, MIDDLE};
use crate::accuracy::RayLanes;
use crate::{LaneMask, Lanes, RayPacket};

/// The bounds of a group's live rays; of none, the empty ones.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    /// Of [`View::screen`].
    pub(super) low: [f32; 2],
    pub(super) high: [f32; 2],
    /// The least depth that a ray starts at.
    pub(super) front: f32,
    /// The greatest depth that a ray goes to.
    pub(super) end: f32,
    /// The largest coordinate of an origin.
    pub(super) far: f32,
}

impl Bounds {
    pub(super) const EMPTY: Self = Self {
        low: [f32::INFINITY; 2],
        high: [f32::NEG_INFINITY; 2],
        front: f32::INFINITY,
        end: f32::NEG_INFINITY,
        far: 0.0,
    };

    /// Bounds of both.
    pub(super) fn and(self, other: Self) -> Self {
        Self {
            low: [self.low[0].min(other.low[0]), self.low[1].min(other.low[1])],
            high: [self.high[0].max(other.high[0]), self.high[1].max(other.high[1])],
            front: self.front.min(other.front),
            end: self.end.max(other.end),
            far: self.far.max(other.far),
        }
    }
}

/// The bounds of a group, lane by lane.
#[derive(Clone, Copy, Debug)]
pub(super) struct BoundLanes<L> {
    minus_low: [L; 2],
    high: [L; 2],
    minus_front: L,
    end: L,
    far: L,
}

impl<L: Lanes> BoundLanes<L> {
    #[inline(always)]
    pub(super) fn empty(token: L::Token) -> Self {
        let none = L::splat(token, f32::NEG_INFINITY);
        let zero = L::splat(token, 0.0);
        Self { minus_low: [none; 2], high: [none; 2], minus_front: none, end: none, far: zero }
    }

    #[inline(always)]
    pub(super) fn add<V: View>(&mut self, view: &V, heading: &Heading, member: &Member<L>) {
        let live = member.rays.live;
        let none = member.best.like(f32::NEG_INFINITY);
        let [i, j] = view.screen(heading, &member.rays);
        self.minus_low[0] = self.minus_low[0].filter_max(L::select(live, -i, none));
        self.minus_low[1] = self.minus_low[1].filter_max(L::select(live, -j, none));
        self.high[0] = self.high[0].filter_max(L::select(live, i, none));
        self.high[1] = self.high[1].filter_max(L::select(live, j, none));
        let front = -(member.start + member.depth);
        self.minus_front = self.minus_front.filter_max(L::select(live, front, none));
        self.end = self.end.filter_max(L::select(live, member.best + member.depth, none));
        let [x, y, z] = member.origin;
        let far = x.abs().filter_max(y.abs()).filter_max(z.abs());
        self.far = self.far.filter_max(L::select(live, far, none.like(0.0)));
    }

    #[inline(always)]
    pub(super) fn bounds(&self) -> Bounds {
        Bounds {
            low: [-greatest(self.minus_low[0]), -greatest(self.minus_low[1])],
            high: [greatest(self.high[0]), greatest(self.high[1])],
            front: -greatest(self.minus_front),
            end: greatest(self.end),
            far: greatest(self.far),
        }
    }
}

/// The largest of the lanes, by halves: seven chains, lane after lane, cost some percent more.
#[inline(always)]
fn greatest<L: Lanes>(lanes: L) -> f32 {
    let mut array = lanes.store();
    let mut count = L::COUNT;
    while let Some((low, high)) = array.as_mut().get_mut(..count).and_then(halves) {
        for (low, high) in low.iter_mut().zip(high) {
            *low = if *low < *high { *high } else { *low };
        }
        count /= 2;
    }
    array.as_ref().first().copied().unwrap_or(f32::INFINITY)
}

/// Two halves; nothing where there is but one number.
#[inline(always)]
fn halves(numbers: &mut [f32]) -> Option<(&mut [f32], &[f32])> {
    let (low, high) = numbers.split_at_mut_checked(numbers.len() / 2)?;
    (!low.is_empty()).then_some((low, high))
}

/// The way that the first live ray of some packets runs.
#[inline(always)]
fn heading_of<L: Lanes>(token: L::Token, packets: &[RayPacket<L>]) -> Option<Heading> {
    for packet in packets {
        let live = RayLanes::<L>::load(token, packet).live.bits();
        if live != 0 {
            let lane = live.trailing_zeros() as usize;
            let [x, y, z] = &packet.direction;
            let component = |array: &L::Array| array.as_ref().get(lane).copied();
            return Some(Heading::of([component(x)?, component(y)?, component(z)?]));
        }
    }
    None
}

/// The packets, at the front of some, that make up a large group, and the bounds of its parts.
#[derive(Clone, Copy, Debug)]
pub(super) struct Survey {
    /// How many.
    pub(super) packets: usize,
    pub(super) heading: Heading,
    pub(super) bounds: [Bounds; LARGE / MIDDLE],
}

impl Survey {
    /// Nothing where not even the first packet's rays are covered, or none of a whole group is live.
    #[inline(always)]
    pub(super) fn new<L: Lanes, V: View>(
        token: L::Token,
        view: &V,
        packets: &[RayPacket<L>],
    ) -> Option<Self> {
        let packets = packets.get(..LARGE).unwrap_or(packets);
        let heading = heading_of::<L>(token, packets)?;
        let mut survey = Self { packets: 0, heading, bounds: [Bounds::EMPTY; LARGE / MIDDLE] };
        for (packets, bounds) in packets.chunks(MIDDLE).zip(&mut survey.bounds) {
            let mut lanes = BoundLanes::<L>::empty(token);
            let before = survey.packets;
            for packet in packets {
                let member = Member::<L>::new(token, view, packet);
                if (member.rays.live & !fits(view, &heading, &member.rays)).any() {
                    break;
                }
                lanes.add(view, &heading, &member);
                survey.packets += 1;
            }
            *bounds = lanes.bounds();
            if survey.packets < before + MIDDLE {
                break;
            }
        }
        (survey.packets > 0).then_some(survey)
    }

    /// Of all packets.
    #[inline(always)]
    pub(super) fn all(&self) -> Bounds {
        let mut all = Bounds::EMPTY;
        for bounds in &self.bounds {
            all = all.and(*bounds);
        }
        all
    }
}

/// How many packets there are until one of which the bounds cover all rays; at least one.
#[inline(always)]
pub(super) fn uncovered<L: Lanes, V: View>(
    token: L::Token,
    view: &V,
    packets: &[RayPacket<L>],
) -> usize {
    let mut count = 1;
    for packet in packets.iter().skip(1) {
        if let Some(heading) = heading_of::<L>(token, core::slice::from_ref(packet)) {
            let rays = RayLanes::<L>::load(token, packet);
            if !(rays.live & !fits(view, &heading, &rays)).any() {
                break;
            }
        }
        count += 1;
    }
    count
}
