//! What rays hit.

use spherule_kernel::Hit;

/// What rays hit.
#[derive(Clone, Debug)]
pub struct Answers {
    /// The closest hit of each ray.
    pub hits: Vec<Option<Hit>>,
    /// Whether each ray hits anything.
    pub occluded: Vec<bool>,
}
