//! What rays of a run have in common: an origin, or a direction.

use super::list::Listed;
use super::pencil::{LEAST_MARGIN, MARGIN, Pencil, Side};
use super::survey::Bounds;
use crate::accuracy::RayLanes;
use crate::axes::{axes, dot};
use crate::bvh::LARGEST;
use crate::bvh::slabs::{LONGEST, U};
use crate::{Accuracy, Lanes, Sphere, Vec3};

/// The steepest slope.
const STEEPEST: f32 = 2.0;

/// The axis that rays run along, and which way.
#[derive(Clone, Copy, Debug)]
pub(super) struct Heading {
    /// The axes across, and the one along.
    pub(super) axes: [usize; 3],
    /// 1 or -1.
    pub(super) sign: f32,
}

impl Heading {
    pub(super) fn of(direction: [f32; 3]) -> Self {
        let [x, y, z] = axes!(i => direction[i].abs());
        let axes = if z >= x && z >= y {
            [0, 1, 2]
        } else if y >= x {
            [2, 0, 1]
        } else {
            [1, 2, 0]
        };
        let along = direction.get(axes[2]).copied().unwrap_or_default();
        Self { axes, sign: if along < 0.0 { -1.0 } else { 1.0 } }
    }

    /// The components across, and the one along.
    #[inline(always)]
    pub(super) fn turned<T: Copy>(&self, [x, y, z]: [T; 3]) -> [T; 3] {
        match self.axes[2] {
            0 => [y, z, x],
            1 => [z, x, y],
            _ => [x, y, z],
        }
    }
}

/// What rays have in common, as a type: an origin, or a direction.
pub(super) trait View: Copy {
    /// The same, among others of its kind.
    fn seen_by(self) -> Seen;
    /// The rays' origins, from where the viewpoint is.
    fn origin<L: Lanes>(&self, rays: &RayLanes<L>) -> [L; 3];
    /// Which rays have in common what all have.
    fn shares<L: Lanes>(&self, rays: &RayLanes<L>) -> L::Mask;
    /// What the slopes, or the places in a plane across, of a group are bounded by.
    fn screen<L: Lanes>(&self, heading: &Heading, rays: &RayLanes<L>) -> [L; 2];
    /// How deep the rays start.
    fn depth<L: Lanes>(&self, rays: &RayLanes<L>) -> L;
    /// A centre from where the ray starts, for a member's [`View::origin`].
    fn seen<L: Lanes>(&self, center: [f32; 3], origin: [L; 3]) -> [L; 3];
    /// A sphere as lists hold it.
    fn listed(&self, sphere: &Sphere) -> Listed;
    /// What a group cannot leave.
    fn pencil<A: Accuracy>(&self, heading: &Heading, bounds: &Bounds, extent: f32) -> Pencil;
}

/// Rays from a common origin.
#[derive(Clone, Copy, Debug)]
pub(super) struct Perspective {
    pub(super) eye: [f32; 3],
}

/// Rays of a common direction.
#[derive(Clone, Copy, Debug)]
pub(super) struct Parallel {
    pub(super) direction: [f32; 3],
    /// The same of unit length.
    pub(super) unit: [f32; 3],
}

/// What an order was made for.
#[derive(Clone, Copy, Debug)]
pub(super) enum Seen {
    Perspective(Perspective),
    Parallel(Parallel),
}

#[inline(always)]
fn splat<L: Lanes>(token: L::Token, v: [f32; 3]) -> [L; 3] {
    axes!(i => L::splat(token, v[i]))
}

#[inline(always)]
fn equal<L: Lanes>(a: [L; 3], b: [L; 3]) -> L::Mask {
    let [x, y, z] = axes!(i => a[i].le(b[i]) & b[i].le(a[i]));
    x & y & z
}

impl View for Perspective {
    fn seen_by(self) -> Seen {
        Seen::Perspective(self)
    }

    #[inline(always)]
    fn origin<L: Lanes>(&self, rays: &RayLanes<L>) -> [L; 3] {
        splat(rays.t_min.token(), [0.0; 3])
    }

    #[inline(always)]
    fn seen<L: Lanes>(&self, center: [f32; 3], origin: [L; 3]) -> [L; 3] {
        splat(origin[0].token(), center)
    }

    fn listed(&self, sphere: &Sphere) -> Listed {
        let center = axes!(i => sphere.center[i] - self.eye[i]);
        let away = libm::sqrtf(dot(center, center));
        let margin = margin_of(away + sphere.radius);
        Listed {
            center,
            reach: sphere.radius + margin,
            depth: (away - sphere.radius).abs() - margin,
            index: 0,
        }
    }

    #[inline(always)]
    fn shares<L: Lanes>(&self, rays: &RayLanes<L>) -> L::Mask {
        equal(rays.origin, splat(rays.t_min.token(), self.eye))
    }

    #[inline(always)]
    fn screen<L: Lanes>(&self, heading: &Heading, rays: &RayLanes<L>) -> [L; 2] {
        let [i, j, k] = heading.turned(rays.direction);
        let per_k = k.like(1.0) / k;
        [i * per_k, j * per_k]
    }

    #[inline(always)]
    fn depth<L: Lanes>(&self, rays: &RayLanes<L>) -> L {
        rays.t_min.like(0.0)
    }

    #[inline(always)]
    fn pencil<A: Accuracy>(&self, heading: &Heading, bounds: &Bounds, extent: f32) -> Pencil {
        let Bounds { low, high, .. } = *bounds;
        let moved = 8.0 * U;
        let lower = [low[0] - moved * low[0].abs(), low[1] - moved * low[1].abs()];
        let upper = [high[0] + moved * high[0].abs(), high[1] + moved * high[1].abs()];
        // Where x_k is negative for all, the greater slope bounds x_i from below.
        let (first, last) = if heading.sign < 0.0 { (upper, lower) } else { (lower, upper) };
        let sides =
            [Side::new([first[0], last[0]], [0.0; 2]), Side::new([first[1], last[1]], [0.0; 2])];
        Pencil {
            axes: heading.axes,
            sides,
            normal: [0.0, 0.0, heading.sign],
            front: 0.0,
            pad: 0.0,
            end: bounds.end + A::SPREAD * extent,
        }
    }
}

impl View for Parallel {
    fn seen_by(self) -> Seen {
        Seen::Parallel(self)
    }

    #[inline(always)]
    fn origin<L: Lanes>(&self, rays: &RayLanes<L>) -> [L; 3] {
        rays.origin
    }

    #[inline(always)]
    fn seen<L: Lanes>(&self, center: [f32; 3], origin: [L; 3]) -> [L; 3] {
        axes!(i => L::splat(origin[0].token(), center[i]) - origin[i])
    }

    fn listed(&self, sphere: &Sphere) -> Listed {
        let center = sphere.center.to_array();
        let away = libm::sqrtf(dot(center, center));
        let reach = sphere.radius + margin_of(away + sphere.radius);
        Listed { center, reach, depth: dot(center, self.unit) - reach, index: 0 }
    }

    #[inline(always)]
    fn shares<L: Lanes>(&self, rays: &RayLanes<L>) -> L::Mask {
        equal(rays.direction, splat(rays.t_min.token(), self.direction))
    }

    #[inline(always)]
    fn screen<L: Lanes>(&self, heading: &Heading, rays: &RayLanes<L>) -> [L; 2] {
        let [i, j, k] = heading.turned(rays.origin);
        let [m_i, m_j] = self.slopes(heading);
        [k.like(-m_i).filter_mul_add(k, i), k.like(-m_j).filter_mul_add(k, j)]
    }

    #[inline(always)]
    fn depth<L: Lanes>(&self, rays: &RayLanes<L>) -> L {
        dot(rays.origin, splat(rays.t_min.token(), self.unit))
    }

    #[inline(always)]
    fn pencil<A: Accuracy>(&self, heading: &Heading, bounds: &Bounds, extent: f32) -> Pencil {
        let Bounds { low, high, .. } = *bounds;
        let [m_i, m_j] = self.slopes(heading);
        let pad = 2.0 * (MARGIN + A::SPREAD) * bounds.far;
        Pencil {
            axes: heading.axes,
            sides: [Side::new([m_i; 2], [low[0], high[0]]), Side::new([m_j; 2], [low[1], high[1]])],
            normal: heading.turned(self.unit),
            front: bounds.front,
            pad,
            end: bounds.end + pad + A::SPREAD * extent,
        }
    }
}

impl Perspective {
    /// Nothing where the bounds do not cover the origin.
    pub(super) fn new(eye: Vec3) -> Option<Self> {
        let eye = eye.to_array();
        let [x, y, z] = axes!(i => eye[i].abs() <= LARGEST);
        (x && y && z).then_some(Self { eye })
    }
}

impl Parallel {
    /// Nothing where the bounds do not cover the direction.
    pub(super) fn new(direction: Vec3) -> Option<Self> {
        let direction = direction.to_array();
        let a = dot(direction, direction);
        let per_length = 1.0 / libm::sqrtf(a);
        let unit = axes!(i => direction[i] * per_length);
        (1.0 / LONGEST..=LONGEST).contains(&a).then_some(Self { direction, unit })
    }

    #[inline(always)]
    fn slopes(&self, heading: &Heading) -> [f32; 2] {
        let [i, j, k] = heading.turned(self.direction);
        [i / k, j / k]
    }
}

/// Which rays the bounds cover.
#[inline(always)]
pub(super) fn fits<L: Lanes, V: View>(view: &V, heading: &Heading, rays: &RayLanes<L>) -> L::Mask {
    let d = rays.direction;
    let a = dot(d, d);
    let far = rays.origin[0].abs().filter_max(rays.origin[1].abs());
    let far = far.filter_max(rays.origin[2].abs());
    let [i, j, k] = heading.turned(d);
    let most = k * a.like(STEEPEST * heading.sign);
    view.shares(rays)
        & a.like(1.0 / LONGEST).le(a)
        & a.le(a.like(LONGEST))
        & far.le(a.like(LARGEST))
        & a.like(0.0).le(rays.t_min)
        & i.abs().filter_max(j.abs()).le(most)
}

/// What a reach is raised by.
fn margin_of(size: f32) -> f32 {
    MARGIN * size + LEAST_MARGIN
}
