//! What the command line says of a crowd of spheres: how they are told apart.

use crate::choice::{Auto, auto_or};
use crate::coloring::ColorBy;
use crate::coloring::scale::Range;
use crate::scene::Scene;
use crate::style::Aids;
use clap::{Args, ValueEnum};

/// On, or off.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Switch {
    /// Shown
    On,
    /// Not shown
    Off,
}

/// What tells spheres of a crowd apart.
#[derive(Args, Clone, Debug)]
pub struct CrowdArguments {
    /// What spheres are coloured by: scene, element, chain, residue, molecule, type, or a column of numbers [default:
    /// chain if there are several, else scene]
    #[arg(long, value_name = "WHAT")]
    pub color_by: Option<ColorBy>,
    /// The numbers that get the darkest and the lightest colour; needs --color-by COLUMN [default: the least and the
    /// largest of the frames so far]
    #[arg(long, value_name = "LOW:HIGH", requires = "color_by", allow_hyphen_values = true)]
    pub range: Option<Range>,
    /// Write what colours mean over the picture, also outside the viewer
    #[arg(long, conflicts_with_all = ["png", "pick", "cast"])]
    pub legend: bool,
    /// Darken spheres where others block light; auto: if there are chains
    #[arg(long, value_name = "WHEN", default_value = "auto")]
    #[arg(value_parser = auto_or::<Switch>("On if there are chains"))]
    #[arg(num_args = 0..=1, require_equals = true, default_missing_value = "on")]
    pub occlusion: Auto<Switch>,
    /// Darken edges before far things, and around chains; auto: if there are chains
    #[arg(long, value_name = "WHEN", default_value = "auto")]
    #[arg(value_parser = auto_or::<Switch>("On if there are chains"))]
    #[arg(num_args = 0..=1, require_equals = true, default_missing_value = "on")]
    pub edges: Auto<Switch>,
    /// Fade what is far away; auto: if there are chains
    #[arg(long, value_name = "WHEN", default_value = "auto")]
    #[arg(value_parser = auto_or::<Switch>("On if there are chains"))]
    #[arg(num_args = 0..=1, require_equals = true, default_missing_value = "on")]
    pub depth_cue: Auto<Switch>,
}

impl CrowdArguments {
    /// What a scene is coloured by.
    #[must_use]
    pub fn color_by(&self, scene: &Scene) -> ColorBy {
        self.color_by.clone().unwrap_or_else(|| ColorBy::usual(scene.attributes()))
    }

    /// The aids of its pictures.
    #[must_use]
    pub fn aids(&self, scene: &Scene) -> Aids {
        let usual = Aids::usual(scene);
        let is_on =
            |switch: Auto<Switch>, usual: bool| switch.map_or(usual, |switch| switch == Switch::On);
        Aids {
            occlusion: is_on(self.occlusion, usual.occlusion),
            edges: is_on(self.edges, usual.edges),
            depth_cue: is_on(self.depth_cue, usual.depth_cue),
        }
    }
}
