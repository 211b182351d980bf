//! Which picture is wanted.

use super::shown::Shown;

/// All that a picture depends on, besides the file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Wanted {
    /// Which scene, counted as they come. A frame that comes again may have other colours: the scale may have widened.
    pub(super) scene: usize,
    /// What it shows.
    pub(super) pictured: Shown,
    /// Columns and rows.
    pub(super) size: (u16, u16),
    /// Width and height of a cell, if it is drawn in pixels.
    pub(super) cell: Option<(u32, u32)>,
}

impl Wanted {
    /// Whether `other` is this picture, perhaps moved by what keys that are held down and drags move: the view, the seam.
    pub(super) fn moves_to(&self, other: &Self) -> bool {
        *other == Self { pictured: self.pictured.moved_as(&other.pictured), ..*self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compare::Comparison;
    use crate::viewer::Start;
    use crate::viewer::keys::Input;
    use crate::viewer::state::State;
    use spherule_kernel::Tier;

    #[test]
    fn what_is_held_down_moves_the_picture_and_other_keys_change_it() {
        let comparison = Some(Comparison::Split([Tier::Fast, Tier::Exact]));
        let start = Start { comparison, ..Start::FRONT };
        let shown = |inputs: &[Input]| {
            let mut state = State::new(start, (0, 3));
            state.set_size(80, 24);
            for &input in inputs {
                state.apply(input);
            }
            state.shown
        };
        let wanted = |inputs: &[Input]| {
            let pictured = shown(inputs).pictured();
            Wanted { scene: 0, pictured, size: (80, 24), cell: None }
        };
        let (at_first, before) = (shown(&[]), wanted(&[]));
        for input in [Input::Help, Input::Legend, Input::Pick, Input::Table] {
            assert!(wanted(&[input]) == before, "{input:?}");
            let after = shown(&[Input::Orbit(1, 0), input]);
            assert!(after.moved_as(&at_first) != at_first, "{input:?}");
        }
        for input in [Input::Orbit(1, 0), Input::Zoom(1), Input::Pan(0, 1), Input::Seam(1)] {
            let after = wanted(&[input]);
            assert!(after != before && before.moves_to(&after), "{input:?}");
            assert!(shown(&[input]).moved_as(&at_first) == at_first, "{input:?}");
        }
        for input in [Input::Structure, Input::Charset, Input::Errors, Input::Coloring] {
            let after = wanted(&[Input::Orbit(1, 0), input]);
            assert!(!before.moves_to(&after), "{input:?}");
        }
        assert!(!before.moves_to(&Wanted { scene: 1, ..before }));
    }
}
