//! A second process of this program that outlives the first, to end what that one started: whatever
//! ends the first, also what it cannot notice itself, closes a pipe between the two.

use rustix::process::{Pid, Signal, kill_process_group};
use std::io::{Read, Result, Write};
use std::os::unix::process::CommandExt;
use std::process::{Child, Command, Stdio};

/// Makes a process of this program a guard.
const ARGUMENT: &str = "--guard-process-group";

/// This program as a guard.
#[cfg(not(test))]
fn own() -> Result<Command> {
    let own = match cfg!(target_os = "linux") {
        // Also where the file was replaced meanwhile.
        true => "/proc/self/exe".into(),
        false => std::env::current_exe()?,
    };
    let mut guard = Command::new(own);
    guard.arg(ARGUMENT);
    Ok(guard)
}

/// A program of tests is no guard: something that reads as one does.
#[cfg(test)]
fn own() -> Result<Command> {
    Ok(Command::new("cat"))
}

/// A process that ends a process group once this one has ended.
pub struct Guard(Child);

impl Guard {
    pub fn start() -> Result<Guard> {
        let guard = own()?
            .stdin(Stdio::piped())
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            // Signals that a terminal sends to this process do not reach it.
            .process_group(0)
            .spawn()?;
        Ok(Guard(guard))
    }

    /// Any process: that of tests is no guard.
    #[cfg(test)]
    pub fn of(process: Child) -> Guard {
        Guard(process)
    }

    /// Gives it the group of a child.
    pub fn watch(&mut self, child: &Child) -> Result<()> {
        match &mut self.0.stdin {
            Some(pipe) => writeln!(pipe, "{}", child.id()),
            None => Ok(()),
        }
    }

    /// There is nothing to end any more.
    pub fn dismiss(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// Ends all of a child's group. The child, which is not waited for yet, is its first process.
pub fn end_group(child: &Child) {
    let _ = kill_process_group(Pid::from_child(child), Signal::KILL);
}

/// Returns true if this process is a guard, which has done its work then.
pub fn served() -> bool {
    let mut arguments = std::env::args_os().skip(1);
    if arguments.next().is_none_or(|a| a != ARGUMENT) {
        return false;
    }
    // Ends with the process at the other end.
    let mut text = String::new();
    let _ = std::io::stdin().read_to_string(&mut text);
    let group = text.trim().parse().ok().and_then(Pid::from_raw);
    if let Some(group) = group {
        let _ = kill_process_group(group, Signal::KILL);
    }
    true
}
