//! A program in a pseudo-terminal of its own, and what its screen shows.
//!
//! Nothing here sleeps for a fixed time, except to see that nothing happens. Every wait looks until its condition
//! holds, and a test fails if that takes longer than [`PATIENCE`].

use super::emulated::{Answers, Emulated};
use super::modes;
use portable_pty::{
    Child, CommandBuilder, ExitStatus, MasterPty, PtySize, SlavePty, native_pty_system,
};
use rustix::fd::OwnedFd;
use rustix::fs::{Mode, OFlags};
use rustix::io::{Errno, ioctl_fionread};
use rustix::process::{Pid, Signal, WaitId, WaitIdOptions, kill_process, waitid};
use rustix::termios::{Action, QueueSelector, Termios, tcflow, tcflush, tcgetattr};
use std::ffi::OsStr;
use std::fs;
use std::io::{Read, Write};
use std::num::NonZeroU16;
use std::path::PathBuf;
use std::sync::{Arc, Condvar, Mutex, MutexGuard};
use std::thread;
use std::time::{Duration, Instant};

/// Far longer than anything takes on a loaded machine.
const PATIENCE: Duration = Duration::from_secs(60);
/// The time between two looks at something that does not report changes.
const GLANCE: Duration = Duration::from_millis(2);
/// Far longer than the viewer delays anything: if nothing happens for so long, nothing will.
const STILLNESS: Duration = Duration::from_millis(400);
/// The test itself writes this into the terminal: all output of the program comes before it. No terminal knows this
/// sequence, so none shows it.
const END_MARK: &[u8] = b"\x1b]7777;all has been read\x07";

/// What has come out of the terminal so far.
pub(crate) struct Output {
    pub(crate) terminal: vt100::Parser,
    pub(crate) sent: Vec<u8>,
}

impl Output {
    pub(crate) fn screen(&self) -> &vt100::Screen {
        self.terminal.screen()
    }
}

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
    /// Starts `program` in a terminal of `columns` x `rows` that answers as a good one does.
    pub(crate) fn start(
        program: impl AsRef<OsStr>,
        arguments: &[&str],
        variables: &[(&str, &str)],
        size: (u16, u16),
    ) -> Self {
        Self::start_in(Emulated::good(), program, arguments, variables, size)
    }

    /// The same in another kind of terminal, or over a link.
    pub(crate) fn start_in(
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

    /// Waits until `found` finds something in the output, and returns that.
    pub(crate) fn wait_for<T>(&self, what: &str, found: impl Fn(&Output) -> Option<T>) -> T {
        let mut result = None;
        self.wait_until(what, &mut |output| {
            result = found(output);
            result.is_some()
        });
        result.expect("it has been waited for")
    }

    fn wait_until(&self, what: &str, is_so: &mut dyn FnMut(&Output) -> bool) {
        let deadline = Instant::now() + PATIENCE;
        let mut output = self.output();
        loop {
            if is_so(&output) {
                return;
            }
            let left = deadline.saturating_duration_since(Instant::now());
            if left.is_zero() {
                let shown = output.screen().contents();
                drop(output);
                panic!("waited in vain for {what}; the screen shows:\n{shown}");
            }
            output = self.output.1.wait_timeout(output, left).expect("the reader lives").0;
        }
    }

    /// Waits until the program neither sends anything nor wakes up for a while.
    pub(crate) fn wait_for_peace(&self) {
        self.poll("peace", || (!self.stirs()).then_some(()));
    }

    /// Whether the program sends anything or wakes up within a while.
    pub(crate) fn stirs(&self) -> bool {
        let signs = || (self.output().sent.len(), self.sleeps());
        let before = signs();
        thread::sleep(STILLNESS);
        signs() != before
    }

    /// How often the program's threads went to sleep, which is how often they woke up. Only Linux tells.
    fn sleeps(&self) -> u64 {
        if !cfg!(target_os = "linux") {
            return 0;
        }
        let tasks = format!("/proc/{}/task", self.pid);
        let statuses = fs::read_dir(tasks).expect("it runs").filter_map(|task| {
            let status = fs::read_to_string(task.expect("a thread").path().join("status"));
            // A thread that ends meanwhile changes the sum.
            let has_ended =
                |error| matches!(Errno::from_io_error(error), Some(Errno::NOENT | Errno::SRCH));
            if status.as_ref().is_err_and(has_ended) {
                None
            } else {
                Some(status.expect("a status"))
            }
        });
        let sleeps = statuses.map(|status| {
            let line =
                status.lines().find_map(|line| line.strip_prefix("voluntary_ctxt_switches:"));
            line.and_then(|count| count.trim().parse::<u64>().ok()).expect("a count")
        });
        sleeps.sum()
    }

    /// The name of the program's side.
    pub(crate) fn terminal_name(&self) -> PathBuf {
        self.master.tty_name().expect("it has a name")
    }

    /// The names of all that the program has open; of none, except on Linux.
    pub(crate) fn open_files(&self) -> Vec<PathBuf> {
        let Ok(files) = fs::read_dir(format!("/proc/{}/fd", self.pid)) else { return Vec::new() };
        files.filter_map(|file| fs::read_link(file.ok()?.path()).ok()).collect()
    }

    /// The modes of the program's side now.
    pub(crate) fn modes(&self) -> Termios {
        tcgetattr(&self.line).expect("it is a terminal")
    }

    /// Waits until the program is stopped, as a shell does.
    pub(crate) fn wait_until_stopped(&self) {
        self.poll("a stop", || {
            let options = WaitIdOptions::STOPPED | WaitIdOptions::NOHANG;
            waitid(WaitId::Pid(self.pid), options).expect("it is our child")
        });
    }

    /// Waits for the program's end, and until all that it has sent is read.
    pub(crate) fn wait_for_end(&mut self) -> ExitStatus {
        let status = self.wait_for_exit();
        rustix::io::write(&self.line, END_MARK).expect("the terminal takes the mark");
        self.wait_for("the last bytes", |output| output.sent.ends_with(END_MARK).then_some(()));
        status
    }

    /// Waits for the program's end, but not for its output.
    pub(crate) fn wait_for_exit(&mut self) -> ExitStatus {
        let deadline = Instant::now() + PATIENCE;
        loop {
            if let Some(status) = self.child.try_wait().expect("it is our child") {
                return status;
            }
            assert!(Instant::now() < deadline, "waited in vain for the end of the program");
            thread::sleep(GLANCE);
        }
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

    fn poll<T>(&self, what: &str, look: impl Fn() -> Option<T>) -> T {
        let deadline = Instant::now() + PATIENCE;
        loop {
            if let Some(found) = look() {
                return found;
            }
            assert!(Instant::now() < deadline, "waited in vain for {what}");
            thread::sleep(GLANCE);
        }
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
