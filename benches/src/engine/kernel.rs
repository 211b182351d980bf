//! The kernel: every tier in every way to the hits, at a level of instructions or in lanes of a fixed width.

use super::{Engine, Label, Promise, Query, Ready, Run, SOME_RAYS};
use spherule_kernel::{
    DepthList, Hit, HitPacket, Intersect, LaneArray, Lanes, Level, LevelName, RayPacket,
    SphereTree, Tier, Trace, f32x4, f32x8, f32x16,
};
use spherule_tests::scenes::{Kind, Scene, viewpoint};
use std::cell::RefCell;
use std::rc::Rc;

/// Tests of brute force that a sample may cost.
const TESTS: usize = 1 << 25;

/// A way to the hits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Way {
    /// Every ray against every sphere.
    BruteForce,
    RayByRay,
    Packets,
    /// Made anew for every pass over the rays.
    DepthList,
}

impl Way {
    pub(crate) const fn as_str(self) -> &'static str {
        match self {
            Self::BruteForce => "brute force",
            Self::RayByRay => "tree, ray by ray",
            Self::Packets => "tree, packets",
            Self::DepthList => "depth list",
        }
    }
}

/// The levels that the CPU has, the best first.
pub(crate) fn levels() -> Vec<Level> {
    LevelName::ALL.into_iter().rev().filter_map(Level::named).collect()
}

/// The engines of a scene.
pub(crate) struct Kernel<'a> {
    scene: &'a Scene,
    tree: Rc<SphereTree>,
    /// Shared by all that are compared: the same memory, as warm for each.
    answers: Rc<RefCell<Answers>>,
}

impl<'a> Kernel<'a> {
    pub(crate) fn new(scene: &'a Scene, tree: &Rc<SphereTree>) -> Self {
        Self { scene, tree: Rc::clone(tree), answers: Rc::default() }
    }

    /// What others are held to: `Exact` by the tree.
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
                let promise = self.like_brute_force(tier);
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
        // Diffuse rays have no viewpoint.
        let ways = [Way::BruteForce, Way::RayByRay, Way::Packets, Way::DepthList];
        let ways = &ways[..if kind == Kind::Primary { 4 } else { 3 }];
        let mut all = Vec::new();
        for (index, &level) in levels.iter().enumerate() {
            for &way in ways {
                let tiers = if index == 0 { tiers } else { &[Tier::Stable] };
                all.extend(tiers.iter().map(|&tier| self.engine(kind, (way, tier, level))));
            }
        }
        all
    }

    fn like_brute_force(&self, tier: Tier) -> Promise {
        Promise::SameBits(self.at_level(Way::BruteForce, tier, Level::best()))
    }

    fn engine(&self, kind: Kind, (way, tier, level): (Way, Tier, Level)) -> Engine {
        let is_brute_force = way == Way::BruteForce;
        let is_reference = is_brute_force && level.name() == Level::best().name();
        let promise = match tier {
            // They may lose false hits of their forms in a structure.
            Tier::Fast | Tier::Geometric if !is_brute_force => Promise::Nothing,
            _ if !is_reference => self.like_brute_force(tier),
            _ if !self.scene.is_small => Promise::Nothing,
            Tier::Geometric if self.scene.has_ground() => Promise::GEOMETRIC_ON_GROUND,
            Tier::Fast | Tier::Geometric => Promise::TEXTBOOK,
            // The discriminant may cancel to a 32nd of its terms and the root to an 8th of half the chord before the
            // tier reaches for two-term arithmetic: 6 u of the terms (u = 2^-24) are 96 u of half the chord, and 768 u
            // of the root.
            Tier::Stable if self.scene.has_ground() => Promise::Near(0.0, 768),
            // Grazing rays lose a few bits of t.
            Tier::Stable => Promise::Near(0.0, 64),
            Tier::Exact => Promise::Near(0.0, 0),
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
            let search = move |query, rays: &[_], (hits, met): &mut Answers<L::Array>| match query {
                Query::ClosestHit => {
                    tree.list().closest_hit_lanes::<L>(tier, (), &mut Trace::new(), rays, hits);
                }
                Query::AnyHit => {
                    tree.list().any_hit_lanes::<L>(tier, (), &mut Trace::new(), rays, met);
                }
            };
            let packets = rays.list.chunks(L::COUNT).map(RayPacket::new).collect();
            let (answers, count) = (Rc::default(), rays.list.len());
            Box::new(InPackets { packets, search, answers, count, any_hit: false })
        })
    }

    fn at_level(&self, way: Way, tier: Tier, level: Level) -> Ready {
        let (tree, answers) = (Rc::clone(&self.tree), Rc::clone(&self.answers));
        Box::new(move |rays| {
            let (tree, viewpoint) = (Rc::clone(&tree), viewpoint(&rays.list));
            let (mut depth_list, mut scratch) = (Vec::new(), Vec::new());
            let search = move |query, rays: &[RayPacket], (hits, met): &mut Answers| {
                let search = (query, tier, rays, &mut **hits, &mut **met);
                let (spheres, trace) = (tree.list().spheres(), Trace::new().at(level));
                match way {
                    Way::RayByRay => answer(&*tree, trace.incoherent(), search),
                    Way::Packets => answer(&*tree, trace.coherent(), search),
                    Way::DepthList => {
                        let viewpoint = viewpoint.expect("rays with a viewpoint");
                        depth_list.resize(DepthList::needed(spheres.len()), 0.0);
                        scratch.resize(DepthList::scratch(spheres.len()), 0.0);
                        let list = DepthList::sort(spheres, viewpoint, &mut depth_list);
                        let trace = trace.with_scratch(&mut scratch);
                        answer(&list.expect("enough memory"), trace, search);
                    }
                    _ => answer(&spheres, trace, search),
                }
            };
            let (packets, answers, count) = (rays.packets(), Rc::clone(&answers), rays.list.len());
            Box::new(InPackets { packets, search, answers, count, any_hit: false })
        })
    }
}

type Search<'a> = (Query, Tier, &'a [RayPacket], &'a mut [HitPacket], &'a mut [u32]);

fn answer(structure: &impl Intersect, mut trace: Trace<'_>, search: Search<'_>) {
    let (query, tier, rays, hits, met) = search;
    match query {
        Query::ClosestHit => structure.closest_hit_packets(tier, &mut trace, rays, hits),
        Query::AnyHit => structure.any_hit_packets(tier, &mut trace, rays, met),
    }
}

/// Hits, and bits of any hit.
type Answers<A = [f32; 16]> = (Vec<HitPacket<A>>, Vec<u32>);

/// Packets of rays, and what searches for their hits.
struct InPackets<A: LaneArray, S> {
    packets: Rc<[RayPacket<A>]>,
    search: S,
    answers: Rc<RefCell<Answers<A>>>,
    /// How many rays.
    count: usize,
    /// Whether the last run was for any hit.
    any_hit: bool,
}

impl<A: LaneArray, S: FnMut(Query, &[RayPacket<A>], &mut Answers<A>)> Run for InPackets<A, S> {
    fn run(&mut self, query: Query) {
        let answers = &mut *self.answers.borrow_mut();
        let count = answers.0.len().max(self.packets.len());
        answers.0.resize(count, HitPacket::none());
        answers.1.resize(count, 0);
        (self.search)(query, &self.packets, answers);
        self.any_hit = query == Query::AnyHit;
        std::hint::black_box(answers);
    }

    fn hits(&self) -> Vec<Option<Hit>> {
        let (hits, met) = &*self.answers.borrow();
        let hit = |ray: usize| {
            let (packet, lane) = (ray / A::COUNT, ray % A::COUNT);
            let met = || met[packet] >> lane & 1 == 1;
            let any = || met().then_some(Hit { t: 0.0, sphere: 0 });
            if self.any_hit { any() } else { hits[packet].hit(lane) }
        };
        (0..self.count).map(hit).collect()
    }
}
