//! The scorer against cases worked by hand, and against figures of another program.

use spherule_tests::art::cell::{Coverage, HEIGHT, WIDTH};
use spherule_tests::art::figures::{Figures, Truth};
use spherule_tests::art::font::Font;
use spherule_tests::art::light::Light;
use spherule_tests::art::palette::{Rgb, sixteen, xterm};
use spherule_tests::art::screen::{Screen, Shown};
use spherule_tests::art::{geometry, score};
use std::collections::BTreeSet;
use std::fs::File;
use std::ops::Range;

fn read(text: &str, columns: u16, rows: u16) -> Result<Vec<Shown>, String> {
    Screen::read(text.as_bytes(), columns, rows, &xterm()).map(|screen| screen.cells)
}

/// Colours that differ everywhere, in 4x2 cells.
fn slope() -> Truth {
    let places = (0..32).flat_map(|y| (0..32).map(move |x| (x, y)));
    let colors = places.map(|(x, y)| [8 * x, 8 * y, 4 * (x + y)]);
    Truth::new(&Light::of_colors(32, colors)).expect("whole cells")
}

/// Truecolor, 256 and 16 colours, inverse; blocks, a sextant, shade, dots, letters.
const CAPTURE: &str = "\x1b[38;2;200;40;90;48;2;10;20;30m▀▖\x1b[38;5;208;48;5;19m🬗▓\x1b[0m\n\
                       \x1b[31;104m⣷A\x1b[7m▊\x1b[0mg\n";

#[test]
fn figures_are_those_of_another_program() {
    // By a NumPy and FreeType program with the same definitions; FreeType's curves are coarser.
    for (font, far, near, correlation, tolerance) in [
        (Font::Unifont, 11.659_418, 8.180_993, 0.511_632, 2e-4),
        (Font::DejaVuSansMono, 11.498_753, 8.609_865, 0.422_543, 2e-2),
    ] {
        let figures = score(CAPTURE.as_bytes(), &slope(), &xterm(), font).expect("a picture");
        let differences =
            [figures.far - far, figures.near - near, figures.correlation - correlation];
        assert!(differences.iter().all(|x| x.abs() < tolerance), "{font:?}: {figures:?}");
    }
}

#[test]
fn a_picture_that_cells_can_show_is_met() {
    let (red, blue) = ([200, 30, 20], [20, 40, 160]);
    let colors = (0..HEIGHT * WIDTH).map(|i| if i < HEIGHT / 2 * WIDTH { red } else { blue });
    let truth = Truth::new(&Light::of_colors(WIDTH, colors)).expect("a cell");
    let upper = "\x1b[38;2;200;30;20;48;2;20;40;160m▀\n";
    let lower = "\x1b[38;2;20;40;160;48;2;200;30;20m▄\n";
    for text in [upper, lower] {
        let figures = score(text.as_bytes(), &truth, &xterm(), Font::Unifont).expect("a picture");
        assert_eq!((figures.far, figures.near), (120.0, 120.0));
        assert!((figures.correlation - 1.0).abs() < 1e-9);
    }
    // The control: the two halves are swapped.
    let wrong = upper.replace('▀', "▄");
    let figures = score(wrong.as_bytes(), &truth, &xterm(), Font::Unifont).expect("a picture");
    assert!(figures.far < 20.0 && figures.near < 15.0, "{figures:?}");
    assert!(figures.correlation < -0.9, "{figures:?}");
}

#[test]
fn black_for_white_is_no_decibel() {
    let truth =
        |color: Rgb| Truth::new(&Light::of_colors(16, vec![color; 16 * 32])).expect("whole cells");
    let black = Light::of_colors(16, vec![[0; 3]; 16 * 32]);
    let Figures { far, near, correlation, .. } = truth([255; 3]).figures(&black);
    assert!(far.abs() < 1e-4 && near.abs() < 1e-4, "{far} {near}");
    assert_eq!(correlation, 0.0);
    assert_eq!(truth([0; 3]).figures(&black).far, 120.0);
}

#[test]
fn a_point_is_blurred_into_a_bell() {
    let mut light = Light::of_colors(64, vec![[0; 3]; 64 * 64]);
    light.pixels[32 * 64 + 20] = [1.0, 0.5, 0.0];
    let blurred = light.blurred(4.0);
    let at = |x: usize, y: usize| f64::from(blurred.pixels[y * 64 + x][0]);
    let peak = 1.0 / (2.0 * std::f64::consts::PI * 16.0);
    assert!((at(20, 32) / peak - 1.0).abs() < 0.01);
    assert!((at(24, 32) / at(20, 32) - (-0.5_f64).exp()).abs() < 1e-4);
    assert!((at(20, 28) - at(24, 32)).abs() < 1e-9 && at(20, 45) == 0.0);
    let sum: f64 = blurred.pixels.iter().map(|pixel| f64::from(pixel[0])).sum();
    assert!((sum - 1.0).abs() < 1e-4);
    // An edge loses no light.
    let even = Light::of_colors(24, vec![[100; 3]; 24 * 16]);
    let most = even.pixels[0][0];
    assert!(even.blurred(4.0).pixels.iter().all(|pixel| (pixel[0] - most).abs() < 1e-6));
}

#[test]
fn a_screen_has_every_kind_of_colour() {
    let cell = |glyph, ink, behind| Shown { glyph, ink, behind };
    let text = "a\x1b[33;101mb\x1b[38;5;208;48;5;250mc\x1b[38;2;1;2;3;48;2;4;5;6m\u{1cd00}\x1b[7m🬀\x1b[m\n";
    let expected = [
        cell('a', [229; 3], [0; 3]),
        cell('b', [205, 205, 0], [255, 0, 0]),
        cell('c', [255, 135, 0], [188; 3]),
        cell('\u{1cd00}', [1, 2, 3], [4, 5, 6]),
        cell('\u{1fb00}', [4, 5, 6], [1, 2, 3]),
    ];
    assert_eq!(read(text, 5, 1).expect("a screen"), expected);
    for theme in ["vga", "tango", "solarized"] {
        let palette = sixteen(theme).expect("a known theme");
        let screen = Screen::read("\x1b[31mr\x1b[38;5;231mw\n".as_bytes(), 2, 1, &palette);
        let [red, white] = &screen.expect("a screen").cells[..] else { panic!("two cells") };
        let [most, green, blue] = red.ink;
        assert!(most > 2 * green.max(blue) && white.ink == [255; 3], "{theme}");
    }
    assert_eq!(sixteen("no theme"), None);
    let [first, .., last] = &read("▀▄\n\x1b[7m \x1b[0m█\n", 2, 2).expect("a screen")[..]
    else {
        panic!("four cells");
    };
    assert_eq!((first.glyph, last.glyph), ('▀', '█'));
}

#[test]
fn half_a_picture_is_no_picture() {
    for wrong in [
        "ab\n",            // a row is missing
        "ab\nab\nab\n",    // a row too many
        "abc\nabc\n",      // a row too long
        "ab\nab\n\x1b[>q", // an escape that no one here knows
        "ab\na\u{fffd}\n", // bytes that are no UTF-8
        "全\nab\n",        // a wide character
        "a\u{301}b\nab\n", // two characters in a cell
    ] {
        assert!(read(wrong, 2, 2).is_err(), "{wrong:?}");
    }
    assert!(read("ab\nab\n", 2, 2).is_ok());
    let truth = Truth::new(&Light::of_colors(8, vec![[0; 3]; 128])).expect("a cell");
    let unknown = score("\u{10fffd}\n".as_bytes(), &truth, &xterm(), Font::Unifont);
    assert!(unknown.is_err());
}

/// Which of 2 x `rows` equal parts are covered; `None` if one is partly covered.
fn parts(coverage: &Coverage, rows: usize) -> Option<u8> {
    let mut bits = 0_u8;
    for part in 0..2 * rows {
        // A thin line through the middle of the part tells whether the part is covered.
        let (x, y) = (part % 2 * 4, (part / 2 * HEIGHT + HEIGHT / 2) / rows);
        let line = &coverage[y * WIDTH + x..][..4];
        match line {
            [1.0, 1.0, 1.0, 1.0] => bits |= 1 << part,
            [0.0, 0.0, 0.0, 0.0] => (),
            _ => return None,
        }
    }
    // The area shows that nothing else is covered.
    let area: f32 = coverage.iter().sum();
    let whole = bits.count_ones() as f32 * (WIDTH * HEIGHT) as f32 / (2 * rows) as f32;
    ((area - whole).abs() < 1e-3).then_some(bits)
}

#[test]
fn every_mosaic_is_there() {
    let all = || {
        ['\u{20}', '\u{a0}']
            .into_iter()
            .chain('\u{2580}'..='\u{259f}')
            .chain('\u{1cd00}'..='\u{1ceaf}')
            .chain('\u{1fb00}'..='\u{1fbff}')
    };
    for (rows, count) in [(2, 16), (3, 64), (4, 256)] {
        let known = all().filter_map(geometry::coverage);
        let masks: BTreeSet<u8> = known.filter_map(|coverage| parts(&coverage, rows)).collect();
        assert_eq!(masks.len(), count, "2 x {rows}");
    }
    // Characters are numbered row by row: octant 3 is the left of the second row.
    let octant = geometry::coverage('\u{1cd00}').expect("octant 3");
    assert_eq!(parts(&octant, 4), Some(0b100));
    let sextant = geometry::coverage('\u{1fb02}').expect("sextant 12");
    assert_eq!(parts(&sextant, 3), Some(0b11));
}

#[test]
fn eighths_are_at_their_sides() {
    let share = |character, part: fn(usize, usize) -> bool| {
        let coverage = geometry::coverage(character).expect("a block");
        let pixels = (0..WIDTH * HEIGHT).filter(|pixel| part(pixel % WIDTH, pixel / WIDTH));
        pixels.map(|pixel| coverage[pixel]).sum::<f32>() / coverage.iter().sum::<f32>()
    };
    let area = |character| geometry::coverage(character).expect("a block").iter().sum::<f32>();
    for (i, lower) in ('▁'..='█').enumerate() {
        assert_eq!(area(lower), 16.0 * (i + 1) as f32);
    }
    for (i, left) in ('█'..='▏').enumerate() {
        assert_eq!(area(left), 16.0 * (8 - i) as f32);
    }
    for (character, part) in [
        ('▁', (|_, y| y >= 14) as fn(usize, usize) -> bool),
        ('▔', |_, y| y < 2),
        ('▏', |x, _| x < 1),
        ('▕', |x, _| x >= 7),
        ('\u{1fb83}', |_, y| y < 6),
        ('\u{1fb88}', |x, _| x >= 5),
        ('\u{1fb71}', |x, _| x == 2),
        ('\u{1fb77}', |_, y| y / 2 == 2),
        ('\u{1fbe6}', |x, y| x < 4 && (4..12).contains(&y)),
        ('\u{1cea0}', |x, y| x >= 4 && y >= 12),
    ] {
        assert_eq!(share(character, part), 1.0, "{character:?}");
    }
    assert_eq!([area('░'), area('▒'), area('▓')], [32.0, 64.0, 96.0]);
}

#[test]
fn letters_are_in_their_cells() {
    for font in Font::ALL {
        let ink = |character| {
            let coverage = font.coverage(character).expect("a glyph");
            coverage.iter().sum::<f32>()
        };
        assert_eq!(ink(' '), 0.0, "{font:?}");
        // An L has ink at the left side and the foot, and a T at neither: fonts are not read
        // mirrored.
        let [l, t] = ['L', 'T'].map(|character| font.coverage(character).expect("a glyph"));
        let part = |coverage: &Coverage, columns: Range<usize>, rows: Range<usize>| {
            let places = rows.flat_map(|y| columns.clone().map(move |x| y * WIDTH + x));
            places.map(|pixel| coverage[pixel]).sum::<f32>()
        };
        assert!(part(&l, 0..4, 4..10) > 3.0 && part(&l, 4..8, 4..9) < 1.0, "{font:?}");
        assert!(part(&l, 4..8, 9..14) > 2.0 && part(&t, 0..2, 8..16) < 1.0, "{font:?}");
        assert!(ink('-') > 2.0 && ink('@') > 2.0 * ink('-'), "{font:?}");
        // An underline is whole: no row is cut.
        assert!(ink('_') > 6.0, "{font:?}");
        // Unifont marks the places of dots that are off.
        let dots = |character| ink(character) - ink('\u{2800}');
        assert!(dots('\u{2801}') > 2.0 && dots('\u{2847}') == 4.0 * dots('\u{2801}'), "{font:?}");
        assert_eq!(font.coverage('\u{10fffd}'), None);
    }
}

#[test]
fn a_png_is_read_as_it_was_written() {
    let path = std::env::temp_dir().join(format!("spherule-art-{}.png", std::process::id()));
    let colors: Vec<Rgb> = (0..16 * 32).map(|i: u32| [i as u8, (i / 3) as u8, 7]).collect();
    let write = |kind| {
        let mut encoder = png::Encoder::new(File::create(&path).expect("a file"), 16, 32);
        encoder.set_color(kind);
        let mut writer = encoder.write_header().expect("a header");
        let bytes = colors.as_flattened();
        let count = 16 * 32 * kind.samples();
        writer.write_image_data(&bytes[..count]).expect("pixels");
    };
    write(png::ColorType::Rgb);
    let light = Light::read_png(&path).expect("a picture");
    write(png::ColorType::Grayscale);
    let grey = Light::read_png(&path);
    let _ = std::fs::remove_file(&path);
    assert_eq!(light, Light::of_colors(16, colors.iter().copied()));
    assert_eq!(light.height(), 32);
    assert!(grey.is_err() && Light::read_png(&path).is_err());
    assert!(Truth::new(&Light::of_colors(15, vec![[0; 3]; 15 * 32])).is_err());
}
