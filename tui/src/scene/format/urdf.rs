//! A robot in URDF whose links are spheres, as planners approximate them: every `<sphere>` of a `<collision>`, or of a
//! `<visual>` where no link has a collision sphere, with all joints at zero.
//!
//! Frames are chained from the root by the `origin` of joints, in double precision. Specification:
//! <https://wiki.ros.org/urdf/XML>.

mod joints;
mod limits;

use crate::scene::Scene;
use crate::scene::attributes::Naming;
use crate::scene::input::Input;
use crate::scene::notes::Notes;
use crate::scene::particles::Particles;
use crate::scene::read_error::ReadError;
use crate::scene::symbols::Symbols;
use glam::{DAffine3, DQuat, DVec3};
use joints::Joints;
use roxmltree::{Document, Node, ParsingOptions};

/// The longest name of a link, in bytes: each of its spheres is found by it.
const LONGEST_NAME: usize = 1024;

/// Reads the robot.
///
/// # Errors
/// [`ReadError`] if it is no XML, beyond its limits, has no spheres, a joint in a circle, or a number that is none.
pub(super) fn read(input: &mut Input, notes: &mut Notes) -> Result<Scene, ReadError> {
    let text = &input.text()?;
    let source = input.source();
    limits::check(text).map_err(|(byte, what)| ReadError::in_text(source, text, byte, what))?;
    let options = ParsingOptions { nodes_limit: 1 << 22, ..ParsingOptions::default() };
    let document = Document::parse_with_options(text, options).map_err(|error| {
        let place = error.pos();
        ReadError::at(source, place.row as usize, place.col as usize, error.to_string())
    })?;
    let robot = document.root_element();
    let wrong = |node: Node<'_, '_>, what: String| {
        ReadError::in_text(source, text, node.range().start, what)
    };
    if robot.tag_name().name() != "robot" {
        let name = robot.tag_name().name();
        return Err(wrong(robot, format!("the root is <{name}>, not <robot>")));
    }
    let origin = |node: Node<'_, '_>| -> Result<DAffine3, ReadError> {
        let Some(origin) = child(node, "origin") else { return Ok(DAffine3::IDENTITY) };
        let three = |name| match origin.attribute(name) {
            None => Ok(DVec3::ZERO),
            Some(text) => vector(text).ok_or_else(|| {
                wrong(origin, format!("{name} is {text:?}, which is not three numbers"))
            }),
        };
        let angles = three("rpy")?;
        // Roll about x, then pitch about y, then yaw about z, all fixed.
        let turn = DQuat::from_rotation_z(angles.z)
            * DQuat::from_rotation_y(angles.y)
            * DQuat::from_rotation_x(angles.x);
        Ok(DAffine3::from_rotation_translation(turn, three("xyz")?))
    };

    // Every link has at most one joint above it.
    let mut joints = Joints::default();
    for joint in robot.children().filter(|node| node.has_tag_name("joint")) {
        let link = |name| child(joint, name).and_then(|node| node.attribute("link"));
        let (Some(parent), Some(below)) = (link("parent"), link("child")) else {
            // A joint of a transmission has neither.
            continue;
        };
        if !joints.add(parent, below, origin(joint)?) {
            return Err(wrong(joint, format!("the link {below:?} has two joints above it")));
        }
    }

    for kind in ["collision", "visual"] {
        let mut particles = Particles { symbols: Symbols::Numbers, ..Particles::default() };
        let mut others = 0;
        for link in robot.children().filter(|node| node.has_tag_name("link")) {
            let name = link.attribute("name").unwrap_or_default();
            if name.len() > LONGEST_NAME {
                let what = format!("a link whose name has more than {LONGEST_NAME} bytes");
                return Err(wrong(link, what));
            }
            let Some(transform) = joints.place(name) else {
                return Err(wrong(link, format!("the link {name:?} hangs on itself")));
            };
            for part in link.children().filter(|node| node.has_tag_name(kind)) {
                let Some(geometry) = child(part, "geometry") else { continue };
                let Some(sphere) = child(geometry, "sphere") else {
                    others += 1;
                    continue;
                };
                let text = sphere.attribute("radius").unwrap_or_default();
                let radius = text.trim().parse::<f64>().map_or(f32::NAN, |radius| radius as f32);
                if !(radius.is_finite() && radius >= 0.0) {
                    let what = format!("radius is {text:?}, which is not a number of zero or more");
                    return Err(wrong(sphere, what));
                }
                let center = (transform * origin(part)?).translation;
                if !center.as_vec3().is_finite() {
                    let what =
                        format!("a sphere is at {center}, which is not finite in single precision");
                    return Err(wrong(sphere, what));
                }
                particles.center(center);
                particles.radii.push(radius);
                particles.kind(name.as_bytes(), 1);
                particles.naming(Naming::Molecule).push(name.as_bytes());
            }
        }
        if !particles.is_empty() {
            match others {
                0 => {}
                1 => notes.note("1 shape that is not a sphere is ignored"),
                _ => notes.note(format!("{others} shapes that are not spheres are ignored")),
            }
            return particles.finish(notes, source);
        }
    }
    Err(ReadError::whole(source, "a robot without spheres"))
}

fn child<'a, 'i>(node: Node<'a, 'i>, name: &str) -> Option<Node<'a, 'i>> {
    node.children().find(|child| child.has_tag_name(name))
}

fn vector(text: &str) -> Option<DVec3> {
    let values: Result<Vec<f64>, _> = text.split_whitespace().map(str::parse).collect();
    <[f64; 3]>::try_from(values.ok()?).ok().map(DVec3::from_array)
}
