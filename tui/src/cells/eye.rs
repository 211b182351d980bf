//! How far away the eye is, and what it sees of a cell from there.
//!
//! From the chair, 60 cm from cells 2.2 mm wide, a cell is a fifth of a degree wide, and an eye that resolves a sixtieth of a degree tells
//! a twelfth of a cell: it sees single pixels. From across the room it sees a cell as little more than a point: it sees means. In between
//! both count. So three choices depend on the distance: whether a colour is what most pixels have or their mean, how much of the space
//! around them letters and dots light up, and how much of what a cell lacks its neighbours make up for.
//!
//! For halves of marbles, FLIP at 38 pixels a degree over chafa's, and dB from across the room, are 0.897 and 42.8 with all handed on,
//! 0.892 and 42.6 with 0.85 of it, 0.886 and 42.3 with 0.7 of it; 0.94 and 43.3 with all, and means instead of medians.

use crate::style::CHAIR;

/// Four metres.
const ROOM: f32 = 1800.0;

/// What an eye makes of a cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Eye {
    /// How much of a colour is the mean of light, and not what most pixels have: 0 from the chair and nearer, 1 from across the
    /// room and beyond.
    pub means: f32,
    /// How much letters and dots lend to the space around them: 0 if single pixels are seen, 1 if their mean is.
    pub lent: f32,
    /// How much of what cells lack is handed to their neighbours.
    pub handed: f32,
}

impl Eye {
    /// The eye that follows a picture that moves: [changes](super::change) count, and handing on would change the neighbours, too.
    pub const MOVING: Self = Self { means: 1.0, lent: 0.0, handed: 0.0 };

    /// The eye at so many widths of a cell; less than 0 counts as 0.
    #[must_use]
    pub fn at(widths: f32) -> Self {
        // 0 in the chair, 1 across the room, -1 as near again.
        let far = ((widths.max(0.0) / CHAIR).ln() / (ROOM / CHAIR).ln()).clamp(-1.0, 1.0);
        let handed = if far < 0.0 { 0.85 + 0.85 * far } else { 0.85 + 0.15 * far };
        Self { means: far.max(0.0), lent: 0.5 + 0.5 * far, handed }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_farther_the_more_means_count() {
        let all = [0.0, 1.0, 100.0, CHAIR, 500.0, 1000.0, ROOM, 1e6, f32::INFINITY].map(Eye::at);
        assert_eq!(all[0], Eye { means: 0.0, lent: 0.0, handed: 0.0 });
        assert_eq!(all[3], Eye { means: 0.0, lent: 0.5, handed: 0.85 });
        for eye in [all[6], all[7], all[8]] {
            assert_eq!(eye, Eye { means: 1.0, lent: 1.0, handed: 1.0 });
        }
        for pair in all.windows(2) {
            assert!(pair[0].means <= pair[1].means && pair[0].lent <= pair[1].lent);
            assert!(pair[0].handed <= pair[1].handed);
        }
        assert_eq!(Eye::at(-1.0), all[0]);
        // 60 cm, and four metres, from cells 2.2 mm wide.
        assert_eq!((Eye::at(600.0 / 2.2).means, Eye::at(290.0).means > 0.0), (0.0, true));
        assert!(Eye::at(4000.0 / 2.2).means == 1.0 && Eye::at(1700.0).means < 1.0);
    }
}
