//! What an intersector says of a ray.

/// A hit as it was answered; a miss is `None`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Answer {
    /// Where the ray hits, in multiples of its direction. Widening an `f32` loses nothing.
    pub t: f64,
    /// The index of the sphere; `None` if the intersector does not say it.
    pub sphere: Option<u32>,
}

impl Answer {
    /// A hit of the only sphere.
    #[must_use]
    pub fn at(t: impl Into<f64>) -> Self {
        Self { t: t.into(), sphere: Some(0) }
    }
}
