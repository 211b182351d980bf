//! A tree as data: the words of a tree answer as the list does, and any other words are an error.

use super::scenes::{EYE, camera, mixed, uniform, unit};
use proptest::prelude::*;
use spherule_kernel::{
    Bvh4, Bvh4Error, Hit, Intersect, Ray, Sphere, SphereList, Tier, TooSmall, Vec3,
};
use spherule_referee::random::Random;
use spherule_referee::strategies;
use spherule_tests::variants::bits;
use std::iter::repeat_with;

/// How many words precede the order.
const HEADER: usize = 5;

fn words_of(spheres: &[Sphere]) -> Vec<u32> {
    let mut words = vec![7; Bvh4::needed(spheres.len())];
    let list = SphereList::from(spheres);
    Bvh4::build(list.spheres(), &mut words).expect("enough memory").words().to_vec()
}

fn error_of(spheres: &[Sphere], words: &[u32]) -> Option<Bvh4Error> {
    Bvh4::load(SphereList::from(spheres).spheres(), words).err()
}

/// Spheres that bounds cover, some that bounds do not cover, and some invalid ones.
fn of_all_kinds() -> Vec<Sphere> {
    let mut spheres = uniform(37);
    spheres[3].radius = f32::NAN;
    spheres[11].center.y = f32::INFINITY;
    spheres[20] = Sphere { center: Vec3::new(0.0, -1e30, 0.0), radius: 1e30 };
    spheres[36] = Sphere { center: Vec3::splat(1e-30), radius: 1e-32 };
    spheres[30] = spheres[31];
    spheres
}

/// Asserts that every ray gets the list's answer.
fn assert_answers(spheres: &[Sphere], tree: &Bvh4<'_>, rays: &[Ray]) {
    let list = SphereList::from(spheres);
    for ray in rays {
        let (hit, expected) =
            (tree.closest_hit(Tier::Exact, ray), list.closest_hit(Tier::Exact, ray));
        assert_eq!(bits(hit), bits(expected), "{ray:?}");
        assert_eq!(tree.any_hit(Tier::Exact, ray), expected.is_some(), "{ray:?}");
    }
}

#[test]
fn what_was_built_is_loaded() {
    for count in [0, 1, 4, 5, 16, 17, 1000, 65_536] {
        let (spheres, rays) = (uniform(count), camera(EYE, Vec3::ZERO, 0.364, 8));
        let mut words = words_of(&spheres);
        assert_eq!(words.len(), Bvh4::needed(count));
        assert!(words.len() * 4 <= 12 * count + 700, "{count}: {} words", words.len());
        // Words behind the tree belong to no sphere.
        words.extend([u32::MAX; 3]);
        let list = SphereList::from(spheres.as_slice());
        let tree = Bvh4::load(list.spheres(), &words).expect("what was built");
        assert_eq!(tree.words(), &words[..words.len() - 3]);
        assert_eq!(tree.spheres().len(), count);
        assert_answers(&spheres, &tree, &rays);
    }
    let spheres = of_all_kinds();
    let (list, words) = (SphereList::from(spheres.as_slice()), words_of(&spheres));
    let tree = Bvh4::load(list.spheres(), &words).expect("what was built");
    assert_answers(&spheres, &tree, &mixed(200, 8));
}

#[test]
fn too_little_memory() {
    for count in [0, 1, 17, 1000] {
        let (list, needed) = (SphereList::from(uniform(count)), Bvh4::needed(count));
        let mut words = vec![0; needed];
        for given in [0, needed / 2, needed - 1] {
            let error = Bvh4::build(list.spheres(), &mut words[..given]).expect_err("too little");
            assert_eq!(error, TooSmall { what: "words", needed, given });
        }
        assert!(Bvh4::build(list.spheres(), &mut words).is_ok());
    }
    assert_eq!(Bvh4::needed(65_537), usize::MAX);
    let list = SphereList::from(vec![Sphere { center: Vec3::ZERO, radius: 1.0 }; 65_537]);
    assert!(Bvh4::build(list.spheres(), &mut [0; 1000]).is_err());
    assert_eq!(Bvh4::load(list.spheres(), &[0; 1000]).err(), Some(Bvh4Error::Mark));
}

/// Every bit of a tree counts.
#[test]
fn another_bit_is_another_tree() {
    let mut seen = Vec::new();
    // Of one kind alone, whose number another number may exceed, and of all.
    for spheres in [uniform(40), of_all_kinds()] {
        let words = words_of(&spheres);
        assert_eq!(error_of(&spheres, &words), None);
        for word in 0..words.len() {
            for bit in 0..32 {
                let mut words = words.clone();
                words[word] ^= 1 << bit;
                let error = error_of(&spheres, &words);
                assert!(error.is_some(), "bit {bit} of word {word}");
                seen.extend(error);
            }
        }
    }
    for error in
        [Bvh4Error::Mark, Bvh4Error::Count, Bvh4Error::Scale, Bvh4Error::Order, Bvh4Error::Box]
    {
        assert!(seen.contains(&error), "{error}");
    }
    let spheres = of_all_kinds();
    let words = words_of(&spheres);
    for length in 0..words.len() {
        let error = error_of(&spheres, &words[..length]);
        assert_eq!(error, Some(Bvh4Error::Length), "{length} words of {}", words.len());
    }
}

/// A file that was written in another order of bytes is no tree.
#[test]
fn in_another_order_of_bytes() {
    let spheres = of_all_kinds();
    let words = words_of(&spheres);
    let bytes: Vec<u8> = words.iter().copied().flat_map(u32::to_le_bytes).collect();
    let read = |word: fn([u8; 4]) -> u32| -> Vec<u32> {
        bytes.as_chunks::<4>().0.iter().copied().map(word).collect()
    };
    assert_eq!(error_of(&spheres, &read(u32::from_le_bytes)), None);
    assert_eq!(error_of(&spheres, &read(u32::from_be_bytes)), Some(Bvh4Error::Mark));
}

/// A tree over other spheres is an error.
#[test]
fn of_other_spheres() {
    let spheres = of_all_kinds();
    let words = words_of(&spheres);
    let other = |change: &dyn Fn(&mut Vec<Sphere>)| {
        let mut spheres = spheres.clone();
        change(&mut spheres);
        error_of(&spheres, &words)
    };
    assert_eq!(other(&|_| ()), None);
    assert_eq!(other(&|spheres| spheres.truncate(36)), Some(Bvh4Error::Count));
    assert_eq!(other(&|spheres| spheres[5].center.x += 1.0), Some(Bvh4Error::Box));
    assert_eq!(other(&|spheres| spheres[5].radius *= 2.0), Some(Bvh4Error::Box));
    assert_eq!(other(&|spheres| spheres[5].radius = -1.0), Some(Bvh4Error::Order));
    assert_eq!(other(&|spheres| spheres[3].radius = 0.0), Some(Bvh4Error::Order));
    assert_eq!(other(&|spheres| spheres[20] = spheres[5]), Some(Bvh4Error::Order));
}

/// Two equal spheres: if the tree holds one of them twice, every box is right, but the other sphere
/// is lost.
#[test]
fn a_lost_sphere_is_seen() {
    let spheres = of_all_kinds();
    let words = words_of(&spheres);
    let order = HEADER..HEADER + spheres.len();
    for (kept, lost) in [(30, 31), (31, 30)] {
        let mut words = words.clone();
        let place = words[order.clone()].iter().position(|&word| word & 0xffff == lost);
        let word = &mut words[HEADER + place.expect("each is there once")];
        *word = *word & 0xffff_0000 | kept;
        assert_eq!(error_of(&spheres, &words), Some(Bvh4Error::Order));
        // Changes its place, too.
        words[HEADER + lost as usize] =
            words[HEADER + lost as usize] & 0xffff | words[HEADER + kept as usize] & 0xffff_0000;
        assert_eq!(error_of(&spheres, &words), Some(Bvh4Error::Order));
    }
    // The control: with the two swapped, the words are still a tree.
    let mut words = words;
    let place = |words: &[u32], index: usize| words[HEADER + index] >> 16;
    let (first, second) = (place(&words, 30), place(&words, 31));
    for (index, place) in [(30, second), (31, first)] {
        words[HEADER + index] = words[HEADER + index] & 0xffff | place << 16;
        let word = &mut words[HEADER + place as usize];
        *word = *word & 0xffff_0000 | index as u32;
    }
    assert_eq!(error_of(&spheres, &words), None);
    let list = SphereList::from(spheres.as_slice());
    let tree = Bvh4::load(list.spheres(), &words).expect("a tree");
    // Of equal spheres the first is the hit, wherever they lie in the tree.
    let mut random = Random::new(111, 0);
    let from = || Ray::new(spheres[30].center, unit(&mut random));
    let rays: Vec<Ray> = repeat_with(from).take(50).collect();
    let of_both = |hit: &Hit| hit.sphere == 30 || hit.sphere == 31;
    let hits = rays.iter().filter_map(|ray| tree.closest_hit(Tier::Stable, ray)).filter(of_both);
    let hits: Vec<u32> = hits.map(|hit| hit.sphere).collect();
    assert!(hits.len() > 10 && hits.iter().all(|&sphere| sphere == 30), "{hits:?}");
}

proptest! {
    #![proptest_config(strategies::config(300))]

    /// Any words give an error, or a tree that answers as the list does.
    #[test]
    fn any_words(
        seed in any::<u64>(),
        count in 0_usize..60,
        changes in 0_usize..8,
        random_from in prop_oneof![Just(usize::MAX), 0_usize..200],
    ) {
        let mut random = Random::new(110, seed);
        let mut spheres = uniform(count);
        for sphere in &mut spheres {
            if random.one_in(6) {
                sphere.radius = random.pick(&[f32::NAN, -1.0, 0.0, 1e30, 1e-40]);
            }
        }
        let mut words = words_of(&spheres);
        for _ in 0..changes {
            let place = random.integer(0, words.len() as i64 - 1) as usize;
            words[place] = match random.integer(0, 3) {
                0 => random.bits() as u32,
                1 => words[random.integer(0, words.len() as i64 - 1) as usize],
                2 => words[place].wrapping_add(random.integer(-2, 2) as u32),
                _ => words[place] ^ 1 << random.integer(0, 31),
            };
        }
        // The words begin as a tree and continue at random.
        for word in words.iter_mut().skip(random_from.max(1)) {
            *word = random.bits() as u32;
        }
        let list = SphereList::from(spheres.as_slice());
        if let Ok(tree) = Bvh4::load(list.spheres(), &words) {
            assert_answers(&spheres, &tree, &mixed(10, 4));
        }
    }
}
