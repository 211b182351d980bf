//! A camera's tiles, at every layer and in every structure that makes their rays itself.

use super::answers::Answers;
use super::difference::bits;
use super::memory::{Memory, Structures};
use super::packing::{level, stale_packet};
use super::table::{Layer, brute, packet_layers};
use spherule_kernel::{
    Camera, CameraTiles, DepthList, Hit, HitPacket, Intersect, LaneArray, Lanes, Projection, Ray,
    RayPacket, Sphere, Tier, Trace, Vec3, Viewpoint, f32x4, f32x8, f32x16,
};
use spherule_referee::case::HexRay;

/// A camera's picture, from some pixel on.
#[derive(Clone, Copy, Debug)]
pub struct Frame {
    /// The camera.
    pub camera: Camera,
    /// The first pixel that is looked at, and how many across and down.
    pub from: (u32, u32),
    /// How many, across and down.
    pub count: (u32, u32),
    /// The picture's width and height.
    pub size: (u32, u32),
}

impl Frame {
    /// The first pixels of its tiles.
    fn corners<A: LaneArray>(&self) -> Vec<(u32, u32)> {
        Camera::tile_corners::<A>(self.count.0, self.count.1)
            .map(|(x, y)| (self.from.0.saturating_add(x), self.from.1.saturating_add(y)))
            .collect()
    }

    /// The origin or direction that all rays share.
    fn viewpoint(&self) -> Viewpoint {
        match self.camera.projection {
            Projection::Perspective { eye } => Viewpoint::Origin(eye),
            Projection::Parallel { direction } => Viewpoint::Direction(direction),
        }
    }
}

/// Asserts that tiles of a frame are answered, bit for bit, as brute force answers the rays of their pixels, and that these rays are left.
/// Asks `tiers` that promise the same bits, in every structure. As in the table of variants, lists have every width, the larger structures
/// two.
///
/// # Panics
/// If there is a difference.
#[track_caller]
pub fn assert_same_tiles(tiers: &[Tier], frame: &Frame, spheres: &[Sphere]) {
    let difference = Memory::new(spheres).sorted(frame.viewpoint(), |structures| {
        tiers.iter().find_map(|&tier| {
            packet_layers(None).find_map(|layer| {
                let question = Question { tier, layer, frame, structures };
                match layer {
                    Layer::Lanes(1) => question.different::<f32>(every_structure::<f32>),
                    Layer::Lanes(4) => question.different::<f32x4>(list_alone::<f32x4>),
                    Layer::Lanes(8) => question.different::<f32x8>(every_structure::<f32x8>),
                    Layer::Lanes(_) => question.different::<f32x16>(list_alone::<f32x16>),
                    _ => question.different::<f32x16>(every_structure_at_a_level),
                }
            })
        })
    });
    if let Some(difference) = difference {
        panic!("{difference}");
    }
}

/// The rays that were made, and what they hit, lane by lane.
type Traced = (Vec<Ray>, Vec<Option<Hit>>);

/// How the structures answer, each with its name.
type Ways = fn(&Question<'_>, CameraTiles<'_>) -> Vec<(&'static str, Traced)>;

struct Question<'a> {
    tier: Tier,
    layer: Layer,
    frame: &'a Frame,
    structures: Structures<'a>,
}

impl Question<'_> {
    fn different<L: Lanes<Token = ()>>(&self, ways: Ways) -> Option<String> {
        let Self { tier, layer, frame, structures } = *self;
        let corners = frame.corners::<L::Array>();
        let (width, height) = frame.size;
        let (tile_width, _) = Camera::tile::<L::Array>();
        // The expected answers, pixel by pixel.
        let pixel = |(x, y): (u32, u32), lane: u32| {
            let (x, y) = (x.checked_add(lane % tile_width)?, y.checked_add(lane / tile_width)?);
            (x < width && y < height).then(|| frame.camera.get_ray(x, y))
        };
        let lanes = |&corner: &(u32, u32)| {
            (0..L::COUNT as u32).map(move |lane| pixel(corner, lane).unwrap_or(Ray::INACTIVE))
        };
        let rays: Vec<Ray> = corners.iter().flat_map(lanes).collect();
        let Answers { hits: expected, .. } = brute(tier).ask(structures, &rays);

        let tiles = CameraTiles { camera: frame.camera, size: frame.size, corners: &corners };
        for (name, (made, hits)) in ways(self, tiles) {
            for (index, ray) in rays.iter().enumerate() {
                let (made, hit, expected) = (made[index], hits[index], expected[index]);
                if !same_but_for_nan(&made, ray) {
                    return Some(format!(
                        "{layer:?}, ray {index}: {made:?} and not {ray:?}, {frame:?}"
                    ));
                }
                if bits(hit) != bits(expected) {
                    return Some(format!(
                        "{tier:?} by {name}, {layer:?}, ray {index} of {}: {hit:?} and not {expected:?}; \
                         {}; {frame:?}",
                        rays.len(),
                        HexRay(ray)
                    ));
                }
            }
        }
        None
    }
}

fn list_alone<L: Lanes<Token = ()>>(
    question: &Question<'_>,
    tiles: CameraTiles<'_>,
) -> Vec<(&'static str, Traced)> {
    let Question { tier, structures, .. } = *question;
    vec![("list", in_lanes::<_, L>(tier, structures.list, Trace::new(), tiles))]
}

fn every_structure<L: Lanes<Token = ()>>(
    question: &Question<'_>,
    tiles: CameraTiles<'_>,
) -> Vec<(&'static str, Traced)> {
    let Question { tier, structures: Structures { list, depth_list, tree, .. }, .. } = *question;
    let mut scratch = vec![f32::NAN; DepthList::scratch(list.spheres().len())];
    let with_scratch = Trace::new().with_scratch(&mut scratch);
    vec![
        ("list", in_lanes::<_, L>(tier, list, Trace::new(), tiles)),
        ("depth list", in_lanes::<_, L>(tier, depth_list, with_scratch, tiles)),
        ("tree", in_lanes::<_, L>(tier, tree, Trace::new().coherent(), tiles)),
        ("tree, detected", in_lanes::<_, L>(tier, tree, Trace::new(), tiles)),
        ("tree, ray by ray", in_lanes::<_, L>(tier, tree, Trace::new().incoherent(), tiles)),
    ]
}

fn every_structure_at_a_level(
    question: &Question<'_>,
    tiles: CameraTiles<'_>,
) -> Vec<(&'static str, Traced)> {
    let Structures { list, depth_list, tree, .. } = question.structures;
    let mut scratch = vec![f32::NAN; DepthList::scratch(list.spheres().len())];
    let with_scratch = Trace::new().with_scratch(&mut scratch);
    vec![
        ("list", at_a_level(question, list, Trace::new(), tiles)),
        ("depth list", at_a_level(question, depth_list, with_scratch, tiles)),
        ("tree", at_a_level(question, tree, Trace::new().coherent(), tiles)),
        ("tree, detected", at_a_level(question, tree, Trace::new(), tiles)),
        ("tree, ray by ray", at_a_level(question, tree, Trace::new().incoherent(), tiles)),
    ]
}

/// Compares bit for bit, except that every NaN equals every other: an operation on two NaN may return either.
fn same_but_for_nan(a: &Ray, b: &Ray) -> bool {
    let bits = |ray: &Ray| {
        let [o, d] = [ray.origin, ray.direction].map(|vector| vector.to_array());
        let numbers = [o[0], o[1], o[2], d[0], d[1], d[2], ray.t_min, ray.t_max];
        numbers.map(|x| if x.is_nan() { f32::NAN.to_bits() } else { x.to_bits() })
    };
    bits(a) == bits(b)
}

fn in_lanes<S: Intersect, L: Lanes<Token = ()>>(
    tier: Tier,
    structure: &S,
    mut trace: Trace<'_>,
    tiles: CameraTiles<'_>,
) -> Traced {
    let (mut rays, mut hits) = stale::<L>(tiles.corners.len());
    structure.closest_hit_tile_lanes::<L>(tier, (), &mut trace, tiles, &mut rays, &mut hits);
    lane_by_lane::<L>(&rays, &hits)
}

fn at_a_level<S: Intersect>(
    question: &Question<'_>,
    structure: &S,
    mut trace: Trace<'_>,
    tiles: CameraTiles<'_>,
) -> Traced {
    let Layer::Packets(name) = question.layer else { unreachable!("lanes of the caller's") };
    trace.level = level(name);
    let (mut rays, mut hits) = stale::<f32x16>(tiles.corners.len());
    structure.closest_hit_tiles(question.tier, &mut trace, tiles, &mut rays, &mut hits);
    lane_by_lane::<f32x16>(&rays, &hits)
}

type Packets<L> = (Vec<RayPacket<<L as Lanes>::Array>>, Vec<HitPacket<<L as Lanes>::Array>>);

/// Old contents must not show; one packet more must be left alone.
fn stale<L: Lanes<Token = ()>>(count: usize) -> Packets<L> {
    let ray = Ray::new(Vec3::new(0.0, 0.0, -3.0), Vec3::Z);
    (vec![RayPacket::new(&[ray; 16]); count + 1], vec![stale_packet::<L>(); count + 1])
}

fn lane_by_lane<L: Lanes<Token = ()>>(
    rays: &[RayPacket<L::Array>],
    hits: &[HitPacket<L::Array>],
) -> Traced {
    let past = stale::<L>(0);
    assert!(rays.last() == past.0.last() && hits.last() == past.1.last(), "past the tiles");
    let rays = rays.iter().flat_map(|packet| (0..L::COUNT).map(|lane| packet.ray(lane)));
    (rays.collect(), hits.iter().flat_map(HitPacket::hits).collect())
}
