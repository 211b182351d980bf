//! The README's pictures: what a terminal shows of the program's cells, in pixels.

use super::chafa::output;
use super::image::write_png;
use spherule_tests::art::font::Font;
use spherule_tests::art::light::Light;
use spherule_tests::art::palette::xterm;
use spherule_tests::art::screen::Screen;
use spherule_tests::binary::spherule;
use std::error::Error;
use std::path::Path;
use std::process::Command;

/// A file, its size in cells, and the options of the pictures in it, one below the other.
type Picture = (&'static str, (u16, u16), &'static [&'static str]);

const PICTURES: [Picture; 3] = [
    ("marbles", (160, 50), &["marbles --charset block"]),
    ("caffeine", (120, 40), &["caffeine --charset block"]),
    ("edge", (120, 40), &["edge --accuracy fast", "edge --accuracy exact"]),
];

/// Writes the pictures.
pub(crate) fn write() -> Result<(), Box<dyn Error>> {
    for (name, (columns, rows), pictures) in PICTURES {
        let mut all = Light { width: 0, pixels: Vec::new() };
        for options in pictures {
            let mut program = Command::new(spherule());
            program.args(["--color", "truecolor", "--size", &format!("{columns}x{rows}")]);
            let bytes = output(program.args(options.split_whitespace()))?;
            let screen = Screen::read(&bytes, columns, rows, &xterm())?;
            let light = Light::of_screen(&screen, Font::Unifont)?;
            all.width = light.width;
            all.pixels.extend(light.pixels);
        }
        let path = format!("{}/../tui/pictures/{name}.png", env!("CARGO_MANIFEST_DIR"));
        write_png(&all, Path::new(&path))?;
    }
    Ok(())
}
