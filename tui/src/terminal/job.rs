//! Whether somebody can continue what Ctrl-Z stops.

use rustix::process::{Pid, getpgid, getppid, getsid};
use std::fs;

/// The numbers of a process's group and session: 0 for those from outside of the namespace that processes are counted in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Place {
    group: i32,
    session: i32,
}

/// The parent of a process, in its namespace.
#[derive(Clone, Copy, Debug)]
struct Parent {
    place: Place,
    /// Whether it is an init of containers.
    is_init: bool,
}

/// Inits of containers, among them what Docker and Podman call those they bring. They make a group for their child, in
/// their session, as a shell does; but they wait for its end alone.
const INITS: [&str; 4] = ["tini", "docker-init", "catatonit", "podman-init"];

/// Whether a shell waits for the process group, as for a job: then it is told of a stop.
///
/// No one is told of the group of a session's leader, such as a program that is all that runs in its terminal, nor of a group
/// whose shell is gone. Where nothing can be known, a shell is supposed.
pub(super) fn has_shell() -> bool {
    // rustix takes no 0 for a number, which Linux may return.
    let places = if cfg!(target_os = "linux") { places_by_files() } else { places_by_calls() };
    let Some((Place { group, session }, parent)) = places else { return true };
    match parent {
        Some(Parent { place, is_init }) => {
            !is_init && place.session == session && is_a_job(group, session, place.group)
        }
        // The parent is outside, and so is a session that it shares.
        None => session == 0,
    }
}

/// Whether a shell has made the `group`; the parent is in a group of the same session.
fn is_a_job(group: i32, session: i32, group_of_parent: i32) -> bool {
    // A parent in the same group, such as a script, is stopped with it. Who waits for that is not told, but the group of
    // the session's leader is no shell's. Outside, a leader's group cannot be told from others.
    group_of_parent != group || group != session || session == 0
}

/// Where the process is, and its parent, if that is in the namespace.
fn places_by_files() -> Option<(Place, Option<Parent>)> {
    let read = |process: &str| {
        let line = fs::read(format!("/proc/{process}/stat")).ok()?;
        Some(String::from_utf8_lossy(&line).into_owned())
    };
    let (own, parent) = of_line(&read("self")?)?;
    if parent == 0 {
        return Some((own, None));
    }
    let line = read(&parent.to_string())?;
    let (place, _) = of_line(&line)?;
    Some((own, Some(Parent { place, is_init: is_init(&line) })))
}

/// Whether the line of its `stat` says that a process is an init of containers.
fn is_init(line: &str) -> bool {
    let name = line.split_once('(').and_then(|(_, rest)| rest.rsplit_once(')'));
    name.is_some_and(|(name, _)| INITS.contains(&name))
}

/// Where a process is, and its parent's number, from the line of its `stat`; its name may hold anything.
fn of_line(line: &str) -> Option<(Place, i32)> {
    let (_, fields) = line.rsplit_once(')')?;
    // The first is its state.
    let mut numbers = fields.split_whitespace().skip(1).map(str::parse::<i32>);
    let mut next = || numbers.next()?.ok();
    let (parent, group, session) = (next()?, next()?, next()?);
    Some((Place { group, session }, parent))
}

/// The same where numbers are never 0.
fn places_by_calls() -> Option<(Place, Option<Parent>)> {
    let read = |process: Option<Pid>| {
        let (group, session) = (getpgid(process).ok()?, getsid(process).ok()?);
        Some(Place { group: group.as_raw_pid(), session: session.as_raw_pid() })
    };
    let (own, parent) = (read(None)?, getppid());
    let parent = match parent {
        Some(_) => Some(Parent { place: read(parent)?, is_init: false }),
        None => None,
    };
    Some((own, parent))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_job_has_a_group_that_a_shell_made() {
        let [shell, job, script] = [100, 200, 300];
        assert!(is_a_job(job, shell, shell));
        assert!(is_a_job(script, shell, job));
        // Started by a script of that job, or by one that is all that runs in its terminal.
        assert!(is_a_job(job, shell, job));
        assert!(!is_a_job(shell, shell, shell));
        // In a namespace: of a shell that was started in it, or part of a job from outside.
        assert!(is_a_job(job, 0, shell));
        assert!(is_a_job(0, 0, 0));
    }

    #[test]
    fn inits_are_known_by_their_names() {
        for (line, expected) in [
            ("1 (tini) S 0 1 1 34816 7 4194560", true),
            ("1 (docker-init) S 0 1 1 34816 7 4194560", true),
            ("1 (podman-init) S 0 1 1 34816 7 4194560", true),
            ("9 (catatonit) S 1 9 1 34816 12 4194560", true),
            ("1 (bash) S 0 1 1 34816 7 4194560", false),
            ("17 (a (tini) b) S 16 15 14 0", false),
            ("17 (tini)) S 16 15 14 0", false),
            ("17 () S 16 15 14 0", false),
            ("17 tini S 16 15 14 0", false),
            ("", false),
        ] {
            assert_eq!(is_init(line), expected, "{line}");
        }
    }

    #[test]
    fn places_are_read_after_any_name() {
        let place = |group, session| Place { group, session };
        for (line, expected) in [
            ("17 (cat) R 16 15 14 34816 -1", Some((place(15, 14), 16))),
            ("17 (a) S 1 (2) b) S 16 15 14 0", Some((place(15, 14), 16))),
            ("1 (spherule) R 0 0 0 0 -1", Some((place(0, 0), 0))),
            ("17 (cat) R 16 15", None),
            ("17 (cat) R 16 x 14", None),
            ("17 cat R 16 15 14", None),
            ("", None),
        ] {
            assert_eq!(of_line(line), expected, "{line}");
        }
    }
}
