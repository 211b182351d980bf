//! What the rays under way do next: the rounds of a walk.

use super::ray_walk::Walk;
use super::{LEAF, NO_CHILD};
use crate::{LaneArray, Lanes};

/// A walk, and the node or leaf that it looks into next.
#[derive(Clone, Copy)]
pub(super) struct Step {
    pub(super) walk: u32,
    pub(super) child: u32,
}

impl Step {
    const NONE: Self = Self { walk: 0, child: NO_CHILD };
}

/// Steps, one a walk at most.
pub(super) struct Steps<L: Lanes> {
    steps: <L::Array as LaneArray>::Each<Step>,
    pub(super) count: usize,
}

impl<L: Lanes> Steps<L> {
    #[inline(always)]
    fn none() -> Self {
        Self { steps: L::Array::each(Step::NONE), count: 0 }
    }

    /// Adds a step if it is `wanted`, without a branch.
    #[inline(always)]
    pub(super) fn append(&mut self, step: Step, wanted: bool) {
        if let Some(place) = self.steps.as_mut().get_mut(self.count % L::COUNT) {
            *place = step;
            self.count += usize::from(wanted);
        }
    }

    #[inline(always)]
    pub(super) fn get(&self, at: usize) -> Step {
        self.steps.as_ref().get(at % L::COUNT).copied().unwrap_or(Step::NONE)
    }
}

/// What the walks do next: the rounds of the loop.
pub(super) struct Round<L: Lanes> {
    pub(super) nodes: Steps<L>,
    pub(super) leaves: Steps<L>,
    /// Walks that have ended.
    pub(super) ended: Steps<L>,
}

impl<L: Lanes> Round<L> {
    #[inline(always)]
    pub(super) fn empty() -> Self {
        Self { nodes: Steps::none(), leaves: Steps::none(), ended: Steps::none() }
    }

    #[inline(always)]
    pub(super) fn clear(&mut self) {
        (self.nodes.count, self.leaves.count, self.ended.count) = (0, 0, 0);
    }

    /// Takes what is next from the stack of a walk.
    #[inline(always)]
    pub(super) fn go_on(&mut self, number: u32, walk: &mut Walk) {
        let ended = walk.stack.is_empty();
        let child = walk.stack.pop();
        let leaf = child & LEAF != 0;
        self.nodes.append(Step { walk: number, child }, !leaf & !ended);
        self.leaves.append(Step { walk: number, child: child & !LEAF }, leaf & !ended);
        self.ended.append(Step { walk: number, child }, ended);
    }
}
