//! A button of the mouse that is held down, and whether it has been a click.

/// Where a button of the mouse is held down, if it is.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Hand {
    hold: Option<Hold>,
}

#[derive(Clone, Copy, Debug)]
struct Hold {
    /// Column and row of the press, or of the last movement.
    place: (u16, u16),
    /// Whether the mouse has moved since the press, or moves without one.
    moved: bool,
}

impl Hand {
    /// Takes note of a press.
    pub(super) fn grab(&mut self, place: (u16, u16)) {
        self.hold = Some(Hold { place, moved: false });
    }

    /// Takes note of a movement; returns how many cells it goes to the right and down: zero for the first
    /// movement without a press, from which the next one counts.
    pub(super) fn led_to(&mut self, place: (u16, u16)) -> [f32; 2] {
        let Hold { place: from, moved } = self.hold.unwrap_or(Hold { place, moved: true });
        self.hold = Some(Hold { place, moved: moved || from != place });
        [f32::from(place.0) - f32::from(from.0), f32::from(place.1) - f32::from(from.1)]
    }

    /// Takes note of a release; returns whether it ends a click: at the place of the press, without a
    /// movement since.
    pub(super) fn release(&mut self, place: (u16, u16)) -> bool {
        self.hold.take().is_some_and(|hold| !hold.moved && hold.place == place)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_click_is_a_press_and_a_release_at_one_place() {
        let mut hand = Hand::default();
        assert!(!hand.release((3, 4)));
        hand.grab((3, 4));
        assert_eq!(hand.led_to((3, 4)), [0.0, 0.0]);
        assert!(hand.release((3, 4)));
        assert!(!hand.release((3, 4)));
        hand.grab((3, 4));
        assert!(!hand.release((3, 5)));
        hand.grab((3, 4));
        assert_eq!(hand.led_to((5, 3)), [2.0, -1.0]);
        assert_eq!(hand.led_to((3, 4)), [-2.0, 1.0]);
        assert!(!hand.release((3, 4)));
    }

    #[test]
    fn what_is_led_without_a_grab_is_no_click() {
        let mut hand = Hand::default();
        assert_eq!(hand.led_to((3, 4)), [0.0, 0.0]);
        assert_eq!(hand.led_to((5, 3)), [2.0, -1.0]);
        assert!(!hand.release((5, 3)));
        assert_eq!(hand.led_to((3, 4)), [0.0, 0.0]);
        assert!(!hand.release((3, 4)));
    }
}
