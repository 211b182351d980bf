//! Sums of products without any rounding: numbers that do not overlap, from small to large (Shewchuk 1997).

use std::cmp::Ordering;

/// A sum, exact as long as no product of it overflows, and none has bits below the least number.
#[derive(Default)]
pub(crate) struct Sum(Vec<f64>);

impl Sum {
    /// Adds a product: double precision holds it, rounded, and its rounding error.
    pub(crate) fn add_product(&mut self, x: f64, y: f64) {
        let high = x * y;
        self.add(x.mul_add(y, -high));
        self.add(high);
    }

    fn add(&mut self, mut value: f64) {
        for part in &mut self.0 {
            let sum = value + *part;
            let other = sum - value;
            let low = (value - (sum - other)) + (*part - other);
            (value, *part) = (sum, low);
        }
        self.0.push(value);
        self.0.retain(|part| *part != 0.0);
    }

    /// How it compares with zero: the largest part decides.
    pub(crate) fn sign(&self) -> Ordering {
        self.0.last().map_or(Ordering::Equal, |part| part.total_cmp(&0.0))
    }
}
