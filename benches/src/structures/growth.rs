//! More and more uniform spheres under the same rays.

use crate::scenes::{Kind, Scene};
use crate::structures::build::Builds;
use crate::structures::contender::{Contender, Tier, Way};
use crate::structures::measure::{self, Plan};
use crate::structures::measured::Measured;
use spherule_kernel::Question;

/// Pixels to a side of the picture: enough for a time, few enough for brute force to be shown.
const PIXELS: usize = 512;

/// So many spheres.
#[derive(Clone, Debug)]
pub struct Step {
    /// How many.
    pub spheres: usize,
    /// The builds.
    pub builds: Builds,
    /// Both kinds of rays.
    pub measured: Vec<Measured>,
}

/// Who is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Line {
    /// `Stable` in one of the kernel's ways.
    Ours(Way),
    /// The best of its calls.
    Embree,
}

/// What is shown, and what it is called.
pub const LINES: [(Kind, Line, &str); 6] = [
    (Kind::Primary, Line::Ours(Way::Coherent), "tree, primary"),
    (Kind::Primary, Line::Ours(Way::Tiles), "tile lists, primary"),
    (Kind::Primary, Line::Embree, "Embree, primary"),
    (Kind::Diffuse, Line::Ours(Way::Single), "tree, diffuse"),
    (Kind::Diffuse, Line::Embree, "Embree, diffuse"),
    (Kind::Primary, Line::Ours(Way::Brute), "brute force, primary"),
];

impl Step {
    /// A million rays a second, nearest hit; nothing of who did not take part.
    #[must_use]
    pub fn rate(&self, kind: Kind, line: Line) -> Option<f64> {
        let measured = self.measured.iter().find(|measured| measured.kind == kind)?;
        let question = Question::Nearest;
        let contender = match line {
            Line::Ours(way) => Contender::Ours(way, Tier::Stable, measured.level),
            Line::Embree => measured.fastest(question, Contender::is_embree)?,
        };
        measured.rate(contender, question)
    }
}

/// Measures as many spheres as `counts` says, one after the other.
pub fn measure(counts: &[usize], pixels: Option<usize>, plan: &Plan<'_>) -> Vec<Step> {
    let pixels = pixels.unwrap_or(PIXELS);
    let step = |&spheres: &usize| {
        eprintln!("growth: {spheres}");
        let (builds, measured) = measure::scene(&Scene::uniform(spheres, pixels), plan);
        Step { spheres, builds, measured }
    };
    counts.iter().map(step).collect()
}
