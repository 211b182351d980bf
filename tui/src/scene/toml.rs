//! Scenes in TOML: the format is stated in `docs/program.md` and, by example, in the tests below.

mod limits;
mod projection;
mod table;

use super::origin::{FIRST, origin};
use super::read_error::ReadError;
use super::{Light, Lighting, Scene, Source};
use crate::color::Srgb;
use crate::view::{Lens, LensKind, View};
use glam::DVec3;
use projection::projection;
use serde::Deserialize;
use serde::de::value::SeqAccessDeserializer;
use serde::de::{Deserializer, Error, SeqAccess, Unexpected, Visitor};
use spherule_kernel::{Sphere, Vec3};
use std::fmt;
use std::ops::Range;
use table::Table;
use toml::Spanned;

/// A number and its place in the file.
type Number = Spanned<f64>;
/// Three numbers, if it is right: from a longer array serde would take the first three.
type Vector = Spanned<Vec<Number>>;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SceneTable {
    background: Option<Spanned<String>>,
    #[serde(default)]
    shadows: bool,
    camera: Option<Spanned<Table<CameraTable>>>,
    #[serde(default)]
    sphere: Vec<Table<SphereTable>>,
    #[serde(default)]
    light: LightEntry,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct CameraTable {
    eye: Vector,
    target: Vector,
    up: Option<Vector>,
    #[serde(default, deserialize_with = "projection")]
    projection: LensKind,
    fov: Option<Number>,
    height: Option<Number>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SphereTable {
    center: Vector,
    radius: Number,
    color: Option<Spanned<String>>,
    label: Option<String>,
}

/// What `light` is: tables, or the word for the lights that go with the eye. TOML does not allow both.
enum LightEntry {
    Tables(Vec<Spanned<Table<LightTable>>>),
    Camera,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct LightTable {
    direction: Option<Vector>,
    position: Option<Vector>,
    color: Option<Spanned<String>>,
}

impl Default for LightEntry {
    fn default() -> Self {
        Self::Tables(Vec::new())
    }
}

/// Written by hand: for an untagged enum serde says no more than that nothing matched.
impl<'de> Deserialize<'de> for LightEntry {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(LightVisitor)
    }
}

struct LightVisitor;

impl<'de> Visitor<'de> for LightVisitor {
    type Value = LightEntry;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("\"camera\" or tables [[light]]")
    }

    fn visit_str<E: Error>(self, word: &str) -> Result<LightEntry, E> {
        match word {
            "camera" => Ok(LightEntry::Camera),
            _ => Err(E::invalid_value(Unexpected::Str(word), &self)),
        }
    }

    fn visit_seq<A: SeqAccess<'de>>(self, tables: A) -> Result<LightEntry, A::Error> {
        Vec::deserialize(SeqAccessDeserializer::new(tables)).map(LightEntry::Tables)
    }
}

/// The field of view of a camera that states none, in degrees.
const USUAL_FOV: f32 = 40.0;

/// Reads the scene that `text` describes; `source` is its name in errors.
///
/// # Errors
/// [`ReadError`], if it can be with line and column: beyond the limits, no TOML, an unknown key, a wrong type, a number that is
/// not a finite `f32`, a negative radius, a vector without a direction, a colour that is none, a
/// camera that cannot see, no sphere.
pub fn read(text: &str, source: &str) -> Result<Scene, ReadError> {
    limits::check(text).map_err(|(byte, what)| ReadError::in_text(source, text, byte, what))?;
    let table: SceneTable = toml::from_str(text).map_err(|error| {
        let mut message = error.message().lines().map(str::trim).collect::<Vec<_>>().join(", ");
        let span = error.span().unwrap_or(0..0);
        if message == "duplicate key"
            && let Some(key) = text.get(span.clone())
        {
            message = format!("{message} `{key}`");
        }
        ReadError::in_text(source, text, span.start, message)
    })?;
    let first = &table.sphere[..table.sphere.len().min(FIRST)];
    let centers: Vec<_> = first.iter().map(|Table(sphere)| double(&sphere.center)).collect();
    let radii: Vec<_> = first.iter().map(|Table(sphere)| *sphere.radius.get_ref() as f32).collect();
    scene(table, &Place { text, source, origin: origin(&centers, &radii) })
}

/// The vector in double precision, whose missing numbers are zero until it is refused.
fn double(vector: &Vector) -> DVec3 {
    let number = |axis: usize| vector.get_ref().get(axis).map_or(0.0, |number| *number.get_ref());
    DVec3::new(number(0), number(1), number(2))
}

/// Turns places in the text into errors, and numbers that stand there into those of the scene.
struct Place<'a> {
    text: &'a str,
    source: &'a str,
    /// Where positions are taken from.
    origin: DVec3,
}

impl Place<'_> {
    fn error(&self, span: Range<usize>, what: impl Into<String>) -> ReadError {
        ReadError::in_text(self.source, self.text, span.start, what)
    }

    fn number(&self, number: &Number, name: &str) -> Result<f32, ReadError> {
        let single = *number.get_ref() as f32;
        if single.is_finite() {
            return Ok(single);
        }
        let what =
            format!("{name} is {}, which is not finite in single precision", number.get_ref());
        Err(self.error(number.span(), what))
    }

    fn vector(&self, vector: &Vector, name: &str) -> Result<Vec3, ReadError> {
        let [x, y, z] = vector.get_ref().as_slice() else {
            let what = format!("{name} is an array of {}, not of 3", vector.get_ref().len());
            return Err(self.error(vector.span(), what));
        };
        let number = |number| self.number(number, name);
        Ok(Vec3::new(number(x)?, number(y)?, number(z)?))
    }

    fn position(&self, vector: &Vector, name: &str) -> Result<Vec3, ReadError> {
        self.vector(vector, name)?;
        Ok((double(vector) - self.origin).as_vec3())
    }

    fn direction(&self, vector: &Vector, name: &str) -> Result<Vec3, ReadError> {
        let direction = self.vector(vector, name)?;
        // Neither its square nor that square's inverse may leave the range of numbers.
        if (1e-15..1e15).contains(&direction.abs().max_element()) {
            return Ok(direction);
        }
        let what = format!("{name} has no direction: it is too short or too long");
        Err(self.error(vector.span(), what))
    }

    fn color(&self, color: Option<&Spanned<String>>, default: Srgb) -> Result<Srgb, ReadError> {
        color.map_or(Ok(default), |color| {
            color.get_ref().parse().map_err(|what: String| self.error(color.span(), what))
        })
    }
}

fn scene(table: SceneTable, place: &Place<'_>) -> Result<Scene, ReadError> {
    let mut scene = Scene::new();
    scene.origin = place.origin;
    scene.background = place.color(table.background.as_ref(), Srgb::BLACK)?;
    scene.names_background = table.background.is_some();
    scene.shadows = table.shadows;
    scene.view = table.camera.map(|camera| view(&camera, place)).transpose()?;
    for Table(sphere) in &table.sphere {
        let center = place.position(&sphere.center, "center")?;
        let radius = place.number(&sphere.radius, "radius")?;
        if radius < 0.0 {
            let what = format!("radius is {}, which is negative", sphere.radius.get_ref());
            return Err(place.error(sphere.radius.span(), what));
        }
        let color = place.color(sphere.color.as_ref(), Srgb::WHITE)?;
        scene.push(Sphere { center, radius }, color, sphere.label.as_deref());
    }
    if table.sphere.is_empty() {
        let what = "the scene is empty; it needs at least one [[sphere]]";
        return Err(ReadError::whole(place.source, what));
    }
    scene.lighting = match table.light {
        LightEntry::Camera => Lighting::Camera,
        LightEntry::Tables(tables) if tables.is_empty() => Lighting::Plain,
        LightEntry::Tables(tables) => {
            let lights: Result<Vec<_>, _> =
                tables.iter().map(|table| light(table, place)).collect();
            Lighting::World(lights?)
        }
    };
    Ok(scene)
}

fn light(table: &Spanned<Table<LightTable>>, place: &Place<'_>) -> Result<Light, ReadError> {
    let Table(LightTable { direction, position, color }) = table.get_ref();
    let source = match (direction, position) {
        (Some(direction), None) => Source::Direction(place.direction(direction, "direction")?),
        (None, Some(position)) => Source::Position(place.position(position, "position")?),
        _ => {
            let what = "a light has a direction or a position, one of the two";
            return Err(place.error(table.span(), what));
        }
    };
    Ok(Light { source, color: place.color(color.as_ref(), Srgb::WHITE)? })
}

fn view(table: &Spanned<Table<CameraTable>>, place: &Place<'_>) -> Result<View, ReadError> {
    let Table(camera) = table.get_ref();
    let eye = place.position(&camera.eye, "eye")?;
    let target = place.position(&camera.target, "target")?;
    let up = match &camera.up {
        Some(up) => place.direction(up, "up")?,
        None => Vec3::Y,
    };
    if eye == target {
        return Err(place.error(camera.target.span(), "the camera's target is its eye"));
    }
    Ok(View { eye, target, up, lens: lens(table, place)? })
}

fn lens(table: &Spanned<Table<CameraTable>>, place: &Place<'_>) -> Result<Lens, ReadError> {
    let Table(camera) = table.get_ref();
    let in_vain = |number: &Number, what| Err(place.error(number.span(), what));
    match (camera.projection, &camera.fov, &camera.height) {
        (LensKind::Perspective, _, Some(height)) => {
            in_vain(height, "height is for projection = \"parallel\"; perspective has fov")
        }
        (LensKind::Parallel, Some(fov), _) => {
            in_vain(fov, "fov is for projection = \"perspective\"; parallel has height")
        }
        (LensKind::Perspective, None, None) => Ok(Lens::Perspective { fov: USUAL_FOV }),
        (LensKind::Perspective, Some(number), None) => match place.number(number, "fov")? {
            fov if fov > 0.0 && fov < 180.0 => Ok(Lens::Perspective { fov }),
            fov => {
                in_vain(number, &format!("fov is {fov}; it must be above 0 and below 180 degrees"))
            }
        },
        (LensKind::Parallel, None, Some(number)) => match place.number(number, "height")? {
            height if height > 0.0 => Ok(Lens::Parallel { height }),
            height => in_vain(number, &format!("height is {height}; it must be above 0")),
        },
        (LensKind::Parallel, None, None) => {
            Err(place.error(table.span(), "a parallel camera has a height"))
        }
    }
}

#[cfg(test)]
mod tests;
