//! How many colours: what the user asks for, then what the environment says.

use super::multiplexer::Multiplexer;
use super::variable;
use crate::palette::Theme;
use crate::style::ColorDepth;
use clap::ValueEnum;

/// What `--color` says.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ColorChoice {
    /// As the environment and the terminal say
    Auto,
    /// No colour
    Never,
    /// As many colours as the terminal has, also into a pipe
    Always,
    /// The 16 of the user's theme
    #[value(name = "16")]
    Ansi16,
    /// The xterm palette
    #[value(name = "256")]
    Ansi256,
    /// 24 bits
    Truecolor,
}

/// What decides besides the flag.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Surroundings {
    /// Whether standard output is a terminal.
    pub is_terminal: bool,
    /// `NO_COLOR` (<https://no-color.org>) is set, and not empty: no colour.
    pub no_color: bool,
    /// `CLICOLOR_FORCE` (<https://bixense.com/clicolors>) is set, and neither empty nor 0: colour
    /// also into a pipe.
    pub force: bool,
    /// `TERM`.
    pub term: String,
    /// What shows the program a terminal of its own.
    pub multiplexer: Option<Multiplexer>,
    /// `COLORTERM` promises 24 bits.
    pub truecolor: bool,
    /// What the terminal itself says of 24 bits, if it was asked and has answered.
    pub told: Option<bool>,
}

impl Surroundings {
    /// The surroundings of this process.
    #[must_use]
    pub fn of_process(is_terminal: bool) -> Self {
        Self {
            is_terminal,
            no_color: anstyle_query::no_color(),
            // Not `anstyle_query::clicolor_force`, which takes 0 for a yes.
            force: !["", "0"].contains(&variable("CLICOLOR_FORCE").as_str()),
            // Not `anstyle_query::term_supports_color`: an empty name promises no colour.
            term: variable("TERM"),
            multiplexer: Multiplexer::of_process(),
            truecolor: anstyle_query::truecolor(),
            told: None,
        }
    }

    /// How many colours a picture gets: by the flag, else `NO_COLOR`, else `CLICOLOR_FORCE`, else
    /// whether there is a terminal, and what it says it has.
    #[must_use]
    pub fn depth(&self, choice: ColorChoice) -> ColorDepth {
        let forced = || match self.terminal_depth() {
            ColorDepth::Never => ColorDepth::Ansi16,
            depth => depth,
        };
        match choice {
            ColorChoice::Never => ColorDepth::Never,
            ColorChoice::Ansi16 => ColorDepth::Ansi16,
            ColorChoice::Ansi256 => ColorDepth::Ansi256,
            ColorChoice::Truecolor => ColorDepth::Truecolor,
            ColorChoice::Always => forced(),
            ColorChoice::Auto if self.no_color => ColorDepth::Never,
            ColorChoice::Auto if self.force => forced(),
            ColorChoice::Auto if self.is_terminal => self.terminal_depth(),
            ColorChoice::Auto => ColorDepth::Never,
        }
    }

    /// What the 16 colours are: those that are `asked` for, else xterm's, or on Linux's console its own. That has eight papers: codes 100 to
    /// 107 mean the same as 40 to 47 (`console_codes(4)`).
    #[must_use]
    pub fn theme(&self, asked: Option<Theme>) -> Theme {
        match self.term.as_str() {
            "linux" => Theme { papers: 8, ..asked.unwrap_or(Theme::VGA) },
            _ => asked.unwrap_or(Theme::XTERM),
        }
    }

    /// Whether the terminal knows no escape sequence, and so can show no viewer.
    #[must_use]
    pub fn is_dumb(&self) -> bool {
        self.term == "dumb"
    }

    /// What the terminal says, else what `TERM` and `COLORTERM` promise. ssh does not send `COLORTERM`, so some terminals are
    /// known by name; GNU screen hands it on but cannot keep the promise.
    fn terminal_depth(&self) -> ColorDepth {
        const KNOWN: [&str; 7] =
            ["-direct", "-truecolor", "kitty", "alacritty", "foot", "wezterm", "ghostty"];
        let of_palette =
            if self.term.contains("256color") { ColorDepth::Ansi256 } else { ColorDepth::Ansi16 };
        match self.term.as_str() {
            "" | "dumb" => ColorDepth::Never,
            _ if self.told == Some(true) => ColorDepth::Truecolor,
            _ if self.told == Some(false) => of_palette,
            _ if self.multiplexer == Some(Multiplexer::Screen) => of_palette,
            term if self.truecolor || KNOWN.iter().any(|known| term.contains(known)) => {
                ColorDepth::Truecolor
            }
            _ => of_palette,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::ColorChoice::{Always, Auto, Never};
    use super::*;

    #[test]
    fn the_order_of_precedence() {
        use ColorDepth::{Ansi16, Ansi256, Truecolor};
        let none = ColorDepth::Never;
        // Flag, `NO_COLOR`, `CLICOLOR_FORCE`, terminal, `TERM` and `TMUX`, `COLORTERM`, and the depth.
        let rows = [
            // The flag rules.
            (Never, 0, 1, 1, "xterm-256color", 1, none),
            (ColorChoice::Ansi16, 1, 0, 0, "dumb", 0, Ansi16),
            (ColorChoice::Ansi256, 1, 0, 0, "dumb", 0, Ansi256),
            (ColorChoice::Truecolor, 1, 0, 1, "xterm", 0, Truecolor),
            (Always, 1, 0, 0, "xterm-256color", 0, Ansi256),
            (Always, 1, 0, 0, "xterm", 1, Truecolor),
            (Always, 0, 0, 0, "", 0, Ansi16),
            // Then NO_COLOR.
            (Auto, 1, 1, 1, "xterm-256color", 1, none),
            (Auto, 1, 0, 1, "xterm", 0, none),
            (Auto, 0, 0, 1, "xterm", 0, Ansi16),
            // Then CLICOLOR_FORCE.
            (Auto, 0, 1, 0, "xterm-256color", 0, Ansi256),
            (Auto, 0, 1, 0, "dumb", 0, Ansi16),
            // Then whether there is a terminal.
            (Auto, 0, 0, 0, "xterm-256color", 1, none),
            // Then TERM and COLORTERM.
            (Auto, 0, 0, 1, "", 0, none),
            (Auto, 0, 0, 1, "dumb", 1, none),
            (Auto, 0, 0, 1, "linux", 0, Ansi16),
            (Auto, 0, 0, 1, "xterm-256color", 0, Ansi256),
            (Auto, 0, 0, 1, "xterm-256color", 1, Truecolor),
            (Auto, 0, 0, 1, "tmux-256color", 1, Truecolor),
            // tmux may have GNU screen's name.
            (Auto, 0, 0, 1, "screen-256color TMUX", 1, Truecolor),
            (Auto, 0, 0, 1, "screen-256color TMUX", 0, Ansi256),
            (Auto, 0, 0, 1, "screen-256color", 1, Ansi256),
            (Auto, 0, 0, 1, "screen", 1, Ansi16),
            (Auto, 0, 0, 1, "xterm-kitty", 0, Truecolor),
            (Auto, 0, 0, 1, "xterm-direct", 0, Truecolor),
        ];
        for row in rows {
            let (choice, no_color, force, is_terminal, term, truecolor, depth) = row;
            let (term, is_in_tmux) = match term.split_once(' ') {
                Some((term, _)) => (term, true),
                None => (term, false),
            };
            let surroundings = Surroundings {
                is_terminal: is_terminal == 1,
                no_color: no_color == 1,
                force: force == 1,
                term: term.to_owned(),
                multiplexer: Multiplexer::called(term, is_in_tmux),
                truecolor: truecolor == 1,
                told: None,
            };
            assert_eq!(surroundings.depth(choice), depth, "{row:?}");
        }
    }

    #[test]
    fn linux_s_console_has_colours_of_its_own_and_eight_papers() {
        let of = |term: &str| Surroundings { term: term.to_owned(), ..Surroundings::default() };
        let (console, xterm) = (of("linux"), of("xterm"));
        assert_eq!(xterm.theme(None), Theme::XTERM);
        assert_eq!(xterm.theme(Some(Theme::TANGO)), Theme::TANGO);
        assert_eq!(console.theme(None), Theme { papers: 8, ..Theme::VGA });
        assert_eq!(console.theme(Some(Theme::TANGO)), Theme { papers: 8, ..Theme::TANGO });
    }

    #[test]
    fn the_terminal_knows_better_than_its_name_and_the_user_best() {
        let surroundings = |told, term: &str| Surroundings {
            is_terminal: true,
            term: term.to_owned(),
            truecolor: true,
            told,
            ..Surroundings::default()
        };
        let told_no = surroundings(Some(false), "xterm-256color");
        assert_eq!(told_no.depth(Auto), ColorDepth::Ansi256);
        assert_eq!(told_no.depth(ColorChoice::Truecolor), ColorDepth::Truecolor);
        let told_yes = Surroundings { truecolor: false, ..surroundings(Some(true), "xterm") };
        assert_eq!(told_yes.depth(Auto), ColorDepth::Truecolor);
        assert_eq!(Surroundings { told: None, ..told_yes.clone() }.depth(Auto), ColorDepth::Ansi16);
        assert_eq!(Surroundings { no_color: true, ..told_yes }.depth(Auto), ColorDepth::Never);
        assert_eq!(surroundings(Some(true), "dumb").depth(Auto), ColorDepth::Never);
    }
}
