//! What is told of frames, over the picture and in the status line.

use super::*;

/// The one thing that there is to tell.
fn news(film: &mut Film) -> String {
    let news = film.take_news();
    let [news] = &news[..] else { panic!("{news:?}") };
    news.clone()
}

#[test]
fn a_frame_that_is_wrong_is_told_of_where_it_would_be_next() {
    let frame = |index: usize| {
        let x = if index == 20 { "x" } else { "0" };
        format!("2\nframe {index}\nC {index} 0 0\nO {x} {index} 0\n")
    };
    std::fs::write(path("damaged.xyz"), (0..60).map(frame).collect::<String>()).expect("a file");
    let mut film = film_of(path("damaged.xyz").to_str().expect("UTF-8"));
    for x in 1..=19 {
        film.step(true);
        assert_eq!(next(&mut film), x as f32);
        if x == 12 {
            wait_until(&film, |state| state.ending.is_some());
        }
        assert!(x == 19 || film.status().starts_with(&format!("{x}/")), "{}", film.status());
    }
    // The status line has no room for all of it. Whoever asks again is told again.
    let why = format!("frame 20: {}:84:3: x is \"x\": no number", path("damaged.xyz").display());
    for _ in 0..2 {
        assert!(film.next().is_none() && news(&mut film).starts_with(&why));
        assert!(film.next().is_none() && film.take_news().is_empty());
        assert_eq!(film.status(), "frame 20: line 84");
        film.step(true);
    }
    assert!(film.next().is_none() && news(&mut film).starts_with(&why));
    // A step back asks for no more.
    film.step(false);
    assert_eq!(next(&mut film), 18.0);
    assert!(film.take_news().is_empty());
    assert_eq!(film.status(), "18/20!");
}

/// Else it would look as if the file ended there.
#[test]
fn a_film_that_ends_at_a_wrong_frame_says_so_as_it_plays() {
    std::fs::write(path("short.xyz"), text(3) + "2\n\nC 0 0 0\n").expect("a file");
    let mut film = film_of(path("short.xyz").to_str().expect("UTF-8"));
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
    std::fs::write(path("second.xyz"), text(1) + "2\n\nC 0 0 0\n").expect("a file");
    let mut film = film_of(path("second.xyz").to_str().expect("UTF-8"));
    wait_until(&film, |state| state.ending.is_some());
    assert!(film.has_status() && !film.has_more());
    assert!(film.status().starts_with("frame 1: "), "{}", film.status());
    assert!(film.next().is_none() && news(&mut film).starts_with("frame 1: "));
}

#[test]
fn what_frames_lack_is_told_of_the_first_that_is_shown() {
    std::fs::write(path("lacking.xyz"), text(3)).expect("a file");
    let name = path("lacking.xyz");
    let Ok(Opened::File(mut frames)) = open(name.to_str().expect("UTF-8"), &Reading::default())
    else {
        panic!("no file")
    };
    let _ = frames.read(0).expect("a frame").expect("a frame");
    let prepare = |_: &mut Scene| Err("keeps its radii: none".to_owned());
    let mut film = Film::new(frames, 0, prepare).expect("a thread");
    wait_until(&film, |state| state.ready.contains_key(&2));
    assert!(film.next().is_none() && film.take_news().is_empty());
    film.step(true);
    assert_eq!(next(&mut film), 1.0);
    assert_eq!(news(&mut film), "frame 1 keeps its radii: none");
    film.step(true);
    assert_eq!(next(&mut film), 2.0);
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
    film.step(false);
    assert_eq!(next(&mut film), 39.0);
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
