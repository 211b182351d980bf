//! How the rays of a picture find spheres, with what else the picture needs of its scene.

use super::openness::Around;
use super::search::Search;
use super::{Order, Structure};
use crate::scene::Light;
use spherule_kernel::{Coherence, Sphere};

/// How the rays of a picture find spheres.
#[derive(Clone, Debug)]
pub struct PictureSearch<'a> {
    /// The structure that is searched; in object order only the rays to the lights search it.
    pub structure: Structure,
    /// Whether its rays lie close together.
    pub coherence: Coherence,
    /// The search of the camera's rays.
    pub camera: Search<'a>,
    /// The lights of the picture.
    pub lights: Vec<Light>,
    /// The searches of the rays to the lights, one a light; none if the scene casts no shadows.
    pub to_lights: Vec<Search<'a>>,
    /// What aids need of the scene.
    pub setting: Setting,
}

/// A scene as a whole, as far as the aids of a picture need it.
#[derive(Clone, Debug, Default)]
pub struct Setting {
    /// A sphere around what there is to see, if the depth cue needs it.
    pub subject: Option<Sphere>,
    /// How open it is around the spheres, if occlusion is shown.
    pub around: Option<Around>,
}

impl PictureSearch<'_> {
    /// The order of the camera's rays.
    #[must_use]
    pub fn order(&self) -> Order {
        match self.camera {
            Search::Objects(_) => Order::Object,
            Search::Brute(_) | Search::DepthList(_) | Search::Bvh(_) => Order::Image,
        }
    }
}
