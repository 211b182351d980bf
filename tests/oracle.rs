//! The oracle against hand-made cases, a second derivation, and the vectors of another hand.

use spherule_tests::oracle;
use spherule_tests::vectors;

#[test]
fn agrees_with_every_vector() {
    let Some(vectors) = vectors::read() else { return };
    for (index, vector) in vectors.iter().enumerate() {
        let found = oracle::intersect(&vector.case.ray, &vector.case.sphere);
        let (found, expected) = (found.map(f32::to_bits), vector.expected.map(f32::to_bits));
        assert_eq!(found, expected, "vector {index}: {:?}", vector.case);
    }
}
