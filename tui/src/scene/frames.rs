//! The frames of a file: read one by one, in any order where the file can be read again.
//!
//! The start of each frame is remembered as it is passed: 16 bytes a frame. Nothing is read before it is asked for.

use super::Scene;
use super::format::{Context, Format};
use super::input::{Input, Place};
use super::read_error::ReadError;

/// A file that has one frame or more.
#[derive(Debug)]
pub struct Frames {
    input: Input,
    format: Format,
    context: Context,
    /// Where frames begin, as far as that is known: one more than have been passed.
    places: Vec<Place>,
    /// What a file that is followed had just before the last of them, if that is known.
    tail: Option<Vec<u8>>,
    /// The frame at whose start the input is.
    at: usize,
    /// How many there are, once that is known.
    count: Option<usize>,
    follows: bool,
}

impl Frames {
    pub(super) fn new(input: Input, format: Format, context: Context, follows: bool) -> Self {
        let places = vec![input.place()];
        // A pipe is waited for while it is read, and its end is the end.
        let follows = follows && input.can_be_read_again();
        let context = Context { follows, ..context };
        Self { input, format, context, places, tail: None, at: 0, count: None, follows }
    }

    /// The name of the file.
    #[must_use]
    pub fn source(&self) -> &str {
        self.input.source()
    }

    /// How many frames there are, once the end has been seen; `None` for a file that is followed.
    #[must_use]
    pub fn count(&self) -> Option<usize> {
        self.count.filter(|_| !self.follows)
    }

    /// The frame that would be read next: all before it have been passed.
    #[must_use]
    pub fn at(&self) -> usize {
        self.at
    }

    /// Whether more may be written to the file.
    #[must_use]
    pub fn follows(&self) -> bool {
        self.follows
    }

    /// Whether frames that have been read can be read again.
    #[must_use]
    pub fn can_go_back(&self) -> bool {
        self.input.can_be_read_again()
    }

    /// Writes the notes about the file to standard error, each once. From then on, progress of reading is not shown.
    pub fn report(&mut self) {
        self.input.be_quiet();
        let source = self.input.source().to_owned();
        self.context.notes.report(&source);
    }

    /// The notes about the file, each once.
    pub fn notes(&mut self) -> Vec<String> {
        self.context.notes.take().into_iter().map(Into::into).collect()
    }

    /// Notes something.
    pub fn note(&mut self, text: String) {
        self.context.notes.note(text);
    }

    /// Reports `what` if there are frames behind number `frame`.
    pub(crate) fn report_more(&mut self, frame: usize, what: String) {
        // A wrong frame behind the picture does not make it wrong. What a pipe may bring is not waited for.
        let is_asked = self.can_go_back() && !self.follows();
        if is_asked && self.has(frame + 1).unwrap_or(false) {
            self.note(what);
            self.report();
        }
    }

    /// Reads frame `index`, from 0; `None` if there is none, or, in a file that is followed, not yet.
    ///
    /// Frames in between are passed over. To read a frame before the next one, the file must be one that can be read
    /// again.
    ///
    /// # Errors
    /// [`ReadError`] if a frame is not valid, or the file is followed and has other contents now. A frame without particles
    /// is passed.
    pub fn read(&mut self, index: usize) -> Result<Option<Scene>, ReadError> {
        if !self.format.has_frames() && index > 0 {
            self.end_at_one();
            return Ok(None);
        }
        let nearest = index.min(self.places.len() - 1);
        if self.at != nearest && (index < self.at || nearest > self.at) {
            self.input.go(self.places[nearest])?;
            self.at = nearest;
        }
        while self.at < index {
            let format = self.format;
            if !self.attempt(|input, context| format.skip(input, context))?.unwrap_or(false) {
                self.count = Some(self.at);
                return Ok(None);
            }
            self.passed();
        }
        let format = self.format;
        let scene = self.attempt(|input, context| format.frame(input, context));
        let scene = scene.map(Option::flatten);
        match &scene {
            Ok(Some(_)) if !self.format.has_frames() => {
                self.passed();
                self.end_at_one();
            }
            Ok(Some(_)) => self.passed(),
            Ok(None) => self.count = Some(self.at),
            Err(error) if error.is_empty_frame => self.passed(),
            Err(_) => {}
        }
        scene
    }

    /// There is one frame, whatever else is written.
    fn end_at_one(&mut self) {
        (self.count, self.follows) = (Some(1), false);
    }

    /// Whether there is a frame `index`, without reading more of it than need be. A pipe may be behind that frame then.
    ///
    /// # Errors
    /// [`ReadError`] if a frame before it is not valid.
    pub fn has(&mut self, index: usize) -> Result<bool, ReadError> {
        if !self.format.has_frames() {
            return Ok(index == 0);
        }
        if index < self.places.len() - 1 {
            return Ok(true);
        }
        if self.at == index && self.format.has_only_frames() {
            let before = self.input.place();
            let is_over = self.input.is_over_but_blanks()?;
            // A blank line may be the title of the frame.
            if self.can_go_back() {
                self.input.go(before)?;
            }
            return Ok(!is_over);
        }
        // Of a frame that is not wanted there is nothing to note.
        let notes = std::mem::take(&mut self.context.notes);
        let scene = self.read(index);
        self.context.notes = notes;
        Ok(scene?.is_some())
    }

    /// Tries to read what may not be there yet; if it is not, the input goes back to where it was.
    fn attempt<T>(
        &mut self,
        read: impl FnOnce(&mut Input, &mut Context) -> Result<T, ReadError>,
    ) -> Result<Option<T>, ReadError> {
        if self.follows && !self.has_what_was_passed()? {
            return Ok(None);
        }
        let (before, fixed) = (self.input.place(), self.context.fixed);
        let result = read(&mut self.input, &mut self.context);
        // A line without an end may still go on.
        let ends_early = result.as_ref().is_err_and(|error| error.ends_early);
        if self.follows && (ends_early || !self.input.is_terminated()) {
            self.input.go_anew(before)?;
            // The end of the last number may be missing.
            self.context.fixed = fixed;
            return Ok(None);
        }
        result.map(Some)
    }

    /// Whether the file still has what has been passed. One that is copied over again is shorter for a while.
    ///
    /// # Errors
    /// [`ReadError`] if it has something else there: what follows need not begin a line.
    fn has_what_was_passed(&mut self) -> Result<bool, ReadError> {
        let last = self.places[self.places.len() - 1];
        if !self.input.reaches(last, self.places[self.at])? {
            return Ok(false);
        }
        let found = self.input.bytes_before(last);
        if matches!((&self.tail, &found), (Some(tail), Some(found)) if tail != found) {
            let what = "the file was written anew, with other contents";
            return Err(ReadError::whole(self.input.source(), what));
        }
        Ok(true)
    }

    fn passed(&mut self) {
        self.at += 1;
        if self.at == self.places.len() {
            let place = self.input.place();
            self.places.push(place);
            self.tail = if self.follows { self.input.bytes_before(place) } else { None };
        }
    }
}
