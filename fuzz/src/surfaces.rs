//! Surfaces and the rays spawned on them: the same bits at every layer, by `Exact` the bits of integers, and a spawned
//! ray meets nothing where it starts.

use crate::promise::is_stable_in_structures;
use spherule_kernel::{
    Intersect, Ray, Side, Sphere, SphereList, Tier, Towards, Vec3, roots, side, surface,
};
use spherule_referee::aim::double;
use spherule_referee::bytes::AimedScene;
use spherule_referee::random::dot;
use spherule_tests::oracle;
use spherule_tests::variants::{Layer, shadow_rays_of, surface_layers, surfaces_of};

/// Judges the surfaces that the rays of a scene hit.
///
/// # Panics
/// If one is wrong.
pub fn check(tier: Tier, scene: &AimedScene) {
    let AimedScene { rays, spheres, .. } = scene;
    let list = SphereList::from(&spheres[..]);
    let one_by_one = surfaces_of(tier, Layer::Ray, &list, rays);
    for layer in surface_layers() {
        let found = surfaces_of(tier, layer, &list, rays);
        for (index, (found, expected)) in found.iter().zip(&one_by_one).enumerate() {
            assert_eq!(
                bits(*found),
                bits(*expected),
                "{tier:?} {layer:?}, ray {index} of {scene:?}"
            );
        }
    }
    for (ray, surface) in rays.iter().zip(&one_by_one) {
        let Some(hit) = list.closest_hit(tier, ray) else { continue };
        let sphere = spheres[hit.sphere as usize];
        if tier == Tier::Exact {
            is_that_of_integers(ray, hit.t, &sphere, *surface);
        }
        for to in [Side::Outside, Side::Inside] {
            spawned_ray_misses(tier, ray, hit.t, &sphere, to);
        }
    }
    let in_domain = |ray: &&Ray| spheres.iter().all(|sphere| is_stable_in_structures(ray, sphere));
    let some: Vec<Ray> = rays.iter().filter(in_domain).copied().collect();
    if let [first, .., last] = some[..] {
        for towards in [Towards::Direction(-first.direction), Towards::Point(last.origin)] {
            shadow_rays_are_those_of_one_ray(tier, &list, &some, towards);
        }
    }
}

fn shadow_rays_are_those_of_one_ray(tier: Tier, list: &SphereList, rays: &[Ray], towards: Towards) {
    let of = |layer| {
        let spawned = shadow_rays_of(tier, layer, list, rays, towards);
        let all = |ray: Ray| {
            let interval = [ray.t_min, ray.t_max].map(f32::to_bits);
            ray.is_live().then(|| (bits([ray.origin, ray.direction]), interval))
        };
        spawned.into_iter().take(rays.len()).map(all).collect::<Vec<_>>()
    };
    let one_by_one = of(Layer::Ray);
    for layer in surface_layers() {
        let list = list.spheres();
        assert_eq!(of(layer), one_by_one, "{tier:?} {layer:?} {towards:?}: {rays:?} {list:?}");
    }
}

/// By bits: a coordinate may be NaN where a tier's arithmetic overflows.
fn bits(surface: [Vec3; 2]) -> [[u32; 3]; 2] {
    let bits = |x: f32| if x.is_nan() { u32::MAX } else { x.to_bits() };
    surface.map(|v| v.to_array().map(bits))
}

fn is_that_of_integers(ray: &Ray, t: f32, sphere: &Sphere, found: [Vec3; 2]) {
    // By rule 4 the near root is the hit, if it is rounded to t.
    let leaves = oracle::roots(ray, sphere).is_some_and(|[near, _]| near != t);
    if let Some(truth) = oracle::surface(ray, sphere, leaves) {
        let truth = truth.map(|v| Vec3::from_array(v.map(|x| x + 0.0)));
        assert_eq!(bits(found), bits(truth), "{ray:?} {sphere:?}");
    }
}

fn spawned_ray_misses(tier: Tier, ray: &Ray, t: f32, sphere: &Sphere, to: Side) {
    let surface = surface(tier, ray, t, sphere);
    let outward = if to == Side::Outside { surface.normal } else { -surface.normal };
    // Away, by the ray's own direction turned, and along the normal.
    let turned = if dot(double(ray.direction), double(outward)) < 0.0 {
        -ray.direction
    } else {
        ray.direction
    };
    for direction in [turned, outward] {
        let Some(left) = surface.spawn_ray(tier, sphere, to, direction) else { continue };
        assert_eq!(side(left.origin, sphere), Some(to), "{left:?} {sphere:?}");
        let met = roots(tier, &left, sphere);
        match to {
            Side::Outside => {
                let seen = SphereList::from([*sphere]).any_hit(tier, &left);
                assert!(!seen, "{tier:?} {left:?} {sphere:?}");
            }
            Side::Inside => {
                let near = met.is_some_and(|[near, _]| left.t_min <= near);
                assert!(!near, "{tier:?} {left:?} {sphere:?}");
            }
        }
    }
}
