//! What the frames of a file have in common, because they are seen from one view.

use glam::DVec3;

/// What a frame of a file has fixed for those that are read after it.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Fixed {
    /// The origin of positions.
    pub(super) origin: Option<DVec3>,
    /// The radius of particles for which the file states none.
    pub(super) radius: Option<f32>,
}
