//! The table of variants: tier, structure and layer of the door, each as a plain function from rays to answers, so
//! that a test says "all of them" in one loop, and that each is compiled once, here.
//!
//! `Exact` gives the same bits in all of them, `Stable` in its domain; `Fast` and `Geometric` in all lists of
//! spheres, while depth list and tree may lose false hits of them.

use super::refitted;
use spherule_kernel::{
    Bvh4, Coherence, DepthList, Hit, HitColumns, HitPacket, Intersect, LaneArray, Lanes, Level,
    LevelName, QueuedRay, Ray, RayColumns, RayPacket, Sphere, SphereList, SpherePacket, SphereTree,
    StreamMemory, StreamRay, Tier, Trace, Vec3, Viewpoint, f32x4, f32x8, f32x16, pair_lanes,
};

/// What holds the spheres.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Structure {
    /// The spheres in their order.
    List,
    /// The spheres by depth, with this part of the scratch memory that a trace can use, in sevenths.
    DepthList(usize),
    /// A tree, and what is said of its rays.
    Tree(Coherence),
    /// A tree that was built over other spheres, of which some were none, larger or the same, and refitted.
    Refitted(Coherence),
    /// A tree whose rays go as a stream, with memory for so many at a time, and to sort so many.
    Stream(usize, usize),
    /// The tree of one lane, of as many spheres as it holds.
    Bvh4,
}

/// How rays come to the door, and in which lanes they go on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layer {
    /// One ray a call.
    Ray,
    /// A slice of rays, and nothing said of them.
    Slice,
    /// Columns of rays, not all of a length, and nothing said of them.
    Columns,
    /// A slice of rays at a level.
    SliceAt(LevelName),
    /// Packets of sixteen at a level.
    Packets(LevelName),
    /// Packets of the caller's own vectors: of 1, 4, 8 or 16 lanes.
    Lanes(usize),
}

impl Layer {
    /// How many rays may share a packet.
    #[must_use]
    pub const fn lanes(self) -> usize {
        match self {
            Self::Ray => 1,
            Self::Slice | Self::Columns | Self::SliceAt(_) | Self::Packets(_) => 16,
            Self::Lanes(lanes) => lanes,
        }
    }
}

/// How many spheres the tree of one lane holds.
const MOST_OF_BVH4: usize = 65_536;

/// A row of the table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Variant {
    /// The tier.
    pub tier: Tier,
    /// The structure.
    pub structure: Structure,
    /// The layer.
    pub layer: Layer,
}

/// The levels that this CPU has.
pub fn levels() -> impl Iterator<Item = LevelName> {
    LevelName::ALL.into_iter().filter(|&name| Level::named(name).is_some())
}

/// The whole table: of a list every lane width; of the larger structures, whose source is the same in every width,
/// two.
pub fn variants() -> impl Iterator<Item = Variant> {
    let of = |structure, layers: Vec<Layer>| {
        let variant = move |tier| {
            let layers = layers.clone().into_iter();
            layers.map(move |layer| Variant { tier, structure, layer })
        };
        Tier::ALL.into_iter().flat_map(variant)
    };
    let plain = [Layer::Ray, Layer::Slice, Layer::Columns];
    let leveled = || {
        let packets = levels().map(Layer::Packets);
        [Layer::SliceAt(LevelName::Baseline)].into_iter().chain(packets)
    };
    let all = |lanes: &[usize]| {
        let lanes = lanes.iter().copied().map(Layer::Lanes);
        leveled().chain(lanes).collect::<Vec<_>>()
    };
    of(Structure::List, [plain.to_vec(), all(&[1, 4, 8, 16])].concat())
        .chain(of(Structure::DepthList(0), plain.to_vec()))
        .chain(of(Structure::DepthList(7), all(&[1, 8])))
        .chain(of(Structure::DepthList(1), vec![Layer::Packets(Level::best().name())]))
        .chain(of(Structure::Tree(Coherence::Detect), plain.to_vec()))
        .chain(of(Structure::Tree(Coherence::Coherent), all(&[1, 8])))
        .chain(of(Structure::Tree(Coherence::Incoherent), all(&[1, 8])))
        .chain(of(Structure::Refitted(Coherence::Detect), vec![Layer::Slice, Layer::Lanes(1)]))
        .chain(of(
            Structure::Refitted(Coherence::Incoherent),
            levels().map(Layer::Packets).collect(),
        ))
        .chain(of(Structure::Stream(1024, 0), all(&[1, 8])))
        .chain(of(Structure::Stream(16, 0), vec![Layer::Packets(Level::best().name())]))
        .chain(of(Structure::Stream(32, 100), all(&[8])))
        .chain(of(
            Structure::Bvh4,
            [plain.to_vec(), vec![Layer::Lanes(1), Layer::Lanes(8)]].concat(),
        ))
}

/// The variants of lists that have loops of their own: rays and slices of them go through packets.
pub fn lists() -> impl Iterator<Item = Variant> {
    let packed = |layer| matches!(layer, Layer::Packets(_) | Layer::Lanes(_));
    variants().filter(move |v| v.structure == Structure::List && packed(v.layer))
}

/// The readable form of a tier: a list, one lane.
#[must_use]
pub const fn reference(tier: Tier) -> Variant {
    Variant { tier, structure: Structure::List, layer: Layer::Lanes(1) }
}

/// Brute force for large scenes: a list, sixteen lanes.
#[must_use]
pub const fn brute(tier: Tier) -> Variant {
    Variant { tier, structure: Structure::List, layer: Layer::Lanes(16) }
}

/// Spheres, and memory for every structure of them.
#[derive(Clone, Debug)]
pub struct Memory {
    tree: SphereTree,
    refitted: SphereTree,
    list: SphereList,
    words: Vec<f32>,
    /// Nothing where there are more spheres than it holds.
    bvh4: Vec<u32>,
}

/// The same spheres in every structure.
#[derive(Clone, Copy, Debug)]
pub struct Structures<'a> {
    /// The list.
    pub list: &'a SphereList,
    /// The depth list.
    pub depth_list: &'a DepthList<'a>,
    /// The tree.
    pub tree: &'a SphereTree,
    /// A tree that was built over other spheres, and refitted.
    pub refitted: &'a SphereTree,
    /// The tree of one lane, loaded from what was built.
    pub bvh4: Option<Bvh4<'a>>,
}

impl Memory {
    /// A list and trees of these spheres, and memory for a depth list.
    ///
    /// # Panics
    /// Never: the memory is enough.
    #[must_use]
    pub fn new(spheres: &[Sphere]) -> Self {
        let list = SphereList::from(spheres);
        let words = vec![f32::NAN; DepthList::needed(spheres.len())];
        let count = if spheres.len() > MOST_OF_BVH4 { 0 } else { Bvh4::needed(spheres.len()) };
        let mut bvh4 = vec![u32::MAX; count];
        if count > 0 {
            Bvh4::build(list.spheres(), &mut bvh4).expect("enough memory");
        }
        let (tree, refitted) = (SphereTree::new(list.clone()), refitted::tree(spheres));
        Self { tree, refitted, list, words, bvh4 }
    }

    /// Calls `ask` with every structure, the depth list sorted from `viewpoint`.
    ///
    /// # Panics
    /// Never: the memory is enough.
    pub fn sorted<R>(&mut self, viewpoint: Viewpoint, ask: impl FnOnce(Structures<'_>) -> R) -> R {
        let Self { tree, refitted, list, words, bvh4 } = self;
        let depth_list = &DepthList::sort(list.spheres(), viewpoint, words).expect("enough memory");
        let load = || Bvh4::load(list.spheres(), bvh4).expect("what was built");
        let bvh4 = (!bvh4.is_empty()).then(load);
        ask(Structures { list, depth_list, tree, refitted, bvh4 })
    }
}

/// What rays hit.
#[derive(Clone, Debug)]
pub struct Answers {
    /// The closest hit of each ray.
    pub hits: Vec<Option<Hit>>,
    /// Whether each ray hits anything.
    pub met: Vec<bool>,
}

impl Variant {
    /// Whether the structure can hold so many spheres.
    #[must_use]
    pub fn holds(&self, count: usize) -> bool {
        self.structure != Structure::Bvh4 || count <= MOST_OF_BVH4
    }

    /// What these rays hit.
    ///
    /// # Panics
    /// Where the structure does not [hold](Variant::holds) the spheres.
    #[must_use]
    pub fn ask(&self, structures: Structures<'_>, rays: &[Ray]) -> Answers {
        let Structures { list, depth_list, tree, refitted, bvh4 } = structures;
        match self.structure {
            Structure::List => self.ask_list(list, rays),
            Structure::DepthList(sevenths) => {
                let words = DepthList::scratch(list.spheres().len()) * sevenths / 7;
                let mut scratch = vec![f32::NAN; words];
                self.ask_of(depth_list, Trace::new().with_scratch(&mut scratch), rays)
            }
            Structure::Tree(coherence) => self.ask_of(tree, Trace::new().with(coherence), rays),
            Structure::Refitted(coherence) => {
                self.ask_of(refitted, Trace::new().with(coherence), rays)
            }
            Structure::Stream(count, sorted) => {
                // The least that queues need for few, and for more what they like to have.
                let needed = StreamMemory::queues_needed(count);
                let queues = if count < 100 { needed } else { needed + 32 * count };
                let (mut queues, mut order) = (vec![QueuedRay::EMPTY; queues], vec![0; 2 * sorted]);
                let mut memory = vec![StreamRay::EMPTY; count];
                let memory = StreamMemory::new(&mut memory, &mut queues).expect("enough");
                let memory = memory.sorting(&mut order).everywhere();
                self.ask_of(tree, Trace::new().incoherent().with_stream(memory), rays)
            }
            Structure::Bvh4 => {
                self.ask_of(&bvh4.expect("no more spheres than it holds"), Trace::new(), rays)
            }
        }
    }

    /// The closest hits in a list, whatever the structure.
    ///
    /// # Panics
    /// If a ray that hits anything has no closest hit, or the reverse.
    #[must_use]
    pub fn closest(&self, spheres: &[Sphere], rays: &[Ray]) -> Vec<Option<Hit>> {
        let Answers { hits, met } = self.ask_list(&SphereList::from(spheres), rays);
        assert!(hits.iter().map(Option::is_some).eq(met), "{self:?}: closest hits and any hits");
        hits
    }

    fn ask_list(&self, list: &SphereList, rays: &[Ray]) -> Answers {
        match self.layer {
            Layer::Lanes(4) => self.lanes::<_, f32x4>(list, Trace::new(), rays),
            Layer::Lanes(16) => self.lanes::<_, f32x16>(list, Trace::new(), rays),
            _ => self.ask_of(list, Trace::new(), rays),
        }
    }

    fn ask_of(&self, structure: &impl Intersect, mut trace: Trace<'_>, rays: &[Ray]) -> Answers {
        let tier = self.tier;
        // What was there before must not show; nothing past the rays is touched.
        let stale = Some(Hit { t: -7.0, sphere: 7 });
        let mut hits = vec![stale; rays.len() + 1];
        let mut met: Vec<bool> = (0..=rays.len()).map(|i| i % 3 == 0).collect();
        let past = met[rays.len()];
        match self.layer {
            Layer::Ray => {
                for (index, ray) in rays.iter().enumerate() {
                    hits[index] = structure.closest_hit(tier, ray);
                    met[index] = structure.any_hit(tier, ray);
                }
            }
            Layer::Slice => {
                structure.closest_hits(tier, rays, &mut hits);
                structure.any_hits(tier, rays, &mut met);
            }
            Layer::Columns => {
                let table = columns_of(rays);
                let [ox, oy, oz, dx, dy, dz, t_min, t_max] = table.each_ref().map(Vec::as_slice);
                let (origin, direction) = ([ox, oy, oz], [dx, dy, dz]);
                let columns = RayColumns { origin, direction, t_min, t_max };
                let (mut t, mut sphere) = (vec![-7.0; rays.len() + 2], vec![7; rays.len() + 1]);
                let found = HitColumns { t: &mut t, sphere: &mut sphere };
                structure.closest_hit_columns(tier, &mut trace, columns, found);
                structure.any_hit_columns(tier, &mut trace, columns, &mut met);
                let none = |t: f32, sphere: u32| sphere == u32::MAX && t == f32::INFINITY;
                let hit = |(&t, &sphere)| (!none(t, sphere)).then_some(Hit { t, sphere });
                hits = t.iter().zip(&sphere).map(hit).collect();
                assert_eq!(t.last(), Some(&-7.0), "{self:?}: past the rays");
            }
            Layer::SliceAt(name) => {
                trace.level = level(name);
                structure.closest_hits_with(tier, &mut trace, rays, &mut hits);
                structure.any_hits_with(tier, &mut trace, rays, &mut met);
            }
            Layer::Packets(name) => {
                trace.level = level(name);
                let packets = packed(rays);
                let mut found = vec![stale_packet::<f32x16>(); packets.len() + 1];
                let mut bits = vec![u32::MAX; packets.len() + 1];
                structure.closest_hit_packets(tier, &mut trace, &packets, &mut found);
                structure.any_hit_packets(tier, &mut trace, &packets, &mut bits);
                return unpacked::<f32x16>(rays.len(), &found, &bits);
            }
            Layer::Lanes(1) => return self.lanes::<_, f32>(structure, trace, rays),
            Layer::Lanes(_) => return self.lanes::<_, f32x8>(structure, trace, rays),
        }
        assert_eq!((hits.pop(), met.pop()), (Some(stale), Some(past)), "{self:?}: past the rays");
        Answers { hits, met }
    }

    fn lanes<S: Intersect, L: Lanes<Token = ()>>(
        &self,
        structure: &S,
        mut trace: Trace<'_>,
        rays: &[Ray],
    ) -> Answers {
        let packets = packed(rays);
        let mut found = vec![stale_packet::<L>(); packets.len() + 1];
        let mut bits = vec![u32::MAX; packets.len() + 1];
        structure.closest_hit_lanes::<L>(self.tier, (), &mut trace, &packets, &mut found);
        structure.any_hit_lanes::<L>(self.tier, (), &mut trace, &packets, &mut bits);
        unpacked::<L>(rays.len(), &found, &bits)
    }
}

/// The first ray's origin.
#[must_use]
pub fn viewpoint_of(rays: &[Ray]) -> Viewpoint {
    Viewpoint::Origin(rays.first().map_or(Vec3::ZERO, |ray| ray.origin))
}

pub(super) fn level(name: LevelName) -> Level {
    Level::named(name).expect("a level of this CPU")
}

/// The numbers of rays, column by column; some columns are longer.
fn columns_of(rays: &[Ray]) -> [Vec<f32>; 8] {
    let numbers = |r: &Ray| {
        let ([ox, oy, oz], [dx, dy, dz]) = (r.origin.to_array(), r.direction.to_array());
        [ox, oy, oz, dx, dy, dz, r.t_min, r.t_max]
    };
    std::array::from_fn(|column| {
        let longer = [0.5].repeat(column % 3);
        rays.iter().map(|ray| numbers(ray)[column]).chain(longer).collect()
    })
}

pub(super) fn packed<A: LaneArray>(rays: &[Ray]) -> Vec<RayPacket<A>> {
    rays.chunks(A::COUNT).map(RayPacket::new).collect()
}

/// The answers to `count` rays, and a packet more that was left alone.
fn unpacked<L: Lanes<Token = ()>>(
    count: usize,
    found: &[HitPacket<L::Array>],
    bits: &[u32],
) -> Answers {
    let past = count.div_ceil(L::COUNT);
    assert!(found[past].hits().eq(stale_packet::<L>().hits()) && bits[past] == u32::MAX);
    Answers {
        hits: found.iter().flat_map(HitPacket::hits).take(count).collect(),
        met: (0..count).map(|ray| bits[ray / L::COUNT] >> (ray % L::COUNT) & 1 == 1).collect(),
    }
}

/// A packet that is full of hits.
pub(super) fn stale_packet<L: Lanes<Token = ()>>() -> HitPacket<L::Array> {
    let ray = Ray::new(Vec3::new(0.0, 0.0, -3.0), Vec3::Z);
    let sphere = Sphere { center: Vec3::ZERO, radius: 1.0 };
    let (rays, spheres) = (RayPacket::new(&[ray; 16]), SpherePacket::new(&[sphere; 16]));
    pair_lanes::<L>(Tier::Fast, (), &rays, &spheres)
}
