//! Every traversal at every level, compiled once, here.
//!
//! Generic code is compiled where it is used, in every program and every test that uses it. The functions of an
//! `impl` for one type are compiled with this crate, and the generic methods of [`Intersect`](crate::Intersect) only
//! call them. So a user's crate has them at full speed whatever its profile says, and tiers are values here.

use super::Level;
use crate::accuracy::Tier;
use crate::bvh::traverse::one_ray;
use crate::bvh::tree::Bvh;
use crate::coherent::depth_list::DepthList;
use crate::coherent::few_rays::{self, Asked};
use crate::coherent::learnt::Learnt;
use crate::coherent::packet_source::PacketSource;
use crate::coherent::ray_order::RayKeys;
use crate::coherent::tree_source::Ways;
use crate::coherent::{list_source, tree_source};
use crate::geometry::camera::tiles::CameraTiles;
use crate::geometry::hit::HitPacket;
use crate::geometry::many::ManyRays;
use crate::geometry::many_answers::ManyAnswers;
use crate::geometry::ray::Ray;
use crate::geometry::ray_packet::RayPacket;
use crate::geometry::sphere::{SpherePacket, Spheres};
use crate::geometry::surface::SurfacePacket;
use crate::lanes::dispatched::joined::Joined;
use crate::linear::Writes;
use crate::query::{Answers, AnyHit, ClosestHit};
use crate::spawn_ray::packets::{self, SurfaceHits, Towards};
use crate::{linear, surface};
#[cfg(not(any(
    all(any(target_arch = "x86", target_arch = "x86_64"), target_feature = "sse2"),
    target_arch = "aarch64",
    all(target_arch = "wasm32", target_feature = "simd128"),
)))]
use fearless_simd::Fallback;
#[cfg(target_arch = "aarch64")]
use fearless_simd::aarch64::Neon;
#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
use fearless_simd::wasm32::WasmSimd128;
use fearless_simd::{Simd, f32x4};
#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
use fearless_simd::{
    f32x8, f32x16,
    x86::{Avx2, Avx512, Sse2},
};

/// Does `work` in a function that is compiled for `level`, with its token and its sixteen lanes. Of the levels of x86
/// only those that have a [`LevelName`](super::LevelName) are compiled, since one more takes a quarter more to
/// compile.
macro_rules! at_level {
    ($level:expr, $simd:ident, $lanes:ident => $work:expr) => {
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        {
            at_level!(@as $level.as_avx512(), $simd, $lanes = f32x16<Avx512> => $work);
            at_level!(@as $level.as_avx2(), $simd, $lanes = Joined<f32x8<Avx2>, 2> => $work);
            at_level!(@as $level.as_sse2(), $simd, $lanes = Joined<f32x4<Sse2>, 4> => $work);
        }
        #[cfg(target_arch = "aarch64")]
        at_level!(@as $level.as_neon(), $simd, $lanes = Joined<f32x4<Neon>, 4> => $work);
        #[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
        at_level!(@as $level.as_wasm_simd128(), $simd, $lanes = Joined<f32x4<WasmSimd128>, 4> => $work);
        #[cfg(not(any(
            all(any(target_arch = "x86", target_arch = "x86_64"), target_feature = "sse2"),
            target_arch = "aarch64",
            all(target_arch = "wasm32", target_feature = "simd128"),
        )))]
        if let fearless_simd::Level::Fallback(fallback) = $level {
            at_level!(@as Some(fallback), $simd, $lanes = Joined<f32x4<Fallback>, 4> => $work);
        }
    };
    (@as $token:expr, $simd:ident, $lanes:ident = $type:ty => $work:expr) => {
        if let Some($simd) = $token {
            // Work that moves no lanes does not name their type.
            #[allow(dead_code)]
            type $lanes = $type;
            return $simd.vectorize(
                #[inline(always)]
                || $work,
            );
        }
    };
}

/// The traversals of a query, for packets of sixteen lanes: a trait, and its implementation for both queries
/// by functions that are generic over lanes and query.
macro_rules! compiled {
    ($($(#[$doc:meta])* fn $name:ident($structure:ident: $type:ty $(, $more:ident: $kind:ty)*) = $traverse:path;)*) => {
        /// The traversals of a query, for packets of sixteen lanes.
        pub trait Compiled: Answers {
            $(
                $(#[$doc])*
                fn $name(
                    level: Level,
                    tier: Tier,
                    $structure: $type,
                    $($more: $kind,)*
                    answers: &mut [Self::Packet<[f32; 16]>],
                );
            )*
            /// Writes the answers of packets from place `from` on, before place `to`.
            fn write_at(
                level: Level,
                many: &mut Self::Many<'_>,
                packets: &[Self::Packet<[f32; 16]>],
                from: usize,
                to: usize,
            );

            /// Answers one ray by a tree.
            fn one_ray(level: Level, tier: Tier, bvh: &Bvh<'_>, ray: &Ray) -> Self::One;
        }

        compiled!(@query ClosestHit, HitPacket, $($name($structure: $type $(, $more: $kind)*) = $traverse;)*);
        compiled!(@query AnyHit, u32, $($name($structure: $type $(, $more: $kind)*) = $traverse;)*);
    };
    (@query $query:ident, $packet:ty, $($name:ident($structure:ident: $type:ty $(, $more:ident: $kind:ty)*) = $traverse:path;)*) => {
        impl Compiled for $query {
            $(
                #[inline(never)]
                fn $name(
                    level: Level,
                    tier: Tier,
                    $structure: $type,
                    $($more: $kind,)*
                    answers: &mut [$packet],
                ) {
                    use $traverse as traverse;
                    at_level!(level.0, simd, Vector => {
                        traverse::<Vector, Self>(tier, simd, $structure, $($more,)* answers)
                    });
                }
            )*

            #[inline(never)]
            fn write_at(
                level: Level,
                many: &mut Self::Many<'_>,
                packets: &[$packet],
                from: usize,
                to: usize,
            ) {
                at_level!(level.0, simd, Vector => {
                    let _ = simd;
                    many.write(packets, from, to);
                });
            }

            #[inline(never)]
            fn one_ray(level: Level, tier: Tier, bvh: &Bvh<'_>, ray: &Ray) -> Self::One {
                at_level!(level.0, simd, Vector => {
                    one_ray::trace::<Vector, Self>(simd, tier, bvh, ray)
                });
                // There is no other level.
                <Self as Answers>::one::<[f32; 1]>(&<Self as Answers>::none::<[f32; 1]>(), 0)
            }
        }
    };
}

compiled! {
    /// Of a list of spheres.
    fn list(spheres: Spheres<'_>, rays: &[RayPacket]) = linear::traverse;
    /// Of a tree, as the rays are coherent or not.
    fn tree(bvh: &Bvh<'_>, ways: Ways<'_>, packets: PacketSource<'_, [f32; 16]>) = tree_source::traverse;
    /// Of a depth list.
    fn depth_list(list: &DepthList<'_>, memory: (&mut [f32], &mut Learnt), rays: &[RayPacket]) = list_source::traverse;
}

/// [`pair_lanes`](crate::pair_lanes), packet by packet.
#[inline(never)]
pub(crate) fn pairs(
    level: Level,
    tier: Tier,
    rays: &[RayPacket],
    spheres: &[SpherePacket],
    hits: &mut [HitPacket],
) {
    at_level!(level.0, simd, Vector => linear::each_pair::<Vector>(tier, simd, rays, spheres, hits));
}

/// [`object_lanes`](crate::object_lanes) for those packets that `numbers` names.
#[inline(never)]
pub(crate) fn object(
    level: Level,
    tier: Tier,
    object: (Spheres<'_>, u32),
    (numbers, rays): (&[u32], &[RayPacket]),
    hits: &mut [HitPacket],
) -> Writes {
    at_level!(level.0, simd, Vector => {
        linear::one_object::<Vector>(tier, simd, object, numbers, rays, hits)
    });
    // There is no other level.
    Writes::default()
}

/// [`surface_lanes`](crate::surface_lanes), packet by packet.
#[inline(never)]
pub(crate) fn surfaces(
    level: Level,
    tier: Tier,
    spheres: Spheres<'_>,
    (rays, hits): (&[RayPacket], &[HitPacket]),
    surfaces: &mut [SurfacePacket],
) {
    at_level!(level.0, simd, Vector => {
        surface::each_packet::<Vector>(tier, simd, spheres, rays, hits, surfaces);
    });
}

/// [`shadow_lanes`](crate::shadow_lanes), packet by packet.
#[inline(never)]
pub(crate) fn shadows(
    level: Level,
    tier: Tier,
    spheres: Spheres<'_>,
    hit: SurfaceHits<'_>,
    towards: Towards,
    shadow_rays: &mut [RayPacket],
) {
    at_level!(level.0, simd, Vector => {
        packets::each_packet::<Vector>(tier, simd, spheres, hit, towards, shadow_rays);
    });
}

/// [`leaves_held`](few_rays::leaves_held) of a tree.
#[inline(never)]
pub(crate) fn leaves_held(level: Level, bvh: &Bvh<'_>, asked: &Asked) -> f32 {
    at_level!(level.0, simd, Vector => few_rays::leaves_held::<Vector>(simd, bvh, asked));
    // There is no other level.
    0.0
}

/// Fills packets with rays.
#[inline(never)]
pub(crate) fn fill(level: Level, rays: &ManyRays<'_>, packets: &mut [RayPacket]) {
    at_level!(level.0, simd, Vector => rays.fill::<Vector>(simd, 0, packets));
}

/// Writes the keys of rays above their numbers.
#[inline(never)]
pub(crate) fn write_keys(level: Level, keys: &RayKeys, rays: &ManyRays<'_>, places: &mut [u32]) {
    at_level!(level.0, simd, Vector => keys.write_keys::<Vector>(simd, rays, places));
}

/// Makes the rays of as many of a camera's tiles as there is room for.
#[inline(never)]
pub(crate) fn fill_tiles(level: Level, tiles: CameraTiles<'_>, rays: &mut [RayPacket]) {
    at_level!(level.0, simd, Vector => {
        tiles.fill::<Vector>(simd, tiles.corners, rays);
    });
}
