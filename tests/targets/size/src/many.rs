//! A scene of many spheres, as data: columns, and a tree that was built on the host (`build.rs`).

use spherule_kernel::Spheres;

include!(concat!(env!("OUT_DIR"), "/baked.rs"));

/// The number of spheres.
pub const COUNT: usize = BAKED_SPHERES[0].len();

/// The spheres.
#[must_use]
pub fn spheres() -> Option<Spheres<'static>> {
    let [x, y, z, r] = &BAKED_SPHERES;
    Spheres::new(x, y, z, r).ok()
}
