//! Scenes that the program does not have, in files for it: a dark one, and one like noise.

use spherule_referee::random::Random;

/// A scene in a file of `tests/cases`.
#[derive(Clone, Copy, Debug)]
pub struct Kept {
    /// The name. The file is called the same, with `.toml`.
    pub name: &'static str,
    /// The text of the file.
    pub text: fn() -> String,
}

/// All of them.
pub const KEPT: [Kept; 2] =
    [Kept { name: "night", text: night }, Kept { name: "confetti", text: confetti }];

impl Kept {
    /// The path of the file.
    #[must_use]
    pub fn path(&self) -> String {
        format!("{}/cases/{}.toml", env!("CARGO_MANIFEST_DIR"), self.name)
    }
}

/// 300 small balls that lie on dark ground under a faint light.
fn night() -> String {
    let mut random = Random::new(25, 0);
    let mut text = String::from(
        "# A night: 300 small balls on dark ground. Written by `cargo test -p spherule-tests -- --ignored pin_scenes`.\n\
         background = \"#05070d\"\n\
         shadows = true\n\
         light = [\n    { direction = [-0.6, 0.7, 0.5], color = \"#6a7490\" },\n    \
         { direction = [0.9, 0.4, 0.3], color = \"#1c1610\" },\n]\n\
         sphere = [\n    { center = [0, -1000, 0], radius = 1000, color = \"#2a2d36\" },\n",
    );
    for _ in 0..300 {
        let radius = random.between(0.05, 0.2);
        let [x, z] = [(); 2].map(|()| random.between(-4.5, 4.5));
        let color = color(&mut random, 40);
        text += &ball([x, radius, z], radius, &color);
    }
    text += "]\n\n[camera]\neye = [0.3, 3.2, 8]\ntarget = [0, 0.3, 0]\nfov = 36\n";
    text
}

/// 3000 tiny balls whose colours are independent of their places, before light and dark.
fn confetti() -> String {
    let mut random = Random::new(25, 1);
    let mut text = String::from(
        "# Noise: 3000 tiny balls of random colours. Written by `cargo test -p spherule-tests -- --ignored pin_scenes`.\n\
         background = \"#808080\"\n\
         light = \"camera\"\n\
         sphere = [\n",
    );
    for _ in 0..3000 {
        let [x, y, z] = [(); 3].map(|()| random.between(-1.2, 1.2));
        let radius = random.between(0.02, 0.04);
        let color = color(&mut random, 0);
        text += &ball([x, y, z], radius, &color);
    }
    text += "]\n\n[camera]\neye = [0, 0, 8]\ntarget = [0, 0, 0]\nfov = 15\n";
    text
}

/// A line of a list of spheres.
fn ball([x, y, z]: [f32; 3], radius: f32, color: &str) -> String {
    format!(
        "    {{ center = [{x:.3}, {y:.3}, {z:.3}], radius = {radius:.3}, color = \"{color}\" }},\n"
    )
}

/// Red, green and blue, each at least `least`.
fn color(random: &mut Random, least: i64) -> String {
    let channels = [(); 3].map(|()| random.integer(least, 255));
    channels.iter().fold(String::from("#"), |hash, channel| hash + &format!("{channel:02x}"))
}
