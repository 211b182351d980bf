//! The arrays that packets in memory are made of.
//!
//! The operations of traversals on these arrays stand here, as loops that are always inlined. An iterator, closure or
//! `Default` of the standard library would be a call where a build has many codegen units and no link-time
//! optimisation: 13 times slower, measured.

use core::fmt::Debug;

/// How many numbers of one kind a node, a leaf or a block of a depth list holds.
pub(crate) const WIDTH: usize = 16;

mod sealed {
    pub trait Sealed {}
}

/// Aligns a packet of several lanes to a line of the cache; takes no room.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(align(64))]
pub struct CacheLine;

/// `[f32; N]`, one number a lane, for N = 1, 4, 8 and 16.
///
/// Packets depend on nothing else of the lanes that read them, so that vectors fixed at build time
/// and vectors chosen at run time share their packets.
pub trait LaneArray:
    sealed::Sealed + Copy + Debug + PartialEq + AsRef<[f32]> + AsMut<[f32]> + 'static
{
    /// N.
    const COUNT: usize;
    /// `[u32; N]`: sphere indices, one a lane.
    type Ids: Copy + Debug + PartialEq + AsRef<[u32]> + AsMut<[u32]>;
    /// `[T; N]`: anything else, one a lane.
    type Each<T>: AsRef<[T]> + AsMut<[T]>;
    /// Aligns a packet, and takes no room: one lane needs no more alignment than its numbers do.
    #[doc(hidden)]
    type Alignment: Copy + Debug + PartialEq;

    /// What aligns a packet.
    #[doc(hidden)]
    const ALIGNMENT: Self::Alignment;
    /// Zero in every lane.
    const ZEROS: Self;
    /// `+inf` in every lane.
    const INFINITIES: Self;
    /// `-inf` in every lane.
    const MINUS_INFINITIES: Self;
    /// The greatest index in every lane, which stands for none.
    const NO_IDS: Self::Ids;

    /// `value` in every lane.
    fn filled(value: f32) -> Self;
    /// `value` in every lane.
    fn ids(value: u32) -> Self::Ids;
    /// `value` in every lane.
    fn each<T: Copy>(value: T) -> Self::Each<T>;
    /// The number in `lane`, modulo N: the remainder spares a branch.
    fn get(&self, lane: usize) -> f32;
    /// Puts a number in `lane`, modulo N.
    fn set(&mut self, lane: usize, value: f32);
    /// Numbers `part * N ..` of sixteen; a part past the last wraps to the first.
    fn part(numbers: &[f32; 16], part: usize) -> Self;
    /// Puts the lanes where [`part`](LaneArray::part) takes them from.
    fn put_part(&self, numbers: &mut [f32; 16], part: usize);
    /// The lanes that are in `numbers` from `at` on; `None` if there are too few.
    fn taken_at(numbers: &[f32], at: usize) -> Option<Self>;
    /// Puts the lanes into `numbers`, from `at` on; does nothing and returns false if there is no room.
    fn put_at(&self, numbers: &mut [f32], at: usize) -> bool;
}

macro_rules! lane_array {
    ($count:literal, $alignment:tt) => {
        impl sealed::Sealed for [f32; $count] {}

        // For one lane, the modulus is one.
        #[allow(clippy::modulo_one)]
        impl LaneArray for [f32; $count] {
            const COUNT: usize = $count;
            type Ids = [u32; $count];
            type Each<T> = [T; $count];
            type Alignment = $alignment;

            const ALIGNMENT: $alignment = $alignment;
            const ZEROS: Self = [0.0; $count];
            const INFINITIES: Self = [f32::INFINITY; $count];
            const MINUS_INFINITIES: Self = [f32::NEG_INFINITY; $count];
            const NO_IDS: [u32; $count] = [u32::MAX; $count];

            #[inline(always)]
            fn filled(value: f32) -> Self {
                [value; $count]
            }

            #[inline(always)]
            fn ids(value: u32) -> [u32; $count] {
                [value; $count]
            }

            #[inline(always)]
            fn each<T: Copy>(value: T) -> [T; $count] {
                [value; $count]
            }

            #[inline(always)]
            fn get(&self, lane: usize) -> f32 {
                self[lane % $count]
            }

            #[inline(always)]
            fn set(&mut self, lane: usize, value: f32) {
                self[lane % $count] = value;
            }

            #[inline(always)]
            fn part(numbers: &[f32; WIDTH], part: usize) -> Self {
                // Sixteen divides 2^32 and 2^64, so a product that wraps has the same remainder.
                let from = part.wrapping_mul($count) % WIDTH;
                let mut lanes = [0.0; $count];
                let mut lane = 0;
                while lane < $count {
                    lanes[lane] = numbers[(from + lane) % WIDTH];
                    lane += 1;
                }
                lanes
            }

            #[inline(always)]
            fn put_part(&self, numbers: &mut [f32; WIDTH], part: usize) {
                let from = part.wrapping_mul($count) % WIDTH;
                let mut lane = 0;
                while lane < $count {
                    numbers[(from + lane) % WIDTH] = self[lane];
                    lane += 1;
                }
            }

            #[inline(always)]
            fn taken_at(numbers: &[f32], at: usize) -> Option<Self> {
                if let Some(numbers) = numbers.get(at..)
                    && let Some(numbers) = numbers.first_chunk::<$count>()
                {
                    return Some(*numbers);
                }
                None
            }

            #[inline(always)]
            fn put_at(&self, numbers: &mut [f32], at: usize) -> bool {
                if let Some(numbers) = numbers.get_mut(at..)
                    && let Some(numbers) = numbers.first_chunk_mut::<$count>()
                {
                    *numbers = *self;
                    return true;
                }
                false
            }
        }
    };
}

lane_array!(1, ());
lane_array!(4, CacheLine);
lane_array!(8, CacheLine);
lane_array!(16, CacheLine);
