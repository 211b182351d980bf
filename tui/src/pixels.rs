//! Pictures in pixels, for terminals that have a protocol for them: in place of cells, never beside them.
//!
//! | protocol | pixels | who |
//! |---|---|---|
//! | `kitty` | just as they are, deflated | kitty, Ghostty, Konsole, `WezTerm`; under tmux by placeholders |
//! | `sixel` | in a palette of 256 or fewer, chosen in `OKLab` | foot, xterm, Windows Terminal, mlterm |
//! | `iterm2` | just as they are, as a PNG | iTerm2, `WezTerm`, VS Code |

mod diacritics;
pub mod iterm2;
pub mod kitty;
mod median_cut;
pub mod sixel;

use crate::choice::Auto;
use crate::picture::Image;
use crate::terminal::multiplexer::Multiplexer;
use crate::terminal::{Abilities, variable};
use clap::ValueEnum;

/// What terminals of many kinds are called.
const GENERAL: [&str; 5] = ["xterm-256color", "xterm", "xterm-color", "xterm-new", "xterm-direct"];

/// What the program writes to a terminal.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Output {
    /// Pixels if the terminal says that it has them, else cells
    Auto,
    /// Characters
    Cells,
    /// Pixels by kitty's protocol; under tmux by placeholders, with allow-passthrough on
    Kitty,
    /// Pixels in 256 colours
    Sixel,
    /// Pixels by iTerm2's protocol
    Iterm2,
}

/// How pixels are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Protocol {
    /// Kitty's; whether what is written goes through tmux.
    Kitty {
        /// Then it is wrapped, and shown by placeholders.
        through_tmux: bool,
    },
    /// DEC's.
    Sixel {
        /// At most, of 256.
        colors: u16,
    },
    /// The one of iTerm2.
    Iterm2,
}

impl Output {
    /// Returns the protocol for a terminal of which so much is known; `None` for cells. A protocol that is asked for by
    /// name is believed, unless the terminal has answered all questions and not that one.
    #[must_use]
    pub fn protocol(self, abilities: &Abilities) -> Auto<Protocol> {
        let multiplexer = Multiplexer::of_process();
        let through_tmux = multiplexer == Some(Multiplexer::Tmux);
        let kitty = Protocol::Kitty { through_tmux };
        let sixel = Protocol::Sixel { colors: abilities.sixel_colors.unwrap_or(256) };
        let denies = |has: bool| abilities.has_answered && !has;
        match self {
            Self::Cells => None,
            Self::Kitty => (!denies(abilities.kitty)).then_some(kitty),
            Self::Sixel => (!denies(abilities.sixel)).then_some(sixel),
            Self::Iterm2 => Some(Protocol::Iterm2),
            Self::Auto if abilities.kitty => Some(kitty),
            // tmux says that it has sixels, whatever is behind it.
            Self::Auto if multiplexer.is_some() => None,
            Self::Auto if is_known_for_iterm2(&variable("TERM_PROGRAM"), &variable("TERM")) => {
                Some(Protocol::Iterm2)
            }
            Self::Auto if abilities.sixel => Some(sixel),
            Self::Auto => None,
        }
    }
}

/// No question tells whether a terminal has iTerm2's protocol. Another one that was started in it has inherited the name of the
/// `program`: it is believed only if it calls terminals `term`.
fn is_known_for_iterm2(program: &str, term: &str) -> bool {
    match program {
        "iTerm.app" => term.starts_with("iterm") || GENERAL.contains(&term),
        "WezTerm" => term == "wezterm" || GENERAL.contains(&term),
        _ => false,
    }
}

impl Protocol {
    /// Whether text is another layer than pixels, and so leaves them alone.
    #[must_use]
    pub fn has_layers(self) -> bool {
        self == Self::Kitty { through_tmux: false }
    }

    /// Appends what shows `image` from the top left on, in so many columns and rows. The cursor may then be anywhere.
    pub fn write(self, image: &Image, cells: (u16, u16), number: u32, out: &mut Vec<u8>) {
        match self {
            Self::Kitty { through_tmux } => kitty::write(image, cells, number, through_tmux, out),
            Self::Sixel { colors } => {
                out.extend_from_slice(b"\x1b[H");
                sixel::write(image, colors, out);
            }
            Self::Iterm2 => {
                out.extend_from_slice(b"\x1b[H");
                iterm2::write(image, cells, out);
            }
        }
    }

    /// Appends what shows `image` where the cursor is, and moves the cursor to the line below; the image may be
    /// higher than the screen.
    pub fn write_in_line(
        self,
        image: &Image,
        cells: (u16, u16),
        is_higher: bool,
        out: &mut Vec<u8>,
    ) {
        match self {
            Self::Kitty { through_tmux } => {
                kitty::write_in_line(image, cells, through_tmux, is_higher, out);
            }
            Self::Sixel { colors } => sixel::write(image, colors, out),
            Self::Iterm2 => iterm2::write(image, cells, out),
        }
        out.push(b'\n');
    }

    /// Returns what ends an image that is half sent, and removes the images that are there.
    #[must_use]
    pub fn removal(self) -> Vec<u8> {
        let mut out = b"\x1b\\".to_vec();
        match self {
            Self::Kitty { through_tmux } => kitty::remove(through_tmux, &mut out),
            // These images are where text is.
            Self::Sixel { .. } | Self::Iterm2 => out.extend_from_slice(b"\x1b[2J"),
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_program_is_believed_where_the_terminal_has_a_name_that_it_gives() {
        for (program, term, expected) in [
            ("iTerm.app", "xterm-256color", true),
            ("iTerm.app", "xterm", true),
            ("iTerm.app", "iterm2", true),
            ("WezTerm", "xterm-256color", true),
            ("WezTerm", "wezterm", true),
            ("WezTerm", "iterm2", false),
            ("WezTerm", "alacritty", false),
            ("WezTerm", "foot", false),
            ("iTerm.app", "screen.xterm-256color", false),
            ("iTerm.app", "tmux-256color", false),
            ("iTerm.app", "xterm-kitty", false),
            ("iTerm.app", "xterm-ghostty", false),
            ("Apple_Terminal", "xterm-256color", false),
            ("", "xterm-256color", false),
        ] {
            assert_eq!(is_known_for_iterm2(program, term), expected, "{program}, {term}");
        }
    }
}
