//! Charts, as SVG in memory.

use crate::builds::OURS;
use crate::engine::EMBREE;
use crate::structures::OfScene;
use plotters::coord::Shift;
use plotters::prelude::*;

type Outcome<T> = Result<T, Box<dyn std::error::Error>>;
type Panel<'a> = DrawingArea<SVGBackend<'a>, Shift>;
/// A name, a colour, and a value for each number of spheres.
type Series = (&'static str, RGBColor, Vec<(f64, f64)>);

// The colour-blind can tell these colours apart (Okabe and Ito).
const PRIMARY: RGBColor = RGBColor(0, 114, 178);
const DIFFUSE: RGBColor = RGBColor(213, 94, 0);
const DEPTH_LIST: RGBColor = RGBColor(0, 158, 115);
const GREY: RGBColor = RGBColor(110, 110, 110);

/// A title, where the figures come from, and what `body` draws below.
fn chart(
    size: (u32, u32),
    [title, origin]: [&str; 2],
    body: impl FnOnce(&Panel<'_>) -> Outcome<()>,
) -> Outcome<String> {
    let mut text = String::new();
    {
        let root = SVGBackend::with_string(&mut text, size).into_drawing_area();
        root.fill(&WHITE)?;
        let (head, rest) = root.split_vertically(60);
        head.draw_text(title, &("sans-serif", 20).into_text_style(&head), (16, 8))?;
        head.draw_text(origin, &("sans-serif", 12).into_text_style(&head), (16, 36))?;
        body(&rest)?;
        root.present()?;
    }
    Ok(text)
}

/// How many times as fast as Embree the primary and the diffuse rays are: a pair of bars for each scene.
pub(crate) fn embree(origin: &str, scenes: &[OfScene]) -> Outcome<String> {
    let bars: Vec<_> = scenes.iter().map(OfScene::times_embree).collect();
    let most = bars.iter().flat_map(|(_, bars)| bars).flatten().fold(1.0_f64, |a, b| a.max(*b));
    let level = scenes.first().and_then(|scene| scene.measured[0].levels().next()).unwrap_or("");
    let title = format!(
        "Rays a second, as a multiple of Embree's ({level}, stable, closest hit, one thread)"
    );
    chart((1500, 460), [&title, origin], |panel| {
        let mut chart = ChartBuilder::on(panel)
            .margin(10)
            .x_label_area_size(30)
            .y_label_area_size(40)
            .build_cartesian_2d(0.0..bars.len() as f64, 0.0..most * 1.1)?;
        let mut mesh = chart.configure_mesh();
        mesh.disable_x_mesh().light_line_style(WHITE).x_labels(0).draw()?;
        let label = |text: String, at: (f64, f64), colour: &'static RGBColor| {
            Text::new(text, at, ("sans-serif", 14).into_text_style(panel).color(colour))
        };
        let mut labels = Vec::new();
        let kinds = [("primary rays", &PRIMARY), ("diffuse rays", &DIFFUSE)];
        for (bar, (kind, colour)) in kinds.into_iter().enumerate() {
            let below = 0.07 * bar as f64;
            labels.push(label(kind.to_owned(), (0.3, most * (1.05 - below)), colour));
            for (index, (_, times)) in bars.iter().enumerate() {
                let Some(times) = times[bar] else { continue };
                let x = index as f64 + 0.12 + 0.38 * bar as f64;
                let corners = [(x, 0.0), (x + 0.36, times)];
                chart.draw_series([Rectangle::new(corners, colour.filled())])?;
                labels.push(label(format!("{times:.1}"), (x + 0.02, times + 0.05 * most), colour));
            }
        }
        for (index, (name, _)) in bars.iter().enumerate() {
            labels.push(label((*name).to_owned(), (index as f64 + 0.2, -0.03 * most), &BLACK));
        }
        chart.draw_series(labels)?;
        chart.draw_series(LineSeries::new([(0.0, 1.0), (bars.len() as f64, 1.0)], BLACK))?;
        Ok(())
    })
}

/// Rays a second, and beside it the time of the build, by the number of spheres.
pub(crate) fn growth(origin: &str, steps: &[OfScene]) -> Outcome<String> {
    let title = "Rays a second and time of the build, by the number of uniform spheres";
    let series = |name, colour, value: &dyn Fn(&OfScene) -> Option<f64>| -> Series {
        let point = |step: &OfScene| Some((step.spheres as f64, value(step)?));
        (name, colour, steps.iter().filter_map(point).collect())
    };
    let names = steps.first().into_iter().flat_map(|step| step.rates().map(|(name, _)| name));
    let colours = [PRIMARY, DEPTH_LIST, PRIMARY, DIFFUSE, DIFFUSE, GREY];
    let rate = |(line, (name, colour)): (usize, (&'static str, _))| {
        series(name, colour, &|step| step.rates()[line].1)
    };
    let rates: Vec<_> = names.zip(colours).enumerate().map(rate).collect();
    let builds = [(OURS, PRIMARY), (EMBREE, GREY)].map(|(name, colour)| {
        series(name, colour, &|step| {
            let name = if name == EMBREE { step.builds.embree()? } else { name };
            Some(step.builds.milliseconds(name)? * 1e-3)
        })
    });
    chart((1100, 560), [title, origin], |panel| {
        let (left, right) = panel.split_horizontally(660);
        lines(&left, "a million rays a second", &rates)?;
        lines(&right, "seconds a build", &builds)
    })
}

fn lines(panel: &Panel<'_>, label: &str, series: &[Series]) -> Outcome<()> {
    let ends = |of: fn(&(f64, f64)) -> f64| {
        let values = series.iter().flat_map(|(.., points)| points).map(of);
        values.fold((f64::INFINITY, 0.0_f64), |(low, high), x| (low.min(x), high.max(x)))
    };
    let (x, y) = (ends(|point| point.0), ends(|point| point.1));
    // Room on the right for the names.
    let (x, y) = ((x.0 / 1.3..x.1 * 40.0).log_scale(), (y.0 / 1.6..y.1 * 1.6).log_scale());
    let mut chart = ChartBuilder::on(panel)
        .margin(10)
        .x_label_area_size(44)
        .y_label_area_size(60)
        .build_cartesian_2d(x, y)?;
    let mut mesh = chart.configure_mesh();
    mesh.light_line_style(WHITE).x_desc("spheres").y_desc(label).draw()?;
    for (name, colour, points) in series {
        // Another program's line is thin, and its marks are rings.
        let others = name.starts_with(EMBREE);
        let line = if others { colour.mix(0.6).stroke_width(1) } else { colour.stroke_width(2) };
        chart.draw_series(LineSeries::new(points.iter().copied(), line))?;
        let mark = if others { colour.stroke_width(2) } else { colour.filled() };
        chart.draw_series(points.iter().map(|&point| Circle::new(point, 4, mark)))?;
        let style = ("sans-serif", 14).into_text_style(panel).color(colour);
        let name = points.last().map(|&(x, y)| Text::new(*name, (x * 1.3, y * 1.08), style));
        chart.draw_series(name)?;
    }
    Ok(())
}
