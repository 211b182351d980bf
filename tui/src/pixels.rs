//! Pictures in pixels, for terminals that have a protocol for them: in place of cells, never beside them.
//!
//! | protocol | pixels | who |
//! |---|---|---|
//! | `kitty` | just as they are, deflated | kitty, Ghostty, Konsole, `WezTerm`; under tmux by placeholders |
//! | `sixel` | in a palette of 256, chosen in `OKLab` | foot, xterm, Windows Terminal, mlterm |
//! | `iterm2` | just as they are, as a PNG | iTerm2, `WezTerm`, VS Code |

mod diacritics;
pub mod iterm2;
pub mod kitty;
mod median_cut;
pub mod sixel;

use crate::choice::Auto;
use crate::picture::Image;
use crate::terminal::Abilities;
use clap::ValueEnum;
use std::env;

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
    Sixel,
    /// The one of iTerm2.
    Iterm2,
}

impl Output {
    /// Returns the protocol for a terminal of which so much is known; `None` for cells. A protocol that is asked for by
    /// name is believed, unless the terminal has answered all questions and not that one.
    #[must_use]
    pub fn protocol(self, abilities: &Abilities) -> Auto<Protocol> {
        let through_tmux = env::var_os("TMUX").is_some_and(|name| !name.is_empty());
        let kitty = Protocol::Kitty { through_tmux };
        // tmux takes questions that are not for it, and answers none of them.
        let denies = |has: bool| abilities.has_answered && !has;
        match self {
            Self::Cells => None,
            Self::Kitty => (through_tmux || !denies(abilities.kitty)).then_some(kitty),
            Self::Sixel => (!denies(abilities.sixel)).then_some(Protocol::Sixel),
            Self::Iterm2 => Some(Protocol::Iterm2),
            Self::Auto if abilities.kitty => Some(kitty),
            Self::Auto if is_known_for_iterm2() => Some(Protocol::Iterm2),
            Self::Auto if abilities.sixel => Some(Protocol::Sixel),
            Self::Auto => None,
        }
    }
}

/// No question tells whether a terminal has iTerm2's protocol.
fn is_known_for_iterm2() -> bool {
    env::var_os("TERM_PROGRAM").is_some_and(|name| name == "iTerm.app" || name == "WezTerm")
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
            Self::Sixel => {
                out.extend_from_slice(b"\x1b[H");
                sixel::write(image, out);
            }
            Self::Iterm2 => {
                out.extend_from_slice(b"\x1b[H");
                iterm2::write(image, cells, out);
            }
        }
    }

    /// Appends what shows `image` where the cursor is, and moves the cursor to the line below.
    pub fn write_in_line(self, image: &Image, cells: (u16, u16), out: &mut Vec<u8>) {
        match self {
            Self::Kitty { through_tmux } => kitty::write_in_line(image, cells, through_tmux, out),
            Self::Sixel => sixel::write(image, out),
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
            Self::Sixel | Self::Iterm2 => out.extend_from_slice(b"\x1b[2J"),
        }
        out
    }
}
