//! Light that goes with the eye: a molecule is as clear from behind as from the front.

use spherule::color::{Srgb, oklab};
use spherule::picture::Picture;
use spherule::scene::builtin::builtin;
use spherule::scene::{Light, Lighting, Scene, Source};
use spherule::shade::Shader;
use spherule::structure::Structure;
use spherule::structure::picture_search::{PictureSearch, Setting};
use spherule::structure::search::{Scratch, Search, Tracing};
use spherule::threads::Threads;
use spherule::view::View;
use spherule_kernel::{Camera, Coherence, HitPacket, Level, RayPacket, Tier, Vec3};
use std::collections::BTreeMap;

/// Pixels across and down, a ray each.
const SIDE: u32 = 40;

/// The pixels that show a sphere: which one, and in which colour.
fn sphere_pixels(scene: &Scene, view: &View) -> Vec<(u32, Srgb)> {
    let (lights, camera) = (scene.lighting.lights(view), Search::Brute(scene.spheres()));
    let search = PictureSearch {
        structure: Structure::Brute,
        coherence: Coherence::Coherent,
        camera,
        to_lights: vec![camera; lights.len()],
        lights,
        setting: Setting::default(),
    };
    let tracing =
        Tracing { tier: Tier::Exact, level: Level::best(), coherence: Coherence::Coherent };
    let camera = view.camera(SIDE, SIDE, 1.0);
    let corners = Camera::tile_corners::<[f32; 16]>(SIDE, SIDE);
    let rays: Vec<RayPacket> = corners.map(|(x, y)| camera.packet(x, y, SIDE, SIDE)).collect();
    let (mut hits, mut scratch) = (vec![HitPacket::none(); rays.len()], Scratch::default());
    search.camera.closest_hits(tracing, &mut scratch, &rays, &mut hits);

    let (mut shader, mut picture, mut met) = (Shader::default(), Picture::default(), Vec::new());
    picture.reset(rays.len() * RayPacket::COUNT);
    for (packet, hits) in hits.iter().enumerate() {
        shader.begin_packet();
        for (lane, hit) in hits.hits().enumerate() {
            let Some(hit) = hit else { continue };
            let pixel = packet * RayPacket::COUNT + lane;
            let color = scene.colors()[hit.sphere as usize].to_linear();
            shader.add(scene, &mut picture, lane, pixel as u32, color);
            met.push((hit.sphere, pixel));
        }
    }
    let (threads, hits) = (Threads::default(), (&*rays, &*hits));
    shader.light(tracing, (&mut scratch, &threads), scene, &search, hits, &mut picture);
    let color = |(sphere, pixel)| (sphere, Srgb::from_linear(picture.pixels()[pixel]));
    met.into_iter().map(color).collect()
}

/// What a view looks like.
struct Look {
    /// The mean lightness of what is seen of the spheres.
    lightness: f32,
    /// The share of the spheres' pixels with a channel at its end.
    clipped: f32,
    /// How far lightness varies on a sphere, as the mean of the larger ones.
    relief: f32,
}

fn look(scene: &Scene, view: &View) -> Look {
    let pixels = sphere_pixels(scene, view);
    let lightness = |color: Srgb| oklab(color.to_linear()).x;
    let mut spheres = BTreeMap::<u32, Vec<f32>>::new();
    for &(sphere, color) in &pixels {
        spheres.entry(sphere).or_default().push(lightness(color));
    }
    let large = spheres.values().filter(|values| values.len() >= 20);
    let reliefs: Vec<f32> = large
        .map(|values| {
            let most = values.iter().copied().fold(0.0, f32::max);
            most - values.iter().copied().fold(1.0, f32::min)
        })
        .collect();
    let count = pixels.len() as f32;
    assert!(count > 100.0 && reliefs.len() > 2, "{view:?}");
    let clipped = pixels.iter().filter(|(_, color)| color.0.contains(&255)).count();
    Look {
        lightness: spheres.values().flatten().sum::<f32>() / count,
        clipped: clipped as f32 / count,
        relief: reliefs.iter().sum::<f32>() / reliefs.len() as f32,
    }
}

/// From all around, every ten degrees, as far from the molecule as at first.
fn around(scene: &Scene) -> impl Iterator<Item = View> {
    let first = scene.first_view(1.0);
    let distance = first.eye.distance(first.target);
    (0..36).flat_map(move |azimuth| {
        (-8..=8).map(move |elevation| {
            let [azimuth, elevation] =
                [azimuth, elevation].map(|tens| f32::to_radians(tens as f32 * 10.0));
            let (height, across) = elevation.sin_cos();
            let way = Vec3::new(across * azimuth.sin(), height, across * azimuth.cos());
            View { eye: first.target + distance * way, ..first }
        })
    })
}

/// The least lightness beside that of the front, the largest share that is clipped, the least relief.
fn worst(scene: &Scene) -> (f32, f32, f32) {
    let front = look(scene, &scene.first_view(1.0)).lightness;
    around(scene).fold((1.0, 0.0, 1.0), |(lightness, clipped, relief), view| {
        let look = look(scene, &view);
        let least = f32::min(lightness, look.lightness / front);
        (least, f32::max(clipped, look.clipped), f32::min(relief, look.relief))
    })
}

#[test]
fn caffeine_is_clear_from_every_side() {
    let caffeine = builtin("caffeine").expect("caffeine");
    let (lightness, clipped, relief) = worst(&caffeine);
    println!("lightness {lightness}, clipped {clipped}, relief {relief}");
    assert!(lightness >= 0.6, "{lightness} of the front's lightness");
    assert!(clipped <= 0.02, "{clipped} of the pixels");
    assert!(relief >= 0.2, "flat: {relief}");
}

/// The control: each of the three can be missed.
#[test]
fn other_light_leaves_a_molecule_dark_or_burnt_or_flat() {
    let mut caffeine = builtin("caffeine").expect("caffeine");
    let from = |direction| Light { source: Source::Direction(direction), color: Srgb::WHITE };
    let front = caffeine.first_view(1.0);
    caffeine.lighting = Lighting::World(vec![from(front.eye - front.target); 2]);
    let (lightness, clipped, _) = worst(&caffeine);
    assert!(lightness < 0.6 && clipped > 0.02, "{lightness}, {clipped}");
    caffeine.lighting = Lighting::Plain;
    assert!(worst(&caffeine).2 < 0.01);
}
