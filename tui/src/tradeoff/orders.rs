//! What both orders take: the lecture's image order, in which every ray is tested against every sphere and its pixel
//! written once, and object order.

use super::rays::Rays;
use super::watch::{Step, Watch};
use crate::structure::object_order::{Counts, ObjectOrder, Raster};
use crate::structure::screen::Screen;
use crate::structure::search::Tracing;
use crate::threads::{Threads, packets_a_task};
use crate::view::View;
use spherule_kernel::{HitPacket, Spheres, Writes};
use std::sync::{Mutex, PoisonError};

/// Tasks of the threads between two calls of the watch.
const TASKS_A_PART: usize = 16;

/// Counts of both orders for the same rays.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Orders {
    pub(super) image: Counts,
    pub(super) object: Counts,
}

impl Orders {
    /// Counts by tracing the `camera` rays of `view` in object order; `None` if the watch ends it.
    pub(super) fn count(
        tracing: Tracing,
        threads: &Threads,
        spheres: Spheres<'_>,
        view: &View,
        camera: &Rays,
        watch: &mut Watch<'_>,
    ) -> Option<Self> {
        let rays = camera.count as u64;
        let writes = Writes { stored: rays, overwritten: 0 };
        let image = Counts { tests: rays * spheres.len() as u64, writes };

        let mut areas = Vec::new();
        let objects = ObjectOrder::new(spheres, Screen::new(view), &mut areas);
        let object = Mutex::new(Counts::default());
        let (size, mut rasters) = (packets_a_task(camera.packets.len()), Vec::new());
        let parts = camera.packets.chunks(TASKS_A_PART * size);
        for (part, done) in parts.clone().zip(0_u32..) {
            watch.go_on(Step::Orders, f64::from(done) / parts.len() as f64)?;
            threads.share(&mut rasters, part.chunks(size), |raster: &mut Raster, rays| {
                let mut hits = vec![HitPacket::none(); rays.len()];
                let counts = objects.closest_hits(tracing, raster, rays, &mut hits);
                *object.lock().unwrap_or_else(PoisonError::into_inner) += counts;
            });
        }
        let object = object.into_inner().unwrap_or_else(PoisonError::into_inner);
        Some(Self { image, object })
    }
}
