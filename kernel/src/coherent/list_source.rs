//! Packets of a common origin or direction, traced through spheres in the order of their depth.
//!
//! A thousand packets share a list of the spheres inside their frustum, some tens share a shorter one. Four packets go
//! through it together (`list_group.rs`).

use super::depth_list::DepthList;
use super::learnt::Learnt;
use super::list_group::ListSource;
use super::packet_group::GROUP;
use super::patience::Patience;
use super::survey::Survey;
use crate::Accuracy;
use crate::geometry::ray_packet::RayPacket;
use crate::lanes::Lanes;
use crate::linear;
use crate::query::Query;
use core::ops::Range;

/// How many packets share the larger list.
const LARGE: usize = 1024;
/// How many packets share the shorter list.
const MIDDLE: usize = 64;
/// A list of so many spheres is short enough: looking at its blocks costs less than a survey.
const SHORT: usize = 64;

/// Answers every ray.
#[inline(always)]
pub(crate) fn traverse<L: Lanes, Q: Query>(
    tier: impl Accuracy,
    token: L::Token,
    list: &DepthList<'_>,
    (scratch, learnt): (&mut [f32], &mut Learnt),
    rays: &[RayPacket<L::Array>],
    answers: &mut [Q::Packet<L::Array>],
) {
    let count = rays.len().min(answers.len());
    let Some(view) = &list.view else {
        return test_all::<L, Q>(tier, token, list, learnt, (rays, 0..count), answers);
    };
    let (longer, shorter) = scratch.split_at_mut(scratch.len() / 2);
    let size = (list.scale.factor, list.extent, tier.spread());
    // Packets from `unanswered` to `from` are to be tested against all spheres, in one run.
    let (mut from, mut unanswered) = (0, 0);
    let mut patience = Patience::NEW;
    while from < count {
        let large = rays.get(from..count.min(from + LARGE)).unwrap_or_default();
        let survey = Survey::new::<L>(token, view, large, size);
        let end = from + survey.packets.max(1);
        // A packet by itself pays for no block of spheres outside.
        if survey.packets == 0 && (list.outside > 0 || !view.is_shared_by::<L>(token, &rays[from]))
        {
            from = end;
            continue;
        }
        // Spheres that no bound sees are tested first: packets begin with these hits.
        if list.outside > 0
            && let (Some(rays), Some(answers)) = (rays.get(from..end), answers.get_mut(from..end))
        {
            linear::traverse_some::<L, Q>(tier, token, &list.outside(), rays, answers);
        }
        let mut listed = list.listed;
        if survey.packets > MIDDLE && listed.count > SHORT {
            listed = listed.inside::<L>(token, &survey, longer).unwrap_or(listed);
        }
        while from < end {
            let to = end.min(from + MIDDLE);
            let middle = rays.get(from..to).unwrap_or_default();
            let mut shorter_list = listed;
            if middle.len() > GROUP && listed.count > SHORT {
                let survey = Survey::new::<L>(token, view, middle, size);
                // The first of these rays may show another way, in which not all of them run.
                if survey.packets == middle.len() {
                    shorter_list = listed.inside::<L>(token, &survey, shorter).unwrap_or(listed);
                }
            }
            let mut source = ListSource { list, view, listed: &shorter_list, patience, work: 0 };
            while from < to {
                let next = to.min(from + GROUP);
                if let (Some(group), Some(of_group)) =
                    (rays.get(from..next), answers.get_mut(from..next))
                    && source.trace::<L, Q>(tier, token, group, of_group)
                {
                    let run = (rays, unanswered..from);
                    test_all::<L, Q>(tier, token, list, learnt, run, answers);
                    unanswered = next;
                }
                from = next;
            }
            patience = source.patience;
            learnt.add_work(source.work);
        }
    }
    test_all::<L, Q>(tier, token, list, learnt, (rays, unanswered..count), answers);
}

/// Tests some packets against all spheres, except where the caller does otherwise.
#[inline(always)]
fn test_all<L: Lanes, Q: Query>(
    tier: impl Accuracy,
    token: L::Token,
    list: &DepthList<'_>,
    learnt: &mut Learnt,
    (rays, run): (&[RayPacket<L::Array>], Range<usize>),
    answers: &mut [Q::Packet<L::Array>],
) {
    if !run.is_empty()
        && !learnt.are_left(run.clone())
        && let (Some(rays), Some(answers)) = (rays.get(run.clone()), answers.get_mut(run))
    {
        linear::traverse::<L, Q>(tier, token, list.spheres, rays, answers);
    }
}
