//! What is behind the spheres of a scene that does not say so itself.

use crate::color::{Srgb, oklab};
use crate::scene::Scene;

/// A sphere without light that is no farther than this from the colour behind it, in `OKLab`, is lost there. (White paper of Solarized is
/// 0.04 from white, a light grey 0.05, sand 0.09.)
const LOST: f32 = 0.08;

/// Gives a scene that names no background the user's.
pub(super) fn paint(scene: &mut Scene, background: Option<Srgb>) {
    if let Some(background) = background.filter(|_| !scene.names_background) {
        scene.background = background;
    }
}

/// Whether half of the spheres or more can be seen before `background`: by their colour, or because they are lit.
pub(super) fn sets_off(background: Srgb, scene: &Scene) -> bool {
    if !scene.lighting.is_plain() {
        return true;
    }
    let (look, colors) = (oklab(background.to_linear()), scene.colors());
    let is_seen = |color: &&Srgb| oklab(color.to_linear()).distance(look) > LOST;
    2 * colors.iter().filter(is_seen).count() >= colors.len()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Lighting;
    use spherule_kernel::{Sphere, Vec3};

    #[test]
    fn spheres_without_light_are_not_lost_in_their_background() {
        let mut scene = Scene::new();
        let sphere = Sphere { center: Vec3::ZERO, radius: 1.0 };
        scene.push(sphere, Srgb::WHITE, None);
        let [solarized, sand] = [Srgb([0xfd, 0xf6, 0xe3]), Srgb([0xf0, 0xe0, 0xd0])];
        for (background, expected) in
            [(Srgb::WHITE, false), (solarized, false), (sand, true), (Srgb::BLACK, true)]
        {
            assert_eq!(sets_off(background, &scene), expected, "{background:?}");
        }
        scene.push(sphere, Srgb::BLACK, None);
        assert!(sets_off(Srgb::WHITE, &scene) && sets_off(Srgb::BLACK, &scene));
        scene.push(sphere, Srgb::WHITE, None);
        assert!(!sets_off(Srgb::WHITE, &scene) && sets_off(Srgb::BLACK, &scene));
        scene.lighting = Lighting::Camera;
        assert!(sets_off(Srgb::WHITE, &scene));
    }
}
