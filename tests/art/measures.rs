//! The measures against other programs' figures for a pair of pictures made here.

use spherule_tests::art::flip::Reference;
use spherule_tests::art::light::Light;
use spherule_tests::art::palette::Rgb;
use spherule_tests::art::srgb::{decoded, encoded};
use spherule_tests::art::{figures::Truth, ssim};

const WIDTH: i32 = 96;
const HEIGHT: i32 = 64;

/// A disc before a slope; and the same picture in coarse steps, with the disc moved by three pixels, and noise.
fn pair() -> [Vec<Rgb>; 2] {
    let disc = |x: i32, y: i32, middle: i32| (x - middle).pow(2) + (y - 30).pow(2) < 400;
    let face = |x: i32, y: i32| [230 - x, 60 + y, 40];
    let picture = |color: &dyn Fn(i32, i32) -> [i32; 3]| {
        let places = (0..HEIGHT).flat_map(|y| (0..WIDTH).map(move |x| (x, y)));
        let rgb = |channel: i32| channel.clamp(0, 255) as u8;
        places.map(|(x, y)| color(x, y).map(rgb)).collect()
    };
    let truth = |x, y| match disc(x, y, 40) {
        true => face(x, y),
        false => [2 * x + 20, 3 * y + 10, 2 * (x + y) % 256],
    };
    let coarse = |x, y| {
        let color = match disc(x, y, 43) {
            true => face(x, y),
            false => [2 * (x / 8 * 8) + 24, 3 * (y / 8 * 8) + 20, 2 * (x + y) % 256],
        };
        color.map(|channel| channel + (7 * x + 13 * y) % 5 * 6 - 12)
    };
    [picture(&truth), picture(&coarse)]
}

#[test]
fn flip_is_that_of_its_authors() {
    // What the Python package flip-evaluator 1.7, by FLIP's authors, prints for this pair at these pixels a degree.
    let [truth, coarse] = pair();
    for (pixels_a_degree, expected) in
        [(38.0, 0.179_754), (67.020_64, 0.150_012), (15.0, 0.256_236), (120.0, 0.126_764)]
    {
        let reference = Reference::new(WIDTH as usize, &truth, pixels_a_degree);
        let mean = reference.mean(&coarse);
        assert!((mean - expected).abs() < 2e-5, "{pixels_a_degree}: {mean} for {expected}");
        assert_eq!(reference.mean(&truth), 0.0);
    }
    let black = Reference::new(WIDTH as usize, &vec![[0; 3]; truth.len()], 38.0);
    let mean = black.mean(&vec![[255; 3]; truth.len()]);
    assert!((mean - 0.967_325).abs() < 2e-5, "{mean}");
}

#[test]
fn ssim_and_psnr_are_those_of_another_program() {
    // By scikit-image 0.26: structural_similarity of luma with gaussian_weights, sigma 1.5, no sample covariance and a
    // range of 255; peak_signal_noise_ratio of the colours.
    let [truth, coarse] = pair();
    let lumas = [&truth, &coarse].map(|colors| ssim::luma(colors));
    let like = ssim::mean(WIDTH as usize, &lumas[0], &lumas[1]);
    assert!((like - 0.474_670_57).abs() < 1e-7, "{like}");
    assert!((ssim::mean(WIDTH as usize, &lumas[0], &lumas[0]) - 1.0).abs() < 1e-12);
    let [truth, coarse] = [truth, coarse].map(|colors| Light::of_colors(WIDTH as usize, colors));
    let figures = Truth::new(&truth).expect("whole cells").figures(&coarse);
    assert!((figures.psnr - 22.264_663).abs() < 1e-5, "{figures:?}");
    assert!((figures.ssim - like).abs() < 1e-12 && (figures.flip - 0.179_754).abs() < 2e-5);
}

#[test]
fn a_picture_smaller_than_a_window_has_a_likeness() {
    let [first, second] = [1.0, 200.0].map(|level| vec![level; 8 * 16]);
    assert!((ssim::mean(8, &first, &first) - 1.0).abs() < 1e-12);
    assert!(ssim::mean(8, &first, &second) < 0.1);
    assert!((ssim::mean(1, &first, &first) - 1.0).abs() < 1e-12);
}

#[test]
fn every_level_is_its_own_light() {
    for level in 0..=255 {
        assert_eq!(encoded(decoded([level; 3])), [level; 3]);
    }
    assert_eq!(encoded([-1.0, 2.0, 0.5]), [0, 255, 188]);
}
