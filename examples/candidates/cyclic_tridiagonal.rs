//! Cyclic tridiagonal systems in Rust, in binary frames:
//!
//!     rustc -O -o cyclic_tridiagonal examples/candidates/cyclic_tridiagonal.rs
//!     mechaudit audit cyclic-tridiagonal --binary --exec ./cyclic_tridiagonal
//!
//! A frame is a count and that many numbers, each eight bytes, the least significant first. Input:
//! lower[n], diagonal[n], upper[n], d[n]. In place of a count, all bits set are a refusal; one
//! less, a text about the program: its length, and its bytes up to a multiple of eight.
//!
//! Rows but the last are swept twice, for the right-hand side and for the column of the last
//! unknown.

use std::io::{self, BufReader, BufWriter, Read, Write};

const REFUSAL: u64 = u64::MAX;
const TEXT: u64 = u64::MAX - 1;

/// The next word, or nothing at the end.
fn word(from: &mut impl Read) -> io::Result<Option<u64>> {
    let mut bytes = [0; 8];
    match from.read_exact(&mut bytes) {
        Err(e) if e.kind() == io::ErrorKind::UnexpectedEof => Ok(None),
        other => other.map(|()| Some(u64::from_le_bytes(bytes))),
    }
}

fn numbers(from: &mut impl Read, count: u64) -> io::Result<Vec<f64>> {
    let number = |_| {
        word(from)?
            .map(f64::from_bits)
            .ok_or(io::ErrorKind::UnexpectedEof.into())
    };
    (0..count).map(number).collect()
}

/// The solution; none where a pivot vanishes.
fn solve(lower: &[f64], diagonal: &[f64], upper: &[f64], d: &[f64]) -> Option<Vec<f64>> {
    let m = d.len() - 1;
    // x[i] = p[i] - q[i] x[i+1] - r[i] x[m].
    let (mut p, mut q, mut r) = (vec![0.0; m], vec![0.0; m], vec![0.0; m]);
    for i in 0..m {
        let (before, corner) = match i {
            0 => ([0.0; 3], lower[0]),
            _ => ([p[i - 1], q[i - 1], r[i - 1]], 0.0),
        };
        let l = if i == 0 { 0.0 } else { lower[i] };
        let pivot = diagonal[i] - l * before[1];
        if pivot == 0.0 {
            return None;
        }
        p[i] = (d[i] - l * before[0]) / pivot;
        r[i] = (corner - l * before[2]) / pivot;
        if i + 1 < m {
            q[i] = upper[i] / pivot;
        } else {
            r[i] += upper[i] / pivot;
        }
    }
    for i in (0..m - 1).rev() {
        p[i] -= q[i] * p[i + 1];
        r[i] -= q[i] * r[i + 1];
    }
    let pivot = diagonal[m] - upper[m] * r[0] - lower[m] * r[m - 1];
    if pivot == 0.0 {
        return None;
    }
    let last = (d[m] - upper[m] * p[0] - lower[m] * p[m - 1]) / pivot;
    let rest = p.iter().zip(&r).map(|(p, r)| p - r * last);
    Some(rest.chain([last]).collect())
}

fn main() -> io::Result<()> {
    let mut from = BufReader::new(io::stdin().lock());
    let mut to = BufWriter::new(io::stdout().lock());
    let mut about = b"name: cyclic sweep in Rust\nversion: 1.0".to_vec();
    to.write_all(&TEXT.to_le_bytes())?;
    to.write_all(&(about.len() as u64).to_le_bytes())?;
    about.resize(about.len().next_multiple_of(8), 0);
    to.write_all(&about)?;
    while let Some(count) = word(&mut from)? {
        let v = numbers(&mut from, count)?;
        let n = v.len() / 4;
        let whole = n >= 3 && v.len() == 4 * n;
        let part = |k: usize| &v[k * n..(k + 1) * n];
        match whole
            .then(|| solve(part(0), part(1), part(2), part(3)))
            .flatten()
        {
            Some(x) => {
                to.write_all(&(x.len() as u64).to_le_bytes())?;
                x.iter().try_for_each(|x| to.write_all(&x.to_le_bytes()))?;
            }
            None => to.write_all(&REFUSAL.to_le_bytes())?,
        }
        // An answer that waits in a buffer is one that did not come.
        if from.buffer().is_empty() {
            to.flush()?;
        }
    }
    to.flush()
}
