//! What a caller says of rays.

/// What rays that come one after the other have in common.
///
/// The words are those of Embree's `RTCRayQueryFlags`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Coherence {
    /// The kernel finds out: it tries packets together, and traces those that do not gain ray by ray.
    #[default]
    Detect,
    /// They share an origin or a direction, or nearly so, and lie close together: camera rays, shadow rays to one light.
    /// After packets that do not pay, fewer are passed over before the next try. A false claim costs the tries.
    Coherent,
    /// They share nothing, or many spheres lie between neighbouring rays. They go ray by ray, or in lent memory as a stream as long
    /// as enough of them meet.
    Incoherent,
}
