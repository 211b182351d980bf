//! Frames over a link that is slow or stalls.

use super::emulated::{Emulated, Link};
use super::look::look;
use super::output::{BEGIN, Output};
use super::session::Session;
use std::sync::atomic::Ordering::SeqCst;
use std::thread;
use std::time::{Duration, Instant};

const SIZE: (u16, u16) = (200, 60);
const RATE: f64 = 0.5e6;
const BUFFER: usize = 256 << 10;
/// The longest time from a key to its effect.
const LIMIT: Duration = Duration::from_millis(250);

/// Starts a large picture that spins over this link.
fn spinning(link: &Link, more: &[&str]) -> Session {
    let emulated = Emulated { link: Some(link.clone()), ..Emulated::good() };
    let arguments = [&["marbles", "--color", "truecolor"], more].concat();
    let mut session = Session::start_in(emulated, &arguments, &[], SIZE);
    session.wait_for_status("? help");
    session.type_in(" ");
    session.wait_until("a rate", Output::tells_a_rate);
    session
}

/// Keys while it spins: how long each takes until its effect is seen, by the clock, and by what the link carries meanwhile, for which a
/// quiet machine would wait.
fn delays(session: &mut Session) -> Vec<(Duration, Duration)> {
    let keys = [("1", " fast "), ("3", " exact ")].into_iter().cycle();
    keys.take(8)
        .map(|(key, tier)| {
            thread::sleep(Duration::from_millis(310));
            let (before, start) = (session.output().sent.len(), Instant::now());
            session.type_in(key);
            let after = session.wait_for(tier, |output| {
                output.status().contains(tier).then_some(output.sent.len())
            });
            let carried = Duration::from_secs_f64((after - before) as f64 / RATE);
            (start.elapsed(), carried)
        })
        .collect()
}

#[test]
fn over_a_slow_link_a_key_is_seen_within_a_quarter_of_a_second() {
    let link = Link::new(BUFFER, RATE);
    let mut session = spinning(&link, &[]);
    let mut delays = delays(&mut session);
    delays.sort();
    let (median, longest) = (delays[delays.len() / 2].0, delays.iter().map(|delay| delay.1).max());
    println!(
        "by the clock: median {median:?}, longest {:?}; on the link: longest {longest:?}",
        delays.last()
    );
    assert!(longest.is_some_and(|carried| carried <= LIMIT), "{delays:?}");
    let line = session.output().status();
    assert!(line.contains(" kB rtt "), "{line}");
    session.quit("q");
}

/// What is asked for at rest is sent in parts, and a key in between is seen as soon.
#[test]
fn over_a_slow_link_the_picture_becomes_exact_at_rest() {
    let link = Link::new(BUFFER, RATE);
    let mut session = spinning(&link, &[]);
    session.type_in(" r");
    session.wait_for_peace();
    let shown = look(session.output().screen(), SIZE.1 - 1);
    // A full redraw: the picture without anything before it.
    session.signal(rustix::process::Signal::TSTP);
    session.wait_until_stopped();
    session.signal(rustix::process::Signal::CONT);
    session.wait_until("a full frame", |output| {
        let start = output.sent.len().saturating_sub(400_000);
        let redrawn = output.text_after(start).contains("\x1b[?1049h");
        redrawn && output.status().contains("? help")
    });
    session.wait_for_peace();
    let again = look(session.output().screen(), SIZE.1 - 1);
    assert!(shown == again, "the picture at rest is not what is drawn anew");
    session.quit("q");
}

/// While the link stalls, nothing is queued. Afterwards at most the two frames that were under way arrive, and then the frame that is
/// wanted now.
#[test]
fn a_link_that_stalls_queues_nothing() {
    let link = Link::new(BUFFER, RATE);
    let mut session = spinning(&link, &[]);
    link.is_stalled.store(true, SeqCst);
    thread::sleep(Duration::from_secs(1));
    let before = session.output().sent.len();
    // Together with the seconds before and after, this is more than half of `LOST`.
    thread::sleep(Duration::from_secs(8));
    session.type_in("1");
    thread::sleep(Duration::from_secs(1));
    link.is_stalled.store(false, SeqCst);
    let between = session.wait_for("the key", |output| {
        let is_seen = output.status().contains(" fast ");
        is_seen.then(|| output.text_after(before).matches(BEGIN).count())
    });
    assert!(between <= 3, "{between} frames before the key's");
    session.quit("q");
}

/// `--fps` limits how many frames are sent.
#[test]
fn frames_are_no_more_than_asked_for() {
    let link = Link::new(BUFFER, 100e6);
    let mut session = spinning(&link, &["--fps", "5"]);
    let start = session.output().sent.len();
    thread::sleep(Duration::from_secs(2));
    let frames = session.output().text_after(start).matches(BEGIN).count();
    assert!((1..=11).contains(&frames), "{frames} frames in two seconds");
    session.quit("q");
}
