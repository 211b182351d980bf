//! How long trees take to be built, and how large ours is.

#[cfg(feature = "embree")]
use crate::embree::Embree;
use crate::rounds::{self, Median, Samples, Subject};
use crate::structures::ours::{TreeMemory, bytes};
use crate::structures::peer::Builder;
use spherule_kernel::{Bvh, Spheres};

/// The name of Embree among builds.
pub const EMBREE: &str = "Embree";
/// The kernel's.
pub const OURS: &str = "ours";

/// Times of builds, and the size of ours.
#[derive(Clone, Debug)]
pub struct Builds {
    /// How many spheres.
    pub spheres: usize,
    /// Bytes a sphere, beyond the caller's list.
    pub bytes: f64,
    /// Nodes below each other.
    pub depth: usize,
    /// Who built.
    pub names: Vec<&'static str>,
    /// Nanoseconds a build.
    samples: Samples,
}

impl Builds {
    /// Milliseconds; nothing of who did not take part.
    #[must_use]
    pub fn milliseconds(&self, name: &str) -> Option<f64> {
        let took_part = self.names.contains(&name);
        took_part.then(|| self.samples.median(name).middle * 1e-6)
    }

    /// The time of ours by that of Embree's, round by round.
    #[must_use]
    pub fn by_embree(&self) -> Option<Median> {
        self.names.contains(&EMBREE).then(|| self.samples.ratio(OURS, EMBREE))
    }
}

/// Builds in turns, one thread each, and tells what `bvh` over the same spheres is like. Memory is
/// part of it for all: ours is asked of the system and filled before it is built in, and returned.
#[must_use]
pub fn measure(spheres: Spheres<'_>, bvh: &Bvh<'_>, builders: &[Builder], rounds: usize) -> Builds {
    let mut names = vec![OURS];
    let mut subjects = vec![Subject::new(OURS, || {
        let mut memory = TreeMemory::new(spheres.len());
        std::hint::black_box(memory.build(spheres));
        1
    })];
    #[cfg(feature = "embree")]
    {
        names.push(EMBREE);
        let build = || Embree::build(spheres).build_nanoseconds() as f64;
        subjects.push(Subject::timing_itself(EMBREE, build));
    }
    for builder in builders {
        names.push(builder.name);
        let build = move || (builder.build)(spheres).build_nanoseconds();
        subjects.push(Subject::timing_itself(builder.name, build));
    }
    let samples = rounds::take(&mut subjects, rounds);
    let bytes = bytes(bvh) as f64 / spheres.len().max(1) as f64;
    Builds { spheres: spheres.len(), bytes, depth: bvh.depth(), names, samples }
}
