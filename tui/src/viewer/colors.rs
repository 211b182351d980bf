//! By what spheres are coloured in the viewer: all that the scene has, one after the other.

use crate::color::Srgb;
use crate::coloring::legend::Legend;
use crate::coloring::scale::Range;
use crate::coloring::{ColorBy, coloring};
use crate::scene::Scene;
use std::sync::Arc;

/// What spheres can be coloured by, and what they are coloured by now.
#[derive(Debug)]
pub(super) struct Colors {
    choices: Vec<ColorBy>,
    /// The range of the column that was asked for first.
    range: Option<Range>,
    first: usize,
    /// `None` for a scene that has not been shown.
    shown: Option<usize>,
    /// The scene's own colours, while it has others.
    own: Option<Vec<Srgb>>,
    pub(super) legend: Option<Legend>,
}

impl Colors {
    /// The choices of a scene that has its own colours.
    pub(super) fn new(scene: &Scene, first: &ColorBy, range: Option<Range>) -> Self {
        let choices = ColorBy::choices(scene.attributes());
        let is_first = |choice: &ColorBy| choice.name().eq_ignore_ascii_case(first.name());
        let first = choices.iter().position(is_first).unwrap_or(0);
        Self { choices, range, first, shown: None, own: None, legend: None }
    }

    /// The choice that was asked for, and how many there are.
    pub(super) fn start(&self) -> (usize, usize) {
        (self.first, self.choices.len())
    }

    /// Takes note of another scene of the same file, which has its own colours.
    pub(super) fn begin_anew(&mut self) {
        (self.shown, self.own) = (None, None);
    }

    /// Colours `scene` by a choice, if it is not already.
    pub(super) fn show(&mut self, scene: &mut Arc<Scene>, choice: usize) {
        if self.shown == Some(choice) {
            return;
        }
        self.shown = Some(choice);
        let range = self.range.filter(|_| choice == self.first);
        let found = self.choices.get(choice).and_then(|by| coloring(scene, by, range).ok());
        let (colors, legend) = found.map_or((None, None), |found| (found.colors, found.legend));
        self.legend = legend;
        // Threads that measure or read ahead may share the scene: then this one becomes a copy.
        match (colors, self.own.take()) {
            (Some(colors), own) => {
                self.own = own.or_else(|| Some(scene.colors().to_vec()));
                Arc::make_mut(scene).set_colors(colors);
            }
            (None, Some(own)) => Arc::make_mut(scene).set_colors(own),
            (None, None) => {}
        }
    }
}
