//! How wrong a tier is: its nearest hits against those of `Exact`.

use spherule_kernel::dispatch::Packet;
use spherule_kernel::{HitPacket, Lanes};

/// What differs from the truth, counted in rays, and by how much t does where nothing else does.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Errors {
    /// A hit where there is none.
    pub(super) wrong_hits: u64,
    /// None where there is one.
    pub(super) wrong_misses: u64,
    /// Another sphere than the nearest.
    pub(super) wrong_sphere: u64,
    /// The ulp between both t, a ray that meets the right sphere, in ascending order.
    ulp: Vec<u64>,
}

impl Errors {
    /// Compares ray by ray.
    pub(super) fn new(hits: &[HitPacket<Packet>], truth: &[HitPacket<Packet>]) -> Self {
        let mut errors = Self::default();
        for (hits, truth) in hits.iter().zip(truth) {
            for lane in 0..Packet::COUNT {
                match (hits.hit(lane), truth.hit(lane)) {
                    (None, None) => {}
                    (Some(_), None) => errors.wrong_hits += 1,
                    (None, Some(_)) => errors.wrong_misses += 1,
                    (Some(hit), Some(truth)) if hit.sphere != truth.sphere => {
                        errors.wrong_sphere += 1;
                    }
                    (Some(hit), Some(truth)) => errors.ulp.push(ulp_between(hit.t, truth.t)),
                }
            }
        }
        errors.ulp.sort_unstable();
        errors
    }

    /// The least number of ulp that so many thousandths of the rays do not exceed; none where no
    /// ray meets the right sphere.
    pub(super) fn ulp_at(&self, thousandths: usize) -> Option<u64> {
        let rank = (self.ulp.len() * thousandths).div_ceil(1000);
        self.ulp.get(rank.saturating_sub(1)).copied()
    }
}

/// How many `f32` lie between two finite ones, across zero too.
fn ulp_between(a: f32, b: f32) -> u64 {
    let place = |x: f32| {
        let magnitude = i64::from(x.to_bits() & 0x7fff_ffff);
        if x.is_sign_negative() { -magnitude } else { magnitude }
    };
    place(a).abs_diff(place(b))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_are_an_ulp_apart() {
        assert_eq!(ulp_between(1.0, 1.0), 0);
        assert_eq!(ulp_between(1.0, 1.0_f32.next_up()), 1);
        assert_eq!(ulp_between(1.0_f32.next_down(), 1.0_f32.next_up()), 2);
        assert_eq!(ulp_between(f32::from_bits(1), -f32::from_bits(1)), 2);
        assert_eq!(ulp_between(0.0, -0.0), 0);
    }

    #[test]
    fn quantiles_are_of_the_list() {
        let errors = |ulp: Vec<u64>| Errors { ulp, ..Errors::default() };
        assert_eq!(errors(vec![]).ulp_at(500), None);
        let one = errors(vec![7]);
        assert_eq!([1, 500, 999, 1000].map(|rank| one.ulp_at(rank)), [Some(7); 4]);
        let many = errors((1..=2000).collect());
        assert_eq!([500, 999, 1000].map(|rank| many.ulp_at(rank)), [1000, 1998, 2000].map(Some));
    }
}
