//! What a caller says of rays.

/// What rays that come one after the other have in common.
///
/// The words are those of Embree's `RTCRayQueryFlags`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Coherence {
    /// This is found out as rays come: packets are tried together, and those that do not pay go ray by ray.
    #[default]
    Detect,
    /// They share an origin or a direction, or nearly so, and lie close together: camera rays, shadow rays to one light.
    /// After packets that do not pay, fewer are passed over before the next try. If this is false, it costs the tries.
    Coherent,
    /// They share nothing, or far fewer spheres than there are between them. They go ray by ray, or in lent memory as a stream as long
    /// as enough of them meet.
    Incoherent,
}
