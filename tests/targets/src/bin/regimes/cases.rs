//! The kept cases of the 22 regimes, and forty relatives of each: mixed with the next, and a few
//! ulp away in some numbers. Bits throughout.

use spherule_kernel::{Ray, Sphere, Vec3};
use spherule_targets::cases::{Case, Random};

/// How many cases are kept.
pub(crate) const KEPT: usize = 660;
const RELATIVES: usize = 40;

/// All cases, the kept ones first.
///
/// # Panics
/// If the file does not have the form that its head describes.
pub(crate) fn all() -> Vec<Case> {
    let text = include_str!("../../../../cases/regimes.txt");
    let lines = text.lines().filter(|line| !line.starts_with('#'));
    let kept: Vec<[u32; 12]> = lines.map(numbers).collect();
    assert_eq!(kept.len(), KEPT, "as many cases as are kept");

    let mut all = kept.clone();
    let mut random = Random(1);
    for (index, bits) in kept.iter().enumerate() {
        for _ in 0..RELATIVES {
            let mut relative = *bits;
            for (place, number) in relative.iter_mut().enumerate() {
                match random.bits() % 8 {
                    0 => *number = number.wrapping_add(random.bits() % 5),
                    1 => *number = number.wrapping_sub(random.bits() % 5),
                    2 if random.bits().is_multiple_of(4) => {
                        *number = kept[(index + 1) % KEPT][place];
                    }
                    _ => {}
                }
            }
            all.push(relative);
        }
    }
    all.into_iter().map(case).collect()
}

/// The twelve numbers between the regime and the answer.
fn numbers(line: &str) -> [u32; 12] {
    let mut words = line.split(' ').skip(1);
    std::array::from_fn(|_| {
        let word = words.next().expect("twelve numbers");
        u32::from_str_radix(word, 16).expect("hexadecimal bits")
    })
}

fn case(bits: [u32; 12]) -> Case {
    let [ox, oy, oz, dx, dy, dz, t_min, t_max, cx, cy, cz, radius] = bits.map(f32::from_bits);
    let (origin, direction) = (Vec3::new(ox, oy, oz), Vec3::new(dx, dy, dz));
    let ray = Ray { origin, direction, t_min, t_max };
    Case { ray, sphere: Sphere { center: Vec3::new(cx, cy, cz), radius } }
}
