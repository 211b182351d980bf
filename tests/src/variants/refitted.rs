//! A tree whose spheres were elsewhere when it was built.

use spherule_kernel::{Sphere, SphereList, SphereTree, Vec3};

/// At most so many spheres are invalid, or of another scale, when the tree is built, since each of them is tested
/// against every ray.
const FEW: usize = 40;

/// A tree that was built over other spheres, and refitted to these.
///
/// # Panics
/// Never: the number is the same.
pub(super) fn tree(spheres: &[Sphere]) -> SphereTree {
    let mut tree = SphereTree::new(others(spheres));
    let growth = tree.refit(spheres).expect("as many");
    assert!(growth.is_finite() && growth > 0.0, "{growth}");
    tree
}

/// As many spheres, most of which have moved by some of their distance from the origin. Some are invalid, of another
/// scale, or equal to others.
fn others(spheres: &[Sphere]) -> SphereList {
    let rare = (spheres.len() / FEW).max(7);
    let other = |(index, sphere): (usize, &Sphere)| {
        let Vec3 { x, y, z } = sphere.center;
        match index % rare {
            1 => Sphere { center: Vec3::splat(f32::NAN), ..*sphere },
            3 => Sphere { radius: 1e30, ..*sphere },
            4 => Sphere { radius: -1.0, ..*sphere },
            5 => spheres[index - 1],
            _ if (20..20 + FEW).contains(&index) => spheres[20],
            even if even % 2 == 0 => Sphere { center: Vec3::new(y, 1.25 * x, z), ..*sphere },
            _ => *sphere,
        }
    };
    spheres.iter().enumerate().map(other).collect()
}
