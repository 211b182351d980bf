//! The columns of an mmCIF table of atoms.

use crate::scene::input::Line;
use crate::scene::read_error::ReadError;

/// Which column of the table is what.
#[derive(Clone, Debug, Default, PartialEq)]
pub(in crate::scene) struct Columns {
    pub(super) count: usize,
    pub(super) position: [usize; 3],
    pub(super) symbol: Option<usize>,
    pub(super) name: Option<usize>,
    pub(super) residue: Option<usize>,
    pub(super) chain: Option<usize>,
    pub(super) residue_number: Option<usize>,
    pub(super) insertion: Option<usize>,
    pub(super) entity: Option<usize>,
    pub(super) location: Option<usize>,
    pub(super) model: Option<usize>,
    pub(super) numbers: [Option<usize>; 2],
}

impl Columns {
    pub(super) fn of(tags: &[String], line: &Line<'_>) -> Result<Self, ReadError> {
        let find = |names: &[&str]| {
            names.iter().find_map(|name| tags.iter().position(|tag| tag.eq_ignore_ascii_case(name)))
        };
        let axis = |name: &str| {
            find(&[name])
                .ok_or_else(|| line.error(0, format!("no _atom_site.{name} before the atoms")))
        };
        Ok(Self {
            count: tags.len(),
            position: [axis("Cartn_x")?, axis("Cartn_y")?, axis("Cartn_z")?],
            symbol: find(&["type_symbol"]),
            name: find(&["auth_atom_id", "label_atom_id"]),
            residue: find(&["auth_comp_id", "label_comp_id"]),
            chain: find(&["auth_asym_id", "label_asym_id"]),
            residue_number: find(&["auth_seq_id", "label_seq_id"]),
            insertion: find(&["pdbx_PDB_ins_code"]),
            entity: find(&["label_entity_id"]),
            location: find(&["label_alt_id"]),
            model: find(&["pdbx_PDB_model_num"]),
            numbers: [find(&["occupancy"]), find(&["B_iso_or_equiv"])],
        })
    }
}
