//! Judges anyone's ray-sphere intersector against exact truth.
//!
//! ```
//! use spherule_referee::{Ray, Sphere, Trial, intersector::Pair};
//!
//! /// Anybody's function: where the ray meets the sphere first, if it does.
//! fn textbook(ray: &Ray, sphere: &Sphere) -> Option<f32> {
//!     let p = sphere.center - ray.origin;
//!     let (a, b) = (ray.direction.length_squared(), ray.direction.dot(p));
//!     let root = (b * b - a * (p.length_squared() - sphere.radius * sphere.radius)).sqrt();
//!     [(b - root) / a, (b + root) / a].into_iter().find(|t| (ray.t_min..=ray.t_max).contains(t))
//! }
//!
//! let report = Trial { cases: 200, ..Trial::default() }.run(&Pair::new("textbook", textbook));
//! assert!(report.wrong() > 0);
//! println!("{report}");
//! ```
//!
//! Code that has spheres of its own, a tree or another language behind it implements [`Intersector`], which has one required method besides
//! the name.
//!
//! | room | holds |
//! |---|---|
//! | [`case`], [`scene`], [`random`], [`ulp`], [`aim`] | a ray and a sphere; rays and spheres; tools that make cases |
//! | [`families`], [`measured`] | the families of cases; those in which error is measured |
//! | [`rules`], [`truth`] | what an intersector promises, and what is true under these promises |
//! | [`answer`], [`middle`], [`verdict`], [`counts`], [`failure`], [`judge`] | an answer, how it is wrong, how many are wrong, the worst and the
//! simplest, and the judge that counts them |
//! | [`simplicity`], [`shrink`], [`snippet`] | how readable a case is, the smallest that fails, and lines to paste |
//! | [`table`] | counts as a table, and a picture of where in a family it fails |
//! | [`intersector`], [`watched`], [`trial`] | what can be judged; a thread that may panic or hang; all families at once |
//! | [`bytes`], `strategies`, `timed` | a fuzzer's bytes; proptest's strategies; criterion's clock, started after the judge |
//!
//! The truth is [`spherule_kernel::Exact`], which is right for every input. The tests of the workspace compare it with an oracle in big
//! integers, on these families too.

#![forbid(unsafe_code)]

pub mod aim;
pub mod answer;
pub mod bytes;
pub mod case;
pub mod counts;
mod exact_sum;
pub mod failure;
pub mod families;
pub mod intersector;
pub mod judge;
pub mod measured;
pub mod middle;
pub mod random;
pub mod rules;
pub mod scene;
pub mod shrink;
pub mod simplicity;
pub mod snippet;
#[cfg(feature = "proptest")]
pub mod strategies;
pub mod table;
mod tangent;
#[cfg(feature = "criterion")]
pub mod timed;
pub mod trial;
pub mod truth;
pub mod ulp;
pub mod verdict;
pub mod watched;

pub use intersector::Intersector;
pub use rules::Rules;
pub use spherule_kernel::{Ray, Sphere, Vec3};
pub use trial::Trial;
