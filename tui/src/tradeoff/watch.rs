//! How far a measurement is, and whether it goes on.

/// What is being done, in this order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Step {
    /// A structure is built, and the rays of a picture are found.
    Rays,
    /// Tests and writes of both orders are counted.
    Orders,
    /// Normals and shadows are held against those of `Exact`.
    Lighting,
    /// The camera's rays are timed and judged.
    Camera,
    /// So are the shadow rays.
    Shadow,
}

impl Step {
    /// What is being done, in words.
    #[must_use]
    pub const fn doing(self) -> &'static str {
        match self {
            Self::Rays => "finding rays",
            Self::Orders => "counting both orders",
            Self::Lighting => "comparing light",
            Self::Camera => "measuring camera rays",
            Self::Shadow => "measuring shadow rays",
        }
    }

    /// The share of the whole at its start and at its end, by about how long it takes.
    const fn part(self) -> [f64; 2] {
        match self {
            Self::Rays => [0.0, 0.03],
            Self::Orders => [0.03, 0.06],
            Self::Lighting => [0.06, 0.1],
            Self::Camera => [0.1, 0.55],
            Self::Shadow => [0.55, 1.0],
        }
    }
}

/// Hears between passes what is being measured and how much of all is done, from 0 to 1; says whether to go on.
pub(super) struct Watch<'a> {
    watcher: &'a mut dyn FnMut(Step, f64) -> bool,
}

impl<'a> Watch<'a> {
    pub(super) fn new(watcher: &'a mut dyn FnMut(Step, f64) -> bool) -> Self {
        Self { watcher }
    }

    /// Tells that this `share` of a step is done; `None` if the watcher wants no more.
    pub(super) fn go_on(&mut self, step: Step, share: f64) -> Option<()> {
        let [from, to] = step.part();
        (self.watcher)(step, from + (to - from) * share.clamp(0.0, 1.0)).then_some(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_steps_are_parts_of_one_way() {
        let steps = [Step::Rays, Step::Orders, Step::Lighting, Step::Camera, Step::Shadow];
        assert!(steps.is_sorted());
        let mut told = Vec::new();
        let mut watcher = |_, share| {
            told.push(share);
            true
        };
        let mut watch = Watch::new(&mut watcher);
        for step in steps {
            assert_eq!(watch.go_on(step, 0.0), Some(()));
            assert_eq!(watch.go_on(step, 1.5), Some(()));
        }
        assert!(told.is_sorted() && told.len() == 10, "{told:?}");
        assert_eq!((told[0], told[9]), (0.0, 1.0));
        assert!(told[1..9].chunks(2).all(|both| both[0] == both[1]), "{told:?}");
    }
}
