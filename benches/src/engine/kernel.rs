//! The kernel: every tier in every way to the hits, at a level or in lanes of a fixed width.

use super::blocks::{Blocks, InPackets, Memory};
use super::{BLOCK, Engine, Label, Promise, Query, Ready, SOME_RAYS};
use spherule_kernel::{
    DepthList, Intersect, Lanes, Level, LevelName, QueuedRay, RayPacket, SphereTree, StreamMemory,
    StreamRay, Tier, Trace, f32x4, f32x8, f32x16,
};
use spherule_tests::scenes::{Kind, Scene, viewpoint};
use std::cell::RefCell;
use std::rc::Rc;

/// How many tests of brute force a sample may cost.
const TESTS: usize = 1 << 25;
/// How many rays a stream has memory for: so many go down together.
pub(crate) const STREAM: usize = 8192;
/// Places in queues for each ray: with so many no queue is cut short.
const QUEUES: usize = 64;

/// A way to the hits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Way {
    /// Every ray against every sphere.
    BruteForce,
    RayByRay,
    /// Queues of rays, [`STREAM`] rays at a time.
    Stream,
    Packets,
    /// A list that is sorted anew for every pass over the rays.
    DepthList,
}

impl Way {
    pub(crate) const fn as_str(self) -> &'static str {
        match self {
            Self::BruteForce => "brute force",
            Self::RayByRay => "tree, ray by ray",
            Self::Stream => "tree, streams",
            Self::Packets => "tree, packets",
            Self::DepthList => "depth list",
        }
    }

    /// How many rays are in the cache when they are searched.
    const fn block(self) -> usize {
        match self {
            Self::Stream => STREAM,
            _ => BLOCK,
        }
    }
}

/// The levels that the CPU has, the best first. Where the build's target guarantees more than the baseline, the level of that name is
/// another one's, and left out.
pub(crate) fn levels() -> Vec<Level> {
    let own = |name| Level::named(name).filter(|level| level.name() == name);
    LevelName::ALL.into_iter().rev().filter_map(own).collect()
}

/// The engines of a scene.
pub(crate) struct Kernel<'a> {
    scene: &'a Scene,
    tree: Rc<SphereTree>,
    /// All engines that are compared share this memory, so that it is as warm in the cache for each.
    memory: Rc<RefCell<Memory>>,
}

impl<'a> Kernel<'a> {
    pub(crate) fn new(scene: &'a Scene, tree: &Rc<SphereTree>) -> Self {
        Self { scene, tree: Rc::clone(tree), memory: Rc::default() }
    }

    /// The engine that others are held to: `Exact` by the tree.
    pub(crate) fn truth(&self) -> Ready {
        self.at_level(Way::RayByRay, Tier::Exact, Level::best())
    }

    /// Every tier in brute force, in lanes of a fixed width, with the instructions that the build may use anywhere,
    /// and at every level.
    pub(crate) fn brute_force(&self) -> Vec<Engine> {
        let mut all = Vec::new();
        for tier in Tier::ALL {
            let in_lanes = |lanes, ready| {
                let label = Label { way: Way::BruteForce.as_str(), name: tier.as_str(), lanes };
                let promise = Promise::SameBits(self.reference(tier));
                Engine { label, promise, most_rays: usize::MAX, ready }
            };
            all.push(in_lanes("f32", self.in_lanes::<f32>(tier)));
            all.push(in_lanes("f32x4", self.in_lanes::<f32x4>(tier)));
            all.push(in_lanes("f32x8", self.in_lanes::<f32x8>(tier)));
            all.push(in_lanes("f32x16", self.in_lanes::<f32x16>(tier)));
            let at_level = |level| self.engine(Kind::Primary, (Way::BruteForce, tier, level));
            all.extend(levels().into_iter().map(at_level));
        }
        all
    }

    /// Every way: in `tiers` at the first level, in `Stable` at the others.
    pub(crate) fn ways(&self, kind: Kind, levels: &[Level], tiers: &[Tier]) -> Vec<Engine> {
        use Way::{BruteForce, DepthList, Packets, RayByRay, Stream};
        // Diffuse rays have no viewpoint; a camera's gain nothing as a stream.
        let ways: &[Way] = match kind {
            Kind::Primary => &[BruteForce, RayByRay, Packets, DepthList],
            Kind::Diffuse => &[BruteForce, RayByRay, Packets, Stream],
        };
        let mut all = Vec::new();
        for (index, &level) in levels.iter().enumerate() {
            for &way in ways {
                let tiers = if index == 0 { tiers } else { &[Tier::Stable] };
                all.extend(tiers.iter().map(|&tier| self.engine(kind, (way, tier, level))));
            }
        }
        all
    }

    /// What the other ways are held to.
    fn reference(&self, tier: Tier) -> Ready {
        self.at_level(Way::BruteForce, tier, Level::best())
    }

    fn engine(&self, kind: Kind, (way, tier, level): (Way, Tier, Level)) -> Engine {
        let is_brute_force = way == Way::BruteForce;
        let is_reference = is_brute_force && level.name() == Level::best().name();
        let promise = match tier {
            // A structure may lose the false hits of these forms.
            Tier::Fast | Tier::Geometric if !is_brute_force => {
                Promise::SameButFalseHits(self.reference(tier))
            }
            _ if !is_reference => Promise::SameBits(self.reference(tier)),
            Tier::Exact => Promise::Near(0.0, 0),
            _ if !self.scene.is_small => Promise::Nothing,
            Tier::Geometric if self.scene.has_ground() => Promise::GEOMETRIC_ON_GROUND,
            Tier::Fast | Tier::Geometric => Promise::TEXTBOOK,
            // Before the tier takes to two-term arithmetic, the discriminant may cancel to a 32nd of its terms, and the
            // root to an 8th of half the chord. Then 6 u of the terms (u = 2^-24) are 96 u of half the chord, and 768 u
            // of the root.
            Tier::Stable if self.scene.has_ground() => Promise::Near(0.0, 768),
            // Grazing rays lose a few bits of t.
            Tier::Stable => Promise::Near(0.0, 64),
            other => unreachable!("no promise of {other:?}"),
        };
        let most_rays = match (way, kind) {
            _ if is_brute_force => TESTS / self.scene.spheres.len().max(1),
            (Way::RayByRay, Kind::Primary) => SOME_RAYS,
            // Rays that have nothing in common gain nothing as packets.
            (Way::Packets, Kind::Diffuse) => 0,
            _ => usize::MAX,
        };
        let label = Label { way: way.as_str(), name: tier.as_str(), lanes: level.name().as_str() };
        Engine { label, promise, most_rays, ready: self.at_level(way, tier, level) }
    }

    fn in_lanes<L: Lanes<Token = (), Array: 'static> + 'static>(&self, tier: Tier) -> Ready {
        let tree = Rc::clone(&self.tree);
        Box::new(move |rays| {
            let tree = Rc::clone(&tree);
            let search = move |query, blocks: &mut Blocks<'_, L::Array>| {
                blocks.each(|rays, hits, occluded| match query {
                    Query::ClosestHit => {
                        tree.list().closest_hit_lanes::<L>(tier, (), &mut Trace::new(), rays, hits);
                    }
                    Query::AnyHit => {
                        tree.list().any_hit_lanes::<L>(tier, (), &mut Trace::new(), rays, occluded);
                    }
                });
            };
            let packets = rays.list.chunks(L::COUNT).map(RayPacket::new).collect();
            Box::new(InPackets::new(packets, rays.list.len(), BLOCK, search, Rc::default()))
        })
    }

    fn at_level(&self, way: Way, tier: Tier, level: Level) -> Ready {
        let (tree, memory) = (Rc::clone(&self.tree), Rc::clone(&self.memory));
        Box::new(move |rays| {
            let (tree, viewpoint) = (Rc::clone(&tree), viewpoint(&rays.list));
            let (mut depth_list, mut scratch) = (Vec::new(), Vec::new());
            let (mut stream, mut queues) = (Vec::new(), Vec::new());
            let search = move |query, blocks: &mut Blocks<'_>| {
                let (spheres, trace) = (tree.list().spheres(), Trace::new().at(level));
                let asked = (query, tier);
                match way {
                    Way::RayByRay => answer(&*tree, trace.incoherent(), asked, blocks),
                    Way::Packets => answer(&*tree, trace.coherent(), asked, blocks),
                    Way::Stream => {
                        stream.resize(STREAM, StreamRay::EMPTY);
                        queues.resize(STREAM * QUEUES, QueuedRay::EMPTY);
                        let memory = StreamMemory::new(&mut stream, &mut queues);
                        let memory = memory.expect("enough memory").everywhere();
                        answer(&*tree, trace.incoherent().with_stream(memory), asked, blocks);
                    }
                    Way::DepthList => {
                        let viewpoint = viewpoint.expect("rays with a viewpoint");
                        depth_list.resize(DepthList::needed(spheres.len()), 0.0);
                        scratch.resize(DepthList::scratch(spheres.len()), 0.0);
                        let list =
                            blocks.once(|| DepthList::sort(spheres, viewpoint, &mut depth_list));
                        let trace = trace.with_scratch(&mut scratch);
                        answer(&list.expect("enough memory"), trace, asked, blocks);
                    }
                    Way::BruteForce => answer(&spheres, trace, asked, blocks),
                }
            };
            let (packets, memory) = (rays.packets(), Rc::clone(&memory));
            Box::new(InPackets::new(packets, rays.list.len(), way.block(), search, memory))
        })
    }
}

fn answer(
    structure: &impl Intersect,
    mut trace: Trace<'_>,
    (query, tier): (Query, Tier),
    blocks: &mut Blocks<'_>,
) {
    blocks.each(|rays, hits, occluded| match query {
        Query::ClosestHit => structure.closest_hit_packets(tier, &mut trace, rays, hits),
        Query::AnyHit => structure.any_hit_packets(tier, &mut trace, rays, occluded),
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::checked;
    use spherule_tests::scenes::small;
    use std::panic::{AssertUnwindSafe, catch_unwind};

    /// In a native build, too.
    #[test]
    fn every_level_is_there_once() {
        let names: Vec<_> = levels().into_iter().map(Level::name).collect();
        assert!(names.is_sorted_by(|better, worse| better > worse), "{names:?}");
        assert_eq!(names[0], Level::best().name());
    }

    /// An engine that is honest leaves the truth in the memory that all share.
    #[test]
    fn an_engine_that_writes_nothing_is_seen() {
        let scene = small::cube("64", 64);
        for kind in Kind::ALL {
            let kernel = Kernel::new(&scene, &scene.tree());
            let honest = kernel.ways(kind, &levels()[..1], &Tier::ALL);
            let all: Vec<_> = honest.iter().collect();
            let passes = |engines: &[&Engine]| {
                let truth = kernel.truth();
                let check = || drop(checked((&scene, kind), engines, &truth, usize::MAX));
                catch_unwind(AssertUnwindSafe(check)).is_ok()
            };
            assert!(passes(&all));
            for engine in kernel.ways(kind, &levels()[..1], &Tier::ALL) {
                let memory = Rc::clone(&kernel.memory);
                let ready: Ready = Box::new(move |rays| {
                    let search = |_, _: &mut Blocks<'_>| {};
                    let (packets, memory) = (rays.packets(), Rc::clone(&memory));
                    Box::new(InPackets::new(packets, rays.list.len(), BLOCK, search, memory))
                });
                let name = engine.label.to_string();
                assert!(!passes(&[&Engine { ready, ..engine }]), "{name}");
            }
        }
    }
}
