//! Frames one after another, each read while the one before is drawn.

use crate::arguments::files::FOLLOW;
use crate::error::Error;
use crate::scene::Scene;
use crate::scene::frames::Frames;
use std::ops::Range;
use std::panic::resume_unwind;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{SyncSender, sync_channel};
use std::thread;

/// Calls `draw` with the frames of `range` in order, as far as there are any, without those that have no particles; waits
/// for those of a file that is followed.
///
/// A thread reads one frame ahead. After an error no one waits for it: a pipe may be silent for ever.
///
/// # Errors
/// The first error of `draw`; [`Error::Input`] if a frame cannot be read, after those before it have been drawn.
pub(super) fn while_reading(
    mut frames: Frames,
    range: Range<usize>,
    mut draw: impl FnMut(usize, Scene) -> Result<(), Error>,
) -> Result<(), Error> {
    let (sender, read) = sync_channel(0);
    let is_over = Arc::new(AtomicBool::new(false));
    let is_over_there = Arc::clone(&is_over);
    let reading = move || {
        read_all(&mut frames, range, &sender, &is_over_there);
        // What was noted behind the last frame.
        frames.report();
    };
    let reader = thread::Builder::new().name("frames".to_owned()).spawn(reading);
    let reader =
        reader.map_err(|error| Error::Running(format!("cannot start a thread: {error}")))?;
    let result = read.iter().try_for_each(|frame| {
        let (index, scene) = frame?;
        draw(index, scene)
    });
    is_over.store(true, Ordering::Relaxed);
    drop(read);
    result?;
    // There are no more frames, so the reader ends now.
    if let Err(panic) = reader.join() {
        resume_unwind(panic);
    }
    Ok(())
}

/// Sends what it reads until there is no more, or no one takes it.
fn read_all(
    frames: &mut Frames,
    range: Range<usize>,
    sender: &SyncSender<Result<(usize, Scene), Error>>,
    is_over: &AtomicBool,
) {
    let mut has_empty = false;
    'frames: for index in range {
        let frame = loop {
            match frames.read(index) {
                Ok(Some(scene)) => break Ok((index, scene)),
                Ok(None) if !frames.follows() || is_over.load(Ordering::Relaxed) => return,
                Ok(None) => thread::sleep(FOLLOW),
                Err(error) if error.is_empty_frame => {
                    // What is not sent does not tell that no one takes it.
                    if is_over.load(Ordering::Relaxed) {
                        return;
                    }
                    if !std::mem::replace(&mut has_empty, true) {
                        frames
                            .note(format!("frame {index} has no atoms: such frames are left out"));
                    }
                    continue 'frames;
                }
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
    use crate::scene::format::Format;
    use crate::scene::open::{Opened, open};
    use crate::scene::reading::Reading;
    use crate::test_file::written;
    use std::io::{ErrorKind, Write};
    use std::os::fd::AsRawFd;
    use std::time::Duration;

    /// Draws frames until x of the first atom is `last`; tells their numbers, and x of each.
    fn drawn(frames: Frames, last: f32) -> (Vec<(usize, f32)>, Result<(), Error>) {
        let mut seen = Vec::new();
        let result = while_reading(frames, 0..9, |index, scene| {
            let x = scene.spheres().get(0).expect("an atom").center.x;
            seen.push((index, x));
            let end = || Error::of_output("standard output", &ErrorKind::BrokenPipe.into());
            if x == last { Err(end()) } else { Ok(()) }
        });
        (seen, result)
    }

    /// A file of this text.
    fn opened(name: &str, text: &str, follow: bool) -> Frames {
        let path = written(name, text);
        open_by(path.to_str().expect("UTF-8"), &Reading { follow, ..Reading::default() })
    }

    fn open_by(name: &str, reading: &Reading) -> Frames {
        match open(name, reading) {
            Ok(Opened::File(frames)) => frames,
            other => panic!("no file: {other:?}"),
        }
    }

    /// A frame of a dump with an atom at each of these x.
    fn dump(atoms: &[usize]) -> String {
        let rows: String = atoms.iter().map(|x| format!("1 1 {x} 0 0\n")).collect();
        let (head, count) = ("ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS", atoms.len());
        format!("{head}\n{count}\nITEM: ATOMS id type x y z\n{rows}")
    }

    const THREE: &str = "1\n\nC 0 0 0\n1\n\nC 1 0 0\n1\n\nC 2 0 0\n";

    #[test]
    fn frames_come_in_order_until_there_are_no_more() {
        let (seen, result) = drawn(opened("order.xyz", THREE, false), 9.0);
        assert_eq!(seen, [(0, 0.0), (1, 1.0), (2, 2.0)]);
        result.expect("no error");
    }

    #[test]
    fn frames_without_atoms_are_left_out() {
        let text = [dump(&[]), dump(&[1]), dump(&[]), dump(&[]), dump(&[4])].concat();
        let (seen, result) = drawn(opened("empty.dump", &text, false), 9.0);
        assert_eq!(seen, [(1, 1.0), (4, 4.0)]);
        result.expect("no error");
    }

    /// However many of them follow.
    #[test]
    fn frames_without_atoms_are_not_read_for_no_one() {
        let mut frames = opened("unread.dump", &dump(&[]).repeat(3), false);
        let (sender, _) = sync_channel(0);
        read_all(&mut frames, 0..9, &sender, &AtomicBool::new(true));
        assert_eq!(frames.at(), 1);
    }

    #[test]
    fn what_is_before_a_bad_frame_is_drawn() {
        let bad = THREE.replace("C 2", "C x");
        let (seen, result) = drawn(opened("bad.xyz", &bad, false), 9.0);
        assert_eq!(seen, [(0, 0.0), (1, 1.0)]);
        let Err(Error::Input(error)) = result else { panic!("{result:?}") };
        assert!(error.contains(":9:3: x is \"x\", which is not a number"), "{error}");
    }

    #[test]
    fn whoever_stops_drawing_does_not_wait_for_a_file_to_grow() {
        let (seen, result) = drawn(opened("grows.xyz", THREE, true), 2.0);
        assert_eq!(seen, [(0, 0.0), (1, 1.0), (2, 2.0)]);
        assert!(result.is_err());
    }

    /// Whoever writes it keeps it open, in the middle of a frame.
    #[test]
    fn whoever_stops_drawing_does_not_wait_for_a_pipe() {
        let (reader, mut writer) = std::io::pipe().expect("a pipe");
        writer.write_all(&THREE.as_bytes()[..THREE.len() - 4]).expect("room in the pipe");
        let (sender, ended) = sync_channel(1);
        thread::spawn(move || {
            let reading = Reading { format: Some(Format::Xyz), ..Reading::default() };
            let frames = open_by(&format!("/dev/fd/{}", reader.as_raw_fd()), &reading);
            sender.send(drawn(frames, 1.0)).expect("it is awaited");
        });
        let (seen, result) = ended.recv_timeout(Duration::from_secs(5)).expect("an end");
        assert_eq!(seen, [(0, 0.0), (1, 1.0)]);
        assert!(result.is_err());
        drop(writer);
    }
}
