//! The walk from station to station: keys in, pages out, until somebody quits.

use super::frame::{self, LEAST};
use super::station::{Numbers, Station, Turn};
use super::stations::STATIONS;
use crate::encode::Encoder;
use crate::error::Error;
use crate::style::{ColorDepth, Style};
use crate::terminal::{Incoming, LONGEST_BACKLOG, Terminal, Uses, Wish, lost, wish};
use crossterm::event::{Event, KeyCode};
use std::io;
use std::time::Duration;

/// What a key asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Input {
    Next,
    Back,
    Turn(Turn),
    Reset,
    Help,
    Escape,
    Quit,
    /// Give the terminal back and stop, until continued.
    Suspend,
    /// The terminal has another size, or all is to be drawn anew.
    Resize,
}

/// Where the walk is. It has no terminal: keys come in.
struct Walk {
    index: usize,
    /// The numbers of every station, so that coming back finds those that were left.
    numbers: [Numbers; STATIONS.len()],
    help: bool,
    /// Columns and rows of what is drawn.
    room: (u16, u16),
}

impl Walk {
    fn new(index: usize) -> Self {
        let numbers = STATIONS.each_ref().map(Station::first);
        Self { index, numbers, help: false, room: frame::room(LEAST) }
    }

    /// Does what a key asks for; returns `false` if that is to quit.
    fn apply(&mut self, input: Input) -> bool {
        let (station, numbers) = (&STATIONS[self.index], &mut self.numbers[self.index]);
        match input {
            Input::Next => self.index = (self.index + 1) % STATIONS.len(),
            Input::Back => self.index = (self.index + STATIONS.len() - 1) % STATIONS.len(),
            Input::Turn(turn) => *numbers = station.turned_in(self.room, *numbers, turn),
            Input::Reset => *numbers = station.first(),
            Input::Escape if !self.help => return false,
            Input::Help | Input::Escape => self.help = !self.help,
            Input::Quit => return false,
            Input::Suspend | Input::Resize => {}
        }
        true
    }
}

/// Walks from station `index` on. If `may_ask`, asks the terminal what it can do.
///
/// # Errors
/// [`Error::Running`] if there is no terminal to read keys from, or it goes away.
pub(super) fn walk(index: usize, style: Style, may_ask: bool) -> Result<(), Error> {
    let uses = Uses { color: style.depth != ColorDepth::Never, kitty: false, sixel: false };
    let mut terminal = Terminal::enter(may_ask, uses).map_err(|error| lost(&error))?;
    let mut walk = Walk::new(index);
    let mut encoder = Encoder::new();
    loop {
        show(&terminal, &mut walk, &mut encoder, style).map_err(|error| lost(&error))?;
        if !take_input(&mut terminal, &mut walk, &mut encoder).map_err(|error| lost(&error))? {
            return Ok(());
        }
    }
}

fn show(
    terminal: &Terminal,
    walk: &mut Walk,
    encoder: &mut Encoder,
    style: Style,
) -> io::Result<()> {
    let (columns, rows) = terminal.size()?;
    if columns == 0 || rows == 0 {
        return Ok(());
    }
    walk.room = frame::room((columns, rows));
    let numbers = walk.numbers[walk.index];
    let page = frame::page(walk.index, numbers, walk.help, (columns, rows), style);
    let mut bytes = Vec::new();
    encoder.set_synchronized(terminal.abilities().synchronized);
    encoder.encode(&page, &mut bytes);
    terminal.show(&bytes)
}

/// Waits for input and takes all there is, before a page is drawn; returns `false` if the user
/// quits.
fn take_input(terminal: &mut Terminal, walk: &mut Walk, encoder: &mut Encoder) -> io::Result<bool> {
    let mut wait = None;
    for _ in 0..LONGEST_BACKLOG {
        let Some(incoming) = terminal.next_event(wait)? else { break };
        wait = Some(Duration::ZERO);
        let Incoming::User(event) = incoming else { continue };
        let Some(input) = input(&event) else { continue };
        match input {
            Input::Suspend => {
                terminal.suspend()?;
            }
            // The terminal may have moved its cells about, even if the size is the same.
            Input::Resize => encoder.forget(),
            _ => {}
        }
        if !walk.apply(input) {
            return Ok(false);
        }
    }
    if terminal.was_resumed() {
        encoder.forget();
    }
    Ok(true)
}

fn input(event: &Event) -> Option<Input> {
    match wish(event)? {
        Wish::Key(key) => of_key(key),
        Wish::Mouse(_) => None,
        Wish::Quit => Some(Input::Quit),
        Wish::Suspend => Some(Input::Suspend),
        Wish::Resize => Some(Input::Resize),
    }
}

fn of_key(key: KeyCode) -> Option<Input> {
    Some(match key {
        KeyCode::Char('n') | KeyCode::PageDown => Input::Next,
        KeyCode::Char('b') | KeyCode::PageUp => Input::Back,
        KeyCode::Left => Input::Turn(Turn::Left),
        KeyCode::Right => Input::Turn(Turn::Right),
        KeyCode::Up => Input::Turn(Turn::Up),
        KeyCode::Down => Input::Turn(Turn::Down),
        KeyCode::Char('r') => Input::Reset,
        KeyCode::Char('?') => Input::Help,
        KeyCode::Char('q') => Input::Quit,
        KeyCode::Esc => Input::Escape,
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lecture::stations::station;
    use crate::lecture::tests::BACK;
    use crossterm::event::{KeyEvent, KeyModifiers};

    #[test]
    fn the_stations_go_around() {
        let mut walk = Walk::new(0);
        for index in 1..=STATIONS.len() {
            assert!(walk.apply(Input::Next));
            assert_eq!(walk.index, index % STATIONS.len());
        }
        walk.apply(Input::Back);
        assert_eq!(walk.index, STATIONS.len() - 1);
    }

    #[test]
    fn an_arrow_leads_back_at_once_from_where_another_was_held_down() {
        let stations = ["illumination", "first-picture"];
        for (name, (held, back)) in stations.iter().flat_map(|name| BACK.map(|turn| (name, turn))) {
            let index = station(name).expect("a station");
            let mut walk = Walk::new(index);
            for _ in 0..100 {
                assert!(walk.apply(Input::Turn(held)));
            }
            let page =
                |walk: &Walk| frame::page(index, walk.numbers[index], false, LEAST, Style::PLAIN);
            let at_the_edge = page(&walk);
            assert!(walk.apply(Input::Turn(back)));
            assert!(page(&walk) != at_the_edge, "{name} {back:?}");
        }
    }

    #[test]
    fn escape_closes_the_help_first() {
        let mut walk = Walk::new(3);
        assert!(walk.apply(Input::Help) && walk.help);
        assert!(walk.apply(Input::Escape) && !walk.help);
        assert!(!walk.apply(Input::Escape));
        assert!(!walk.apply(Input::Quit));
    }

    #[test]
    fn keys_and_control() {
        let key = |code, modifiers| input(&Event::Key(KeyEvent::new(code, modifiers)));
        let none = KeyModifiers::NONE;
        assert_eq!(key(KeyCode::PageDown, none), Some(Input::Next));
        assert_eq!(key(KeyCode::Char('b'), none), Some(Input::Back));
        assert_eq!(key(KeyCode::Char('c'), KeyModifiers::CONTROL), Some(Input::Quit));
        assert_eq!(key(KeyCode::Char('l'), KeyModifiers::CONTROL), Some(Input::Resize));
        assert_eq!(key(KeyCode::Char('q'), KeyModifiers::CONTROL), None);
        assert_eq!(key(KeyCode::Char('x'), none), None);
    }
}
