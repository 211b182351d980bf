//! A terminal that answers nothing, and is closed while the program runs: a window, or a link that breaks.

use super::session::size;
use portable_pty::{Child, CommandBuilder, PtyPair, native_pty_system};
use std::io::{Read, Write};

pub(crate) struct Window {
    pair: PtyPair,
    child: Box<dyn Child + Send + Sync>,
    reader: Box<dyn Read + Send>,
    sent: Vec<u8>,
    /// As long as it is open: when it is dropped it types an end of input.
    keys: Option<Box<dyn Write + Send>>,
}

impl Window {
    pub(crate) fn open(program: CommandBuilder, (columns, rows): (u16, u16)) -> Self {
        let pair = native_pty_system().openpty(size(columns, rows)).expect("a pseudo-terminal");
        let child = pair.slave.spawn_command(program).expect("the program starts");
        let reader = pair.master.try_clone_reader().expect("output can be read");
        Self { pair, child, reader, sent: Vec::new(), keys: None }
    }

    pub(crate) fn read_until(&mut self, until: impl Fn(&[u8]) -> bool) {
        let mut bytes = [0; 4096];
        while !until(&self.sent) {
            let count = self.reader.read(&mut bytes).expect("the program writes");
            self.sent.extend_from_slice(&bytes[..count]);
        }
    }

    pub(crate) fn type_in(&mut self, key: &[u8]) {
        let writer = || self.pair.master.take_writer().expect("input can be written");
        self.keys.get_or_insert_with(writer).write_all(key).expect("it listens");
    }

    /// Closes it, by which the program ends.
    pub(crate) fn close(mut self) {
        drop((self.keys, self.pair, self.reader));
        let status = self.child.wait().expect("it is our child");
        assert_eq!(status.signal(), Some("Hangup"), "{status}");
    }
}
