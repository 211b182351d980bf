//! What was asked for, and whether it is reached.

use crate::scenes::Kind;

/// How many times as fast as the best call of Embree `Stable` shall be, scene by scene: primary and
/// diffuse rays.
const TIMES_EMBREE: [(&str, f64, f64); 9] = [
    ("one", 5.5, 4.0),
    ("u64", 6.0, 1.9),
    ("flake4", 7.0, 1.4),
    ("u10k", 8.0, 1.6),
    ("u1m", 5.5, 2.6),
    ("ground", 3.0, 1.2),
    ("cloud", 3.0, 1.2),
    ("parallel", 3.0, 1.2),
    ("long lens", 3.0, 1.2),
];
/// The time of the build of u1m by that of Embree's with one thread, at most.
pub const BUILD: f64 = 1.0;
/// Bytes a sphere beyond the caller's list, at most.
pub const BYTES: f64 = 40.0;
/// Primary rays a second in u10k by those in u1m, at most.
pub const SLOWDOWN: f64 = 2.6;
/// How many times as fast two threads are as one, at least.
pub const TWO_THREADS: f64 = 1.8;

/// How many times as fast as Embree, at least; nothing where nothing was asked.
#[must_use]
pub fn times_embree(scene: &str, kind: Kind) -> Option<f64> {
    let (_, primary, diffuse) = TIMES_EMBREE.into_iter().find(|(name, ..)| *name == scene)?;
    Some(match kind {
        Kind::Primary => primary,
        Kind::Diffuse => diffuse,
    })
}

/// The time of `Exact` by that of `Stable`, at most.
#[must_use]
pub const fn exact_by_stable(kind: Kind) -> f64 {
    match kind {
        Kind::Primary => 1.3,
        Kind::Diffuse => 1.6,
    }
}

/// The word for it in tables.
#[must_use]
pub const fn verdict(met: bool) -> &'static str {
    if met { "met" } else { "**missed**" }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenes::Name;

    #[test]
    fn every_scene_has_a_target() {
        for name in Name::ALL {
            assert!(times_embree(name.as_str(), Kind::Primary) >= Some(3.0));
            assert!(times_embree(name.as_str(), Kind::Diffuse) >= Some(1.2));
        }
    }
}
