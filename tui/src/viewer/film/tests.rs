use super::*;
use crate::scene::open::{Opened, open};
use crate::scene::reading::Reading;

fn film(name: &str, count: usize) -> Film {
    let text: String = (0..count).map(|index| format!("1\n\nC {index} 0 0\n")).collect();
    let path = std::env::temp_dir().join(format!("spherule-{}-{name}", std::process::id()));
    std::fs::write(&path, text).expect("a file");
    let Ok(Opened::File(mut frames)) = open(path.to_str().expect("UTF-8"), &Reading::default())
    else {
        panic!("no file")
    };
    let _ = frames.read(0).expect("a frame").expect("a frame");
    Film::new(frames, 0, |_| ()).expect("a thread")
}

/// x of the next frame, once it is there.
fn next(film: &mut Film) -> f32 {
    for _ in 0..2000 {
        if let Some(scene) = film.next() {
            return scene.spheres().get(0).expect("an atom").center.x;
        }
        std::thread::sleep(Duration::from_millis(2));
    }
    panic!("no frame comes: {}", film.status());
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
    film.step(true);
    assert_eq!(next(&mut film), 2.0);
    // The end has been seen by now, or is seen by this.
    film.step(true);
    std::thread::sleep(Duration::from_millis(100));
    assert!(film.next().is_none());
    assert_eq!(film.status(), "2/3");
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
    film.step(true);
    assert_eq!(next(&mut film), 1.0);
    std::thread::sleep(Duration::from_millis(200));
    let ready = film.shared.lock().ready.len();
    assert!(ready <= AHEAD + 3, "{ready}");
}
