//! What the command line says of a scene's file: its format, its columns, its frames.

use crate::error::Error;
use crate::scene::file_name::FileName;
use crate::scene::frames::Frames;
use crate::scene::open::{Opened, open};
use crate::scene::reading::Reading;
use crate::scene::{ReadError, Scene};
use clap::Args;
use std::ops::Range;

/// A file, and which of its frames.
#[derive(Args, Clone, Debug, Default)]
pub struct FileArguments {
    /// How it is read.
    #[command(flatten)]
    pub reading: Reading,
    /// The frame that is shown first, from 0 [default: the first with particles]
    #[arg(long, value_name = "N", conflicts_with = "frames", allow_negative_numbers = true)]
    pub frame: Option<usize>,
    /// Write the pictures of frames A to B - 1, from 0; without B, up to the last; N is 0..N
    #[arg(long, value_name = "A..B", value_parser = range, allow_negative_numbers = true)]
    pub frames: Option<Range<usize>>,
    /// What was meant by a name that is no scene's.
    #[arg(skip)]
    pub(super) meant: Option<String>,
}

/// A scene, and the file it is from.
#[derive(Debug)]
pub struct Subject {
    /// The frame that is shown first.
    pub scene: Scene,
    /// Its number.
    pub frame: usize,
    /// Its file, if it has one.
    pub frames: Option<Frames>,
}

impl FileArguments {
    /// The first frame that is asked for; if no one is named, the first of those with particles.
    ///
    /// # Errors
    /// [`Error::Input`] if there is no such scene or frame, or it cannot be read.
    pub fn open(&self, name: &FileName) -> Result<Subject, Error> {
        let wrong = |error: ReadError| Error::Input(error.to_string());
        let one = |frame: usize| frame..frame.saturating_add(1);
        let asked = self.frames.clone().unwrap_or(self.frame.map_or(0..usize::MAX, one));
        let first = asked.start;
        let opened = open(name, &self.reading).map_err(|error| {
            let meant = self.meant.as_ref().map_or_else(String::new, |meant| format!("; {meant}"));
            Error::Input(format!("{error}{meant}"))
        })?;
        match opened {
            Opened::Builtin(_) if first > 0 => {
                Err(Error::Input(format!("{name}: frame {first}: it has one frame")))
            }
            Opened::Builtin(_) if asked.end > 1 && asked.end < usize::MAX => {
                Err(Error::Input(format!("{name}: frames 0..{}: it has one frame", asked.end)))
            }
            Opened::Builtin(scene) => Ok(Subject { scene, frame: 0, frames: None }),
            Opened::File(mut frames) => {
                let (mut frame, mut empty) = (first, None);
                let scene = loop {
                    match frames.read(frame) {
                        Ok(Some(scene)) => break scene,
                        Ok(None) if frames.follows() => std::thread::sleep(FOLLOW),
                        Ok(None) => {
                            let none = || format!("{name}: no frame {first}; frames count from 0");
                            return Err(empty.map_or_else(|| Error::Input(none()), wrong));
                        }
                        Err(error) if error.is_empty_frame && frame + 1 < asked.end => {
                            empty.get_or_insert(error);
                            frame += 1;
                        }
                        Err(error) => return Err(wrong(error)),
                    }
                };
                if frame > first {
                    let what =
                        format!("frame {first} has no atoms; frame {frame} is the next with any");
                    frames.note(what);
                }
                frames.report();
                Ok(Subject { scene, frame, frames: Some(frames) })
            }
        }
    }
}

impl FileArguments {
    /// How many frames a turn around the scene has.
    ///
    /// # Errors
    /// Says how many frames it may have.
    pub fn turn(&self) -> Result<u16, String> {
        let frames =
            self.frames.as_ref().map_or(120, |frames| frames.end.saturating_sub(frames.start));
        let count = u16::try_from(frames).ok().filter(|count| (1..=MOST_OF_TURN).contains(count));
        count.ok_or_else(|| format!("--frames: a turn has 1 to {MOST_OF_TURN} frames"))
    }
}

/// The most frames of a turn.
const MOST_OF_TURN: u16 = 3600;

/// The time between two looks at a file that grows.
pub const FOLLOW: std::time::Duration = std::time::Duration::from_millis(200);

/// `A..B`, `A..`, or `N` for `0..N`.
fn range(text: &str) -> Result<Range<usize>, String> {
    let wrong = || "A..B, A below B, or A.., or N".to_owned();
    let (start, end) = text.split_once("..").unwrap_or(("0", text));
    if end.is_empty() && !text.contains("..") {
        return Err(wrong());
    }
    let start = if start.is_empty() { 0 } else { start.parse().map_err(|_| wrong())? };
    let end = if end.is_empty() { usize::MAX } else { end.parse().map_err(|_| wrong())? };
    if start < end { Ok(start..end) } else { Err(wrong()) }
}
