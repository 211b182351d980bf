//! Two loops that are no tier: what a user pays without the kernel, and what accuracy that buys.
//!
//! * `plain geometric`: the form of the tier `Geometric`, in `f32`: t_m = d.p, l^2 = p.p - t_m^2,
//!   dt = sqrt(r^2 - l^2), t = t_m -+ dt. Directions are made unit before the clock starts; t is divided by their
//!   length if a line hits.
//! * `plain f64`: the textbook form in double precision, nothing proven: a = d.d, b = d.p, D = b^2 - a (p.p - r^2),
//!   t = (b -+ sqrt D) / a.
//!
//! Both run in the same brute-force loop: one branch for four spheres, and roots only behind it and out of line.
//! Whatever can be done before the clock starts is done before: rays are widened, radii squared. Products and sums are
//! fused if the build has that instruction.

use super::{Engine, Label, Promise, Query, Run};
use spherule_kernel::{Hit, Ray, Sphere, Spheres};
use spherule_tests::scenes::Scene;
use std::rc::Rc;

/// The lecture's geometric form.
pub(crate) const GEOMETRIC: &str = "plain geometric";
/// The textbook form in double precision.
pub(crate) const DOUBLE: &str = "plain f64";
/// Spheres under one branch.
const GROUP: usize = 4;

/// Both forms in their lanes, the narrowest first.
pub(crate) fn marks(scene: &Scene) -> [Engine; 5] {
    type Ready = fn(&[Ray], Spheres<'_>) -> Box<dyn Run>;
    let mark = |name, lanes, ready: Ready| Engine {
        label: Label { way: "brute force", name, lanes },
        promise: match name {
            DOUBLE => Promise::Near(0.0, 1),
            _ if scene.has_ground() => Promise::GEOMETRIC_ON_GROUND,
            _ => Promise::TEXTBOOK,
        },
        most_rays: usize::MAX,
        ready: {
            let list = Rc::clone(&scene.spheres);
            Box::new(move |rays| ready(&rays.list, list.spheres()))
        },
    };
    [
        mark(GEOMETRIC, "f32x4", geometric_x4::ready),
        mark(GEOMETRIC, "f32x8", geometric_x8::ready),
        mark(GEOMETRIC, "f32x16", geometric_x16::ready),
        mark(DOUBLE, "f64x4", double_x4::ready),
        mark(DOUBLE, "f64x8", double_x8::ready),
    ]
}

/// The loop for one lane type of `wide`, whose types share no trait for their methods; `$unit` chooses the form.
macro_rules! brute_force {
    ($module:ident, $vector:ident, $element:ident, $count:literal, unit: $unit:literal) => {
        mod $module {
            use super::*;
            use wide::$vector as V;

            /// A packet. `beside` holds what else the form needs of the direction: its length, or d.d.
            struct Packet {
                origin: [V; 3],
                direction: [V; 3],
                beside: V,
                t_min: V,
                t_max: V,
                /// The closest hit: t, infinite if there is none, and the sphere's index as a number.
                best: [V; 2],
            }

            /// A sphere, its radius squared.
            #[derive(Clone, Copy)]
            struct Prepared {
                center: [$element; 3],
                square: $element,
            }

            struct Brute {
                packets: Vec<Packet>,
                groups: Vec<[Prepared; GROUP]>,
                rays: usize,
            }

            #[inline(always)]
            fn dot(v: [V; 3], w: [V; 3]) -> V {
                v[2].mul_add(w[2], v[1].mul_add(w[1], v[0] * w[0]))
            }

            /// Lanes past the last ray repeat it.
            fn packet(rays: &[Ray]) -> Packet {
                let lanes = |of: &dyn Fn(&Ray) -> f32| {
                    let lane = |lane: usize| $element::from(of(&rays[lane.min(rays.len() - 1)]));
                    V::new(std::array::from_fn(lane))
                };
                let d = [0, 1, 2].map(|axis| lanes(&|ray| ray.direction[axis]));
                let beside = if $unit { dot(d, d).sqrt() } else { dot(d, d) };
                Packet {
                    origin: [0, 1, 2].map(|axis| lanes(&|ray| ray.origin[axis])),
                    direction: if $unit { d.map(|x| x / beside) } else { d },
                    beside,
                    t_min: lanes(&|ray| ray.t_min),
                    t_max: lanes(&|ray| ray.t_max),
                    best: [V::splat($element::INFINITY); 2],
                }
            }

            pub(super) fn ready(rays: &[Ray], spheres: Spheres<'_>) -> Box<dyn Run> {
                let prepared = |sphere: Sphere| {
                    let radius = $element::from(sphere.radius);
                    let center = sphere.center.to_array().map($element::from);
                    Prepared { center, square: radius * radius }
                };
                let mut spheres: Vec<_> = spheres.iter().map(prepared).collect();
                // Nothing hits a sphere whose radius squared is -inf.
                let nothing = Prepared { center: [0.0; 3], square: $element::NEG_INFINITY };
                spheres.resize(spheres.len().next_multiple_of(GROUP), nothing);
                let groups = spheres.as_chunks().0.to_vec();
                let packets = rays.chunks($count).map(packet).collect();
                Box::new(Brute { packets, groups, rays: rays.len() })
            }

            /// The middle between the roots, and the discriminant.
            #[inline(always)]
            fn solved(rays: &Packet, sphere: &Prepared) -> [V; 2] {
                let p = [0, 1, 2].map(
                    #[inline(always)]
                    |axis| V::splat(sphere.center[axis]) - rays.origin[axis],
                );
                let b = dot(rays.direction, p);
                let square = V::splat(sphere.square);
                let discriminant = if $unit {
                    square - (dot(p, p) - b * b)
                } else {
                    b.mul_add(b, V::splat(0.0) - rays.beside * (dot(p, p) - square))
                };
                [b, discriminant]
            }

            impl Run for Brute {
                fn run(&mut self, _: Query) {
                    for rays in &mut self.packets {
                        rays.best = [V::splat($element::INFINITY), V::splat(0.0)];
                        for (index, group) in self.groups.iter().enumerate() {
                            let [one, two, three, four] = group;
                            let [_, one] = solved(rays, one);
                            let [_, two] = solved(rays, two);
                            let [_, three] = solved(rays, three);
                            let [_, four] = solved(rays, four);
                            let largest = one.fast_max(two).fast_max(three.fast_max(four));
                            if V::splat(0.0).simd_le(largest).any() {
                                resolve(rays, group, index * GROUP);
                            }
                        }
                    }
                    std::hint::black_box(&self.packets);
                }

                fn hits(&self) -> Vec<Option<Hit>> {
                    let hit = |ray: usize| {
                        let [t, sphere] = self.packets[ray / $count].best;
                        let [t, sphere] = [t, sphere].map(|v| v.to_array()[ray % $count] as f32);
                        t.is_finite().then_some(Hit { t: t + 0.0, sphere: sphere as u32 })
                    };
                    (0..self.rays).map(hit).collect()
                }
            }

            #[inline(never)]
            fn resolve(rays: &mut Packet, group: &[Prepared; GROUP], first: usize) {
                for (slot, sphere) in group.iter().enumerate() {
                    let [middle, discriminant] = solved(rays, sphere);
                    let meets = V::splat(0.0).simd_le(discriminant);
                    if meets.any() {
                        let root = discriminant.sqrt();
                        let [near, far] = [middle - root, middle + root].map(|t| t / rays.beside);
                        let accepted = |t: V| meets & rays.t_min.simd_le(t) & t.simd_le(rays.t_max);
                        let t = accepted(far).select(far, V::splat($element::INFINITY));
                        let t = accepted(near).select(near, t);
                        let nearer = t.simd_lt(rays.best[0]);
                        let index = V::splat((first + slot) as $element);
                        rays.best =
                            [nearer.select(t, rays.best[0]), nearer.select(index, rays.best[1])];
                    }
                }
            }
        }
    };
}

brute_force!(geometric_x4, f32x4, f32, 4, unit: true);
brute_force!(geometric_x8, f32x8, f32, 8, unit: true);
brute_force!(geometric_x16, f32x16, f32, 16, unit: true);
brute_force!(double_x4, f64x4, f64, 4, unit: false);
brute_force!(double_x8, f64x8, f64, 8, unit: false);
