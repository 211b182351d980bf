//! The chemical elements: how large an atom is drawn, and in which colour.
//!
//! Radii are van der Waals radii in angstrom. Main group: M. Mantina, A. C. Chamberlin, R. Valero,
//! C. J. Cramer, D. G. Truhlar, "Consistent van der Waals Radii for the Whole Main Group", J.
//! Phys. Chem. A 113, 5806 (2009), which completes A. Bondi, J. Phys. Chem. 68, 441 (1964). The
//! others up to Es: S. Alvarez, "A cartography of the van der Waals territories", Dalton Trans.
//! 42, 8617 (2013). For Pm and from Fm on none is published; they get 2.00.
//!
//! Covalent radii up to Cm: B. Cordero and others, "Covalent radii revisited", Dalton Trans. 2832 (2008); of C that of sp3,
//! of Mn, Fe and Co that of low spin. From Bk on: P. Pyykkö, M. Atsumi, "Molecular Single-Bond Covalent Radii for
//! Elements 1-118", Chem. Eur. J. 15, 186 (2009).
//!
//! Colours are those of Jmol (<https://jmol.sourceforge.net/jscolors/>), an extension of Corey,
//! Pauling and Koltun's; the elements after Mt, which it does not list, get that of Mt.

use crate::color::Srgb;
use std::sync::LazyLock;

/// An element of the periodic table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Element {
    /// The atomic number.
    pub number: u8,
    /// `H`, `He` and so on.
    pub symbol: &'static str,
    /// The van der Waals radius in angstrom.
    pub radius: f32,
    /// The covalent radius in angstrom.
    pub covalent_radius: f32,
    /// The colour of its atoms.
    pub color: Srgb,
}

/// The element that `text` names: a symbol in any case, or an atomic number. D and T are hydrogen, as in structures that
/// are known by neutrons.
#[must_use]
pub fn element(text: &str) -> Option<Element> {
    let named = |element: &&Element| element.symbol.eq_ignore_ascii_case(text);
    match text.parse() {
        Ok(number) => of_number(number),
        Err(_) if ["D", "T"].iter().any(|isotope| isotope.eq_ignore_ascii_case(text)) => {
            of_number(1)
        }
        Err(_) => ELEMENTS.iter().find(named).copied(),
    }
}

/// The element of an atomic number.
#[must_use]
pub fn of_number(number: usize) -> Option<Element> {
    ELEMENTS.get(number.checked_sub(1)?).copied()
}

/// By atomic number, from 1.
static ELEMENTS: LazyLock<Vec<Element>> = LazyLock::new(|| {
    let element = |(index, line): (usize, &'static str)| {
        let mut words = line.split_whitespace();
        let number = u8::try_from(index + 1).ok()?;
        let symbol = words.next()?;
        let (radius, covalent_radius) = (words.next()?.parse().ok()?, words.next()?.parse().ok()?);
        let color = words.next()?.parse().ok()?;
        Some(Element { number, symbol, radius, covalent_radius, color })
    };
    include_str!("elements.txt").lines().enumerate().filter_map(element).collect()
});

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn symbols_in_any_case_and_numbers() {
        let carbon = element("C").expect("carbon");
        assert_eq!((carbon.symbol, carbon.radius, carbon.color), ("C", 1.70, Srgb([0x90; 3])));
        assert_eq!(carbon.covalent_radius, 0.76);
        assert_eq!(element("c"), element("6"));
        assert_eq!(element("cl").map(|e| e.symbol), Some("Cl"));
        assert_eq!(element("CL"), element("17"));
        assert_eq!([element("D"), element("t")], [element("H"); 2]);
        assert_eq!(element("og"), element("118"));
    }

    #[test]
    fn what_is_no_element() {
        for text in ["", "Xx", "0", "119", "-6", "C1", "6.0", "18446744073709551616"] {
            assert_eq!(element(text), None, "{text}");
        }
    }

    #[test]
    fn every_atom_can_be_drawn() {
        for number in 1..=118 {
            let element = element(&number.to_string()).expect("an element");
            assert!(element.radius >= 1.0 && element.radius < 4.0, "{element:?}");
            let covalent = element.covalent_radius;
            assert!(covalent > 0.25 && covalent < 2.7 && covalent < element.radius, "{element:?}");
            assert_ne!(element.color, Srgb::BLACK);
        }
    }
}
