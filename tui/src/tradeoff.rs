//! `spherule tradeoff`: what every tier costs on a scene, and how wrong it is there.
//!
//! The rays are those that a picture of the scene takes; the truth is what `Exact` says.

mod errors;
mod progress;
mod rays;
mod report;
mod speed;

use crate::arguments::TradeoffArguments;
use crate::draw::{AccuracyChoice, Charset, ColorDepth, Style, picture_aspect, sample_grid};
use crate::failure::{Failure, write_stdout};
use crate::show::{PIPE_SIZE, USUAL_ASPECT};
use crate::{machine, scene, view};
use errors::Errors;
use progress::Progress;
use rays::Rays;
use report::{Report, Tier};
use spherule_kernel::dispatch::{Level, Packet, any, nearest};
use spherule_kernel::{
    Accuracy, Exact, Fast, HitPacket, Lanes, Question, Spheres, Stable, Stages, stages,
};
use std::hint::black_box;

/// Measures, and prints what was found.
///
/// # Errors
/// [`Failure`] where there is no such scene, or nobody to tell.
pub fn tradeoff(arguments: &TradeoffArguments) -> Result<(), Failure> {
    let scene = scene::open::open(&arguments.scene, arguments.format)
        .map_err(|error| Failure::Input(error.to_string()))?;
    let level = arguments.level.unwrap_or_else(Level::best);
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
    let (camera, width, height) = sample_grid(&view, &style, columns, rows);
    let camera = Rays::of_camera(&camera, width, height, spheres.len());
    let shadow = Rays::of_shadows(&camera, &scene, level);
    let mut progress = Progress::new();
    let mut tiers = Vec::new();
    for (rays, kind, question) in
        [(&camera, "camera", Question::Nearest), (&shadow, "shadow", Question::Any)]
    {
        if rays.count > 0 {
            tiers.extend(measure(rays, kind, question, spheres, level, &mut progress));
        }
    }
    drop(progress);

    let report = Report {
        scene: arguments.scene.clone(),
        spheres: spheres.len(),
        cpu: machine::cpu(),
        rustc: machine::RUSTC,
        level: level.name(),
        lanes: Packet::COUNT,
        tiers,
    };
    let text = if arguments.json { report.json() } else { report.table() };
    write_stdout(text.as_bytes())
}

/// Every tier on these rays.
fn measure(
    rays: &Rays,
    kind: &'static str,
    question: Question,
    spheres: Spheres<'_>,
    level: Level,
    progress: &mut Progress,
) -> [Tier; 3] {
    let mut passes = (
        pass::<Fast>(rays, question, spheres, level),
        pass::<Stable>(rays, question, spheres, level),
        pass::<Exact>(rays, question, spheres, level),
    );
    let seconds = speed::medians([&mut passes.0, &mut passes.1, &mut passes.2], |share| {
        progress.show(&format!("{kind} rays"), share);
    });
    let truth = hits::<Exact>(rays, spheres, level);
    let errors = [
        Errors::new(&hits::<Fast>(rays, spheres, level), &truth),
        Errors::new(&hits::<Stable>(rays, spheres, level), &truth),
        Errors::new(&truth, &truth),
    ];
    let exact = stages::<Packet>((), &rays.packets, spheres, question);
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

/// What is timed: the kernel's call that answers the question for all rays.
fn pass<'a, A: Accuracy>(
    rays: &'a Rays,
    question: Question,
    spheres: Spheres<'a>,
    level: Level,
) -> impl FnMut() + 'a {
    let mut hits = vec![HitPacket::<Packet>::none(); rays.packets.len()];
    let mut met = vec![0; rays.packets.len()];
    move || match question {
        Question::Nearest => {
            nearest::<A>(level, &rays.packets, spheres, &mut hits);
            black_box(&hits);
        }
        Question::Any => {
            any::<A>(level, &rays.packets, spheres, &mut met);
            black_box(&met);
        }
    }
}

/// The nearest hits of a tier.
fn hits<A: Accuracy>(rays: &Rays, spheres: Spheres<'_>, level: Level) -> Vec<HitPacket<Packet>> {
    let mut hits = vec![HitPacket::<Packet>::none(); rays.packets.len()];
    nearest::<A>(level, &rays.packets, spheres, &mut hits);
    hits
}
