//! Shadow rays from the hits of packets: in lanes what [`Surface::spawn_ray`](crate::Surface::spawn_ray) is for one ray.
//!
//! Steps are tried in double-precision lanes; a ray that these cannot decide goes on alone.

use super::side::GRAZING;
use super::start::{DEEP, start_of};
use super::steps::{next, step_of};
use crate::accuracy::{Accuracy, RayLanes, Tier, test_lanes};
use crate::geometry::hit::HitPacket;
use crate::geometry::ray::Ray;
use crate::geometry::ray_packet::RayPacket;
use crate::geometry::sphere::Spheres;
use crate::geometry::surface::SurfacePacket;
use crate::lanes::{DoubleLanes, LaneArray, LaneMask, Lanes};
use crate::numeric::axes::{axes, dot, largest};
use crate::numeric::power_of_point::power_of;
use crate::numeric::rounding::DOUBLE_U as U;
use crate::surface::HitSpheres;
use glam::Vec3;

/// Where shadow rays go.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Towards {
    /// In this direction, without an end.
    Direction(Vec3),
    /// To this point, which is at t = 1, where the rays end.
    Point(Vec3),
}

/// The rays of a packet, what they hit, and the surfaces there.
pub type SurfaceHit<'a, A = [f32; 16]> = (&'a RayPacket<A>, &'a HitPacket<A>, &'a SurfacePacket<A>);

/// The rays of many packets, what they hit, and the surfaces there.
pub type SurfaceHits<'a, A = [f32; 16]> =
    (&'a [RayPacket<A>], &'a [HitPacket<A>], &'a [SurfacePacket<A>]);

/// Returns rays to a light from the hits of a packet. Each begins on the side of the surface that its ray came from
/// ([`incident_side`](crate::Surface::incident_side)). The lane is inactive where that side does not face the light, where nothing was
/// hit, and where there is no ray by `spawn_ray`. `hits` and `surfaces` are the answers of `tier` for
/// `rays` among `spheres`.
///
/// A ray is bit for bit that of [`Surface::spawn_ray`](crate::Surface::spawn_ray) or `spawn_ray_to`, in every lane width. Cost:
/// in sixteen lanes some 10 ns a ray.
///
/// ```
/// use spherule_kernel::{
///     Exact, HitPacket, Intersect, Ray, RayPacket, SphereList, Towards, Trace, Vec3, f32x8,
///     shadow_lanes, surface_lanes,
/// };
///
/// let spheres = SphereList::from([[0.0, 0.0, 5.0, 1.0]]);
/// let rays = [RayPacket::<[f32; 8]>::new(&[Ray::new(Vec3::ZERO, Vec3::Z)])];
/// let mut hits = [HitPacket::<[f32; 8]>::none()];
/// spheres.closest_hit_lanes::<f32x8>(Exact, (), &mut Trace::new(), &rays, &mut hits);
/// let surfaces = surface_lanes::<f32x8>(Exact, (), spheres.spheres(), &rays[0], &hits[0]);
/// let hit = (&rays[0], &hits[0], &surfaces);
/// let up = Towards::Direction(Vec3::new(0.0, 1.0, -1.0));
/// let shadow_rays = shadow_lanes::<f32x8>(Exact, (), spheres.spheres(), hit, up);
/// assert_eq!([shadow_rays.ray(0).is_live(), shadow_rays.ray(1).is_live()], [true, false]);
/// ```
#[must_use]
#[inline(always)]
pub fn shadow_lanes<L: Lanes>(
    tier: impl Accuracy,
    token: L::Token,
    spheres: Spheres<'_>,
    (rays, hits, surfaces): SurfaceHit<'_, L::Array>,
    towards: Towards,
) -> RayPacket<L::Array> {
    let Some(HitSpheres { center, radius, hit }) = HitSpheres::gather(token, &spheres, hits) else {
        return RayPacket::inactive();
    };
    let spawn = Spawn::<L>::new(rays, surfaces, center, radius);
    let (zero, none) = (radius.like(0.0), L::mask(token, 0));
    let from = spawn.origin(surfaces, zero, 0.0);
    let step = spawn.step(from);
    let faces = spawn.faces(direction_from(from, towards));

    let (mut waiting, mut left, mut alone) = (L::mask(token, hit) & faces, none, none);
    let (mut origin, mut direction) = ([zero; 3], [zero; 3]);
    let mut steps = 0.0;
    for _ in 0..MOST_TRIES {
        if !waiting.any() {
            break;
        }
        let tried = spawn.try_from(tier, surfaces, step, steps, towards, waiting);
        let taken = waiting & tried.spawned;
        for i in 0..3 {
            origin[i] = L::select(taken, tried.origin[i], origin[i]);
            direction[i] = L::select(taken, tried.direction[i], direction[i]);
        }
        left = left | taken;
        alone = alone | (waiting & tried.unknown);
        waiting = waiting & !taken & !tried.unknown;
        steps = next(steps);
    }

    let end = if let Towards::Point(_) = towards { 1.0 } else { f32::INFINITY };
    let mut shadow_rays = RayPacket {
        alignment: L::Array::ALIGNMENT,
        origin: axes!(i => origin[i].store()),
        direction: axes!(i => direction[i].store()),
        t_min: L::select(left, start_of(direction, radius), zero.like(f32::INFINITY)).store(),
        t_max: L::select(left, zero.like(end), zero.like(f32::NEG_INFINITY)).store(),
    };
    let alone = (alone | waiting).bits();
    if alone != 0 {
        let hit = (rays, hits, surfaces);
        one_by_one(tier.tier(), alone, spheres, hit, towards, &mut shadow_rays);
    }
    shadow_rays
}

/// How many origins are tried in lanes.
const MOST_TRIES: u32 = 8;

/// [`shadow_lanes`], packet by packet.
#[inline(always)]
pub(crate) fn each_packet<L: Lanes>(
    tier: impl Accuracy,
    token: L::Token,
    spheres: Spheres<'_>,
    hit: SurfaceHits<'_, L::Array>,
    towards: Towards,
    shadow_rays: &mut [RayPacket<L::Array>],
) {
    for place in 0..shadow_rays.len() {
        if let (Some(rays), Some(hits), Some(surfaces), Some(shadow_rays)) =
            (hit.0.get(place), hit.1.get(place), hit.2.get(place), shadow_rays.get_mut(place))
        {
            *shadow_rays = shadow_lanes::<L>(tier, token, spheres, (rays, hits, surfaces), towards);
        }
    }
}

/// Makes the rays of the lanes whose bit is set.
#[cold]
#[inline(never)]
fn one_by_one<A: LaneArray>(
    tier: Tier,
    mut lanes: u32,
    spheres: Spheres<'_>,
    (rays, hits, surfaces): SurfaceHit<'_, A>,
    towards: Towards,
    shadow_rays: &mut RayPacket<A>,
) {
    while lanes != 0 {
        let lane = lanes.trailing_zeros() as usize;
        lanes &= lanes - 1;
        let sphere = hits.hit(lane).and_then(|hit| spheres.get(hit.sphere as usize));
        let Some(sphere) = sphere else { continue };
        let surface = surfaces.surface(lane);
        let side = surface.incident_side(rays.ray(lane).direction);
        let ray = match towards {
            Towards::Direction(direction) => surface.spawn_ray(tier, &sphere, side, direction),
            Towards::Point(target) => surface.spawn_ray_to(tier, &sphere, side, target),
        };
        shadow_rays.set(lane, &ray.unwrap_or(Ray::INACTIVE));
    }
}

#[inline(always)]
fn direction_from<L: Lanes>(from: [L; 3], towards: Towards) -> [L; 3] {
    match towards {
        Towards::Direction(direction) => axes!(i => from[i].like(direction[i])),
        Towards::Point(point) => axes!(i => from[i].like(point[i]) - from[i]),
    }
}

/// Where n.d exceeds `least` times |d|_1. Double precision holds every product; in single precision that of a direction of 2^-149 is
/// zero.
#[inline(always)]
fn are_along<L: Lanes>(normal: [L; 3], direction: [L; 3], least: f64) -> L::Mask {
    let token = normal[0].token();
    let mut along = 0_u32;
    for part in 0..L::PARTS {
        let n = axes!(i => normal[i].widen(part));
        let d = axes!(i => direction[i].widen(part));
        let length = d[0].abs() + d[1].abs() + d[2].abs();
        // A way of infinite length has a side, too.
        let bound = if least == 0.0 { length.like(0.0) } else { length.like(least) * length };
        along |= bound.lt(dot(n, d)).bits() << (part * L::Double::COUNT);
    }
    L::mask(token, along)
}

/// Where rays are spawned.
#[derive(Clone, Copy)]
struct Spawn<L: Lanes> {
    center: [L; 3],
    radius: L,
    normal: [L; 3],
    /// The lanes whose rays came from inside.
    inside: L::Mask,
}

/// Origins that were tried, and what is known of them.
struct Tried<L: Lanes> {
    origin: [L; 3],
    direction: [L; 3],
    /// The ray is spawned.
    spawned: L::Mask,
    /// Double precision cannot tell.
    unknown: L::Mask,
}

impl<L: Lanes> Spawn<L> {
    #[inline(always)]
    fn new(
        rays: &RayPacket<L::Array>,
        surfaces: &SurfacePacket<L::Array>,
        center: [L; 3],
        radius: L,
    ) -> Self {
        let token = radius.token();
        let normal = axes!(i => L::load(token, &surfaces.normal[i]));
        let came = axes!(i => L::load(token, &rays.direction[i]));
        Self { center, radius, normal, inside: are_along(normal, came, GRAZING) }
    }

    /// Where the surface faces that way.
    #[inline(always)]
    fn faces(&self, direction: [L; 3]) -> L::Mask {
        let towards = axes!(i => L::select(self.inside, -self.normal[i], self.normal[i]));
        are_along(towards, direction, 0.0)
    }

    /// A step to the side where the ray is spawned.
    #[inline(always)]
    fn step(&self, point: [L; 3]) -> L {
        let step = step_of(point, self.radius);
        L::select(self.inside, -step, step)
    }

    /// The point so many steps from the surface, rounded once from double precision.
    #[inline(always)]
    fn origin(&self, surfaces: &SurfacePacket<L::Array>, step: L, steps: f64) -> [L; 3] {
        let token = step.token();
        let mut origin = [L::Array::filled(0.0); 3];
        for part in 0..L::PARTS {
            let step = step.widen(part);
            for i in 0..3 {
                let point = L::load(token, &surfaces.point[i]).widen(part);
                let point = point + L::load(token, &surfaces.rest[i]).widen(part);
                let point = self.center[i].widen(part) + point;
                let moved = point + step.like(steps) * step * self.normal[i].widen(part);
                L::narrow(&mut origin[i], part, moved);
            }
        }
        axes!(i => L::load(token, &origin[i]))
    }

    /// Tries the origins that are so many steps from the surface.
    #[inline(always)]
    fn try_from(
        &self,
        tier: impl Accuracy,
        surfaces: &SurfacePacket<L::Array>,
        step: L,
        steps: f64,
        towards: Towards,
        active: L::Mask,
    ) -> Tried<L> {
        let token = step.token();
        let origin = self.origin(surfaces, step, steps);
        let direction = direction_from(origin, towards);

        // On which side the origin surely is, and whether the ray surely goes away from the centre; and whether it is finite: the
        // way to a light may leave the range of numbers. From inside, whether its far side is surely not before the interval.
        let (start, longest) = (start_of(direction, self.radius), largest(direction));
        let [mut inner, mut outer, mut away, mut deep, mut finite] = [0_u32; 5];
        for part in 0..L::PARTS {
            let first = part * L::Double::COUNT;
            let d = axes!(i => direction[i].widen(part));
            let x = axes!(i => origin[i].widen(part));
            let c = axes!(i => self.center[i].widen(part));
            let radius = self.radius.widen(part);
            let (power, margin) = power_of(x, c, radius);
            inner |= power.lt(-margin).bits() << first;
            if self.inside.any() {
                let near = radius.like(DEEP) * radius * (start.widen(part) * longest.widen(part));
                deep |= power.lt(-(margin + near)).bits() << first;
            }
            outer |= margin.lt(power).bits() << first;
            let q = axes!(i => x[i] - c[i]);
            let size = dot(axes!(i => d[i].abs()), axes!(i => q[i].abs()));
            away |= (size.like(8.0 * U) * size).lt(dot(d, q)).bits() << first;
            finite |= size.lt(size.like(f64::INFINITY)).bits() << first;
        }
        let (inner, outer) = (L::mask(token, inner), L::mask(token, outer));
        let on_side = (self.inside & inner) | (!self.inside & outer);
        let unsure = !((inner | outer) & L::mask(token, finite));
        if tier.tier() == Tier::Exact {
            let leaves = L::mask(token, deep) | (!self.inside & L::mask(token, away));
            let spawned = on_side & !unsure & leaves;
            return Tried { origin, direction, spawned, unknown: unsure | (on_side & !spawned) };
        }

        // The tier says whether it sees the sphere. From inside it matters at which root: such rays go one by one. So do those
        // that go back, which may meet the sphere: the way to a light turns as the origin moves out.
        let (faces, infinity) = (self.faces(direction), step.like(f32::INFINITY));
        let outside = active & on_side & !unsure & !self.inside & faces;
        let rays = RayLanes { origin, direction, t_min: start, t_max: infinity, live: outside };
        let t = test_lanes(tier, &rays, self.center, self.radius, outside, infinity, true);
        let spawned = outside & !t.lt(infinity);
        let unknown = unsure | (on_side & (self.inside | !faces));
        Tried { origin, direction, spawned, unknown }
    }
}
