//! What there is to see: spheres, their colours, how they are lit, and a first view.

pub mod attributes;
pub mod builtin;
pub mod elements;
pub mod file_name;
mod fixed;
pub mod format;
pub mod frames;
pub mod framing;
mod input;
mod lighting;
pub(crate) mod notes;
mod number;
pub mod open;
mod origin;
mod particles;
pub mod radii;
mod read_error;
pub mod reading;
mod spacing;
mod symbols;
pub mod toml;
mod type_colors;

pub use lighting::{Light, Lighting, Source};
pub use read_error::ReadError;

use crate::color::Srgb;
use crate::view::View;
use attributes::Attributes;
use glam::DVec3;
use spherule_kernel::{Sphere, SphereList, Spheres};
use std::borrow::Cow;
use std::sync::Arc;

/// Spheres, how they are lit, and a first view.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    list: Arc<SphereList>,
    colors: Vec<Srgb>,
    /// Labels by the index of the sphere; spheres past the end have none.
    labels: Vec<Option<Box<str>>>,
    attributes: Attributes,
    /// The place, in the file's coordinates, of the zero of all positions here. It is the zero of the file, except
    /// where the file's spheres are far from that.
    pub origin: DVec3,
    /// The radius of spheres for which the file states none, where something tells it and there are such spheres.
    pub unstated_radius: Option<f32>,
    /// The colour of what no sphere covers.
    pub background: Srgb,
    /// Whether the scene itself names the background: then it is not the user's to choose.
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

    /// A scene of the spheres of a file, as many colours, and the attributes that the file states.
    #[must_use]
    pub fn of_spheres(list: SphereList, colors: Vec<Srgb>, attributes: Attributes) -> Self {
        Self { list: Arc::new(list), colors, attributes, ..Self::default() }
    }

    /// The same particles, with as many spheres elsewhere.
    #[must_use]
    pub fn moved(&self, list: SphereList) -> Self {
        Self { list: Arc::new(list), ..self.clone() }
    }

    /// Adds a sphere after the others, without attributes: only files state those.
    pub fn push(&mut self, sphere: Sphere, color: Srgb, label: Option<&str>) {
        Arc::make_mut(&mut self.list).push(sphere);
        self.colors.push(color);
        if let Some(label) = label {
            self.labels.resize(self.colors.len() - 1, None);
            self.labels.push(Some(label.into()));
        }
    }

    /// The spheres. They are shared with what is built over them.
    #[must_use]
    pub fn list(&self) -> &Arc<SphereList> {
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

    /// Sets the radii, one a sphere.
    pub fn resize_spheres(&mut self, radii: &[f32]) {
        let spheres = self.list.spheres();
        let resized =
            spheres.iter().zip(radii).map(|(sphere, &radius)| Sphere { radius, ..sphere });
        self.list = Arc::new(resized.collect());
    }

    /// Sets the colours, one a sphere: those that are chosen by attributes.
    pub fn set_colors(&mut self, colors: Vec<Srgb>) {
        self.colors = colors;
    }

    /// What the scene's file says of its spheres.
    #[must_use]
    pub fn attributes(&self) -> &Attributes {
        &self.attributes
    }

    /// The label of sphere `index`, its own or made of its attributes; `None` if it has none, or there is no such sphere.
    #[must_use]
    pub fn label(&self, index: usize) -> Option<Cow<'_, str>> {
        let own = self.labels.get(index).and_then(Option::as_deref);
        own.map(Cow::Borrowed).or_else(|| self.attributes.label(index).map(Cow::Owned))
    }

    /// The scene's own view, or one that shows all of it in a picture of `aspect`, width over
    /// height.
    #[must_use]
    pub fn first_view(&self, aspect: f32) -> View {
        self.view.unwrap_or_else(|| framing::framed(self.spheres(), aspect))
    }
}
