//! Where the links of a robot are with all joints at zero.

use glam::DAffine3;
use std::collections::HashMap;

/// The most joints from the root to a link; with more, there is a circle.
const DEEPEST: usize = 1024;

/// The joints of a robot.
#[derive(Debug, Default)]
pub(super) struct Joints<'a> {
    /// The link above a link, and where the lower is from there.
    above: HashMap<&'a str, (&'a str, DAffine3)>,
    /// Where links are from the root, as far as that is known, and how many joints are between.
    placed: HashMap<&'a str, (DAffine3, usize)>,
}

impl<'a> Joints<'a> {
    /// Adds a joint; returns whether it is the only one above `child`.
    pub(super) fn add(&mut self, parent: &'a str, child: &'a str, joint: DAffine3) -> bool {
        self.above.insert(child, (parent, joint)).is_none()
    }

    /// Where a link is from the root; `None` if it hangs on itself. All calls together pass each joint once.
    pub(super) fn place(&mut self, link: &'a str) -> Option<DAffine3> {
        let (mut at, mut way) = (link, Vec::new());
        let (mut transform, mut depth) = loop {
            if let Some(&placed) = self.placed.get(at) {
                break placed;
            }
            match self.above.get(at) {
                Some(&(parent, joint)) if way.len() <= DEEPEST => {
                    way.push((at, joint));
                    at = parent;
                }
                _ => break (DAffine3::IDENTITY, 0),
            }
        };
        if depth + way.len() > DEEPEST {
            return None;
        }
        while let Some((link, joint)) = way.pop() {
            transform *= joint;
            depth += 1;
            self.placed.insert(link, (transform, depth));
        }
        Some(transform)
    }
}
