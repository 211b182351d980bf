//! Many rays of a call: slices and columns are packed, traced and unpacked, some packets at a time, on the stack.

#[cfg(feature = "std")]
mod by_depth;
#[cfg(feature = "alloc")]
mod in_order;
#[cfg(feature = "alloc")]
mod in_place;
#[cfg(feature = "alloc")]
mod many_at_once;
mod window;

use crate::Accuracy;
#[cfg(feature = "alloc")]
use crate::coherent::ray_order::MOST;
use crate::geometry::many::ManyRays;
use crate::geometry::many_answers::ManyAnswers;
use crate::geometry::ray_packet::RayPacket;
use crate::structures::{LevelQuery, Traverse};
use crate::trace::Trace;
#[cfg(feature = "std")]
use by_depth::Looks;
use window::{PACKETS, answer_part};

/// How many packets go first, if as many as are traced at a time are left after them: they tell whether groups pay, or a stream. (With 64,
/// closest hits of rays sorted by direction and half of a camera, among a million spheres, ran at 0.65 to 0.98 of the speed of ray by ray;
/// with 16 at 0.81 to 1.26. Where fewer rays are left than a stream has, it lacks those that went first: 0.7 of the speed of the best way
/// among nested spheres.)
const FIRST: usize = 16;
/// How many packets few rays fill: as many as go through a tree together; and how many some rays fill.
const FEW: usize = 4;
const SOME: usize = 16;

/// Answers every ray, as far as there is room for answers.
pub(crate) fn traverse<S: Traverse + ?Sized, Q: LevelQuery>(
    structure: &S,
    tier: impl Accuracy,
    trace: &mut Trace<'_>,
    rays: ManyRays<'_>,
    answers: Q::Many<'_>,
) {
    let count = rays.count().min(answers.count());
    #[cfg(feature = "std")]
    if structure.goes_one_by_one(trace, &rays, 0..count) {
        let mut answers = answers;
        return one_by_one::<S, Q>(structure, tier, trace, (&rays, 0, count), &mut answers);
    }
    trace.learnt.begin_call::<Q>(count.div_ceil(RayPacket::COUNT));
    // Memory is cleared before it is used. For few rays, to clear all of it takes longer than to trace them.
    if count <= RayPacket::COUNT {
        windows::<S, Q, 1>(structure, tier, trace, (&rays, count), answers);
    } else if count <= FEW * RayPacket::COUNT {
        windows::<S, Q, FEW>(structure, tier, trace, (&rays, count), answers);
    } else if cfg!(feature = "std") && count <= SOME * RayPacket::COUNT {
        windows::<S, Q, SOME>(structure, tier, trace, (&rays, count), answers);
    } else {
        windows::<S, Q, PACKETS>(structure, tier, trace, (&rays, count), answers);
    }
}

/// Answers every packet, as far as there is room for answers.
pub(crate) fn traverse_packets<S: Traverse + ?Sized, Q: LevelQuery>(
    structure: &S,
    tier: impl Accuracy,
    trace: &mut Trace<'_>,
    rays: &[RayPacket],
    answers: &mut [Q::Packet<[f32; 16]>],
) {
    trace.learnt.begin_call::<Q>(rays.len());
    #[cfg(feature = "alloc")]
    in_place::traverse::<S, Q>(structure, tier, trace, rays, answers);
    #[cfg(not(feature = "alloc"))]
    structure.in_packets::<Q>(tier, trace, rays, answers);
}

/// Answers rays `from` to `to` one by one.
#[cfg(feature = "std")]
#[inline(always)]
fn one_by_one<S: Traverse + ?Sized, Q: LevelQuery>(
    structure: &S,
    tier: impl Accuracy,
    trace: &mut Trace<'_>,
    (rays, from, to): (&ManyRays<'_>, usize, usize),
    answers: &mut Q::Many<'_>,
) {
    for index in from..to {
        // A ray is read where it lies. A copy would be read wider than it was written, and so wait for all stores before it. (Copied,
        // closest hits of 9 and 64 rays that have nothing in common ran at 0.84 to 0.9 of the speed by AVX-512 and AVX2, at 0.95 at the
        // baseline.)
        if let ManyRays::Slice(rays) = *rays {
            if let Some(ray) = rays.get(index) {
                answers.set(index, structure.one::<Q>(tier, trace, ray));
            }
        } else if let Some(ray) = rays.ray(index) {
            answers.set(index, structure.one::<Q>(tier, trace, &ray));
        }
    }
}

/// Answers rays, `AT_ONCE` packets at a time. (All share one trace, since they are one call.)
#[inline(never)]
fn windows<S: Traverse + ?Sized, Q: LevelQuery, const AT_ONCE: usize>(
    structure: &S,
    tier: impl Accuracy,
    trace: &mut Trace<'_>,
    (rays, count): (&ManyRays<'_>, usize),
    mut answers: Q::Many<'_>,
) {
    let mut packets = [RayPacket::BLANK; AT_ONCE];
    let mut answered = [Q::none::<[f32; 16]>(); AT_ONCE];
    let is_long = count >= (FIRST + AT_ONCE) * RayPacket::COUNT;
    let mut packets_at_once = if is_long { FIRST.min(AT_ONCE) } else { AT_ONCE };
    let mut from = 0;
    // The order of the rays is not looked at before this one.
    #[cfg(feature = "alloc")]
    let mut next_look = 0;
    #[cfg(feature = "std")]
    let (mut looks, fewest) = (Looks::NONE, FIRST * RayPacket::COUNT + by_depth::FEWEST);
    // (No `chunks`: they divide by their length, and may panic where the compiler does not know it.)
    while from < count {
        #[cfg(feature = "std")]
        let is_counted = looks.begin(structure, trace, [from, count - from, fewest]);
        #[cfg(feature = "std")]
        if is_counted {
            packets_at_once = FIRST.min(AT_ONCE);
        }
        let to = (from + packets_at_once * RayPacket::COUNT).min(count);
        #[cfg(feature = "std")]
        if from > 0 && structure.goes_one_by_one(trace, rays, from..to) {
            return one_by_one::<S, Q>(structure, tier, trace, (rays, from, to), &mut answers);
        }
        let all = (&mut answered[..], &mut answers);
        answer_part::<S, Q>(structure, tier, trace, (rays, from, to), &mut packets, all);
        #[cfg(feature = "std")]
        let counted = to - from;
        from = to;
        packets_at_once = AT_ONCE;
        #[cfg(feature = "std")]
        if is_counted {
            let work = (counted, trace.learnt.counted_work() / counted as f32);
            let (rest, all) = ((rays, from, count), (&mut answered[..], &mut answers));
            let before = from;
            from = by_depth::answer::<S, Q>(structure, tier, trace, rest, work, &mut packets, all);
            if looks.end([before, from]) {
                continue;
            }
        }
        #[cfg(feature = "alloc")]
        {
            if from >= next_look
                && let Some(gain) = structure.gain_by_order::<Q>(trace)
                && gain.is_for(count - from)
            {
                let (rest, all) = ((gain, rays, from, count), (&mut answered[..], &mut answers));
                from = in_order::answer::<S, Q>(structure, tier, trace, rest, &mut packets, all);
                next_look = from + MOST;
            }
            let rest = (rays, from, count);
            from = many_at_once::answer::<S, Q>(structure, tier, trace, rest, &mut answers);
        }
    }
}

#[cfg(all(test, proofs))]
#[cfg(feature = "std")]
mod tests {
    use crate::proofs::work::{Kind, Work};
    use crate::{Exact, Intersect, Ray, SphereList, SphereTree, Vec3};

    #[test]
    fn few_rays_go_one_by_one() {
        let list: SphereList = (0..200).map(|number| (Vec3::X * number as f32, 0.25)).collect();
        let tree = SphereTree::new(list);
        let rays: [Ray; 40] =
            core::array::from_fn(|number| Ray::new(Vec3::new(number as f32, 0.1, -9.0), Vec3::Z));
        for (count, is_packet) in [(1, false), (5, false), (8, false), (9, true), (40, true)] {
            let rays = &rays[..count];
            let (mut hits, mut occluded) = ([None; 40], [false; 40]);
            let closest = Work::of(|| tree.closest_hits(Exact, rays, &mut hits));
            let any = Work::of(|| tree.any_hits(Exact, rays, &mut occluded));
            // A ray that goes by itself clears no stack; rays that go together enter nodes as packets.
            let as_packets =
                |work: Work| work.count(Kind::RayStacks) + work.count(Kind::GroupNode) > 0;
            assert_eq!([closest, any].map(as_packets), [is_packet; 2], "{count}");
            for (number, ray) in rays.iter().enumerate() {
                assert_eq!(hits[number], tree.closest_hit(Exact, ray));
                assert_eq!(occluded[number], tree.any_hit(Exact, ray));
            }
            assert!(
                hits[..count].iter().all(Option::is_some) && hits[count..] == [None; 40][count..]
            );
        }
    }

    #[test]
    fn the_last_few_rays_of_a_long_call_have_answers_of_their_own() {
        let list: SphereList = (0..200).map(|number| (Vec3::X * number as f32, 0.25)).collect();
        let tree = SphereTree::new(list);
        let rays: [Ray; 1027] = core::array::from_fn(|number| {
            let x = if number < 1024 { (number % 200) as f32 } else { 1e3 };
            Ray::new(Vec3::new(x, 0.1, -9.0), Vec3::Z)
        });
        let (mut hits, mut occluded) = ([None; 1027], [false; 1027]);
        tree.closest_hits(Exact, &rays, &mut hits);
        tree.any_hits(Exact, &rays, &mut occluded);
        let together = |count| {
            let (rays, mut hits) = (&rays[..count], [None; 1027]);
            let work = Work::of(|| tree.closest_hits(Exact, rays, &mut hits));
            [Kind::RayStacks, Kind::GroupNode].map(|kind| work.count(kind))
        };
        assert_eq!(together(1027), together(1024), "the last three go one by one");
        for number in 0..rays.len() {
            assert_eq!(hits[number].is_some(), number < 1024, "{number}");
            assert_eq!(occluded[number], number < 1024, "{number}");
        }
    }
}
