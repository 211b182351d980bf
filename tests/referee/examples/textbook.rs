//! Judges a textbook's intersector: where it fails first, and everything that it gets wrong.
//!
//! `cargo run --release -p spherule-referee --example textbook`

use spherule_referee::intersector::Pair;
use spherule_referee::{Ray, Sphere, Trial};

/// The quadratic formula, as it stands in books.
pub(crate) fn textbook(ray: &Ray, sphere: &Sphere) -> Option<f32> {
    let oc = ray.origin - sphere.center;
    let a = ray.direction.dot(ray.direction);
    let half_b = oc.dot(ray.direction);
    let c = oc.dot(oc) - sphere.radius * sphere.radius;
    let discriminant = half_b * half_b - a * c;
    if discriminant < 0.0 {
        return None;
    }
    let mut root = (-half_b - discriminant.sqrt()) / a;
    if root < ray.t_min || ray.t_max < root {
        root = (-half_b + discriminant.sqrt()) / a;
    }
    (ray.t_min <= root && root <= ray.t_max).then_some(root)
}

/// Judges the textbook's intersector.
pub(crate) fn main() {
    let report = Trial::default().run(&Pair::new("textbook", textbook));
    let first = report.first.map_or(f64::NAN, |first| 1e3 * first.as_secs_f64());
    println!("the first failure after {first:.1} ms, all after {:.2?}\n", report.took);
    print!("{report}");
}
