//! The structures over the spheres of a scene, built when they are first used.

use super::choose::{Workload, choose};
use super::object_order::ObjectOrder;
use super::openness::{Around, Openness};
use super::picture_search::{PictureSearch, Setting};
use super::screen::{Area, Screen};
use super::search::Search;
use super::{Order, Structure};
use crate::choice::Auto;
use crate::error::Error;
use crate::scene::framing::subject;
use crate::scene::{Scene, Source};
use crate::style::Aids;
use crate::threads::Threads;
use crate::view::View;
use spherule_kernel::{Bvh, DepthList, Sphere, SphereList, SphereTree, Spheres, Viewpoint};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// With so many spheres or fewer, occlusion rays search all of them, without a tree.
const FEW: usize = 64;
/// Spheres farther away than this, over the radius of all there is to see, are in no one's way: a sky around it.
const REACH: f32 = 2.0;

/// A tree whose boxes have grown by this factor is built anew.
const WORN: f32 = 1.5;

/// The spheres of a scene, and what has been built over them.
#[derive(Debug)]
pub struct SceneStructures<'a> {
    list: Arc<SphereList>,
    threads: &'a Threads,
    order: Order,
    aids: Aids,
    tree: Option<Arc<SphereTree>>,
    subject: Option<Sphere>,
    openness: Option<Arc<Openness>>,
    /// The memory of depth lists, one a viewpoint.
    depth_lists: Vec<Vec<f32>>,
    /// Where the spheres are on the screen.
    areas: Vec<Area>,
    build: Duration,
}

impl<'a> SceneStructures<'a> {
    /// Builds nothing yet; a tree will be built by `threads`.
    #[must_use]
    pub fn new(list: &Arc<SphereList>, threads: &'a Threads) -> Self {
        Self {
            list: Arc::clone(list),
            threads,
            order: Order::Image,
            aids: Aids::NONE,
            tree: None,
            subject: None,
            openness: None,
            depth_lists: Vec::new(),
            areas: Vec::new(),
            build: Duration::ZERO,
        }
    }

    /// The same structures, for pictures whose camera rays and spheres meet in this order.
    #[must_use]
    pub fn in_order(self, order: Order) -> Self {
        Self { order, ..self }
    }

    /// Which aids the next pictures have.
    pub fn set_aids(&mut self, aids: Aids) {
        self.aids = aids;
    }

    /// In which order camera rays and spheres meet.
    #[must_use]
    pub fn order(&self) -> Order {
        self.order
    }

    /// The same structures, with a tree that others have built over the same spheres.
    #[must_use]
    pub fn with_tree(self, tree: Option<Arc<SphereTree>>) -> Self {
        Self { tree, ..self }
    }

    /// The tree, if one has been built.
    #[must_use]
    pub fn tree(&self) -> Option<Arc<SphereTree>> {
        self.tree.clone()
    }

    /// Replaces the spheres. If there are as many as before, a tree is refitted to them, until it is `WORN`; else it is
    /// built again when it is used.
    ///
    /// For a million spheres that move a little, a refit takes a fraction of the time of a build. What there is to see stays
    /// what it was in the first picture, as the view does: else a sphere that leaves would change how all others fade.
    pub fn go_on(&mut self, list: &Arc<SphereList>) {
        self.subject.get_or_insert_with(|| subject(self.list.spheres()));
        self.list = Arc::clone(list);
        self.openness = None;
        let Some(tree) = self.tree.take() else { return };
        // A tree that is still shared cannot be refitted: a new one is built.
        let Ok(mut tree) = Arc::try_unwrap(tree) else { return };
        if tree.list().len() != list.len() {
            return;
        }
        let start = Instant::now();
        if tree.refit(SphereList::clone(list)).is_ok_and(|growth| growth < WORN) {
            self.tree = Some(Arc::new(tree));
        }
        self.build += start.elapsed();
    }

    /// From now on `subject` is what there is to see.
    pub fn frame(&mut self, subject: Sphere) {
        if self.subject != Some(subject) {
            (self.subject, self.openness) = (Some(subject), None);
        }
    }

    /// Returns `choice` or, if that is open, the cheapest structure for this work.
    #[must_use]
    pub fn structure(&self, choice: Auto<Structure>, workload: &Workload) -> Structure {
        let (spheres, threads) = (self.list.len(), self.threads.count());
        choice.unwrap_or_else(|| choose(spheres, workload, threads, self.tree.is_some()))
    }

    /// Returns `structure` for the rays of a viewpoint, or for rays of none: then brute force replaces a depth list.
    ///
    /// # Errors
    /// [`Error::Running`] if there is no memory for it.
    pub fn search(
        &mut self,
        structure: Structure,
        viewpoint: Option<Viewpoint>,
    ) -> Result<Search<'_>, Error> {
        Ok(self.searches(structure, &[viewpoint], None)?.remove(0))
    }

    /// Returns the searches of a picture of `scene` from `view`, by the structure of `choice`.
    ///
    /// `scene` must have the spheres of `self`; the lights and whether they cast shadows are taken from it.
    ///
    /// # Errors
    /// [`Error::Running`] if there is no memory for it.
    pub fn picture(
        &mut self,
        choice: Auto<Structure>,
        workload: &Workload,
        view: &View,
        scene: &Scene,
    ) -> Result<PictureSearch<'_>, Error> {
        let setting = self.setting()?;
        let lights = scene.lighting.lights(view);
        let casting = if scene.shadows { &*lights } else { &[] };
        let structure = self.structure(choice, &workload.with_shadows(casting));
        let coherence = workload.coherence();
        let towards = casting.iter().map(|light| match light.source {
            Source::Direction(direction) => Some(Viewpoint::Direction(direction)),
            Source::Position(_) => None,
        });
        let (camera, screen) = match self.order {
            Order::Image => (Some(Some(view.viewpoint())), None),
            Order::Object => (None, Some(Screen::new(view))),
        };
        let viewpoints: Vec<_> = camera.into_iter().chain(towards).collect();
        let mut to_lights = self.searches(structure, &viewpoints, screen)?;
        let camera = to_lights.remove(0);
        Ok(PictureSearch { structure, coherence, camera, lights, to_lights, setting })
    }

    /// What the aids need, found once.
    fn setting(&mut self) -> Result<Setting, Error> {
        let Aids { occlusion, depth_cue, .. } = self.aids;
        if !occlusion && !depth_cue {
            return Ok(Setting::default());
        }
        let subject = *self.subject.get_or_insert_with(|| subject(self.list.spheres()));
        let around = if occlusion { Some(self.around(subject.radius)?) } else { None };
        Ok(Setting { subject: depth_cue.then_some(subject), around })
    }

    /// The openness, as far as it is known, of a scene of this radius.
    fn around(&mut self, radius: f32) -> Result<Around, Error> {
        let tree = if self.list.len() > FEW {
            Some(Arc::clone(built(&mut self.tree, &self.list, self.threads, &mut self.build)?))
        } else {
            None
        };
        let openness = self
            .openness
            .get_or_insert_with(|| Arc::new(Openness::new(self.list.len(), REACH * radius)));
        Ok(Around { openness: Arc::clone(openness), list: Arc::clone(&self.list), tree })
    }

    /// Returns one search a viewpoint. If there is a screen, the spheres in object order come before them.
    fn searches(
        &mut self,
        structure: Structure,
        viewpoints: &[Option<Viewpoint>],
        screen: Option<Screen>,
    ) -> Result<Vec<Search<'_>>, Error> {
        let (start, spheres) = (Instant::now(), self.list.spheres());
        let areas = &mut self.areas;
        let objects =
            screen.map(|screen| Search::Objects(ObjectOrder::new(spheres, screen, areas)));
        let searches = match structure {
            Structure::Brute => Ok(vec![Search::Brute(spheres); viewpoints.len()]),
            Structure::Bvh => {
                let tree = built(&mut self.tree, &self.list, self.threads, &mut self.build)?;
                Ok(vec![Search::Bvh(tree.bvh()); viewpoints.len()])
            }
            Structure::DepthList => {
                self.depth_lists
                    .resize_with(viewpoints.len().max(self.depth_lists.len()), Vec::new);
                let sorted = |(viewpoint, memory): (&Option<Viewpoint>, _)| match viewpoint {
                    Some(viewpoint) => depth_list(spheres, *viewpoint, memory),
                    None => Ok(Search::Brute(spheres)),
                };
                let searches = viewpoints.iter().zip(&mut self.depth_lists).map(sorted).collect();
                self.build += start.elapsed();
                searches
            }
        };
        Ok(objects.into_iter().chain(searches?).collect())
    }

    /// How long building has taken, all together.
    #[must_use]
    pub fn build_time(&self) -> Duration {
        self.build
    }
}

/// Returns the tree. If there is none it is built, and `time` grows by what that takes.
fn built<'a>(
    tree: &'a mut Option<Arc<SphereTree>>,
    list: &SphereList,
    threads: &Threads,
    time: &mut Duration,
) -> Result<&'a Arc<SphereTree>, Error> {
    let there = match tree.take() {
        Some(there) => there,
        None => {
            let start = Instant::now();
            let built = SphereTree::build_with(threads, list.clone());
            let built = built.map_err(|_| no_tree(list.spheres().len()))?;
            *time += start.elapsed();
            Arc::new(built)
        }
    };
    Ok(tree.insert(there))
}

/// Sorts the spheres in the memory given.
fn depth_list<'a>(
    spheres: Spheres<'a>,
    viewpoint: Viewpoint,
    memory: &'a mut Vec<f32>,
) -> Result<Search<'a>, Error> {
    let missing = DepthList::needed(spheres.len()).saturating_sub(memory.len());
    memory.try_reserve_exact(missing).map_err(|_| no_memory("a depth list", spheres.len()))?;
    memory.resize(memory.len() + missing, 0.0);
    let list = DepthList::sort(spheres, viewpoint, memory);
    list.map(Search::DepthList).map_err(|error| Error::Running(error.to_string()))
}

fn no_tree(spheres: usize) -> Error {
    if Bvh::needed(spheres).places < usize::MAX {
        return no_memory("a tree", spheres);
    }
    let what = "a tree holds at most 134217728 spheres; --structure brute needs none";
    Error::Running(what.to_owned())
}

fn no_memory(what: &str, spheres: usize) -> Error {
    Error::Running(format!("no memory for {what} of {spheres} spheres"))
}

#[cfg(test)]
mod tests;
