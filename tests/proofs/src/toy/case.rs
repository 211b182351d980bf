//! Rays and spheres of integers, what is true of them, and what lanes hold of them.

use crate::accuracy::RayLanes;
use crate::exact::Root;
use crate::proofs::toy::floats::{Format, Toy};

/// o, d, c, r.
#[derive(Clone, Copy, Debug)]
pub(super) struct Case {
    pub(super) o: [i64; 3],
    pub(super) d: [i64; 3],
    pub(super) c: [i64; 3],
    pub(super) r: i64,
}

/// a, b, |d x p|^2 and D of a case, exactly.
#[derive(Clone, Copy, Debug)]
pub(super) struct Truth {
    pub(super) a: i64,
    pub(super) b: i64,
    pub(super) across: i64,
    pub(super) discriminant: i64,
}

impl Case {
    /// In the plane of x and y.
    pub(super) fn in_plane(o: [i64; 2], d: [i64; 2], c: [i64; 2], r: i64) -> Self {
        let [o, d, c] = [o, d, c].map(|[x, y]| [x, y, 0]);
        Self { o, d, c, r }
    }

    pub(super) fn truth(&self) -> Truth {
        let Self { o, d, c, r } = *self;
        let p = [c[0] - o[0], c[1] - o[1], c[2] - o[2]];
        let x = [d[1] * p[2] - d[2] * p[1], d[2] * p[0] - d[0] * p[2], d[0] * p[1] - d[1] * p[0]];
        let dot = |v: [i64; 3], w: [i64; 3]| v[0] * w[0] + v[1] * w[1] + v[2] * w[2];
        let (a, across) = (dot(d, d), dot(x, x));
        Truth { a, b: dot(d, p), across, discriminant: a * r * r - across }
    }

    pub(super) fn rays<F: Format>(&self, [t_min, t_max]: [f64; 2]) -> RayLanes<Toy<F>> {
        RayLanes {
            origin: lanes(self.o),
            direction: lanes(self.d),
            t_min: Toy::new(t_min),
            t_max: Toy::new(t_max),
            live: true,
        }
    }

    /// Its centre and its radius.
    pub(super) fn sphere<F: Format>(&self) -> ([Toy<F>; 3], Toy<F>) {
        (lanes(self.c), Toy::new(self.r as f64))
    }
}

impl Truth {
    /// How far from the centre the line passes.
    pub(super) fn distance(&self) -> f64 {
        (self.across as f64 / self.a as f64).sqrt()
    }

    /// A root, near enough for figures.
    pub(super) fn about(&self, root: Root) -> f64 {
        let [a, b, d] = [self.a, self.b, self.discriminant].map(|x| x as f64);
        match root {
            Root::Near => (b - d.sqrt()) / a,
            Root::Far => (b + d.sqrt()) / a,
        }
    }

    /// What is found for both roots, if there are any.
    pub(super) fn roots(&self, find: impl Fn(Root) -> f64) -> Option<[f64; 2]> {
        (self.discriminant >= 0).then(|| [Root::Near, Root::Far].map(find))
    }
}

/// The nearest numbers of a format.
pub(super) fn lanes<F: Format>(v: [i64; 3]) -> [Toy<F>; 3] {
    v.map(|x| Toy::new(x as f64))
}
