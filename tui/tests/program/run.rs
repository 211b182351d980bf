//! The real program, run and its outcome checked.

use rustix::process::Signal;
use serde_json::Value;
use std::ffi::OsStr;
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

/// Where the tests write. It has a blank in its name, as the folder of the repository may have.
const FOLDER: &str = concat!(env!("CARGO_TARGET_TMPDIR"), "/own files");

/// The program without any variable that decides about colour or characters.
pub(crate) fn spherule() -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_spherule"));
    for name in ["NO_COLOR", "CLICOLOR_FORCE", "COLORTERM", "LC_ALL", "LC_CTYPE", "LANG"] {
        command.env_remove(name);
    }
    command.env("TERM", "xterm-256color").stdin(Stdio::null());
    command
}

/// Runs it with these arguments.
pub(crate) fn run<S: AsRef<OsStr>>(arguments: impl IntoIterator<Item = S>) -> Output {
    spherule().args(arguments).output().expect("the program runs")
}

/// A command line as words, which blanks separate, except those in the name of [`FOLDER`].
pub(crate) fn split(line: &str) -> Vec<String> {
    let line = line.replace(FOLDER, "\0");
    line.split_whitespace().map(|word| word.replace('\0', FOLDER)).collect()
}

/// What it prints by these words.
pub(crate) fn prints(words: &str) -> String {
    printed(run(split(words)))
}

/// The one line of JSON that it prints by these words.
pub(crate) fn json(words: &str) -> Value {
    let text = prints(words);
    assert_eq!(text.lines().count(), 1, "{words}");
    serde_json::from_str(&text).expect("JSON")
}

/// The bytes that it writes to standard output by these words.
pub(crate) fn writes(words: &str) -> Vec<u8> {
    written(run(split(words)))
}

/// The line by which it refuses these words.
pub(crate) fn refuses(words: &str) -> String {
    refusal(&run(split(words)))
}

/// Runs it by a script of a shell, as `$0`; arguments can be added.
pub(crate) fn by_script(script: &str) -> Command {
    let mut command = Command::new("sh");
    command.args(["-c", script]).arg(spherule().get_program());
    command
}

/// Runs it with these words, and `input` on standard input.
pub(crate) fn run_with_input(words: &str, input: &[u8]) -> Output {
    let mut child = spherule()
        .args(split(words))
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program runs");
    // It may have seen enough before it has read everything.
    let _ = child.stdin.take().expect("piped").write_all(input);
    child.wait_with_output().expect("the program ends")
}

/// Runs it with these words while no one reads what it prints.
pub(crate) fn without_reader(words: &str) -> Output {
    let mut command = spherule();
    command.args(split(words)).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().expect("the program runs");
    drop(child.stdout.take());
    child.wait_with_output().expect("the program ends")
}

/// Whether a signal ends the program, as far as can be told. What is ignored where these tests were started is ignored by the
/// program, too; off Linux it supposes so of SIGHUP.
pub(crate) fn is_heard(signal: &Signal) -> bool {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let mask = mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
    let is_heard =
        mask.map_or(*signal != Signal::HUP, |mask| mask >> (signal.as_raw() - 1) & 1 == 0);
    if !is_heard {
        println!("{signal:?} is left out: it is ignored here");
    }
    is_heard
}

/// The bytes that a successful run wrote to standard output.
fn written(output: Output) -> Vec<u8> {
    assert_eq!((output.status.code(), &*stderr(&output)), (Some(0), ""));
    output.stdout
}

/// What a successful run printed.
pub(crate) fn printed(output: Output) -> String {
    String::from_utf8(written(output)).expect("UTF-8")
}

/// What a run said on stderr.
pub(crate) fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).expect("UTF-8")
}

/// The one line that an input error prints, after `spherule: `.
pub(crate) fn refusal(output: &Output) -> String {
    line(output, 2)
}

/// The one line of a run that ends with this code.
fn line(output: &Output, code: i32) -> String {
    let stderr = stderr(output);
    assert_eq!(output.status.code(), Some(code), "{stderr}");
    assert!(output.stdout.is_empty(), "something on stdout, and {stderr}");
    let message = stderr.strip_prefix("spherule: ").expect("the program's name");
    let line = message.strip_suffix('\n').expect("a line");
    assert!(!line.contains('\n'), "more than a line: {stderr}");
    line.to_owned()
}

/// The one line of a failure that is no input error, after `spherule: `.
pub(crate) fn failure(output: &Output) -> String {
    line(output, 1)
}

/// Whether a picture has this size, such as `80x24`.
pub(crate) fn is_of_size(picture: &str, size: &str) -> bool {
    let (columns, rows) = size.split_once('x').expect("a size");
    let is_whole = |line: &str| line.chars().count().to_string() == columns;
    picture.lines().count().to_string() == rows && picture.lines().all(is_whole)
}

/// A file that is this test's own.
pub(crate) fn file(name: &str, bytes: impl AsRef<[u8]>) -> String {
    fs::create_dir_all(FOLDER).expect("a writable folder");
    let path = format!("{FOLDER}/{name}");
    fs::write(&path, bytes).expect("a writable folder");
    path
}

/// An empty folder that is this test's own.
pub(crate) fn folder(name: &str) -> PathBuf {
    let path = Path::new(FOLDER).join(name);
    let _ = fs::remove_dir_all(&path);
    fs::create_dir_all(&path).expect("a writable folder");
    path
}

/// The names of what is in a folder.
pub(crate) fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("a folder");
    entries.map(|entry| entry.expect("an entry").file_name().display().to_string()).collect()
}

/// A `.npy` file of version 1 with this header and data.
pub(crate) fn npy(header: &str, data: &[u8]) -> Vec<u8> {
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend((header.len() as u16).to_le_bytes());
    bytes.extend(header.as_bytes());
    bytes.extend(data);
    bytes
}

/// Such a header: a type, whether the order is Fortran's, a shape.
pub(crate) fn header(descr: &str, is_fortran: &str, shape: &str) -> String {
    format!("{{'descr': {descr}, 'fortran_order': {is_fortran}, 'shape': {shape}, }}\n")
}

/// What is after the header.
pub(crate) fn data(bytes: &[u8]) -> &[u8] {
    let start = 10 + usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
    assert_eq!(start % 64, 0);
    &bytes[start..]
}

/// A `.npy` file of float32 rows.
pub(crate) fn array(rows: usize, columns: usize, values: &[f32]) -> Vec<u8> {
    let data: Vec<u8> = values.iter().flat_map(|value| value.to_le_bytes()).collect();
    npy(&header("'<f4'", "False", &format!("({rows}, {columns})")), &data)
}
