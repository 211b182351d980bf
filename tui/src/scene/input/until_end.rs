//! A reader whose first end is its end.

use std::io::{self, Read};

/// Asks `reader` for nothing more once it has ended. What a terminal has after that are keys of someone else.
pub(super) struct UntilEnd<R> {
    reader: R,
    has_ended: bool,
}

impl<R: Read> UntilEnd<R> {
    pub(super) fn new(reader: R) -> Self {
        Self { reader, has_ended: false }
    }
}

impl<R: Read> Read for UntilEnd<R> {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        if self.has_ended || bytes.is_empty() {
            return Ok(0);
        }
        let read = self.reader.read(bytes)?;
        self.has_ended = read == 0;
        Ok(read)
    }
}

#[cfg(test)]
mod tests {
    use crate::scene::input::Input;
    use std::io::{self, Read};

    /// What is typed, in the parts in which it is read; one of nothing is an end.
    struct Typed(Vec<&'static [u8]>);

    const TYPED: [&[&[u8]]; 2] = [&[b"1\n", b"", b"q"], &[b"one line\n", b"two\n", b"", b"q"]];

    impl Read for Typed {
        fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
            let part = self.0.first_mut().expect("it is not asked again");
            let read = part.read(bytes)?;
            if part.is_empty() {
                self.0.remove(0);
            }
            Ok(read)
        }
    }

    #[test]
    fn what_comes_after_an_end_is_left_alone() {
        for parts in TYPED {
            let typed = Typed(parts.to_vec());
            let mut input = Input::of_reader(Box::new(typed), "-").expect("an input");
            for part in &parts[..parts.len() - 2] {
                let line = input.line().expect("no error").expect("a line");
                assert_eq!(line.bytes, part.trim_ascii());
            }
            for _ in 0..3 {
                assert!(input.line().expect("no error").is_none());
                assert!(input.is_over().expect("no error"));
            }
        }
    }
}
