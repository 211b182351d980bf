//! Every traversal at every level, compiled once, here.
//!
//! What is generic is compiled where it is used, in every program and every test that does; the
//! functions of an `impl` for one type are compiled with this crate, and the generic methods of
//! [`Intersect`](crate::Intersect) only call them. So a crate of a user's has them at full speed
//! whatever its profile says, and tiers are values here.

use super::Level;
use crate::accuracy::Tier;
use crate::bvh::traverse::wavefront;
use crate::bvh::tree::Bvh;
use crate::coherent::depth_list::DepthList;
use crate::coherent::{list_source, tree_source};
use crate::geometry::hit::HitPacket;
use crate::geometry::ray::RayPacket;
use crate::geometry::sphere::{SpherePacket, Spheres};
use crate::linear;
use crate::query::{Answers, AnyHit, ClosestHit};
use crate::trace::Coherence;
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

/// The traversals of a query, for packets of sixteen lanes.
pub trait Compiled: Answers {
    /// Of a list of spheres.
    fn list(
        level: Level,
        tier: Tier,
        spheres: Spheres<'_>,
        rays: &[RayPacket],
        answers: &mut [Self::Packet<[f32; 16]>],
    );

    /// Of a tree, as the rays are `coherent` or not.
    fn tree(
        level: Level,
        tier: Tier,
        bvh: &Bvh<'_>,
        coherence: Coherence,
        rays: &[RayPacket],
        answers: &mut [Self::Packet<[f32; 16]>],
    );

    /// Of a depth list.
    fn depth_list(
        level: Level,
        tier: Tier,
        list: &DepthList<'_>,
        scratch: &mut [f32],
        rays: &[RayPacket],
        answers: &mut [Self::Packet<[f32; 16]>],
    );
}

macro_rules! compiled {
    ($query:ident, $packet:ty) => {
        impl Compiled for $query {
            #[inline(never)]
            fn list(
                level: Level,
                tier: Tier,
                spheres: Spheres<'_>,
                rays: &[RayPacket],
                answers: &mut [$packet],
            ) {
                #[inline(always)]
                fn at<S: Simd>(
                    simd: S,
                    tier: Tier,
                    spheres: Spheres<'_>,
                    rays: &[RayPacket],
                    answers: &mut [$packet],
                ) {
                    linear::traverse::<f32x16<S>, $query>(tier, simd, spheres, rays, answers);
                }
                at_level!(level.0, simd => at(simd, tier, spheres, rays, answers));
            }

            #[inline(never)]
            fn tree(
                level: Level,
                tier: Tier,
                bvh: &Bvh<'_>,
                coherence: Coherence,
                rays: &[RayPacket],
                answers: &mut [$packet],
            ) {
                #[inline(always)]
                fn at<S: Simd>(
                    simd: S,
                    tier: Tier,
                    bvh: &Bvh<'_>,
                    coherence: Coherence,
                    rays: &[RayPacket],
                    answers: &mut [$packet],
                ) {
                    if coherence == Coherence::Incoherent {
                        wavefront::traverse::<f32x16<S>, $query>(tier, simd, bvh, rays, answers);
                    } else {
                        let detect = coherence == Coherence::Detect;
                        tree_source::traverse::<f32x16<S>, $query>(
                            tier, simd, bvh, detect, rays, answers,
                        );
                    }
                }
                at_level!(level.0, simd => at(simd, tier, bvh, coherence, rays, answers));
            }

            #[inline(never)]
            fn depth_list(
                level: Level,
                tier: Tier,
                list: &DepthList<'_>,
                scratch: &mut [f32],
                rays: &[RayPacket],
                answers: &mut [$packet],
            ) {
                #[inline(always)]
                fn at<S: Simd>(
                    simd: S,
                    tier: Tier,
                    list: &DepthList<'_>,
                    scratch: &mut [f32],
                    rays: &[RayPacket],
                    answers: &mut [$packet],
                ) {
                    list_source::traverse::<f32x16<S>, $query>(
                        tier, simd, list, scratch, rays, answers,
                    );
                }
                at_level!(level.0, simd => at(simd, tier, list, scratch, rays, answers));
            }
        }
    };
}

compiled!(ClosestHit, HitPacket);
compiled!(AnyHit, u32);

/// [`pair_lanes`](crate::pair_lanes), packet by packet.
#[inline(never)]
pub(crate) fn pairs(
    level: Level,
    tier: Tier,
    rays: &[RayPacket],
    spheres: &[SpherePacket],
    hits: &mut [HitPacket],
) {
    at_level!(level.0, simd => linear::each_pair::<f32x16<_>>(tier, simd, rays, spheres, hits));
}
