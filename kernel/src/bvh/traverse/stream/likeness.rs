//! Which of the next rays look like those that were seen.
//!
//! A count of some rays says little of others: a camera's rays may be followed by their bounces. So the next rays are compared,
//! part by part, with those that were counted: in how many packets the first and the last ray look in different directions, and in
//! how many they start in different places. Where both shares stay about as they were, so does the number of rays that meet.
//!
//! Parts that come in turns are a mixture. So rays are counted anew only where a part looks otherwise, and all rays from there on,
//! taken together, do, too.
//!
//! On a Zen 3 a camera's rays and then diffuse ones among a million spheres, 2,000 to 16,000 in all, took 1.2 to 1.9 times as long
//! as ray by ray when the first eighth decided for all. Now they take 1.04 to 1.4 times as long, mostly because of the sample of
//! diffuse rays.

use crate::geometry::ray_packet::RayPacket;
use crate::lanes::LaneArray;
use glam::Vec3;

/// A part is an eighth of the rays that are left, but at least and at most so many. (With parts of 1,024, and 2,048 rays of which
/// half are a camera's, 224 diffuse ones went as a stream with the camera's, at 0.6 to 0.7 of the speed of ray by ray.)
const PART: [usize; 2] = [256, 1024];
/// Packets of a part that are looked at.
const LOOKED_AT: usize = 16;
/// Two rays look in different directions if the square of the cosine of their angle is less: 30 degrees.
const COSINE_SQUARED: f32 = 0.75;
/// Two rays start in different places if they start farther apart than this share of the greatest distance of any start from the
/// first.
const NEAR: f32 = 0.125;
/// Shares that differ by more are not alike. (Diffuse rays look in different directions in nine of ten packets; with 0.5, turns of
/// 1,000 rays would be cut into streams of so few.)
const UNLIKE: f32 = 0.7;

/// In which share of packets the first and the last ray look in different directions, and in which they start in different places;
/// NaN where nothing was seen.
#[derive(Clone, Copy, Debug)]
pub(super) struct Likeness {
    elsewhere: [f32; 2],
}

impl Likeness {
    /// The likeness of no rays: all rays look like these.
    pub(super) const OF_NONE: Self = Self { elsewhere: [f32::NAN; 2] };

    /// The likeness of these rays.
    #[inline(never)]
    pub(super) fn of<A: LaneArray>(packets: &[RayPacket<A>]) -> Self {
        let step = (packets.len() / LOOKED_AT).max(1);
        let looked_at =
            || packets.iter().step_by(step).map(|packet| (packet.ray(0), packet.ray(A::COUNT - 1)));
        let begin = packets.first().map_or(Vec3::ZERO, |packet| packet.ray(0).origin);
        let mut farthest = 0.0_f32;
        for (ray, _) in looked_at() {
            farthest = farthest.max(begin.distance_squared(ray.origin));
        }

        let (mut counts, mut count) = ([0.0; 2], 0.0);
        for (one, other) in looked_at() {
            let along = one.direction.dot(other.direction);
            let lengths = one.direction.length_squared() * other.direction.length_squared();
            let apart = one.origin.distance_squared(other.origin);
            counts[0] += f32::from(along < 0.0 || along * along < COSINE_SQUARED * lengths);
            counts[1] += f32::from(apart > NEAR * NEAR * farthest);
            count += 1.0;
        }
        Self { elsewhere: counts.map(|found| found / count) }
    }

    /// How many packets there are before the first that look otherwise.
    #[inline(never)]
    pub(super) fn end<A: LaneArray>(&self, packets: &[RayPacket<A>]) -> usize {
        let part = (packets.len() / 8).clamp(PART[0] / A::COUNT, PART[1] / A::COUNT);
        let mut from = 0;
        while from < packets.len() {
            let rest = packets.get(from..).unwrap_or_default();
            let next = rest.get(..part).unwrap_or(rest);
            if self.is_unlike(&Self::of(next)) && self.is_unlike(&Self::of(rest)) {
                return from;
            }
            from += part;
        }
        packets.len()
    }

    fn is_unlike(&self, other: &Self) -> bool {
        let differs = |of: usize| (self.elsewhere[of] - other.elsewhere[of]).abs() > UNLIKE;
        differs(0) || differs(1)
    }
}

#[cfg(all(test, proofs))]
mod tests {
    use super::*;
    use crate::Ray;
    use core::array;

    /// Packets whose first and last rays look so many radians apart, and start so far apart, where `differ` says so; all
    /// are strung along a way of length 1.
    fn packets<const N: usize>(
        (angle, apart): (f32, f32),
        differ: impl Fn(usize) -> bool,
    ) -> [RayPacket; N] {
        array::from_fn(|place| {
            let along = Vec3::X * (place as f32 / (N - 1) as f32);
            let (angle, apart) = if differ(place) { (angle, apart) } else { (0.0, 0.0) };
            let to = Vec3::new(0.0, libm::sinf(angle), libm::cosf(angle));
            let mut packet = RayPacket::new(&[Ray::new(along, 3.0 * Vec3::Z); 16]);
            packet.set(15, &Ray::new(along + apart * Vec3::Y, 5.0 * to));
            packet
        })
    }

    /// How many packets come before those that look otherwise than rays of one start and one direction.
    fn end<const N: usize>(of: (f32, f32), differ: impl Fn(usize) -> bool) -> usize {
        let seen = Likeness::of(&packets::<64>((0.0, 0.0), |_| false));
        seen.end(&packets::<N>(of, differ))
    }

    #[test]
    fn rays_that_look_or_start_elsewhere_are_told_from_those_that_do_not() {
        let all = |_| true;
        assert_eq!(end::<16>((0.4, 0.0), all), 16);
        assert_eq!(end::<16>((0.7, 0.0), all), 0);
        assert_eq!(end::<16>((3.0, 0.0), all), 0);
        assert_eq!(end::<16>((0.0, 0.1), all), 16);
        assert_eq!(end::<16>((0.0, 0.2), all), 0);
        let scattered = Likeness::of(&packets::<16>((2.0, 0.5), all));
        assert_eq!(scattered.end(&packets::<16>((2.0, 0.5), all)), 16);
        assert_eq!(scattered.end(&packets::<16>((0.0, 0.0), all)), 0);
    }

    #[test]
    fn a_change_is_found_where_it_begins_and_what_comes_in_turns_is_none() {
        let far = (2.0, 0.5);
        assert_eq!(end::<512>(far, |place| place >= 256), 256);
        assert_eq!(end::<512>(far, |place| place >= 448), 448);
        // Few packets have shorter parts; half a part is not told.
        assert_eq!(end::<128>(far, |place| place >= 96), 96);
        assert_eq!(end::<128>(far, |place| place >= 120), 128);
        // Many packets have parts of 64 packets: half of one is not told.
        assert_eq!(end::<512>(far, |place| place >= 480), 512);
        for turn in [1, 4, 64, 128] {
            let in_turns = |place| place / turn % 2 == 1;
            assert!(end::<512>(far, in_turns) > 256, "{turn}");
        }
        // In a part, every fourth packet is looked at.
        assert_eq!(end::<512>(far, |place| place % 8 == 0), 512);
        assert_eq!(end::<512>(far, |place| place % 12 == 0), 512);
    }

    #[test]
    fn nothing_seen_and_rays_that_are_none_look_like_all() {
        let dead = [const { RayPacket::<[f32; 16]>::inactive() }; 64];
        let not_a_number = dead.map(|_| {
            let ray = Ray::new(Vec3::NAN, Vec3::splat(f32::INFINITY));
            RayPacket::new(&[ray; 16])
        });
        let scattered = packets::<64>((2.0, 0.5), |_| true);
        for packets in [&dead, &not_a_number, &scattered, &[][..]] {
            assert_eq!(Likeness::OF_NONE.end(packets), packets.len());
            assert_eq!(Likeness::of::<[f32; 16]>(&[]).end(packets), packets.len());
            assert!(Likeness::of(packets).end(packets) == packets.len());
        }
    }
}
