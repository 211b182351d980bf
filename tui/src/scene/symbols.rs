//! How names of particles tell their elements.

use super::attributes::Names;
use super::elements::{Element, element};

/// How a name tells an element.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Symbols {
    /// It is a symbol or an atomic number, perhaps with a number behind it, as in `C12`.
    #[default]
    Elements,
    /// It is the name of an atom in a molecule: `CA`, `1HB2`, `OW`.
    AtomNames,
    /// It tells none: types are numbered.
    Numbers,
}

/// The atomic number of every name; 0 where none is known.
pub(super) fn resolved(kinds: &Names, symbols: Symbols) -> Vec<u8> {
    let number = |name: &str| {
        let found = match symbols {
            Symbols::Elements => of_symbol(name),
            Symbols::AtomNames => of_atom_name(name),
            Symbols::Numbers => None,
        };
        found.map_or(0, |element| element.number)
    };
    kinds.table().iter().map(|name| number(name)).collect()
}

/// The element of a symbol or an atomic number, perhaps with a number behind it.
pub(super) fn of_symbol(name: &str) -> Option<Element> {
    let is_behind = |c: char| c.is_ascii_digit() || c == '+' || c == '-';
    element(name).or_else(|| element(name.trim_end_matches(is_behind)))
}

/// The element that the name of an atom tells. In molecules of life, the names of all atoms of C, H, N, O, P and S
/// begin with that letter; ions have names of their own.
pub(super) fn of_atom_name(name: &str) -> Option<Element> {
    let letters = name.trim_start_matches(|c: char| c.is_ascii_digit());
    let stem = letters.trim_end_matches(|c: char| !c.is_ascii_alphabetic());
    let ions = [
        "NA", "CL", "MG", "ZN", "FE", "MN", "BR", "LI", "CU", "CO", "NI", "CAL", "SOD", "CLA",
        "POT",
    ];
    if ions.contains(&stem) {
        return of_ion(stem);
    }
    // A capital and a small letter are a symbol, as in `Fe` and `Na+`; names in molecules of life have capitals.
    if let [capital, small] = stem.as_bytes()
        && capital.is_ascii_uppercase()
        && small.is_ascii_lowercase()
        && let Some(found) = element(stem)
    {
        return Some(found);
    }
    let first = letters.get(..1)?;
    let is_isotope = ["D", "T"].contains(&letters);
    if is_isotope || ["C", "H", "N", "O", "P", "S", "F", "K", "I"].contains(&first) {
        element(first)
    } else {
        // Another letter alone is no element, but a bead of several atoms, as `W` is water in Martini.
        Some(stem).filter(|stem| stem.len() > 1).and_then(element)
    }
}

/// The element of an atom that is an ion, or a metal, by itself: its whole name tells, without a charge behind it.
pub(super) fn of_ion(name: &str) -> Option<Element> {
    element(match name.trim_end_matches(|c: char| !c.is_ascii_alphabetic()) {
        // As CHARMM calls them.
        "CAL" => "CA",
        "SOD" => "NA",
        "CLA" => "CL",
        "POT" => "K",
        "LIT" => "LI",
        "RUB" => "RB",
        "CES" => "CS",
        "BAR" => "BA",
        "CAD" => "CD",
        stem => stem,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn symbol(name: &str) -> Option<&'static str> {
        of_atom_name(name).map(|element| element.symbol)
    }

    #[test]
    fn names_in_mixed_case_are_symbols() {
        let names = ["Na+", "Cl-", "Fe", "Cu", "Si12", "Ca", "Co2+"];
        assert_eq!(names.map(symbol), ["Na", "Cl", "Fe", "Cu", "Si", "Ca", "Co"].map(Some));
    }

    #[test]
    fn names_in_capitals_are_those_of_molecules_of_life() {
        let names = ["CA", "NA", "CD1", "NE2", "1HB2", "OW", "CAL"];
        assert_eq!(names.map(symbol), ["C", "Na", "C", "N", "H", "O", "Ca"].map(Some));
        // No element, so the first letter tells.
        assert_eq!(["Ow", "Hw1"].map(symbol), ["O", "H"].map(Some));
    }

    #[test]
    fn heavy_hydrogen_is_hydrogen() {
        assert_eq!(["D", "T", "D2A"].map(symbol), [Some("H"), Some("H"), None]);
    }

    #[test]
    fn a_bead_is_no_element() {
        assert_eq!(["W", "W1", "B", "BB", "U"].map(symbol), [None; 5]);
    }
}
