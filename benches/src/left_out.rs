//! A report runs for an hour: a scene on which an answer is wrong is left out, and costs the others nothing.

use std::cell::RefCell;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// The scenes that a page lacks.
#[derive(Default)]
pub(crate) struct LeftOut(RefCell<Vec<&'static str>>);

impl LeftOut {
    /// What `measure` returns; `None` if it panics, which says on stderr why, and leaves the scene out.
    pub(crate) fn unless_wrong<T>(
        &self,
        scene: &'static str,
        measure: impl FnOnce() -> T,
    ) -> Option<T> {
        let measured = catch_unwind(AssertUnwindSafe(measure)).ok();
        if measured.is_none() {
            self.0.borrow_mut().push(scene);
        }
        measured
    }

    /// What the page lacks; `None` if it is complete.
    pub(crate) fn line(&self) -> Option<String> {
        let scenes = self.0.borrow();
        let line = || {
            format!(
                "Left out, since an answer was wrong or measuring failed (stderr says why): {}.",
                scenes.join(", ")
            )
        };
        (!scenes.is_empty()).then(line)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wrong_scene_costs_the_others_nothing() {
        let left_out = LeftOut::default();
        let measure = |scene: &'static str| {
            left_out.unless_wrong(scene, || {
                assert!(scene != "long lens", "a wrong answer");
                scene.len()
            })
        };
        assert_eq!((measure("one"), left_out.line()), (Some(3), None));
        let measured: Vec<_> = ["long lens", "shell"].into_iter().filter_map(measure).collect();
        assert_eq!(measured, [5]);
        let line =
            "Left out, since an answer was wrong or measuring failed (stderr says why): long lens.";
        assert_eq!(left_out.line().as_deref(), Some(line));
    }
}
