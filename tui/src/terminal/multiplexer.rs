//! A terminal within a terminal: what tmux and GNU screen do with strings, and what they say, is theirs, not that of the
//! terminal behind them.

use super::variable;

/// What shows the program a terminal of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Multiplexer {
    /// It takes an application program command (APC) for a title, and hands on what is wrapped for it.
    Tmux,
    /// It takes an APC for a title, too, and hands on what is in a device control string (DCS).
    Screen,
}

impl Multiplexer {
    /// The one that this process runs in, as far as the environment tells.
    #[must_use]
    pub fn of_process() -> Option<Self> {
        Self::called(&variable("TERM"), !variable("TMUX").is_empty())
    }

    /// The one whose terminals are called `term`. Those of tmux may be called like GNU screen's; ssh sends the name alone.
    pub(super) fn called(term: &str, is_in_tmux: bool) -> Option<Self> {
        if is_in_tmux || term.starts_with("tmux") {
            Some(Self::Tmux)
        } else {
            term.starts_with("screen").then_some(Self::Screen)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tmux_is_known_by_its_variable_and_both_by_their_names() {
        for (term, is_in_tmux, expected) in [
            ("tmux-256color", true, Some(Multiplexer::Tmux)),
            ("screen-256color", true, Some(Multiplexer::Tmux)),
            ("xterm-256color", true, Some(Multiplexer::Tmux)),
            ("tmux-256color", false, Some(Multiplexer::Tmux)),
            ("screen.xterm-256color", false, Some(Multiplexer::Screen)),
            ("screen", false, Some(Multiplexer::Screen)),
            ("xterm-256color", false, None),
            ("", false, None),
        ] {
            assert_eq!(Multiplexer::called(term, is_in_tmux), expected, "{term}, {is_in_tmux}");
        }
    }
}
