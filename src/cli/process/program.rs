//! A running program and all that it starts: its process group, which ends with the audit, however
//! the audit ends.

use crate::cli::failure::Failure;
use crate::cli::process::answers::End;
#[cfg(unix)]
use crate::cli::process::guard::Guard;
use std::io;
use std::path::Path;
use std::process::{Child, ChildStdin, ChildStdout, Command, ExitStatus, Stdio};
use std::thread;
use std::time::{Duration, Instant};

/// It is ended, with all it started, when this goes.
pub struct Program {
    child: Child,
    #[cfg(unix)]
    guard: Guard,
    /// It has given its number away, and its group's.
    waited_for: bool,
}

impl Program {
    /// Starts a command in a folder, or in the current one; `protocol` tells it how it is spoken to.
    pub fn start(command: &str, folder: Option<&Path>, protocol: &str) -> Result<Program, Failure> {
        let words = shell_words::split(command)
            .map_err(|e| Failure::caused(e).about(format!("--exec {command:?}")))?;
        let [program, arguments @ ..] = words.as_slice() else {
            return Err(Failure::new("--exec needs a command"));
        };
        let mut start = Command::new(program);
        start.args(arguments);
        folder.map(|folder| start.current_dir(folder));
        start.env("MECHAUDIT_PROTOCOL", protocol);
        start.stdin(Stdio::piped()).stdout(Stdio::piped());
        let failed = |e: io::Error| Failure::caused(e).about(format!("cannot start {program:?}"));
        #[cfg(unix)]
        {
            std::os::unix::process::CommandExt::process_group(&mut start, 0);
            // Before the program, which is to have no moment without it.
            let mut guard = Guard::start().map_err(failed)?;
            let child = start.spawn().map_err(failed)?;
            let watched = guard.watch(&child).map_err(failed);
            let program = Program {
                child,
                guard,
                waited_for: false,
            };
            watched.map(|()| program)
        }
        #[cfg(not(unix))]
        Ok(Program {
            child: start.spawn().map_err(failed)?,
            waited_for: false,
        })
    }

    /// Its standard input and output.
    pub fn pipes(&mut self) -> Result<(ChildStdin, ChildStdout), Failure> {
        let pipes = self.child.stdin.take().zip(self.child.stdout.take());
        pipes.ok_or_else(|| Failure::new("the program has no standard input or output"))
    }

    /// Ends it and says what was wrong with its end, if anything was.
    pub fn end(&mut self, end: End, timeout: Duration) -> Option<String> {
        let seconds = timeout.as_secs_f64();
        match end {
            End::Closed => match self.wait(timeout) {
                None => Some(format!(
                    "ended its output but not itself within {seconds} s"
                )),
                Some(status) if status.success() => None,
                Some(status) => Some(format!("ended: {}", ended(status))),
            },
            End::TooMany => Some("wrote one more line than there are inputs".into()),
            End::Silent => Some(format!("wrote no line for {seconds} s and was ended")),
            End::Unreadable(why) => Some(format!("its output could not be read: {why}")),
            End::Late => Some("its time was over and it was ended".into()),
            End::Interrupted => Some("was interrupted".into()),
        }
    }

    fn wait(&mut self, timeout: Duration) -> Option<ExitStatus> {
        let start = Instant::now();
        while !self.has_ended() {
            if start.elapsed() > timeout {
                return None;
            }
            thread::sleep(Duration::from_millis(2));
        }
        self.end_all()
    }

    /// Returns true if it has ended by itself.
    pub fn has_ended(&mut self) -> bool {
        #[cfg(unix)]
        {
            use rustix::process::{Pid, WaitId, WaitIdOptions, waitid};
            // It keeps its number.
            let options = WaitIdOptions::EXITED | WaitIdOptions::NOHANG | WaitIdOptions::NOWAIT;
            let status = waitid(WaitId::Pid(Pid::from_child(&self.child)), options);
            self.waited_for || status.is_ok_and(|s| s.is_some())
        }
        #[cfg(not(unix))]
        self.child.try_wait().is_ok_and(|s| s.is_some())
    }

    /// Ends what it left behind.
    pub fn end_group(&self) {
        #[cfg(unix)]
        if !self.waited_for {
            crate::cli::process::guard::end_group(&self.child);
        }
    }

    fn end_all(&mut self) -> Option<ExitStatus> {
        self.end_group();
        #[cfg(unix)]
        self.guard.dismiss();
        let _ = self.child.kill();
        self.waited_for = true;
        self.child.wait().ok()
    }
}

impl Drop for Program {
    fn drop(&mut self) {
        self.end_all();
    }
}

fn ended(status: ExitStatus) -> String {
    #[cfg(unix)]
    if let Some(signal) = std::os::unix::process::ExitStatusExt::signal(&status) {
        return format!("killed by signal {signal}");
    }
    match status.code() {
        Some(code) => format!("exit status {code}"),
        None => "for an unknown reason".into(),
    }
}

#[cfg(all(test, target_os = "linux"))]
mod tests {
    use super::*;
    use std::os::unix::process::CommandExt;
    use std::path::PathBuf;

    fn started(command: &[&str]) -> (Program, PathBuf) {
        let spawn = |words: &[&str]| {
            let mut start = Command::new(words[0]);
            start.args(&words[1..]).process_group(0);
            start.stdin(Stdio::piped()).stdout(Stdio::null());
            start.stderr(Stdio::null()).spawn().unwrap()
        };
        let program = Program {
            child: spawn(command),
            guard: Guard::of(spawn(&["cat"])),
            waited_for: false,
        };
        let process = PathBuf::from(format!("/proc/{}", program.child.id()));
        assert!(process.exists());
        (program, process)
    }

    /// Once it is waited for, its number may be that of another process.
    #[test]
    fn what_is_waited_for_has_ended() {
        let (mut program, process) = started(&["true"]);
        let end = program.end(End::Closed, Duration::from_secs(60));
        assert_eq!(end, None);
        assert!(program.has_ended() && !process.exists());
    }

    #[test]
    fn a_program_ends_with_its_owner() {
        let (mut program, process) = started(&["cat"]);
        assert!(!program.has_ended());
        drop(program);
        assert!(!process.exists());
    }
}
