//! The judge's own scenes equal their files. After a change, write the files again:
//!
//! ```text
//! cargo test -p spherule-tests -- --ignored pin_scenes
//! ```

use spherule::scene::open;
use spherule_tests::art::scenes::KEPT;
use std::fs;

#[test]
fn scenes_are_as_made() {
    for (kept, spheres) in KEPT.iter().zip([301, 3000]) {
        let text = fs::read_to_string(kept.path()).expect("a file");
        assert!(text == (kept.text)(), "{} is not as it is made", kept.name);
        let scene = open::scene(&kept.path()).expect("a scene");
        assert_eq!(scene.spheres().len(), spheres, "{}", kept.name);
    }
}

#[test]
#[ignore = "writes tests/cases"]
fn pin_scenes() {
    for kept in KEPT {
        fs::write(kept.path(), (kept.text)()).expect("a file");
    }
}
