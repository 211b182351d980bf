//! How the rays of a stream go on.

/// How rays that have nothing in common go through a tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum StreamStrategy {
    RayByRay,
    Stream,
}
