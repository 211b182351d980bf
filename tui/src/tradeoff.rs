//! `spherule tradeoff`: what every tier costs on a scene, and how wrong it is there.
//!
//! The rays are those that a picture of the scene takes; the truth is what `Exact` says.

mod errors;
mod progress;
mod rays;
mod report;
mod speed;

use crate::arguments::{ComputingArguments, TradeoffArguments};
use crate::draw::{
    AccuracyChoice, Charset, ColorDepth, Style, picture_aspect, picture_workload, sample_grid,
};
use crate::failure::{Failure, write_stdout};
use crate::show::{PIPE_SIZE, USUAL_ASPECT};
use crate::structure::{RaysKind, SceneStructures, Search, Structure, TileLists, TreeMemory};
use crate::threads::{Threads, packets_a_task};
use crate::{machine, scene, view};
use errors::Errors;
use progress::Progress;
use rays::{Rays, most_rays};
use report::{Report, Tier};
use spherule_kernel::dispatch::{Level, Packet};
use spherule_kernel::{
    Accuracy, Exact, Fast, HitPacket, Lanes, Question, RayPacket, Spheres, Stable, Stages, stages,
};
use std::hint::black_box;

/// Measures, and prints what was found.
///
/// # Errors
/// [`Failure`] where there is no such scene, or nobody to tell.
pub fn tradeoff(arguments: &TradeoffArguments) -> Result<(), Failure> {
    let scene = scene::open::open(&arguments.scene, arguments.format)
        .map_err(|error| Failure::Input(error.to_string()))?;
    let ComputingArguments { structure, threads, level } = arguments.computing;
    let threads = Threads::new(threads)?;
    let level = level.unwrap_or_else(Level::best);
    let (columns, rows) = arguments.size.unwrap_or(PIPE_SIZE);
    let style = Style {
        accuracy: AccuracyChoice::Exact,
        charset: Charset::Ascii,
        depth: ColorDepth::Never,
        samples: arguments.samples,
        cell_aspect: USUAL_ASPECT,
    };
    let mut view = scene.first_view(picture_aspect(&style, columns, rows) as f32);
    if let Some(kind) = arguments.projection {
        view = view::with_projection(&view, kind);
    }

    let spheres = scene.spheres();
    let mut memory = TreeMemory::default();
    let mut structures = SceneStructures::new(spheres, &threads, &mut memory);
    // What is built is not timed here, as if there were pictures without end.
    let workload = picture_workload(spheres.len(), &style, columns, rows, f64::INFINITY);
    let structure = structures.structure(structure, &workload);
    let search = structures.picture(structure, workload.kind, view.viewpoint(), &scene.lights)?;
    let (camera, width, height) = sample_grid(&view, &style, columns, rows);
    let most = most_rays(spheres.len(), structure);
    let camera = Rays::of_camera(&camera, width, height, most);
    let for_camera =
        Machine { level, threads: &threads, kind: search.kind, searches: &[search.camera] };
    let for_shadow = Machine { searches: &search.lights, ..for_camera };
    let shadow = Rays::of_shadows(&camera, &for_camera.hits::<Exact>(&camera), &scene, most);
    let mut progress = Progress::new();
    let mut tiers = Vec::new();
    for (machine, rays, kind, question) in [
        (&for_camera, &camera, "camera", Question::Nearest),
        (&for_shadow, &shadow, "shadow", Question::Any),
    ] {
        if rays.count > 0 {
            tiers.extend(machine.measure(rays, kind, question, spheres, &mut progress));
        }
    }
    drop(progress);

    let report = Report {
        scene: arguments.scene.clone(),
        spheres: spheres.len(),
        cpu: machine::cpu(),
        rustc: machine::RUSTC,
        structure,
        level: level.name(),
        lanes: Packet::COUNT,
        threads: threads.count(),
        tiers,
    };
    let text = if arguments.json { report.json() } else { report.table() };
    write_stdout(text.as_bytes())
}

/// What measures.
#[derive(Clone, Copy)]
struct Machine<'a> {
    level: Level,
    threads: &'a Threads,
    kind: RaysKind,
    /// One for every part of the rays.
    searches: &'a [Search<'a>],
}

impl Machine<'_> {
    /// Every tier on these rays.
    fn measure(
        &self,
        rays: &Rays,
        kind: &'static str,
        question: Question,
        spheres: Spheres<'_>,
        progress: &mut Progress,
    ) -> [Tier; 3] {
        let mut passes = (
            self.pass::<Fast>(rays, question),
            self.pass::<Stable>(rays, question),
            self.pass::<Exact>(rays, question),
        );
        let seconds = speed::medians([&mut passes.0, &mut passes.1, &mut passes.2], |share| {
            progress.show(&format!("{kind} rays"), share);
        });
        let truth = self.hits::<Exact>(rays);
        let errors = [
            Errors::new(&self.hits::<Fast>(rays), &truth),
            Errors::new(&self.hits::<Stable>(rays), &truth),
            Errors::new(&truth, &truth),
        ];
        // Of every test there is, as if by brute force; of some rays, if those are too many.
        let some = most_rays(spheres.len(), Structure::Brute) / Packet::COUNT;
        let step = rays.packets.len().div_ceil(some).max(1);
        let some: Vec<_> = rays.packets.iter().step_by(step).copied().collect();
        let exact = stages::<Packet>((), &some, spheres, question);
        // The other tiers know single precision alone.
        let single = Stages { double: 0, expansions: 0, ..exact };
        let [fast_errors, stable_errors, exact_errors] = errors;
        let tier = |accuracy, seconds, errors, stages| Tier {
            accuracy,
            rays_kind: kind,
            rays: rays.count,
            seconds,
            errors,
            stages,
        };
        [
            tier(AccuracyChoice::Fast, seconds[0], fast_errors, single),
            tier(AccuracyChoice::Stable, seconds[1], stable_errors, single),
            tier(AccuracyChoice::Exact, seconds[2], exact_errors, exact),
        ]
    }

    /// What is timed: the kernel's calls that answer the question for all rays.
    fn pass<'a, A: Accuracy>(&'a self, rays: &'a Rays, question: Question) -> impl FnMut() + 'a {
        let mut hits = vec![HitPacket::<Packet>::none(); rays.packets.len()];
        let mut met = vec![0; rays.packets.len()];
        move || match question {
            Question::Nearest => {
                self.nearest::<A>(rays, &mut hits);
                black_box(&hits);
            }
            Question::Any => {
                self.trace(rays, &mut met, |search, rays, lists, met| {
                    search.any::<A>(self.level, self.kind, rays, lists, met);
                });
                black_box(&met);
            }
        }
    }

    /// The nearest hits of a tier.
    fn hits<A: Accuracy>(&self, rays: &Rays) -> Vec<HitPacket<Packet>> {
        let mut hits = vec![HitPacket::<Packet>::none(); rays.packets.len()];
        self.nearest::<A>(rays, &mut hits);
        hits
    }

    fn nearest<A: Accuracy>(&self, rays: &Rays, hits: &mut [HitPacket<Packet>]) {
        self.trace(rays, hits, |search, rays, lists, hits| {
            search.nearest::<A>(self.level, self.kind, rays, lists, hits);
        });
    }

    /// Hands packets and results to the threads, part by part.
    fn trace<R: Send>(
        &self,
        rays: &Rays,
        results: &mut [R],
        trace: impl Fn(&Search<'_>, &[RayPacket<Packet>], &mut TileLists, &mut [R]) + Sync,
    ) {
        let (mut packets, mut results) = (&*rays.packets, results);
        let mut tasks = Vec::new();
        for (&length, search) in rays.parts.iter().zip(self.searches) {
            let own = packets.split_off(..length).unwrap_or_default();
            let answers = results.split_off_mut(..length).unwrap_or_default();
            let size = packets_a_task(length);
            let pieces = own.chunks(size).zip(answers.chunks_mut(size));
            tasks.extend(pieces.map(|(rays, results)| (search, rays, results)));
        }
        let tasks = tasks.into_iter();
        self.threads.share(&mut Vec::new(), tasks, |lists, (search, rays, results)| {
            trace(search, rays, lists, results);
        });
    }
}
