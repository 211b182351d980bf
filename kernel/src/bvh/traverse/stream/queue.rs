//! The queues of a stream: which rays wait at each box on the way, in memory of the caller's.

use super::ray::StreamRay;
use crate::bvh::node::{NO_CHILD, WIDTH};

/// Memory for a ray that waits at a box. 8 bytes.
#[derive(Clone, Copy, Debug)]
pub struct QueuedRay {
    /// Which ray of the stream.
    pub(super) ray: u32,
    /// The s at which it enters the box.
    pub(super) entry: f32,
}

impl QueuedRay {
    /// No ray: what memory for queues is filled with.
    pub const EMPTY: Self = Self { ray: 0, entry: 0.0 };
}

/// A node on the way: the rays that wait at it, and those that wait at its children.
#[derive(Clone, Copy)]
pub(super) struct Frame {
    pub(super) node: u32,
    /// The rays that have yet to enter the node, by their places in the queues.
    pub(super) next: usize,
    pub(super) end: usize,
    /// Where the queue of the first child begins, and how many rays a child has room for.
    pub(super) base: usize,
    pub(super) room: usize,
    /// How many rays wait at each child.
    pub(super) counts: [u32; WIDTH],
    /// The children from this place on, in the order of the octant, are done.
    pub(super) left: u32,
}

impl Frame {
    pub(super) const EMPTY: Self =
        Self { node: NO_CHILD, next: 0, end: 0, base: 0, room: 0, counts: [0; WIDTH], left: 0 };
}

/// Drops rays of the queue `from..to` that have found something before they would enter; returns where the queue
/// ends then.
#[inline(always)]
pub(super) fn still_waiting(
    queues: &mut [QueuedRay],
    rays: &[StreamRay],
    from: usize,
    to: usize,
) -> usize {
    let mut kept = from;
    for at in from..to {
        let Some(&queued) = queues.get(at) else { break };
        let Some(ray) = rays.get(queued.ray as usize) else { break };
        if let Some(place) = queues.get_mut(kept) {
            *place = queued;
        }
        kept += usize::from(queued.entry <= ray.end_of_boxes);
    }
    kept
}
