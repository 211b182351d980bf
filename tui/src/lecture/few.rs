//! A few spheres before a camera of few pixels: the picture that the stations of both orders make.

use super::canvas::letter;
use super::pixels::Pixel;
use crate::structure::object_order::{Counts, ObjectOrder, Raster};
use crate::structure::screen::Screen;
use crate::structure::search::Tracing;
use crate::view::{Lens, View};
use spherule_kernel::{
    Camera, ClosestHit, Coherence, Exact, Hit, HitPacket, Intersect, Level, Ray, RayPacket,
    SphereList, Tier, Vec3, stages,
};

/// How many spheres there are.
pub(super) const COUNT: usize = 5;
/// Centre and radius: A, B and so on, from far to near. Some hide others.
const SPHERES: [[f32; 4]; COUNT] = [
    [0.3, 0.1, -3.0, 1.9],
    [3.1, -0.9, -1.0, 0.7],
    [-1.9, -0.2, -0.6, 1.1],
    [1.6, 0.5, 0.2, 0.9],
    [0.2, -0.7, 1.2, 0.6],
];
/// From where they are seen.
pub(super) const VIEW: View = View {
    eye: Vec3::new(0.0, 0.0, 7.0),
    target: Vec3::ZERO,
    up: Vec3::Y,
    lens: Lens::Perspective { fov: 38.0 },
};

/// The spheres, in an order, and a camera of so many pixels.
#[derive(Clone, Debug)]
pub(super) struct Few {
    pub(super) list: SphereList,
    /// The letter of every sphere, by its place in the list.
    names: Vec<usize>,
    pub(super) camera: Camera,
    pub(super) width: u32,
    pub(super) height: u32,
}

impl Few {
    /// The spheres in their order, or in reverse.
    pub(super) fn new((width, height): (u32, u32), reversed: bool) -> Self {
        let mut names: Vec<_> = (0..SPHERES.len()).collect();
        if reversed {
            names.reverse();
        }
        let list = names.iter().map(|&name| SPHERES[name]).collect();
        let camera = VIEW.camera(width, height, f64::from(width) / f64::from(height));
        Self { list, names, camera, width, height }
    }

    pub(super) fn pixels(&self) -> usize {
        (self.width * self.height) as usize
    }

    /// Which sphere stands at a place of the list: 0 is A.
    pub(super) fn name(&self, place: usize) -> usize {
        self.names[place]
    }

    /// The viewing ray of a pixel, row by row.
    pub(super) fn ray(&self, pixel: usize) -> Ray {
        let (ix, iy) = self.place(pixel);
        self.camera.get_ray(ix, iy)
    }

    /// Column and row of a pixel.
    pub(super) fn place(&self, pixel: usize) -> (u32, u32) {
        (pixel as u32 % self.width, pixel as u32 / self.width)
    }

    /// The pixel in a column and a row.
    pub(super) fn pixel(&self, ix: u32, iy: u32) -> usize {
        (iy * self.width + ix) as usize
    }

    /// What a pixel of a picture shows whose first pixels have these `hits`: the letter of a sphere.
    pub(super) fn seen(&self, hits: &[Option<Hit>], ix: u32, iy: u32) -> Pixel {
        match hits.get(self.pixel(ix, iy)) {
            Some(hit) => Pixel::of_sphere(self.shown(*hit), letter),
            None => Pixel::WAITING,
        }
    }

    /// The sphere that a pixel shows.
    pub(super) fn shown(&self, hit: Option<Hit>) -> Option<usize> {
        hit.map(|hit| self.name(hit.sphere as usize))
    }

    /// Image order: the closest hits of the first pixels, and how many tests they took, as the kernel counts.
    pub(super) fn image_order(&self, pixels: usize) -> (Vec<Option<Hit>>, u64) {
        let rays: Vec<_> = (0..pixels).map(|pixel| self.ray(pixel)).collect();
        let mut hits = vec![None; pixels];
        self.list.closest_hits(Exact, &rays, &mut hits);
        let packets: Vec<_> = rays.chunks(RayPacket::COUNT).map(RayPacket::new).collect();
        (hits, stages(ClosestHit, &packets, self.list.spheres()).tests)
    }

    /// Object order: the hits after the first spheres of the list, and what these spheres took.
    pub(super) fn object_order(&self, spheres: usize) -> (Vec<Option<Hit>>, Counts) {
        let list: SphereList = self.list.spheres().iter().take(spheres).collect();
        let (across, _) = Camera::tile::<[f32; 16]>();
        let corners: Vec<_> = Camera::tile_corners::<[f32; 16]>(self.width, self.height).collect();
        let rays: Vec<RayPacket> = corners
            .iter()
            .map(|&(x, y)| self.camera.packet(x, y, self.width, self.height))
            .collect();
        let mut packets = vec![HitPacket::none(); rays.len()];
        let mut areas = Vec::new();
        let objects = ObjectOrder::new(list.spheres(), Screen::new(&VIEW), &mut areas);
        // The tier that is right.
        let tracing =
            Tracing { tier: Tier::Exact, level: Level::best(), coherence: Coherence::Coherent };
        let counts = objects.closest_hits(tracing, &mut Raster::default(), &rays, &mut packets);
        let mut hits = vec![None; self.pixels()];
        for (&(left, top), packet) in corners.iter().zip(&packets) {
            for (lane, hit) in (0..).zip(packet.hits()) {
                let (ix, iy) = (left + lane % across, top + lane / across);
                if ix < self.width && iy < self.height {
                    hits[self.pixel(ix, iy)] = hit;
                }
            }
        }
        (hits, counts)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_orders_have_one_picture() {
        for reversed in [false, true] {
            for size in [(24, 12), (7, 5)] {
                let few = Few::new(size, reversed);
                let (image, tests) = few.image_order(few.pixels());
                let (object, counts) = few.object_order(COUNT);
                assert_eq!(image, object);
                assert_eq!(tests, (few.pixels() * COUNT) as u64);
                assert!(counts.tests > 0 && counts.writes.stored >= counts.writes.overwritten);
            }
        }
    }
}
