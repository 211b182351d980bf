//! The light that a point receives.

use super::{Turn, many};
use std::collections::HashSet;

/// What each line says makes the sum below.
#[test]
fn the_sum_is_that_of_the_lines() {
    let mut lit_by = HashSet::new();
    for text in many("illumination", &[(Turn::Right, 15), (Turn::Left, 35), (Turn::Down, 5)]) {
        let Some((lines, below)) = text.split_once("sum of n.l times light: ") else { continue };
        let first = |words: &str| -> f32 {
            let word = words.split_whitespace().next().expect("a number");
            word.parse().expect(word)
        };
        let (mut sum, mut lit) = (0.0, 0);
        for line in lines.split("n.l = ").skip(1) {
            let (_, light) = line.split_once("  light ").expect("how bright the light is");
            if line.contains("way: lit") {
                sum += first(line) * first(light);
                lit += 1;
            }
        }
        assert!((sum - first(below)).abs() < 0.003, "{sum}: {text}");
        lit_by.insert(lit);
    }
    assert!(lit_by.contains(&2) && lit_by.len() > 1, "{lit_by:?}");
}
