//! Bounds on the length of files that are read line by line.

use crate::cli::number::size;
use std::io::{Error, Read, Result};

/// A reader that ends with an error where a line or the whole is too long.
pub struct Bounded<R> {
    input: R,
    line: usize,
    whole: usize,
    /// The bytes read of the current line, and of all lines.
    read: (usize, usize),
    number: u64,
}

impl<R: Read> Bounded<R> {
    /// Creates a reader of at most `line` bytes in a line and `whole` bytes in all.
    pub fn new(input: R, line: usize, whole: usize) -> Bounded<R> {
        Bounded {
            input,
            line,
            whole,
            read: (0, 0),
            number: 1,
        }
    }
}

impl<R: Read> Read for Bounded<R> {
    fn read(&mut self, to: &mut [u8]) -> Result<usize> {
        let n = self.input.read(to)?;
        self.read.1 += n;
        if self.read.1 > self.whole {
            let limit = size(self.whole);
            return Err(Error::other(format!(
                "it is longer than the limit of {limit}"
            )));
        }
        let mut parts = to[..n].split(|b| *b == b'\n');
        let first = parts.next().map_or(0, <[u8]>::len);
        self.read.0 += first;
        for part in parts {
            self.check()?;
            self.number += 1;
            self.read.0 = part.len();
        }
        self.check()?;
        Ok(n)
    }
}

impl<R> Bounded<R> {
    fn check(&self) -> Result<()> {
        if self.read.0 <= self.line {
            return Ok(());
        }
        let (number, limit) = (self.number, size(self.line));
        Err(Error::other(format!(
            "line {number} is longer than the limit of {limit}"
        )))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all(text: &str, line: usize, whole: usize) -> Result<()> {
        // In pieces of any length.
        for piece in [1, 2, 3, 100] {
            let mut read = Bounded::new(text.as_bytes(), line, whole);
            let (mut found, mut buffer) = (Vec::<u8>::new(), vec![0; piece]);
            loop {
                match read.read(&mut buffer)? {
                    0 => break,
                    n => found.extend(&buffer[..n]),
                }
            }
            assert_eq!(found, text.as_bytes());
        }
        Ok(())
    }

    #[test]
    fn what_is_short_is_read_whole() {
        assert!(all("ab\nabc\n\nabc", 3, 11).is_ok());
        let long = all("ab\nabcd\nx", 3, 100).unwrap_err();
        assert_eq!(
            long.to_string(),
            "line 2 is longer than the limit of 3 bytes"
        );
        let large = all("ab\nabc\n", 3, 6).unwrap_err();
        assert_eq!(large.to_string(), "it is longer than the limit of 6 bytes");
    }

    #[test]
    fn nothing_is_endless() {
        let mut zeros = Bounded::new(std::io::repeat(0), 1 << 20, 1 << 26);
        let e = std::io::copy(&mut zeros, &mut std::io::sink()).unwrap_err();
        assert_eq!(e.to_string(), "line 1 is longer than the limit of 1 MiB");
    }
}
