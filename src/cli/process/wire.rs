//! Inputs and answers as lines of text.

use crate::cli::failure::{Failure, chain};
use crate::cli::number::{LONGEST, LineError, numbers, shortened};
use mechaudit::audit::{SolverAnswer, write_hex_float};
use std::io::{BufRead, BufReader, Read};

/// As a rule an answer is not longer.
const USUAL: usize = 64;

/// A line without its end; one that is longer than allowed is cut.
pub struct Line {
    /// Counted from one, comments included.
    pub number: u64,
    text: Vec<u8>,
}

/// Lines of a stream. Comments (#) are passed over.
pub struct Lines<R> {
    input: R,
    number: u64,
}

impl<R: BufRead> Lines<R> {
    pub fn new(input: R) -> Lines<R> {
        Lines { input, number: 0 }
    }

    /// The next line that is no comment, or nothing at the end.
    pub fn read(&mut self) -> std::io::Result<Option<Line>> {
        loop {
            match self.read_any()? {
                Some(l) if l.is_comment() => {}
                line => return Ok(line),
            }
        }
    }

    /// The next line, be it a comment.
    pub fn read_any(&mut self) -> std::io::Result<Option<Line>> {
        let mut text = Vec::with_capacity(USUAL);
        let limit = LONGEST as u64 + 1;
        if (&mut self.input).take(limit).read_until(b'\n', &mut text)? == 0 {
            return Ok(None);
        }
        if text.last() == Some(&b'\n') {
            text.pop();
        } else if text.len() > LONGEST {
            self.input.skip_until(b'\n')?;
        }
        self.number += 1;
        let number = self.number;
        Ok(Some(Line { number, text }))
    }
}

impl<R: Read> Lines<BufReader<R>> {
    /// Returns true if the end of the next line has to be waited for.
    pub fn is_drained(&self) -> bool {
        !self.input.buffer().contains(&b'\n')
    }
}

impl Line {
    /// Returns true if it is a comment, readable or not.
    pub fn is_comment(&self) -> bool {
        self.text.first() == Some(&b'#')
    }

    fn text(&self) -> Result<&str, LineError> {
        if self.text.len() > LONGEST {
            return Err(LineError::TooLong);
        }
        Ok(std::str::from_utf8(&self.text)?.trim())
    }

    /// Returns the text after `#`, trimmed, if the line is a comment.
    pub fn comment(&self) -> Option<&str> {
        self.text().ok()?.strip_prefix('#').map(str::trim)
    }

    pub fn is_blank(&self) -> bool {
        self.text().is_ok_and(str::is_empty)
    }

    /// An input: numbers separated by commas or blanks.
    pub fn input(&self) -> Result<Vec<f64>, Failure> {
        let numbers = self.text().and_then(numbers);
        numbers.map_err(|e| Failure::caused(e).about(format!("inputs, line {}", self.number)))
    }

    /// An answer; a line that is none is a failure to answer.
    pub fn answer(&self) -> SolverAnswer {
        let failed = |e: LineError| {
            let (line, why) = (self.number, chain(&e));
            SolverAnswer::Fails(format!("malformed answer on line {line}: {why}"))
        };
        let text = match self.text() {
            Ok("") => return failed(LineError::Empty),
            Ok(text) => text,
            Err(why) => return failed(why),
        };
        if let Some(reason) = text.strip_prefix("refuse")
            && (reason.is_empty() || reason.starts_with([' ', '\t', ':']))
        {
            let reason = reason.trim_start_matches([' ', '\t', ':']);
            let reason = (!reason.is_empty()).then(|| shortened(reason.as_bytes()));
            return SolverAnswer::Declines(reason);
        }
        numbers(text).map_or_else(failed, SolverAnswer::Values)
    }
}

/// An input as a line: hexadecimal floats, or decimals that read back as the same numbers.
pub fn line(input: &[f64], decimal: bool) -> String {
    let mut line = String::new();
    write(&mut line, input, decimal);
    line
}

/// [`line`] at the end of a text.
pub fn write(text: &mut String, input: &[f64], decimal: bool) {
    for (k, x) in input.iter().enumerate() {
        if k > 0 {
            text.push(',');
        }
        match decimal {
            true if x.is_nan() => text.push_str("nan"),
            true => text.push_str(&format!("{x:?}")),
            false => write_hex_float(text, *x),
        }
    }
}

#[cfg(test)]
mod tests;
