mod told;

use super::ahead::{AHEAD, State};
use super::*;
use crate::scene::open::{Opened, open};
use crate::scene::reading::Reading;
use crate::test_file::{self, path};
use std::fs::OpenOptions;
use std::io::Write;
use std::os::fd::AsRawFd;

/// The name of a file of this text.
fn written(name: &str, text: impl AsRef<[u8]>) -> String {
    let path = test_file::written(name, text);
    path.into_os_string().into_string().expect("UTF-8")
}

fn text(count: usize) -> String {
    (0..count).map(|index| format!("1\n\nC {index} 0 0\n")).collect()
}

/// A frame that lacks an atom.
const WRONG: &str = "2\n\nC 0 0 0\n";

fn film(name: &str, count: usize) -> Film {
    film_of(&written(name, text(count)))
}

/// The same from a pipe.
fn piped(count: usize) -> Film {
    let (reader, mut writer) = std::io::pipe().expect("a pipe");
    writer.write_all(text(count).as_bytes()).expect("room in the pipe");
    drop(writer);
    film_of(&format!("/dev/fd/{}", reader.as_raw_fd()))
}

fn film_of(name: &str) -> Film {
    film_from(name, &Reading::default(), 0)
}

/// One of a file that grows.
fn followed(name: &str, count: usize) -> Film {
    let reading = Reading { follow: true, ..Reading::default() };
    film_from(&written(name, text(count)), &reading, 0)
}

fn film_from(name: &str, reading: &Reading, first: usize) -> Film {
    Film::new(opened(name, reading, first), first, |_| Ok(())).expect("a thread")
}

/// The frames of a file of which the first to be shown has been read.
fn opened(name: &str, reading: &Reading, first: usize) -> Frames {
    let Ok(Opened::File(mut frames)) = open(name, reading) else { panic!("no file") };
    let _ = frames.read(first).expect("a frame").expect("a frame");
    frames
}

/// What is found within four seconds.
fn soon<T>(mut look: impl FnMut() -> Option<T>) -> Option<T> {
    (0..2000).find_map(|_| {
        let found = look();
        if found.is_none() {
            std::thread::sleep(Duration::from_millis(2));
        }
        found
    })
}

/// x of the next frame, once it is there.
fn next(film: &mut Film) -> f32 {
    let scene = soon(|| film.next());
    let scene = scene.unwrap_or_else(|| panic!("no frame comes: {}", film.status()));
    scene.spheres().get(0).expect("an atom").center.x
}

/// x of the frame to which a step leads.
fn stepped(film: &mut Film, forward: bool) -> f32 {
    film.step(forward);
    next(film)
}

fn wait_until(film: &Film, is_so: impl Fn(&State) -> bool) {
    let was_so = soon(|| is_so(&film.shared.lock()).then_some(()));
    assert!(was_so.is_some(), "it is never so: {}", film.status());
}

#[test]
fn steps_go_on_and_back_and_end_at_the_ends() {
    let mut film = film("steps.xyz", 3);
    assert!(film.next().is_none() && film.wait().is_none());
    for (forward, x) in [(true, 1.0), (true, 2.0), (false, 1.0), (false, 0.0), (true, 1.0)] {
        film.step(forward);
        assert!(film.wait().is_some());
        assert_eq!(next(&mut film), x);
    }
    assert_eq!(stepped(&mut film, true), 2.0);
    // The end has been seen by now, or is seen by this.
    film.step(true);
    std::thread::sleep(Duration::from_millis(100));
    assert!(film.next().is_none());
    assert_eq!(film.status(), "2/3");
}

/// Else what is drawn for long would be ended for a frame that is not there.
#[test]
fn a_frame_that_is_to_be_shown_next_is_there() {
    let mut film = film("awaited.xyz", 3);
    wait_until(&film, |state| state.ready.contains_key(&1));
    assert!(!film.has_next(), "no one has asked for it");
    film.play();
    assert!(film.has_next() && film.is_playing());
    film.play();
    assert!(!film.has_next());
    film.step(true);
    assert!(film.has_next() && !film.is_playing());
    film.want(5);
    assert!(!film.has_next());
}

/// Whoever holds the key down is ahead of what has been read. Of a pipe no frame can be read again.
#[test]
fn steps_past_an_end_that_is_not_known_lead_to_the_last_frame() {
    let mut film = film("beyond.xyz", 3);
    wait_until(&film, |state| state.count.is_some());
    {
        let mut state = film.shared.lock();
        state.count = None;
        state.ready.clear();
    }
    film.want(5);
    assert_eq!(next(&mut film), 2.0);
    assert_eq!(film.status(), "2/3");
    assert!(film.next().is_none() && film.wait().is_none());
    let mut pipe = piped(20);
    pipe.want(60);
    assert_eq!(next(&mut pipe), 19.0);
    assert_eq!(pipe.status(), "19/20");
}

/// They wait for the next frame of a file that grows; of a pipe, a step back gives the wait up.
#[test]
fn steps_past_the_end_of_what_grows_wait_for_one_frame() {
    let mut film = followed("grows.xyz", 3);
    (0..60).for_each(|_| film.step(true));
    wait_until(&film, |state| state.unwritten == Some(3));
    assert!(film.next().is_none());
    let file = OpenOptions::new().append(true).open(path("grows.xyz"));
    file.and_then(|mut file| file.write_all(b"1\n\nC 3 0 0\n")).expect("a file");
    assert_eq!(next(&mut film), 3.0);

    // (Before the end of this one is known.)
    let mut pipe = piped(20);
    pipe.shared.lock().count = None;
    pipe.want(60);
    pipe.shared.lock().count = None;
    pipe.step(false);
    assert!(pipe.wait().is_none(), "it waits");
}

/// Whoever waits for what is silent does not wake up again and again.
#[test]
fn the_longer_no_frame_comes_the_less_often_it_is_looked_for() {
    for plays in [false, true] {
        let mut film = followed("silent.xyz", 1);
        film.is_playing = plays;
        film.want(1);
        assert!(film.wait().is_some_and(|wait| wait < GLANCE));
        std::thread::sleep(Duration::from_millis(400));
        let seldom = film.wait();
        assert!(seldom >= Some(Duration::from_millis(50)) && seldom <= Some(GLANCE), "{seldom:?}");
        // Another frame is looked for at once.
        film.want(2);
        assert!(film.wait().is_some_and(|wait| wait < GLANCE));
    }
}

/// Else it would be asked for the next frame again and again. So it would if the only other frame has no particles.
#[test]
fn a_file_of_one_frame_does_not_play() {
    let empty = "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n0\nITEM: ATOMS id type x y z\n";
    let one = empty.replace("ATOMS\n0\n", "ATOMS\n1\n") + "1 1 0 0 0\n";
    let name = written("late.dump", empty.to_owned() + &one);
    let late = film_from(&name, &Reading::default(), 1);
    for mut film in [film("single.xyz", 1), late] {
        film.play();
        soon(|| {
            assert!(film.next().is_none());
            (!film.is_playing()).then_some(())
        });
        assert!(!film.is_playing() && film.wait().is_none());
    }
}

#[test]
fn steps_past_a_frame_that_is_wrong_lead_to_the_one_before() {
    let mut film = film_of(&written("wrong.xyz", text(3) + WRONG));
    film.want(60);
    assert_eq!(next(&mut film), 2.0);
    assert!(film.status().starts_with("frame 3: "), "{}", film.status());
}

/// Not even at the end is one of them waited for.
#[test]
fn frames_without_atoms_are_passed_over() {
    let frame = |x: usize, atoms: usize| {
        let row = format!("1 1 {x} 0 0\n").repeat(atoms);
        format!(
            "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n{atoms}\nITEM: ATOMS id type x y z\n{row}"
        )
    };
    let atoms = [1, 0, 0, 1, 1, 0, 0];
    let text: String = atoms.iter().enumerate().map(|(x, &atoms)| frame(x, atoms)).collect();
    let mut film = film_of(&written("empty.dump", text));
    for (forward, x) in [(true, 3.0), (false, 0.0), (true, 3.0), (true, 4.0)] {
        assert_eq!(stepped(&mut film, forward), x);
    }
    wait_until(&film, |state| state.count == Some(5));
    film.step(true);
    assert!(film.next().is_none() && film.wait().is_none());
    film.play();
    let seen: Vec<f32> = (0..4).map(|_| next(&mut film)).collect();
    assert_eq!(seen, [0.0, 3.0, 4.0, 0.0]);
}

#[test]
fn it_plays_all_and_begins_again() {
    let mut film = film("plays.xyz", 4);
    film.play();
    let seen: Vec<f32> = (0..7).map(|_| next(&mut film)).collect();
    assert_eq!(seen, [1.0, 2.0, 3.0, 0.0, 1.0, 2.0, 3.0]);
    film.play();
    assert!(film.next().is_none() && film.wait().is_none());
}

#[test]
fn no_more_is_read_than_has_room() {
    let mut film = film("room.xyz", 500);
    assert_eq!(stepped(&mut film, true), 1.0);
    std::thread::sleep(Duration::from_millis(200));
    let ready = film.shared.lock().ready.len();
    assert!(ready <= AHEAD + 3, "{ready}");
}

#[test]
fn a_pipe_goes_back_as_far_as_is_kept_and_on_to_its_end() {
    let mut film = piped(20);
    for x in 1..=10 {
        assert_eq!(stepped(&mut film, true), x as f32);
    }
    wait_until(&film, |state| state.ready.contains_key(&19));
    // One frame behind is kept.
    for _ in 0..9 {
        film.step(false);
    }
    assert_eq!(next(&mut film), 9.0);
    assert!(film.next().is_none() && film.wait().is_none());
    for x in 10..20 {
        assert_eq!(stepped(&mut film, true), x as f32);
    }
    wait_until(&film, |state| state.count.is_some());
    film.play();
    std::thread::sleep(Duration::from_millis(100));
    assert!(film.next().is_none() && film.wait().is_none());
    assert_eq!(film.status(), "19/20");
}
