//! Criterion: see the crate's documentation.

fn main() {
    spherule_benches::closest_hit();
}
