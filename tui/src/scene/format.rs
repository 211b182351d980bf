//! The formats of files: what each is told by, and who reads it.

mod channels;
mod context;
mod gro;
mod lammps;
mod locations;
mod mercury;
mod mmcif;
mod mmcif_columns;
mod npy_points;
mod pdb;
mod ply;
pub(super) mod recognise;
pub(crate) mod replaced;
mod stated;
mod table;
mod urdf;
mod words;
mod xtc;
mod xyz;

pub(super) use context::Context;

use super::input::Input;
use super::read_error::ReadError;
use super::{Scene, toml};
use clap::ValueEnum;

/// The formats that scenes are read from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// Spheres, lights and a camera: Spherule's own
    Toml,
    /// XYZ and extended XYZ
    Xyz,
    /// Protein Data Bank
    Pdb,
    /// Macromolecular Crystallographic Information File
    Mmcif,
    /// GROMACS's .gro
    Gro,
    /// A trajectory of LAMMPS
    LammpsDump,
    /// The input of LAMMPS
    LammpsData,
    /// MercuryDPM's .data
    Mercury,
    /// A table: comma, tab, semicolon or space between columns
    #[value(alias = "tsv")]
    Csv,
    /// Stanford's polygons: their points
    Ply,
    /// numpy's array, (N, 3) or (N, 4)
    Npy,
    /// GROMACS's compressed trajectory
    Xtc,
    /// A robot whose parts are spheres
    Urdf,
}

impl Format {
    /// Whether a file of this format may have more than one frame.
    pub(super) fn has_frames(self) -> bool {
        self.has_only_frames() || matches!(self, Self::Pdb | Self::Mmcif)
    }

    /// Whether whatever follows a frame is another one. Behind the models of the other formats there may be anything.
    pub(super) fn has_only_frames(self) -> bool {
        matches!(self, Self::Xyz | Self::Gro | Self::LammpsDump | Self::Mercury | Self::Xtc)
    }

    /// Reads the next frame; `None` after the last.
    ///
    /// # Errors
    /// [`ReadError`] if it is no valid frame.
    pub(super) fn frame(
        self,
        input: &mut Input,
        context: &mut Context,
    ) -> Result<Option<Scene>, ReadError> {
        let scene = match self {
            Self::Xyz => xyz::frame(input, context),
            Self::Pdb => pdb::frame(input, context),
            Self::Mmcif => mmcif::frame(input, context),
            Self::Gro => gro::frame(input, context),
            Self::LammpsDump => lammps::dump::frame(input, context),
            Self::Mercury => mercury::frame(input, context),
            Self::Xtc => xtc::frame(input, context),
            Self::LammpsData => lammps::data::read(input, &mut context.notes).map(Some),
            Self::Csv => table::read(input, context).map(Some),
            Self::Ply => ply::read(input, &mut context.notes).map(Some),
            Self::Npy => npy_points::read(input, &mut context.notes).map(Some),
            Self::Urdf => urdf::read(input, &mut context.notes).map(Some),
            Self::Toml => toml::read(&input.text()?, input.source()).map(Some),
        }?;
        // Frames are seen from one view, so all have the origin of the first, and particles without a radius keep their size.
        if let Some(scene) = &scene {
            let fixed = &mut context.fixed;
            fixed.origin = fixed.origin.or(Some(scene.origin));
            fixed.radius = fixed.radius.or(scene.unstated_radius);
        }
        Ok(scene)
    }

    /// Leaves out a frame; `false` if there is none.
    ///
    /// # Errors
    /// [`ReadError`] if it is no valid frame.
    pub(super) fn skip(self, input: &mut Input, context: &mut Context) -> Result<bool, ReadError> {
        match self {
            Self::Xyz => xyz::skip(input),
            Self::LammpsDump => lammps::dump::skip(input),
            Self::Mercury => mercury::skip(input),
            _ => {
                let radius = context.fixed.radius;
                let frame = self.frame(input, context);
                // The size is that of a frame that is shown.
                context.fixed.radius = radius;
                match frame {
                    Err(error) if error.is_empty_frame => Ok(true),
                    frame => Ok(frame?.is_some()),
                }
            }
        }
    }
}

#[cfg(test)]
mod tests;
