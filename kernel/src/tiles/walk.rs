//! From runs of packets to groups of a thousand, of some ten, of a few.

use super::answer::Answer;
use super::list::List;
use super::member::Member;
use super::pencil::{Pencil, raised_reach};
use super::survey::{self, BoundLanes, Survey};
use super::view::{Heading, Seen, View};
use super::{DepthOrder, LISTS};
use crate::{Accuracy, HitPacket, LaneMask, Lanes, RayPacket, Spheres};

/// How many packets share the larger list.
pub(super) const LARGE: usize = 1024;
/// How many share the shorter one.
pub(super) const MIDDLE: usize = 64;
/// How many go through it together.
const SMALL: usize = 4;

/// The nearest hit of every ray: what [`nearest`](crate::nearest) returns, for rays that share an
/// origin or a direction.
///
/// `hits[i]` is overwritten with what `rays[i]` meets; packets past the end of the shorter slice are
/// left alone. `spheres` is the list that `order` was made from; what happens with another stands
/// at [`DepthOrder`]. `lists` is working memory, as long as [`DepthOrder::lists`] says, one for each
/// thread; with less the answers are the same, and take longer.
///
/// Domain and guarantee: see the [module](crate::tiles). Cost: grows with the number of spheres
/// that lie one behind the other, and by a sixteenth of an operation in a thousand packets with
/// their number; packets that follow each other should lie beside each other in the picture. What
/// the bounds do not cover costs as without an order. Stack: some 12 KiB.
#[inline(always)]
pub fn nearest<A: Accuracy, L: Lanes>(
    token: L::Token,
    rays: &[RayPacket<L>],
    spheres: Spheres<'_>,
    order: &DepthOrder<'_>,
    lists: &mut [u32],
    hits: &mut [HitPacket<L>],
) {
    answer::<A, L, HitPacket<L>>(token, rays, spheres, order, lists, hits);
}

/// Whether every ray meets anything: what [`any`](crate::any) returns, for rays that share an origin
/// or a direction.
///
/// Lane `i` in bit `i` of `met[k]` for `rays[k]`. True exactly where [`nearest`] finds a hit;
/// cheaper, since a ray that has met something is done. Otherwise as `nearest`.
#[inline(always)]
pub fn any<A: Accuracy, L: Lanes>(
    token: L::Token,
    rays: &[RayPacket<L>],
    spheres: Spheres<'_>,
    order: &DepthOrder<'_>,
    lists: &mut [u32],
    met: &mut [u32],
) {
    answer::<A, L, u32>(token, rays, spheres, order, lists, met);
}

#[inline(always)]
fn answer<A: Accuracy, L: Lanes, R: Answer<L>>(
    token: L::Token,
    rays: &[RayPacket<L>],
    spheres: Spheres<'_>,
    order: &DepthOrder<'_>,
    lists: &mut [u32],
    answers: &mut [R],
) {
    match order.seen {
        _ if order.count != spheres.len() => {
            R::by_brute_force::<A>(token, rays, spheres, answers);
        }
        Some(Seen::Perspective(view)) => {
            Walk { view, order, spheres }.packets::<A, L, R>(token, rays, lists, answers);
        }
        Some(Seen::Parallel(view)) => {
            Walk { view, order, spheres }.packets::<A, L, R>(token, rays, lists, answers);
        }
        None => R::by_brute_force::<A>(token, rays, spheres, answers),
    }
}

/// What all groups share.
struct Walk<'a, V> {
    view: V,
    order: &'a DepthOrder<'a>,
    spheres: Spheres<'a>,
}

impl<V: View> Walk<'_, V> {
    #[inline(always)]
    fn packets<A: Accuracy, L: Lanes, R: Answer<L>>(
        &self,
        token: L::Token,
        rays: &[RayPacket<L>],
        lists: &mut [u32],
        answers: &mut [R],
    ) {
        let (longer, shorter) = lists.split_at_mut(lists.len() / LISTS);
        let mut from = 0;
        while let (Some(rays @ [_, ..]), Some(answers @ [_, ..])) =
            (rays.get(from..), answers.get_mut(from..))
        {
            if let Some(survey) = Survey::new::<L, V>(token, &self.view, rays) {
                let group = rays.get(..survey.packets).unwrap_or(rays);
                self.large_group::<A, L, R>(token, &survey, group, longer, shorter, answers);
                from += survey.packets;
            } else {
                let count = survey::uncovered::<L, V>(token, &self.view, rays);
                let group = rays.get(..count).unwrap_or(rays);
                R::by_brute_force::<A>(token, group, self.spheres, answers);
                from += count;
            }
        }
    }

    #[inline(always)]
    fn large_group<A: Accuracy, L: Lanes, R: Answer<L>>(
        &self,
        token: L::Token,
        survey: &Survey,
        rays: &[RayPacket<L>],
        longer: &mut [u32],
        shorter: &mut [u32],
        answers: &mut [R],
    ) {
        let (heading, extent) = (&survey.heading, self.order.extent);
        let mut list = self.order.list;
        if rays.len() > MIDDLE {
            let pencil = self.view.pencil::<A>(heading, &survey.all(), extent);
            list = list.inside::<A, L>(token, &pencil, longer).unwrap_or(list);
        }
        for ((rays, answers), bounds) in
            rays.chunks(MIDDLE).zip(answers.chunks_mut(MIDDLE)).zip(&survey.bounds)
        {
            let mut list = list;
            if rays.len() > SMALL {
                let pencil = self.view.pencil::<A>(heading, bounds, extent);
                list = list.inside::<A, L>(token, &pencil, shorter).unwrap_or(list);
            }
            for (rays, answers) in rays.chunks(SMALL).zip(answers.chunks_mut(SMALL)) {
                self.small_group::<A, L, R>(token, heading, rays, &list, answers);
            }
        }
    }

    #[inline(always)]
    fn small_group<A: Accuracy, L: Lanes, R: Answer<L>>(
        &self,
        token: L::Token,
        heading: &Heading,
        rays: &[RayPacket<L>],
        list: &List<'_>,
        answers: &mut [R],
    ) {
        let Some(first) = rays.first() else { return };
        let mut members = [Member::<L>::new(token, &self.view, first); SMALL];
        for (member, packet) in members.iter_mut().zip(rays).skip(1) {
            *member = Member::<L>::new(token, &self.view, packet);
        }
        let members = members.get_mut(..rays.len()).unwrap_or_default();
        let mut bounds = BoundLanes::<L>::empty(token);
        for member in members.iter() {
            bounds.add(&self.view, heading, member);
        }
        let pencil = self.view.pencil::<A>(heading, &bounds.bounds(), self.order.extent);
        let mut hits = [HitPacket::<L>::none(); SMALL];
        self.visit::<A, L, R>(token, &pencil, list, members, &mut hits);
        for (answer, hits) in answers.iter_mut().zip(&hits) {
            *answer = R::from_hits(token, hits);
        }
    }

    /// Goes through a list from the front.
    #[inline(always)]
    fn visit<A: Accuracy, L: Lanes, R: Answer<L>>(
        &self,
        token: L::Token,
        pencil: &Pencil,
        list: &List<'_>,
        members: &mut [Member<L>],
        hits: &mut [HitPacket<L>; SMALL],
    ) {
        let slack = pencil.pad + A::SPREAD * self.order.extent;
        for (member, hit) in members.iter_mut().zip(hits.iter_mut()) {
            member.shorten::<R>(slack, hit);
        }
        if self.order.outside > 0 {
            self.meet_outside::<A, L, R>(slack, members, hits);
        }
        for at in (0..list.count).step_by(L::COUNT) {
            // All that follows is as deep, or deeper.
            let Some(depth) = list.depth(at) else { return };
            if !any_goes_to(members, depth) {
                return;
            }
            let inside = pencil.may_meet::<A, L>(&list.lanes::<L>(token, at, pencil.axes));
            let mut places = inside.bits();
            while places != 0 {
                let place = at + places.trailing_zeros() as usize;
                places &= places - 1;
                let Some(listed) = list.get(place) else { return };
                let center = listed.center;
                let reach = raised_reach::<A, f32>(center, listed.reach, pencil.pad);
                let mut reached = false;
                for (member, hit) in members.iter_mut().zip(hits.iter_mut()) {
                    if !member.goes_to(listed.depth) {
                        continue;
                    }
                    reached = true;
                    let asked = member.may_meet(&self.view, center, reach);
                    if asked.any()
                        && let Some(sphere) = self.spheres.get(listed.index as usize)
                    {
                        member.meet::<A>(&sphere, listed.index, asked, hit);
                        member.shorten::<R>(slack, hit);
                    }
                }
                if !reached {
                    return;
                }
            }
        }
    }

    /// Asks about the spheres that every ray must be tested against.
    #[inline(always)]
    fn meet_outside<A: Accuracy, L: Lanes, R: Answer<L>>(
        &self,
        slack: f32,
        members: &mut [Member<L>],
        hits: &mut [HitPacket<L>; SMALL],
    ) {
        for &index in self.order.outside() {
            let Some(sphere) = self.spheres.get(index as usize) else { return };
            for (member, hit) in members.iter_mut().zip(hits.iter_mut()) {
                member.meet::<A>(&sphere, index, member.rays.live, hit);
                member.shorten::<R>(slack, hit);
            }
        }
    }
}

/// Whether a ray of any of them goes as deep as `depth`.
#[inline(always)]
fn any_goes_to<L: Lanes>(members: &[Member<L>], depth: f32) -> bool {
    for member in members {
        if member.goes_to(depth) {
            return true;
        }
    }
    false
}
