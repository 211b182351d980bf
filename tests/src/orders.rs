//! Orders in which rays come: no order of a caller's rays may lead the kernel into a trap.
//!
//! Every order makes any number of rays for any scene from the places of its spheres. A scene that is huge, tiny or far
//! away gets the same rays, at its scale and place. The same seed makes the same rays.
//!
//! | order | rays |
//! |---|---|
//! | beam | one direction, random origins: a detector, an X-ray |
//! | nearly parallel | the same, a hundredth apart |
//! | to a light | random points to one light, t from 0 to 1 |
//! | long lens, shuffled | random pixels of a camera a thousand scene sizes away |
//! | scan lines | a camera's, line by line |
//! | shuffled, reversed | a camera's, in other orders |
//! | sorted by direction | [`Order::Diffuse`], neighbours in direction one after the other |
//! | two cameras; shuffled | from two sides, ray by ray in turns; the same, in no order |
//! | half and half | a camera's scan lines, then diffuse rays |
//! | 64 and 64 | the same, 64 at a time in turns |
//! | bursts | so many from one origin in nearly one direction, then from elsewhere |
//! | scanner | a fan of 64 that turns once about a point inside |
//! | two lights | every random point to one light, then to another, t from 0 to 1 |
//! | along an axis | along z, random origins |
//! | from far away | one direction, from 10^4 scene sizes away |
//! | 16 and 16 | sixteen of a camera, sixteen of a beam |
//! | all around | one origin inside, every direction |
//! | diffuse | random origins inside, every direction |
//! | bounces | from random points on random spheres, up from the surface |

mod extent;
mod rays;

pub use extent::Extent;

use rays::{Rays, in_turns};
use spherule_kernel::{Ray, Spheres};
use spherule_referee::random::Random;

/// An order of rays.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs, reason = "the table of the module")]
pub enum Order {
    Beam,
    NearlyParallel,
    ToALight,
    LongLens,
    ScanLines,
    Shuffled,
    Reversed,
    SortedByDirection,
    TwoCameras,
    HalfAndHalf,
    Alternating64,
    Bursts16,
    Bursts64,
    Bursts1000,
    Scanner,
    TwoLights,
    AlongAnAxis,
    FromFarAway,
    Alternating16,
    AllAround,
    Diffuse,
    Bounces,
    TwoCamerasShuffled,
}

impl Order {
    /// Each in its place, with its name in tables.
    const NAMED: [(Self, &'static str); 23] = [
        (Self::Beam, "beam"),
        (Self::NearlyParallel, "nearly parallel"),
        (Self::ToALight, "to a light"),
        (Self::LongLens, "long lens, shuffled"),
        (Self::ScanLines, "scan lines"),
        (Self::Shuffled, "shuffled"),
        (Self::Reversed, "reversed"),
        (Self::SortedByDirection, "sorted by direction"),
        (Self::TwoCameras, "two cameras"),
        (Self::HalfAndHalf, "half and half"),
        (Self::Alternating64, "64 and 64"),
        (Self::Bursts16, "bursts of 16"),
        (Self::Bursts64, "bursts of 64"),
        (Self::Bursts1000, "bursts of 1000"),
        (Self::Scanner, "scanner"),
        (Self::TwoLights, "two lights"),
        (Self::AlongAnAxis, "along an axis"),
        (Self::FromFarAway, "from far away"),
        (Self::Alternating16, "16 and 16"),
        (Self::AllAround, "all around"),
        (Self::Diffuse, "diffuse"),
        (Self::Bounces, "bounces"),
        (Self::TwoCamerasShuffled, "two cameras, shuffled"),
    ];

    /// All of them.
    pub const ALL: [Self; 23] = {
        let (mut all, mut place) = ([Self::Beam; 23], 0);
        while place < all.len() {
            all[place] = Self::NAMED[place].0;
            place += 1;
        }
        all
    };

    /// The name in tables.
    #[must_use]
    pub const fn as_str(self) -> &'static str {
        Self::NAMED[self as usize].1
    }

    /// The order of that name; `None` if there is none.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::NAMED.into_iter().find(|(_, own)| *own == name).map(|(order, _)| order)
    }

    /// `count` rays for a scene.
    #[must_use]
    pub fn rays(self, spheres: Spheres<'_>, count: usize, seed: u64) -> Vec<Ray> {
        self.rays_in(&Extent::of(spheres), spheres, count, seed)
    }

    /// The same, for a known extent: finding the extent takes longer than making a few rays.
    #[must_use]
    pub fn rays_in(
        self,
        extent: &Extent,
        spheres: Spheres<'_>,
        count: usize,
        seed: u64,
    ) -> Vec<Ray> {
        let mut rays = Rays { extent, random: Random::new(seed, self as u64) };
        // Orders of two parts change between whole turns.
        let half = count.div_ceil(2).next_multiple_of(64).min(count);
        match self {
            Self::Beam => rays.beam(count, 0.0),
            Self::NearlyParallel => rays.beam(count, 0.01),
            Self::ToALight => (0..count).map(|_| rays.shadow_rays()[0]).collect(),
            Self::LongLens => rays.camera_shuffled(count, 1e3),
            Self::ScanLines => rays.camera(count, false),
            Self::Shuffled => rays.camera_shuffled(count, 2.0),
            Self::Reversed => rays.camera(count, false).into_iter().rev().collect(),
            Self::SortedByDirection => rays::sorted_by_direction(rays.diffuse(count)),
            Self::TwoCameras => rays.two_cameras(count, half),
            Self::HalfAndHalf => {
                let mut both = rays.camera(half, false);
                both.extend(rays.diffuse(count - half));
                both
            }
            Self::Alternating64 => {
                let (camera, diffuse) = (rays.camera(half, false), rays.diffuse(half));
                in_turns([camera, diffuse], 64, count)
            }
            Self::Bursts16 => rays.bursts(count, 16),
            Self::Bursts64 => rays.bursts(count, 64),
            Self::Bursts1000 => rays.bursts(count, 1000),
            Self::Scanner => rays.scanner(count),
            Self::TwoLights => {
                (0..count.div_ceil(2)).flat_map(|_| rays.shadow_rays()).take(count).collect()
            }
            Self::AlongAnAxis => rays.along_an_axis(count),
            Self::FromFarAway => rays.far_beam(count),
            Self::Alternating16 => {
                let (camera, beam) = (rays.camera(half, false), rays.beam(half, 0.0));
                in_turns([camera, beam], 16, count)
            }
            Self::AllAround => rays.all_around(count),
            Self::Diffuse => rays.diffuse(count),
            Self::Bounces => rays.bounces(spheres, count),
            Self::TwoCamerasShuffled => {
                let both = rays.two_cameras(count, half);
                rays.shuffled(both)
            }
        }
    }
}
