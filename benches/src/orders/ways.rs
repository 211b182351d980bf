//! The ways in which a caller can have rays traced, whatever their order.
//!
//! Only this module of the report names what the kernel offers.

use crate::engine::{EVERY_SECOND, Query};
use crate::rounds::timed;
use spherule_kernel::{
    DepthList, Hit, HitPacket, Intersect, Level, QueuedRay, Ray, RayPacket, SphereTree,
    StreamMemory, StreamRay, Tier, Trace, Viewpoint,
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
            Self::DepthList => {
                work.viewpoint.is_some() && work.tree.list().spheres().len() < DEPTH_LIST
            }
            _ => true,
        }
    }
}

/// Rays, in slices and in packets, and memory for their answers and for every way.
pub(super) struct Work<'a> {
    tree: &'a SphereTree,
    pub(super) rays: Vec<Ray>,
    viewpoint: Option<Viewpoint>,
    packets: Vec<RayPacket>,
    hits: Vec<Option<Hit>>,
    occluded: Vec<bool>,
    packet_hits: Vec<HitPacket>,
    packets_occluded: Vec<u32>,
    stream: Vec<StreamRay>,
    queues: Vec<QueuedRay>,
    depth_list: Vec<f32>,
    scratch: Vec<f32>,
}

/// What each ray hits; for any hit, whether it hits.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Answers {
    Closest(Vec<Option<(u32, u32)>>),
    Any(Vec<bool>),
}

impl<'a> Work<'a> {
    /// Memory without rays.
    pub(super) fn new(tree: &'a SphereTree) -> Self {
        Self {
            tree,
            rays: Vec::new(),
            viewpoint: None,
            packets: Vec::new(),
            hits: Vec::new(),
            occluded: Vec::new(),
            packet_hits: Vec::new(),
            packets_occluded: Vec::new(),
            stream: vec![StreamRay::EMPTY; STREAM],
            queues: vec![QueuedRay::EMPTY; STREAM * QUEUES],
            depth_list: Vec::new(),
            scratch: Vec::new(),
        }
    }

    /// Replaces the rays.
    pub(super) fn take(&mut self, rays: Vec<Ray>) {
        self.packets = rays.chunks(RayPacket::COUNT).map(RayPacket::new).collect();
        self.viewpoint = viewpoint(&rays);
        self.hits.resize(rays.len(), None);
        self.occluded.resize(rays.len(), false);
        self.packet_hits.resize(self.packets.len(), HitPacket::none());
        self.packets_occluded.resize(self.packets.len(), 0);
        self.rays = rays;
        if Way::DepthList.is_for(self) {
            let spheres = self.tree.list().spheres().len();
            self.depth_list.resize(DepthList::needed(spheres), 0.0);
            self.scratch.resize(DepthList::scratch(spheres), 0.0);
        }
    }

    /// Answers every ray. Returns how many nanoseconds it took.
    pub(super) fn run(&mut self, way: Way, level: Level, query: Query) -> f64 {
        let tree = self.tree;
        let trace = Trace::new().at(level);
        match way {
            Way::Plain => self.slices(trace, query),
            Way::RayByRay => self.slices(trace.incoherent(), query),
            Way::Coherent => self.slices(trace.coherent(), query),
            Way::Packets => self.in_packets(tree, trace, query),
            Way::IncoherentPackets => self.in_packets(tree, trace.incoherent(), query),
            Way::Stream => {
                let mut stream = std::mem::take(&mut self.stream);
                let mut queues = std::mem::take(&mut self.queues);
                let memory = StreamMemory::new(&mut stream, &mut queues).expect("enough memory");
                let trace = trace.incoherent().with_stream(memory.everywhere());
                let time = self.in_packets(tree, trace, query);
                (self.stream, self.queues) = (stream, queues);
                time
            }
            Way::DepthList => {
                let spheres = tree.list().spheres();
                let viewpoint = self.viewpoint.expect("rays with a viewpoint");
                let mut memory = std::mem::take(&mut self.depth_list);
                let mut scratch = std::mem::take(&mut self.scratch);
                let mut list = None;
                let mut time = timed(|| {
                    list = DepthList::sort(spheres, viewpoint, &mut memory).ok();
                });
                let list = list.expect("enough memory");
                time += self.in_packets(&list, trace.with_scratch(&mut scratch), query);
                (self.depth_list, self.scratch) = (memory, scratch);
                time
            }
        }
    }

    fn slices(&mut self, mut trace: Trace<'_>, query: Query) -> f64 {
        let Self { tree, rays, hits, occluded, .. } = self;
        timed(|| match query {
            Query::ClosestHit => tree.closest_hits_with(TIER, &mut trace, rays, hits),
            Query::AnyHit => tree.any_hits_with(TIER, &mut trace, rays, occluded),
        })
    }

    /// Traces packets. With the clock stopped, copies the answers to where slices leave theirs.
    fn in_packets(
        &mut self,
        structure: &impl Intersect,
        mut trace: Trace<'_>,
        query: Query,
    ) -> f64 {
        let Self { packets, packet_hits, packets_occluded, .. } = &mut *self;
        let trace = &mut trace;
        let time = timed(|| match query {
            Query::ClosestHit => structure.closest_hit_packets(TIER, trace, packets, packet_hits),
            Query::AnyHit => structure.any_hit_packets(TIER, trace, packets, packets_occluded),
        });
        for index in 0..self.rays.len() {
            let (packet, lane) = (index / RayPacket::COUNT, index % RayPacket::COUNT);
            match query {
                Query::ClosestHit => self.hits[index] = self.packet_hits[packet].hit(lane),
                Query::AnyHit => {
                    self.occluded[index] = self.packets_occluded[packet] >> lane & 1 == 1;
                }
            }
        }
        time
    }

    /// The answers of the last run.
    pub(super) fn answers(&self, query: Query) -> Answers {
        match query {
            Query::ClosestHit => Answers::Closest(self.hits.iter().map(bits).collect()),
            Query::AnyHit => Answers::Any(self.occluded.clone()),
        }
    }

    /// Overwrites the answers with wrong ones, so that a run that writes none is seen. (Bits that are inverted are right again when they
    /// are inverted twice.)
    pub(super) fn forget(&mut self) {
        let wrong = Some(Hit { t: f32::NAN, sphere: u32::MAX });
        self.hits.fill(wrong);
        self.occluded.iter_mut().enumerate().for_each(|(ray, hit)| *hit = ray % 2 == 0);
        self.packet_hits.fill(HitPacket::none());
        self.packets_occluded.fill(EVERY_SECOND);
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
    ) -> Answers {
        self.forget();
        self.run(Way::RayByRay, level, query);
        let answers = self.answers(query);
        let (rays, list) = (&self.rays[..few.min(self.rays.len())], self.tree.list());
        let mut hits = vec![None; rays.len()];
        list.closest_hits_with(TIER, &mut Trace::new().at(level), rays, &mut hits);
        let is_same = match &answers {
            Answers::Closest(answers) => hits.iter().map(bits).eq(answers[..rays.len()].to_vec()),
            Answers::Any(occluded) => {
                hits.iter().map(Option::is_some).eq(occluded[..rays.len()].to_vec())
            }
        };
        assert!(is_same, "{name}: ray by ray differs from brute force");
        answers
    }

    pub(super) fn spheres(&self) -> usize {
        self.tree.list().spheres().len()
    }
}

/// A hit's t in bits, and its sphere.
fn bits(hit: &Option<Hit>) -> Option<(u32, u32)> {
    hit.map(|hit| (hit.t.to_bits(), hit.sphere))
}

impl Answers {
    /// Whether a ray hits anything.
    pub(super) fn is_hit(&self, ray: usize) -> bool {
        match self {
            Self::Closest(hits) => hits[ray].is_some(),
            Self::Any(occluded) => occluded[ray],
        }
    }
}
