//! Robots that are slow to read, or beyond a limit.

use super::*;

const SPHERE: &str = "<collision><geometry><sphere radius='1'/></geometry></collision>";

fn joint(parent: usize, child: usize) -> String {
    format!(
        "<joint><parent link='l{parent}'/><child link='l{child}'/><origin xyz='0 0 1'/></joint>"
    )
}

/// A chain of so many joints whose middle and end are spheres.
fn chain(joints: usize) -> String {
    let link = |link: usize| format!("<link name='l{link}'>{SPHERE}</link>");
    let chain: String = (0..joints).map(|above| joint(above, above + 1)).collect();
    format!("<robot>{}{chain}{}</robot>", link(joints / 2), link(joints))
}

#[test]
fn shapes_that_are_no_spheres_are_said() {
    let others = |count: usize| {
        let boxes = "<collision><geometry><box size='1 1 1'/></geometry></collision>".repeat(count);
        notes("shapes.urdf", &format!("\n<robot><link name='l'>{SPHERE}{boxes}</link></robot>"))
    };
    assert!(others(0).is_empty());
    assert_eq!(others(1), ["1 shape that is not a sphere is ignored"]);
    assert_eq!(others(2), ["2 shapes that are not spheres are ignored"]);
}

#[test]
fn many_attributes_and_namespaces() {
    let attributes: String = (0..600_000).map(|index| format!(" a{index}=''")).collect();
    let names: String = (0..65).map(|index| format!("<link xmlns:a{index}='u'/>")).collect();
    let long = format!("xmlns:a='{}'", "u".repeat(257));
    let signs = "=".repeat((1 << 23) + 1);
    let tags = [attributes, format!("/>{names}<a"), long, format!("/>{signs}<a")];
    let message = |tag: String| error(format!("<robot>\n <link {tag}/>\n</robot>"));
    let [attributes, names, long, signs] = soon(|| tags.map(message));
    assert_eq!(attributes, "f:2:2: an element of more than 64 attributes");
    assert!(names.ends_with(": more than 64 namespaces"));
    assert_eq!(long, "f:2:2: a namespace of more than 256 bytes");
    assert!(signs.ends_with(" elements and attributes"));
}

#[test]
fn what_is_no_attribute_is_not_counted() {
    let many = "a='' ".repeat(100);
    let others = format!(
        "<!-- > <link {many}> --><?p <link {many}> ?><a b='{}' c=\"'>'\">{many}</a>\
         <![CDATA[ > <link {many}> ]]>",
        "=".repeat(100)
    );
    let all: String = (0..64).map(|index| format!(" xmlns:a{index}='u{index}'")).collect();
    // What is declared again is the same.
    let again = "<b xmlns:a0='u0'/>".repeat(100);
    let robot =
        format!("<robot{all}>{others}<link name='l'>{SPHERE}</link>{others}{again}</robot>");
    assert_eq!(good(robot).spheres().len(), 1);
}

#[test]
fn many_links_at_the_end_of_a_long_chain() {
    let links = "<link name='l1000'/>".repeat(300_000);
    let robot = chain(1000).replace("</robot>", &format!("{links}</robot>"));
    assert_eq!(centers(&soon(|| good(robot))), [[0.0, 0.0, 500.0], [0.0, 0.0, 1000.0]]);
}

#[test]
fn a_chain_that_is_too_long_and_a_circle() {
    assert_eq!(centers(&good(chain(1024)))[1], [0.0, 0.0, 1024.0]);
    assert!(error(chain(1025)).ends_with(": the link \"l1025\" hangs on itself"));
    let circle = [joint(1, 2), joint(2, 1)].concat();
    let message = error(format!("<robot>\n{circle}<link name='l1'/></robot>"));
    assert!(message.starts_with("f:2:") && message.ends_with("the link \"l1\" hangs on itself"));
}

#[test]
fn a_link_with_a_long_name() {
    let named = |length: usize| {
        let name = "l".repeat(length);
        format!("<robot>\n<link name='{name}'>{SPHERE}</link></robot>")
    };
    assert_eq!(good(named(1024)).spheres().len(), 1);
    assert_eq!(error(named(1025)), "f:2:1: a link whose name has more than 1024 bytes");
}
