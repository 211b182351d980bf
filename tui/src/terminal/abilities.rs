//! What a terminal can do, by its own word, and the questions for it.
//!
//! Questions are asked once, together. The last is one that every terminal answers: what has not been answered before
//! it never will be. An answer that comes late counts from then on.

use super::multiplexer::Multiplexer;
use super::reply::{RARE_COLOR, Reply};
use crate::color::Srgb;
use std::time::Duration;

/// How long the answers are waited for before the first picture.
pub(super) const PATIENCE: Duration = Duration::from_millis(200);
/// The number of an image that is asked about and never sent.
pub const ASKED_IMAGE: u32 = 31;

/// What is known of a terminal. What it has not said is not known.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Abilities {
    /// Whether it has answered all that it ever will.
    pub has_answered: bool,
    /// Whether it tells how far it has come.
    pub reports_status: bool,
    /// Whether it holds its picture back between brackets (mode 2026).
    pub synchronized: bool,
    /// Whether it has 24 bits of colour.
    pub truecolor: Option<bool>,
    /// Width and height of a cell in pixels.
    pub cell_pixels: Option<(u16, u16)>,
    /// The colour behind its cells.
    pub background: Option<Srgb>,
    /// Whether it shows images by kitty's protocol.
    pub kitty: bool,
    /// Whether it shows sixels.
    pub sixel: bool,
    /// In how many colours.
    pub sixel_colors: Option<u16>,
    /// How many pixels of them, across and down, however large the window is.
    pub sixel_pixels: Option<(u32, u32)>,
}

impl Abilities {
    /// Takes note of an answer, whenever it comes.
    pub(super) fn learn(&mut self, reply: Reply) {
        match reply {
            Reply::Attributes { sixel } => (self.has_answered, self.sixel) = (true, sixel),
            Reply::Synchronized(is_known) => self.synchronized = is_known,
            Reply::CellPixels(width, height) => self.cell_pixels = Some((width, height)),
            Reply::Background(color) => self.background = Some(color),
            Reply::Truecolor(has) => self.truecolor = Some(has),
            Reply::Image(ASKED_IMAGE, is_well) => self.kitty = is_well,
            Reply::Image(..) => {}
            Reply::SixelColors(colors) => self.sixel_colors = Some(colors),
            Reply::SixelPixels(width, height) => self.sixel_pixels = Some((width, height)),
            Reply::Status => self.reports_status = true,
        }
    }
}

/// What the program has a use for, where that decides what is asked.
#[derive(Clone, Copy, Debug)]
pub struct Uses {
    /// Colours: the question about them sets one.
    pub color: bool,
    /// Images by kitty's protocol, also of the terminal behind tmux.
    pub kitty: bool,
    /// Images in sixels: how large they may be, and in how many colours.
    pub sixel: bool,
}

/// The questions for a terminal called `term`, or for the `multiplexer` that shows it.
///
/// The console of Linux gets only those that it answers: old ones show the letters of strings that they do not know.
pub(super) fn questions(term: &str, multiplexer: Option<Multiplexer>, uses: Uses) -> Vec<u8> {
    const LAST: &str = "\x1b[5n\x1b[c";
    if term == "linux" {
        return LAST.into();
    }
    let [red, green, blue] = RARE_COLOR;
    let pen = match multiplexer {
        // The terminal behind it would get the letters.
        Some(Multiplexer::Screen) => String::new(),
        _ if !uses.color => String::new(),
        _ => format!("\x1b[48;2;{red};{green};{blue}m\x1bP$qm\x1b\\\x1b[m"),
    };
    let image = format!("\x1b_Gi={ASKED_IMAGE},s=1,v=1,a=q,t=d,f=24;AAAA\x1b\\");
    let image = match multiplexer {
        None => image,
        Some(Multiplexer::Tmux) if uses.kitty => {
            format!("\x1bPtmux;{}\x1b\\", image.replace('\x1b', "\x1b\x1b"))
        }
        // It would be the title of a window, for good.
        Some(_) => String::new(),
    };
    let sixel = if uses.sixel { "\x1b[?1;1;0S\x1b[?2;4;0S" } else { "" };
    format!("{pen}\x1b[?2026$p\x1b[16t\x1b]11;?\x1b\\{image}{sixel}{LAST}").into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_answered_is_not_known() {
        let mut abilities = Abilities::default();
        abilities.learn(Reply::Status);
        abilities.learn(Reply::Image(7, true));
        abilities.learn(Reply::Attributes { sixel: false });
        let known = Abilities { has_answered: true, reports_status: true, ..Abilities::default() };
        assert_eq!(abilities, known);
        // Late, it counts all the same.
        abilities.learn(Reply::Synchronized(true));
        abilities.learn(Reply::Image(ASKED_IMAGE, true));
        assert_eq!(abilities, Abilities { synchronized: true, kitty: true, ..known });
    }

    #[test]
    fn the_questions_leave_the_pen_alone_and_end_with_the_one_that_all_answer() {
        for term in ["xterm-256color", "linux"] {
            let uses = Uses { color: true, kitty: true, sixel: true };
            let questions = String::from_utf8(questions(term, None, uses)).expect("UTF-8");
            assert!(questions.ends_with("\x1b[c"), "{questions:?}");
            assert_eq!(questions.contains("48;2;"), questions.contains("\x1b[m"));
            assert!(term != "linux" || !questions.contains(['P', ']', '_', '$']));
        }
    }

    #[test]
    fn multiplexers_get_no_string_that_they_take_for_something_else() {
        for (multiplexer, gets_dcs, gets_apc) in [
            (None, true, true),
            (Some(Multiplexer::Tmux), true, false),
            (Some(Multiplexer::Screen), false, false),
        ] {
            for kitty in [false, true] {
                let uses = Uses { color: true, kitty, sixel: false };
                let questions = questions("screen", multiplexer, uses);
                let questions = String::from_utf8(questions).expect("UTF-8");
                let wrapped = "\x1bPtmux;\x1b\x1b_Gi=31,s=1,v=1,a=q,t=d,f=24;AAAA\x1b\x1b\\\x1b\\";
                let is_for_tmux = kitty && multiplexer == Some(Multiplexer::Tmux);
                assert_eq!(questions.contains(wrapped), is_for_tmux, "{multiplexer:?}, {kitty}");
                let bare = questions.replace(wrapped, "");
                assert_eq!(bare.contains("\x1bP"), gets_dcs, "{multiplexer:?}, {kitty}");
                assert_eq!(bare.contains("48;2;"), gets_dcs, "{multiplexer:?}, {kitty}");
                assert_eq!(bare.contains("\x1b_"), gets_apc, "{multiplexer:?}, {kitty}");
            }
        }
    }
}
