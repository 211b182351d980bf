//! How many packets of a slice are traced at a time.

/// Enough that preparing 128 spheres of a list for them is a hundredth of the work; for firmware as many as its stack
/// holds.
pub(super) const PACKETS: usize = if cfg!(feature = "std") { 64 } else { 4 };
