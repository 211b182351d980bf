//! `spherule tradeoff`: what every tier costs on a scene, and how wrong it is there.
//!
//! The rays are those that a picture of the scene takes; the truth is what `Exact` says.

mod blocks;
pub mod chart;
mod lighting;
mod machine;
mod orders;
mod rays;
mod report;
mod speed;
mod watch;

use crate::arguments::files::Subject;
use crate::arguments::{ComputingArguments, TradeoffArguments};
use crate::choice::Auto;
use crate::draw::{picture_workload, sample_grid};
use crate::error::{Error, write_stdout};
use crate::machine::cpu;
use crate::progress::Progress;
use crate::scene::Scene;
use crate::structure::Structure;
use crate::structure::picture_search::PictureSearch;
use crate::structure::scene::SceneStructures;
use crate::style::{PIPE_SIZE, Style};
use crate::threads::Threads;
use crate::view::View;
use machine::Machine;
use orders::Orders;
use rays::{Rays, most_rays};
pub use report::Report;
use spherule_kernel::{Level, RayPacket, Tier};
use std::time::Duration;
pub use watch::Step;
use watch::Watch;

/// What is measured: the rays of a picture, and what traces them.
#[derive(Clone, Copy, Debug)]
pub struct Question<'a> {
    /// The scene that the rays meet.
    pub scene: &'a Scene,
    /// The view that they come from.
    pub view: View,
    /// The style, which says how many rays a cell has.
    pub style: Style,
    /// Columns and rows of cells.
    pub size: (u16, u16),
    /// Which structure is asked for.
    pub structure: Auto<Structure>,
    /// Instructions and threads.
    pub machine: (Level, &'a Threads),
}

/// Measures, and prints what was found.
///
/// # Errors
/// [`Error`] if there is no such scene, or the report cannot be written.
pub fn tradeoff(arguments: &TradeoffArguments) -> Result<(), Error> {
    let Subject { scene, frame, frames } = arguments.scene.open()?;
    let ComputingArguments { structure, threads, level } = arguments.computing;
    let threads = Threads::new(threads)?;
    let (columns, rows) = arguments.scene.size.unwrap_or(PIPE_SIZE);
    let style = Style { samples: arguments.scene.samples, ..Style::PLAIN };
    let question = Question {
        scene: &scene,
        view: arguments.scene.view(&scene, style.picture_aspect(columns, rows)),
        style,
        size: (columns, rows),
        structure,
        machine: (level.unwrap_or_else(Level::best), &threads),
    };
    let mut structures =
        SceneStructures::new(scene.list(), &threads).in_order(arguments.scene.order);
    let mut progress = Progress::after(Duration::ZERO);
    let report = question.measure(&mut structures, &mut |step, share| {
        progress.show(step.doing(), share);
        true
    })?;
    drop(progress);
    let name = &arguments.scene.name;
    let text = |report: Report| if arguments.json { report.json(name) } else { report.table(name) };
    write_stdout(report.map(text).unwrap_or_default().as_bytes())?;
    if let Some(mut frames) = frames {
        let what = format!("frame {frame} is measured; there are more: --frame N");
        frames.report_more(frame, what);
    }
    Ok(())
}

impl Question<'_> {
    /// Measures what every tier takes and gets wrong, with one of the `structures` of the scene, whose building is not
    /// timed. Between passes, calls `watcher` with what is being done and the share of all that is done, from 0 to 1.
    /// If `watcher` returns `false`, the measurement ends without a report.
    ///
    /// # Errors
    /// [`Error::Running`] if there is no memory for a structure.
    pub fn measure(
        &self,
        structures: &mut SceneStructures<'_>,
        watcher: &mut dyn FnMut(Step, f64) -> bool,
    ) -> Result<Option<Report>, Error> {
        let mut watch = Watch::new(watcher);
        if watch.go_on(Step::Rays, 0.0).is_none() {
            return Ok(None);
        }
        let &Self { scene, view, style, size: (columns, rows), structure, .. } = self;
        // The structure is chosen as if there were pictures without end.
        let workload =
            picture_workload(scene.spheres().len(), &style, columns, rows, f64::INFINITY);
        // Rays to lights are measured whether the scene casts shadows or not.
        let mut casting = scene.clone();
        casting.shadows = true;
        let search = structures.picture(structure, &workload, &view, &casting)?;
        Ok(self.report(&search, &mut watch))
    }

    fn report(&self, search: &PictureSearch<'_>, watch: &mut Watch<'_>) -> Option<Report> {
        let &Self { scene, view, style, size: (columns, rows), machine: (level, threads), .. } =
            self;
        let spheres = scene.spheres();
        let (camera, width, height) = sample_grid(&view, &style, columns, rows);
        let most = most_rays(spheres.len(), search.structure);
        let camera = Rays::of_camera(&camera, width, height, most);
        let coherence = search.coherence;
        let for_camera = Machine { level, threads, coherence, searches: &[search.camera] };
        let for_shadow = Machine { searches: &search.to_lights, ..for_camera };
        watch.go_on(Step::Rays, 0.5)?;
        let shadow = {
            let hits = for_camera.hits(Tier::Exact, &camera);
            let tracing = for_shadow.tracing(Tier::Exact);
            Rays::of_shadows(tracing, (&camera, &hits), spheres, &search.lights, most)
        };
        let tracing = for_camera.tracing(Tier::Exact);
        let orders = Orders::count(tracing, threads, spheres, &view, &camera, watch)?;
        let scene_lit = (spheres, &*search.lights);
        let lighting =
            lighting::errors([&for_camera, &for_shadow], &camera, scene_lit, most, watch)?;
        let mut tiers = Vec::new();
        for (machine, rays) in [(&for_camera, &camera), (&for_shadow, &shadow)] {
            if rays.count > 0 {
                tiers.extend(machine.measure(rays, spheres, watch)?);
            }
        }
        Some(Report {
            spheres: spheres.len(),
            cpu: cpu(),
            order: search.order(),
            structure: search.structure,
            level: level.name(),
            lanes: RayPacket::COUNT,
            threads: threads.count(),
            orders,
            tiers,
            lighting,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::builtin::builtin;

    /// Whatever is being done: the first `false` is the last word.
    #[test]
    fn it_stops_wherever_it_is_told_to() {
        let (scene, threads) = (builtin("marbles").expect("marbles"), Threads::default());
        let question = Question {
            scene: &scene,
            view: scene.first_view(1.0),
            style: Style::PLAIN,
            size: (20, 10),
            structure: None,
            machine: (Level::best(), &threads),
        };
        let measure = |watcher: &mut dyn FnMut(Step, f64) -> bool| {
            let mut structures = SceneStructures::new(scene.list(), &threads);
            question.measure(&mut structures, watcher).expect("there is memory")
        };
        let mut told = Vec::new();
        let whole = measure(&mut |step, share| {
            told.push((step, share));
            true
        });
        assert_eq!(whole.expect("it is not ended").tiers.len(), 2 * Tier::ALL.len());
        let shares = told.iter().map(|(_, share)| share);
        assert!(shares.is_sorted() && told.iter().all(|(_, share)| (0.0..=1.0).contains(share)));
        for end in [Step::Rays, Step::Orders, Step::Lighting, Step::Camera, Step::Shadow] {
            let mut last = None;
            let stopped = measure(&mut |step, _| {
                assert_eq!(last.filter(|&last| last >= end), None, "told after its end");
                last = Some(step);
                step < end
            });
            assert!(stopped.is_none() && last == Some(end), "{end:?}");
        }
    }
}
