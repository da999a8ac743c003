//! Answers of a candidate, read on a thread of their own so that waiting for one can end.

use crate::cli::process::frames::{Frame, Frames};
use crate::cli::process::interrupt;
use crate::cli::process::wire::Lines;
use mechaudit::audit::{Method, SolverAnswer};
use std::io::{BufReader, Read};
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, sync_channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

mod batch;
pub use batch::Batch;

/// The number of answers in a chunk, and the number of chunks read ahead.
const TOGETHER: usize = 512;
const AHEAD: usize = 8;
/// Characters of a name or version.
const LONGEST: usize = 80;

/// The form of answers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    Lines,
    Frames,
}

/// The lines of an answer: one, or one for each of its rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AnswerLines {
    /// Rows of an answer.
    rows: usize,
    /// Numbers of a row.
    width: usize,
}

impl Default for AnswerLines {
    /// One line.
    fn default() -> AnswerLines {
        AnswerLines { rows: 1, width: 0 }
    }
}

impl AnswerLines {
    /// The lines of an answer of a method: its rows may stand on a line each where their number is
    /// known.
    pub fn of(method: &(impl Method + ?Sized)) -> AnswerLines {
        let rows = method.rows().and_then(|rows| rows.count.parse().ok());
        AnswerLines {
            rows: rows.unwrap_or(1),
            width: method.outputs().len(),
        }
    }
}

/// The header of a candidate: lines `name: …` and `version: …` before its first answer.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Header {
    pub name: Option<String>,
    pub version: Option<String>,
}

impl Header {
    fn read(&mut self, line: &str) {
        let Some((key, value)) = line.split_once(':') else {
            return;
        };
        let place = match key.trim() {
            "name" => &mut self.name,
            "version" => &mut self.version,
            _ => return,
        };
        let printable = value.trim().chars().filter(|c| !c.is_control());
        let value: String = printable.take(LONGEST).collect();
        if place.is_none() && !value.is_empty() {
            *place = Some(value);
        }
    }
}

/// A chunk of answers, and the error that ends them where they cannot be read.
type AnswerChunk = (Batch, Option<std::io::Error>);

/// A stream of answers.
pub struct Answers {
    from: Receiver<AnswerChunk>,
    here: AnswerChunk,
    /// The number of answers taken from the current chunk.
    taken: usize,
    header: Arc<Mutex<Header>>,
}

/// The reason why there are no more answers to judge.
pub enum End {
    /// There are no more.
    Closed,
    /// One more than there are inputs; whoever knows how many inputs there are says so.
    TooMany,
    /// Nothing came in time.
    Silent,
    /// The time for all of them is over.
    Late,
    /// They cannot be read.
    Unreadable(std::io::Error),
    /// The user has asked to stop.
    Interrupted,
}

impl Answers {
    pub fn of(input: impl Read + Send + 'static, form: Form, lines: AnswerLines) -> Answers {
        let (sender, from) = sync_channel(AHEAD);
        let header = Arc::new(Mutex::new(Header::default()));
        let filled = Arc::clone(&header);
        let input = BufReader::with_capacity(1 << 16, input);
        thread::spawn(move || match form {
            Form::Lines => listen(&mut Rows(Lines::new(input), lines), &filled, &sender),
            Form::Frames => listen(&mut Frames::new(input), &filled, &sender),
        });
        Answers {
            from,
            here: AnswerChunk::default(),
            taken: 0,
            header,
        }
    }

    /// Returns the header read until now.
    pub fn header(&self) -> Header {
        let header = self.header.lock();
        header.unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// The next one, waited for as long as that, or for ever.
    ///
    /// # Errors
    /// The reason why there is none.
    pub fn next(&mut self, patience: Option<Duration>) -> Result<SolverAnswer, End> {
        self.wait(patience)?;
        self.taken += 1;
        Ok(self.here.0.get(self.taken - 1))
    }

    /// Takes the next answer, waiting likewise, and those that are here after it, at most `most`.
    ///
    /// # Errors
    /// The reason why there is none.
    pub fn take(&mut self, most: usize, patience: Duration, into: &mut Batch) -> Result<(), End> {
        let some = self.wait(Some(patience))?.min(most);
        into.extend(&self.here.0, self.taken..self.taken + some);
        self.taken += some;
        Ok(())
    }

    /// Waits until there are answers here; how many.
    fn wait(&mut self, patience: Option<Duration>) -> Result<usize, End> {
        interrupt::flag();
        let start = Instant::now();
        loop {
            if interrupt::is_requested() {
                return Err(End::Interrupted);
            }
            let here = self.here.0.len() - self.taken;
            if here > 0 {
                return Ok(here);
            }
            if let Some(why) = self.here.1.take() {
                return Err(End::Unreadable(why));
            }
            let left = patience.map(|p| p.saturating_sub(start.elapsed()));
            let wait = left.map_or(interrupt::POLL, |l| l.min(interrupt::POLL));
            match self.from.recv_timeout(wait) {
                Ok(heard) => (self.here, self.taken) = (heard, 0),
                Err(RecvTimeoutError::Disconnected) => return Err(End::Closed),
                Err(RecvTimeoutError::Timeout) => {
                    if left.is_some_and(|l| l <= wait) {
                        return Err(End::Silent);
                    }
                }
            }
        }
    }
}

/// A source of answers.
trait Source {
    /// The next answer; lines of a header on the way go to `header`.
    fn answer(&mut self, header: &mut dyn FnMut(&str)) -> Option<std::io::Result<SolverAnswer>>;
    /// Returns true if the next one has to be waited for.
    fn is_drained(&self) -> bool;
}

/// Lines, of which several may be one answer.
struct Rows<R>(Lines<BufReader<R>>, AnswerLines);

impl<R: Read> Rows<R> {
    /// The answer on the next line.
    fn row(&mut self, header: &mut dyn FnMut(&str)) -> Option<std::io::Result<SolverAnswer>> {
        loop {
            match self.0.read_any() {
                Ok(Some(line)) if line.is_comment() => {
                    line.comment().into_iter().for_each(&mut *header)
                }
                Ok(Some(line)) => return Some(Ok(line.answer())),
                Ok(None) => return None,
                Err(e) => return Some(Err(e)),
            }
        }
    }
}

impl<R: Read> Source for Rows<R> {
    fn answer(&mut self, header: &mut dyn FnMut(&str)) -> Option<std::io::Result<SolverAnswer>> {
        let first = self.row(header)?;
        let AnswerLines { rows, width } = self.1;
        let mut values = match first {
            Ok(SolverAnswer::Values(values)) if rows > 1 && values.len() == width => values,
            other => return Some(other),
        };
        for k in 1..rows {
            match self.row(header) {
                Some(Ok(SolverAnswer::Values(row))) if row.len() == width => values.extend(row),
                Some(Ok(SolverAnswer::Values(row))) => {
                    let why = format!("row {k} has {} numbers in the place of {width}", row.len());
                    return Some(Ok(SolverAnswer::Fails(why)));
                }
                // The judge reports an answer of too few numbers.
                None => break,
                other => return other,
            }
        }
        Some(Ok(SolverAnswer::Values(values)))
    }

    fn is_drained(&self) -> bool {
        Lines::is_drained(&self.0)
    }
}

impl<R: Read> Source for Frames<R> {
    fn answer(&mut self, header: &mut dyn FnMut(&str)) -> Option<std::io::Result<SolverAnswer>> {
        loop {
            match self.read() {
                Ok(Some(Frame::Answer(answer))) => return Some(Ok(answer)),
                Ok(Some(Frame::Text(text))) => text.lines().for_each(&mut *header),
                Ok(None) => return None,
                Err(e) => return Some(Err(e)),
            }
        }
    }

    fn is_drained(&self) -> bool {
        Frames::is_drained(self)
    }
}

/// Hands over answers until there are no more or nobody wants them.
fn listen(from: &mut dyn Source, header: &Mutex<Header>, to: &SyncSender<AnswerChunk>) {
    let mut first = true;
    let mut batch = Batch::default();
    loop {
        let answer = from.answer(&mut |line| {
            if first {
                let mut header = header.lock().unwrap_or_else(PoisonError::into_inner);
                header.read(line);
            }
        });
        first = false;
        let (last, unreadable) = match answer {
            Some(Ok(answer)) => {
                batch.push(answer);
                (false, None)
            }
            Some(Err(why)) => (true, Some(why)),
            None => (true, None),
        };
        if (last || batch.len() == TOGETHER || from.is_drained())
            && (!batch.is_empty() || unreadable.is_some())
            && to.send((std::mem::take(&mut batch), unreadable)).is_err()
        {
            return;
        }
        if last {
            return;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::process::frames;

    fn header(bytes: &'static [u8], form: Form) -> (Header, usize) {
        let mut answers = Answers::of(bytes, form, AnswerLines::default());
        let mut count = 0;
        while answers.next(None).is_ok() {
            count += 1;
        }
        (answers.header(), count)
    }

    #[test]
    fn a_header_names_the_code() {
        let text = b"# name: libcerf\n# version:  2.4 \n# other: x\n# name: second\n1,2\n# version: 3\n1\n";
        let (found, answers) = header(text, Form::Lines);
        assert_eq!(found.name.as_deref(), Some("libcerf"));
        assert_eq!((found.version.as_deref(), answers), (Some("2.4"), 2));
        // None is needed, and what is none does no harm.
        assert_eq!(
            header(b"1\n# name: late\n", Form::Lines).0,
            Header::default()
        );
        let (found, _) = header(b"# name: \x1b[31mred\n# version:\n1\n", Form::Lines);
        assert_eq!(found.name.as_deref(), Some("[31mred"));
        assert_eq!(found.version, None);
    }

    /// Lines, each an answer.
    fn one<R: Read>(input: BufReader<R>) -> Rows<R> {
        Rows(Lines::new(input), AnswerLines::default())
    }

    /// Rows of an answer on lines of their own, or on one line.
    #[test]
    fn rows_of_an_answer() {
        let read = |text: &'static [u8]| {
            let lines = AnswerLines { rows: 3, width: 2 };
            let mut answers = Answers::of(text, Form::Lines, lines);
            let mut all = Vec::new();
            while let Ok(answer) = answers.next(None) {
                all.push(answer);
            }
            all
        };
        let whole = SolverAnswer::Values(vec![1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
        let both = read(b"# name: x\n1,2\n3,4\n5,6\n1,2,3,4,5,6\n");
        assert_eq!(both, [whole.clone(), whole.clone()]);
        // A line that is no row is an answer, as a whole answer of another size is.
        assert_eq!(read(b"1\n1,2\n3,4\n5,6\n")[1], whole);
        let short = read(b"1,2\n3\n1,2\n3,4\n5,6\n");
        assert!(matches!(&short[0], SolverAnswer::Fails(why) if why.contains("row 1 has 1")));
        assert_eq!(short[1], whole);
        assert!(matches!(
            read(b"1,2\nrefuse\n")[0],
            SolverAnswer::Declines(_)
        ));
        // An answer that is cut off has too few numbers.
        assert_eq!(
            read(b"1,2\n3,4\n"),
            [SolverAnswer::Values(vec![1.0, 2.0, 3.0, 4.0])]
        );
    }

    /// Answers that have arrived are handed over together.
    #[test]
    fn answers_come_together() {
        let batches = |from: &mut dyn Source| {
            let (to, heard) = sync_channel(AHEAD);
            listen(from, &Mutex::default(), &to);
            drop(to);
            let lengths = heard.iter().map(|(batch, _)| batch.len());
            lengths.collect::<Vec<_>>()
        };
        let mut bytes = Vec::new();
        for _ in 0..3 {
            frames::encode(&[1.0, 2.0], &mut bytes);
        }
        let mut whole = Frames::new(BufReader::new(&bytes[..]));
        assert_eq!(batches(&mut whole), [3]);
        let lines = b"1,2\n1,2\n1,2\n";
        assert_eq!(batches(&mut one(BufReader::new(&lines[..]))), [3]);
        // Those that have arrived do not wait for others.
        let rest = (&lines[..8]).chain(&lines[8..]);
        assert_eq!(batches(&mut one(BufReader::new(rest))), [2, 1]);
        let many = "1\n".repeat(TOGETHER + 1);
        let mut many = one(BufReader::with_capacity(many.len(), many.as_bytes()));
        assert_eq!(batches(&mut many), [TOGETHER, 1]);
    }

    fn values(batch: &Batch) -> Vec<f64> {
        (0..batch.len())
            .map(|k| match batch.get(k) {
                SolverAnswer::Values(v) => v[0],
                other => panic!("{other:?}"),
            })
            .collect()
    }

    /// Answers are taken in their order, at most the number asked for at a time, until there are no more.
    #[test]
    fn answers_are_taken_in_pieces() {
        let patience = Duration::from_secs(60);
        let mut answers = Answers::of(
            &b"1\n2\n3\n4\n5\n6\n"[..],
            Form::Lines,
            AnswerLines::default(),
        );
        let mut all = Batch::default();
        for (most, due) in [(2, 2), (1, 3)] {
            assert!(answers.take(most, patience, &mut all).is_ok());
            assert_eq!(all.len(), due);
        }
        for due in [4.0, 5.0] {
            match answers.next(Some(patience)) {
                Ok(SolverAnswer::Values(v)) => assert_eq!(v, [due]),
                _ => panic!("{due}"),
            }
        }
        assert!(answers.take(9, patience, &mut all).is_ok());
        assert_eq!(values(&all), [1.0, 2.0, 3.0, 6.0]);
        for _ in 0..2 {
            assert!(matches!(
                answers.take(9, patience, &mut all),
                Err(End::Closed)
            ));
        }
        assert!(matches!(answers.next(None), Err(End::Closed)));
    }

    /// Answers before it are handed over.
    #[test]
    fn what_cannot_be_read_is_told_once() {
        let mut bytes = Vec::new();
        frames::encode(&[7.0], &mut bytes);
        frames::encode(&[8.0], &mut bytes);
        bytes.truncate(bytes.len() - 1);
        let mut answers = Answers::of(
            std::io::Cursor::new(bytes),
            Form::Frames,
            AnswerLines::default(),
        );
        match answers.next(None) {
            Ok(SolverAnswer::Values(v)) => assert_eq!(v, [7.0]),
            _ => panic!("an answer"),
        }
        // The last one is cut off, which is an answer of its own or none at all.
        let ends: Vec<bool> = (0..3)
            .map(|_| matches!(answers.next(None), Err(End::Closed)))
            .collect();
        assert!(ends[2], "{ends:?}");
        // Nothing but what cannot be read.
        struct Broken;
        impl Read for Broken {
            fn read(&mut self, _: &mut [u8]) -> std::io::Result<usize> {
                Err(std::io::Error::other("broken"))
            }
        }
        let mut answers = Answers::of(Broken, Form::Lines, AnswerLines::default());
        match answers.next(None) {
            Err(End::Unreadable(why)) => assert_eq!(why.to_string(), "broken"),
            _ => panic!("an error"),
        }
        assert!(matches!(answers.next(None), Err(End::Closed)));
    }

    /// As long as asked for, be it shorter or longer than the time between two looks for Ctrl-C.
    #[test]
    fn silence_is_waited_for() {
        let (sender, receiver) = sync_channel::<Vec<u8>>(1);
        struct Later(Receiver<Vec<u8>>);
        impl Read for Later {
            fn read(&mut self, into: &mut [u8]) -> std::io::Result<usize> {
                let bytes = self.0.recv().unwrap_or_default();
                into[..bytes.len()].copy_from_slice(&bytes);
                Ok(bytes.len())
            }
        }
        let mut answers = Answers::of(Later(receiver), Form::Lines, AnswerLines::default());
        for patience in [Duration::ZERO, interrupt::POLL / 4, interrupt::POLL * 5 / 2] {
            let start = Instant::now();
            let end = answers.next(Some(patience));
            assert!(matches!(end, Err(End::Silent)), "{patience:?}");
            assert!(start.elapsed() >= patience);
        }
        sender.send(b"4\n".to_vec()).unwrap();
        assert!(answers.next(None).is_ok());
        drop(sender);
        assert!(matches!(answers.next(None), Err(End::Closed)));
    }

    /// Names and versions are short, and those in frames count as well.
    #[test]
    fn a_header_is_short() {
        let long = "x".repeat(LONGEST + 1);
        let text: &'static [u8] = format!("# name: {long}\n# version: {}\n1\n", &long[1..])
            .leak()
            .as_bytes();
        let (found, _) = header(text, Form::Lines);
        assert_eq!(found.name.as_deref(), Some(&long[1..]));
        assert_eq!(found.version.as_deref(), Some(&long[1..]));
        assert_eq!(LONGEST, 80);
    }
}
