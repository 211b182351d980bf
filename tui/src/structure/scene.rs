//! The structures over the spheres of a scene, and their memory.

use super::{Search, Structure, StructureChoice, Workload, choose};
use crate::failure::Failure;
use spherule_kernel::{Bvh, BvhLeaf, BvhNode, Spheres};
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
        let grown = self.nodes.try_reserve_exact(needed.nodes.saturating_sub(self.nodes.len()));
        let grown = grown
            .and(self.leaves.try_reserve_exact(needed.leaves.saturating_sub(self.leaves.len())));
        grown
            .map_err(|_| Failure::Running(format!("no memory for a tree of {spheres} spheres")))?;
        self.nodes.resize(needed.nodes, BvhNode::EMPTY);
        self.leaves.resize(needed.leaves, BvhLeaf::EMPTY);
        Ok(())
    }
}

/// The spheres of a scene, and what has been built over them because somebody asked for it.
#[derive(Debug)]
pub struct SceneStructures<'a> {
    spheres: Spheres<'a>,
    /// Until the tree is there.
    memory: Option<&'a mut TreeMemory>,
    tree: Option<Bvh<'a>>,
    build: Duration,
}

impl<'a> SceneStructures<'a> {
    /// Nothing is built yet; what will be, is built in `memory`.
    pub fn new(spheres: Spheres<'a>, memory: &'a mut TreeMemory) -> Self {
        Self { spheres, memory: Some(memory), tree: None, build: Duration::ZERO }
    }

    /// What `choice` comes to for this work, built where it is not there yet.
    ///
    /// # Errors
    /// [`Failure::Running`] where there is no memory for it.
    pub fn search(
        &mut self,
        choice: StructureChoice,
        workload: &Workload,
    ) -> Result<Search<'a>, Failure> {
        let structure = match choice {
            StructureChoice::Only(structure) => structure,
            StructureChoice::Auto => choose(self.spheres.len(), workload),
        };
        match structure {
            Structure::Brute => Ok(Search::brute(self.spheres)),
            Structure::Bvh => Ok(Search::tree(self.spheres, self.tree()?)),
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
        let tree = Bvh::build(self.spheres, &mut memory.nodes, &mut memory.leaves);
        let tree = tree.map_err(|error| Failure::Running(error.to_string()))?;
        self.build = start.elapsed();
        Ok(*self.tree.insert(tree))
    }

    /// How long it took to build what is there.
    #[must_use]
    pub fn build_time(&self) -> Duration {
        self.build
    }
}
