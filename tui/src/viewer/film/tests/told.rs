//! What is told of frames, over the picture and in the status line.

use super::*;

/// The one thing that there is to tell.
fn news(film: &mut Film) -> String {
    let news = film.take_news();
    let [news] = &news[..] else { panic!("{news:?}") };
    news.clone()
}

/// No frame comes any more, and there is something to tell.
fn stops_with_news(film: &mut Film) {
    soon(|| {
        let has_ended = film.wait().is_none();
        assert!(has_ended || film.next().is_none());
        has_ended.then_some(())
    });
    assert!(film.wait().is_none() && !film.take_news().is_empty());
}

#[test]
fn a_frame_that_is_wrong_is_told_of_where_it_would_be_next() {
    let frame = |index: usize| {
        let x = if index == 20 { "x" } else { "0" };
        format!("2\nframe {index}\nC {index} 0 0\nO {x} {index} 0\n")
    };
    let name = written("damaged.xyz", (0..60).map(frame).collect::<String>());
    let mut film = film_of(&name);
    for x in 1..=19 {
        assert_eq!(stepped(&mut film, true), x as f32);
        if x == 12 {
            wait_until(&film, |state| state.ending.is_some());
        }
        assert!(x == 19 || film.status().starts_with(&format!("{x}/")), "{}", film.status());
    }
    // The status line has no room for all of it. Whoever asks again is told again.
    let why = format!("frame 20: {name}:84:3: x is \"x\", which is not a number");
    for _ in 0..2 {
        assert!(film.next().is_none() && news(&mut film).starts_with(&why));
        assert!(film.next().is_none() && film.take_news().is_empty());
        assert_eq!(film.status(), "frame 20: line 84");
        film.step(true);
    }
    assert!(film.next().is_none() && news(&mut film).starts_with(&why));
    // A step back asks for no more.
    assert_eq!(stepped(&mut film, false), 18.0);
    assert!(film.take_news().is_empty());
    assert_eq!(film.status(), "18/20!");
}

/// Else it would look as if the file ended there.
#[test]
fn a_film_that_ends_at_a_wrong_frame_says_so_as_it_plays() {
    let mut film = film_of(&written("short.xyz", text(3) + WRONG));
    wait_until(&film, |state| state.ending.is_some());
    assert_eq!(film.status(), "0/3!");
    film.play();
    assert_eq!((next(&mut film), next(&mut film)), (1.0, 2.0));
    assert!(film.take_news().is_empty());
    assert_eq!(next(&mut film), 0.0);
    assert!(news(&mut film).starts_with("frame 3: "));
    let seen: Vec<f32> = (0..3).map(|_| next(&mut film)).collect();
    assert_eq!((seen, film.status()), (vec![1.0, 2.0, 0.0], ">0/3!".to_owned()));
    assert!(film.take_news().is_empty());
}

/// There is nothing to count or to play then.
#[test]
fn a_second_frame_that_is_wrong_is_told_of() {
    let mut film = film_of(&written("second.xyz", text(1) + WRONG));
    wait_until(&film, |state| state.ending.is_some());
    assert!(film.has_status() && !film.has_more());
    assert!(film.status().starts_with("frame 1: "), "{}", film.status());
    assert!(film.next().is_none() && news(&mut film).starts_with("frame 1: "));
}

#[test]
fn what_frames_lack_is_told_of_the_first_that_is_shown() {
    let frames = opened(&written("lacking.xyz", text(3)), &Reading::default(), 0);
    let prepare = |_: &mut Scene| Err("keeps its radii: none".to_owned());
    let mut film = Film::new(frames, 0, prepare).expect("a thread");
    wait_until(&film, |state| state.ready.contains_key(&2));
    assert!(film.next().is_none() && film.take_news().is_empty());
    assert_eq!(stepped(&mut film, true), 1.0);
    assert_eq!(news(&mut film), "frame 1 keeps its radii: none");
    assert_eq!(stepped(&mut film, true), 2.0);
    assert!(film.take_news().is_empty());
}

/// Frames that are read again, and those that are no longer kept, are there all the same.
#[test]
fn the_count_does_not_fall_with_steps_back() {
    let mut film = film("back.xyz", 500);
    film.want(40);
    assert_eq!(next(&mut film), 40.0);
    wait_until(&film, |state| !state.is_reading);
    assert_eq!(film.status(), format!("40/{}+", 42 + AHEAD));
    assert_eq!(stepped(&mut film, false), 39.0);
    assert_eq!(film.status(), format!("39/{}+", 42 + AHEAD));
}

/// At rest no key makes the viewer look.
#[test]
fn whoever_shows_the_count_is_told_that_it_changes() {
    let mut film = film("noticed.xyz", 3);
    assert_eq!(film.wait_for_status(), Some(Duration::ZERO), "nothing has been shown");
    wait_until(&film, |state| !state.is_reading);
    film.has_changed();
    assert_eq!((film.line().as_deref(), film.wait_for_status()), (Some("0/3"), None));
    film.shared.lock().is_reading = true;
    assert_eq!(film.wait_for_status(), Some(GLANCE));
    film.shared.lock().count = None;
    assert_eq!(film.wait_for_status(), Some(Duration::ZERO));
    assert!(film.has_changed() && !film.has_changed());
    // Where it plays, every frame tells.
    film.play();
    assert!(film.wait_for_status().is_none() && !film.has_changed());
    film.play();
    assert_eq!(film.wait_for_status(), Some(GLANCE));
}

/// They would be read from the middle of a line.
#[test]
fn other_contents_of_a_file_that_is_followed_end_the_film() {
    let mut film = followed("cut.xyz", 3);
    film.play();
    assert_eq!((next(&mut film), next(&mut film)), (1.0, 2.0));
    wait_until(&film, |state| state.unwritten == Some(3));
    std::fs::write(path("cut.xyz"), text(4).replace('C', "O")).expect("a file");
    wait_until(&film, |state| state.ending.is_some());
    stops_with_news(&mut film);
    assert_eq!(film.status(), "frame 3: the file was written anew, with other contents");
}

/// What it still has can be shown, and why it stopped is told.
#[test]
fn a_file_that_is_gone_stops_where_it_would_begin_again() {
    let mut film = film("gone.xyz", 4);
    wait_until(&film, |state| state.count.is_some());
    std::fs::remove_file(path("gone.xyz")).expect("the file");
    film.play();
    for x in [1.0, 2.0, 3.0] {
        assert_eq!(next(&mut film), x);
    }
    stops_with_news(&mut film);
    assert!(film.status().starts_with("frame 0: "), "{}", film.status());
    assert_eq!(stepped(&mut film, false), 2.0);
    assert_eq!(film.status(), "2/4");
}
