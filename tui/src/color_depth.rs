//! How many colours: what the user asks for, then what the environment says.

use crate::draw::ColorDepth;

/// What `--color` says.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ColorChoice {
    /// As the environment and the terminal say.
    #[default]
    Auto,
    /// No colour.
    Never,
    /// As many colours as the terminal has, also into a pipe.
    Always,
    /// So many, whatever the terminal has.
    Depth(ColorDepth),
}

/// What decides besides the flag; values as the environment holds them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Surroundings {
    /// Whether standard output is a terminal.
    pub is_terminal: bool,
    /// `NO_COLOR` (<https://no-color.org>): no colour, if set and not empty.
    pub no_color: Option<String>,
    /// `CLICOLOR_FORCE` (<https://bixense.com/clicolors>): colour also into a pipe, if set and
    /// neither empty nor 0.
    pub clicolor_force: Option<String>,
    /// `TERM`.
    pub term: Option<String>,
    /// `COLORTERM`.
    pub colorterm: Option<String>,
}

impl Surroundings {
    /// Those of this process.
    #[must_use]
    pub fn of_process(is_terminal: bool) -> Self {
        let variable = |name| std::env::var_os(name).map(|value| value.to_string_lossy().into());
        Self {
            is_terminal,
            no_color: variable("NO_COLOR"),
            clicolor_force: variable("CLICOLOR_FORCE"),
            term: variable("TERM"),
            colorterm: variable("COLORTERM"),
        }
    }

    /// How many colours a picture gets: by the flag, else `NO_COLOR`, else `CLICOLOR_FORCE`, else
    /// whether there is a terminal, and what it says it has.
    #[must_use]
    pub fn depth(&self, choice: ColorChoice) -> ColorDepth {
        let is_set = |value: &Option<String>| value.as_ref().is_some_and(|text| !text.is_empty());
        let force = is_set(&self.clicolor_force) && self.clicolor_force.as_deref() != Some("0");
        let forced = || match self.terminal_depth() {
            ColorDepth::Never => ColorDepth::Ansi16,
            depth => depth,
        };
        match choice {
            ColorChoice::Depth(depth) => depth,
            ColorChoice::Never => ColorDepth::Never,
            ColorChoice::Always => forced(),
            ColorChoice::Auto if is_set(&self.no_color) => ColorDepth::Never,
            ColorChoice::Auto if force => forced(),
            ColorChoice::Auto if self.is_terminal => self.terminal_depth(),
            ColorChoice::Auto => ColorDepth::Never,
        }
    }

    /// What `TERM` and `COLORTERM` promise. ssh does not send `COLORTERM`, so some terminals are
    /// known by name; GNU screen hands it on but cannot keep the promise.
    fn terminal_depth(&self) -> ColorDepth {
        let term = self.term.as_deref().unwrap_or_default();
        let known = ["-direct", "-truecolor", "kitty", "alacritty", "foot", "wezterm", "ghostty"];
        if term.is_empty() || term == "dumb" {
            return ColorDepth::Never;
        }
        if term.starts_with("screen") {
            return if term.contains("256color") {
                ColorDepth::Ansi256
            } else {
                ColorDepth::Ansi16
            };
        }
        let colorterm = self.colorterm.as_deref().unwrap_or_default();
        if matches!(colorterm, "truecolor" | "24bit") || known.iter().any(|k| term.contains(k)) {
            ColorDepth::Truecolor
        } else if term.contains("256color") {
            ColorDepth::Ansi256
        } else {
            ColorDepth::Ansi16
        }
    }
}

#[cfg(test)]
mod tests {
    use super::ColorChoice::{Always, Auto, Depth, Never};
    use super::*;

    /// A row: flag, `NO_COLOR`, `CLICOLOR_FORCE`, terminal, `TERM`, `COLORTERM`, and the depth.
    type Row<'a> =
        (ColorChoice, Option<&'a str>, Option<&'a str>, bool, &'a str, &'a str, ColorDepth);

    #[test]
    fn the_order_of_precedence() {
        use ColorDepth::{Ansi16, Ansi256, Truecolor};
        let none = ColorDepth::Never;
        let set = Some("1");
        let rows: [Row<'_>; 26] = [
            // The flag rules.
            (Never, None, set, true, "xterm-256color", "truecolor", none),
            (Depth(Ansi16), set, None, false, "dumb", "", Ansi16),
            (Depth(Truecolor), set, None, true, "xterm", "", Truecolor),
            (Always, set, None, false, "xterm-256color", "", Ansi256),
            (Always, set, None, false, "xterm", "truecolor", Truecolor),
            (Always, None, None, false, "", "", Ansi16),
            // Then NO_COLOR, if not empty.
            (Auto, set, set, true, "xterm-256color", "truecolor", none),
            (Auto, Some("0"), None, true, "xterm", "", none),
            (Auto, Some(""), None, true, "xterm", "", Ansi16),
            // Then CLICOLOR_FORCE.
            (Auto, None, set, false, "xterm-256color", "", Ansi256),
            (Auto, None, set, false, "dumb", "", Ansi16),
            (Auto, None, Some("0"), false, "xterm-256color", "", none),
            (Auto, None, Some(""), false, "xterm-256color", "", none),
            // Then whether there is a terminal.
            (Auto, None, None, false, "xterm-256color", "truecolor", none),
            // Then TERM and COLORTERM.
            (Auto, None, None, true, "", "", none),
            (Auto, None, None, true, "dumb", "truecolor", none),
            (Auto, None, None, true, "xterm", "", Ansi16),
            (Auto, None, None, true, "linux", "", Ansi16),
            (Auto, None, None, true, "xterm-256color", "", Ansi256),
            (Auto, None, None, true, "xterm-256color", "truecolor", Truecolor),
            (Auto, None, None, true, "xterm-256color", "24bit", Truecolor),
            (Auto, None, None, true, "xterm-256color", "yes", Ansi256),
            (Auto, None, None, true, "tmux-256color", "truecolor", Truecolor),
            (Auto, None, None, true, "screen-256color", "truecolor", Ansi256),
            (Auto, None, None, true, "xterm-kitty", "", Truecolor),
            (Auto, None, None, true, "xterm-direct", "", Truecolor),
        ];
        for row in rows {
            let (choice, no_color, force, is_terminal, term, colorterm, depth) = row;
            let surroundings = Surroundings {
                is_terminal,
                no_color: no_color.map(Into::into),
                clicolor_force: force.map(Into::into),
                term: (!term.is_empty()).then(|| term.into()),
                colorterm: (!colorterm.is_empty()).then(|| colorterm.into()),
            };
            assert_eq!(surroundings.depth(choice), depth, "{row:?}");
        }
    }
}
