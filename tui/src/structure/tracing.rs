//! How rays are traced, whatever finds their spheres.

use spherule_kernel::{Coherence, Level, Tier};

/// What all rays of a call have in common.
#[derive(Clone, Copy, Debug)]
pub struct Tracing {
    /// Which tier decides hits.
    pub tier: Tier,
    /// The instructions.
    pub level: Level,
    /// Whether the rays lie close together.
    pub coherence: Coherence,
}
