//! D and both roots in double precision, each with the bound that `docs/numerics.md` proves.

use crate::DoubleLanes;
use crate::accuracy::constants::Constants;
use crate::numeric::axes::{axes, cross, dot, sum_of_magnitudes};

/// D and the roots as computed, each with a bound on its error.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Estimate<D> {
    pub(crate) discriminant: D,
    /// E.
    pub(crate) error: D,
    /// t and T of the smaller root; meaningless where D is not above E.
    pub(crate) near: (D, D),
    /// t and T of the larger root, likewise.
    pub(crate) far: (D, D),
}

/// The sums of an estimate over the axes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sums<D> {
    /// d.d.
    pub(super) a: D,
    /// d.p.
    pub(super) b: D,
    /// |d x p|^2.
    pub(super) square: D,
    /// The sum of the magnitudes of d.
    pub(super) d: D,
    /// The sum of the magnitudes of p.
    pub(super) p: D,
    /// The sum of the magnitudes of d x p.
    pub(super) x: D,
}

/// D as computed, its bound, and the parts of the roots.
#[derive(Clone, Copy, Debug)]
pub(super) struct Solved<D> {
    pub(super) discriminant: D,
    /// E.
    pub(super) error: D,
    /// sqrt D.
    pub(super) root: D,
    /// 1 / a.
    per_a: D,
    /// The part that the bounds of both roots share.
    shared: D,
}

impl<D: DoubleLanes> Sums<D> {
    #[inline(always)]
    pub(super) fn new(origin: [D; 3], d: [D; 3], center: [D; 3]) -> Self {
        let p = axes!(i => center[i] - origin[i]);
        let x = cross(d, p);
        Self {
            a: dot(d, d),
            b: dot(d, p),
            square: dot(x, x),
            d: sum_of_magnitudes(d),
            p: sum_of_magnitudes(p),
            x: sum_of_magnitudes(x),
        }
    }
}

impl<D: DoubleLanes> Solved<D> {
    #[inline(always)]
    pub(super) fn new(sums: &Sums<D>, radius: D, constants: &Constants) -> Self {
        let Sums { a, square, d, p, x, .. } = *sums;
        // D and its bound.
        let reach = a * (radius * radius);
        let discriminant = reach - square;
        let g = d * p;
        let error = a.like(constants.sums) * (reach + square)
            + a.like(constants.cross) * (x * g)
            + a.like(constants.square) * (g * g);

        let root = discriminant.sqrt();
        let inverse = a.like(1.0) / (a * root);
        let per_a = root * inverse;
        let shared =
            per_a * (a.like(constants.slope) * g + a.like(constants.root) * root) + error * inverse;
        Self { discriminant, error, root, per_a, shared }
    }

    /// t and its bound T, from `b_root`: b - sqrt D or b + sqrt D.
    #[inline(always)]
    pub(super) fn t(&self, b_root: D, constants: &Constants) -> (D, D) {
        let t = b_root * self.per_a;
        (t, self.shared + t.like(constants.t) * t.abs())
    }
}

impl<D: DoubleLanes> Estimate<D> {
    /// [`Constants::of`] the precision of these lanes.
    pub(crate) const PROVEN: Constants = Constants::of(D::UNIT_ROUNDOFF);

    #[inline(always)]
    pub(crate) fn new(
        origin: [D; 3],
        d: [D; 3],
        center: [D; 3],
        radius: D,
        constants: &Constants,
    ) -> Self {
        let sums = Sums::new(origin, d, center);
        let solved = Solved::new(&sums, radius, constants);
        let Solved { discriminant, error, root, .. } = solved;
        let (near, far) = (sums.b - root, sums.b + root);
        let (near, far) = (solved.t(near, constants), solved.t(far, constants));
        Self { discriminant, error, near, far }
    }
}
