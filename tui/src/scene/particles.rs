//! The particles of a frame, as a file states them, and the scene that they become.
//!
//! The element of particles is looked up once per name, not once per particle. A particle with neither an element nor a
//! radius of its own is as large as particles are apart, or, beside elements, as a small atom, and as large in all frames.

use super::attributes::{Attributes, Names, NamesBuilder, Naming, NumberColumn, Own};
use super::elements::of_number;
use super::fixed::Fixed;
use super::notes::Notes;
use super::origin::{FIRST, origin};
use super::read_error::ReadError;
use super::spacing::half_spacing;
use super::symbols::{Symbols, resolved};
use super::type_colors::type_color;
use super::{Lighting, Scene};
use crate::color::Srgb;
use glam::DVec3;
use spherule_kernel::{Sphere, Vec3};

/// What is behind particles.
const BACKGROUND: Srgb = Srgb([0x10, 0x12, 0x1a]);

/// The colour of particles of which nothing is known.
pub(super) const NEUTRAL: Srgb = Srgb([0xa8, 0xa8, 0xa8]);

/// In angstrom; the radius of an unknown particle beside atoms.
const UNKNOWN_RADIUS: f32 = 1.2;

/// The radius of particles that nothing is apart from.
const LONE_RADIUS: f32 = 1.0;

/// The particles of a frame. What is not empty has a value a particle.
#[derive(Debug, Default)]
pub(super) struct Particles {
    /// Counted from the origin, once that is fixed.
    pub(super) centers: Vec<Vec3>,
    pub(super) fixed: Fixed,
    /// The first centres, which tell the origin, in the file's coordinates.
    pub(super) first: Vec<DVec3>,
    /// NaN where there is none.
    pub(super) radii: Vec<f32>,
    pub(super) colors: Vec<Srgb>,
    /// What tells the element.
    pub(super) kinds: NamesBuilder,
    pub(super) symbols: Symbols,
    /// The lines in which names of `kinds` first occur.
    pub(super) lines: Vec<usize>,
    /// By [`Naming`].
    pub(super) names: [NamesBuilder; Naming::ALL.len()],
    pub(super) residue_numbers: Vec<i32>,
    pub(super) columns: Vec<NumberColumn>,
}

impl Particles {
    /// No particles yet, of a file of which frames before have `fixed` something.
    pub(super) fn from(fixed: Fixed) -> Self {
        Self { fixed, ..Self::default() }
    }

    /// Whether there are no particles.
    pub(super) fn is_empty(&self) -> bool {
        self.centers.is_empty() && self.first.is_empty()
    }

    /// Adds the centre of the next particle, in the file's coordinates.
    #[inline]
    pub(super) fn center(&mut self, center: DVec3) {
        match self.fixed.origin {
            Some(origin) => self.centers.push((center - origin).as_vec3()),
            None => self.first_center(center),
        }
    }

    /// Adds the next particle, and its radius if all have one.
    ///
    /// # Errors
    /// What is wrong with a number of these in single precision.
    #[inline]
    pub(super) fn sphere(&mut self, center: DVec3, radius: Option<f64>) -> Result<(), String> {
        if !center.as_vec3().is_finite() {
            return Err(format!("is at {center}, which is not finite in single precision"));
        }
        self.center(center);
        if let Some(radius) = radius.map(|radius| radius as f32) {
            if !(radius.is_finite() && radius >= 0.0) {
                return Err(format!("has the radius {radius}"));
            }
            self.radii.push(radius);
        }
        Ok(())
    }

    #[cold]
    fn first_center(&mut self, center: DVec3) {
        self.first.push(center);
        if self.first.len() == FIRST {
            self.settle();
        }
    }

    /// Fixes the origin of positions from now on, and returns it.
    fn settle(&mut self) -> DVec3 {
        let first = std::mem::take(&mut self.first);
        let origin = *self.fixed.origin.get_or_insert_with(|| origin(&first, &self.radii));
        self.centers.extend(first.into_iter().map(|center| (center - origin).as_vec3()));
        origin
    }

    /// Adds what tells the element of the next particle, which is in `line`.
    #[inline]
    pub(super) fn kind(&mut self, name: &[u8], line: usize) {
        self.kinds.push(name);
        if self.kinds.known() > self.lines.len() {
            self.lines.push(line);
        }
    }

    /// Changes what tells the element of particle `index`, by what `line` says.
    pub(super) fn rename_kind(&mut self, index: usize, name: &[u8], line: usize) {
        self.kinds.rename(index, name);
        if self.kinds.known() > self.lines.len() {
            self.lines.push(line);
        }
    }

    /// The names of one kind.
    #[inline]
    pub(super) fn naming(&mut self, naming: Naming) -> &mut NamesBuilder {
        &mut self.names[naming as usize]
    }

    /// Brings the particles into the order of `keys`, one a particle.
    pub(super) fn sort_by(&mut self, keys: &[i64]) {
        self.settle();
        if keys.is_sorted() {
            return;
        }
        let mut order: Vec<u32> = (0..keys.len() as u32).collect();
        order.sort_by_key(|&index| keys[index as usize]);
        permute(&mut self.centers, &order);
        permute(&mut self.radii, &order);
        permute(&mut self.colors, &order);
        permute(&mut self.residue_numbers, &order);
        for column in &mut self.columns {
            permute(&mut column.values, &order);
        }
        for names in &mut self.names {
            names.permute(|indices| permute(indices, &order));
        }
        let former = self.kinds.permute(|indices| permute(indices, &order));
        let line = |&kind: &u32| self.lines.get(kind as usize).copied();
        self.lines = former.iter().filter_map(line).collect();
    }

    /// The scene. `source` is the file in errors.
    ///
    /// # Errors
    /// [`ReadError`] if there is no particle, or one of an unknown type where `notes` are strict.
    pub(super) fn finish(mut self, notes: &mut Notes, source: &str) -> Result<Scene, ReadError> {
        let origin = self.settle();
        let (count, symbols) = (self.centers.len(), self.symbols);
        let kinds = self.kinds.finish();
        let known = kinds.as_ref().map_or_else(Vec::new, |kinds| resolved(kinds, symbols));
        let number_of = |index: usize| -> u8 {
            kinds.as_ref().map_or(0, |kinds| known[kinds.indices()[index] as usize])
        };
        let has_elements = known.iter().any(|&number| number > 0);
        let own = Own { colors: !self.colors.is_empty(), radii: !self.radii.is_empty() };
        if let Some(kinds) = &kinds
            && symbols != Symbols::Numbers
            && !(own.colors && own.radii)
        {
            note_unknown(kinds, &known, &self.lines, notes, source)?;
        }

        if !own.colors {
            self.colors = match &kinds {
                None => vec![NEUTRAL; count],
                Some(kinds) => {
                    // The colour is looked up once per kind, not once per atom.
                    let color = |kind: usize| match of_number(known[kind].into()) {
                        Some(element) => element.color,
                        None if symbols == Symbols::Numbers => {
                            type_color(kind, &kinds.table()[kind])
                        }
                        None => NEUTRAL,
                    };
                    let by_kind: Vec<Srgb> = (0..known.len()).map(color).collect();
                    kinds.indices().iter().map(|&kind| by_kind[kind as usize]).collect()
                }
            };
        }
        let told = self.fixed.radius.or_else(|| match has_elements {
            true => Some(UNKNOWN_RADIUS),
            false => half_spacing(&self.centers),
        });
        let unstated = told.unwrap_or(LONE_RADIUS);
        let radius_of_number: Vec<Option<f32>> = (0..=u8::MAX)
            .map(|number| of_number(number.into()).map(|element| element.radius))
            .collect();
        let mut has_unstated = false;
        let mut radius = |index: usize| match self.radii.get(index) {
            Some(radius) if !radius.is_nan() => *radius,
            _ => radius_of_number[usize::from(number_of(index))].unwrap_or_else(|| {
                has_unstated = true;
                unstated
            }),
        };
        let list = self.centers.iter().enumerate();
        let list = list.map(|(index, &center)| Sphere { center, radius: radius(index) }).collect();

        self.columns.retain(|column| column.values.len() == count);
        let mut attributes = Attributes { columns: self.columns, own, ..Attributes::default() };
        attributes.elements = has_elements.then(|| (0..count).map(number_of).collect());
        attributes.residue_numbers =
            (self.residue_numbers.len() == count && count > 0).then_some(self.residue_numbers);
        for (naming, builder) in Naming::ALL.into_iter().zip(self.names) {
            attributes.set_names(naming, builder.finish());
        }
        if attributes.names(Naming::Type).is_none() && attributes.names(Naming::Name).is_none() {
            attributes.set_names(Naming::Type, kinds);
        }
        let mut scene = Scene::of_spheres(list, self.colors, attributes);
        scene.origin = origin;
        scene.unstated_radius = told.filter(|_| has_unstated);
        scene.background = BACKGROUND;
        scene.lighting = Lighting::Camera;
        Ok(scene)
    }
}

fn permute<T: Copy>(values: &mut Vec<T>, order: &[u32]) {
    if values.len() == order.len() {
        *values = order.iter().map(|&index| values[index as usize]).collect();
    }
}

fn note_unknown(
    kinds: &Names,
    known: &[u8],
    lines: &[usize],
    notes: &mut Notes,
    source: &str,
) -> Result<(), ReadError> {
    let is_unknown = |kind: usize| known[kind] == 0 && !kinds.table()[kind].is_empty();
    let unknown: Vec<usize> = (0..known.len()).filter(|&kind| is_unknown(kind)).collect();
    if unknown.is_empty() {
        return Ok(());
    }
    let count = kinds.indices().iter().filter(|&&kind| is_unknown(kind as usize)).count();
    let names: Vec<&str> = unknown.iter().map(|&kind| &*kinds.table()[kind]).collect();
    notes.unknown(source, lines.get(unknown[0]).copied().unwrap_or(1), count, &names)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The origin of so many particles around one point, and one at zero.
    fn origin_of(around: usize) -> DVec3 {
        let mut particles = Particles::default();
        for index in 0..around {
            particles.center(DVec3::new(1e6 + index as f64, 0.0, 0.0));
        }
        particles.center(DVec3::ZERO);
        let scene = particles.finish(&mut Notes::default(), "").expect("a scene");
        assert_eq!(
            scene.origin.x + f64::from(scene.spheres().get(1).expect("two").center.x),
            1e6 + 1.0
        );
        scene.origin
    }

    #[test]
    fn sixteen_tell_whether_all_are_far_from_zero() {
        assert_eq!(origin_of(FIRST - 1), DVec3::ZERO);
        assert_eq!(origin_of(FIRST), DVec3::new(1e6, 0.0, 0.0));
        assert_eq!(FIRST, 16);
    }
}
