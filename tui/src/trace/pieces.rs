//! Packets cut into pieces of work whose rays are of one kind.

use crate::structure::RaysKind;
use spherule_kernel::{Lanes, Ray, Vec3};
use std::ops::Range;

/// How many packets are judged together: as many as go through a tree together.
const BUNDLE: usize = 4;
/// Packets of one kind of rays, for one thread.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Piece {
    pub(super) packets: Range<usize>,
    pub(super) kind: RaysKind,
}

/// Packets of `L` lanes, filled with `rays` from first to last, in pieces of at most `longest`
/// packets.
///
/// Rays are coherent where those of some packets side by side share an origin or a direction.
pub(super) fn pieces<L: Lanes>(rays: &[Ray], longest: usize) -> Vec<Piece> {
    let mut pieces = Vec::<Piece>::new();
    let mut run_start = 0;
    for (index, rays) in rays.chunks(BUNDLE * L::COUNT).enumerate() {
        let kind = kind(rays);
        let first = BUNDLE * index;
        let end = first + rays.len().div_ceil(L::COUNT);
        match pieces.last_mut() {
            Some(last) if last.kind == kind => {
                if (first - run_start).is_multiple_of(longest) {
                    pieces.push(Piece { packets: first..end, kind });
                } else {
                    last.packets.end = end;
                }
            }
            _ => {
                run_start = first;
                pieces.push(Piece { packets: first..end, kind });
            }
        }
    }
    pieces
}

fn kind(rays: &[Ray]) -> RaysKind {
    let bits = |vector: Vec3| vector.to_array().map(f32::to_bits);
    let share = |of: fn(&Ray) -> Vec3| {
        let mut all = rays.iter().map(|ray| bits(of(ray)));
        all.next().is_none_or(|first| all.all(|other| other == first))
    };
    if share(|ray| ray.origin) || share(|ray| ray.direction) {
        RaysKind::Coherent
    } else {
        RaysKind::Incoherent
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use RaysKind::{Coherent, Incoherent};
    use spherule_kernel::f32x16;

    /// Rays of which those in `scattered` have nothing in common.
    fn rays(count: usize, scattered: Range<usize>) -> Vec<Ray> {
        let ray = |index| {
            let place = index as f32;
            let origin = if scattered.contains(&index) { place } else { 0.5 };
            Ray::new(Vec3::splat(origin), Vec3::new(1.0, place, 0.0))
        };
        (0..count).map(ray).collect()
    }

    fn check(pieces: &[Piece], packets: usize, longest: usize) {
        let mut end = 0;
        for piece in pieces {
            assert_eq!(piece.packets.start, end);
            assert!(!piece.packets.is_empty() && piece.packets.len() <= longest);
            end = piece.packets.end;
        }
        assert_eq!(end, packets);
    }

    #[test]
    fn kinds_are_told_apart_by_the_bundle() {
        let pieces = pieces::<f32x16>(&rays(1000, 130..300), 256);
        check(&pieces, 63, 256);
        let of_kind = |packet: usize| {
            pieces.iter().find(|piece| piece.packets.contains(&packet)).map(|piece| piece.kind)
        };
        let kinds = [0, 7, 8, 19, 20, 62].map(of_kind);
        assert_eq!(
            kinds,
            [Coherent, Coherent, Incoherent, Incoherent, Coherent, Coherent].map(Some)
        );
    }

    #[test]
    fn pieces_are_not_too_long() {
        for longest in [16, 48, 256] {
            let pieces = pieces::<f32x16>(&rays(100_001, 5000..6000), longest);
            check(&pieces, 6251, longest);
            assert!(pieces.len() <= 6251 / longest + 5);
        }
        assert_eq!(pieces::<f32x16>(&[], 16), []);
    }

    #[test]
    fn parallel_rays_are_coherent() {
        let ray = |index: u8| Ray::new(Vec3::splat(f32::from(index)), Vec3::Z);
        let rays: Vec<_> = (0..9).map(ray).collect();
        assert_eq!(pieces::<f32x16>(&rays, 16), [Piece { packets: 0..1, kind: Coherent }]);
    }
}
