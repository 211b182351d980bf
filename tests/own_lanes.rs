//! Lanes that a user writes, without vectors: every default of the traits answers as the kernel's own lanes do.

use spherule_kernel::{
    DoubleLanes, Exact, HitPacket, Intersect, LaneMask, Lanes, Ray, RayPacket, SphereList,
    SphereTree, Trace, f32x8,
};
use spherule_referee::random::Random;
use std::array::from_fn;
use std::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

/// Eight lanes, one by one.
#[derive(Clone, Copy, Debug)]
struct Eight<T>([T; 8]);

/// A bit a lane.
#[derive(Clone, Copy)]
struct Bits(u32);

macro_rules! operators {
    ($($operator:ident $method:ident),*) => {$(
        impl<T: Copy + $operator<Output = T>> $operator for Eight<T> {
            type Output = Self;
            fn $method(self, other: Self) -> Self {
                Self(from_fn(|lane| self.0[lane].$method(other.0[lane])))
            }
        }
    )*};
}
operators!(Add add, Sub sub, Mul mul, Div div);

impl<T: Copy + Neg<Output = T>> Neg for Eight<T> {
    type Output = Self;
    fn neg(self) -> Self {
        Self(self.0.map(T::neg))
    }
}

impl BitAnd for Bits {
    type Output = Self;
    fn bitand(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }
}

impl BitOr for Bits {
    type Output = Self;
    fn bitor(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }
}

impl Not for Bits {
    type Output = Self;
    fn not(self) -> Self {
        Self(!self.0 & 0xff)
    }
}

impl LaneMask for Bits {
    fn bits(self) -> u32 {
        self.0
    }
}

impl<T: Copy> Eight<T> {
    fn bits(self, other: Self, holds: impl Fn(&T, &T) -> bool) -> Bits {
        let lanes = self.0.iter().zip(&other.0).enumerate();
        Bits(lanes.fold(0, |bits, (lane, (a, b))| bits | u32::from(holds(a, b)) << lane))
    }

    fn chosen(mask: Bits, yes: Self, no: Self) -> Self {
        Self(from_fn(|lane| if mask.0 >> lane & 1 == 1 { yes.0[lane] } else { no.0[lane] }))
    }
}

impl DoubleLanes for Eight<f64> {
    const COUNT: usize = 8;
    type Token = ();
    type Mask = Bits;

    fn token(self) {}
    fn splat((): (), value: f64) -> Self {
        Self([value; 8])
    }
    fn sqrt(self) -> Self {
        Self(self.0.map(f64::sqrt))
    }
    fn lt(self, other: Self) -> Bits {
        self.bits(other, |a, b| a < b)
    }
    fn le(self, other: Self) -> Bits {
        self.bits(other, |a, b| a <= b)
    }
    fn select(mask: Bits, yes: Self, no: Self) -> Self {
        Self::chosen(mask, yes, no)
    }
}

impl Lanes for Eight<f32> {
    const COUNT: usize = 8;
    type Token = ();
    type Array = [f32; 8];
    type Mask = Bits;
    type Double = Eight<f64>;

    fn token(self) {}
    fn splat((): (), value: f32) -> Self {
        Self([value; 8])
    }
    fn load((): (), array: &[f32; 8]) -> Self {
        Self(*array)
    }
    fn store(self) -> [f32; 8] {
        self.0
    }
    fn sqrt(self) -> Self {
        Self(self.0.map(f32::sqrt))
    }
    fn filter_mul_add(self, factor: Self, addend: Self) -> Self {
        self * factor + addend
    }
    fn filter_max(self, other: Self) -> Self {
        Self::chosen(other.lt(self), self, other)
    }
    fn lt(self, other: Self) -> Bits {
        self.bits(other, |a, b| a < b)
    }
    fn le(self, other: Self) -> Bits {
        self.bits(other, |a, b| a <= b)
    }
    fn select(mask: Bits, yes: Self, no: Self) -> Self {
        Self::chosen(mask, yes, no)
    }
    fn compress(self, mask: Bits) -> Self {
        let kept = (0..8).filter(|lane| mask.0 >> lane & 1 == 1).map(|lane| self.0[lane]);
        let mut lanes = self.0;
        lanes.iter_mut().zip(kept).for_each(|(lane, number)| *lane = number);
        Self(lanes)
    }
    fn widen(self, _: usize) -> Eight<f64> {
        Eight(self.0.map(f64::from))
    }
    fn narrow(array: &mut [f32; 8], _: usize, doubles: Eight<f64>) {
        *array = doubles.0.map(|number| number as f32);
    }
    fn out_of_line<R>((): (), work: impl FnOnce() -> R) -> R {
        work()
    }
}

/// Every hit of packets of eight.
fn hits_of<L: Lanes<Token = (), Array = [f32; 8]>>(
    structure: &impl Intersect,
    packets: &[RayPacket<[f32; 8]>],
) -> Vec<HitPacket<[f32; 8]>> {
    let mut hits = vec![HitPacket::none(); packets.len()];
    structure.closest_hit_lanes::<L>(Exact, (), &mut Trace::new(), packets, &mut hits);
    hits
}

#[test]
fn they_answer_as_the_kernel_s_do() {
    let mut random = Random::seeded(51);
    let sphere = |random: &mut Random| {
        let [x, y, z] = random.in_cube(1.0).to_array();
        [x, y, z, random.log_uniform(-6, -3) as f32]
    };
    let spheres: SphereList = (0..500).map(|_| sphere(&mut random)).collect();
    let tree = SphereTree::new(spheres.clone());
    // Beams, of which the tree makes groups, and rays that have nothing in common.
    let mut packets = Vec::new();
    for _ in 0..100 {
        let (from, to) = (random.in_cube(3.0), random.in_cube(1.0));
        let beam = from_fn::<_, 8, _>(|_| Ray::new(from, to + random.in_cube(0.05) - from));
        packets.push(RayPacket::new(&beam));
        let apart = from_fn::<_, 8, _>(|_| Ray::new(random.in_cube(2.0), random.direction()));
        packets.push(RayPacket::new(&apart));
    }

    let hits = hits_of::<f32x8>(&spheres, &packets);
    assert!(hits.iter().flat_map(HitPacket::hits).flatten().count() > 400);
    assert_eq!(hits_of::<Eight<f32>>(&spheres, &packets), hits);
    assert_eq!(hits_of::<Eight<f32>>(&tree, &packets), hits);

    let mut occluded = vec![0; packets.len()];
    let trace = &mut Trace::new();
    spheres.any_hit_lanes::<Eight<f32>>(Exact, (), trace, &packets, &mut occluded);
    for (occluded, hits) in occluded.into_iter().zip(&hits) {
        let bits = hits.hits().enumerate().map(|(lane, hit)| u32::from(hit.is_some()) << lane);
        assert_eq!(occluded, bits.sum::<u32>());
    }
}
