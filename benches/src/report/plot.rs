//! Speed against error as a picture: some regimes side by side, ulp of t above, wrong decisions
//! below; further left is faster, further down is righter.

use crate::report::contender::{Contender, Engine};
use crate::report::error::{NamedErrors, RegimeError};
use crate::report::machine::Machine;
use crate::report::speed::{Speed, Workload};
use plotters::coord::Shift;
use plotters::prelude::*;

/// The columns.
const REGIMES: [&str; 5] =
    ["ordinary", "dist/r 1e4", "grazing 2^-20", "inside near surface", "planet r 6.4e6"];
/// What the time on the horizontal axes is of.
const WORKLOAD: Workload = Workload::ALL[0];
const SIZE: (u32, u32) = (1500, 860);
const HEAD: u32 = 110;
/// Zero has no place on a logarithmic axis: it gets a band under it, this part of its height, in
/// which every name has a row of its own.
const BAND: f64 = 0.3;

type Error = Box<dyn std::error::Error>;
type Panel<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// What a row shows: its name, the top of its axis, and where the figure is found.
type Row = (&'static str, f64, fn(&RegimeError) -> f64);

/// A name's colour, told apart also by the colour-blind (Okabe and Ito), for tiers to come too.
fn colour(index: usize) -> RGBColor {
    const COLOURS: [RGBColor; 7] = [
        RGBColor(213, 94, 0),
        RGBColor(0, 114, 178),
        RGBColor(0, 158, 115),
        RGBColor(110, 110, 110),
        RGBColor(204, 121, 167),
        RGBColor(230, 159, 0),
        RGBColor(86, 180, 233),
    ];
    COLOURS[index % COLOURS.len()]
}

/// A mark: how long a test takes, how wrong it is, in which lanes.
struct Mark {
    time: f64,
    error: f64,
    engine: Engine,
}

/// The picture, as SVG.
///
/// # Errors
/// Where the plotting crate has any; writing to memory has none of its own.
pub fn svg(
    machine: &Machine,
    contenders: &[Contender],
    errors: &[NamedErrors],
    speed: &Speed,
) -> Result<String, Error> {
    let mut text = String::new();
    {
        let root = SVGBackend::with_string(&mut text, SIZE).into_drawing_area();
        root.fill(&WHITE)?;
        let (head, body) = root.split_vertically(HEAD);
        draw_head(&head, machine, errors)?;
        let panels = body.split_evenly((2, REGIMES.len()));
        let times = contenders.iter().map(|c| speed.time(c.name, c.engine, WORKLOAD).middle);
        let ends = times.fold((f64::INFINITY, 0.0), |(low, high): (f64, f64), time| {
            (low.min(time), high.max(time))
        });
        let rows: [Row; 2] = [
            ("p99.9 error of t, ulp", 1e10, |error| error.summary.p999 as f64),
            ("wrong decisions, ppm", 3e6, RegimeError::wrong_ppm),
        ];
        for (row, (label, top, of)) in rows.into_iter().enumerate() {
            for (column, regime) in REGIMES.into_iter().enumerate() {
                let of_regime = |entry: &NamedErrors| {
                    entry.regimes.iter().find(|error| error.regime == regime).map_or(0.0, of)
                };
                let marks: Vec<Vec<Mark>> = errors
                    .iter()
                    .enumerate()
                    .map(|(index, entry)| {
                        let row = (index as f64 + 0.7) / (errors.len() as f64 + 0.4);
                        let error = match of_regime(entry) {
                            0.0 => top.powf(-BAND * row),
                            error => error,
                        };
                        let own = contenders.iter().filter(|c| c.name == entry.name);
                        own.map(|&Contender { name, engine, .. }| Mark {
                            time: speed.time(name, engine, WORKLOAD).middle,
                            error,
                            engine,
                        })
                        .collect()
                    })
                    .collect();
                let title = format!("{regime}: {label}");
                draw_panel(&panels[row * REGIMES.len() + column], &title, ends, top, &marks)?;
            }
        }
        root.present()?;
    }
    Ok(text)
}

fn draw_head(head: &Panel<'_>, machine: &Machine, errors: &[NamedErrors]) -> Result<(), Error> {
    let title =
        format!("Speed against error, {} build: left is faster, down is righter", machine.build());
    head.draw_text(&title, &("sans-serif", 24).into_text_style(head), (16, 10))?;
    let small = ("sans-serif", 15).into_text_style(head);
    let source = format!("{}, {}, commit {}", machine.cpu, machine.rustc, machine.commit);
    head.draw_text(&source, &small, (16, 42))?;
    let mut x = 24;
    for (index, entry) in errors.iter().enumerate() {
        head.draw(&Circle::new((x, 84), 7, colour(index).filled()))?;
        head.draw_text(entry.name, &("sans-serif", 18).into_text_style(head), (x + 14, 74))?;
        x += 50 + 10 * entry.name.len() as i32;
    }
    let lanes = "size: 1, 4, 8, 16 lanes; ring: instructions chosen at run time; \
                 the error is the same in all lanes";
    head.draw_text(lanes, &small, (x + 10, 76))?;
    Ok(())
}

fn draw_panel(
    panel: &Panel<'_>,
    title: &str,
    (least, most): (f64, f64),
    top: f64,
    marks: &[Vec<Mark>],
) -> Result<(), Error> {
    let mut chart = ChartBuilder::on(panel)
        .caption(title, ("sans-serif", 16))
        .margin(8)
        .x_label_area_size(42)
        .y_label_area_size(48)
        .build_cartesian_2d(
            (least / 1.4..most * 1.4).log_scale().base(2.0),
            (top.powf(-BAND)..top).log_scale(),
        )?;
    chart
        .configure_mesh()
        .light_line_style(WHITE)
        .bold_line_style(RGBColor(225, 225, 225))
        .x_desc(format!("ns a ray-sphere test ({WORKLOAD})"))
        .x_labels(8)
        .y_labels(8)
        .x_label_formatter(&|time| format!("{time}"))
        .y_label_formatter(&|error| scale_label(*error))
        .label_style(("sans-serif", 13))
        .axis_desc_style(("sans-serif", 14))
        .draw()?;
    let band = [(least / 1.4, top.powf(-BAND)), (most * 1.4, top.powf(-BAND * 0.08))];
    chart.draw_series(core::iter::once(Rectangle::new(band, RGBColor(232, 240, 236).filled())))?;
    let label = ("sans-serif", 15).into_text_style(panel).color(&RGBColor(60, 60, 60));
    let place = (most * 1.1, top.powf(-BAND * 0.4));
    chart.draw_series(core::iter::once(Text::new("0", place, label)))?;

    for (index, own) in marks.iter().enumerate() {
        let colour = colour(index);
        let line = own.iter().filter(|mark| mark.engine.level == Engine::BUILD);
        let line = line.map(|mark| (mark.time, mark.error));
        chart.draw_series(LineSeries::new(line, colour.mix(0.5)))?;
        chart.draw_series(own.iter().map(|mark| {
            let at_run_time = mark.engine.level != Engine::BUILD;
            let style = if at_run_time { colour.stroke_width(2) } else { colour.mix(0.8).filled() };
            Circle::new((mark.time, mark.error), size(mark.engine.count), style)
        }))?;
    }
    Ok(())
}

/// The radius of a mark.
const fn size(lanes: usize) -> i32 {
    match lanes {
        0..4 => 3,
        4..8 => 5,
        8..16 => 7,
        _ => 9,
    }
}

fn scale_label(error: f64) -> String {
    if error < 1.0 {
        String::new()
    } else if error < 1e4 {
        format!("{error:.0}")
    } else {
        format!("{error:.0e}")
    }
}
