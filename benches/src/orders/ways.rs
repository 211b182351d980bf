//! The ways in which a caller can have rays traced, whatever their order.

use crate::engine::Query;
use crate::forms::{Answer, Forms, answer};
use crate::rounds::timed;
use spherule_kernel::{
    DepthList, Intersect, Level, QueuedRay, Ray, SphereTree, StreamMemory, StreamRay, Tier, Trace,
    Viewpoint,
};
use spherule_tests::scenes::viewpoint;

/// The tier of a user who chooses none.
pub(super) const TIER: Tier = Tier::Exact;
/// How many rays a stream has memory for.
const STREAM: usize = 8192;
/// Places in queues for each ray: with so many no queue is cut short.
const QUEUES: usize = 64;
/// The most spheres of a depth list.
const DEPTH_LIST: usize = 20_000;

/// A way to the hits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Way {
    /// Slices, with nothing said about the rays.
    Plain,
    /// Slices, said to be incoherent: the other ways are held to its answers.
    RayByRay,
    Coherent,
    Packets,
    IncoherentPackets,
    Stream,
    /// A list that is sorted anew in every run.
    DepthList,
}

impl Way {
    /// All ways, ray by ray first.
    pub(crate) const ALL: [Self; 7] = [
        Self::RayByRay,
        Self::IncoherentPackets,
        Self::Stream,
        Self::Packets,
        Self::DepthList,
        Self::Coherent,
        Self::Plain,
    ];

    /// The ways that go through spheres differently.
    pub(crate) const TRAVERSALS: [Self; 4] =
        [Self::RayByRay, Self::Stream, Self::Coherent, Self::DepthList];

    /// Which of [`Self::TRAVERSALS`] the way takes; `None` for the plain call, which chooses
    /// itself.
    pub(super) const fn traversal(self) -> Option<Self> {
        match self {
            Self::Plain => None,
            Self::IncoherentPackets => Some(Self::RayByRay),
            Self::Packets => Some(Self::Coherent),
            _ => Some(self),
        }
    }

    /// The name in tables.
    pub(crate) const fn as_str(self) -> &'static str {
        match self {
            Self::Plain => "plain",
            Self::RayByRay => "ray by ray",
            Self::Coherent => "coherent",
            Self::Packets => "packets",
            Self::IncoherentPackets => "incoherent packets",
            Self::Stream => "streams",
            Self::DepthList => "depth list",
        }
    }

    /// Whether the way is meant for these rays.
    pub(super) fn is_for(self, work: &Work<'_>) -> bool {
        match self {
            Self::DepthList => work.viewpoint.is_some() && work.spheres() < DEPTH_LIST,
            _ => true,
        }
    }
}

/// Rays, and memory for every way.
pub(super) struct Work<'a> {
    tree: &'a SphereTree,
    forms: Forms,
    viewpoint: Option<Viewpoint>,
    stream: Vec<StreamRay>,
    queues: Vec<QueuedRay>,
    depth_list: Vec<f32>,
    scratch: Vec<f32>,
}

impl<'a> Work<'a> {
    /// Memory without rays.
    pub(super) fn new(tree: &'a SphereTree) -> Self {
        Self {
            tree,
            forms: Forms::new(Vec::new()),
            viewpoint: None,
            stream: vec![StreamRay::EMPTY; STREAM],
            queues: vec![QueuedRay::EMPTY; STREAM * QUEUES],
            depth_list: Vec::new(),
            scratch: Vec::new(),
        }
    }

    /// Replaces the rays.
    pub(super) fn take(&mut self, rays: Vec<Ray>) {
        self.viewpoint = viewpoint(&rays);
        self.forms = Forms::new(rays);
        if Way::DepthList.is_for(self) {
            let spheres = self.spheres();
            self.depth_list.resize(DepthList::needed(spheres), 0.0);
            self.scratch.resize(DepthList::scratch(spheres), 0.0);
        }
    }

    pub(super) fn rays(&self) -> &[Ray] {
        &self.forms.rays
    }

    pub(super) fn spheres(&self) -> usize {
        self.tree.list().spheres().len()
    }

    /// Answers every ray. Returns how many nanoseconds it took.
    pub(super) fn run(&mut self, way: Way, level: Level, query: Query) -> f64 {
        let Self { tree, forms, viewpoint, stream, queues, depth_list, scratch } = self;
        let (tree, trace) = (*tree, Trace::new().at(level));
        match way {
            Way::Plain => in_slices(tree, forms, trace, query),
            Way::RayByRay => in_slices(tree, forms, trace.incoherent(), query),
            Way::Coherent => in_slices(tree, forms, trace.coherent(), query),
            Way::Packets => in_packets(tree, forms, trace, query),
            Way::IncoherentPackets => in_packets(tree, forms, trace.incoherent(), query),
            Way::Stream => {
                let memory = StreamMemory::new(stream, queues).expect("enough memory");
                let trace = trace.incoherent().with_stream(memory.everywhere());
                in_packets(tree, forms, trace, query)
            }
            Way::DepthList => {
                let viewpoint = viewpoint.expect("rays with a viewpoint");
                let (spheres, memory) = (tree.list().spheres(), &mut depth_list[..]);
                let mut list = None;
                let sorting = timed(|| list = DepthList::sort(spheres, viewpoint, memory).ok());
                let list = list.expect("enough memory");
                sorting + in_packets(&list, forms, trace.with_scratch(scratch), query)
            }
        }
    }

    /// What the last run in this way answered.
    pub(super) fn answers(&self, way: Way, query: Query) -> Vec<Answer> {
        match way {
            Way::Plain | Way::RayByRay | Way::Coherent => self.forms.of_slices(query),
            _ => self.forms.of_packets(query),
        }
    }

    /// Overwrites the answers with wrong ones, so that a run that writes none is seen.
    pub(super) fn forget(&mut self) {
        self.forms.forget();
    }

    /// Returns the answers of ray by ray.
    ///
    /// # Panics
    /// If brute force has other answers for the first `few` rays.
    pub(super) fn checked(
        &mut self,
        (level, query): (Level, Query),
        few: usize,
        name: &str,
    ) -> Vec<Answer> {
        self.forget();
        self.run(Way::RayByRay, level, query);
        let answers = self.answers(Way::RayByRay, query);
        let (rays, list) = (&self.rays()[..few.min(self.rays().len())], self.tree.list());
        let mut hits = vec![None; rays.len()];
        list.closest_hits_with(TIER, &mut Trace::new().at(level), rays, &mut hits);
        let is_same = hits.iter().zip(&answers).all(|(&hit, found)| match query {
            Query::ClosestHit => answer(hit) == *found,
            Query::AnyHit => hit.is_some() == found.is_some(),
        });
        assert!(is_same, "{name}: ray by ray differs from brute force");
        answers
    }
}

/// The nanoseconds of one call of slices.
fn in_slices(tree: &SphereTree, forms: &mut Forms, mut trace: Trace<'_>, query: Query) -> f64 {
    let Forms { rays, hits, occluded, .. } = forms;
    timed(|| match query {
        Query::ClosestHit => tree.closest_hits_with(TIER, &mut trace, rays, hits),
        Query::AnyHit => tree.any_hits_with(TIER, &mut trace, rays, occluded),
    })
}

/// The nanoseconds of one call of packets.
fn in_packets(
    structure: &impl Intersect,
    forms: &mut Forms,
    mut trace: Trace<'_>,
    query: Query,
) -> f64 {
    let Forms { packets, packet_hits, packets_occluded, .. } = forms;
    let trace = &mut trace;
    timed(|| match query {
        Query::ClosestHit => structure.closest_hit_packets(TIER, trace, packets, packet_hits),
        Query::AnyHit => structure.any_hit_packets(TIER, trace, packets, packets_occluded),
    })
}
