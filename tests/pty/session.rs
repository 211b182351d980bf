//! A program in a pseudo-terminal of its own, and what its screen shows.

mod waits;

use super::emulated::{Answers, Emulated};
use super::modes;
use super::output::Output;
use portable_pty::{Child, CommandBuilder, MasterPty, PtySize, SlavePty, native_pty_system};
use rustix::fd::OwnedFd;
use rustix::fs::{Mode, OFlags};
use rustix::io::ioctl_fionread;
use rustix::process::{Pid, Signal, kill_process};
use rustix::termios::{Action, QueueSelector, Termios, tcflow, tcflush, tcgetattr};
use spherule_tests::binary::spherule;
use std::ffi::OsStr;
use std::fs;
use std::io::{Read, Write};
use std::num::NonZeroU16;
use std::path::PathBuf;
use std::sync::{Arc, Condvar, Mutex, MutexGuard};
use std::thread;

/// Where keys are typed and the terminal's answers go.
pub(crate) type Keys = Arc<Mutex<Box<dyn Write + Send>>>;
type Shared = Arc<(Mutex<Output>, Condvar)>;

/// A running program, its terminal, and the terminal's modes from before.
pub(crate) struct Session {
    child: Box<dyn Child + Send + Sync>,
    pid: Pid,
    keys: Keys,
    master: Box<dyn MasterPty + Send>,
    /// The program's side of the terminal. It is kept open, since the last bytes may be lost when its last holder
    /// closes it.
    line: OwnedFd,
    _slave: Box<dyn SlavePty + Send>,
    output: Shared,
    modes_before: String,
}

/// The terminal's model needs at least one cell.
fn cells(count: u16) -> NonZeroU16 {
    NonZeroU16::new(count.max(1)).expect("at least 1")
}

pub(crate) fn size(columns: u16, rows: u16) -> PtySize {
    PtySize { rows, cols: columns, pixel_width: 0, pixel_height: 0 }
}

/// `program` with the environment of a good local terminal, and with `variables`.
pub(crate) fn command(
    program: impl AsRef<OsStr>,
    arguments: &[&str],
    variables: &[(&str, &str)],
) -> CommandBuilder {
    let mut command = CommandBuilder::new(program);
    command.args(arguments);
    for name in ["NO_COLOR", "CLICOLOR_FORCE", "SSH_CONNECTION", "LINES", "COLUMNS"] {
        command.env_remove(name);
    }
    for name in ["LC_ALL", "LC_CTYPE", "TMUX", "TERM_PROGRAM"] {
        command.env_remove(name);
    }
    command.env("LANG", "C.UTF-8");
    command.env("TERM", "xterm-256color");
    command.env("COLORTERM", "truecolor");
    command.env("RUST_BACKTRACE", "0");
    for (name, value) in variables {
        command.env(name, value);
    }
    command
}

impl Session {
    /// Starts `spherule` in a terminal of `columns` x `rows` that answers as a good one does.
    pub(crate) fn start(arguments: &[&str], variables: &[(&str, &str)], size: (u16, u16)) -> Self {
        Self::start_in(Emulated::good(), arguments, variables, size)
    }

    /// The same in another kind of terminal, or over a link.
    pub(crate) fn start_in(
        emulated: Emulated,
        arguments: &[&str],
        variables: &[(&str, &str)],
        size: (u16, u16),
    ) -> Self {
        Self::start_program(emulated, spherule(), arguments, variables, size)
    }

    /// Starts a script of a shell: its `$0` is `spherule`, and its arguments are these.
    pub(crate) fn start_script(script: &str, arguments: &[&str], size: (u16, u16)) -> Self {
        let program = spherule();
        let program = program.to_str().expect("a path that is text");
        let arguments = [&["-c", script, program], arguments].concat();
        Self::start_program(Emulated::good(), "sh", &arguments, &[], size)
    }

    /// Starts any program.
    pub(crate) fn start_program(
        emulated: Emulated,
        program: impl AsRef<OsStr>,
        arguments: &[&str],
        variables: &[(&str, &str)],
        (columns, rows): (u16, u16),
    ) -> Self {
        let pair = native_pty_system().openpty(size(columns, rows)).expect("a pseudo-terminal");
        let name = pair.master.tty_name().expect("it has a name");
        // The program's side must not become the test's own controlling terminal if the test has none, nor be inherited
        // by a program that another test starts meanwhile.
        let flags = OFlags::RDWR | OFlags::NOCTTY | OFlags::CLOEXEC;
        let line = rustix::fs::open(name, flags, Mode::empty()).expect("the program's side opens");
        let modes_before = modes::line_discipline(&tcgetattr(&line).expect("it is a terminal"));

        let command = command(program, arguments, variables);
        let child = pair.slave.spawn_command(command).expect("the program starts");
        let pid = child.process_id().expect("it has an id").try_into().expect("it is positive");

        let terminal = vt100::Parser::new(cells(rows), cells(columns), 0);
        let output: Shared =
            Arc::new((Mutex::new(Output { terminal, sent: Vec::new() }), Condvar::new()));
        let reader = pair.master.try_clone_reader().expect("output can be read");
        let keys = pair.master.take_writer().expect("input can be written");
        let keys: Keys = Arc::new(Mutex::new(keys));
        let Emulated { answers, link } = emulated;
        let mut answers = Answers::new(answers, Arc::clone(&keys));
        let shared = Arc::clone(&output);
        let mut take = move |bytes: &[u8]| {
            let mut output = shared.0.lock().expect("no test panics while it reads");
            output.terminal.process(bytes);
            output.sent.extend_from_slice(bytes);
            answers.look(&output.sent);
            shared.1.notify_all();
        };
        match link {
            None => {
                let mut reader: Box<dyn Read + Send> = reader;
                thread::spawn(move || {
                    let mut bytes = [0; 4096];
                    while let Ok(count @ 1..) = reader.read(&mut bytes) {
                        take(&bytes[..count]);
                    }
                });
            }
            Some(link) => link.carry(reader, take),
        }
        Self {
            child,
            pid: Pid::from_raw(pid).expect("it is not 0"),
            keys,
            master: pair.master,
            line,
            _slave: pair.slave,
            output,
            modes_before,
        }
    }

    /// Types `keys`.
    pub(crate) fn type_in(&mut self, keys: &str) {
        let mut writer = self.keys.lock().expect("whoever answers does not panic");
        writer.write_all(keys.as_bytes()).and_then(|()| writer.flush()).expect("it listens");
    }

    /// Sends `signal` to the program alone.
    pub(crate) fn signal(&self, signal: Signal) {
        kill_process(self.pid, signal).expect("it is still there");
    }

    /// Gives the terminal another size.
    pub(crate) fn resize(&self, columns: u16, rows: u16) {
        // The model first, so that it has the new size when the program draws for it.
        self.output().terminal.screen_mut().set_size(cells(rows), cells(columns));
        self.master.resize(size(columns, rows)).expect("the terminal takes its size");
    }

    /// Gives the terminal's cells another size in pixels, as another font does.
    pub(crate) fn resize_cells(&self, width: u16, height: u16) {
        let (rows, columns) = self.output().screen().size();
        let (columns, rows) = (columns.get(), rows.get());
        let (pixel_width, pixel_height) = (columns * width, rows * height);
        let size = PtySize { pixel_width, pixel_height, ..size(columns, rows) };
        self.master.resize(size).expect("the terminal takes its size");
    }

    /// The terminal no longer knows its size, as one on a serial line; its screen stays.
    pub(crate) fn forget_size(&self) {
        self.master.resize(size(0, 0)).expect("the terminal takes its size");
    }

    /// The output so far. While the guard is held, nothing more is read.
    pub(crate) fn output(&self) -> MutexGuard<'_, Output> {
        self.output.0.lock().expect("the reader does not panic")
    }

    /// Stops the terminal from taking output, as Ctrl-S does outside of raw mode.
    pub(crate) fn block_output(&self) {
        tcflow(&self.line, Action::OOff).expect("the terminal obeys");
    }

    /// Takes all input that the program has not read, as a shell does while the program is stopped.
    pub(crate) fn take_input(&self) {
        tcflush(&self.line, QueueSelector::IFlush).expect("the terminal obeys");
    }

    /// How many bytes of input the program has left to the shell.
    pub(crate) fn unread(&self) -> u64 {
        ioctl_fionread(&self.line).expect("the terminal tells")
    }

    /// The name of the program's side.
    pub(crate) fn terminal_name(&self) -> PathBuf {
        self.master.tty_name().expect("it has a name")
    }

    /// The names of all that the program has open.
    pub(crate) fn open_files(&self) -> Vec<PathBuf> {
        let files = fs::read_dir(format!("/proc/{}/fd", self.pid)).expect("it runs");
        files.filter_map(|file| fs::read_link(file.ok()?.path()).ok()).collect()
    }

    /// The modes of the program's side now.
    pub(crate) fn modes(&self) -> Termios {
        tcgetattr(&self.line).expect("it is a terminal")
    }

    /// Everything that the program has left behind.
    pub(crate) fn left_behind(&self) -> Vec<String> {
        let output = self.output();
        let mut found = modes::left_behind(output.screen(), &output.sent);
        if modes::line_discipline(&self.modes()) != self.modes_before {
            found.push("line discipline".to_owned());
        }
        found
    }
}

impl Drop for Session {
    fn drop(&mut self) {
        if let Ok(None) = self.child.try_wait() {
            let _ = kill_process(self.pid, Signal::KILL);
            let _ = self.child.wait();
        }
    }
}
