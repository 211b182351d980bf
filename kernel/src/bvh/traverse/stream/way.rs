//! When rays go as a stream, and when ray by ray: what measures faster.
//!
//! Times a ray, ray by ray and as a stream, nanoseconds on a core of an EPYC of 2025 (Zen 5) with AVX-512; AVX2 and the
//! baseline have the same signs. 131,072 diffuse rays of uniform spheres, of a million 262,144; 8,192 go together.
//!
//! | spheres | tree | closest | stream | sorted | any | stream | sorted |
//! |--:|--:|--:|--:|--:|--:|--:|--:|
//! | 1,000 | 25 KB | 99 | 72 | 106 | 67 | 56 | 79 |
//! | 4,000 | 0.1 MB | 127 | 92 | 129 | 92 | 74 | 95 |
//! | 16,000 | 0.4 MB | 153 | 140 | 183 | 106 | 116 | 139 |
//! | 64,000 | 1.6 MB | 241 | 231 | 211 | 155 | 191 | 157 |
//! | 256,000 | 6.4 MB | 359 | 454 | 306 | 204 | 419 | 240 |
//! | 1,000,000 | 25 MB | 530 | 1159 | 358 | 345 | 996 | 264 |
//!
//! A ray that is done at its first hit shares less of its way. (Sorted, such rays gain among a million uniform spheres,
//! and lose a third where a large sphere ends most: they stay ray by ray.) Sorted, rays share what they read: it takes so
//! many that they share. A million spheres with 131,072 rays: 429.
//!
//! Fewer rays at a time share less, too. AVX-512, 1,000 spheres and 10,000:
//!
//! | rays | closest | stream | any | stream | closest | stream | any | stream |
//! |--:|--:|--:|--:|--:|--:|--:|--:|--:|
//! | 256 | 105 | 113 | 75 | 95 | 153 | 258 | 108 | 231 |
//! | 1,024 | 101 | 80 | 69 | 62 | 145 | 181 | 100 | 158 |
//! | 4,096 | 99 | 69 | 68 | 51 | 141 | 132 | 97 | 107 |
//! | 8,192 | 100 | 67 | 68 | 52 | 144 | 125 | 101 | 94 |

use super::{StreamMemory, TOGETHER};
use crate::bvh::traverse::few;
use crate::bvh::tree::Bvh;
use crate::query::Query;

/// How rays that have nothing in common go through a tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Way {
    RayByRay,
    AsTheyCome,
    Sorted,
}

/// Queues with less room for a ray are cut short too often. (With one place a ray a stream took 2.5 times as long as ray by
/// ray, with 4 it runs at 0.87 of its speed.)
const WORTH_IT: usize = 8;

/// Whether a tree is small enough for rays that go as they come.
#[inline(always)]
fn is_near<Q: Query>(bvh: &Bvh<'_>) -> bool {
    let most_bytes = if Q::ANY { 1 << 18 } else { 1 << 21 };
    size_of_val(bvh.nodes) + size_of_val(bvh.numbers) <= most_bytes
}

/// Whether enough rays, with enough memory, gain as they come.
#[inline(always)]
pub(crate) fn pays<Q: Query>(bvh: &Bvh<'_>) -> bool {
    is_near::<Q>(bvh) && few::few(bvh).is_none()
}

impl Way {
    /// The way of so many rays, which can be sorted if there is nothing known of any.
    #[inline(always)]
    pub(super) fn of<Q: Query>(
        bvh: &Bvh<'_>,
        memory: &StreamMemory<'_>,
        rays: usize,
        is_new: bool,
    ) -> Self {
        let together = memory.rays.len().min(TOGETHER);
        let can_be_sorted = rays.min(memory.order.len() / 2);
        // (What is outside would have to be known ray by ray.)
        let is_sorted = is_new && bvh.outside.is_empty() && can_be_sorted > together;
        if !memory.everywhere && memory.queues.len() < WORTH_IT * together {
            return Self::RayByRay;
        }
        if memory.everywhere {
            return if is_sorted { Self::Sorted } else { Self::AsTheyCome };
        }
        let (spheres, together) = (bvh.spheres.len(), together.min(rays));
        let shared_by = if Q::ANY { 1 } else { 2 };
        let is_shared = together == TOGETHER || spheres / shared_by <= together;
        if few::few(bvh).is_some() {
            Self::RayByRay
        } else if is_near::<Q>(bvh) && is_shared {
            Self::AsTheyCome
        } else if !Q::ANY && !is_near::<Q>(bvh) && is_sorted && spheres / 8 <= can_be_sorted {
            Self::Sorted
        } else {
            Self::RayByRay
        }
    }
}

#[cfg(test)]
#[cfg(feature = "alloc")]
mod tests {
    extern crate std;

    use super::*;
    use crate::query::{AnyHit, ClosestHit};
    use crate::testing::climb::Random;
    use crate::{QueuedRay, Sphere, SphereList, SphereTree, StreamRay, Vec3};
    use std::vec;

    /// The ways of the closest hit and of any, of so many rays in a tree over so many spheres, with memory to sort so
    /// many.
    fn ways(spheres: usize, rays: usize, sorted: usize, everywhere: bool) -> [Way; 2] {
        let mut random = Random(53);
        let mut sphere = || {
            let center = Vec3::from_array([(); 3].map(|()| random.below(1 << 20) as f32));
            Sphere { center, radius: 1.0 }
        };
        let tree = SphereTree::new((0..spheres).map(|_| sphere()).collect::<SphereList>());
        let (mut stream, mut order) = (vec![StreamRay::EMPTY; TOGETHER], vec![0; 2 * sorted]);
        let mut queues = vec![QueuedRay::EMPTY; WORTH_IT * TOGETHER];
        let memory = StreamMemory::new(&mut stream, &mut queues).expect("enough");
        let memory = memory.sorting(&mut order);
        let memory = if everywhere { memory.everywhere() } else { memory };
        [
            Way::of::<ClosestHit>(&tree.bvh(), &memory, rays, true),
            Way::of::<AnyHit>(&tree.bvh(), &memory, rays, true),
        ]
    }

    #[test]
    fn what_measures_faster() {
        use Way::{AsTheyCome, RayByRay, Sorted};
        // Few spheres, or few rays for them.
        assert_eq!(ways(64, 8192, 0, false), [RayByRay; 2]);
        assert_eq!(ways(1000, 256, 0, false), [RayByRay; 2]);
        assert_eq!(ways(1000, 600, 0, false), [AsTheyCome, RayByRay]);
        assert_eq!(ways(1000, 1024, 8192, false), [AsTheyCome; 2]);
        assert_eq!(ways(30_000, 8192, 0, false), [AsTheyCome, RayByRay]);
        // Many spheres, without enough rays that are sorted.
        assert_eq!(ways(120_000, 100_000, 0, false), [RayByRay; 2]);
        assert_eq!(ways(120_000, 100_000, 10_000, false), [RayByRay; 2]);
        assert_eq!(ways(120_000, 100_000, 20_000, false), [Sorted, RayByRay]);
    }

    #[test]
    fn everywhere_is_whatever_is_faster() {
        assert_eq!(ways(2, 16, 0, true), [Way::AsTheyCome; 2]);
        assert_eq!(ways(2, 10_000, 10_000, true), [Way::Sorted; 2]);
    }
}
