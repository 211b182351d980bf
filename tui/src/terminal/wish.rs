//! What the user or the terminal wants, whatever is shown.

use crossterm::event::{Event, KeyCode, KeyEventKind, KeyModifiers, MouseEvent};

/// What an event asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wish<'a> {
    /// To do what a key does.
    Key(KeyCode),
    /// To do what the mouse does.
    Mouse(&'a MouseEvent),
    /// Ctrl-C: to end.
    Quit,
    /// Ctrl-Z: to give the terminal back and stop, until continued.
    Suspend,
    /// Another size, or one that must be read again; Ctrl-L: to draw all anew.
    Resize,
}

/// What `event` asks for, if anything. A key that is let go says nothing, and one that is held with Control is no
/// letter.
#[must_use]
pub fn wish(event: &Event) -> Option<Wish<'_>> {
    match event {
        Event::Resize(..) => Some(Wish::Resize),
        Event::Mouse(mouse) => Some(Wish::Mouse(mouse)),
        Event::Key(key) if key.kind == KeyEventKind::Release => None,
        Event::Key(key) if key.modifiers.contains(KeyModifiers::CONTROL) => match key.code {
            KeyCode::Char('c') => Some(Wish::Quit),
            KeyCode::Char('z') => Some(Wish::Suspend),
            KeyCode::Char('l') => Some(Wish::Resize),
            _ => None,
        },
        Event::Key(key) => Some(Wish::Key(key.code)),
        _ => None,
    }
}
