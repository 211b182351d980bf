//! The structures over the spheres of a scene, and their memory.

use super::{RaysKind, Search, Structure, StructureChoice, Workload, choose};
use crate::failure::Failure;
use crate::scene::{Light, Source};
use crate::threads::Threads;
use spherule_kernel::tiles::Viewpoint;
use spherule_kernel::{Bvh, BvhLeaf, BvhNode, DepthOrder, Spheres};
use std::time::{Duration, Instant};

/// Room for a tree.
#[derive(Clone, Debug, Default)]
pub struct TreeMemory {
    nodes: Vec<BvhNode>,
    leaves: Vec<BvhLeaf>,
}

impl TreeMemory {
    /// Room for a tree over so many spheres.
    fn grow(&mut self, spheres: usize) -> Result<(), Failure> {
        let needed = Bvh::needed(spheres);
        grow(&mut self.nodes, needed.nodes, BvhNode::EMPTY, "a tree", spheres)?;
        grow(&mut self.leaves, needed.leaves, BvhLeaf::EMPTY, "a tree", spheres)
    }
}

/// Makes a vector at least so long.
fn grow<T: Copy>(
    memory: &mut Vec<T>,
    length: usize,
    value: T,
    what: &str,
    spheres: usize,
) -> Result<(), Failure> {
    let missing = length.saturating_sub(memory.len());
    let reserved = memory.try_reserve_exact(missing);
    reserved.map_err(|_| Failure::Running(format!("no memory for {what} of {spheres} spheres")))?;
    memory.resize(memory.len() + missing, value);
    Ok(())
}

/// How the rays of a picture find spheres.
#[derive(Clone, Debug)]
pub struct PictureSearch<'a> {
    /// What all of them have in common.
    pub kind: RaysKind,
    /// Those of the camera.
    pub camera: Search<'a>,
    /// Those to the lights, one a light.
    pub lights: Vec<Search<'a>>,
}

/// The spheres of a scene, and what has been built over them because somebody asked for it.
#[derive(Debug)]
pub struct SceneStructures<'a> {
    spheres: Spheres<'a>,
    threads: &'a Threads,
    /// Until the tree is there.
    memory: Option<&'a mut TreeMemory>,
    tree: Option<Bvh<'a>>,
    /// Room for orders of the spheres, one a viewpoint.
    orders: Vec<Vec<u32>>,
    build: Duration,
}

impl<'a> SceneStructures<'a> {
    /// Nothing is built yet; a tree will be built in `memory`, by `threads`.
    pub fn new(spheres: Spheres<'a>, threads: &'a Threads, memory: &'a mut TreeMemory) -> Self {
        Self {
            spheres,
            threads,
            memory: Some(memory),
            tree: None,
            orders: Vec::new(),
            build: Duration::ZERO,
        }
    }

    /// What `choice` comes to for this work.
    #[must_use]
    pub fn structure(&self, choice: StructureChoice, workload: &Workload) -> Structure {
        match choice {
            StructureChoice::Only(structure) => structure,
            StructureChoice::Auto => choose(self.spheres.len(), workload),
        }
    }

    /// `structure` for rays of one viewpoint or none, built where it is not there yet.
    ///
    /// # Errors
    /// [`Failure::Running`] where there is no memory for it.
    pub fn search(
        &mut self,
        structure: Structure,
        viewpoint: Option<Viewpoint>,
    ) -> Result<Search<'_>, Failure> {
        let brute = Search::brute(self.spheres);
        let searches = self.searches(structure, &[viewpoint])?;
        Ok(searches.into_iter().next().unwrap_or(brute))
    }

    /// `structure` for a picture of rays of this kind from `viewpoint`, whose shadow rays go to
    /// `lights`.
    ///
    /// # Errors
    /// [`Failure::Running`] where there is no memory for it.
    pub fn picture(
        &mut self,
        structure: Structure,
        kind: RaysKind,
        viewpoint: Viewpoint,
        lights: &[Light],
    ) -> Result<PictureSearch<'_>, Failure> {
        let towards = lights.iter().map(|light| match light.source {
            Source::Direction(direction) => Some(Viewpoint::Direction(direction)),
            Source::Position(_) => None,
        });
        let viewpoints: Vec<_> = std::iter::once(Some(viewpoint)).chain(towards).collect();
        let mut lights = self.searches(structure, &viewpoints)?;
        let camera = lights.remove(0);
        Ok(PictureSearch { kind, camera, lights })
    }

    /// One search a viewpoint.
    fn searches(
        &mut self,
        structure: Structure,
        viewpoints: &[Option<Viewpoint>],
    ) -> Result<Vec<Search<'_>>, Failure> {
        let spheres = self.spheres;
        match structure {
            Structure::Brute => Ok(vec![Search::brute(spheres); viewpoints.len()]),
            Structure::Bvh => Ok(vec![Search::tree(spheres, self.tree()?); viewpoints.len()]),
            Structure::Tiles => {
                let start = Instant::now();
                if self.orders.len() < viewpoints.len() {
                    self.orders.resize_with(viewpoints.len(), Vec::new);
                }
                let sorted = |(viewpoint, memory): (&Option<Viewpoint>, _)| match viewpoint {
                    Some(viewpoint) => order(spheres, *viewpoint, memory),
                    None => Ok(Search::brute(spheres)),
                };
                let searches = viewpoints.iter().zip(&mut self.orders).map(sorted).collect();
                self.build += start.elapsed();
                searches
            }
        }
    }

    fn tree(&mut self) -> Result<Bvh<'a>, Failure> {
        let memory = match (self.tree, self.memory.take()) {
            (Some(tree), _) => return Ok(tree),
            (None, Some(memory)) => memory,
            (None, None) => unreachable!("a failure has ended the program"),
        };
        let start = Instant::now();
        memory.grow(self.spheres.len())?;
        let tree =
            Bvh::build_with(self.threads, self.spheres, &mut memory.nodes, &mut memory.leaves);
        let tree = tree.map_err(|error| Failure::Running(error.to_string()))?;
        self.build += start.elapsed();
        Ok(*self.tree.insert(tree))
    }

    /// How long it took to build what was asked for, all together.
    #[must_use]
    pub fn build_time(&self) -> Duration {
        self.build
    }
}

/// Sorts the spheres in the memory given.
fn order<'a>(
    spheres: Spheres<'a>,
    viewpoint: Viewpoint,
    memory: &'a mut Vec<u32>,
) -> Result<Search<'a>, Failure> {
    let count = spheres.len();
    grow(memory, DepthOrder::needed(count), 0, "the order", count)?;
    let order = DepthOrder::new(spheres, viewpoint, memory);
    let order = order.map_err(|error| Failure::Running(error.to_string()))?;
    Ok(Search::tiles(spheres, order))
}
