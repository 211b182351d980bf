//! `--output`: what terminals are sent in pixels is decoded here, and held against `--png`.

use crate::png::{self, decoded};
use crate::run::{printed, spherule};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use flate2::read::ZlibDecoder;
use spherule::color::{Srgb, oklab};
use spherule::picture::Image;
use spherule::pixels::kitty;
use spherule::pixels::sixel::percent;
use std::io::Read;

fn png(words: &str) -> Image {
    decoded(&png::png(words))
}

/// What a terminal gets by these words.
fn sent(words: &str, tmux: Option<&str>) -> String {
    let mut command = spherule();
    command.args(words.split(' ')).env_remove("TMUX");
    if let Some(tmux) = tmux {
        command.env("TMUX", tmux);
    }
    printed(command.output().expect("the program runs"))
}

/// What is between `begin` and `end`, as often as it is there.
fn strings<'a>(text: &'a str, begin: &str, end: &str) -> Vec<&'a str> {
    text.split(begin).skip(1).map(|part| part.split(end).next().expect("a part")).collect()
}

/// The image of kitty's commands: control data of the first piece, pixels of all.
fn of_kitty(text: &str) -> (String, Image) {
    let pieces = strings(text, "\x1b_G", "\x1b\\");
    let (mut keys, mut payload) = (None, String::new());
    for (place, piece) in pieces.iter().enumerate() {
        let (control, data) = piece.split_once(';').expect("data");
        assert!(data.len() <= 4096 && data.len().is_multiple_of(4), "{}", data.len());
        let is_last = place + 1 == pieces.len();
        assert!(control.ends_with(if is_last { "m=0" } else { "m=1" }), "{control}");
        keys.get_or_insert_with(|| control.to_owned());
        payload += data;
    }
    let keys = keys.expect("a command");
    let number = |name: &str| {
        let key = keys.split(',').find_map(|key| key.strip_prefix(name));
        key.and_then(|value| value.parse().ok()).expect("a number")
    };
    let mut rgb = Vec::new();
    let deflated = STANDARD.decode(payload).expect("base64");
    ZlibDecoder::new(&deflated[..]).read_to_end(&mut rgb).expect("zlib");
    let image = Image { width: number("s="), height: number("v="), rgb };
    (keys, image)
}

const WORDS: &str = "marbles --size 30x9";

#[test]
fn kitty_gets_the_pixels_of_the_png() {
    let text = sent(&format!("{WORDS} --output kitty"), None);
    let (keys, image) = of_kitty(&text);
    assert!(image == png(WORDS), "other pixels");
    for key in ["a=T", "f=24", "o=z", "c=30", "r=9"] {
        assert!(keys.split(',').any(|own| own == key), "{key} in {keys}");
    }
    // The cursor stays, in the first of as many rows, and then goes below them.
    assert!(keys.split(',').any(|key| key == "C=1"), "{keys}");
    assert!(text.starts_with(&format!("{}\x1b[8A\x1b_G", "\n".repeat(8))));
    assert!(text.ends_with("\x1b\\\x1b[8B\n"));
    let wide = "marbles --size 12x20 --cell-aspect 3:1";
    let text = sent(&format!("{wide} --output kitty"), None);
    assert!(of_kitty(&text).1 == png(wide), "other pixels of wide cells");
    let row = sent("marbles --size 30x1 --output kitty", None);
    assert!(row.starts_with("\x1b_G") && row.ends_with("\x1b\\\n"), "{row:?}");
}

/// A picture that is higher than the usual screen would go out at its top: there the terminal itself moves the cursor.
#[test]
fn a_screen_that_is_not_known_has_the_rows_of_a_picture_in_a_pipe() {
    for (rows, stays) in [(24, true), (25, false), (60, false)] {
        let words = format!("marbles --size 6x{rows} --output kitty");
        let text = sent(&words, None);
        let (keys, _) = of_kitty(&text);
        assert_eq!(keys.split(',').any(|key| key == "C=1"), stays, "{rows}: {keys}");
        assert_eq!(text.starts_with('\n'), stays, "{rows}");
    }
}

/// Commands are wrapped for the terminal behind tmux; placeholders tell where the image is.
#[test]
fn under_tmux_there_are_placeholders() {
    let words = format!("{WORDS} --output kitty");
    let text = sent(&words, Some("/tmp/tmux,1,0"));
    let (wrapped, cells) = text.rsplit_once("\x1b\\\x1b\\").expect("a wrapped command");
    let inside = format!("{wrapped}\x1b\\\x1b\\");
    let unwrapped: String = strings(&inside, "\x1bPtmux;", "\x1b\\\x1b\\")
        .iter()
        .map(|part| format!("{part}\x1b\\").replace("\x1b\x1b", "\x1b").replace("\x1b\x1b", "\x1b"))
        .collect();
    let (keys, image) = of_kitty(&unwrapped);
    assert!(image == png(WORDS), "other pixels");
    assert!(keys.split(',').any(|key| key == "U=1"), "{keys}");
    // The next picture leaves this one where it is, and so does the viewer.
    let number_of = |text: &str| {
        let mut keys = text.split(',').filter_map(|key| key.strip_prefix("i="));
        keys.next().and_then(|number| number.parse::<u32>().ok()).expect("a number")
    };
    let again = sent(&words, Some("/tmp/tmux,1,0"));
    let (number, next) = (number_of(&keys), number_of(&again));
    assert!(number != next && !kitty::NUMBERS.contains(&number), "{number}, {next}");
    let rows: Vec<&str> = cells.trim_end_matches('\n').split('\n').collect();
    assert_eq!(rows.len(), 9);
    for (row, mark) in
        rows.iter().zip("\u{305}\u{30d}\u{30e}\u{310}\u{312}\u{33d}\u{33e}\u{33f}\u{346}".chars())
    {
        assert_eq!(row.matches('\u{10EEEE}').count(), 30);
        assert!(row.contains(&format!("\u{10EEEE}{mark}\u{305}\u{10EEEE}")), "{row:?}");
        let [_, red, green, blue] = number.to_be_bytes();
        assert!(row.starts_with(&format!("\x1b[38;2;{red};{green};{blue}m")), "{row:?}");
    }
}

#[test]
fn iterm2_gets_the_pixels_of_the_png() {
    let text = sent(&format!("{WORDS} --output iterm2"), None);
    let command = strings(&text, "\x1b]1337;File=", "\x07");
    let [command] = command[..] else { panic!("{} commands", command.len()) };
    let (keys, data) = command.split_once(':').expect("data");
    let file = STANDARD.decode(data).expect("base64");
    assert!(keys.contains(&format!("size={};width=30;height=9;", file.len())), "{keys}");
    assert!(decoded(&file) == png(WORDS), "other pixels");
}

/// A reader of sixels: as the manual has it, and no more than is needed.
fn of_sixel(text: &str) -> Image {
    let body = text.strip_prefix("\x1bP0;1;0q").and_then(|text| text.split("\x1b\\").next());
    let bytes = body.expect("a sixel string").as_bytes();
    let mut at = 0;
    let number = |at: &mut usize| {
        let start = *at;
        while bytes.get(*at).is_some_and(u8::is_ascii_digit) {
            *at += 1;
        }
        str::from_utf8(&bytes[start..*at]).expect("digits").parse::<usize>().expect("a number")
    };
    let mut image = Image::default();
    let mut palette = vec![None; 256];
    let (mut x, mut y, mut color, mut repeat) = (0, 0, 0, 1);
    while let Some(&byte) = bytes.get(at) {
        at += 1;
        match byte {
            b'"' | b'#' => {
                let mut numbers = vec![number(&mut at)];
                while bytes.get(at) == Some(&b';') {
                    at += 1;
                    numbers.push(number(&mut at));
                }
                match (byte, &numbers[..]) {
                    (b'"', [1, 1, width, height]) => {
                        (image.width, image.height) = (*width as u32, *height as u32);
                        image.rgb = vec![0; 3 * width * height];
                    }
                    (b'#', [entry, 2, red, green, blue]) => {
                        palette[*entry] = Some([*red as u8, *green as u8, *blue as u8]);
                    }
                    (b'#', [entry]) => color = *entry,
                    _ => panic!("{numbers:?}"),
                }
            }
            b'!' => repeat = number(&mut at),
            b'$' => x = 0,
            b'-' => (x, y) = (0, y + 6),
            b'?'..=b'~' => {
                let rows = (0..6).filter(|row| (byte - b'?') >> row & 1 == 1);
                for row in rows {
                    for column in x..x + repeat {
                        let start = 3 * ((y + row) * image.width as usize + column);
                        image.rgb[start..start + 3]
                            .copy_from_slice(&palette[color].expect("a colour"));
                    }
                }
                (x, repeat) = (x + repeat, 1);
            }
            _ => panic!("{byte}"),
        }
    }
    image
}

/// Pixel for pixel: every pixel of one colour of the picture becomes one of the palette, which is near.
#[test]
fn sixels_are_the_pixels_of_the_png_in_256_colours() {
    for (words, most) in
        [(WORDS, 0.012), ("unit --size 20x5", 0.003), ("caffeine --size 30x9", 0.012)]
    {
        let text = sent(&format!("{words} --output sixel"), None);
        // After the last band the cursor is in the last row of cells.
        assert!(text.ends_with("\x1b\\\n") && !text.ends_with("-\x1b\\\n"), "{words}");
        let (image, expected) = (of_sixel(&text), png(words));
        let bands = expected.height.div_ceil(6) as usize;
        assert_eq!(text.matches('-').count(), bands - 1, "{words}");
        assert_eq!((image.width, image.height), (expected.width, expected.height));
        let pairs = || image.rgb.as_chunks::<3>().0.iter().zip(expected.rgb.as_chunks::<3>().0);
        let mut colors: Vec<_> = pairs().map(|(own, _)| own).collect();
        colors.sort();
        colors.dedup();
        assert!(colors.len() <= 256 && (words != WORDS || colors.len() > 200), "{}", colors.len());
        let squares = pairs().map(|(own, expected)| {
            let own = Srgb(own.map(|share| (f32::from(share) * 2.55).round() as u8));
            let far = oklab(own.to_linear()).distance(oklab(Srgb(*expected).to_linear()));
            f64::from(far * far)
        });
        let error = (squares.sum::<f64>() / pairs().count() as f64).sqrt();
        println!("{words}: {error:.4} in OKLab");
        assert!(error < most, "{words}: {error}");
    }
    assert_eq!([0, 128, 255].map(percent), [0, 50, 100]);
}
