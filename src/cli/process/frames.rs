//! Inputs and answers as binary frames of 64-bit little-endian words.
//!
//! An input is its count of numbers and the numbers; an answer likewise. Two counts that no answer
//! has mean something else: all bits set, a refusal; one less, a text (its length in bytes, then
//! the bytes, filled up with zeros to whole words), whose lines are those of a header.

use crate::cli::number::FIELDS;
use mechaudit::audit::SolverAnswer;
use std::io::{BufReader, ErrorKind, Read};

/// In place of a count: the code refuses.
pub const REFUSAL: u64 = u64::MAX;
/// In place of a count: a text follows.
pub const TEXT: u64 = u64::MAX - 1;
/// Bytes of a text.
const LONGEST: usize = 4096;

/// The contents of a frame.
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

    /// Returns true if the end of the next frame has to be waited for.
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

    /// The next frame, or nothing at the end. A frame that is cut off is an answer that cannot be
    /// read; a count that none has ends the stream, whose frames cannot be told apart any more.
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

    /// A stream that ends within a frame.
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

    /// A text of that many bytes, filled up to whole words.
    fn text(length: usize) -> Vec<u8> {
        let mut bytes = TEXT.to_le_bytes().to_vec();
        bytes.extend((length as u64).to_le_bytes());
        bytes.resize(bytes.len() + length, b'a');
        bytes.resize(bytes.len().next_multiple_of(8), 0);
        bytes
    }

    #[test]
    fn texts_end_with_whole_words() {
        for length in [0, 1, 7, 8, 9, LONGEST] {
            let mut bytes = text(length);
            encode(&[2.0], &mut bytes);
            let due = [
                Frame::Text("a".repeat(length)),
                Frame::Answer(Values(vec![2.0])),
            ];
            assert_eq!(all(&bytes), (due.into(), None), "{length}");
        }
        let (found, why) = all(&text(LONGEST + 1));
        assert!(found.is_empty());
        assert_eq!(why.unwrap(), "a text of 4097 bytes, more than 4096");
    }

    /// Texts are no answers, and are not counted as such.
    #[test]
    fn a_bad_frame_is_named_by_its_number() {
        let mut bytes = text(3);
        encode(&[1.0], &mut bytes);
        bytes.extend(text(3));
        let mut large = bytes.clone();
        large.extend((FIELDS as u64 + 1).to_le_bytes());
        let due = "frame 2 claims 100001 values, more than 100000";
        assert_eq!(all(&large).1.as_deref(), Some(due));
        bytes.extend(1u64.to_le_bytes());
        let (found, error) = all(&bytes);
        let last = Frame::Answer(Fails("frame 2 is cut off".into()));
        assert_eq!((found.last(), error), (Some(&last), None));
    }

    #[test]
    fn the_longest_answer_is_read() {
        let mut bytes = Vec::new();
        encode(&vec![1.0; FIELDS], &mut bytes);
        let (found, error) = all(&bytes);
        assert_eq!((found.len(), error), (1, None));
        assert!(matches!(&found[0], Frame::Answer(Values(v)) if v.len() == FIELDS));
    }

    /// After its end a stream has no more frames, whatever its source gives.
    #[test]
    fn a_stream_that_is_cut_off_has_ended() {
        let mut frames = Frames::new(BufReader::new(&[1, 2, 3][..]));
        let cut = frames.read().unwrap();
        assert_eq!(cut, Some(Frame::Answer(Fails("frame 1 is cut off".into()))));
        assert_eq!(frames.read().unwrap(), None);
        let mut none = Frames::new(BufReader::new(&[][..]));
        assert_eq!(none.read().unwrap(), None);
    }

    /// A whole frame in memory is not waited for; an incomplete one is.
    #[test]
    fn a_frame_that_is_not_whole_is_waited_for() {
        let drained = |bytes: &[u8]| {
            // A refusal before it fills the memory of the reader.
            let all = [&REFUSAL.to_le_bytes(), bytes].concat();
            let mut frames = Frames::new(BufReader::new(&all[..]));
            assert!(frames.is_drained());
            frames.read().unwrap();
            frames.is_drained()
        };
        let mut two = Vec::new();
        encode(&[1.0, 2.0], &mut two);
        assert!(drained(&[]) && drained(&two[..7]) && drained(&two[..8]));
        assert!(drained(&two[..two.len() - 1]) && !drained(&two));
        assert!(!drained(&REFUSAL.to_le_bytes()) && !drained(&0u64.to_le_bytes()));
        assert!(drained(&TEXT.to_le_bytes()));
    }

    /// A source that is interrupted is asked again; one that fails is not.
    #[test]
    fn interruptions_are_no_errors() {
        struct Source(Vec<std::result::Result<u8, ErrorKind>>);
        impl Read for Source {
            fn read(&mut self, to: &mut [u8]) -> std::io::Result<usize> {
                match self.0.pop() {
                    None => Ok(0),
                    Some(Ok(byte)) => {
                        to[0] = byte;
                        Ok(1)
                    }
                    Some(Err(kind)) => Err(kind.into()),
                }
            }
        }
        let of = |kind: ErrorKind| {
            let mut bytes = Vec::new();
            encode(&[4.0], &mut bytes);
            let mut steps: Vec<_> = bytes.into_iter().map(Ok).collect();
            steps.insert(3, Err(kind));
            steps.reverse();
            Frames::new(BufReader::with_capacity(1, Source(steps))).read()
        };
        let found = of(ErrorKind::Interrupted).unwrap();
        assert_eq!(found, Some(Frame::Answer(Values(vec![4.0]))));
        let why = of(ErrorKind::TimedOut).unwrap_err();
        assert_eq!(why.kind(), ErrorKind::TimedOut);
    }
}
