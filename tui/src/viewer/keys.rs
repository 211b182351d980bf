//! What keys, mouse and terminal say, in the words of the viewer.

use crate::terminal::{Wish, wish};
use crossterm::event::{Event, KeyCode, KeyEvent, MouseButton, MouseEvent, MouseEventKind};
use spherule_kernel::Tier;

/// One thing that the user or the terminal wants.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Input {
    /// Turn the eye around the target, or move the picked cell: steps to the right, steps up.
    Orbit(i8, i8),
    /// Go nearer by so many steps.
    Zoom(i8),
    /// A button was pressed at this column and row, ...
    Grab(u16, u16),
    /// ... and the mouse was dragged to this one.
    Drag(u16, u16),
    /// The button was released at this one.
    Release(u16, u16),
    /// Move eye and target along the picture: steps to the right, steps up.
    Pan(i8, i8),
    /// The button that moves eye and target was pressed at this column and row, ...
    GrabPlane(u16, u16),
    /// ... and the mouse was dragged to this one with it.
    DragPlane(u16, u16),
    /// Start or stop to pick a cell.
    Pick,
    /// Show all of the scene.
    FrameAll,
    /// Show the sphere that is picked.
    FramePicked,
    /// Use this tier.
    Accuracy(Tier),
    /// Show what the tier gets wrong, or the picture again.
    Errors,
    /// Show two tiers side by side, or the picture again.
    Split,
    /// Show or hide the table of what every tier takes and gets wrong.
    Table,
    /// Move the seam between two tiers so many columns to the right.
    Seam(i8),
    /// The other projection.
    Projection,
    /// The next charset.
    Charset,
    /// Turn occlusion on or off.
    Occlusion,
    /// Turn dark edges on or off.
    Edges,
    /// Turn the fading of what is far away on or off.
    DepthCue,
    /// Colour by the next thing.
    Coloring,
    /// Show or hide what colours mean.
    Legend,
    /// The next structure.
    Structure,
    /// Start or stop to play the frames of a file; where there is one, to spin.
    Spin,
    /// One frame on, or back.
    Step(bool),
    /// Back to the first view.
    Reset,
    /// Show or hide the keys.
    Help,
    /// Tell the command line that shows this view.
    CommandLine,
    /// Begin a recording, or write it.
    Record,
    /// Close what is open, else quit.
    Escape,
    /// End.
    Quit,
    /// Give the terminal back and stop, until continued.
    Suspend,
    /// Another size, or one that must be read again; or to draw all anew.
    Resize,
}

/// What `event` means, if anything.
pub(super) fn input(event: &Event) -> Option<Input> {
    match wish(event)? {
        Wish::Key(key) => key_input(key),
        Wish::Mouse(mouse) => mouse_input(mouse),
        Wish::Quit => Some(Input::Quit),
        Wish::Suspend => Some(Input::Suspend),
        Wish::Resize => Some(Input::Resize),
    }
}

fn key_input(key: KeyCode) -> Option<Input> {
    Some(match key {
        KeyCode::Left | KeyCode::Char('h') => Input::Orbit(-1, 0),
        KeyCode::Right | KeyCode::Char('l') => Input::Orbit(1, 0),
        KeyCode::Up | KeyCode::Char('k') => Input::Orbit(0, 1),
        KeyCode::Down | KeyCode::Char('j') => Input::Orbit(0, -1),
        KeyCode::Char('H') => Input::Pan(-1, 0),
        KeyCode::Char('L') => Input::Pan(1, 0),
        KeyCode::Char('K') => Input::Pan(0, 1),
        KeyCode::Char('J') => Input::Pan(0, -1),
        KeyCode::Char('+' | '=') => Input::Zoom(1),
        KeyCode::Char('-' | '_') => Input::Zoom(-1),
        KeyCode::Char('1') => Input::Accuracy(Tier::Fast),
        KeyCode::Char('2') => Input::Accuracy(Tier::Stable),
        KeyCode::Char('3') => Input::Accuracy(Tier::Exact),
        KeyCode::Char('4') => Input::Accuracy(Tier::Geometric),
        KeyCode::Char('e') => Input::Errors,
        KeyCode::Char('v') => Input::Split,
        KeyCode::Char('t') => Input::Table,
        KeyCode::Char('[') => Input::Seam(-1),
        KeyCode::Char(']') => Input::Seam(1),
        KeyCode::Char('o') => Input::Projection,
        KeyCode::Char('c') => Input::Charset,
        KeyCode::Char('a') => Input::Occlusion,
        KeyCode::Char('E') => Input::Edges,
        KeyCode::Char('d') => Input::DepthCue,
        KeyCode::Char('C') => Input::Coloring,
        KeyCode::Char('g') => Input::Legend,
        KeyCode::Char('s') => Input::Structure,
        KeyCode::Char(' ') => Input::Spin,
        KeyCode::Char('.') => Input::Step(true),
        KeyCode::Char(',') => Input::Step(false),
        KeyCode::Char('r') => Input::Reset,
        KeyCode::Char('p') => Input::Pick,
        KeyCode::Char('f') => Input::FrameAll,
        KeyCode::Enter => Input::FramePicked,
        KeyCode::Char('y') => Input::CommandLine,
        KeyCode::Char('R') => Input::Record,
        KeyCode::Char('?') => Input::Help,
        KeyCode::Char('q') => Input::Quit,
        KeyCode::Esc => Input::Escape,
        _ => return None,
    })
}

fn mouse_input(mouse: &MouseEvent) -> Option<Input> {
    match mouse.kind {
        MouseEventKind::ScrollUp => Some(Input::Zoom(1)),
        MouseEventKind::ScrollDown => Some(Input::Zoom(-1)),
        MouseEventKind::Down(MouseButton::Left) => Some(Input::Grab(mouse.column, mouse.row)),
        MouseEventKind::Drag(MouseButton::Left) => Some(Input::Drag(mouse.column, mouse.row)),
        MouseEventKind::Up(MouseButton::Left) => Some(Input::Release(mouse.column, mouse.row)),
        MouseEventKind::Down(MouseButton::Right) => Some(Input::GrabPlane(mouse.column, mouse.row)),
        MouseEventKind::Drag(MouseButton::Right) => Some(Input::DragPlane(mouse.column, mouse.row)),
        _ => None,
    }
}

/// The key that panics if a test has set the switch.
pub(super) fn is_panic(event: &Event) -> bool {
    matches!(event, Event::Key(KeyEvent { code: KeyCode::Char('!'), .. }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crossterm::event::{KeyEventKind, KeyModifiers};

    fn key(code: KeyCode, modifiers: KeyModifiers) -> Option<Input> {
        input(&Event::Key(KeyEvent::new(code, modifiers)))
    }

    #[test]
    fn control_is_not_the_letter() {
        assert_eq!(key(KeyCode::Char('c'), KeyModifiers::NONE), Some(Input::Charset));
        assert_eq!(key(KeyCode::Char('c'), KeyModifiers::CONTROL), Some(Input::Quit));
        assert_eq!(key(KeyCode::Char('z'), KeyModifiers::CONTROL), Some(Input::Suspend));
        assert_eq!(key(KeyCode::Char('l'), KeyModifiers::CONTROL), Some(Input::Resize));
        assert_eq!(key(KeyCode::Char('q'), KeyModifiers::CONTROL), None);
    }

    #[test]
    fn shifted_keys_count() {
        assert_eq!(key(KeyCode::Char('?'), KeyModifiers::SHIFT), Some(Input::Help));
        assert_eq!(key(KeyCode::Char('+'), KeyModifiers::SHIFT), Some(Input::Zoom(1)));
        assert_eq!(key(KeyCode::Char('H'), KeyModifiers::SHIFT), Some(Input::Pan(-1, 0)));
    }

    #[test]
    fn a_released_key_says_nothing() {
        let mut released = KeyEvent::new(KeyCode::Char('q'), KeyModifiers::NONE);
        released.kind = KeyEventKind::Release;
        assert_eq!(input(&Event::Key(released)), None);
    }

    #[test]
    fn the_left_button_turns_and_the_right_one_moves() {
        let mouse = |kind| {
            let modifiers = KeyModifiers::NONE;
            input(&Event::Mouse(MouseEvent { kind, column: 3, row: 4, modifiers }))
        };
        assert_eq!(mouse(MouseEventKind::Down(MouseButton::Left)), Some(Input::Grab(3, 4)));
        assert_eq!(mouse(MouseEventKind::Drag(MouseButton::Left)), Some(Input::Drag(3, 4)));
        assert_eq!(mouse(MouseEventKind::Up(MouseButton::Left)), Some(Input::Release(3, 4)));
        assert_eq!(mouse(MouseEventKind::Down(MouseButton::Right)), Some(Input::GrabPlane(3, 4)));
        assert_eq!(mouse(MouseEventKind::Drag(MouseButton::Right)), Some(Input::DragPlane(3, 4)));
        assert_eq!(mouse(MouseEventKind::Drag(MouseButton::Middle)), None);
        assert_eq!(mouse(MouseEventKind::ScrollUp), Some(Input::Zoom(1)));
    }
}
