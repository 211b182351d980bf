//! What there is to see: spheres, their colours, how they are lit, and a first view.

pub mod builtin;
pub mod elements;
pub mod framing;
mod lighting;
mod lines;
pub mod open;
mod read_error;
pub mod toml;
pub mod xyz;

pub use lighting::{Light, Lighting, Source};
pub use read_error::ReadError;

use crate::color::Srgb;
use crate::view::View;
use spherule_kernel::{Sphere, SphereList, Spheres};

/// Spheres, how they are lit, and a first view.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    list: SphereList,
    colors: Vec<Srgb>,
    labels: Vec<Option<Box<str>>>,
    /// The colour of what no sphere covers.
    pub background: Srgb,
    /// Whether the scene itself says so: then it is not the user's to choose.
    pub names_background: bool,
    /// Whether spheres cast shadows.
    pub shadows: bool,
    /// How the spheres are lit.
    pub lighting: Lighting,
    /// The scene's own view; `None`: framed automatically.
    pub view: Option<View>,
}

impl Scene {
    /// No spheres, no lights, a black background.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a sphere after the others.
    pub fn push(&mut self, sphere: Sphere, color: Srgb, label: Option<&str>) {
        self.list.push(sphere);
        self.colors.push(color);
        self.labels.push(label.map(Into::into));
    }

    /// The spheres.
    #[must_use]
    pub fn list(&self) -> &SphereList {
        &self.list
    }

    /// The spheres, borrowed as the kernel reads them.
    #[must_use]
    pub fn spheres(&self) -> Spheres<'_> {
        self.list.spheres()
    }

    /// The colours, one a sphere.
    #[must_use]
    pub fn colors(&self) -> &[Srgb] {
        &self.colors
    }

    /// The label of sphere `index`; `None` if it has none, or there is no such sphere.
    #[must_use]
    pub fn label(&self, index: usize) -> Option<&str> {
        self.labels.get(index)?.as_deref()
    }

    /// The scene's own view, or one that shows all of it in a picture of `aspect`, width over
    /// height.
    #[must_use]
    pub fn first_view(&self, aspect: f32) -> View {
        self.view.unwrap_or_else(|| framing::framed(self.spheres(), aspect))
    }
}
