//! Long calls, in which a tree finds out how the rays go best: as groups, streams, sorted rays, or ray by ray. Each way is taken up and
//! given up in the course of a call. The answers are those of ray by ray, which are those of brute force.

use super::scenes::{diffuse, uniform};
use spherule_kernel::{Level, Ray, SphereList, SphereTree, Tier, Trace, Vec3};
use spherule_tests::orders::Order;
use spherule_tests::scenes::{Scene, Size};
use spherule_tests::variants::{Layer, Structure, Variant, bits, levels};

/// Closest hits, and whether there is any hit.
type Answers = (Vec<Option<(u32, u32)>>, Vec<bool>);

/// Answers by `layer`. `trace` keeps what it learns.
fn ask(layer: Layer, tree: &SphereTree, trace: &mut Trace<'_>, rays: &[Ray]) -> Answers {
    let structure = Structure::Tree(trace.coherence);
    let answers = Variant { tier: Tier::Exact, structure, layer }.ask_tree(tree, trace, rays);
    (answers.hits.into_iter().map(bits).collect(), answers.occluded)
}

fn ray_by_ray(tree: &SphereTree, rays: &[Ray]) -> Answers {
    ask(Layer::SliceAt(Level::best().name()), tree, &mut Trace::new().incoherent(), rays)
}

/// # Panics
/// If a way differs from ray by ray.
fn check(name: &str, tree: &SphereTree, rays: &[Ray]) {
    let expected = ray_by_ray(tree, rays);
    for level in levels() {
        let name = format!("{name}, {} rays, {level:?}", rays.len());
        let (slices, packets) = (Layer::SliceAt(level.name()), Layer::Packets(level.name()));
        // The second time, the trace uses what it has learnt.
        let (mut of_slices, mut of_packets) = (Trace::new().at(level), Trace::new().at(level));
        for _ in 0..2 {
            assert!(ask(slices, tree, &mut of_slices, rays) == expected, "{name}: slices");
            assert!(ask(packets, tree, &mut of_packets, rays) == expected, "{name}: packets");
        }
        let coherent = &mut Trace::new().at(level).coherent();
        assert!(ask(slices, tree, coherent, rays) == expected, "{name}: said to be coherent");
        let trace = &mut Trace::new().at(level);
        assert!(ask(Layer::Columns, tree, trace, rays) == expected, "{name}: columns");
    }
}

#[test]
fn ways_that_are_taken_up_and_given_up() {
    let orders = [Order::Beam, Order::Diffuse, Order::TwoCameras, Order::Alternating16];
    for (name, most) in [("u10k", 3000), ("nested", 500), ("duplicates", 1500), ("u64", 64)] {
        let scene = Scene::large(name, Size(32, most)).expect("listed");
        let tree = scene.tree();
        for order in orders {
            for count in [1024, 1025, 5000] {
                let rays = order.rays(scene.spheres.spheres(), count, 1);
                check(&format!("{name}, {order:?}"), &tree, &rays);
            }
        }
    }
}

/// What a trace learns from some rays does not suit the rays that follow.
#[test]
fn rays_that_change_on_the_way() {
    let scene = Scene::large("u10k", Size(32, 3000)).expect("listed");
    let of = |order: Order| order.rays(scene.spheres.spheres(), 6000, 1);
    let orders = [Order::Diffuse, Order::ScanLines, Order::Beam, Order::Bursts64, Order::Diffuse];
    let rays: Vec<Ray> = orders.into_iter().flat_map(of).collect();
    check("orders one after the other", &scene.tree(), &rays);
}

/// One ray in sixteen is invalid: NaN, infinity, an empty interval, a zero direction.
#[test]
fn rays_of_which_some_are_none() {
    let scene = Scene::large("u10k", Size(32, 3000)).expect("listed");
    let mut rays = Order::Beam.rays(scene.spheres.spheres(), 9000, 1);
    for (number, ray) in rays.iter_mut().enumerate().filter(|(number, _)| number % 16 == 5) {
        match number / 16 % 5 {
            0 => ray.origin.x = f32::NAN,
            1 => ray.origin.y = f32::INFINITY,
            2 => (ray.t_min, ray.t_max) = (2.0, 1.0),
            3 => ray.direction = Vec3::ZERO,
            _ => ray.direction.z = f32::NEG_INFINITY,
        }
    }
    check("some are none", &scene.tree(), &rays);
}

/// A tree of up to four spheres is traced as a list; more spheres make a larger tree.
#[test]
fn very_few_spheres() {
    for count in 0..=6 {
        let mut list = uniform(count);
        // One sphere that no bound covers, and an invalid one.
        if count > 2 {
            list[1].radius = 1e30;
            list[2].center.x = f32::NAN;
        }
        let tree = SphereTree::new(SphereList::from(&list[..]));
        check(&format!("{count} spheres"), &tree, &diffuse(1500));
    }
}

/// A tree of more than 8 MB, and rays that are sorted by their origins.
#[test]
fn many_rays_in_a_large_tree() {
    let scene = Scene::large("u1m", Size(32, 400_000)).expect("listed");
    let tree = scene.tree();
    let rays = Order::Diffuse.rays(scene.spheres.spheres(), 40_000, 1);
    let expected = ray_by_ray(&tree, &rays);
    let best = Level::best().name();
    for layer in [Layer::SliceAt(best), Layer::Packets(best)] {
        assert!(ask(layer, &tree, &mut Trace::new(), &rays) == expected, "{layer:?}");
    }
}
