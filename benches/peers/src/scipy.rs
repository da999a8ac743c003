//! `scipy.special.wofz` in a Python process that measures its own time.

use crate::code::{Code, Codes, Shape};
use num_complex::Complex64;
use std::io::{self, BufRead, BufReader, Read, Write};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::sync::Mutex;
use std::time::Duration;

struct Process {
    child: Child,
    requests: Option<ChildStdin>,
    answers: BufReader<ChildStdout>,
}

impl Drop for Process {
    fn drop(&mut self) {
        self.requests = None;
        let _ = self.child.wait();
    }
}

struct Scipy {
    version: String,
    process: Mutex<Process>,
}

/// Adds it.
pub fn add(codes: &mut Codes) {
    let python = std::env::var("PYTHON").unwrap_or_else(|_| "python3".into());
    let outcome = start(&python)
        .map(|s| Box::new(s) as Box<dyn Code>)
        .map_err(|e| format!("{python} with numpy and scipy: {e} (PYTHON names another one)"));
    codes.add("scipy wofz", outcome);
}

fn start(python: &str) -> Result<Scipy, String> {
    let mut child = Command::new(python)
        .args(["-c", include_str!("scipy_child.py")])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .map_err(|e| e.to_string())?;
    let requests = child.stdin.take();
    let answers = child.stdout.take().ok_or("no standard output")?;
    let mut process = Process {
        child,
        requests,
        answers: BufReader::new(answers),
    };
    let mut version = String::new();
    let read = process.answers.read_line(&mut version);
    if read.map_err(|e| e.to_string())? == 0 {
        return Err("does not start".into());
    }
    Ok(Scipy {
        version: version.trim().to_owned(),
        process: Mutex::new(process),
    })
}

impl Process {
    fn ask(&mut self, z: &[Complex64], out: &mut [Complex64]) -> io::Result<Duration> {
        let mut bytes = Vec::with_capacity(8 + 16 * z.len());
        bytes.extend((z.len() as u64).to_le_bytes());
        for z in z {
            bytes.extend(z.re.to_le_bytes());
            bytes.extend(z.im.to_le_bytes());
        }
        let requests = self.requests.as_mut().ok_or(io::ErrorKind::BrokenPipe)?;
        requests.write_all(&bytes)?;
        requests.flush()?;
        let mut head = [0; 8];
        self.answers.read_exact(&mut head)?;
        bytes.truncate(16 * z.len());
        self.answers.read_exact(&mut bytes)?;
        let number = |b: &[u8]| f64::from_le_bytes(b.try_into().expect("eight bytes"));
        for (w, b) in out.iter_mut().zip(bytes.chunks_exact(16)) {
            *w = Complex64::new(number(&b[..8]), number(&b[8..]));
        }
        Ok(Duration::from_nanos(u64::from_le_bytes(head)))
    }
}

impl Code for Scipy {
    fn name(&self) -> &str {
        "scipy wofz"
    }
    fn version(&self) -> &str {
        &self.version
    }
    fn shape(&self) -> Shape {
        Shape::Batch
    }
    fn evaluate(&self, z: &[Complex64], out: &mut [Complex64]) {
        self.time(z, out);
    }
    fn time(&self, z: &[Complex64], out: &mut [Complex64]) -> Duration {
        let mut process = self.process.lock().expect("no panic in between");
        match process.ask(z, out) {
            Ok(taken) => taken,
            Err(e) => {
                eprintln!("the scipy process stopped: {e}");
                std::process::exit(1);
            }
        }
    }
}
