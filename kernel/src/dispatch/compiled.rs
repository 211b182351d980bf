//! The walks of every tier at every level, compiled once, here.
//!
//! What is generic is compiled where it is used, in every program and every test that does; and
//! three tiers at three levels take minutes. The functions of an `impl` for one type are not
//! generic: they are compiled with this crate, and the generic functions of
//! [`dispatch`](crate::dispatch) only call them.

use super::{Level, Packet};
use crate::{
    Accuracy, Bvh, DepthOrder, Exact, Fast, HitPacket, Lanes, RayPacket, SpherePacket, Spheres,
    Stable, bvh, tiles,
};
use fearless_simd::{Simd, f32x16};

/// Does `work` in a function that is compiled for `level`, with its token: of the levels of x86
/// those that have a [`LevelName`](super::LevelName), since one more is a quarter more to compile.
macro_rules! at_level {
    ($level:expr, $simd:ident => $work:expr) => {
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        {
            if let Some($simd) = $level.as_avx512() {
                return $simd.vectorize(
                    #[inline(always)]
                    || $work,
                );
            }
            if let Some($simd) = $level.as_avx2() {
                return $simd.vectorize(
                    #[inline(always)]
                    || $work,
                );
            }
            if let Some($simd) = $level.as_sse2() {
                return $simd.vectorize(
                    #[inline(always)]
                    || $work,
                );
            }
        }
        #[cfg(not(all(any(target_arch = "x86", target_arch = "x86_64"), target_feature = "sse2")))]
        fearless_simd::dispatch!($level, $simd => $work);
    };
}

/// A trait of functions at a level, and its implementation for every tier by functions that are
/// generic over tier and lanes.
macro_rules! compiled {
    (@trait $(fn $name:ident = $($walk:ident)::+($($argument:ident: $type:ty),*);)*) => {
        /// What a tier does at a level.
        pub trait Compiled {
            $(
                #[doc = concat!("`", stringify!($($walk)::+), "`")]
                fn $name(level: Level, $($argument: $type),*);
            )*
        }
    };
    (@tier $tier:ident $(fn $name:ident = $($walk:ident)::+($($argument:ident: $type:ty),*);)*) => {
        impl Compiled for $tier {
            $(
                #[inline(never)]
                fn $name(level: Level, $($argument: $type),*) {
                    #[inline(always)]
                    fn at<S: Simd>(simd: S, $($argument: $type),*) {
                        $($walk)::+::<$tier, f32x16<S>>(simd, $($argument),*);
                    }
                    at_level!(level.0, simd => at(simd, $($argument),*));
                }
            )*
        }
    };
    ($($functions:tt)*) => {
        compiled!(@trait $($functions)*);
        compiled!(@tier Fast $($functions)*);
        compiled!(@tier Stable $($functions)*);
        compiled!(@tier Exact $($functions)*);
    };
}

compiled! {
    fn nearest = crate::nearest(
        rays: &[RayPacket<Packet>], spheres: Spheres<'_>, hits: &mut [HitPacket<Packet>]
    );
    fn any = crate::any(rays: &[RayPacket<Packet>], spheres: Spheres<'_>, met: &mut [u32]);
    fn pairs = each_pair(
        rays: &[RayPacket<Packet>],
        spheres: &[SpherePacket<Packet>],
        hits: &mut [HitPacket<Packet>]
    );
    fn tree_nearest = bvh::nearest(
        rays: &[RayPacket<Packet>],
        spheres: Spheres<'_>,
        bvh: &Bvh<'_>,
        hits: &mut [HitPacket<Packet>]
    );
    fn tree_any = bvh::any(
        rays: &[RayPacket<Packet>], spheres: Spheres<'_>, bvh: &Bvh<'_>, met: &mut [u32]
    );
    fn tree_nearest_coherent = bvh::nearest_coherent(
        rays: &[RayPacket<Packet>],
        spheres: Spheres<'_>,
        bvh: &Bvh<'_>,
        hits: &mut [HitPacket<Packet>]
    );
    fn tree_any_coherent = bvh::any_coherent(
        rays: &[RayPacket<Packet>], spheres: Spheres<'_>, bvh: &Bvh<'_>, met: &mut [u32]
    );
    fn tiles_nearest = tiles::nearest(
        rays: &[RayPacket<Packet>],
        spheres: Spheres<'_>,
        order: &DepthOrder<'_>,
        lists: &mut [u32],
        hits: &mut [HitPacket<Packet>]
    );
    fn tiles_any = tiles::any(
        rays: &[RayPacket<Packet>],
        spheres: Spheres<'_>,
        order: &DepthOrder<'_>,
        lists: &mut [u32],
        met: &mut [u32]
    );
}

/// [`crate::pairs`], packet by packet.
#[inline(always)]
fn each_pair<A: Accuracy, L: Lanes>(
    token: L::Token,
    rays: &[RayPacket<L>],
    spheres: &[SpherePacket<L>],
    hits: &mut [HitPacket<L>],
) {
    for ((rays, spheres), hits) in rays.iter().zip(spheres).zip(hits) {
        *hits = crate::pairs::<A, L>(token, rays, spheres);
    }
}
