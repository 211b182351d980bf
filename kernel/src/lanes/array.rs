//! The arrays that packets in memory are made of.

use core::fmt::Debug;

/// `[f32; N]`, one number a lane.
///
/// Packets depend on nothing else of the lanes that read them, so that vectors fixed at build time
/// and vectors chosen at run time share their packets.
pub trait LaneArray: Copy + Debug + Default + PartialEq + AsRef<[f32]> + AsMut<[f32]> {
    /// N.
    const COUNT: usize;
    /// `[u32; N]`: sphere indices, one a lane.
    type Ids: Copy + Debug + Default + PartialEq + AsRef<[u32]> + AsMut<[u32]>;
    /// `[T; N]`: anything else, one a lane.
    type Each<T>: AsRef<[T]> + AsMut<[T]>;

    /// `value` for every lane.
    fn each<T: Copy>(value: T) -> Self::Each<T>;
}

macro_rules! lane_array {
    ($count:literal) => {
        impl LaneArray for [f32; $count] {
            const COUNT: usize = $count;
            type Ids = [u32; $count];
            type Each<T> = [T; $count];

            #[inline(always)]
            fn each<T: Copy>(value: T) -> [T; $count] {
                [value; $count]
            }
        }
    };
}

lane_array!(1);
lane_array!(4);
lane_array!(8);
lane_array!(16);
