//! Rays through the tree, each on its own way.
//!
//! # Method
//!
//! A ray keeps a stack of boxes that it has yet to look into, the nearest on top, each with the s
//! at which it is entered. A step takes one from the stack: a node's children are tested all at
//! once, and those that are met go onto the stack; a leaf's spheres are tested all at once, and
//! those that may be the nearest go onto a list. When a hit is surely nearer than what was known,
//! boxes entered later are dropped from the stack. When all rays of a packet are through, the tier is
//! asked about the lists (`bvh/resolve.rs`), which hold one sphere a ray, seldom more.
//!
//! Four rays are under way in turn, and step together: all take a box, all test, all push. Each
//! branch waits for a chain of some fifty cycles; so the chains overlap, and a wrong guess is
//! known early. (Round robin, one whole step a ray: no gain. Eight or sixteen rays: no more.)
//!
//! # The stack
//!
//! A step takes one entry and adds sixteen at most, so a ray on its way down a tree of nine
//! nodes, one below the other, has 15 * 9 + 1 = 136 at most, whatever its numbers are; 256 are
//! there, so that a mask can stand for a bounds check, and never acts. Spheres that are not in the
//! order of their s cost time, no memory: a full list is settled (`LIST`).

use super::bracket::{Probe, part_of};
use super::resolve::{List, settle, settle_one, settle_outside, take};
use super::slabs::{Slabs, raised};
use super::{Bvh, BvhLeaf, BvhNode, DEPTH, LEAF, NO_CHILD, WIDTH};
use crate::accuracy::RayLanes;
use crate::axes::axes;
use crate::intersect::lanes_of_bits;
use crate::{Accuracy, HitPacket, LaneMask, Lanes, RayPacket, Spheres};

/// The nearest hit of every ray: what [`nearest`](crate::nearest) returns, from a tree.
///
/// `hits[i]` is overwritten with what `rays[i]` meets; packets past the end of the shorter slice
/// are left alone. `spheres` is the list that `bvh` was built from; what happens with another
/// stands at [`Bvh`].
///
/// Domain and guarantee: see the [module](crate::bvh). Cost: by the logarithm of the number of
/// spheres, where they do not overlap much; rays that the bounds do not cover, and spheres above
/// 2^40, cost as without a tree. Stack: some 12 KiB.
#[inline(always)]
pub fn nearest<A: Accuracy, L: Lanes>(
    token: L::Token,
    rays: &[RayPacket<L>],
    spheres: Spheres<'_>,
    bvh: &Bvh<'_>,
    hits: &mut [HitPacket<L>],
) {
    if bvh.count != spheres.len() {
        return crate::nearest::<A, L>(token, rays, spheres, hits);
    }
    let mut under_way = UnderWay::NEW;
    for (packet, hit) in rays.iter().zip(hits.iter_mut()) {
        *hit = HitPacket::none();
        meet::<A, L, false>(token, packet, &spheres, bvh, &mut under_way, hit);
    }
}

/// Whether every ray meets anything: what [`any`](crate::any) returns, from a tree.
///
/// Lane `i` in bit `i` of `met[k]` for `rays[k]`. True exactly where [`nearest`] finds a hit;
/// cheaper, since a ray that has surely met something is done. Otherwise as `nearest`.
#[inline(always)]
pub fn any<A: Accuracy, L: Lanes>(
    token: L::Token,
    rays: &[RayPacket<L>],
    spheres: Spheres<'_>,
    bvh: &Bvh<'_>,
    met: &mut [u32],
) {
    if bvh.count != spheres.len() {
        return crate::any::<A, L>(token, rays, spheres, met);
    }
    let mut under_way = UnderWay::NEW;
    for (packet, met) in rays.iter().zip(met.iter_mut()) {
        let mut hit = HitPacket::none();
        let sure = meet::<A, L, true>(token, packet, &spheres, bvh, &mut under_way, &mut hit);
        let found = L::load(token, &hit.t).lt(L::splat(token, f32::INFINITY));
        *met = sure | found.bits();
    }
}

/// How many rays of a packet are under way in turn.
const TOGETHER: usize = 4;
/// See above.
const STACK: usize = 256;
const _: () = assert!(STACK >= (WIDTH - 1) * DEPTH + WIDTH);

/// Puts lanes where [`part_of`] would take them from.
#[inline(always)]
fn put_part<L: Lanes>(numbers: &mut [f32; WIDTH], part: usize, lanes: L) {
    let array = lanes.store();
    let places = numbers.iter_mut().skip(part * L::COUNT % WIDTH);
    for (place, number) in places.zip(array.as_ref()) {
        *place = *number;
    }
}

/// Takes lanes from a stack.
#[inline(always)]
fn get<L: Lanes>(token: L::Token, stack: &[f32; STACK + WIDTH], at: usize) -> L {
    let mut array = L::Array::default();
    if let Some(places) = stack.get(at..at + L::COUNT) {
        array.as_mut().copy_from_slice(places);
    }
    L::load(token, &array)
}

/// Lays lanes onto a stack.
#[inline(always)]
fn put<L: Lanes>(stack: &mut [f32; STACK + WIDTH], at: usize, lanes: L) {
    let array = lanes.store();
    if let Some(places) = stack.get_mut(at..at + L::COUNT) {
        places.copy_from_slice(array.as_ref());
    }
}

/// What a ray meets in a node.
#[derive(Clone, Copy, Debug)]
struct Met {
    children: u32,
    entries: [f32; WIDTH],
}

/// One ray under way.
#[derive(Clone, Copy, Debug)]
struct Walk {
    origin: [f32; 3],
    direction: [f32; 3],
    inverse: [f32; 3],
    near: [f32; 3],
    far: [f32; 3],
    start: [f32; 2],
    /// Some answer, or the end of the interval, is not above.
    best: f32,
    /// The end of the interval, from below.
    end: f32,
    spread: f32,
    /// |d|.
    length: f32,
    lane: usize,
    list: List,
    /// Something is surely met.
    met: bool,
    entries: [f32; STACK + WIDTH],
    /// As bits: numbers that are moved, never computed with.
    children: [f32; STACK + WIDTH],
    top: usize,
}

impl Walk {
    const NEW: Self = Self {
        origin: [0.0; 3],
        direction: [0.0; 3],
        inverse: [0.0; 3],
        near: [0.0; 3],
        far: [0.0; 3],
        start: [0.0; 2],
        best: 0.0,
        end: 0.0,
        spread: 0.0,
        length: 0.0,
        lane: 0,
        list: List::EMPTY,
        met: false,
        entries: [0.0; STACK + WIDTH],
        children: [0.0; STACK + WIDTH],
        top: 0,
    };

    #[inline(always)]
    fn begin<L: Lanes>(&mut self, slabs: &Slabs<L>, lane: usize, root: u32) {
        #[inline(always)]
        fn at<A: AsRef<[f32]>>(array: &A, lane: usize) -> f32 {
            match array.as_ref().get(lane) {
                Some(value) => *value,
                None => f32::NAN,
            }
        }
        self.origin = axes!(i => at(&slabs.origin[i], lane));
        self.direction = axes!(i => at(&slabs.direction[i], lane));
        self.inverse = axes!(i => at(&slabs.inverse[i], lane));
        self.near = axes!(i => at(&slabs.near[i], lane));
        self.far = axes!(i => at(&slabs.far[i], lane));
        self.start = [at(&slabs.start[0], lane), at(&slabs.start[1], lane)];
        self.end = at(&slabs.end[0], lane);
        self.best = at(&slabs.end[1], lane);
        self.spread = at(&slabs.spread, lane);
        self.length = at(&slabs.length, lane);
        self.lane = lane;
        self.list.count = 0;
        self.met = false;
        self.entries[0] = f32::NEG_INFINITY;
        self.children[0] = f32::from_bits(root);
        self.top = 1;
    }

    /// Takes a box from the stack.
    #[inline(always)]
    fn next(&mut self) -> Option<u32> {
        self.top = self.top.checked_sub(1)?;
        Some(self.children[self.top & (STACK - 1)].to_bits())
    }

    #[inline(always)]
    fn enter<A: Accuracy, L: Lanes>(&self, token: L::Token, node: &BvhNode, met: &mut Met) {
        let best = if A::SPREAD > 0.0 { self.best + self.spread } else { self.best };
        let start = if A::SPREAD > 0.0 { self.start[0] - self.spread } else { self.start[0] };
        let forward = axes!(i => self.inverse[i] >= 0.0);
        let nearer = axes!(i => if forward[i] { &node.low[i] } else { &node.high[i] });
        let farther = axes!(i => if forward[i] { &node.high[i] } else { &node.low[i] });
        let inverse = axes!(i => L::splat(token, self.inverse[i]));
        let near = axes!(i => L::splat(token, -self.near[i]));
        let far = axes!(i => L::splat(token, self.far[i]));
        let (start, minus_best) = (L::splat(token, start), L::splat(token, -best));
        met.children = 0;
        for part in 0..WIDTH / L::COUNT {
            let entry = axes!(i => {
                part_of::<L>(token, nearer[i], part).filter_mul_add(inverse[i], near[i])
            });
            let minus_leave = axes!(i => {
                part_of::<L>(token, farther[i], part).filter_mul_add(-inverse[i], far[i])
            });
            let entry = entry[0].filter_max(entry[1]).filter_max(entry[2].filter_max(start));
            let minus_leave = minus_leave[0]
                .filter_max(minus_leave[1])
                .filter_max(minus_leave[2].filter_max(minus_best));
            met.children |= entry.le(-minus_leave).bits() << (part * L::COUNT);
            put_part(&mut met.entries, part, entry);
        }
    }

    /// Lays the children that are `met` onto the stack, the nearest on top.
    ///
    /// A child's place is the number of those entered later, counted by a comparison with all:
    /// most nodes have one or two, and loops of a sort would be guessed wrong by the processor.
    #[inline(always)]
    fn push_sorted<L: Lanes>(
        &mut self,
        token: L::Token,
        Met { children: met, entries }: &Met,
        children: &[u32; WIDTH],
    ) {
        let met = *met;
        let base = self.top;
        let mut left = met;
        while left != 0 {
            let lane = left.trailing_zeros() as usize % WIDTH;
            let below = left & left.wrapping_neg();
            left &= left - 1;
            let entry = L::splat(token, entries[lane]);
            let (mut later, mut earlier) = (0, 0);
            for part in 0..WIDTH / L::COUNT {
                let others = part_of::<L>(token, entries, part);
                later |= entry.lt(others).bits() << (part * L::COUNT);
                earlier |= others.lt(entry).bits() << (part * L::COUNT);
            }
            let equal_before = !(later | earlier) & (below - 1);
            let rank = ((later | equal_before) & met).count_ones() as usize;
            let at = (base + rank) & (STACK - 1);
            self.entries[at] = entries[lane];
            self.children[at] = f32::from_bits(children[lane]);
            self.top += 1;
        }
    }

    /// Drops what is entered past the best.
    #[inline(always)]
    fn cull<A: Accuracy, L: Lanes>(&mut self, token: L::Token) {
        let best = if A::SPREAD > 0.0 { self.best + self.spread } else { self.best };
        let limit = L::splat(token, best);
        let (top, mut kept) = (self.top, 0);
        for from in (0..top).step_by(L::COUNT) {
            let entries = get::<L>(token, &self.entries, from);
            let children = get::<L>(token, &self.children, from);
            let stays = entries.le(limit);
            put::<L>(&mut self.entries, kept, entries.compress(stays));
            put::<L>(&mut self.children, kept, children.compress(stays));
            let here = stays.bits() & (((1_u64 << (top - from).min(L::COUNT)) - 1) as u32);
            kept += here.count_ones() as usize;
        }
        self.top = kept;
    }

    #[inline(always)]
    fn probe<L: Lanes>(&self, token: L::Token) -> Probe<L> {
        Probe {
            origin: axes!(i => L::splat(token, self.origin[i])),
            direction: axes!(i => L::splat(token, self.direction[i])),
            start: [L::splat(token, self.start[0]), L::splat(token, self.start[1])],
            end: [L::splat(token, self.end), L::splat(token, self.best)],
        }
    }

    /// Which spheres of a leaf to look at.
    #[inline(always)]
    fn filter<A: Accuracy, L: Lanes>(&self, token: L::Token, leaf: &BvhLeaf) -> u32 {
        let probe = self.probe::<L>(token);
        let mut spheres = 0;
        for part in 0..WIDTH / L::COUNT {
            spheres |= probe.may_meet::<A>(leaf, part) << (part * L::COUNT);
        }
        spheres
    }

    #[inline(always)]
    fn meet<A: Accuracy, L: Lanes, const ANY: bool>(
        &mut self,
        token: L::Token,
        packet: &RayPacket<L>,
        bvh: &Bvh<'_>,
        leaf: &BvhLeaf,
        place: u32,
        hits: &mut HitPacket<L>,
    ) {
        let before = self.best;
        let probe = self.probe::<L>(token);
        for part in 0..WIDTH / L::COUNT {
            let bracket = probe.meet::<A>(leaf, part);
            let (entries, bounds) = (bracket.entry.store(), bracket.bound.store());
            let mut candidates = bracket.candidates;
            while candidates != 0 {
                let lane = candidates.trailing_zeros() as usize;
                candidates &= candidates - 1;
                let (Some(&entry), Some(&bound)) =
                    (entries.as_ref().get(lane), bounds.as_ref().get(lane))
                else {
                    continue;
                };
                if ANY && bound < f32::INFINITY {
                    self.met = true;
                    self.top = 0;
                    return;
                }
                if entry > self.best {
                    continue;
                }
                if bound < self.best {
                    self.best = bound;
                }
                if self.list.is_full(self.best) {
                    self.flush::<A, L, ANY>(token, packet, bvh, hits);
                }
                self.list.push(place + (part * L::COUNT + lane) as u32, entry);
            }
        }
        if self.best < before {
            self.cull::<A, L>(token);
        }
    }

    /// Asks the tier about the list, which is full.
    #[inline(always)]
    fn flush<A: Accuracy, L: Lanes, const ANY: bool>(
        &mut self,
        token: L::Token,
        packet: &RayPacket<L>,
        bvh: &Bvh<'_>,
        hits: &mut HitPacket<L>,
    ) {
        let (lane, list) = (self.lane, self.list);
        self.list.count = 0;
        let nearest = L::out_of_line(
            token,
            #[inline(always)]
            || settle_one::<A, L>(token, packet, lane, bvh.leaves, &list),
        );
        let Some(hit) = nearest else { return };
        take(hits, lane, hit.t, hit.sphere);
        if ANY {
            self.met = true;
            self.top = 0;
        }
        let best = raised(hit.t * self.length);
        if best < self.best {
            self.best = best;
        }
    }
}

/// What is kept from one packet to the next, so that it is cleared once.
#[derive(Clone, Copy, Debug)]
struct UnderWay {
    walks: [Walk; TOGETHER],
    /// For every lane its candidates, and its best.
    lists: [(List, f32); MOST_LANES],
}

impl UnderWay {
    const NEW: Self =
        Self { walks: [Walk::NEW; TOGETHER], lists: [(List::EMPTY, f32::INFINITY); MOST_LANES] };
}

/// More lanes have no type.
const MOST_LANES: usize = 32;

/// Meets one packet's rays with all spheres; answers with the lanes that surely meet something,
/// where that is all that is asked.
#[inline(always)]
fn meet<A: Accuracy, L: Lanes, const ANY: bool>(
    token: L::Token,
    packet: &RayPacket<L>,
    spheres: &Spheres<'_>,
    bvh: &Bvh<'_>,
    UnderWay { walks, lists }: &mut UnderWay,
    hits: &mut HitPacket<L>,
) -> u32 {
    let rays = RayLanes::load(token, packet);
    let live = rays.live.bits();
    let slabs = Slabs::<L>::new::<A>(&rays, bvh.extent);
    for (list, _) in lists.iter_mut().take(L::COUNT) {
        list.count = 0;
    }
    let mut met = 0;

    let mut waiting = slabs.judged;
    let mut under_way = 0_u32;
    for (place, walk) in walks.iter_mut().enumerate() {
        if waiting != 0 {
            walk.begin(&slabs, waiting.trailing_zeros() as usize, bvh.root);
            waiting &= waiting - 1;
            under_way |= 1 << place;
        }
    }
    let mut boxes = [(0_usize, 0_u32); TOGETHER];
    let mut in_nodes = [Met { children: 0, entries: [0.0; WIDTH] }; TOGETHER];
    let mut in_leaves = [0_u32; TOGETHER];
    while under_way != 0 {
        // Nodes from the front, leaves from the back.
        let (mut nodes, mut leaves) = (0, TOGETHER);
        let mut left = under_way;
        while left != 0 {
            let place = left.trailing_zeros() as usize % TOGETHER;
            left &= left - 1;
            let walk = &mut walks[place];
            let child = loop {
                if let Some(child) = walk.next() {
                    break child;
                }
                if walk.met {
                    met |= 1 << walk.lane;
                } else if let Some(list) = lists.get_mut(walk.lane) {
                    *list = (walk.list, walk.best);
                }
                if waiting == 0 {
                    under_way &= !(1 << place);
                    break NO_CHILD;
                }
                walk.begin(&slabs, waiting.trailing_zeros() as usize, bvh.root);
                waiting &= waiting - 1;
            };
            if child & LEAF == 0 {
                boxes[nodes % TOGETHER] = (place, child);
                nodes += 1;
            } else if child != NO_CHILD {
                leaves -= 1;
                boxes[leaves % TOGETHER] = (place, child & !LEAF);
            }
        }
        for (&(place, child), met) in boxes.iter().zip(&mut in_nodes).take(nodes) {
            if let Some(node) = bvh.nodes.get(child as usize) {
                walks[place % TOGETHER].enter::<A, L>(token, node, met);
            }
        }
        for (&(place, child), spheres) in boxes.iter().zip(&mut in_leaves).skip(leaves) {
            if let Some(leaf) = bvh.leaves.get(child as usize) {
                *spheres = walks[place % TOGETHER].filter::<A, L>(token, leaf);
            }
        }
        for (&(place, child), met) in boxes.iter().zip(&in_nodes).take(nodes) {
            if let Some(node) = bvh.nodes.get(child as usize) {
                walks[place % TOGETHER].push_sorted::<L>(token, met, &node.child);
            }
        }
        for (&(place, child), spheres) in boxes.iter().zip(&in_leaves).skip(leaves) {
            if *spheres != 0
                && let Some(leaf) = bvh.leaves.get(child as usize)
            {
                let walk = &mut walks[place % TOGETHER];
                walk.meet::<A, L, ANY>(token, packet, bvh, leaf, child * WIDTH as u32, hits);
            }
        }
    }
    settle::<A, L>(token, &rays, bvh.leaves, lists.get(..L::COUNT).unwrap_or(&[]), hits);

    let judged = slabs.judged & !met;
    if !bvh.outside.is_empty() && judged != 0 {
        L::out_of_line(
            token,
            #[inline(always)]
            || settle_outside::<A, L>(token, &rays, bvh.outside, judged, hits),
        );
    }
    let rest = live & !slabs.judged;
    if rest != 0 {
        L::out_of_line(
            token,
            #[inline(always)]
            || meet_all::<A, L>(token, packet, spheres, rest, hits),
        );
    }
    met
}

/// Rays that the bounds do not cover, those in `lanes`, against all spheres.
#[inline(always)]
fn meet_all<A: Accuracy, L: Lanes>(
    token: L::Token,
    packet: &RayPacket<L>,
    spheres: &Spheres<'_>,
    lanes: u32,
    hits: &mut HitPacket<L>,
) {
    let asked = lanes_of_bits::<L>(token, lanes);
    let mut rays = *packet;
    let never = L::splat(token, f32::NAN);
    rays.t_min = L::select(asked, L::load(token, &rays.t_min), never).store();
    let mut found = [HitPacket::none()];
    crate::nearest::<A, L>(token, &[rays], *spheres, &mut found);
    for (lane, (&t, &index)) in found[0].t().iter().zip(found[0].spheres()).enumerate() {
        if lanes >> lane & 1 == 1 && t < f32::INFINITY {
            take(hits, lane, t, index);
        }
    }
}
