//! What a reader of a format knows besides the input.

use super::mmcif_columns::Columns;
use crate::scene::Scene;
use crate::scene::fixed::Fixed;
use crate::scene::input::Place;
use crate::scene::notes::Notes;
use std::collections::BTreeMap;
use std::sync::Arc;

/// What a reader knows besides the input.
#[derive(Debug, Default)]
pub(in crate::scene) struct Context {
    /// The columns that a table is to be read from.
    pub(in crate::scene) columns: Option<String>,
    /// What the particles of a trajectory are.
    pub(in crate::scene) topology: Option<Arc<Scene>>,
    /// What frames before have fixed for those that follow.
    pub(in crate::scene) fixed: Fixed,
    /// Notes for the user.
    pub(in crate::scene) notes: Notes,
    /// The columns of an mmCIF file's tables of atoms, by the place of a table's first row, as far as they have been read.
    /// A table with the columns of the one before is left out.
    pub(in crate::scene) mmcif: BTreeMap<Place, Columns>,
    /// Whether more may be written to the file: then its end need not be the end of a frame.
    pub(in crate::scene) follows: bool,
}
