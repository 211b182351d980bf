//! Whether the colours of two neighbouring pixels tell that they lie on different chains or at different depths.
//!
//! ```sh
//! cargo run --release -p spherule --example legibility -- 6WG6.cif 7CFN.cif                   # as they are shown
//! cargo run --release -p spherule --example legibility -- 6WG6.cif --- --occlusion=off        # with options
//! ```
//!
//! The files must have chains. Two packages of Python's index contain such proteins: `pip download --no-deps
//! --no-binary biopython biopython` brings 6WG6, 7CFN, 2XHE and 2BEG in `Tests/PDB`, `pip download --no-deps
//! MDAnalysisTests` brings 1A28 and 19HC.
//!
//! The picture is the one of `--once --charset half --color truecolor`, 120x40 cells unless `--size` says otherwise. A
//! pixel is half a cell. The truth is what the kernel alone finds on the ray through its middle. Two neighbours, side
//! by side or one above the other, that both show a sphere are *apart* if the spheres are of different chains, or their
//! depths differ by more than both spheres are thick. The score of a pair is the distance of its colours in `OKLab`;
//! the figure is the area under the curve of hits against false alarms (AUC): how often the colours of a pair that is
//! apart differ more than those of a pair that is not. By chance it is 0.5.

use spherule::arguments::{Arguments, Request, parse};
use spherule::cells::{CellGrid, Color};
use spherule::color::{Srgb, oklab};
use spherule::coloring::coloring;
use spherule::coloring::seen::Seen;
use spherule::draw::{Renderer, Spending, picture_workload};
use spherule::scene::Scene;
use spherule::scene::attributes::Naming;
use spherule::structure::scene::SceneStructures;
use spherule::style::{Charset, ColorDepth, Style};
use spherule::threads::Threads;
use spherule::view::View;
use spherule_kernel::{
    Exact, HitPacket, Intersect, Level, RayPacket, SphereList, SphereTree, Trace, Vec3,
};
use std::error::Error;

const SIZE: (u16, u16) = (120, 40);

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let mut parts = arguments.split(|argument| argument == "---");
    let (files, options) = (parts.next().unwrap_or_default(), parts.next().unwrap_or_default());
    println!("{:<24}{:>8}{:>8}{:>8}{:>8}", "file", "atoms", "pairs", "apart", "AUC");
    for file in files {
        let words =
            ["spherule", file].into_iter().map(str::to_owned).chain(options.iter().cloned());
        let request = parse(words.map(Into::into)).map_err(|error| format!("{error:?}"))?;
        let Request::Run(arguments) = request else { return Err("no picture".into()) };
        let Legibility { atoms, pairs, apart, auc } = legibility(&arguments)?;
        let name = file.rsplit('/').next().unwrap_or(file);
        println!("{name:<24}{atoms:>8}{pairs:>8}{apart:>8}{auc:>8.3}");
    }
    Ok(())
}

struct Legibility {
    atoms: usize,
    pairs: usize,
    apart: usize,
    auc: f64,
}

fn legibility(arguments: &Arguments) -> Result<Legibility, Box<dyn Error>> {
    let said = |error: spherule::error::Error| format!("{error:?}");
    let picture = &arguments.picture;
    let mut scene = picture.scene.open().map_err(said)?.scene;
    let by = picture.crowd.color_by(&scene);
    let colored = coloring(&scene, &by, picture.crowd.range, &mut Seen::default())?;
    if let Some(colors) = colored.colors {
        scene.set_colors(colors);
    }
    let size = picture.scene.size.unwrap_or(SIZE);
    let style = Style {
        charset: Charset::Half,
        depth: ColorDepth::Truecolor,
        samples: picture.scene.samples,
        aids: picture.crowd.aids(&scene),
        ..Style::PLAIN
    };
    let view = picture.scene.view(&scene, style.picture_aspect(size.0, size.1));
    let threads = Threads::new(None).map_err(said)?;
    let mut structures = SceneStructures::new(scene.list(), &threads);
    structures.set_aids(style.aids);
    let count = scene.spheres().len();
    let workload = picture_workload(count, &style, size.0, size.1, 1.0);
    let search = structures.picture(None, &workload, &view, &scene).map_err(said)?;
    let mut renderer = Renderer::new(Level::best(), &threads);
    let drawn = renderer.draw(&scene, &search, &view, &style, size, Spending::ByNeed);

    let looks = looks(&drawn.cells);
    let truth = truth(&scene, &view, &style, size);
    let (width, height) = (usize::from(size.0), 2 * usize::from(size.1));
    let (mut together, mut apart) = (Vec::new(), Vec::new());
    for y in 0..height {
        for x in 0..width {
            let here = y * width + x;
            let right = (x + 1 < width).then_some(here + 1);
            let below = (y + 1 < height).then_some(here + width);
            for other in [right, below].into_iter().flatten() {
                if let (Some(one), Some(two)) = (truth[here], truth[other]) {
                    let distance = looks[here].distance(looks[other]);
                    let is_apart = one.chain != two.chain
                        || (one.depth - two.depth).abs() > 2.0 * (one.radius + two.radius);
                    if is_apart { apart.push(distance) } else { together.push(distance) }
                }
            }
        }
    }
    let (pairs, auc) = (together.len() + apart.len(), area(&mut together, &apart));
    Ok(Legibility { atoms: count, pairs, apart: apart.len(), auc })
}

/// How the halves of cells look, row by row.
fn looks(cells: &CellGrid) -> Vec<Vec3> {
    let light = |color| match color {
        Color::Rgb(rgb) => Srgb(rgb).to_linear(),
        Color::Default | Color::Ansi16(_) | Color::Ansi256(_) => Vec3::ZERO,
    };
    let mut looks = Vec::new();
    for row in cells.cells().chunks(cells.columns().max(1).into()) {
        for is_lower in [false, true] {
            looks.extend(row.iter().map(|cell| {
                let (ink, paper) = (light(cell.foreground), light(cell.background));
                oklab(match (cell.glyph, is_lower) {
                    ('\u{2580}', false) | ('\u{2588}', _) => ink,
                    ('\u{258c}', _) => (ink + paper) / 2.0,
                    _ => paper,
                })
            }));
        }
    }
    looks
}

/// What a pixel shows.
#[derive(Clone, Copy)]
struct Shown {
    chain: u32,
    depth: f32,
    radius: f32,
}

/// What the rays through the middles of the halves of cells meet, row by row.
fn truth(
    scene: &Scene,
    view: &View,
    style: &Style,
    (columns, rows): (u16, u16),
) -> Vec<Option<Shown>> {
    let (width, height) = (u32::from(columns), 2 * u32::from(rows));
    let camera = view.camera(width, height, style.picture_aspect(columns, rows));
    let rays: Vec<_> =
        (0..width * height).map(|at| camera.get_ray(at % width, at / width)).collect();
    let packets: Vec<_> = rays.chunks(RayPacket::COUNT).map(RayPacket::<[f32; 16]>::new).collect();
    let mut hits = vec![HitPacket::none(); packets.len()];
    let tree = SphereTree::new(scene.spheres().iter().collect::<SphereList>());
    tree.closest_hit_packets(Exact, &mut Trace::new(), &packets, &mut hits);
    let chains = scene.attributes().names(Naming::Chain);
    let shown = |index: usize, depth| {
        let chain = chains.and_then(|names| names.indices().get(index).copied()).unwrap_or(0);
        Some(Shown { chain, depth, radius: scene.spheres().get(index)?.radius })
    };
    let all = hits.iter().flat_map(HitPacket::hits);
    all.take(rays.len()).map(|hit| hit.and_then(|hit| shown(hit.sphere as usize, hit.t))).collect()
}

/// How often a value of `apart` is greater than one of `together`; equal values count half.
fn area(together: &mut [f32], apart: &[f32]) -> f64 {
    together.sort_unstable_by(f32::total_cmp);
    let below = |distance: f32| {
        let less = together.partition_point(|&other| other < distance);
        let no_more = together.partition_point(|&other| other <= distance);
        (less + no_more) as f64 / 2.0
    };
    let sum: f64 = apart.iter().map(|&distance| below(distance)).sum();
    sum / (together.len() as f64 * apart.len() as f64)
}
