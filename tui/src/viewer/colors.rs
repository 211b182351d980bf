//! By what spheres are coloured in the viewer: all that the frames so far have, one after the other.

use crate::color::Srgb;
use crate::coloring::legend::Legend;
use crate::coloring::scale::Range;
use crate::coloring::seen::Seen;
use crate::coloring::{ColorBy, Coloring, coloring};
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
    seen: Seen,
    /// The choice of which it has been said that a scene lacks it.
    told: Option<usize>,
    pub(super) legend: Option<Legend>,
}

impl Colors {
    /// The choices of a scene that has its own colours.
    pub(super) fn new(scene: &Scene, first: &ColorBy, range: Option<Range>) -> Self {
        let choices = ColorBy::choices(scene.attributes());
        let is_first = |choice: &ColorBy| choice.name().eq_ignore_ascii_case(first.name());
        let first = choices.iter().position(is_first).unwrap_or(0);
        let seen = Seen::default();
        Self { choices, range, first, shown: None, own: None, seen, told: None, legend: None }
    }

    /// The choice that was asked for, and how many there are.
    pub(super) fn start(&self) -> (usize, usize) {
        (self.first, self.choices.len())
    }

    /// What `scene` is coloured by if that is a choice, and the range of its numbers if without `--range` it had another.
    pub(super) fn to_ask(&self, scene: &Scene, choice: usize) -> (&ColorBy, Option<Range>) {
        let attributes = scene.attributes();
        // A scene that lacks what a choice needs keeps its own colours.
        let there = ColorBy::choices(attributes);
        let is_there =
            |by: &&ColorBy| there.iter().any(|other| other.name().eq_ignore_ascii_case(by.name()));
        let by = self.choices.get(choice).filter(is_there).unwrap_or(&ColorBy::Scene);
        let ColorBy::Column(name) = by else { return (by, None) };
        let range = if self.shown == Some(choice) {
            self.legend.as_ref().and_then(Legend::range)
        } else {
            self.range.filter(|_| choice == self.first)
        };
        let own = attributes.column(name).and_then(|column| Range::of(&column.values));
        (by, range.filter(|range| Some(*range) != own))
    }

    /// Takes note of another `scene` of the same file, which has its own colours. Returns how many choices there are now.
    pub(super) fn begin_anew(&mut self, scene: &Scene) -> usize {
        (self.shown, self.own) = (None, None);
        for choice in ColorBy::choices(scene.attributes()) {
            if !self.choices.contains(&choice) {
                self.choices.push(choice);
            }
        }
        self.choices.len()
    }

    /// Colours `scene` by a choice, if it is not already. A scene that lacks what that needs keeps its colours; the first
    /// time this returns what it lacks.
    pub(super) fn show(&mut self, scene: &mut Arc<Scene>, choice: usize) -> Option<String> {
        if self.shown == Some(choice) {
            return None;
        }
        self.shown = Some(choice);
        let range = self.range.filter(|_| choice == self.first);
        let by = self.choices.get(choice).unwrap_or(&ColorBy::Scene);
        let (found, lack) = match coloring(scene, by, range, &mut self.seen) {
            Ok(found) => (found, None),
            Err(lack) => (Coloring::default(), Some(lack)),
        };
        self.legend = found.legend;
        // Threads that measure or read ahead may share the scene: then this one becomes a copy.
        match (found.colors, self.own.take()) {
            (Some(colors), own) => {
                self.own = own.or_else(|| Some(scene.colors().to_vec()));
                Arc::make_mut(scene).set_colors(colors);
            }
            (None, Some(own)) => Arc::make_mut(scene).set_colors(own),
            (None, None) => {}
        }
        let is_told = self.told == Some(choice);
        self.told = (is_told || lack.is_some()).then_some(choice);
        lack.filter(|_| !is_told)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::attributes::{Attributes, NumberColumn};
    use spherule_kernel::{SphereList, Vec3};

    /// A frame of white spheres with these numbers in a column `q`, or of one without any.
    fn frame(numbers: &[f32]) -> Arc<Scene> {
        let mut attributes = Attributes::default();
        if !numbers.is_empty() {
            let values = numbers.to_vec();
            attributes.columns = vec![NumberColumn { name: "q".into(), values }];
        }
        let list: SphereList = (0..numbers.len().max(1)).map(|_| (Vec3::ZERO, 1.0)).collect();
        let colors = vec![Srgb::WHITE; list.len()];
        Arc::new(Scene::of_spheres(list, colors, attributes))
    }

    #[test]
    fn what_a_frame_lacks_is_told_once_a_choice() {
        let (mut with, mut without) = (frame(&[1.0, 2.0]), frame(&[]));
        let mut colors = Colors::new(&with, &ColorBy::Column("Q".into()), None);
        assert_eq!((colors.start(), colors.show(&mut with, 1)), ((1, 2), None));
        assert!(with.colors() != [Srgb::WHITE; 2] && colors.legend.is_some());
        assert_eq!(colors.begin_anew(&without), 2);
        let lack = Some("this scene has no q to colour by; it has scene".to_owned());
        assert_eq!(colors.show(&mut without, 1), lack);
        assert_eq!((without.colors(), &colors.legend), ([Srgb::WHITE].as_slice(), &None));
        for _ in 0..2 {
            let mut other = frame(&[]);
            colors.begin_anew(&other);
            assert_eq!(colors.show(&mut other, 1), None);
        }
        // Whoever asks for it anew is told anew.
        assert_eq!([0, 1, 1].map(|choice| colors.show(&mut without, choice)), [None, lack, None]);
    }

    /// In a frame that lacks what spheres are coloured by, or alone, other colours would be seen.
    #[test]
    fn what_is_to_be_asked_for_is_what_is_seen() {
        let (mut first, mut second, without) = (frame(&[2.0, 4.0]), frame(&[3.0, 7.0]), frame(&[]));
        let by = ColorBy::Column("q".into());
        let mut colors = Colors::new(&first, &by, None);
        assert_eq!(colors.to_ask(&first, 0), (&ColorBy::Scene, None));
        colors.show(&mut first, 1);
        assert_eq!(colors.to_ask(&first, 1), (&by, None));
        colors.begin_anew(&second);
        colors.show(&mut second, 1);
        assert_eq!(colors.to_ask(&second, 1), (&by, Some(Range { low: 2.0, high: 7.0 })));
        assert_eq!(colors.to_ask(&without, 1), (&ColorBy::Scene, None));
        let range = Range { low: 0.0, high: 5.0 };
        let colors = Colors::new(&first, &ColorBy::Column("Q".into()), Some(range));
        assert_eq!(colors.to_ask(&first, 1), (&by, Some(range)));
    }

    #[test]
    fn what_only_later_frames_have_can_be_chosen_too() {
        let (mut without, mut with) = (frame(&[]), frame(&[3.0]));
        let mut colors = Colors::new(&without, &ColorBy::Scene, None);
        assert_eq!((colors.start(), colors.begin_anew(&with)), ((0, 1), 2));
        assert_eq!((colors.show(&mut with, 1), colors.legend.is_some()), (None, true));
        assert_eq!(colors.begin_anew(&without), 2);
        assert!(colors.show(&mut without, 1).is_some());
    }

    #[test]
    fn the_scale_is_that_of_all_frames_so_far() {
        let by = ColorBy::Column("q".into());
        let legends = |range: Option<Range>| {
            let mut colors = Colors::new(&frame(&[2.0, 4.0]), &by, range);
            [[2.0, 4.0], [3.0, 7.0], [2.0, 4.0]].map(|numbers| {
                let mut scene = frame(&numbers);
                colors.begin_anew(&scene);
                assert_eq!(colors.show(&mut scene, 1), None);
                colors.legend.clone()
            })
        };
        let legend = |low, high| Some(Legend::of_numbers("q", low, high, false));
        assert_eq!(legends(None), [legend(2.0, 4.0), legend(2.0, 7.0), legend(2.0, 7.0)]);
        let asked = Some(Range { low: 0.0, high: 5.0 });
        assert_eq!(legends(asked), [legend(0.0, 5.0), legend(0.0, 5.0), legend(0.0, 5.0)]);
    }
}
