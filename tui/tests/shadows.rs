//! No tier sees a sphere in the shadow of itself (acne), whatever its size and place.

use spherule_kernel::{
    Accuracy, Exact, Fast, Ray, RayPacket, Sphere, Spheres, Stable, Vec3, any, f32x8, nearest_hit,
};
use spherule_tui::color::Srgb;
use spherule_tui::scene::{Light, Source};
use spherule_tui::shade::SurfacePoint;

/// Numbers in (-1, 1), the same in every run (splitmix64).
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f32 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 40) as f32 / (1 << 23) as f32 - 1.0
    }

    fn vector(&mut self) -> Vec3 {
        Vec3::new(self.next(), self.next(), self.next())
    }
}

/// How many shadow rays from points of spheres of this radius and place meet their own sphere,
/// and how many were cast.
fn acne<A: Accuracy>(radius: f32, place: f32) -> (u32, u32) {
    let mut numbers = Numbers(u64::from(radius.to_bits()) << 32 | u64::from(place.to_bits()));
    let (mut own, mut cast) = (0, 0);
    for _ in 0..4000 {
        let center = place * numbers.vector();
        let sphere = Sphere { center, radius };
        // From up to ten radii away, towards a point of the ball.
        let origin = center + radius * (1.0 + 9.0 * numbers.next().abs()) * numbers.vector();
        let ray = Ray::new(origin, center + radius * numbers.vector() - origin);
        if (origin - center).length() < 1.001 * radius {
            continue; // From inside every shadow ray meets the sphere.
        }
        let [x, y, z] = center.to_array().map(|x| [x]);
        let r = [radius];
        let spheres = Spheres::new(&x, &y, &z, &r).expect("one sphere");
        let Some(hit) = nearest_hit::<A>(&ray, spheres) else { continue };
        let point = SurfacePoint::new(&ray, hit.t, &sphere);
        // A light anywhere above the surface, and one that grazes it.
        let across = point.normal.cross(numbers.vector()).normalize();
        let grazing = across + 10_f32.powf(numbers.next() * 3.0 - 3.0) * point.normal;
        for direction in [numbers.vector(), grazing] {
            let light = Light { source: Source::Direction(direction), color: Srgb::WHITE };
            let Some((ray, _)) = point.towards(&light) else { continue };
            let mut met = [0];
            any::<A, f32x8>((), &[RayPacket::<f32x8>::new(&[ray])], spheres, &mut met);
            own += met[0];
            cast += 1;
        }
    }
    (own, cast)
}

fn no_acne<A: Accuracy>() {
    let mut total = 0;
    for radius in [1e-6, 1e-3, 0.3, 1.0, 17.0, 1e4, 1e6, 4e6] {
        for place in [0.0, 1.0, 1e3, 1e6] {
            let (own, cast) = acne::<A>(radius, place);
            assert_eq!(own, 0, "{}: radius {radius}, place {place}, of {cast}", A::NAME);
            total += cast;
        }
    }
    assert!(total > 50_000, "{total}");
}

#[test]
fn fast_has_no_acne() {
    no_acne::<Fast>();
}

#[test]
fn stable_has_no_acne() {
    no_acne::<Stable>();
}

#[test]
fn exact_has_no_acne() {
    no_acne::<Exact>();
}

/// The ground of `marbles`, seen from a little above it as far as the eye reaches.
#[test]
fn a_huge_ground_has_no_acne() {
    fn seen_from_above<A: Accuracy>() {
        for radius in [1e4_f32, 1e6, 4e6] {
            let (x, y, z, r) = ([0.0], [-radius], [0.0], [radius]);
            let ground = Spheres::new(&x, &y, &z, &r).expect("one sphere");
            let sphere = ground.get(0).expect("the ground");
            let mut numbers = Numbers(7);
            let mut lit = 0;
            for _ in 0..20_000 {
                let direction = Vec3::new(numbers.next(), -numbers.next().abs(), -1.0);
                let ray = Ray::new(Vec3::new(0.0, 2.0, 8.0), direction);
                let Some(hit) = nearest_hit::<A>(&ray, ground) else { continue };
                let point = SurfacePoint::new(&ray, hit.t, &sphere);
                let source = Source::Direction(Vec3::new(-0.55, 0.9, 0.6));
                let light = Light { source, color: Srgb::WHITE };
                // Where `Fast` errs it may see the far side of the ground, which has no light.
                let Some((ray, _)) = point.towards(&light) else { continue };
                assert_eq!(nearest_hit::<A>(&ray, ground), None, "{} {radius}", A::NAME);
                lit += 1;
            }
            assert!(lit > 10_000);
        }
    }
    seen_from_above::<Fast>();
    seen_from_above::<Stable>();
    seen_from_above::<Exact>();
}
