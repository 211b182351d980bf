//! No tier sees a sphere in the shadow of itself (acne), whatever its size and place; and normals are right from afar.

use spherule::color::Srgb;
use spherule::scene::{Light, Source};
use spherule::shade::{ShadowRays, Surfaces};
use spherule::structure::search::Tracing;
use spherule_kernel::{
    Coherence, HitPacket, Intersect, Level, Ray, RayPacket, Sphere, SphereList, Tier, Trace, Vec3,
};
use spherule_referee::random::Random;
use spherule_tests::oracle;

/// What a ray hits, as shading sees it: one lane of a packet.
struct Point {
    tracing: Tracing,
    spheres: SphereList,
    rays: [RayPacket; 1],
    hits: [HitPacket; 1],
    surfaces: Surfaces,
}

impl Point {
    fn new(tier: Tier, spheres: &SphereList, ray: &Ray) -> Option<Self> {
        let tracing = Tracing { tier, level: Level::best(), coherence: Coherence::Detect };
        let (rays, mut hits) = ([RayPacket::new(&[*ray])], [HitPacket::none()]);
        spheres.closest_hit_packets(tier, &mut Trace::new(), &rays, &mut hits);
        hits[0].hit(0)?;
        let (surfaces, spheres) = (Surfaces::default(), spheres.clone());
        Some(Self { tracing, spheres, rays, hits, surfaces })
    }

    /// Towards the side that the ray came from.
    fn normal(&mut self) -> Vec3 {
        let Self { tracing, spheres, rays, hits, surfaces } = self;
        let normal = surfaces.compute(*tracing, spheres.spheres(), &*rays, &*hits)[0].normal(0);
        if normal.dot(rays[0].ray(0).direction) > 0.0 { -normal } else { normal }
    }

    /// The shadow ray, if the surface faces the light.
    fn ray_to(&mut self, light: &Light) -> Option<Ray> {
        let Self { tracing, spheres, rays, hits, surfaces } = self;
        let surfaces = surfaces.compute(*tracing, spheres.spheres(), &*rays, &*hits);
        let hit = (&*rays as &[_], &*hits as &[_], surfaces);
        let mut shadow_rays = ShadowRays::default();
        let ray = shadow_rays.cast(*tracing, spheres.spheres(), hit, light)[0].ray(0);
        ray.is_live().then_some(ray)
    }
}

/// How many shadow rays from points of spheres of this radius and place meet their own sphere,
/// and how many were cast.
fn acne(tier: Tier, radius: f32, place: f32) -> (u32, u32) {
    let seed = u64::from(radius.to_bits()) << 32 | u64::from(place.to_bits());
    let mut random = Random::seeded(seed);
    let (mut own, mut cast) = (0, 0);
    for _ in 0..1000 {
        let center = place * random.in_cube(1.0);
        let sphere = Sphere { center, radius };
        // From up to ten radii away, towards a point of the ball.
        let origin =
            center + radius * (1.0 + 9.0 * random.between(-1.0, 1.0).abs()) * random.in_cube(1.0);
        let ray = Ray::new(origin, center + radius * random.in_cube(1.0) - origin);
        if (origin - center).length() < 1.001 * radius {
            continue; // From inside every shadow ray meets the sphere.
        }
        let spheres = SphereList::from([sphere]);
        let Some(mut point) = Point::new(tier, &spheres, &ray) else { continue };
        let normal = point.normal();
        // A light anywhere above the surface, and one that grazes it.
        let across = normal.cross(random.in_cube(1.0)).normalize();
        let grazing = across + 10_f32.powf(random.between(-1.0, 1.0) * 3.0 - 3.0) * normal;
        for direction in [random.in_cube(1.0), grazing] {
            let light = Light { source: Source::Direction(direction), color: Srgb::WHITE };
            let Some(ray) = point.ray_to(&light) else { continue };
            own += u32::from(spheres.any_hit(tier, &ray));
            cast += 1;
        }
    }
    (own, cast)
}

fn no_acne(tier: Tier) {
    let mut total = 0;
    for radius in [1e-6, 1e-3, 0.3, 1.0, 17.0, 1e4, 1e6, 4e6] {
        for place in [0.0, 1.0, 1e3, 1e6] {
            let (own, cast) = acne(tier, radius, place);
            assert_eq!(own, 0, "{tier:?}: radius {radius}, place {place}, of {cast}");
            total += cast;
        }
    }
    assert!(total > 12_000, "{total}");
}

#[test]
fn fast_has_no_acne() {
    no_acne(Tier::Fast);
}

#[test]
fn geometric_has_no_acne() {
    no_acne(Tier::Geometric);
}

#[test]
fn stable_has_no_acne() {
    no_acne(Tier::Stable);
}

#[test]
fn exact_has_no_acne() {
    no_acne(Tier::Exact);
}

/// The ground of `marbles`, seen from a little above it as far as the eye reaches.
#[test]
fn a_huge_ground_has_no_acne() {
    for (tier, radius) in
        Tier::ALL.map(|tier| [1e4, 1e6, 4e6].map(|radius| (tier, radius))).concat()
    {
        let sphere = Sphere { center: Vec3::new(0.0, -radius, 0.0), radius };
        let ground = SphereList::from([sphere]);
        let mut random = Random::seeded(7);
        let mut lit = 0;
        for _ in 0..20_000 {
            let (x, y) = (random.between(-1.0, 1.0), random.between(-1.0, 1.0));
            let ray = Ray::new(Vec3::new(0.0, 2.0, 8.0), Vec3::new(x, -y.abs(), -1.0));
            let Some(mut point) = Point::new(tier, &ground, &ray) else { continue };
            let source = Source::Direction(Vec3::new(-0.55, 0.9, 0.6));
            let light = Light { source, color: Srgb::WHITE };
            // If `Fast` or `Geometric` errs it may see the far side of the ground, which has no light.
            let Some(ray) = point.ray_to(&light) else { continue };
            assert_eq!(ground.closest_hit(tier, &ray), None, "{tier:?} {radius}");
            lit += 1;
        }
        assert!(lit > 10_000);
    }
}

/// From up to 10^7 radii away, where t is rounded to a radius: against integers, and nothing in its own shadow.
#[test]
fn from_afar_normals_are_right_and_nothing_shadows_itself() {
    let mut random = Random::seeded(8);
    let (mut hits, mut lit) = (0, 0);
    for distance in [3.0, 1e3, 1e5, 1e6, 3e6, 1e7] {
        for _ in 0..3000 {
            let radius = random.between(0.5, 4.0);
            let sphere = Sphere { center: random.in_cube(8.0), radius };
            let origin = sphere.center + distance * radius * random.direction();
            let target = sphere.center + radius * random.in_cube(1.0);
            let ray = Ray::new(origin, target - origin);
            let spheres = SphereList::from([sphere]);
            let Some(mut point) = Point::new(Tier::Exact, &spheres, &ray) else { continue };
            let [truth, _] = oracle::surface(&ray, &sphere, false).expect("a hit");
            let truth = Vec3::from_array(truth);
            let truth = if truth.dot(ray.direction) > 0.0 { -truth } else { truth };
            assert_eq!(point.normal(), truth, "at {distance}: {ray:?} {sphere:?}");
            hits += 1;
            let light =
                Light { source: Source::Direction(random.in_cube(1.0)), color: Srgb::WHITE };
            if let Some(ray) = point.ray_to(&light) {
                assert!(!spheres.any_hit(Tier::Exact, &ray), "{ray:?} {sphere:?}");
                lit += 1;
            }
        }
    }
    assert!(hits > 5000 && lit > 2000, "{hits} {lit}");
}

/// Shadows of balls on the ground that they touch, wherever the scene is moved to: every coordinate stays a number,
/// and so do the rays.
#[test]
fn contact_shadows_stay_where_a_scene_is_moved() {
    let shadowed = |place: f32| {
        let offset = Vec3::splat(place);
        let ball = |x: f32, z: f32, radius: f32| {
            // Touching, or overlapping by less than an eighth.
            let away = 64.0 + radius;
            let height = (away * away - x * x - z * z).sqrt();
            let center = offset + Vec3::new(x, (height * 8.0).floor() / 8.0, z);
            Sphere { center, radius }
        };
        let spheres = [
            Sphere { center: offset, radius: 64.0 },
            ball(0.0, 0.0, 4.0),
            ball(-9.5, 3.0, 5.0),
            ball(8.25, -2.5, 3.0),
            ball(3.5, 8.75, 2.0),
        ];
        let list = SphereList::from(&spheres[..]);
        let towards = Source::Direction(Vec3::new(0.5, 1.0, 0.25));
        let light = Light { source: towards, color: Srgb::WHITE };
        let mut count = 0;
        for x in -64..64_i16 {
            for z in -64..64_i16 {
                // From above, an eighth beside the lattice of the centres.
                let from = Vec3::new(f32::from(x) / 4.0 + 0.125, 128.0, f32::from(z) / 4.0 + 0.125);
                let ray = Ray::new(offset + from, -Vec3::Y);
                let Some(mut point) = Point::new(Tier::Exact, &list, &ray) else { continue };
                let ray = point.ray_to(&light);
                count += u32::from(ray.is_some_and(|ray| list.any_hit(Tier::Exact, &ray)));
            }
        }
        f64::from(count)
    };
    let at_home = shadowed(0.0);
    assert!(at_home > 1000.0, "{at_home}");
    for (place, part) in [(65_536.0, 0.01), (262_144.0, 0.02), (1_048_576.0, 0.05)] {
        let moved = shadowed(place);
        println!("{moved} of {at_home} pixels in shadow at {place}");
        assert!((moved - at_home).abs() <= part * at_home, "{moved} of {at_home} at {place}");
    }
}
