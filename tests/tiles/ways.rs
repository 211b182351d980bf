//! Tiers in lane widths and instruction sets, by way of tile lists, as plain functions.

use spherule_kernel::dispatch::{self, Level, Packet};
use spherule_kernel::{
    Accuracy, DepthOrder, Exact, Hit, HitArrays, HitPacket, LaneArray, Lanes, Ray, RayPacket,
    Stable, f32x4, f32x8, tiles,
};
use spherule_tests::doors::{Columns, DOORS, Door};

pub(crate) type Answers = (Vec<Option<Hit>>, Vec<bool>);

/// A tier in a lane width and an instruction set.
#[derive(Clone, Copy)]
pub(crate) struct Way {
    pub(crate) tier: &'static str,
    pub(crate) name: &'static str,
    pub(crate) go: fn(&[Ray], &Columns, &DepthOrder<'_>, &mut [u32]) -> Answers,
}

/// Few, since each is compiled for minutes; the last of a tier is the fastest.
pub(crate) const WAYS: [Way; 4] = [
    Way { tier: Exact::NAME, name: "8 lanes", go: built::<Exact, f32x8> },
    Way { tier: Exact::NAME, name: "dispatched", go: dispatched::<Exact> },
    Way { tier: Stable::NAME, name: "4 lanes", go: built::<Stable, f32x4> },
    Way { tier: Stable::NAME, name: "dispatched", go: dispatched::<Stable> },
];

/// The same without lists, in sixteen lanes.
pub(crate) fn brute(tier: &str) -> Door {
    let door = DOORS.into_iter().find(|door| door.tier == tier && door.lanes == 16);
    door.expect("every tier has sixteen lanes")
}

fn built<A: Accuracy, L: Lanes<Token = ()>>(
    rays: &[Ray],
    spheres: &Columns,
    order: &DepthOrder<'_>,
    lists: &mut [u32],
) -> Answers {
    let packets: Vec<RayPacket<L>> = rays.chunks(L::COUNT).map(RayPacket::<L>::new).collect();
    // What was there before must not show.
    let mut hits = vec![HitPacket::<L>::none(); packets.len()];
    let mut met = vec![u32::MAX; packets.len()];
    tiles::nearest::<A, L>((), &packets, spheres.spheres(), order, lists, &mut hits);
    tiles::any::<A, L>((), &packets, spheres.spheres(), order, lists, &mut met);
    unpacked(rays.len(), &hits, &met)
}

fn dispatched<A: Accuracy>(
    rays: &[Ray],
    spheres: &Columns,
    order: &DepthOrder<'_>,
    lists: &mut [u32],
) -> Answers {
    let (level, spheres) = (Level::best(), spheres.spheres());
    let packets: Vec<_> = rays.chunks(Packet::COUNT).map(RayPacket::<Packet>::new).collect();
    let mut hits = vec![HitPacket::<Packet>::none(); packets.len()];
    let mut met = vec![u32::MAX; packets.len()];
    dispatch::tiles::nearest::<A>(level, &packets, spheres, order, lists, &mut hits);
    dispatch::tiles::any::<A>(level, &packets, spheres, order, lists, &mut met);
    unpacked(rays.len(), &hits, &met)
}

fn unpacked<A: LaneArray>(count: usize, hits: &[HitArrays<A>], met: &[u32]) -> Answers {
    let place = |index: usize| (index / A::COUNT, index % A::COUNT);
    let answer =
        |(packet, lane): (usize, usize)| (hits[packet].hit(lane), met[packet] >> lane & 1 == 1);
    (0..count).map(place).map(answer).unzip()
}
