//! Packets of rays, spheres and hits as memory: they return what was stored, in every lane width.

use spherule_kernel::{
    Camera, HitPacket, Lanes, Projection, Ray, RayPacket, Sphere, SpherePacket, Tier, Vec3, f32x4,
    f32x8, f32x16, pair_lanes,
};
use spherule_referee::families::FAMILIES;
use spherule_referee::random::Random;

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

/// Any camera, whose vectors have sizes of their own.
fn camera(random: &mut Random) -> Camera {
    let mut number = || (random.sign() * random.log_uniform(-6, 6)) as f32;
    let mut vector = || Vec3::from_array([(); 3].map(|()| number()));
    let (end, corner, step_x, step_y) = (vector(), vector(), vector(), vector());
    let projection = if random.one_in(2) {
        Projection::Perspective { eye: end }
    } else {
        Projection::Parallel { direction: end }
    };
    Camera { projection, corner, step_x, step_y }
}

/// The rays of a tile are those of its pixels, row by row; outside the picture there is none.
fn holds_the_rays_of_a_tile<L: Lanes>() {
    let (tile_width, tile_height): (u32, u32) = match L::COUNT {
        1 => (1, 1),
        4 => (2, 2),
        8 => (4, 2),
        _ => (4, 4),
    };
    assert_eq!(Camera::tile::<L::Array>(), (tile_width, tile_height));
    assert!(!Ray::INACTIVE.is_live());
    let mut random = Random::new(51, 0);
    for _ in 0..300 {
        let camera = camera(&mut random);
        let mut up_to = |end| random.integer(1, end) as u32;
        let (width, height) = (up_to(20), up_to(20));
        // Checks a packet, and counts its pixels in the picture.
        let pixels = |ix: u32, iy: u32| {
            let packet = camera.packet::<L::Array>(ix, iy, width, height);
            let mut pixels = 0;
            for lane in 0..L::COUNT as u32 {
                let (x, y) = (ix + lane % tile_width, iy + lane / tile_width);
                let inside = x < width && y < height;
                let expected = if inside { camera.get_ray(x, y) } else { Ray::INACTIVE };
                let found = packet.ray(lane as usize);
                assert_eq!(bits(&found), bits(&expected), "({x}, {y}) of {width} x {height}");
                pixels += u32::from(inside);
            }
            pixels
        };
        // Tiles hold all pixels.
        let mut held = 0;
        for iy in (0..height).step_by(tile_height as usize) {
            for ix in (0..width).step_by(tile_width as usize) {
                held += pixels(ix, iy);
            }
        }
        assert_eq!(held, width * height);
        // A packet may begin anywhere, also outside.
        pixels(up_to(40), up_to(40));
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
