//! How spheres and rays are given: lists and trees made of anything that becomes a sphere, lists whose spheres move, columns and their
//! parts.

use spherule_kernel::{RayColumns, Sphere, SphereList, SphereTree, Spheres, Vec4};

const ROWS: [[f32; 4]; 3] = [[0.0, 1.0, 2.0, 3.0], [4.0, 5.0, 6.0, 7.0], [8.0, -0.0, 1e38, 0.5]];

#[test]
fn columns_of_unequal_length() {
    let (one, two) = ([1.0], [1.0, 2.0]);
    for (x, y, z, r) in [
        (&two[..], &one[..], &one[..], &one[..]),
        (&one, &two, &one, &one),
        (&one, &one, &two, &one),
        (&one, &one, &one, &two),
        (&one, &one, &one, &[]),
    ] {
        assert!(Spheres::new(x, y, z, r).is_err());
    }
    assert!(Spheres::new(&one, &one, &one, &one).is_ok());
}

/// However spheres are given, they make the same list.
#[test]
fn lists_from_everything() {
    let rows = [ROWS[0], ROWS[1], [f32::NAN, -0.0, 1e38, -1.0]];
    let spheres = rows.map(Sphere::from);
    let bits = |list: SphereList| -> Vec<[u32; 4]> {
        let bits = |s: Sphere| [s.center.x, s.center.y, s.center.z, s.radius].map(f32::to_bits);
        list.spheres().iter().map(bits).collect()
    };
    let expected: Vec<_> = rows.iter().map(|row| row.map(f32::to_bits)).collect();
    for list in [
        SphereList::from(&spheres[..]),
        SphereList::from(&spheres),
        SphereList::from(spheres.to_vec()),
        SphereList::from(&rows[..]),
        SphereList::from(&rows),
        SphereList::from(rows),
        SphereList::from(&SphereList::from(rows)),
        SphereList::from(SphereList::from(rows).spheres()),
        spheres.into_iter().collect(),
        rows.into_iter().collect(),
        rows.map(Vec4::from_array).into_iter().collect(),
        spheres.map(|sphere| (sphere.center, sphere.radius)).into_iter().collect(),
    ] {
        assert_eq!(bits(list), expected);
    }
}

/// Trees are made of arrays and lists that stay with the caller, and refitted to them.
#[test]
fn trees_from_what_is_lent() {
    // By names: clippy knows that the arrays could be given as well.
    let (rows, moved, fewer) =
        (&ROWS, &ROWS.map(|[x, y, z, r]| [x + 1.0, y, z, r]), &[ROWS[0], ROWS[1]]);
    let list = SphereList::from(rows);
    for mut tree in [SphereTree::new(rows), SphereTree::new(&list)] {
        assert_eq!(tree.list(), &list);
        tree.refit(moved).expect("as many");
        assert_eq!(tree.list(), &SphereList::from(moved));
        tree.refit(&list).expect("as many");
        assert_eq!(tree.list(), &list);
        assert!(tree.refit(fewer).is_err());
        assert_eq!(tree.list(), &list);
    }
}

/// Spheres of a list move one by one, or all are given anew.
#[test]
fn lists_follow_their_spheres() {
    let moved = ROWS.map(|[x, y, z, r]| [x + 0.5, y, z - 1.0, r]);
    let (mut list, expected) = (SphereList::from(ROWS), SphereList::from(moved));
    assert!((0..3).all(|index| list.set(index, moved[index])));
    assert_eq!(list, expected);
    assert!(!list.set(3, ROWS[0]) && !list.set(usize::MAX, ROWS[0]));
    assert_eq!(list, expected);
    list.clear();
    assert!(list.is_empty() && list.spheres().is_empty() && !list.set(0, ROWS[0]));
    list.extend(ROWS);
    assert_eq!(list, SphereList::from(ROWS));
}

/// Parts of columns of unequal length are together the whole.
#[test]
fn parts_of_columns_are_the_whole() {
    let table: [Vec<f32>; 8] = std::array::from_fn(|column| {
        (0..57 - column).map(|row| (100 * column + row) as f32).collect()
    });
    let [ox, oy, oz, dx, dy, dz, t_min, t_max] = table.each_ref().map(Vec::as_slice);
    let rays = RayColumns { origin: [ox, oy, oz], direction: [dx, dy, dz], t_min, t_max };
    assert_eq!(rays.len(), 50);
    for piece in [1, 7, 16, 49, 50, 60] {
        let mut together = Vec::new();
        for first in (0..70).step_by(piece) {
            let part = rays.part(first..first + piece);
            assert_eq!(part.len(), 50_usize.saturating_sub(first).min(piece));
            assert_eq!(part.ray(part.len()), None);
            together.extend((0..part.len()).map(|index| part.ray(index)));
        }
        let whole: Vec<_> = (0..50).map(|index| rays.ray(index)).collect();
        assert_eq!(together, whole, "pieces of {piece}");
    }
    assert_eq!(rays.part(0..usize::MAX).len(), 50);
}
