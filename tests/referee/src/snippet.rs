//! A failing case as lines to paste into an issue: in C, Python and Rust, without a rounding on the way.

use crate::answer::Answer;
use crate::failure::Failure;
use crate::families::FAMILIES;
use spherule_kernel::{Hit, Ray, Sphere};

/// A number in the fewest decimal digits that are read back to the same `f32`.
#[must_use]
pub fn decimal(x: f32) -> String {
    format!("{x:?}")
}

/// A number as a hexadecimal float, as C writes it with `%a`.
#[must_use]
pub fn hex(x: f32) -> String {
    let sign = if x.is_sign_negative() { "-" } else { "" };
    if !x.is_finite() {
        return format!("{sign}{}", if x.is_nan() { "nan" } else { "inf" });
    }
    if x == 0.0 {
        return format!("{sign}0x0p+0");
    }
    // Every f32 is a normal f64.
    let bits = f64::from(x.abs()).to_bits();
    let digits = format!("{:013x}", bits & ((1 << 52) - 1));
    let digits = digits.trim_end_matches('0');
    let point = if digits.is_empty() { "" } else { "." };
    format!("{sign}0x1{point}{digits}p{:+}", (bits >> 52) as i64 - 1023)
}

/// The truth and the answer, in a line.
#[must_use]
pub fn sentence(failure: &Failure) -> String {
    let only = failure.spheres.len() == 1;
    let of = |sphere: Option<u32>| match sphere {
        Some(sphere) if !only => format!(" of sphere {sphere}"),
        _ => String::new(),
    };
    let truth = failure.truth.map_or_else(
        || "a miss".to_owned(),
        |Hit { t, sphere }| format!("a hit at t = {} = {}{}", decimal(t), hex(t), of(Some(sphere))),
    );
    let answer = failure.answer.map_or_else(
        || "a miss".to_owned(),
        |Answer { t, sphere }| {
            let hit = if t.is_finite() { "a hit at " } else { "" };
            format!("{hit}t = {t:?}{}", of(sphere))
        },
    );
    // (No number of ulp leads to what is no answer.)
    let is_off = failure.truth.is_some() && failure.answer.is_some();
    let off = if is_off && failure.severity.is_finite() {
        format!(", {} ulp away", failure.severity)
    } else {
        String::new()
    };
    let family = failure.family.and_then(|number| FAMILIES.get(usize::from(number)));
    let family = family.map_or_else(String::new, |family| format!(" (family {})", family.name));
    format!("{}{family}: in truth {truth}; answered was {answer}{off}", failure.kind.name())
}

/// The case in C: two arrays, and the value that `intersect` must return.
#[must_use]
pub fn c(failure: &Failure) -> String {
    let number = |x: f32| match x {
        _ if x.is_nan() => "NAN".to_owned(),
        _ if x == f32::INFINITY => "INFINITY".to_owned(),
        _ if x == f32::NEG_INFINITY => "-INFINITY".to_owned(),
        _ => format!("{}f", hex(x)),
    };
    let rows = rows(failure, number);
    let expected = failure.truth.map_or_else(|| "INFINITY".to_owned(), |hit| number(hit.t));
    let spheres = rows.spheres.iter().map(|row| format!("    {{{row}}},\n")).collect::<String>();
    format!(
        "/* {} */\n\
         #include <math.h>\n\
         /* origin, direction, t_min, t_max: {} */\n\
         const float ray[8] = {{{}}};\n\
         /* centre, radius: {} */\n\
         const float spheres[{}][4] = {{\n{spheres}}};\n\
         /* t of the closest hit, INFINITY of none; by intersect(ray, spheres, {}): */\n\
         const float expected = {expected};\n",
        sentence(failure),
        rows.ray_in_decimal,
        rows.ray,
        rows.spheres_in_decimal,
        failure.spheres.len(),
        failure.spheres.len(),
    )
}

/// The case in Python: numpy arrays in the form of `spherule trace` and `judge`.
#[must_use]
pub fn python(failure: &Failure) -> String {
    let number = |x: f32| format!("h({:?})", hex(x));
    let rows = rows(failure, number);
    let expected = failure.truth.map_or_else(|| "h(\"inf\")".to_owned(), |hit| number(hit.t));
    let spheres = rows.spheres.iter().map(|row| format!("[{row}]")).collect::<Vec<_>>().join(", ");
    format!(
        "# {}\n\
         import numpy as np\n\
         h = float.fromhex\n\
         # origin, direction, t_min, t_max: {}\n\
         ray = np.array([{}], np.float32)\n\
         # centre, radius: {}\n\
         spheres = np.array([{spheres}], np.float32)\n\
         # t of the closest hit, inf of none; by intersect(ray, spheres):\n\
         expected = np.float32({expected})\n",
        sentence(failure),
        rows.ray_in_decimal,
        rows.ray,
        rows.spheres_in_decimal,
    )
}

/// The case in Rust, in decimals: as many digits as read back as the same bits.
#[must_use]
pub fn rust(failure: &Failure) -> String {
    let number = |x: f32| match x {
        _ if x.is_nan() => "f32::NAN".to_owned(),
        _ if x == f32::INFINITY => "f32::INFINITY".to_owned(),
        _ if x == f32::NEG_INFINITY => "f32::NEG_INFINITY".to_owned(),
        _ => decimal(x),
    };
    let rows = rows(failure, number);
    let expected =
        failure.truth.map_or_else(|| "None".to_owned(), |hit| format!("Some({})", number(hit.t)));
    let spheres = rows.spheres.iter().map(|row| format!("[{row}]")).collect::<Vec<_>>().join(", ");
    format!(
        "// {}\n\
         // Origin, direction, t_min, t_max; centre and radius.\n\
         let ray: [f32; 8] = [{}];\n\
         let spheres: [[f32; 4]; {}] = [{spheres}];\n\
         // t of the closest hit, by intersect(&ray, &spheres).\n\
         let expected: Option<f32> = {expected};\n",
        sentence(failure),
        rows.ray,
        failure.spheres.len(),
    )
}

/// The numbers of a case, row by row.
struct Rows {
    ray: String,
    spheres: Vec<String>,
    ray_in_decimal: String,
    spheres_in_decimal: String,
}

fn rows(failure: &Failure, number: impl Fn(f32) -> String) -> Rows {
    let row = |numbers: &[f32], number: &dyn Fn(f32) -> String| {
        numbers.iter().map(|&x| number(x)).collect::<Vec<_>>().join(", ")
    };
    let Ray { origin, direction, t_min, t_max } = failure.ray;
    let ray = [&origin.to_array()[..], &direction.to_array(), &[t_min, t_max]].concat();
    let of_sphere = |Sphere { center, radius }: &Sphere| center.extend(*radius).to_array();
    let spheres: Vec<[f32; 4]> = failure.spheres.iter().map(of_sphere).collect();
    let in_decimal: Vec<String> = spheres.iter().map(|sphere| row(sphere, &decimal)).collect();
    Rows {
        ray: row(&ray, &number),
        spheres: spheres.iter().map(|sphere| row(sphere, &number)).collect(),
        ray_in_decimal: row(&ray, &decimal),
        spheres_in_decimal: in_decimal.join("; "),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hexadecimal_floats_are_those_of_c() {
        for (x, text) in [
            (1.0, "0x1p+0"),
            (-3.0, "-0x1.8p+1"),
            (0.1, "0x1.99999ap-4"),
            (0.0, "0x0p+0"),
            (-0.0, "-0x0p+0"),
            (f32::from_bits(1), "0x1p-149"),
            (f32::MAX, "0x1.fffffep+127"),
            (f32::NEG_INFINITY, "-inf"),
            (f32::NAN, "nan"),
        ] {
            assert_eq!(hex(x), text);
        }
    }
}
