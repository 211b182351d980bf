use super::*;
use crate::scene::attributes::NamesBuilder;
use spherule_kernel::{SphereList, Vec3};
use std::iter::successors;

/// Four atoms: C and N of chain A, O of chain B, and one that no one knows anything of.
fn attributes() -> Attributes {
    let mut chains = NamesBuilder::default();
    for name in ["A", "A", "B", ""] {
        chains.push(name.as_bytes());
    }
    let column = NumberColumn { name: "b_factor".into(), values: vec![10.0, 20.0, 30.0, f32::NAN] };
    let mut attributes = Attributes::default();
    attributes.elements = Some(vec![6, 7, 8, 0]);
    attributes.columns = vec![column];
    attributes.set_names(Naming::Chain, chains.finish());
    attributes
}

/// The same with more columns.
fn with_columns(names: &[&str], values: [f32; 4]) -> Attributes {
    let mut attributes = attributes();
    let column = |name: &&str| NumberColumn { name: (*name).into(), values: values.into() };
    attributes.columns.extend(names.iter().map(column));
    attributes
}

fn colored(attributes: Attributes, by: &str, range: Option<Range>) -> Result<Coloring, String> {
    let list = SphereList::from_iter([(Vec3::ZERO, 1.0); 4]);
    let scene = Scene::of_spheres(list, vec![Srgb::WHITE; 4], attributes);
    let by: ColorBy = by.parse().expect("a choice");
    coloring(&scene, &by, range, &mut Seen::default())
}

fn colors(by: &str, range: Option<Range>) -> Vec<Srgb> {
    let coloring = colored(attributes(), by, range).expect("colours");
    coloring.colors.expect("not the scene's own")
}

impl Legend {
    /// Of a scale between two numbers.
    pub(crate) fn of_numbers(title: &str, low: f32, high: f32, has_none: bool) -> Self {
        Self::new(title, Entries::Numbers { range: Range { low, high }, has_none })
    }

    fn of_chains(names: &[(Srgb, &str)]) -> Self {
        let names = names.iter().map(|&(color, name)| (color, name.to_owned()));
        Self::new("chain", Entries::Names(names.collect()))
    }
}

fn names(choices: &[ColorBy]) -> Vec<&str> {
    choices.iter().map(ColorBy::name).collect()
}

#[test]
fn names_have_colours_in_the_order_in_which_they_occur() {
    assert_eq!(colors("chain", None), [category(0), category(0), category(1), NEUTRAL]);
}

#[test]
fn elements_have_the_colours_that_chemists_know() {
    let [carbon, nitrogen, oxygen] =
        [6, 7, 8].map(|number| of_number(number).expect("known").color);
    assert_eq!(colors("element", None), [carbon, nitrogen, oxygen, NEUTRAL]);
}

#[test]
fn numbers_have_a_scale_of_their_own_range_or_another() {
    assert_eq!(colors("b_factor", None), [color_of(0.0), color_of(0.5), color_of(1.0), NEUTRAL]);
    let range = Some(Range { low: 20.0, high: 40.0 });
    assert_eq!(colors("B_FACTOR", range), [color_of(0.0), color_of(0.0), color_of(0.5), NEUTRAL]);
}

/// Also where the scene has names of that kind besides, as those of elements are types.
#[test]
fn a_column_of_the_file_s_own_goes_before_names() {
    let attributes = with_columns(&["Chain", "type"], [0.0, 1.0, 2.0, 1.0]);
    let choices = ColorBy::choices(&attributes);
    assert_eq!(names(&choices), ["scene", "element", "b_factor", "Chain", "type"]);
    for (by, name) in [("chain", "Chain"), ("type", "type")] {
        let found = colored(attributes.clone(), by, None).expect("colours");
        let [low, middle, high] = [0.0, 0.5, 1.0].map(color_of);
        assert_eq!(found.colors, Some(vec![low, middle, high, middle]));
        assert_eq!(found.legend, Some(Legend::of_numbers(name, 0.0, 2.0, false)));
    }
}

#[test]
fn every_choice_can_be_asked_for_by_its_name() {
    let choices = ColorBy::choices(&with_columns(&["", "scene", "Charge"], [1.0; 4]));
    assert_eq!(names(&choices), ["scene", "element", "chain", "b_factor", "Charge"]);
    for choice in choices {
        assert_eq!(choice.name().parse::<ColorBy>(), Ok(choice));
    }
}

/// A table has such columns beside its numbers.
#[test]
fn a_column_of_words_is_none_of_numbers() {
    let with_words = with_columns(&["Label", "residue"], [f32::NAN; 4]);
    assert_eq!(ColorBy::choices(&with_words), ColorBy::choices(&attributes()));
    for (by, name) in [("label", "Label"), ("residue", "residue")] {
        let error = colored(with_words.clone(), by, None).expect_err("words");
        let expected = format!(
            "column {name} has no number to colour by; there are scene, element, chain, b_factor"
        );
        assert_eq!(error, expected);
    }
}

#[test]
fn what_a_scene_does_not_have_is_said_with_what_it_has() {
    for by in ["residue", "charge"] {
        let error = colored(attributes(), by, None).expect_err("missing");
        let expected =
            format!("this scene has no {by} to colour by; it has scene, element, chain, b_factor");
        assert_eq!(error, expected);
    }
    assert!("".parse::<ColorBy>().is_err());
}

#[test]
fn a_key_goes_through_all_there_is_in_a_circle() {
    let attributes = attributes();
    let circle = successors(Some(ColorBy::Scene), |by| Some(by.next(&attributes)));
    let circle: Vec<_> = circle.take(5).collect();
    assert_eq!(names(&circle), ["scene", "element", "chain", "b_factor", "scene"]);
    assert_eq!(ColorBy::Scene.next(Scene::new().attributes()), ColorBy::Scene);
}

#[test]
fn several_chains_are_coloured_unless_the_file_has_colours() {
    let mut attributes = attributes();
    assert_eq!(ColorBy::usual(&attributes), ColorBy::Names(Naming::Chain));
    assert_eq!(ColorBy::usual(Scene::new().attributes()), ColorBy::Scene);
    attributes.own.colors = true;
    assert_eq!(ColorBy::usual(&attributes), ColorBy::Scene);
}

#[test]
fn legends_say_what_there_is() {
    let legend = |by| colored(attributes(), by, None).expect("colours").legend;
    let names = [(category(0), "A"), (category(1), "B"), (NEUTRAL, "none")];
    assert_eq!(legend("chain"), Some(Legend::of_chains(&names)));
    let numbers = Legend::of_numbers("b_factor", 10.0, 30.0, true);
    assert_eq!(legend("b_factor"), Some(numbers));
    assert_eq!(legend("scene"), None);
}

/// Chains that come and go, in another order, and numbers that leave the first frame's scale.
#[test]
fn a_colour_means_the_same_in_all_frames() {
    let frame = |atoms: &[(&str, f32)]| {
        let mut chains = NamesBuilder::default();
        atoms.iter().for_each(|(chain, _)| chains.push(chain.as_bytes()));
        let values = atoms.iter().map(|(_, number)| *number).collect();
        let mut attributes = Attributes::default();
        attributes.columns = vec![NumberColumn { name: "q".into(), values }];
        attributes.set_names(Naming::Chain, chains.finish());
        let list: SphereList = atoms.iter().map(|_| (Vec3::ZERO, 1.0)).collect();
        Scene::of_spheres(list, vec![Srgb::WHITE; atoms.len()], attributes)
    };
    let frames = [
        frame(&[("1", 0.0), ("2", 4.0)]),
        frame(&[("2", 8.0)]),
        frame(&[("", 2.0), ("3", 2.0), ("2", 2.0), ("1", 2.0)]),
    ];
    let mut seen = Seen::default();
    let mut colored = |by: ColorBy, range| {
        frames.each_ref().map(|scene| coloring(scene, &by, range, &mut seen).expect("colours"))
    };
    let chains = colored(ColorBy::Names(Naming::Chain), None);
    let [one, two, three] = [0, 1, 2].map(category);
    let colors = chains.each_ref().map(|of| of.colors.clone().expect("not the scene's own"));
    assert_eq!(colors, [vec![one, two], vec![two], vec![NEUTRAL, three, two, one]]);
    let names = [(one, "1"), (two, "2"), (three, "3"), (NEUTRAL, "none")];
    assert_eq!(chains[2].legend, Some(Legend::of_chains(&names)));

    let legend = |low, high| Some(Legend::of_numbers("q", low, high, false));
    // A range that is asked for is no part of what has been seen.
    let asked = colored(ColorBy::Column("q".into()), Some(Range { low: 9.0, high: 1.0 }));
    assert!(asked.iter().all(|of| of.legend == legend(9.0, 1.0)));
    let numbers = colored(ColorBy::Column("Q".into()), None);
    assert_eq!(numbers.map(|of| of.legend), [legend(0.0, 4.0), legend(0.0, 8.0), legend(0.0, 8.0)]);
}
