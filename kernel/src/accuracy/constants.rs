//! The largest errors of double precision, in the estimates of `Exact` and of surfaces.

/// The factors of the terms in the bounds of D and of t.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Constants {
    /// Of A + L, in the bound of D.
    pub(crate) sums: f64,
    /// Of X G, in the bound of D.
    pub(crate) cross: f64,
    /// Of G^2, in the bound of D.
    pub(crate) square: f64,
    /// Of G / a, in the bound of t.
    pub(crate) slope: f64,
    /// Of sqrt D / a, in the bound of t.
    pub(crate) root: f64,
    /// Of |t|, in the bound of t.
    pub(crate) t: f64,
}

impl Constants {
    /// The proof's factors for double precision.
    pub(crate) const PROVEN: Self = Self::of(f64::EPSILON / 2.0);

    /// The proof's factors for a precision with that u.
    pub(crate) const fn of(u: f64) -> Self {
        Self {
            sums: 5.0 * u,
            cross: 8.0 * u,
            square: 32.0 * u * u,
            slope: 5.0 * u,
            root: 2.0 * u,
            t: 11.0 * u,
        }
    }
}
