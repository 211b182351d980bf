//! What the viewer does while a picture takes long: it answers keys, and ends the drawing if one wants another picture.

use super::attended::attend;
use super::film::Film;
use super::frame::Occasion;
use super::pace::PATIENCE;
use super::session::{Picture, Viewer};
use super::shown::{Outcome, Shown};
use super::studio::{Manner, Studio};
use super::wanted::Wanted;
use crate::error::Error;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// The time between two answers to keys.
const ANSWER: Duration = Duration::from_millis(100);

/// What came of a drawing: the picture and how long it took, or `None` if it was given up; and what was asked for
/// meanwhile.
type Came = (Option<(Picture, Duration)>, Outcome);

/// What is seen besides a picture, however that is moved: when it changes, it is shown soon.
#[derive(PartialEq)]
struct Apart {
    shown: Shown,
    notice: Option<String>,
    /// Whether frames are played. How many have been counted is no answer to a key.
    plays: bool,
    /// Whether it is known what the terminal shows.
    is_known: bool,
}

impl Viewer {
    /// Draws the picture that is wanted, and takes input as long as that takes.
    pub(super) fn draw(
        &mut self,
        studio: &mut Studio<'_>,
        wanted: Wanted,
        occasion: &Occasion,
    ) -> Result<Came, Error> {
        let moving = occasion.moving;
        let (seam, spending) = (self.state.seam(), self.pace.spending(moving));
        let manner = Manner { seam, moving, spending };
        let (threads, scene) = (studio.threads(), Arc::clone(&self.scene));
        let work = move || studio.draw(&scene, &wanted, manner);
        let began = Instant::now();
        let (mut outcome, mut said, mut due) = (Outcome::Unchanged, began, Some(began + PATIENCE));
        let drawn = attend(threads, work, || {
            let before = self.apart_from(&wanted);
            outcome = outcome.and(self.take_input(None, Some(Duration::ZERO))?);
            if outcome == Outcome::Quit || self.has_given_up(&wanted, moving, began.elapsed()) {
                outcome = outcome.and(Outcome::Changed);
                return Ok(false);
            }
            if self.apart_from(&wanted) != before {
                due = Some(said + ANSWER);
            }
            let now = Instant::now();
            if due.is_some_and(|due| due <= now) && self.flow.wait(now).is_none() {
                self.show_meanwhile(&wanted, occasion)?;
                (said, due) = (now, None);
            }
            Ok(true)
        })?;
        Ok((drawn.transpose()?, outcome))
    }

    /// Whether the picture is no longer wanted that has been drawn for so long.
    fn has_given_up(&self, drawn: &Wanted, moving: bool, time: Duration) -> bool {
        let wanted = self.wanted();
        let film = self.film.as_ref();
        let (has_next, plays) =
            (film.is_some_and(Film::has_next), film.is_some_and(Film::is_playing));
        if self.postponed.is_some() || !drawn.moves_to(&wanted) {
            true
        } else if moving {
            // What plays and spins shows all its pictures, however long they take.
            let has_moved_on = *drawn != wanted || has_next && !plays;
            has_moved_on && self.pace.may_give_up(time)
        } else {
            *drawn != wanted || has_next || self.state.shown.spinning
        }
    }

    /// What is seen now besides the picture that is `drawn`. A key that merely moves that has its answer in the next one.
    fn apart_from(&self, drawn: &Wanted) -> Apart {
        Apart {
            shown: self.state.shown.moved_as(&drawn.pictured),
            notice: self.notice.clone(),
            plays: self.film.as_ref().is_some_and(Film::is_playing),
            is_known: self.encoder.shown().is_some(),
        }
    }

    /// Shows the last picture, what is written over it now, and that the next one is being drawn.
    fn show_meanwhile(&mut self, wanted: &Wanted, occasion: &Occasion) -> Result<(), Error> {
        let last = self.picture.take();
        let fits = |last: &&Picture| last.of.size == wanted.size && last.of.cell == wanted.cell;
        let shown = match last.as_ref().filter(fits) {
            Some(last) => self.present(last, None, None, occasion),
            None => self.present(&Picture::blank(*wanted), None, None, occasion),
        };
        self.picture = last;
        shown
    }
}
