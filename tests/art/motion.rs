//! The error of changes, against cases worked by hand.

use spherule_tests::art::light::Light;
use spherule_tests::art::motion::Changes;

/// A picture of one grey, of 4x2 cells.
fn grey(level: u8) -> Light {
    Light::of_colors(32, vec![[level; 3]; 32 * 32])
}

/// Columns of pixels of two greys.
fn stripes(even: u8, odd: u8) -> Light {
    let level = |pixel: usize| if pixel.is_multiple_of(2) { even } else { odd };
    Light::of_colors(32, (0..32 * 32).map(|pixel| [level(pixel); 3]))
}

#[test]
fn what_changes_as_the_truth_does_is_right() {
    let truth = Changes::new(&[grey(0), grey(255), grey(255)]);
    let unrest = truth.unrest(&truth);
    assert_eq!((unrest.seen, unrest.plain), (0.0, 0.0));
    // An error that stays is no error of change.
    let [steady, still] = [grey(90), grey(10)].map(|light| Changes::new(&[light.clone(), light]));
    let unrest = steady.unrest(&still);
    assert_eq!((unrest.seen, unrest.plain), (0.0, 0.0));
    // From black to white lightness changes by 1; half of the steps do so.
    let rest = Changes::new(&[grey(0), grey(0), grey(0)]);
    let unrest = truth.unrest(&rest);
    let expected = 0.5_f64.sqrt();
    assert!((unrest.seen - expected).abs() < 1e-4 && (unrest.plain - expected).abs() < 1e-4);
    assert_eq!(Changes::new(&[grey(0)]).unrest(&Changes::new(&[grey(7)])).seen, 0.0);
}

#[test]
fn what_an_eye_does_not_resolve_is_less() {
    let flicker = Changes::new(&[stripes(90, 110), stripes(110, 90)]);
    let rest = Changes::new(&[grey(100), grey(100)]);
    let unrest = flicker.unrest(&rest);
    assert!(unrest.plain > 0.05 && unrest.seen < unrest.plain / 5.0, "{unrest:?}");
}
