//! The surface where rays hit spheres: normals and points that owe nothing to t.

use crate::accuracy::{Accuracy, RayLanes, TierFormula, TierWork};
use crate::geometry::hit::HitPacket;
use crate::geometry::ray::Ray;
use crate::geometry::ray_packet::RayPacket;
use crate::geometry::sphere::{Sphere, Spheres};
use crate::geometry::surface::{Surface, SurfacePacket};
use crate::lanes::{LaneArray, LaneMask, Lanes};
use crate::numeric::axes::{axes, dot};
use glam::Vec3;

/// Returns the surface that `ray` hits at `t`: its unit normal, and the point as seen from the centre. `t` is the answer of
/// `tier` for `sphere`.
///
/// [`Exact`](crate::Exact) rounds every coordinate correctly, as at the point where the line really meets the sphere, however
/// far away. By the other tiers a normal is off by at most 2^-24 plus e / cos, where e = 2^-50 (|p| + r) / r, p is the centre
/// less the origin, and cos is the cosine of normal and ray. √e replaces e / cos where it is less. (A point o + t d is off by
/// 2^-24 |p|, which from afar is more than r.)
///
/// A sphere of radius zero has the point zero, and a normal that points back along the ray. If `t` is not the tier's
/// answer, the surface is that at the nearer root. If ray or sphere is not valid, the numbers have no meaning.
///
/// Cost: some 150 double-precision operations, by `Exact` twice as many. A coordinate that these cannot round takes 2
/// microseconds and 2.5 KiB of stack: one in 10^7; near zero on a large close sphere, one in 10^4.
///
/// ```
/// use spherule_kernel::{Exact, Intersect, Ray, Sphere, SphereList, Vec3, surface};
///
/// let sphere = Sphere::from([0.0, 0.0, 1e7, 1.0]);
/// let ray = Ray::new(Vec3::ZERO, Vec3::new(6e-8, 0.0, 1.0));
/// let hit = SphereList::from([sphere]).closest_hit(Exact, &ray).expect("a hit");
/// let normal = surface(Exact, &ray, hit.t, &sphere).normal;
/// assert!((normal.x - 0.6).abs() < 1e-6 && (normal.z + 0.8).abs() < 1e-6);
/// ```
#[must_use]
pub fn surface(tier: impl Accuracy, ray: &Ray, t: f32, sphere: &Sphere) -> Surface {
    if sphere.radius == 0.0 {
        return of_a_point(ray);
    }
    tier.with_formula(SurfaceOf { ray, t, sphere })
}

/// A sphere of radius zero has no surface: its normal points back along the ray.
fn of_a_point(ray: &Ray) -> Surface {
    let d = ray.direction.to_array().map(f64::from);
    let length = libm::sqrt(dot(d, d));
    let normal = axes!(i => (-d[i] / length) as f32 + 0.0);
    Surface { normal: Vec3::from_array(normal), point: Vec3::ZERO, rest: Vec3::ZERO }
}

/// The arguments of [`surface`].
struct SurfaceOf<'a> {
    ray: &'a Ray,
    t: f32,
    sphere: &'a Sphere,
}

impl TierWork for SurfaceOf<'_> {
    type Output = Surface;

    fn run<F: TierFormula>(self) -> Surface {
        let Self { ray, t, sphere } = self;
        self.known::<F>().unwrap_or_else(|| F::surface_at(ray, t, sphere))
    }
}

impl SurfaceOf<'_> {
    /// The surface as lanes find it; `None` if they do not know it. (A function of its own, so that it is not on the stack
    /// with exact sums.)
    #[inline(never)]
    fn known<F: TierFormula>(&self) -> Option<Surface> {
        let &Self { ray, t, sphere } = self;
        let rays =
            RayLanes::<f32>::load((), &RayPacket::<[f32; 1]>::new(core::slice::from_ref(ray)));
        let center = sphere.center.to_array();
        let (found, known) = F::surfaces::<f32>(&rays, t, center, sphere.radius, true);
        let [normal, point, rest] = [found.normal, found.point, found.rest].map(Vec3::from_array);
        known.then_some(Surface { normal, point, rest })
    }
}

/// Returns the surfaces that the rays of a packet hit among `spheres`; zeros where a ray hits nothing. `hits` are the answers
/// of `tier` for `rays`.
///
/// Each is bit for bit what [`surface`](crate::surface()) returns for one ray, in every lane width. Cost: in sixteen lanes
/// some 6 ns a ray, hit or not.
///
/// ```
/// use spherule_kernel::{
///     Exact, HitPacket, Intersect, Ray, RayPacket, SphereList, Trace, Vec3, f32x8, surface_lanes,
/// };
///
/// let spheres = SphereList::from([[0.0, 0.0, 5.0, 1.0]]);
/// let rays = [RayPacket::<[f32; 8]>::new(&[Ray::new(Vec3::ZERO, Vec3::Z)])];
/// let mut hits = [HitPacket::<[f32; 8]>::none()];
/// spheres.closest_hit_lanes::<f32x8>(Exact, (), &mut Trace::new(), &rays, &mut hits);
/// let surfaces = surface_lanes::<f32x8>(Exact, (), spheres.spheres(), &rays[0], &hits[0]);
/// assert_eq!([surfaces.normal(0), surfaces.normal(1)], [-Vec3::Z, Vec3::ZERO]);
/// ```
#[must_use]
#[inline(always)]
pub fn surface_lanes<L: Lanes>(
    tier: impl Accuracy,
    token: L::Token,
    spheres: Spheres<'_>,
    rays: &RayPacket<L::Array>,
    hits: &HitPacket<L::Array>,
) -> SurfacePacket<L::Array> {
    let mut surfaces = SurfacePacket::none();
    tier.with_formula(Surfaces::<L> {
        token,
        spheres: &spheres,
        rays,
        hits,
        surfaces: &mut surfaces,
    });
    surfaces
}

/// [`surface_lanes`], packet by packet.
#[inline(always)]
pub(crate) fn each_packet<L: Lanes>(
    tier: impl Accuracy,
    token: L::Token,
    spheres: Spheres<'_>,
    rays: &[RayPacket<L::Array>],
    hits: &[HitPacket<L::Array>],
    surfaces: &mut [SurfacePacket<L::Array>],
) {
    for place in 0..rays.len().min(hits.len()).min(surfaces.len()) {
        if let (Some(rays), Some(hits), Some(surfaces)) =
            (rays.get(place), hits.get(place), surfaces.get_mut(place))
        {
            tier.with_formula(Surfaces::<L> { token, spheres: &spheres, rays, hits, surfaces });
        }
    }
}

/// The arguments of [`surface_lanes`].
struct Surfaces<'a, L: Lanes> {
    token: L::Token,
    /// By reference: a copy took a sixth of a packet's time.
    spheres: &'a Spheres<'a>,
    rays: &'a RayPacket<L::Array>,
    hits: &'a HitPacket<L::Array>,
    /// What is found.
    surfaces: &'a mut SurfacePacket<L::Array>,
}

impl<L: Lanes> TierWork for Surfaces<'_, L> {
    type Output = ();

    #[inline(always)]
    fn run<F: TierFormula>(self) {
        let Self { token, spheres, rays: packet, hits, surfaces } = self;
        let Some(HitSpheres { center, radius, hit }) = HitSpheres::gather(token, spheres, hits)
        else {
            *surfaces = SurfacePacket::none();
            return;
        };
        let rays = RayLanes::<L>::load(token, packet);
        let t = L::load(token, &hits.t);
        let zero = t.like(0.0);
        let active = L::mask(token, hit) & zero.lt(radius);
        let (found, known) = F::surfaces(&rays, t, center, radius, active);
        for i in 0..3 {
            surfaces.normal[i] = L::select(known, found.normal[i], zero).store();
            surfaces.point[i] = L::select(known, found.point[i], zero).store();
            surfaces.rest[i] = L::select(known, found.rest[i], zero).store();
        }
        let unknown = hit & !known.bits();
        if unknown != 0 {
            one_by_one::<F, L::Array>(unknown, spheres, packet, hits, surfaces);
        }
    }
}

/// The spheres that the rays of a packet hit.
pub(crate) struct HitSpheres<L: Lanes> {
    pub(crate) center: [L; 3],
    pub(crate) radius: L,
    /// Which rays hit any, a bit a lane.
    pub(crate) hit: u32,
}

impl<L: Lanes> HitSpheres<L> {
    /// `None` if no ray hits anything.
    #[inline(always)]
    pub(crate) fn gather(
        token: L::Token,
        spheres: &Spheres<'_>,
        hits: &HitPacket<L::Array>,
    ) -> Option<Self> {
        let (indices, count) = (hits.sphere.as_ref(), spheres.len());
        let mut hit = 0_u32;
        for lane in 0..L::COUNT {
            let index = indices.get(lane).map_or(usize::MAX, |&index| index as usize);
            hit |= u32::from(index < count) << lane;
        }
        if hit == 0 {
            return None;
        }
        // Sphere by sphere, since the rays of a packet hit few. (Lane by lane, which is the CPU's gather: a fifth
        // more of a surface's time on u64.)
        let zero = L::splat(token, 0.0);
        let (mut center, mut radius) = ([zero; 3], zero);
        let mut left = hit;
        while left != 0 {
            let lane = left.trailing_zeros() as usize;
            let index = indices.get(lane).map_or(u32::MAX, |&index| index);
            let mut same = 0_u32;
            for lane in 0..L::COUNT {
                let is_same = indices.get(lane).is_some_and(|&other| other == index);
                same |= u32::from(is_same) << lane;
            }
            left &= !same;
            if let Some(sphere) = spheres.get(index as usize) {
                let same = L::mask(token, same);
                for i in 0..3 {
                    center[i] = L::select(same, L::splat(token, sphere.center()[i]), center[i]);
                }
                radius = L::select(same, L::splat(token, sphere.radius), radius);
            }
        }
        Some(Self { center, radius, hit })
    }
}

/// Finds the surfaces of the lanes whose bit is set.
#[cold]
#[inline(never)]
fn one_by_one<F: TierFormula, A: LaneArray>(
    mut lanes: u32,
    spheres: &Spheres<'_>,
    rays: &RayPacket<A>,
    hits: &HitPacket<A>,
    surfaces: &mut SurfacePacket<A>,
) {
    while lanes != 0 {
        let lane = lanes.trailing_zeros() as usize;
        lanes &= lanes - 1;
        if let Some(hit) = hits.hit(lane)
            && let Some(sphere) = spheres.get(hit.sphere as usize)
        {
            surfaces.set(lane, &surface(F::THIS, &rays.ray(lane), hit.t, &sphere));
        }
    }
}
