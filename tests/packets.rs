//! Packets of rays, spheres and hits as memory: they return what was stored, in every lane width.

use spherule_kernel::{
    Camera, HitPacket, Lanes, Projection, Ray, RayPacket, Sphere, SpherePacket, Tier, Vec3, f32x4,
    f32x8, f32x16, pair_lanes,
};
use spherule_referee::families::FAMILIES;

/// Some rays of any bits.
fn rays(count: u64) -> Vec<Ray> {
    FAMILIES[19].cases(count).map(|case| case.ray).collect()
}

fn bits(ray: &Ray) -> [u32; 8] {
    let ([ox, oy, oz], [dx, dy, dz]) = (ray.origin.to_array(), ray.direction.to_array());
    [ox, oy, oz, dx, dy, dz, ray.t_min, ray.t_max].map(f32::to_bits)
}

fn packs_and_unpacks<L: Lanes>() {
    let rays = rays(40);
    for count in 0..=40 {
        let packet = RayPacket::<L::Array>::new(&rays[..count]);
        for (lane, ray) in rays.iter().enumerate() {
            let expected = if lane < count.min(L::COUNT) { ray } else { &Ray::INACTIVE };
            assert_eq!(bits(&packet.ray(lane)), bits(expected), "lane {lane} of {}", L::COUNT);
        }
    }
}

fn sets_one_lane_and_no_other<L: Lanes>() {
    let rays = rays(40);
    let before = RayPacket::<L::Array>::new(&rays);
    for lane in 0..40 {
        let mut packet = before;
        packet.set(lane, &rays[39]);
        for other in 0..L::COUNT {
            let expected = if other == lane { &rays[39] } else { &rays[other] };
            assert_eq!(bits(&packet.ray(other)), bits(expected), "lane {lane} of {}", L::COUNT);
        }
    }
}

fn has_no_hit_without_a_lane<L: Lanes<Token = ()>>() {
    let ray = Ray::new(Vec3::new(0.0, 0.0, -3.0), Vec3::Z);
    let sphere = Sphere { center: Vec3::ZERO, radius: 1.0 };
    let rays = RayPacket::<L::Array>::new(&[ray; 40]);
    let hits =
        pair_lanes::<L>(Tier::Fast, (), &rays, &SpherePacket::<L::Array>::new(&[sphere; 40]));
    assert_eq!((hits.t().len(), hits.spheres().len()), (L::COUNT, L::COUNT));
    for lane in 0..40 {
        assert_eq!(hits.hit(lane).is_some(), lane < L::COUNT, "lane {lane} of {}", L::COUNT);
    }
    // Lanes without a sphere hit nothing, and both arrays say so.
    let hits = pair_lanes::<L>(Tier::Fast, (), &rays, &SpherePacket::<L::Array>::new(&[]));
    assert!(hits.t().iter().all(|&t| t == f32::INFINITY));
    assert!(hits.spheres().iter().all(|&sphere| sphere == HitPacket::<L::Array>::NO_SPHERE));
}

/// The rays of a tile are those of its pixels, row by row; outside the picture there is none.
fn holds_the_rays_of_a_tile<L: Lanes>() {
    let vector = |seed: u64| FAMILIES[0].case(seed).ray.origin;
    for projection in
        [Projection::Perspective { eye: vector(1) }, Projection::Parallel { direction: vector(2) }]
    {
        let camera = Camera { projection, corner: vector(3), step_x: vector(4), step_y: vector(5) };
        let (width, height) = Camera::tile::<L::Array>();
        assert_eq!((width * height) as usize, L::COUNT);
        assert!(width == height || width == 2 * height, "{width} x {height}");
        for (ix, iy) in [(0, 0), (8, 4), (11, 6), (13, 9), (40, 40)] {
            let packet = camera.packet::<L::Array>(ix, iy, 13, 8);
            for lane in 0..L::COUNT as u32 {
                let (x, y) = (ix + lane % width, iy + lane / width);
                let inside = x < 13 && y < 8;
                let expected = if inside { camera.get_ray(x, y) } else { Ray::INACTIVE };
                assert_eq!(bits(&packet.ray(lane as usize)), bits(&expected), "({x}, {y})");
            }
        }
    }
}

macro_rules! in_every_width {
    ($($test:ident: $check:ident;)*) => {
        $(
            #[test]
            fn $test() {
                $check::<f32>();
                $check::<f32x4>();
                $check::<f32x8>();
                $check::<f32x16>();
            }
        )*
    };
}

in_every_width! {
    a_packet_packs_and_unpacks: packs_and_unpacks;
    a_packet_sets_one_lane_and_no_other: sets_one_lane_and_no_other;
    a_packet_has_no_hit_without_a_lane: has_no_hit_without_a_lane;
    a_packet_holds_the_rays_of_a_tile: holds_the_rays_of_a_tile;
}
