//! The same spheres in every structure.

use super::refitted;
use super::table::MOST_OF_BVH4;
use spherule_kernel::{Bvh4, DepthList, Ray, Sphere, SphereList, SphereTree, Vec3, Viewpoint};

/// Spheres, and memory for every structure of them.
#[derive(Clone, Debug)]
pub struct Memory {
    tree: SphereTree,
    refitted: SphereTree,
    list: SphereList,
    words: Vec<f32>,
    /// Empty if there are more spheres than the tree holds.
    bvh4: Vec<u32>,
}

/// The same spheres in every structure.
#[derive(Clone, Copy, Debug)]
pub struct Structures<'a> {
    /// The list.
    pub list: &'a SphereList,
    /// The depth list.
    pub depth_list: &'a DepthList<'a>,
    /// The tree.
    pub tree: &'a SphereTree,
    /// A tree that was built over other spheres, and refitted.
    pub refitted: &'a SphereTree,
    /// The tree of one lane, loaded from the words of a built one.
    pub bvh4: Option<Bvh4<'a>>,
}

impl Memory {
    /// Makes a list and trees of these spheres, and memory for a depth list.
    ///
    /// # Panics
    /// Never: the memory is enough.
    #[must_use]
    pub fn new(spheres: &[Sphere]) -> Self {
        let list = SphereList::from(spheres);
        let words = vec![f32::NAN; DepthList::needed(spheres.len())];
        let count = if spheres.len() > MOST_OF_BVH4 { 0 } else { Bvh4::needed(spheres.len()) };
        let mut bvh4 = vec![u32::MAX; count];
        if count > 0 {
            Bvh4::build(list.spheres(), &mut bvh4).expect("enough memory");
        }
        let (tree, refitted) = (SphereTree::new(list.clone()), refitted::tree(spheres));
        Self { tree, refitted, list, words, bvh4 }
    }

    /// Calls `ask` with every structure, the depth list sorted from `viewpoint`.
    ///
    /// # Panics
    /// Never: the memory is enough.
    pub fn sorted<R>(&mut self, viewpoint: Viewpoint, ask: impl FnOnce(Structures<'_>) -> R) -> R {
        let Self { tree, refitted, list, words, bvh4 } = self;
        let depth_list = &DepthList::sort(list.spheres(), viewpoint, words).expect("enough memory");
        let load = || Bvh4::load(list.spheres(), bvh4).expect("what was built");
        let bvh4 = (!bvh4.is_empty()).then(load);
        ask(Structures { list, depth_list, tree, refitted, bvh4 })
    }
}

/// The first ray's origin.
#[must_use]
pub fn viewpoint_of(rays: &[Ray]) -> Viewpoint {
    Viewpoint::Origin(rays.first().map_or(Vec3::ZERO, |ray| ray.origin))
}
