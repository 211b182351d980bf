//! Bins against what a mean over an area is.

use super::*;
use proptest::prelude::*;

fn grids() -> impl Strategy<Value = ((usize, usize), (u32, u32))> {
    // All grids of bins that the program has, and of samples that it can be asked for.
    let bins =
        prop::sample::select(vec![(1, 2), (2, 1), (2, 2), (2, 3), (2, 4), (8, 1), (1, 8), (4, 8)]);
    (bins, (1..=16_u32, 1..=16_u32))
}

proptest! {
    #[test]
    fn the_shares_of_a_bin_add_up_to_one(((across, down), samples) in grids()) {
        let bins = Bins::new((across, down), samples);
        prop_assert_eq!(bins.ends.len(), across * down);
        let mut start = 0;
        for &end in &bins.ends {
            let mut sum = 0.0;
            for &(sample, share) in &bins.shares[start..end] {
                prop_assert!(sample < samples.0 * samples.1);
                prop_assert!(share > 0.0 && share <= 1.0);
                sum += share;
            }
            start = end;
            prop_assert!((sum - 1.0_f32).abs() < 1e-5, "{sum}");
        }
    }

    #[test]
    fn every_sample_is_worth_the_same((bins, samples) in grids()) {
        let count = samples.0 * samples.1;
        let mut worth = vec![0.0; count as usize];
        for &(sample, share) in &Bins::new(bins, samples).shares {
            worth[sample as usize] += share / (bins.0 * bins.1) as f32;
        }
        for worth in worth {
            prop_assert!((worth * count as f32 - 1.0).abs() < 1e-5, "{worth}");
        }
    }

    #[test]
    fn a_constant_stays_constant(((across, down), samples) in grids(), value in 0.0..1.0_f32) {
        let samples_of_it = vec![Vec3::splat(value); (samples.0 * samples.1) as usize];
        let means: [Vec3; 32] = Bins::new((across, down), samples).means(&samples_of_it);
        for (bin, mean) in means.iter().enumerate() {
            let expected = if bin < across * down { value } else { 0.0 };
            prop_assert!((*mean - Vec3::splat(expected)).abs().max_element() < 1e-5, "{bin}: {mean}");
        }
    }

    #[test]
    fn whole_numbers_of_samples_are_plain_means(
        ((across, down), times, values) in (grids(), (1..=2_u32, 1..=2_u32)).prop_flat_map(
            |((bins, _), times)| {
                let count = bins.0 * bins.1 * (times.0 * times.1) as usize;
                (Just(bins), Just(times), prop::collection::vec(0.0..1.0_f32, count))
            },
        ),
    ) {
        let samples = (across as u32 * times.0, down as u32 * times.1);
        let light: Vec<Vec3> = values.iter().map(|&value| Vec3::new(value, 1.0 - value, 0.5)).collect();
        let means: [Vec3; 32] = Bins::new((across, down), samples).means(&light);
        for (bin, mean) in means.iter().enumerate().take(across * down) {
            let inside = light.iter().enumerate().filter(|(sample, _)| {
                let (x, y) = (*sample as u32 % samples.0, *sample as u32 / samples.0);
                ((x / times.0) as usize, (y / times.1) as usize) == (bin % across, bin / across)
            });
            let expected = inside.map(|(_, &light)| light).sum::<Vec3>() / (times.0 * times.1) as f32;
            prop_assert!((*mean - expected).abs().max_element() < 1e-6, "{bin}: {mean} {expected}");
        }
    }
}

#[test]
fn a_cut_sample_goes_to_both_sides() {
    // Three samples over two bins: the middle one is half in each.
    let light = [0.0, 0.3, 0.9].map(Vec3::splat);
    let means: [Vec3; 2] = Bins::new((2, 1), (3, 1)).means(&light);
    assert!((means[0].x - 0.1).abs() < 1e-6 && (means[1].x - 0.7).abs() < 1e-6, "{means:?}");
}
