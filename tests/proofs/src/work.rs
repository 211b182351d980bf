//! Work, counted: what a call does, without a clock.
#![cfg_attr(
    not(feature = "std"),
    expect(dead_code, reason = "calls are counted where there are levels")
)]

use core::cell::Cell;
use std::string::String;
use std::{format, thread_local};

/// Writes the kinds of work, each with its weight.
macro_rules! kinds {
    ($($(#[$about:meta])* $kind:ident $weight:literal,)*) => {
        /// A kind of work: one vector operation over sixteen boxes, spheres or rays, as a rule.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub(crate) enum Kind {
            $($(#[$about])* $kind,)*
        }

        impl Kind {
            const ALL: &[Self] = &[$(Self::$kind),*];
            /// Nanoseconds on an EPYC of 2025 (Zen 5) with AVX-512, fitted to 4,500 calls on inputs of the search: half of the calls take
            /// 0.85 to 1.09 times the sum of their weights, nine of ten 0.7 to 1.26 times. The weights of streams and lists are estimates.
            const WEIGHTS: &[f64] = &[$($weight),*];
        }
    };
}

kinds! {
    /// A run of packets whose rays go by themselves begins.
    RayRun 330.0,
    /// Such a run begins where rays have stacks, which are laid out.
    RayStacks 1000.0,
    /// A packet of such a run is prepared.
    RayPacket 56.0,
    /// A ray by itself against the boxes of a node, and onto its stack.
    RayNode 25.0,
    /// A ray by itself against a leaf.
    RayLeaf 12.0,
    /// The same, once more: between which s the roots are.
    RayRoots 43.0,
    /// A ray of a stream against the boxes of a node.
    StreamNode 15.0,
    /// The same ray, written behind the queue of a child.
    StreamQueued 2.0,
    /// A ray of a stream against a leaf.
    StreamLeaf 10.0,
    /// The same, once more.
    StreamRoots 35.0,
    /// A packet is prepared as one of a group, or surveyed for a depth list.
    GroupPacket 18.0,
    /// Planes are laid around a group, or it is found not to fit.
    GroupFit 380.0,
    /// A group's planes against the boxes of a node.
    GroupNode 17.0,
    /// A group's planes against a leaf, or sixteen spheres of a depth list.
    GroupLeaf 22.0,
    /// A packet's planes against a leaf.
    PacketLeaf 16.0,
    /// A sphere against the rays of a packet.
    PacketSphere 11.0,
    /// The same, once more: between which s the roots are.
    PacketRoots 27.0,
    /// A filter of four spheres of a list against the rays of a packet.
    ListGroup 6.0,
    /// A sphere is sorted by its depth.
    SphereSorted 30.0,
    /// The tier, a ray and a sphere a lane.
    TierLanes 250.0,
    /// A ray and a sphere by exact sums, where double precision cannot decide.
    ExactRoot 900.0,
    /// Two spheres that one ray hits at one t, by exact sums.
    ExactOrder 8000.0,
    /// An addition of 64 bits in an exact sum, carries included: a part of the two kinds above.
    Limb 0.0,
}

const KINDS: usize = Kind::ALL.len();

thread_local! {
    static WORK: [Cell<u64>; KINDS] = const { [const { Cell::new(0) }; KINDS] };
    static PERSISTS: Cell<bool> = const { Cell::new(false) };
}

/// Counts work of this thread.
pub(crate) fn add(kind: Kind, times: usize) {
    WORK.with(|work| work[kind as usize].update(|count| count + times as u64));
}

/// How much work of each kind was done.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Work([u64; KINDS]);

impl Work {
    /// What this thread has done.
    fn done() -> [u64; KINDS] {
        WORK.with(|work| work.each_ref().map(Cell::get))
    }

    /// What `call` does.
    pub(crate) fn of(call: impl FnOnce()) -> Self {
        let before = Self::done();
        call();
        let after = Self::done();
        Self(core::array::from_fn(|kind| after[kind] - before[kind]))
    }

    /// How often work of a kind was done.
    pub(crate) fn count(&self, kind: Kind) -> u64 {
        self.0[kind as usize]
    }

    /// All of it, weighted.
    pub(crate) fn units(&self) -> f64 {
        self.0.iter().zip(Kind::WEIGHTS).map(|(&count, weight)| count as f64 * weight).sum()
    }

    /// The work for one ray of a call of `rays` rays, as a line of text: kinds that it does not do are left out.
    pub(crate) fn per_ray(&self, rays: usize) -> String {
        let rays = rays as f64;
        let kinds = self.0.iter().zip(Kind::ALL).filter(|(count, _)| **count > 0);
        let kinds = kinds.map(|(count, kind)| format!(", {kind:?} {:.2}", *count as f64 / rays));
        format!("{:7.0} units{}", self.units() / rays, kinds.collect::<String>())
    }
}

#[test]
fn work_is_counted_by_kind() {
    let work = Work::of(|| {
        add(Kind::RayNode, 2);
        add(Kind::TierLanes, 1);
    });
    assert_eq!([work.count(Kind::RayNode), work.count(Kind::TierLanes)], [2, 1]);
    assert_eq!(work.count(Kind::GroupNode), 0);
    assert_eq!(Work::of(|| ()).units(), 0.0);
}

/// Whether groups on this thread go on whatever they do: what a control needs to see the work that giving up spares.
pub(crate) fn groups_persist() -> bool {
    PERSISTS.get()
}

/// Does `work` while groups go on whatever they do.
pub(crate) fn while_groups_persist<R>(work: impl FnOnce() -> R) -> R {
    PERSISTS.set(true);
    let result = work();
    PERSISTS.set(false);
    result
}
