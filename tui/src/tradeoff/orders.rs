//! What both orders take: the lecture's image order, in which every ray is tested against every sphere and its pixel
//! written once, and object order.

use super::rays::Rays;
use crate::structure::object_order::{Counts, ObjectOrder, Raster};
use crate::structure::screen::Screen;
use crate::structure::search::Tracing;
use crate::threads::{Threads, packets_a_task};
use crate::view::View;
use spherule_kernel::{HitPacket, Spheres, Writes};
use std::sync::{Mutex, PoisonError};

/// Counts of the same rays.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Orders {
    pub(super) image: Counts,
    pub(super) object: Counts,
}

impl Orders {
    /// Counts by tracing the `camera` rays of `view` in object order.
    pub(super) fn count(
        tracing: Tracing,
        threads: &Threads,
        spheres: Spheres<'_>,
        view: &View,
        camera: &Rays,
    ) -> Self {
        let rays = camera.count as u64;
        let writes = Writes { stored: rays, overwritten: 0 };
        let image = Counts { tests: rays * spheres.len() as u64, writes };

        let mut areas = Vec::new();
        let objects = ObjectOrder::new(spheres, Screen::new(view), &mut areas);
        let object = Mutex::new(Counts::default());
        let tasks = camera.packets.chunks(packets_a_task(camera.packets.len()));
        threads.share(&mut Vec::new(), tasks, |raster: &mut Raster, rays| {
            let mut hits = vec![HitPacket::none(); rays.len()];
            let counts = objects.closest_hits(tracing, raster, rays, &mut hits);
            *object.lock().unwrap_or_else(PoisonError::into_inner) += counts;
        });
        Self { image, object: object.into_inner().unwrap_or_else(PoisonError::into_inner) }
    }
}
