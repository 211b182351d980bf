//! Robots that are slow to read, or beyond a limit.

use super::*;
use std::time::{Duration, Instant};

const SPHERE: &str = "<collision><geometry><sphere radius='1'/></geometry></collision>";

fn in_time(begun: Instant) {
    let took = begun.elapsed();
    assert!(took < Duration::from_secs(20), "{took:?}");
}

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
fn many_attributes_and_namespaces() {
    let begun = Instant::now();
    let message = |tag: String| error(format!("<robot>\n <link {tag}/>\n</robot>"));
    let attributes: String = (0..600_000).map(|index| format!(" a{index}=''")).collect();
    assert_eq!(message(attributes), "f:2:2: an element of more than 64 attributes");
    let names: String = (0..65).map(|index| format!("<link xmlns:a{index}='u'/>")).collect();
    assert!(message(format!("/>{names}<a")).ends_with(": more than 64 namespaces"));
    let long = format!("xmlns:a='{}'", "u".repeat(257));
    assert_eq!(message(long), "f:2:2: a namespace of more than 256 bytes");
    let signs = "=".repeat((1 << 23) + 1);
    assert!(message(format!("/>{signs}<a")).ends_with(" elements and attributes"));
    in_time(begun);
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
    let begun = Instant::now();
    let links = "<link name='l1000'/>".repeat(300_000);
    let robot = chain(1000).replace("</robot>", &format!("{links}</robot>"));
    assert_eq!(centers(&good(robot)), [[0.0, 0.0, 500.0], [0.0, 0.0, 1000.0]]);
    in_time(begun);
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
        scene(format!("<robot>\n<link name='{name}'>{SPHERE}</link></robot>"))
    };
    assert!(named(1024).is_ok());
    let message = named(1025).expect_err("too long").to_string();
    assert_eq!(message, "f:2:1: a link whose name has more than 1024 bytes");
}
