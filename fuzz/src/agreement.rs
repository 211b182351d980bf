//! Every width against one lane, bit for bit; and the rules of the contract, on the answers of the
//! tier itself. These hold whatever bits come in, in the tier's domain or not.

use crate::geometry::Scene;
use crate::promise::Promise;
use spherule_kernel::{
    Exact, Fast, Hit, HitPacket, Lanes, Ray, RayPacket, Sphere, SpherePacket, Spheres, Stable, any,
    f32x4, f32x8, f32x16, nearest, nearest_hit, pairs, roots,
};

/// Judges everything that the kernel answers about a scene.
///
/// # Panics
/// Where an answer is wrong.
pub fn check(scene: &Scene) {
    tier::<Fast>(scene);
    tier::<Stable>(scene);
    tier::<Exact>(scene);
}

fn tier<A: Promise>(scene: &Scene) {
    let list = List::new(&scene.spheres);
    let single: Vec<_> =
        scene.rays.iter().map(|ray| nearest_hit::<A>(ray, list.spheres())).collect();
    for (ray, &hit) in scene.rays.iter().zip(&single) {
        rules::<A>(ray, &scene.spheres, hit);
    }
    for (ray, &aim) in scene.rays.iter().zip(&scene.aims) {
        let sphere = &scene.spheres[aim];
        A::judge(ray, sphere, roots::<A>(ray, sphere));
    }
    width::<A, f32>(scene, &list, &single);
    width::<A, f32x4>(scene, &list, &single);
    width::<A, f32x8>(scene, &list, &single);
    width::<A, f32x16>(scene, &list, &single);
}

/// Rules 1 and 3 to 5, on a one-lane answer.
fn rules<A: Promise>(ray: &Ray, spheres: &[Sphere], hit: Option<Hit>) {
    let accepted = |t: &f32| t.is_finite() && ray.t_min <= *t && *t <= ray.t_max;
    let mut expected: Option<Hit> = None;
    for (index, sphere) in spheres.iter().enumerate() {
        let both = roots::<A>(ray, sphere);
        // Rule 1: what is no sphere and what is no ray is never hit.
        let ray_is_valid = ray.origin.is_finite()
            && ray.direction.is_finite()
            && ray.direction.to_array() != [0.0; 3];
        assert!(both.is_none() || (ray_is_valid && sphere.is_valid()), "{ray:?} {sphere:?}");
        // Rules 3 and 4: the first accepted root. Rule 5: the smallest t, the lowest index.
        let Some(t) = both.and_then(|both| both.into_iter().find(accepted)) else { continue };
        if expected.is_none_or(|hit| t < hit.t) {
            expected = Some(Hit { t, sphere: index as u32 });
        }
    }
    assert_eq!(bits(hit), bits(expected), "{}: {hit:?}, rules {expected:?}: {ray:?}", A::NAME);

    // Rule 3: the interval is closed, so the t that was returned finds the same hit again.
    if let Some(Hit { t, .. }) = hit {
        assert!(!(t == 0.0 && t.is_sign_negative()), "-0: {ray:?}");
        let again = nearest_hit::<A>(&Ray { t_max: t, ..*ray }, List::new(spheres).spheres());
        assert_eq!(bits(again), bits(hit), "{}: {ray:?}", A::NAME);
    }
}

/// Lanes of `L` against one lane.
fn width<A: Promise, L: Lanes<Token = ()>>(scene: &Scene, list: &List, single: &[Option<Hit>]) {
    let packets: Vec<RayPacket<L>> = scene.rays.chunks(L::COUNT).map(RayPacket::<L>::new).collect();
    let mut hits = vec![HitPacket::<L>::none(); packets.len()];
    nearest::<A, L>((), &packets, list.spheres(), &mut hits);
    let mut met = vec![u32::MAX; packets.len()];
    any::<A, L>((), &packets, list.spheres(), &mut met);

    for index in 0..packets.len() * L::COUNT {
        let (packet, lane) = (index / L::COUNT, index % L::COUNT);
        let expected = single.get(index).copied().flatten();
        let say = || format!("{}, {} lanes, ray {index} of {scene:?}", A::NAME, L::COUNT);
        let hit = hits[packet].hit(lane);
        assert_eq!(bits(hit), bits(expected), "nearest: {}", say());
        assert_eq!(met[packet] >> lane & 1 == 1, expected.is_some(), "any: {}", say());
    }

    // Ray i and the sphere that it was made for.
    let aims: Vec<_> = scene.aims.iter().map(|&aim| scene.spheres[aim]).collect();
    let chunks = packets.iter().zip(scene.rays.chunks(L::COUNT).zip(aims.chunks(L::COUNT)));
    for (packet, (rays, aims)) in chunks {
        let hits = pairs::<A, L>((), packet, &SpherePacket::<L>::new(aims));
        for lane in 0..L::COUNT {
            let alone = rays
                .get(lane)
                .zip(aims.get(lane))
                .and_then(|(ray, sphere)| nearest_hit::<A>(ray, List::new(&[*sphere]).spheres()));
            let expected = alone.map(|hit| Hit { sphere: lane as u32, ..hit });
            assert_eq!(
                bits(hits.hit(lane)),
                bits(expected),
                "pairs: {}, {} lanes, lane {lane} of {rays:?} {aims:?}",
                A::NAME,
                L::COUNT
            );
        }
    }
}

fn bits(hit: Option<Hit>) -> Option<(u32, u32)> {
    hit.map(|hit| (hit.t.to_bits(), hit.sphere))
}

/// Spheres, coordinate by coordinate.
struct List([Vec<f32>; 4]);

impl List {
    fn new(spheres: &[Sphere]) -> Self {
        let of = |number: &dyn Fn(&Sphere) -> f32| spheres.iter().map(number).collect();
        let axis = |axis: usize| of(&|sphere| sphere.center[axis]);
        Self([axis(0), axis(1), axis(2), of(&|sphere| sphere.radius)])
    }

    fn spheres(&self) -> Spheres<'_> {
        let [x, y, z, r] = &self.0;
        Spheres::new(x, y, z, r).expect("equal lengths")
    }
}

/// Bytes for the tests, from xorshift.
#[cfg(test)]
pub(crate) fn random_bytes(seed: u64) -> Vec<u8> {
    let mut state = (seed + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let mut next = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 32) as u8
    };
    (0..700).map(|_| next()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn random_scenes_pass() {
        for seed in 0..500 {
            check(&Scene::from_bytes(&random_bytes(seed)));
        }
    }

    #[test]
    fn the_corpus_passes() {
        let corpus = concat!(env!("CARGO_MANIFEST_DIR"), "/corpus/packet_against_oracle");
        let mut files = 0;
        for entry in std::fs::read_dir(corpus).expect("the corpus is there") {
            let path = entry.expect("an entry").path();
            let bytes = std::fs::read(&path).expect("a file");
            println!("{}", path.display());
            check(&Scene::from_bytes(&bytes));
            files += 1;
        }
        assert!(files >= 20, "{files} files");
    }

    #[test]
    #[should_panic(expected = "rules")]
    fn a_hit_that_breaks_the_rules_is_seen() {
        let scene = Scene::from_bytes(&[]);
        rules::<Stable>(&scene.rays[0], &scene.spheres, Some(Hit { t: 1.0, sphere: 0 }));
    }
}
