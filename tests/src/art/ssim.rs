//! SSIM: likeness of structure (Z. Wang and others, "Image quality assessment: from error visibility to structural
//! similarity", 2004), of the luma of encoded colours.

use super::palette::Rgb;

/// Pixels to each side of the middle of a window.
const REACH: usize = 5;
/// The deviation of the window's weights, in pixels.
const DEVIATION: f64 = 1.5;
/// Constants that stabilise quotients of small numbers, for levels up to 255.
const CALM: [f64; 2] = [(0.01 * 255.0) * (0.01 * 255.0), (0.03 * 255.0) * (0.03 * 255.0)];

/// The luma of ITU-R BT.601, as in the authors' own program.
#[must_use]
pub fn luma(colors: &[Rgb]) -> Vec<f64> {
    let luma = |&[red, green, blue]: &Rgb| {
        0.299 * f64::from(red) + 0.587 * f64::from(green) + 0.114 * f64::from(blue)
    };
    colors.iter().map(luma).collect()
}

/// The mean over all windows of 11 x 11 that lie inside both pictures; 1 if the pictures are equal. If a picture is
/// smaller than a window, some windows that reach beyond it count.
#[must_use]
pub fn mean(width: usize, first: &[f64], second: &[f64]) -> f64 {
    let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).collect::<Vec<_>>();
    let [mean_first, mean_second, squares_first, squares_second, products] =
        [first, second, &product(first, first), &product(second, second), &product(first, second)]
            .map(|values| windows(width, values));
    let height = first.len() / width;
    let margin = |length: usize| REACH.min(length.saturating_sub(1) / 2);
    let (left, top) = (margin(width), margin(height));
    let (mut sum, mut count) = (0.0, 0.0);
    for y in top..height - top {
        for pixel in y * width + left..(y + 1) * width - left {
            let (a, b) = (mean_first[pixel], mean_second[pixel]);
            let spread = squares_first[pixel] - a * a + squares_second[pixel] - b * b;
            let covariance = products[pixel] - a * b;
            sum += (2.0 * a * b + CALM[0]) * (2.0 * covariance + CALM[1])
                / ((a * a + b * b + CALM[0]) * (spread + CALM[1]));
            count += 1.0;
        }
    }
    sum / count
}

/// The weighted mean of the window around every pixel. Beyond an edge the picture continues as at the edge.
fn windows(width: usize, values: &[f64]) -> Vec<f64> {
    let bell = |x: usize| (-((x as f64 - REACH as f64) / DEVIATION).powi(2) / 2.0).exp();
    let weights: [f64; 2 * REACH + 1] = std::array::from_fn(bell);
    let sum: f64 = weights.iter().sum();
    let weights = weights.map(|weight| weight / sum);
    let height = values.len() / width;
    // The place in a line of `length` that is `offset` from the left end of the window around `x`.
    let place =
        |x: usize, offset: usize, length: usize| (x + offset).saturating_sub(REACH).min(length - 1);
    let mut across = vec![0.0; values.len()];
    for (row, sums) in values.chunks_exact(width).zip(across.chunks_exact_mut(width)) {
        for (x, sum) in sums.iter_mut().enumerate() {
            let weighted = weights.iter().enumerate();
            *sum = weighted.map(|(offset, weight)| weight * row[place(x, offset, width)]).sum();
        }
    }
    let mut means = vec![0.0; values.len()];
    for (y, sums) in means.chunks_exact_mut(width).enumerate() {
        for (offset, weight) in weights.iter().enumerate() {
            let row = &across[place(y, offset, height) * width..][..width];
            for (sum, value) in sums.iter_mut().zip(row) {
                *sum += weight * value;
            }
        }
    }
    means
}
