//! Work, counted: what a call does, without a clock.
#![cfg_attr(
    not(feature = "std"),
    expect(dead_code, reason = "calls are counted where there are levels")
)]

use core::cell::Cell;
use core::fmt::{Display, Formatter, Result};
use core::ops::Sub;
use std::thread_local;

/// Writes the kinds of work, each with its name in tables and its weight.
macro_rules! kinds {
    ($($(#[$about:meta])* $kind:ident $name:literal $weight:literal,)*) => {
        /// A kind of work: one vector operation over sixteen boxes, spheres or rays, as a rule.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub(crate) enum Kind {
            $($(#[$about])* $kind,)*
        }

        impl Kind {
            const ALL: &[Self] = &[$(Self::$kind),*];
            const NAMES: &[&str] = &[$($name),*];
            /// Nanoseconds on an EPYC of 2025 (Zen 5) with AVX-512, fitted to 4,500 calls on inputs of the search: half of the calls take
            /// 0.85 to 1.09 times the sum of their weights, nine of ten 0.7 to 1.26 times. The weights of streams and lists are estimates.
            const WEIGHTS: &[f64] = &[$($weight),*];
        }
    };
}

kinds! {
    /// A run of packets whose rays go by themselves begins.
    RayRun "runs" 330.0,
    /// Such a run begins where rays have stacks, which are laid out.
    RayStacks "stacks" 1000.0,
    /// A packet of such a run is prepared.
    RayPacket "prepared" 56.0,
    /// A ray by itself against the boxes of a node, and onto its stack.
    RayNode "ray node" 25.0,
    /// A ray by itself against a leaf.
    RayLeaf "ray leaf" 12.0,
    /// The same, once more: between which s the roots are.
    RayRoots "ray roots" 43.0,
    /// A ray of a stream against the boxes of a node.
    StreamNode "stream node" 15.0,
    /// The same ray, written behind the queue of a child.
    StreamQueued "queued" 2.0,
    /// A ray of a stream against a leaf.
    StreamLeaf "stream leaf" 10.0,
    /// The same, once more.
    StreamRoots "stream roots" 35.0,
    /// A packet is prepared as one of a group, or surveyed for a depth list.
    GroupPacket "grouped" 18.0,
    /// Planes are laid around a group, or it is found not to fit.
    GroupFit "fit" 380.0,
    /// A group's planes against the boxes of a node.
    GroupNode "group node" 17.0,
    /// A group's planes against a leaf, or sixteen spheres of a depth list.
    GroupLeaf "group leaf" 22.0,
    /// A packet's planes against a leaf.
    PacketLeaf "packet leaf" 16.0,
    /// A sphere against the rays of a packet.
    PacketSphere "packet sphere" 11.0,
    /// The same, once more: between which s the roots are.
    PacketRoots "packet roots" 27.0,
    /// A filter of four spheres of a list against the rays of a packet.
    ListGroup "list group" 6.0,
    /// The tier, a ray and a sphere a lane.
    TierLanes "tier" 250.0,
    /// A ray and a sphere by exact sums, where double precision cannot decide.
    ExactRoot "exact roots" 900.0,
    /// Two spheres that one ray hits at one t, by exact sums.
    ExactOrder "exact orders" 8000.0,
}

const KINDS: usize = Kind::ALL.len();

thread_local! {
    static WORK: Cell<[u64; KINDS]> = const { Cell::new([0; KINDS]) };
}

/// Counts work of this thread.
pub(crate) fn add(kind: Kind, times: usize) {
    WORK.with(|work| {
        let mut counts = work.get();
        counts[kind as usize] += times as u64;
        work.set(counts);
    });
}

/// How much work of each kind was done.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Work([u64; KINDS]);

impl Work {
    /// What `call` does.
    pub(crate) fn of(call: impl FnOnce()) -> Self {
        let before = Self(WORK.get());
        call();
        Self(WORK.get()) - before
    }

    /// How often work of a kind was done.
    pub(crate) fn count(&self, kind: Kind) -> u64 {
        self.0[kind as usize]
    }

    /// All of it, weighted.
    pub(crate) fn units(&self) -> f64 {
        self.0.iter().zip(Kind::WEIGHTS).map(|(&count, weight)| count as f64 * weight).sum()
    }

    /// The work for one ray of a call of `rays` rays: kinds that it does not do are left out.
    pub(crate) fn per_ray(&self, rays: usize) -> PerRay<'_> {
        PerRay(self, rays)
    }
}

impl Sub for Work {
    type Output = Self;

    fn sub(self, before: Self) -> Self {
        Self(core::array::from_fn(|kind| self.0[kind] - before.0[kind]))
    }
}

/// Work a ray, as a line of text.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PerRay<'a>(&'a Work, usize);

impl Display for PerRay<'_> {
    fn fmt(&self, text: &mut Formatter<'_>) -> Result {
        let rays = self.1 as f64;
        write!(text, "{:7.0} units", self.0.units() / rays)?;
        for (count, name) in self.0.0.iter().zip(Kind::NAMES) {
            if *count > 0 {
                write!(text, ", {name} {:.2}", *count as f64 / rays)?;
            }
        }
        Ok(())
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

std::thread_local! {
    static PERSISTS: Cell<bool> = const { Cell::new(false) };
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
