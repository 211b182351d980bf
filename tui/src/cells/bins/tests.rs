//! Bins against what a mean over an area is.

use super::*;
use crate::cells::layers::Layers;
use proptest::prelude::*;

fn grids() -> impl Strategy<Value = ((usize, usize), (u32, u32))> {
    // All grids of bins that the program has, and of samples that it can be asked for.
    let bins =
        prop::sample::select(vec![(1, 2), (2, 1), (2, 2), (2, 3), (2, 4), (8, 1), (1, 8), (4, 8)]);
    (bins, (1..=16_u32, 1..=16_u32))
}

fn means<const N: usize>(bins: (usize, usize), samples: (u32, u32), light: &[Vec3]) -> [Vec3; N] {
    let mut columns = Columns::default();
    columns.take(light, samples.0 as usize);
    Bins::new(bins, samples).means(&columns)
}

proptest! {
    #[test]
    fn a_bin_is_as_large_as_any((bins, samples) in grids()) {
        let of_samples = Bins::new(bins, samples);
        let (count, all) = (samples.0 * samples.1, bins.0 * bins.1);
        prop_assert_eq!(of_samples.ends.len(), all);
        for bin in 0..all {
            let lanes = of_samples.shares(bin).iter().flat_map(|(_, shares)| shares.to_array());
            let area: f32 = lanes.sum();
            prop_assert!((area * all as f32 / count as f32 - 1.0).abs() < 1e-5, "{area}");
        }
    }

    #[test]
    fn every_sample_is_given_whole((bins, samples) in grids()) {
        let of_samples = Bins::new(bins, samples);
        let mut layers = Layers::default();
        let count = (samples.0 * samples.1) as usize;
        layers.take(count, (0..bins.0 * bins.1).flat_map(|bin| of_samples.shares(bin).iter().copied()));
        let given = layers.ink().iter().flat_map(|share| share.to_array());
        for (place, given) in given.enumerate() {
            let expected = if place < count { 1.0 } else { 0.0 };
            prop_assert!((given - expected).abs() < 1e-6, "{place}: {given}");
        }
    }

    #[test]
    fn a_constant_stays_constant(((across, down), samples) in grids(), value in 0.0..1.0_f32) {
        let samples_of_it = vec![Vec3::splat(value); (samples.0 * samples.1) as usize];
        let means: [Vec3; 32] = means((across, down), samples, &samples_of_it);
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
        let means: [Vec3; 32] = means((across, down), samples, &light);
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
    let means: [Vec3; 2] = means((2, 1), (3, 1), &light);
    assert!((means[0].x - 0.1).abs() < 1e-6 && (means[1].x - 0.7).abs() < 1e-6, "{means:?}");
}
