//! Which pixels the viewer shows, and what of them the terminal has.

use crate::choice::Auto;
use crate::pixels::{Output, Protocol, kitty};
use crate::terminal::{Reply, Terminal};

/// Whether frames are pixels, and what of them the terminal has.
#[derive(Debug)]
pub(super) struct Pixels {
    pub(super) output: Output,
    /// How pixels are written, where nothing is shown that is made of cells; `None` if frames are cells.
    pub(super) protocol: Auto<Protocol>,
    /// How many images were sent.
    pub(super) sent: u32,
    /// Whether one is on the screen.
    pub(super) is_shown: bool,
    /// While the terminal has still to say that it has shown the first: how many frames before that one it has still to
    /// answer.
    pub(super) awaits_first: Option<u32>,
}

impl Pixels {
    pub(super) fn new(output: Output, terminal: &Terminal) -> Self {
        let protocol = output.protocol(terminal.abilities());
        Self { output, protocol, sent: 0, is_shown: false, awaits_first: None }
    }

    /// Takes note of an answer; returns whether it tells that the terminal has no such images.
    pub(super) fn are_denied_by(&mut self, reply: Reply) -> bool {
        match (reply, self.awaits_first) {
            (Reply::Image(number, is_well), _) if kitty::NUMBERS.contains(&number) => {
                self.awaits_first = None;
                !is_well
            }
            (Reply::Status, Some(frames_before)) => {
                self.awaits_first = frames_before.checked_sub(1);
                // The terminal has come past the image, without a word about it.
                frames_before == 0
            }
            _ => false,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const IMAGE: Reply = Reply::Image(kitty::NUMBERS[0], true);

    /// The first image is sent, with so many frames before it unanswered. Returns which of these answers deny it.
    fn denied(frames_before: u32, replies: &[Reply]) -> Vec<bool> {
        let mut pixels = Pixels {
            output: Output::Kitty,
            protocol: None,
            sent: 1,
            is_shown: true,
            awaits_first: Some(frames_before),
        };
        replies.iter().map(|&reply| pixels.are_denied_by(reply)).collect()
    }

    #[test]
    fn silence_about_the_first_image_denies_it_when_that_frame_is_answered() {
        assert_eq!(denied(0, &[Reply::Status]), [true]);
        assert_eq!(denied(2, &[Reply::Status; 4]), [false, false, true, false]);
    }

    #[test]
    fn an_image_that_is_answered_is_there() {
        assert_eq!(denied(0, &[IMAGE, Reply::Status]), [false; 2]);
        let late = [Reply::Status, Reply::Status, IMAGE, Reply::Status, Reply::Status];
        assert_eq!(denied(2, &late), [false; 5]);
        // Another image than ours says nothing.
        assert_eq!(denied(0, &[Reply::Image(31, true), Reply::Status]), [false, true]);
        assert_eq!(denied(0, &[Reply::Image(kitty::NUMBERS[1], false)]), [true]);
    }
}
