//! Spheres as the filter reads them: prepared some at a time, on the stack.

use super::frame::{Frame, farthest};
use super::{BLOCK, GROUP, KAPPA};
use crate::accuracy::{RayLanes, Underflow};
use crate::geometry::sphere::Sphere;
use crate::geometry::sphere_run::SphereRun;
use crate::lanes::{LaneMask, Lanes};
use crate::numeric::axes::{axes, dot, largest};
use crate::numeric::rounding::LARGEST;
use crate::scale::scene::size;

/// Four spheres as the filter reads them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FilterGroup {
    pub(crate) center: [[f32; GROUP]; 3],
    /// r^2 - |c|^2, raised by the bound; `-inf` never passes, `+inf` always.
    pub(crate) excess: [f32; GROUP],
}

impl FilterGroup {
    pub(crate) const EMPTY: Self =
        Self { center: [[0.0; GROUP]; 3], excess: [f32::NEG_INFINITY; GROUP] };

    #[inline(always)]
    pub(super) fn put(&mut self, slot: usize, sphere: &Sphere, frame: &Frame, kappa: f32) {
        if !sphere.is_valid() {
            return;
        }
        if size(sphere) * frame.scale > LARGEST {
            self.excess[slot] = f32::INFINITY;
            return;
        }
        let center = sphere.center();
        let [x, y, z] = axes!(i => center[i] * frame.scale - frame.shift[i]);
        let radius = sphere.radius * frame.scale;
        self.center[0][slot] = x;
        self.center[1][slot] = y;
        self.center[2][slot] = z;
        self.excess[slot] = excess([x, y, z], radius, kappa, frame.least_size);
    }
}

/// r^2 - |c|^2, raised by the bound.
#[inline(always)]
pub(crate) fn excess<L: Lanes>(c: [L; 3], r: L, kappa: f32, least_size: f32) -> L {
    let (cc, rr) = (dot(c, c), r * r);
    (rr - cc) + r.like(kappa) * (cc + rr).filter_max(r.like(least_size * least_size))
}

/// The next spheres of a list, prepared on the stack.
#[derive(Clone, Debug)]
pub(crate) struct FilterBlock {
    /// The number of its first sphere.
    pub(crate) first: usize,
    groups: [FilterGroup; BLOCK],
    count: usize,
    pub(crate) frame: Frame,
    /// Whether the block is seen in the units of rays that start far away.
    from_afar: bool,
}

impl FilterBlock {
    /// A block without spheres.
    #[inline(always)]
    pub(crate) const fn empty() -> Self {
        let groups = [FilterGroup::EMPTY; BLOCK];
        Self { first: usize::MAX, groups, count: 0, frame: Frame::UNIT, from_afar: false }
    }

    /// Prepares spheres `first ..` of the list, as many as a block takes.
    pub(crate) fn prepare(
        &mut self,
        spheres: &(impl SphereRun + ?Sized),
        first: usize,
        underflow: Underflow,
    ) {
        self.prepare_in(Frame::of(spheres, first, underflow, 0.0), spheres, first, KAPPA);
        self.from_afar = false;
    }

    /// Whether the live rays may see the block better in another frame: they start out of its range, or others before
    /// them did.
    #[inline(always)]
    pub(crate) fn is_elsewhere<L: Lanes>(&self, rays: &RayLanes<L>) -> bool {
        let far = largest(rays.origin);
        let near = (far * far.like(self.frame.scale)).le(far.like(LARGEST));
        self.from_afar || (rays.live & !near).any()
    }

    /// Prepares the block once more, as these rays are to see it.
    #[inline(always)]
    pub(crate) fn see<L: Lanes>(
        &mut self,
        spheres: &(impl SphereRun + ?Sized),
        first: usize,
        underflow: Underflow,
        rays: &RayLanes<L>,
    ) {
        let frame = Frame::of(spheres, first, underflow, farthest(rays));
        if frame.scale < self.frame.scale || self.frame.scale < frame.scale {
            let usual = Frame::of(spheres, first, underflow, 0.0);
            self.prepare_in(frame, spheres, first, KAPPA);
            self.from_afar = frame.scale < usual.scale;
        }
    }

    /// Prepares the spheres in a frame. (In place: to make a block and move it took longer than to answer 64 rays by one sphere.)
    pub(crate) fn prepare_in(
        &mut self,
        frame: Frame,
        spheres: &(impl SphereRun + ?Sized),
        first: usize,
        kappa: f32,
    ) {
        (self.first, self.count, self.frame) = (first, 0, frame);
        for (group, start) in self.groups.iter_mut().zip((first..spheres.count()).step_by(GROUP)) {
            *group = FilterGroup::EMPTY;
            for slot in 0..GROUP {
                if let Some(sphere) = spheres.sphere(start + slot) {
                    group.put(slot, &sphere, &frame, kappa);
                }
            }
            self.count += 1;
        }
    }

    /// The groups, in the order of the list.
    #[inline(always)]
    pub(crate) fn groups(&self) -> &[FilterGroup] {
        self.groups.get(..self.count).unwrap_or(&[])
    }
}
