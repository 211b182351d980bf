//! Where what decides is just at its limit.

use super::hit_of;
use spherule_kernel::{Exact, Side, Tier, Vec3, roots};

/// Numbers end before the far side: its t is zero, from every origin.
#[test]
fn a_far_side_that_is_rounded_to_zero_is_no_reason_to_go_deeper() {
    let radius = 2_f32.powi(-30);
    let (surface, sphere) =
        hit_of(Tier::Exact, [2.0 * radius, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 0.0, radius]);
    let inwards = Vec3::new(-3e38, 0.0, 0.0);
    let spawned = surface.spawn_ray(Exact, &sphere, Side::Inside, inwards).expect("an origin");
    assert_eq!(roots(Exact, &spawned, &sphere).map(|[_, far]| far), Some(0.0));
}

#[test]
fn an_interval_begins_at_the_least_number_or_later() {
    let (surface, sphere) =
        hit_of(Tier::Exact, [3.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0]);
    let outwards = Vec3::new(3e38, 0.0, 0.0);
    let spawned = surface.spawn_ray(Exact, &sphere, Side::Outside, outwards).expect("an origin");
    assert_eq!(spawned.t_min.to_bits(), 1);
}

/// n.d is 2^-22 times the sum of the direction's coordinates, then an ulp more.
#[test]
fn a_ray_that_grazes_came_from_outside() {
    let (surface, _) = hit_of(Tier::Exact, [0.0, 0.0, 3.0], [0.0, 0.0, -1.0], [0.0, 0.0, 0.0, 1.0]);
    assert_eq!(surface.normal, Vec3::Z);
    let side = |rise| surface.incident_side(Vec3::new(4_194_303.0, 0.0, rise));
    assert_eq!([1.0, 1.0_f32.next_up()].map(side), [Side::Outside, Side::Inside]);
}
