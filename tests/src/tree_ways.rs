//! Ways through a tree: tier, lanes and instruction set, as plain functions, so that a test can
//! say "all of them" in one loop, and they are compiled once.

use crate::doors::Columns;
use spherule_kernel::dispatch::{Level, LevelName};
use spherule_kernel::{
    Accuracy, Bvh, BvhLeaf, BvhNode, BvhSize, Exact, Fast, Hit, HitPacket, Lanes, Ray, RayPacket,
    Stable, bvh, dispatch, f32x8, f32x16,
};

/// Memory for a tree.
#[derive(Clone, Debug)]
pub struct Memory {
    /// The nodes.
    pub nodes: Vec<BvhNode>,
    /// The leaves.
    pub leaves: Vec<BvhLeaf>,
}

impl Memory {
    /// As much as `count` spheres need.
    #[must_use]
    pub fn new(count: usize) -> Self {
        let BvhSize { nodes, leaves } = Bvh::needed(count);
        Self { nodes: vec![BvhNode::EMPTY; nodes], leaves: vec![BvhLeaf::EMPTY; leaves] }
    }

    /// A tree in it.
    ///
    /// # Panics
    /// Where there are more spheres than it was made for.
    pub fn build(&mut self, spheres: &Columns) -> Bvh<'_> {
        Bvh::build(spheres.spheres(), &mut self.nodes, &mut self.leaves).expect("enough memory")
    }
}

/// What the rays meet: the nearest, and whether any.
pub type Answers = (Vec<Option<Hit>>, Vec<bool>);

/// A way through a tree.
#[derive(Clone, Copy, Debug)]
pub struct Way {
    /// The tier's name.
    pub tier: &'static str,
    /// Lanes of `wide`, or a level.
    pub lanes: &'static str,
    level: Option<LevelName>,
    one_by_one: fn(Option<Level>, &[Ray], &Columns, &Bvh<'_>) -> Answers,
    coherent: fn(Option<Level>, &[Ray], &Columns, &Bvh<'_>) -> Answers,
}

/// All of them that the CPU has; the same source, so few stand for all.
pub fn ways() -> impl Iterator<Item = Way> {
    let fixed = [
        fixed::<Exact, f32>("1 lane"),
        fixed::<Stable, f32x8>("8 lanes"),
        fixed::<Fast, f32x8>("8 lanes"),
    ];
    let levels = LevelName::ALL.into_iter().filter(|&name| Level::named(name).is_some());
    let levels = levels.flat_map(|name| [dispatched::<Exact>(name), dispatched::<Stable>(name)]);
    fixed.into_iter().chain(levels)
}

const fn fixed<A: Accuracy, L: Lanes<Token = ()>>(lanes: &'static str) -> Way {
    Way {
        tier: A::NAME,
        lanes,
        level: None,
        one_by_one: |_, rays, spheres, tree| {
            answers::<L>(
                rays,
                |rays, hits| bvh::nearest::<A, L>((), rays, spheres.spheres(), tree, hits),
                |rays, met| bvh::any::<A, L>((), rays, spheres.spheres(), tree, met),
            )
        },
        coherent: |_, rays, spheres, tree| {
            answers::<L>(
                rays,
                |rays, hits| bvh::nearest_coherent::<A, L>((), rays, spheres.spheres(), tree, hits),
                |rays, met| bvh::any_coherent::<A, L>((), rays, spheres.spheres(), tree, met),
            )
        },
    }
}

const fn dispatched<A: Accuracy>(name: LevelName) -> Way {
    Way {
        tier: A::NAME,
        lanes: name.as_str(),
        level: Some(name),
        one_by_one: |level, rays, spheres, tree| {
            let (level, list) = (level.expect("a level"), spheres.spheres());
            answers::<f32x16>(
                rays,
                |rays, hits| dispatch::bvh::nearest::<A>(level, rays, list, tree, hits),
                |rays, met| dispatch::bvh::any::<A>(level, rays, list, tree, met),
            )
        },
        coherent: |level, rays, spheres, tree| {
            let (level, list) = (level.expect("a level"), spheres.spheres());
            answers::<f32x16>(
                rays,
                |rays, hits| dispatch::bvh::nearest_coherent::<A>(level, rays, list, tree, hits),
                |rays, met| dispatch::bvh::any_coherent::<A>(level, rays, list, tree, met),
            )
        },
    }
}

impl Way {
    /// What the rays meet, each on its own way through the tree.
    #[must_use]
    pub fn one_by_one(&self, rays: &[Ray], spheres: &Columns, tree: &Bvh<'_>) -> Answers {
        (self.one_by_one)(self.level(), rays, spheres, tree)
    }

    /// What the rays meet, packets that look the same way together.
    #[must_use]
    pub fn coherent(&self, rays: &[Ray], spheres: &Columns, tree: &Bvh<'_>) -> Answers {
        (self.coherent)(self.level(), rays, spheres, tree)
    }

    fn level(&self) -> Option<Level> {
        self.level.and_then(Level::named)
    }
}

fn answers<L: Lanes>(
    rays: &[Ray],
    nearest: impl Fn(&[RayPacket<L>], &mut [HitPacket<L>]),
    any: impl Fn(&[RayPacket<L>], &mut [u32]),
) -> Answers {
    let packets: Vec<RayPacket<L>> = rays.chunks(L::COUNT).map(RayPacket::<L>::new).collect();
    // Twice, since what was there before must not show.
    let mut hits = vec![HitPacket::<L>::none(); packets.len()];
    let mut met = vec![u32::MAX; packets.len()];
    nearest(&packets, &mut hits);
    nearest(&packets, &mut hits);
    any(&packets, &mut met);
    let place = |index: usize| (index / L::COUNT, index % L::COUNT);
    (0..rays.len())
        .map(place)
        .map(|(packet, lane)| (hits[packet].hit(lane), met[packet] >> lane & 1 == 1))
        .unzip()
}
