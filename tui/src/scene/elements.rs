//! The chemical elements: how large an atom is drawn, and in which colour.
//!
//! Radii are van der Waals radii in angstrom. Main group: M. Mantina, A. C. Chamberlin, R. Valero,
//! C. J. Cramer, D. G. Truhlar, "Consistent van der Waals Radii for the Whole Main Group", J.
//! Phys. Chem. A 113, 5806 (2009), which completes A. Bondi, J. Phys. Chem. 68, 441 (1964). The
//! others up to Es: S. Alvarez, "A cartography of the van der Waals territories", Dalton Trans.
//! 42, 8617 (2013). For Pm and from Fm on none is published; they get 2.00.
//!
//! Colours are those of Jmol (<https://jmol.sourceforge.net/jscolors/>), an extension of Corey,
//! Pauling and Koltun's; the elements after Mt, which it does not list, get that of Mt.

use crate::color::Srgb;

/// An element of the periodic table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Element {
    /// `H`, `He` and so on.
    pub symbol: &'static str,
    /// The van der Waals radius in angstrom.
    pub radius: f32,
    /// The colour of its atoms.
    pub color: Srgb,
}

/// The element that `text` names: a symbol in any case, or an atomic number.
#[must_use]
pub fn element(text: &str) -> Option<Element> {
    let index = match text.parse::<usize>() {
        Ok(number) => number.checked_sub(1)?,
        Err(_) => TABLE.iter().position(|row| row.0.eq_ignore_ascii_case(text))?,
    };
    let &(symbol, radius, color) = TABLE.get(index)?;
    let color = Srgb([(color >> 16) as u8, (color >> 8) as u8, color as u8]);
    Some(Element { symbol, radius, color })
}

/// Symbol, radius, colour; by atomic number, from 1.
#[rustfmt::skip]
#[allow(clippy::unreadable_literal, reason = "colours are read as rrggbb")]
const TABLE: [(&str, f32, u32); 118] = [
    ("H", 1.10, 0xffffff),
    ("He", 1.40, 0xd9ffff),
    ("Li", 1.81, 0xcc80ff),
    ("Be", 1.53, 0xc2ff00),
    ("B", 1.92, 0xffb5b5),
    ("C", 1.70, 0x909090),
    ("N", 1.55, 0x3050f8),
    ("O", 1.52, 0xff0d0d),
    ("F", 1.47, 0x90e050),
    ("Ne", 1.54, 0xb3e3f5),
    ("Na", 2.27, 0xab5cf2),
    ("Mg", 1.73, 0x8aff00),
    ("Al", 1.84, 0xbfa6a6),
    ("Si", 2.10, 0xf0c8a0),
    ("P", 1.80, 0xff8000),
    ("S", 1.80, 0xffff30),
    ("Cl", 1.75, 0x1ff01f),
    ("Ar", 1.88, 0x80d1e3),
    ("K", 2.75, 0x8f40d4),
    ("Ca", 2.31, 0x3dff00),
    ("Sc", 2.58, 0xe6e6e6),
    ("Ti", 2.46, 0xbfc2c7),
    ("V", 2.42, 0xa6a6ab),
    ("Cr", 2.45, 0x8a99c7),
    ("Mn", 2.45, 0x9c7ac7),
    ("Fe", 2.44, 0xe06633),
    ("Co", 2.40, 0xf090a0),
    ("Ni", 2.40, 0x50d050),
    ("Cu", 2.38, 0xc88033),
    ("Zn", 2.39, 0x7d80b0),
    ("Ga", 1.87, 0xc28f8f),
    ("Ge", 2.11, 0x668f8f),
    ("As", 1.85, 0xbd80e3),
    ("Se", 1.90, 0xffa100),
    ("Br", 1.83, 0xa62929),
    ("Kr", 2.02, 0x5cb8d1),
    ("Rb", 3.03, 0x702eb0),
    ("Sr", 2.49, 0x00ff00),
    ("Y", 2.75, 0x94ffff),
    ("Zr", 2.52, 0x94e0e0),
    ("Nb", 2.56, 0x73c2c9),
    ("Mo", 2.45, 0x54b5b5),
    ("Tc", 2.44, 0x3b9e9e),
    ("Ru", 2.46, 0x248f8f),
    ("Rh", 2.44, 0x0a7d8c),
    ("Pd", 2.15, 0x006985),
    ("Ag", 2.53, 0xc0c0c0),
    ("Cd", 2.49, 0xffd98f),
    ("In", 1.93, 0xa67573),
    ("Sn", 2.17, 0x668080),
    ("Sb", 2.06, 0x9e63b5),
    ("Te", 2.06, 0xd47a00),
    ("I", 1.98, 0x940094),
    ("Xe", 2.16, 0x429eb0),
    ("Cs", 3.43, 0x57178f),
    ("Ba", 2.68, 0x00c900),
    ("La", 2.98, 0x70d4ff),
    ("Ce", 2.88, 0xffffc7),
    ("Pr", 2.92, 0xd9ffc7),
    ("Nd", 2.95, 0xc7ffc7),
    ("Pm", 2.00, 0xa3ffc7),
    ("Sm", 2.90, 0x8fffc7),
    ("Eu", 2.87, 0x61ffc7),
    ("Gd", 2.83, 0x45ffc7),
    ("Tb", 2.79, 0x30ffc7),
    ("Dy", 2.87, 0x1fffc7),
    ("Ho", 2.81, 0x00ff9c),
    ("Er", 2.83, 0x00e675),
    ("Tm", 2.79, 0x00d452),
    ("Yb", 2.80, 0x00bf38),
    ("Lu", 2.74, 0x00ab24),
    ("Hf", 2.63, 0x4dc2ff),
    ("Ta", 2.53, 0x4da6ff),
    ("W", 2.57, 0x2194d6),
    ("Re", 2.49, 0x267dab),
    ("Os", 2.48, 0x266696),
    ("Ir", 2.41, 0x175487),
    ("Pt", 2.29, 0xd0d0e0),
    ("Au", 2.32, 0xffd123),
    ("Hg", 2.45, 0xb8b8d0),
    ("Tl", 1.96, 0xa6544d),
    ("Pb", 2.02, 0x575961),
    ("Bi", 2.07, 0x9e4fb5),
    ("Po", 1.97, 0xab5c00),
    ("At", 2.02, 0x754f45),
    ("Rn", 2.20, 0x428296),
    ("Fr", 3.48, 0x420066),
    ("Ra", 2.83, 0x007d00),
    ("Ac", 2.80, 0x70abfa),
    ("Th", 2.93, 0x00baff),
    ("Pa", 2.88, 0x00a1ff),
    ("U", 2.71, 0x008fff),
    ("Np", 2.82, 0x0080ff),
    ("Pu", 2.81, 0x006bff),
    ("Am", 2.83, 0x545cf2),
    ("Cm", 3.05, 0x785ce3),
    ("Bk", 3.40, 0x8a4fe3),
    ("Cf", 3.05, 0xa136d4),
    ("Es", 2.70, 0xb31fd4),
    ("Fm", 2.00, 0xb31fba),
    ("Md", 2.00, 0xb30da6),
    ("No", 2.00, 0xbd0d87),
    ("Lr", 2.00, 0xc70066),
    ("Rf", 2.00, 0xcc0059),
    ("Db", 2.00, 0xd1004f),
    ("Sg", 2.00, 0xd90045),
    ("Bh", 2.00, 0xe00038),
    ("Hs", 2.00, 0xe6002e),
    ("Mt", 2.00, 0xeb0026),
    ("Ds", 2.00, 0xeb0026),
    ("Rg", 2.00, 0xeb0026),
    ("Cn", 2.00, 0xeb0026),
    ("Nh", 2.00, 0xeb0026),
    ("Fl", 2.00, 0xeb0026),
    ("Mc", 2.00, 0xeb0026),
    ("Lv", 2.00, 0xeb0026),
    ("Ts", 2.00, 0xeb0026),
    ("Og", 2.00, 0xeb0026),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn symbols_in_any_case_and_numbers() {
        let carbon = element("C").expect("carbon");
        assert_eq!((carbon.symbol, carbon.radius, carbon.color), ("C", 1.70, Srgb([0x90; 3])));
        assert_eq!(element("c"), element("6"));
        assert_eq!(element("cl").map(|e| e.symbol), Some("Cl"));
        assert_eq!(element("CL"), element("17"));
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
            assert_ne!(element.color, Srgb::BLACK);
        }
    }
}
