//! The rows: tier, structure and layer.
//!
//! Iterators here are vectors: every test that walks a chain of adapters would compile it anew.

use spherule_kernel::{Coherence, Level, LevelName, Tier};
use std::vec::IntoIter;

/// What holds the spheres.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Structure {
    /// The spheres in their order.
    List,
    /// The spheres by depth. A trace can use this part of the scratch memory, in sevenths.
    DepthList(usize),
    /// A tree, and what the trace says of its rays.
    Tree(Coherence),
    /// A tree built over other spheres, some of them invalid, larger or equal, and then refitted.
    Refitted(Coherence),
    /// A tree whose rays go as a stream, with memory for so many at a time.
    Stream(usize),
    /// The tree of one lane, if it holds as many spheres.
    Bvh4,
}

/// How rays come to the door, and in which lanes they go on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layer {
    /// One ray a call.
    Ray,
    /// A slice of rays, with nothing said about them.
    Slice,
    /// Columns of rays, of different lengths, with nothing said about them.
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
pub fn levels() -> IntoIter<Level> {
    LevelName::ALL.into_iter().filter_map(Level::named).collect::<Vec<_>>().into_iter()
}

/// Packets of the caller's vectors in every width, packets at every level, and `other`.
pub(super) fn packet_layers(other: Option<Layer>) -> IntoIter<Layer> {
    let lanes = [1, 4, 8, 16].map(Layer::Lanes).into_iter();
    lanes.chain(leveled_packets()).chain(other).collect::<Vec<_>>().into_iter()
}

fn leveled_packets() -> Vec<Layer> {
    levels().map(|level| Layer::Packets(level.name())).collect()
}

/// The whole table. Lists have every lane width. The larger structures have two widths, since their source is the same
/// in every width.
pub fn variants() -> IntoIter<Variant> {
    let plain = vec![Layer::Ray, Layer::Slice, Layer::Columns];
    let packets = leveled_packets();
    let best = vec![Layer::Packets(Level::best().name())];
    let all = |lanes: &[usize]| -> Vec<Layer> {
        let leveled = [&[Layer::SliceAt(LevelName::Baseline)], packets.as_slice()].concat();
        leveled.into_iter().chain(lanes.iter().copied().map(Layer::Lanes)).collect()
    };
    let rows = [
        (Structure::List, [plain.clone(), all(&[1, 4, 8, 16])].concat()),
        (Structure::DepthList(0), plain.clone()),
        (Structure::DepthList(7), all(&[1, 8])),
        (Structure::DepthList(1), best.clone()),
        (Structure::Tree(Coherence::Detect), plain.clone()),
        (Structure::Tree(Coherence::Coherent), all(&[1, 8])),
        (Structure::Tree(Coherence::Incoherent), all(&[1, 8])),
        (Structure::Refitted(Coherence::Detect), vec![Layer::Ray, Layer::Slice, Layer::Lanes(1)]),
        (Structure::Refitted(Coherence::Incoherent), packets.clone()),
        (Structure::Stream(1024), all(&[1, 8])),
        (Structure::Stream(16), best),
        (Structure::Bvh4, [plain, vec![Layer::Lanes(1), Layer::Lanes(8)]].concat()),
    ];

    let mut table = Vec::new();
    for (structure, layers) in rows {
        for tier in Tier::ALL {
            table.extend(layers.iter().map(|&layer| Variant { tier, structure, layer }));
        }
    }
    table.into_iter()
}

/// The variants of lists with loops of their own: single rays and slices go through packets.
pub fn lists() -> IntoIter<Variant> {
    let packed = |layer| matches!(layer, Layer::Packets(_) | Layer::Lanes(_));
    let of_lists = |v: &Variant| v.structure == Structure::List && packed(v.layer);
    variants().filter(of_lists).collect::<Vec<_>>().into_iter()
}

/// The reference for a tier: a list, one lane.
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
    /// Whether the structure can hold `count` spheres.
    #[must_use]
    pub fn holds(&self, count: usize) -> bool {
        self.structure != Structure::Bvh4 || count <= MOST_OF_BVH4
    }
}
