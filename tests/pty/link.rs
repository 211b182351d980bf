//! Frames over a link that is slow, stalls, or closes.

use super::emulated::{Emulated, Link};
use super::look::{last_row, look};
use super::session::{Output, Session, command, size};
use portable_pty::native_pty_system;
use spherule_tests::binary::spherule;
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
    let mut session = Session::start_in(emulated, spherule(), &arguments, &[], SIZE);
    session.wait_for("the first picture", |output| {
        last_row(output.screen()).contains("? help").then_some(())
    });
    session.type_in(" ");
    session.wait_for("a rate", |output| {
        let line = last_row(output.screen());
        (line.contains(" fps") && !line.contains("-- fps")).then_some(())
    });
    session
}

fn shows(tier: &str) -> impl Fn(&Output) -> Option<usize> {
    let tier = format!(" {tier} ");
    move |output| last_row(output.screen()).contains(&tier).then_some(output.sent.len())
}

/// Keys while it spins: how long each takes until its effect is seen, by the clock, and by what the link carries meanwhile, for which a
/// quiet machine would wait.
fn delays(session: &mut Session) -> Vec<(Duration, Duration)> {
    let keys = [("1", "fast"), ("3", "exact")].into_iter().cycle();
    keys.take(20)
        .map(|(key, tier)| {
            thread::sleep(Duration::from_millis(310));
            let (before, start) = (session.output().sent.len(), Instant::now());
            session.type_in(key);
            let after = session.wait_for(tier, shows(tier));
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
    {
        let line = last_row(session.output().screen());
        assert!(line.contains(" kB rtt "), "{line}");
    }
    session.type_in("q");
    assert!(session.wait_for_end().success());
    assert_eq!(session.left_behind(), [""; 0]);
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
    session.wait_for("a full frame", |output| {
        let start = output.sent.len().saturating_sub(400_000);
        let redrawn = output.sent[start..].windows(8).any(|bytes| bytes == b"\x1b[?1049h");
        (redrawn && last_row(output.screen()).contains("? help")).then_some(())
    });
    session.wait_for_peace();
    let again = look(session.output().screen(), SIZE.1 - 1);
    assert!(shown == again, "the picture at rest is not what is drawn anew");
    session.type_in("q");
    assert!(session.wait_for_end().success());
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
    let after = session.wait_for("the key", shows("fast"));
    let frames = |bytes: &[u8]| bytes.windows(8).filter(|bytes| *bytes == b"\x1b[?2026h").count();
    let between = frames(&session.output().sent[before..after]);
    assert!(between <= 3, "{between} frames before the key's");
    session.type_in("q");
    assert!(session.wait_for_end().success());
    assert_eq!(session.left_behind(), [""; 0]);
}

/// The program ends as with a terminal that is closed.
#[test]
fn a_link_that_closes_in_the_middle_of_a_frame() {
    let pair = native_pty_system().openpty(size(SIZE.0, SIZE.1)).expect("a pseudo-terminal");
    let arguments = ["marbles", "--no-probe"];
    let program = command(spherule(), &arguments, &[]);
    let mut child = pair.slave.spawn_command(program).expect("the program starts");
    let mut reader = pair.master.try_clone_reader().expect("output can be read");
    let (mut bytes, mut count) = ([0; 4096], 0);
    while count < 20_000 {
        count += std::io::Read::read(&mut reader, &mut bytes).expect("the program writes");
    }
    drop((pair, reader));
    let status = child.wait().expect("it is our child");
    assert_eq!(status.signal(), Some("Hangup"), "{status}");
}

/// `--fps` limits how many frames are sent.
#[test]
fn frames_are_no_more_than_asked_for() {
    let link = Link::new(BUFFER, 100e6);
    let mut session = spinning(&link, &["--fps", "5"]);
    let start = session.output().sent.len();
    thread::sleep(Duration::from_secs(2));
    let frames = {
        let sent = &session.output().sent[start..];
        sent.windows(8).filter(|bytes| *bytes == b"\x1b[?2026h").count()
    };
    assert!((1..=11).contains(&frames), "{frames} frames in two seconds");
    session.type_in("q");
    assert!(session.wait_for_end().success());
}
