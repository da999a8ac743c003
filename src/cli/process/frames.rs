//! Inputs and answers as binary frames of 64-bit little-endian words.
//!
//! An input is its count of numbers and the numbers; an answer likewise. Two counts that no answer has
//! mean something else: all bits set, a refusal; one less, a text (its length in bytes, then the bytes,
//! filled up with zeros to whole words), whose lines are those of a header.

use crate::cli::process::wire::FIELDS;
use mechaudit::audit::SolverAnswer;
use std::io::{BufReader, ErrorKind, Read};

/// In place of a count: the code refuses.
pub const REFUSAL: u64 = u64::MAX;
/// In place of a count: a text follows.
pub const TEXT: u64 = u64::MAX - 1;
/// Bytes of a text.
const LONGEST: usize = 4096;

/// What a frame holds.
#[derive(Debug, PartialEq)]
pub enum Frame {
    Answer(SolverAnswer),
    Text(String),
}

/// Writes an input as a frame.
pub fn encode(input: &[f64], to: &mut Vec<u8>) {
    to.extend((input.len() as u64).to_le_bytes());
    input.iter().for_each(|x| to.extend(x.to_le_bytes()));
}

/// Frames of a stream.
pub struct Frames<R> {
    input: BufReader<R>,
    number: u64,
    bytes: Vec<u8>,
    ended: bool,
}

impl<R: Read> Frames<R> {
    pub fn new(input: BufReader<R>) -> Frames<R> {
        Frames {
            input,
            number: 0,
            bytes: Vec::new(),
            ended: false,
        }
    }

    /// Whether the end of the next frame has to be waited for.
    pub fn is_drained(&self) -> bool {
        let Some((word, rest)) = self.input.buffer().split_first_chunk::<8>() else {
            return true;
        };
        match u64::from_le_bytes(*word) {
            REFUSAL => false,
            count => count > rest.len() as u64 / 8,
        }
    }

    /// Reads that many bytes; how many there were.
    fn fill(&mut self, bytes: usize) -> std::io::Result<usize> {
        self.bytes.resize(bytes, 0);
        let mut read = 0;
        while read < bytes {
            match self.input.read(&mut self.bytes[read..]) {
                Ok(0) => break,
                Ok(n) => read += n,
                Err(e) if e.kind() == ErrorKind::Interrupted => {}
                Err(e) => return Err(e),
            }
        }
        Ok(read)
    }

    /// The next frame, or nothing at the end. A frame that is cut off is an answer that cannot be read; a
    /// count that none has ends the stream, whose frames cannot be told apart any more.
    pub fn read(&mut self) -> std::io::Result<Option<Frame>> {
        if self.ended {
            return Ok(None);
        }
        self.number += 1;
        let due = match self.word()? {
            Some(REFUSAL) => return Ok(Some(Frame::Answer(SolverAnswer::Declines(None)))),
            Some(TEXT) => return self.text(),
            Some(count) => usize::try_from(count).unwrap_or(usize::MAX),
            // Between two frames nothing is cut off.
            None if self.bytes.is_empty() => return Ok(None),
            None => return Ok(self.cut()),
        };
        if due > FIELDS {
            let (number, most) = (self.number, FIELDS);
            let text = format!("frame {number} claims {due} values, more than {most}");
            return Err(std::io::Error::other(text));
        }
        if self.fill(8 * due)? < 8 * due {
            return Ok(self.cut());
        }
        let words = self.bytes.chunks_exact(8);
        let number = |b: &[u8]| f64::from_le_bytes(b.try_into().expect("eight bytes"));
        let values = words.map(number).collect();
        Ok(Some(Frame::Answer(SolverAnswer::Values(values))))
    }

    fn word(&mut self) -> std::io::Result<Option<u64>> {
        let read = self.fill(8)?;
        self.ended = read < 8;
        if read == 0 {
            self.bytes.clear();
        }
        let word = self.bytes.as_slice().try_into();
        Ok(word.ok().filter(|_| read == 8).map(u64::from_le_bytes))
    }

    /// What ends within a frame.
    fn cut(&mut self) -> Option<Frame> {
        self.ended = true;
        let why = format!("frame {} is cut off", self.number);
        Some(Frame::Answer(SolverAnswer::Fails(why)))
    }

    fn text(&mut self) -> std::io::Result<Option<Frame>> {
        let Some(bytes) = self.word()? else {
            return Ok(self.cut());
        };
        let length = usize::try_from(bytes).unwrap_or(usize::MAX);
        if length > LONGEST {
            let text = format!("a text of {length} bytes, more than {LONGEST}");
            return Err(std::io::Error::other(text));
        }
        if self.fill(length.next_multiple_of(8))? < length.next_multiple_of(8) {
            return Ok(self.cut());
        }
        self.number -= 1;
        let text = String::from_utf8_lossy(&self.bytes[..length]);
        Ok(Some(Frame::Text(text.into_owned())))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use SolverAnswer::{Declines, Fails, Values};

    fn all(bytes: &[u8]) -> (Vec<Frame>, Option<String>) {
        let mut frames = Frames::new(BufReader::with_capacity(3, bytes));
        let mut found = Vec::new();
        loop {
            match frames.read() {
                Ok(Some(frame)) => found.push(frame),
                Ok(None) => return (found, None),
                Err(e) => return (found, Some(e.to_string())),
            }
        }
    }

    #[test]
    fn frames_come_back() {
        let mut bytes = Vec::new();
        let text = b"name: x";
        bytes.extend(TEXT.to_le_bytes());
        bytes.extend((text.len() as u64).to_le_bytes());
        bytes.extend(text);
        bytes.push(0);
        encode(&[0.1, -0.0, f64::INFINITY], &mut bytes);
        bytes.extend(REFUSAL.to_le_bytes());
        encode(&[], &mut bytes);
        let due = [
            Frame::Text("name: x".into()),
            Frame::Answer(Values(vec![0.1, -0.0, f64::INFINITY])),
            Frame::Answer(Declines(None)),
            Frame::Answer(Values(vec![])),
        ];
        let (found, error) = all(&bytes);
        assert_eq!((found.as_slice(), error), (due.as_slice(), None));
        // Cut off anywhere: what was whole stays, one answer cannot be read.
        for end in 1..bytes.len() {
            let (found, error) = all(&bytes[..end]);
            assert_eq!(error, None);
            let cut =
                matches!(found.last(), Some(Frame::Answer(Fails(why))) if why.contains("cut off"));
            let between = [24, 56, 64, 72].contains(&end);
            assert_eq!(cut, !between, "{end}: {found:?}");
            let whole = found.len() - usize::from(cut);
            assert_eq!(found[..whole], due[..whole], "{end}");
        }
    }

    #[test]
    fn no_count_takes_all_memory() {
        for count in [FIELDS as u64 + 1, 1 << 40, u64::MAX - 2] {
            let (found, error) = all(&count.to_le_bytes());
            assert!(found.is_empty());
            assert!(error.unwrap().contains("frame 1 claims"), "{count}");
        }
        let mut long = TEXT.to_le_bytes().to_vec();
        long.extend(u64::MAX.to_le_bytes());
        assert!(all(&long).1.unwrap().contains("more than 4096"));
    }
}
