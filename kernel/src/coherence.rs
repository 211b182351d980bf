//! What a caller says of rays.

/// What rays that come one after the other have in common.
///
/// The words of Embree's `RTCRayQueryFlags`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Coherence {
    /// Found out as they come: packets are tried together, and those that do not pay go ray by ray.
    #[default]
    Detect,
    /// An origin or a direction, or nearly so, and they lie close together: camera rays, shadow rays
    /// to one light. Of packets that do not pay fewer are passed over before others are tried. Said falsely, it costs as
    /// much as to try.
    Coherent,
    /// Nothing, or there are many more spheres between them than they share: ray by ray.
    Incoherent,
}
