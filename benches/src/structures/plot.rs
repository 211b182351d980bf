//! Growth as a picture: rays a second above, the build below, by the number of spheres.

use crate::report::machine::Machine;
use crate::scenes::Kind;
use crate::structures::build::{EMBREE, OURS};
use crate::structures::contender::Way;
use crate::structures::growth::{LINES, Line, Step};
use plotters::coord::Shift;
use plotters::prelude::*;

const SIZE: (u32, u32) = (1100, 560);
const HEAD: u32 = 64;

type Error = Box<dyn std::error::Error>;
type Panel<'a> = DrawingArea<SVGBackend<'a>, Shift>;
/// A name, whether it is another program's, a colour, and a value for numbers of spheres.
type Series = (&'static str, RGBColor, Vec<(f64, f64)>);

const PRIMARY: RGBColor = RGBColor(0, 114, 178);
const DIFFUSE: RGBColor = RGBColor(213, 94, 0);
const TILES: RGBColor = RGBColor(0, 158, 115);
const BRUTE: RGBColor = RGBColor(110, 110, 110);

/// The picture, as SVG.
///
/// # Errors
/// Where the plotting crate has any; writing to memory has none of its own.
pub fn svg(machine: &Machine, steps: &[Step]) -> Result<String, Error> {
    let mut text = String::new();
    {
        let root = SVGBackend::with_string(&mut text, SIZE).into_drawing_area();
        root.fill(&WHITE)?;
        let (head, body) = root.split_vertically(HEAD);
        let title = "Rays a second and time of the build, by the number of spheres";
        head.draw_text(title, &("sans-serif", 22).into_text_style(&head), (16, 8))?;
        let source = format!(
            "uniform spheres, one thread, nearest hit, stable; {}, {} build, commit {}",
            machine.cpu,
            machine.build(),
            machine.commit
        );
        head.draw_text(&source, &("sans-serif", 14).into_text_style(&head), (16, 38))?;
        let (left, right) = body.split_horizontally(SIZE.0 * 3 / 5);
        let rates: Vec<Series> = LINES
            .into_iter()
            .map(|(kind, line, name)| {
                let colour = match (line, kind) {
                    (Line::Ours(Way::Brute), _) => BRUTE,
                    (Line::Ours(Way::Tiles), _) => TILES,
                    (_, Kind::Primary) => PRIMARY,
                    (_, Kind::Diffuse) => DIFFUSE,
                };
                let point = |step: &Step| Some((step.spheres as f64, step.rate(kind, line)?));
                (name, colour, steps.iter().filter_map(point).collect())
            })
            .collect();
        panel(&left, "a million rays a second", &rates)?;
        let builds: Vec<Series> = [(OURS, PRIMARY), (EMBREE, BRUTE)]
            .into_iter()
            .map(|(name, colour)| {
                let seconds = |step: &Step| Some(step.builds.milliseconds(name)? * 1e-3);
                let point = |step: &Step| Some((step.spheres as f64, seconds(step)?));
                (name, colour, steps.iter().filter_map(point).collect())
            })
            .collect();
        panel(&right, "seconds a build", &builds)?;
        root.present()?;
    }
    Ok(text)
}

fn panel(panel: &Panel<'_>, label: &str, series: &[Series]) -> Result<(), Error> {
    let points = || series.iter().flat_map(|(.., points)| points);
    let ends = |of: fn(&(f64, f64)) -> f64| {
        points().map(of).fold((f64::INFINITY, 0.0), |(low, high): (f64, f64), value| {
            (low.min(value), high.max(value))
        })
    };
    let (x, y) = (ends(|point| point.0), ends(|point| point.1));
    // Room on the right for the names.
    let x = (x.0 / 1.3..x.1 * 40.0).log_scale();
    let mut chart = ChartBuilder::on(panel)
        .margin(10)
        .x_label_area_size(44)
        .y_label_area_size(60)
        .build_cartesian_2d(x, (y.0 / 1.6..y.1 * 1.6).log_scale())?;
    chart
        .configure_mesh()
        .light_line_style(WHITE)
        .bold_line_style(RGBColor(225, 225, 225))
        .x_desc("spheres")
        .y_desc(label)
        .x_label_formatter(&|count| format!("1e{:.0}", count.log10()))
        .y_label_formatter(&|value| format!("{value}"))
        .label_style(("sans-serif", 13))
        .axis_desc_style(("sans-serif", 14))
        .draw()?;
    for (name, colour, points) in series {
        // Another program's line is thin, and its marks are rings.
        let others = name.starts_with(EMBREE);
        let line = if others { colour.mix(0.6).stroke_width(1) } else { colour.stroke_width(2) };
        chart.draw_series(LineSeries::new(points.iter().copied(), line))?;
        let mark = if others { colour.stroke_width(2) } else { colour.filled() };
        chart.draw_series(points.iter().map(|&point| Circle::new(point, 4, mark)))?;
        if let Some(&(x, y)) = points.last() {
            let style = ("sans-serif", 14).into_text_style(panel).color(colour);
            chart.draw_series(core::iter::once(Text::new(*name, (x * 1.3, y * 1.08), style)))?;
        }
    }
    Ok(())
}
