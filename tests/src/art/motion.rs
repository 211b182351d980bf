//! Pictures one after the other: whether they change as the truth changes.

use super::figures::{READING, oklab};
use super::light::Light;

/// The deviation of the eye's blur, in pixels from reading distance: a thirtieth of a degree.
const SPREAD: f32 = READING / 30.0;

/// How pictures change from one to the next, in OKLab.
#[derive(Clone, Debug)]
pub struct Changes {
    /// As an eye sees the changes from reading distance.
    seen: Vec<Vec<[f32; 3]>>,
    /// Pixel by pixel.
    plain: Vec<Vec<[f32; 3]>>,
}

/// The error of changes: the root of the mean squared distance in OKLab from the changes of the truth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unrest {
    /// As an eye sees the changes from reading distance.
    pub seen: f64,
    /// Pixel by pixel.
    pub plain: f64,
}

impl Changes {
    /// The changes of pictures of the same size.
    #[must_use]
    pub fn new(pictures: &[Light]) -> Self {
        let changes = |look: &dyn Fn(&Light) -> Vec<[f32; 3]>| {
            let looks: Vec<_> = pictures.iter().map(look).collect();
            looks.windows(2).map(|pair| difference(&pair[1], &pair[0])).collect()
        };
        Self { seen: changes(&|light| oklab(&light.blurred(SPREAD))), plain: changes(&oklab) }
    }

    /// How far the changes are from those of the truth; 0 if there is only one picture.
    ///
    /// # Panics
    /// If the truth has more or fewer changes.
    #[must_use]
    pub fn unrest(&self, truth: &Self) -> Unrest {
        Unrest { seen: error(&self.seen, &truth.seen), plain: error(&self.plain, &truth.plain) }
    }
}

fn difference(a: &[[f32; 3]], b: &[[f32; 3]]) -> Vec<[f32; 3]> {
    a.iter().zip(b).map(|(a, b)| std::array::from_fn(|axis| a[axis] - b[axis])).collect()
}

fn error(changes: &[Vec<[f32; 3]>], truth: &[Vec<[f32; 3]>]) -> f64 {
    assert_eq!(changes.len(), truth.len(), "as many pictures");
    let (mut sum, mut count) = (0.0, 0_usize);
    for (change, truth) in changes.iter().zip(truth) {
        let pairs = change.as_flattened().iter().zip(truth.as_flattened());
        sum += pairs.map(|(&a, &b)| f64::from(a - b).powi(2)).sum::<f64>();
        count += change.len();
    }
    (sum / count.max(1) as f64).sqrt()
}
