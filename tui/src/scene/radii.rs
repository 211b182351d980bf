//! How large spheres are, where somebody says so.

use super::Scene;
use super::elements::{Element, of_number};
use std::str::FromStr;

/// What radii are.
#[derive(Clone, Debug, PartialEq)]
pub enum RadiusBy {
    /// Van der Waals radii of elements, in angstrom.
    VanDerWaals,
    /// Covalent radii of elements, in angstrom.
    Covalent,
    /// The same for all.
    Number(f32),
    /// A column of numbers, by its name.
    Column(Box<str>),
}

impl FromStr for RadiusBy {
    type Err = &'static str;

    /// Reads `van-der-waals` (`vdw`), `covalent`, a number, or any other word as the name of a column.
    fn from_str(text: &str) -> Result<Self, Self::Err> {
        match text.parse::<f32>() {
            Ok(number) if number.is_finite() && number >= 0.0 => Ok(Self::Number(number)),
            Ok(_) => Err("a radius is finite and not negative"),
            Err(_) => Ok(match text {
                "" => return Err("van-der-waals, covalent, a number, or a column of numbers"),
                "van-der-waals" | "vdw" => Self::VanDerWaals,
                "covalent" => Self::Covalent,
                column => Self::Column(column.into()),
            }),
        }
    }
}

/// Gives the spheres of `scene` these radii. A sphere without a known element keeps its own. One whose number is
/// missing, negative or infinite gets 0 and is not seen.
///
/// # Errors
/// Says what is missing, if the scene does not have the elements or the column.
pub fn set_radii(scene: &mut Scene, by: &RadiusBy) -> Result<(), String> {
    let attributes = scene.attributes();
    let of_elements = |kind: &str, radius: fn(Element) -> f32| {
        let elements = attributes.elements.as_ref();
        let elements = elements
            .ok_or_else(|| format!("this scene has no elements, so there are no {kind} radii"))?;
        let own = scene.spheres();
        let own = |index: usize| own.get(index).map_or(0.0, |sphere| sphere.radius);
        let numbers = elements.iter().enumerate();
        let radii = numbers
            .map(|(index, &number)| of_number(number.into()).map_or_else(|| own(index), radius));
        Ok::<_, String>(radii.collect::<Vec<_>>())
    };
    let radii = match by {
        RadiusBy::VanDerWaals => of_elements("van der Waals", |element| element.radius)?,
        RadiusBy::Covalent => of_elements("covalent", |element| element.covalent_radius)?,
        RadiusBy::Number(number) => vec![*number; scene.spheres().len()],
        RadiusBy::Column(name) => {
            let columns = attributes.columns.iter().map(|column| &*column.name).collect::<Vec<_>>();
            let column = attributes.column(name).ok_or_else(|| match columns[..] {
                [] => format!("this scene has no {name} for radii, and no other column of numbers"),
                _ => format!("this scene has no {name} for radii; it has {}", columns.join(", ")),
            })?;
            let usable = |&value: &f32| if value.is_finite() { value.max(0.0) } else { 0.0 };
            column.values.iter().map(usable).collect()
        }
    };
    scene.resize_spheres(&radii);
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::Srgb;
    use crate::scene::attributes::{Attributes, NumberColumn};
    use spherule_kernel::{SphereList, Vec3};

    fn scene() -> Scene {
        let values = vec![0.5, f32::NAN, -1.0, f32::INFINITY];
        let attributes = Attributes {
            elements: Some(vec![6, 0, 1, 92]),
            columns: vec![NumberColumn { name: "size".into(), values }],
            ..Attributes::default()
        };
        let list = SphereList::from_iter([(Vec3::X, 7.0); 4]);
        Scene::of_spheres(list, vec![Srgb::WHITE; 4], attributes)
    }

    fn radii(by: &str) -> Result<Vec<f32>, String> {
        let mut scene = scene();
        set_radii(&mut scene, &by.parse()?)?;
        assert!(scene.spheres().iter().all(|sphere| sphere.center == Vec3::X));
        Ok(scene.spheres().iter().map(|sphere| sphere.radius).collect())
    }

    #[test]
    fn radii_are_of_elements_a_column_or_all_the_same() {
        assert_eq!(radii("vdw"), Ok(vec![1.70, 7.0, 1.10, 2.71]));
        assert_eq!(radii("van-der-waals"), radii("vdw"));
        assert_eq!(radii("covalent"), Ok(vec![0.76, 7.0, 0.31, 1.96]));
        assert_eq!(radii("0.25"), Ok(vec![0.25; 4]));
        assert_eq!(radii("Size"), Ok(vec![0.5, 0.0, 0.0, 0.0]));
    }

    #[test]
    fn what_is_no_radius_is_said() {
        assert_eq!(radii("mass"), Err("this scene has no mass for radii; it has size".to_owned()));
        for wrong in ["-1", "nan", "inf", ""] {
            assert!(radii(wrong).is_err(), "{wrong}");
        }
        for (by, kind) in
            [(RadiusBy::Covalent, "covalent"), (RadiusBy::VanDerWaals, "van der Waals")]
        {
            let expected = format!("this scene has no elements, so there are no {kind} radii");
            assert_eq!(set_radii(&mut Scene::new(), &by), Err(expected));
        }
    }
}
