use super::*;
use crate::structure::object_order::Counts;
use crate::structure::{Order, Structure};
use crate::tally::{Summary, Ulp};
use crate::tradeoff::orders::Orders;
use spherule_kernel::{LevelName, Stages};

/// Times 1, 2, 3 and 4 times as long; wrong rays and ulp of all sizes.
fn report(kinds: &[&'static str]) -> Report {
    let wrong = [403_620, 1, 65_536, 0];
    let ulp = [Some(8769), Some(1 << 31), None, Some(0)];
    let tiers = kinds.iter().flat_map(|&rays_kind| {
        (0..4).map(move |index| TierReport {
            tier: Tier::ALL[index],
            rays_kind,
            rays: 1_000_000,
            seconds: 0.0125 * (index + 1) as f64,
            errors: Summary {
                rays: 1_000_000,
                wrong_hits: wrong[index] / 2,
                wrong_misses: wrong[index] - wrong[index] / 2,
                ulp: ulp[index].map(|max| Ulp { median: 0, p999: 0, max }),
                ..Summary::default()
            },
            stages: Stages::default(),
        })
    });
    Report {
        spheres: 24,
        cpu: String::new(),
        order: Order::Image,
        structure: Structure::Bvh,
        level: LevelName::Avx2,
        lanes: 16,
        threads: 1,
        orders: Orders { image: Counts::default(), object: Counts::default() },
        tiers: tiers.collect(),
        lighting: None,
    }
}

const BOTH: [&str; 2] = ["camera", "shadow"];

fn style(charset: Charset, depth: ColorDepth) -> Style {
    Style { charset, depth, ..Style::PLAIN }
}

/// What is written over a picture of dots, and the row below it.
fn written(style: &Style, (columns, rows): (u16, u16), standing: &Standing) -> CellGrid {
    let mut cells = CellGrid::new(columns, rows + 1);
    for row in 0..=rows {
        cells.write(0, row, &".".repeat(columns.into()), Color::Default, Color::Default);
    }
    write(&mut cells, rows, style, standing);
    assert!(cells.row(rows).iter().all(|cell| cell.glyph == '.'), "over the row below");
    cells
}

#[test]
fn in_ascii_over_the_lower_left() {
    let standing = Standing::Done(report(&BOTH));
    let cells = written(&Style::PLAIN, (81, 14), &standing);
    let expected = [
        ".................................................................................",
        " 24 spheres, bvh; avx2, 1 thread                                               ..",
        "            ns a ray            wrong in a million   largest ulp of t          ..",
        " 1,000,000 camera rays                                                         ..",
        " fast         12.5 ###          403,620 ##########           8,769 ######      ..",
        " geometric    25.0 ######             1 #            2,147,483,648 ########### ..",
        " stable       37.5 ########      65,536 #########                -             ..",
        " exact        50.0 ###########        0                          0             ..",
        " 1,000,000 shadow rays, from where exact starts them                           ..",
        " fast         12.5 ###          403,620 ##########           8,769 ######      ..",
        " geometric    25.0 ######             1 #            2,147,483,648 ########### ..",
        " stable       37.5 ########      65,536 #########                -             ..",
        " exact        50.0 ###########        0                          0             ..",
        " bars of wrong and ulp: logarithms, full at 10^6 and 2^24                      ..",
    ];
    assert_eq!(cells.lines()[..14], expected.map(str::to_owned));
}

/// What the box says is what the report says, tier by tier, however wide it is.
#[test]
fn the_numbers_are_read_back() {
    let (report, done) = (report(&BOTH), Standing::Done(report(&BOTH)));
    for columns in [64, 80, 100, 200] {
        for charset in [Charset::Ascii, Charset::Half, Charset::Block] {
            let style = style(charset, ColorDepth::Truecolor);
            let lines = written(&style, (columns, 20), &done).lines();
            let rows = lines.iter().filter(|line| {
                Tier::ALL.iter().any(|tier| line.starts_with(&format!(" {} ", tier.as_str())))
            });
            let read = rows.map(|line| {
                let words = line.split([' ', '#', '.']).filter(|word| !word.is_empty());
                words
                    .map(|word| word.replace(',', ""))
                    .filter(|word| word.is_ascii())
                    .collect::<Vec<_>>()
            });
            for (read, tier) in read.zip(&report.tiers) {
                let ns = format!("{:.1}", tier.ns_per_ray());
                let (whole, tenth) = ns.split_once('.').expect("a decimal");
                let ulp = tier.errors.ulp.map_or_else(|| "-".to_owned(), |ulp| ulp.max.to_string());
                let wrong = tier.wrong_in_a_million().to_string();
                let said = [tier.tier.as_str(), whole, tenth, &wrong, &ulp];
                assert_eq!(read, said, "{columns} {charset:?}: {lines:?}");
            }
        }
    }
}

#[test]
fn without_colour_there_is_none_and_in_ascii_nothing_else() {
    let standings = [
        Standing::Waiting,
        Standing::Underway(Step::Camera, 0.5),
        Standing::Done(report(&BOTH)),
        Standing::Failed("no memory".to_owned()),
    ];
    for standing in standings {
        for charset in [Charset::Ascii, Charset::Half, Charset::Braille, Charset::Block] {
            for depth in [ColorDepth::Never, ColorDepth::Ansi16, ColorDepth::Truecolor] {
                let cells = written(&style(charset, depth), (80, 23), &standing);
                let colored = cells.cells().iter().any(|cell| cell.foreground != Color::Default);
                let has_bars = matches!(standing, Standing::Underway(..) | Standing::Done(_));
                assert_eq!(colored, depth != ColorDepth::Never && has_bars, "{standing:?}");
                let ascii = cells.lines().concat().is_ascii();
                assert_eq!(ascii, charset == Charset::Ascii || !has_bars, "{standing:?}");
            }
        }
    }
}

#[test]
fn what_is_too_small_says_what_it_needs_and_shows_what_fits() {
    let done = Standing::Done(report(&BOTH));
    let text = |size| written(&Style::PLAIN, size, &done).lines().join("\n");
    assert!(text((80, 13)).contains("1,000,000 shadow") && !text((80, 13)).contains("needs"));
    let low = text((80, 9));
    assert!(low.contains(" table needs 80x13, has 80x9 "), "{low}");
    assert!(low.contains(" exact ") && !low.contains("logarithms"), "{low}");
    let narrow = text((40, 20));
    assert!(narrow.contains(" table needs 64x20, has 40x20 "), "{narrow}");
    assert!(narrow.contains(" geometric    25.0 ##  "), "{narrow}");
    for columns in [1, 2, 9, 40, 300] {
        for rows in 0..20 {
            written(&Style::PLAIN, (columns, rows), &done);
            written(&Style::PLAIN, (columns, rows), &Standing::Underway(Step::Orders, 0.3));
        }
    }
    assert_eq!(text((1, 1)), " \n.");
}

#[test]
fn bars_are_as_long_as_their_share() {
    for (charset, steps) in [(Charset::Ascii, 1), (Charset::Octant, 2), (Charset::Block, 8)] {
        let style = style(charset, ColorDepth::Never);
        let length = |share| {
            let bar = bar(&style, share, 10);
            assert_eq!(bar.chars().count(), 10);
            let full = if charset == Charset::Ascii { '#' } else { '█' };
            let whole = bar.chars().filter(|&part| part == full).count();
            let rest = bar.trim_end().chars().count() - whole;
            assert!(rest <= usize::from(steps > 1), "{bar}");
            (whole, rest)
        };
        assert_eq!((length(0.0), length(1.0), length(9.0)), ((0, 0), (10, 0), (10, 0)));
        assert_eq!(length(1e-9), if steps > 1 { (0, 1) } else { (1, 0) });
        assert_eq!(length(0.55), if steps > 1 { (5, 1) } else { (6, 0) });
    }
}

#[test]
fn how_far_it_is_is_told() {
    let cells = written(&Style::PLAIN, (60, 4), &Standing::Underway(Step::Camera, 0.4));
    let [_, _, doing, way, _] = &cells.lines()[..] else { panic!("five rows") };
    assert_eq!(doing, " measuring camera rays                           ...........");
    assert_eq!(way, " ############                    40 %  Esc stops ...........");
}
