//! Frames one after another, each read while the one before is drawn.

use crate::arguments::files::FOLLOW;
use crate::error::Error;
use crate::scene::Scene;
use crate::scene::frames::Frames;
use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{SyncSender, sync_channel};
use std::thread;

/// Calls `draw` with the frames of `range` in order, as far as there are any; waits for those of a file that is
/// followed.
///
/// A thread reads one frame ahead.
///
/// # Errors
/// The first error of `draw`; [`Error::Input`] if a frame cannot be read, after those before it have been drawn.
pub(super) fn while_reading(
    frames: &mut Frames,
    range: Range<usize>,
    mut draw: impl FnMut(usize, Scene) -> Result<(), Error>,
) -> Result<(), Error> {
    let (sender, read) = sync_channel(0);
    let is_over = &AtomicBool::new(false);
    thread::scope(|scope| {
        let reader = thread::Builder::new().name("frames".to_owned());
        let reading = move || read_all(frames, range, &sender, is_over);
        let reader = reader.spawn_scoped(scope, reading);
        let result = match reader {
            Ok(_) => read.iter().try_for_each(|frame| {
                let (index, scene) = frame?;
                draw(index, scene)
            }),
            Err(error) => Err(Error::Running(format!("a thread: {error}"))),
        };
        // The scope waits for the reader, so the reader must end now, whatever it waits for.
        is_over.store(true, Ordering::Relaxed);
        drop(read);
        result
    })
}

/// Sends what it reads until there is no more, or no one takes it.
fn read_all(
    frames: &mut Frames,
    range: Range<usize>,
    sender: &SyncSender<Result<(usize, Scene), Error>>,
    is_over: &AtomicBool,
) {
    for index in range {
        let frame = loop {
            match frames.read(index) {
                Ok(Some(scene)) => break Ok((index, scene)),
                Ok(None) if !frames.follows() || is_over.load(Ordering::Relaxed) => return,
                Ok(None) => thread::sleep(FOLLOW),
                Err(error) => break Err(Error::Input(error.to_string())),
            }
        };
        frames.report();
        let is_last = frame.is_err();
        if sender.send(frame).is_err() || is_last {
            return;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::open::{Opened, open};
    use crate::scene::reading::Reading;
    use std::io::ErrorKind;

    /// Draws the frames of a file of this text, as x of their first atom, until one is `last`.
    fn drawn(name: &str, text: &str, follow: bool, last: f32) -> (Vec<f32>, Result<(), Error>) {
        let path = std::env::temp_dir().join(format!("spherule-{}-{name}", std::process::id()));
        std::fs::write(&path, text).expect("a file");
        let reading = Reading { follow, ..Reading::default() };
        let Ok(Opened::File(mut frames)) = open(path.to_str().expect("UTF-8"), &reading) else {
            panic!("no file")
        };
        let mut seen = Vec::new();
        let result = while_reading(&mut frames, 0..9, |index, scene| {
            let x = scene.spheres().get(0).expect("an atom").center.x;
            assert_eq!(index, seen.len());
            seen.push(x);
            let end = || Error::of_output("standard output", &ErrorKind::BrokenPipe.into());
            if x == last { Err(end()) } else { Ok(()) }
        });
        (seen, result)
    }

    const THREE: &str = "1\n\nC 0 0 0\n1\n\nC 1 0 0\n1\n\nC 2 0 0\n";

    #[test]
    fn frames_come_in_order_until_there_are_no_more() {
        let (seen, result) = drawn("order.xyz", THREE, false, 9.0);
        assert_eq!(seen, [0.0, 1.0, 2.0]);
        result.expect("no error");
    }

    #[test]
    fn what_is_before_a_bad_frame_is_drawn() {
        let bad = THREE.replace("C 2", "C x");
        let (seen, result) = drawn("bad.xyz", &bad, false, 9.0);
        assert_eq!(seen, [0.0, 1.0]);
        let Err(Error::Input(error)) = result else { panic!("{result:?}") };
        assert!(error.contains(":9:3: x is \"x\": no number"), "{error}");
    }

    #[test]
    fn whoever_stops_drawing_does_not_wait_for_a_file_to_grow() {
        let (seen, result) = drawn("grows.xyz", THREE, true, 2.0);
        assert_eq!(seen, [0.0, 1.0, 2.0]);
        assert!(result.is_err());
    }
}
