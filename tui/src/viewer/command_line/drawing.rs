//! The options without which a scene would be drawn otherwise.

use crate::arguments::PictureArguments;
use crate::choice::name;
use crate::color::Srgb;
use crate::coloring::ColorBy;
use crate::compare::Comparison;
use crate::palette::{THEMES, Theme};
use crate::pixels::Output;
use crate::scene::Scene;
use crate::structure::Order;
use crate::style::{Aids, CHAIR};
use crate::terminal::color_depth::ColorChoice;
use crate::viewer::colors::Colors;
use crate::viewer::shown::Shown;
use crate::viewer::state::State;
use spherule_kernel::Tier;

/// What must be said of how `scene` is drawn: options, with their values if they take one. What is so by itself is left out.
pub(super) fn drawing(
    asked: &PictureArguments,
    state: &State,
    scene: &Scene,
    colors: &Colors,
) -> Vec<(&'static str, Option<String>)> {
    let Shown { style, structure, comparison, table, coloring, legend, .. } = state.shown;
    let is_charset_said = asked.charset.is_some() || style.charset != state.first_charset;
    // Object order uses no structure.
    let is_by_objects = asked.scene.order == Order::Object;
    let (by, range) = colors.to_ask(scene, coloring);
    let is_usual = *by == ColorBy::usual(scene.attributes());
    // Beside these `--legend` is refused where there is no viewer.
    let is_refused = comparison.is_some() || table || asked.output != Output::Cells;
    let is_afar = asked.distance.to_bits() != CHAIR.to_bits();
    let valued = [
        ("--accuracy", (style.accuracy != Tier::Exact).then(|| style.accuracy.as_str().to_owned())),
        ("--charset", is_charset_said.then(|| name(&style.charset))),
        ("--color", (asked.color != ColorChoice::Auto).then(|| name(&asked.color))),
        ("--palette", asked.palette.as_ref().map(palette)),
        ("--background", asked.background.map(digits)),
        ("--samples", asked.scene.samples.map(|samples| samples.to_string())),
        ("--cell-aspect", asked.cell_aspect.map(|aspect| format!("{aspect}:1"))),
        ("--distance", is_afar.then(|| asked.distance.to_string())),
        ("--output", (asked.output != Output::Cells).then(|| name(&asked.output))),
        ("--order", is_by_objects.then(|| name(&asked.scene.order))),
        ("--structure", structure.filter(|_| !is_by_objects).map(|structure| name(&structure))),
        ("--show", overlay(comparison, table)),
        ("--color-by", (!is_usual).then(|| by.name().to_owned())),
        ("--range", range.map(|range| format!("{}:{}", range.low, range.high))),
    ];
    let (aids, usual) = (style.aids, Aids::usual(scene));
    let switch = |now: bool, usual: bool, [on, off]: [&'static str; 2]| {
        (now != usual).then_some(if now { on } else { off })
    };
    let flags = [
        switch(aids.occlusion, usual.occlusion, ["--occlusion=on", "--occlusion=off"]),
        switch(aids.edges, usual.edges, ["--edges=on", "--edges=off"]),
        switch(aids.depth_cue, usual.depth_cue, ["--depth-cue=on", "--depth-cue=off"]),
        (legend && !is_refused).then_some("--legend"),
    ];
    let valued = valued.into_iter().filter_map(|(option, value)| Some((option, Some(value?))));
    valued.chain(flags.into_iter().flatten().map(|flag| (flag, None))).collect()
}

/// What `--show` names: of both, the comparison, which is the picture itself.
fn overlay(comparison: Option<Comparison>, table: bool) -> Option<String> {
    match comparison {
        Some(Comparison::Errors) => Some("error".to_owned()),
        Some(Comparison::Split([left, right])) => {
            Some(format!("split:{},{}", left.as_str(), right.as_str()))
        }
        None => table.then(|| "table".to_owned()),
    }
}

/// A theme's name, else its colours.
fn palette(theme: &Theme) -> String {
    let named = |&(_, named): &(&str, Theme)| named == *theme;
    THEMES
        .into_iter()
        .find(named)
        .map_or_else(|| theme.colors.map(digits).join(","), |(name, _)| name.to_owned())
}

/// A colour without the `#`, which begins a comment in a shell.
fn digits(Srgb(channels): Srgb) -> String {
    channels.map(|channel| format!("{channel:02x}")).concat()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arguments::{Arguments, Overlay};
    use crate::scene::attributes::{Attributes, NumberColumn};
    use crate::style::{Charset, Style};
    use crate::viewer::Start;
    use crate::viewer::keys::Input;
    use clap::Parser;
    use spherule_kernel::{SphereList, Vec3};

    /// What is said after these inputs to a viewer of two spheres with numbers, as if on a terminal with the charset `half`.
    fn said(words: &str, inputs: &[Input]) -> String {
        let values = vec![1.0, 2.0];
        let column = NumberColumn { name: "temp".into(), values };
        let mut attributes = Attributes::default();
        attributes.columns.push(column);
        let list = SphereList::from_iter([(Vec3::ZERO, 1.0), (Vec3::X, 1.0)]);
        let scene = Scene::of_spheres(list, vec![Srgb::WHITE; 2], attributes);
        let words = std::iter::once("spherule").chain(words.split_whitespace());
        let asked = Arguments::try_parse_from(words).expect("a command line").picture;
        let crowd = &asked.crowd;
        let colors = Colors::new(&scene, &crowd.color_by(&scene), crowd.range);
        let start = Start {
            style: Style {
                accuracy: asked.accuracy,
                charset: asked.charset.unwrap_or(Charset::Half),
                aids: crowd.aids(&scene),
                ..Style::PLAIN
            },
            structure: asked.computing.structure,
            comparison: asked.show.and_then(Overlay::comparison),
            table: asked.show == Some(Overlay::Table),
            legend: crowd.legend,
            ..Start::FRONT
        };
        let mut state = State::new(start, colors.start());
        for &input in inputs {
            state.apply(input);
        }
        let said = drawing(&asked, &state, &scene, &colors).into_iter();
        let said = said.map(|(option, value)| {
            value.map_or_else(|| option.to_owned(), |value| format!("{option} {value}"))
        });
        said.collect::<Vec<_>>().join(" ")
    }

    #[test]
    fn what_was_asked_for_is_said_again() {
        for line in [
            "",
            "--accuracy fast --charset half --color 256 --palette tango --background 0a0b0c",
            "--samples 9 --cell-aspect 0.75:1 --distance 100 --output kitty --order object",
            "--structure bvh --show split:fast,exact",
            "--show table --color-by temp --range 0:1.5 --occlusion=on --edges=on --depth-cue=on",
            "--color-by temp --legend",
            "--palette 000000,cd0000,00cd00,cdcd00,0000ee,cd00cd,00cdcd,e5e5e5,\
             7f7f7f,ff0000,00ff00,ffff00,5c5cff,ff00ff,00ffff,fffffe",
        ] {
            assert_eq!(said(line, &[]), line);
        }
        let usual = "--accuracy exact --charset auto --color auto --occlusion=off --range=1:2 --color-by temp";
        assert_eq!(said(usual, &[]), "--color-by temp");
    }

    #[test]
    fn what_keys_have_changed_is_said() {
        for (words, inputs, expected) in [
            ("", [Input::Accuracy(Tier::Stable), Input::Edges], "--accuracy stable --edges=on"),
            ("--accuracy fast", [Input::Accuracy(Tier::Exact), Input::DepthCue], "--depth-cue=on"),
            ("", [Input::Charset, Input::Occlusion], "--charset quadrant --occlusion=on"),
            ("--edges", [Input::Edges, Input::Structure], "--structure brute"),
            ("", [Input::Coloring, Input::Legend], "--color-by temp --legend"),
            ("--color-by temp", [Input::Coloring, Input::Errors], "--show error"),
            ("--color-by temp", [Input::Legend, Input::Errors], "--show error --color-by temp"),
            ("--output kitty", [Input::Legend, Input::Edges], "--output kitty --edges=on"),
            ("", [Input::Split, Input::Table], "--show split:fast,exact"),
        ] {
            assert_eq!(said(words, &inputs), expected, "{words} {inputs:?}");
        }
    }
}
