//! The rows: tier, structure and layer.

use spherule_kernel::{Coherence, Level, LevelName, Tier};

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
    /// A tree whose rays go as a stream, with memory for so many at a time.
    Stream(usize),
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
pub(super) const MOST_OF_BVH4: usize = 65_536;

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
        .chain(of(
            Structure::Refitted(Coherence::Detect),
            vec![Layer::Ray, Layer::Slice, Layer::Lanes(1)],
        ))
        .chain(of(
            Structure::Refitted(Coherence::Incoherent),
            levels().map(Layer::Packets).collect(),
        ))
        .chain(of(Structure::Stream(1024), all(&[1, 8])))
        .chain(of(Structure::Stream(16), vec![Layer::Packets(Level::best().name())]))
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

impl Variant {
    /// Whether the structure can hold so many spheres.
    #[must_use]
    pub fn holds(&self, count: usize) -> bool {
        self.structure != Structure::Bvh4 || count <= MOST_OF_BVH4
    }
}
