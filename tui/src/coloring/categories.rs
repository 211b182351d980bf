//! Colours of names: as many as can be told apart, by people who see fewer of them too.

use crate::color::Srgb;

/// The colour of spheres without a name, a number or a known element.
pub const NEUTRAL: Srgb = Srgb([0x9a, 0x9a, 0x9a]);

/// Twelve colours, each as far as can be from all before it, to the eye that tells it from them the least. They are chosen from all colours
/// that are light enough for a shade (`OKLab` 0.5 to 0.9, and some chroma), by their distance in `OKLab` to people with three kinds of
/// cones, and with two of any kind. The first four are 0.18 apart or more, eight 0.09, all 0.075.
const COLORS: [Srgb; 12] = [
    Srgb([0x3c, 0x84, 0xe4]),
    Srgb([0xf0, 0xe4, 0x18]),
    Srgb([0xe4, 0x30, 0x00]),
    Srgb([0x84, 0xd8, 0xfc]),
    Srgb([0xa8, 0x24, 0x78]),
    Srgb([0xfc, 0x90, 0x78]),
    Srgb([0xcc, 0x60, 0x90]),
    Srgb([0xb4, 0xf0, 0xb4]),
    Srgb([0x54, 0x24, 0xfc]),
    Srgb([0x84, 0xa8, 0xe4]),
    Srgb([0x78, 0x48, 0xb4]),
    Srgb([0xc0, 0x00, 0x3c]),
];

/// The colour of name `place`, from 0. The first twelve can be told apart. Then they come again, half as light and half way to white in
/// turns.
#[must_use]
pub fn category(place: usize) -> Srgb {
    let Srgb(channels) = COLORS[place % COLORS.len()];
    Srgb(channels.map(|channel| match place / COLORS.len() % 3 {
        0 => channel,
        1 => (f32::from(channel) * 0.72) as u8,
        _ => 128 + channel / 2,
    }))
}

/// What people see who have fewer kinds of cones.
#[cfg(test)]
pub(crate) mod vision {
    use spherule_kernel::Vec3;

    /// A way to see colours: rows of a matrix on linear light.
    ///
    /// G. M. Machado, M. M. Oliveira, L. A. F. Fernandes, "A Physiologically-based Model for Simulation of Color Vision
    /// Deficiency", 2009, at full severity.
    #[derive(Clone, Copy, Debug)]
    pub(crate) struct Sight {
        pub(crate) name: &'static str,
        rows: [Vec3; 3],
    }

    impl Sight {
        /// The light that looks to everybody as `light` does to people with this sight.
        pub(crate) fn seen(self, light: Vec3) -> Vec3 {
            Vec3::from_array(self.rows.map(|row| row.dot(light))).clamp(Vec3::ZERO, Vec3::ONE)
        }
    }

    pub(crate) const SIGHTS: [Sight; 4] = [
        Sight { name: "all", rows: [Vec3::X, Vec3::Y, Vec3::Z] },
        Sight {
            name: "deuteranopia",
            rows: [
                Vec3::new(0.367_322, 0.860_646, -0.227_968),
                Vec3::new(0.280_085, 0.672_501, 0.047_413),
                Vec3::new(-0.011_82, 0.042_94, 0.968_881),
            ],
        },
        Sight {
            name: "protanopia",
            rows: [
                Vec3::new(0.152_286, 1.052_583, -0.204_868),
                Vec3::new(0.114_503, 0.786_281, 0.099_216),
                Vec3::new(-0.003_882, -0.048_116, 1.051_998),
            ],
        },
        Sight {
            name: "tritanopia",
            rows: [
                Vec3::new(1.255_528, -0.076_749, -0.178_779),
                Vec3::new(-0.078_411, 0.930_809, 0.147_602),
                Vec3::new(0.004_733, 0.691_367, 0.303_9),
            ],
        },
    ];
}

#[cfg(test)]
mod tests {
    use super::vision::SIGHTS;
    use super::*;
    use crate::color::oklab;

    /// The least distance of the first so many colours to the eye that tells them the least.
    fn least(count: usize) -> f32 {
        let mut least = f32::INFINITY;
        for sight in SIGHTS {
            let look = |place| oklab(sight.seen(category(place).to_linear()));
            for one in 0..count {
                for other in 0..one {
                    least = least.min(look(one).distance(look(other)));
                }
            }
        }
        least
    }

    #[test]
    fn everybody_tells_twelve_names_apart() {
        for (count, apart) in [(4, 0.18), (8, 0.09), (12, 0.075)] {
            assert!(least(count) > apart, "{count}: {}", least(count));
        }
        for place in 0..36 {
            let light = oklab(category(place).to_linear()).x;
            assert!((0.35..0.97).contains(&light), "{place}: {light}");
        }
    }

    #[test]
    fn names_past_the_thirty_sixth_have_a_colour_too() {
        assert_eq!(category(36), category(0));
        assert_ne!(category(12), category(0));
        assert_ne!(category(24), category(12));
        let _ = category(usize::MAX);
    }
}
