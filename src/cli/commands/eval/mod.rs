//! Values of a function at the cases given on standard input, one a line.

mod binary;

use crate::cli::args::EvalArgs;
use crate::cli::complain;
use crate::cli::failure::{Failure, Outcome, chain};
use crate::cli::files::output::write_to;
use crate::cli::number::{Number, NumberError};
use crate::cli::process::wire::shortened;
use mechaudit::audit::{Layout, LayoutError, SolverAnswer, Uncertified, answer_of, hex_float};
use mechaudit::methods::{Evaluable, evaluable, find_evaluable};
use rayon::prelude::*;
use rug::Rational;
use std::io::{BufRead, BufReader, Read, Write};

/// Lines computed at a time, for each thread.
const LINES: usize = 1024;
/// The longest line.
const LONGEST: usize = 1 << 20;
/// How many lines' worth of text is held at a time.
const BUFFER: usize = 1 << 16;

/// A line with its number, counted from one.
struct Line {
    number: u64,
    text: Vec<u8>,
}

/// Why there is no value.
#[derive(Debug, thiserror::Error)]
enum EvalError {
    #[error("longer than {LONGEST} bytes")]
    TooLong,
    #[error("not UTF-8")]
    NotUtf8(#[from] std::str::Utf8Error),
    #[error(transparent)]
    Number(#[from] NumberError),
    #[error(transparent)]
    Layout(#[from] LayoutError),
    #[error("{0}")]
    OutsideDomain(String),
    #[error("refused: {0}")]
    Refused(&'static str),
    #[error("{0}, no input")]
    NotAnInput(&'static str),
    /// A solver that answers neither with values nor with a refusal.
    #[error("{0:?}")]
    NoAnswer(SolverAnswer),
    #[error(transparent)]
    Uncertified(Uncertified),
    #[error("{0} digits could not be certified")]
    Digits(u32),
}

impl EvalError {
    /// Whether the line is right and its value could not be had.
    fn is_undecided(&self) -> bool {
        use EvalError::{Digits, NoAnswer, Uncertified};
        matches!(self, NoAnswer(_) | Uncertified(_) | Digits(_))
    }
}

/// Evaluates, or lists what can be evaluated.
pub fn eval(args: &EvalArgs) -> Result<Outcome, Failure> {
    let Some(name) = args.name.as_deref().filter(|_| !args.list) else {
        return list();
    };
    let method = find_evaluable(name).ok_or_else(|| {
        let known: Vec<&str> = evaluable().iter().map(|m| m.name()).collect();
        Failure::no_such("method", name, &known)
    })?;
    if binary::is_asked_for() && args.digits.is_none() {
        return binary::stream(&*method);
    }
    let threads = args.threads.unwrap_or(0);
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .map_err(|e| Failure::caused(e).about(format!("cannot start {threads} threads")))?;
    let mut outcome = Outcome::AsExpected;
    write_to(|out| {
        let input = BufReader::with_capacity(BUFFER, std::io::stdin().lock());
        outcome = stream(&*method, args.digits, &pool, input, out)?;
        Ok(())
    })?;
    Ok(outcome)
}

fn list() -> Result<Outcome, Failure> {
    write_to(|out| {
        for m in evaluable() {
            writeln!(out, "{:<31} {}", m.name(), m.summary())?;
        }
        Ok(())
    })?;
    Ok(Outcome::AsExpected)
}

/// Reads some lines, computes them side by side, writes them in order, and so on.
pub fn stream(
    method: &dyn Evaluable,
    digits: Option<u32>,
    pool: &rayon::ThreadPool,
    mut input: BufReader<impl Read>,
    out: &mut dyn Write,
) -> Result<Outcome, Failure> {
    let evaluation = Evaluation {
        method,
        layout: Layout::new(method),
        digits,
    };
    let most = LINES * pool.current_num_threads();
    let mut lines = Vec::new();
    let mut number = 0;
    let mut more = true;
    while more {
        lines.clear();
        // What has arrived is answered before more is waited for.
        while more && lines.len() < most && (lines.is_empty() || has_line(input.buffer())) {
            let mut text = Vec::new();
            let read = (&mut input)
                .take(LONGEST as u64 + 1)
                .read_until(b'\n', &mut text)
                .map_err(|e| Failure::caused(e).about("cannot read standard input"))?;
            more = read > 0 && text.len() <= LONGEST;
            number += 1;
            if read > 0 {
                lines.push(Line { number, text });
            }
        }
        let answers: Vec<_> = match pool.current_num_threads() {
            1 => lines.iter().map(|l| evaluation.answer(l)).collect(),
            _ => pool.install(|| {
                let lines = lines.par_iter();
                lines.map(|l| evaluation.answer(l)).collect()
            }),
        };
        for (line, answer) in lines.iter().zip(answers) {
            let e = match answer {
                Ok(None) => continue,
                Ok(Some(text)) => {
                    writeln!(out, "{text}")?;
                    continue;
                }
                Err(e) => e,
            };
            out.flush()?;
            let shown = format!("line {} ({:?})", line.number, shortened(&line.text));
            if e.is_undecided() {
                complain(&format!("{shown}: {}", chain(&e)));
                return Ok(Outcome::Finding);
            }
            return Err(Failure::caused(e).about(shown));
        }
        out.flush()?;
    }
    Ok(Outcome::AsExpected)
}

fn has_line(buffer: &[u8]) -> bool {
    buffer.contains(&b'\n')
}

/// What is done to every line.
struct Evaluation<'a> {
    method: &'a dyn Evaluable,
    layout: Layout,
    digits: Option<u32>,
}

impl Evaluation<'_> {
    /// The values of a line; nothing for a blank one or a comment.
    fn answer(&self, line: &Line) -> Result<Option<String>, EvalError> {
        if line.text.len() > LONGEST {
            return Err(EvalError::TooLong);
        }
        let text = std::str::from_utf8(&line.text)?.trim();
        if text.is_empty() || text.starts_with('#') {
            return Ok(None);
        }
        let numbers: Vec<Number> = text
            .split(',')
            .map(Number::parse)
            .collect::<Result<_, _>>()?;
        let x: Vec<f64> = numbers.iter().map(Number::nearest).collect();
        self.layout.lengths(&x)?;
        if let Some(why) = self.method.refusal(&x) {
            return Err(EvalError::OutsideDomain(why));
        }
        let values = match self.digits {
            None => match answer_of(self.method, &x) {
                SolverAnswer::Values(values) => values.into_iter().map(hex_float).collect(),
                SolverAnswer::Refuses(why) => return Err(EvalError::Refused(why)),
                other => return Err(EvalError::NoAnswer(other)),
            },
            Some(count) => {
                let exact: Result<Vec<_>, _> = numbers.iter().map(Number::exact).collect();
                digits(self.method, &exact?, count)?
            }
        };
        Ok(Some(values.join(",")))
    }
}

/// That many certified digits of each value.
fn digits(method: &dyn Evaluable, x: &[Rational], digits: u32) -> Result<Vec<String>, EvalError> {
    for bits in precisions(digits) {
        let values = method.certify(x, bits).map_err(|e| match e {
            Uncertified::Refused(why) => EvalError::Refused(why),
            other => EvalError::Uncertified(other),
        })?;
        let texts = values.iter().map(|v| v.to_decimal(digits as usize));
        if let Some(texts) = texts.collect() {
            return Ok(texts);
        }
    }
    Err(EvalError::Digits(digits))
}

/// Bits to try: two digits and four bits more than are asked for, and twice as many up to three times. Most references
/// keep to the relative accuracy asked for, so that the first time is enough.
fn precisions(digits: u32) -> [u32; 4] {
    let first = ((f64::from(digits) + 2.0) * std::f64::consts::LOG2_10).ceil() as u32 + 4;
    [1, 2, 4, 8].map(|times| times * first)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn precisions_double() {
        assert_eq!(precisions(1), [14, 28, 56, 112]);
        assert_eq!(precisions(60), [210, 420, 840, 1680]);
        assert_eq!(precisions(1000), [3333, 6666, 13_332, 26_664]);
    }

    /// Counts how often something is handed on.
    #[derive(Default)]
    struct Handed {
        text: Vec<u8>,
        times: usize,
    }

    impl Write for Handed {
        fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
            self.text.write(bytes)
        }
        fn flush(&mut self) -> std::io::Result<()> {
            self.times += 1;
            Ok(())
        }
    }

    /// Lines that have arrived are answered together, so many for each thread; the end is looked for once more.
    #[test]
    fn lines_are_answered_together() {
        let method = find_evaluable("erf").unwrap();
        let handed = |text: &str, threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
            let input = BufReader::with_capacity(text.len(), text.as_bytes());
            let mut out = Handed::default();
            let pool = pool.build().unwrap();
            let end = stream(&*method, None, &pool, input, &mut out);
            assert!(matches!(end, Ok(Outcome::AsExpected)));
            (
                String::from_utf8(out.text).unwrap().lines().count(),
                out.times,
            )
        };
        assert_eq!(handed("1,0\n2,0\n3,0\n", 1), (3, 2));
        let many = "#\n".repeat(2 * LINES);
        assert_eq!(handed(&many, 2), (0, 2));
        assert_eq!(handed(&format!("{many}#\n"), 2), (0, 3));
    }

    /// The nearest floats to the certified digits are next to what the solver gives.
    #[test]
    fn every_method_can_be_evaluated() {
        for method in evaluable() {
            let name = method.name();
            // It takes seconds to certify a tenth of a second of it.
            if name == "run-up" {
                continue;
            }
            let points = method.domain().check_points;
            let solved = |input: &[f64]| match method.solve(input) {
                SolverAnswer::Values(v) => Some(v),
                _ => None,
            };
            let evaluated = points.iter().any(|point| {
                let exact: Option<Vec<Rational>> =
                    point.input.iter().map(|x| Rational::from_f64(*x)).collect();
                let (Some(exact), Some(values)) = (exact, solved(&point.input)) else {
                    return false;
                };
                let Ok(texts) = digits(&*method, &exact, 20) else {
                    return false;
                };
                assert_eq!(texts.len(), values.len(), "{name}");
                for (text, value) in texts.iter().zip(values) {
                    let certified: f64 = text.parse().unwrap();
                    // Some are the small difference of others.
                    let size = value.abs().max(1e-6);
                    assert!((certified - value).abs() <= 1e-9 * size, "{name}: {text}");
                }
                true
            });
            assert!(evaluated, "{name}");
        }
    }

    #[test]
    fn long_lines_are_shortened_in_messages() {
        assert_eq!(shortened(b" 1,2\r\n"), "1,2");
        let long = shortened("é".repeat(500).as_bytes());
        assert_eq!(long.chars().count(), 81);
    }

    /// What a stream by one thread comes to: its output, and its outcome or why it ended.
    fn streamed(
        name: &str,
        digits: Option<u32>,
        input: &[u8],
    ) -> (String, Result<Outcome, String>) {
        let method = find_evaluable(name).unwrap();
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(1)
            .build()
            .unwrap();
        let mut out = Vec::new();
        let end = stream(&*method, digits, &pool, BufReader::new(input), &mut out);
        (
            String::from_utf8(out).unwrap(),
            end.map_err(|e| e.to_string()),
        )
    }

    /// The longest line is answered, and the next one too.
    #[test]
    fn a_line_may_be_as_long_as_this() {
        let padded = |length: usize| {
            let mut text = vec![b' '; length - 4];
            text.extend(b"0,0\n1,0\n");
            streamed("erf", None, &text)
        };
        let (out, end) = padded(LONGEST);
        assert!(
            out.lines().count() == 2 && end == Ok(Outcome::AsExpected),
            "{end:?}"
        );
        let (out, end) = padded(LONGEST + 1);
        let why = end.unwrap_err();
        assert_eq!(out, "");
        assert!(
            why.starts_with("line 1 (") && why.ends_with("): longer than 1048576 bytes"),
            "{why}"
        );
    }

    /// Answers up to it are there; it is named by its number, comments and blank lines counted.
    #[test]
    fn a_line_that_is_wrong_is_named() {
        for (line, why) in [
            ("1", "1 number"),
            ("1,2,3", "3 numbers"),
            ("1,x", "is neither a decimal nor"),
            ("1,", "is neither a decimal nor"),
        ] {
            let (out, end) = streamed("erf", None, format!("0,0\n# c\n\n{line}\n1,0\n").as_bytes());
            let end = end.unwrap_err();
            assert_eq!(out.lines().count(), 1, "{line}");
            assert!(
                end.starts_with(&format!("line 4 ({line:?}): ")) && end.contains(why),
                "{end}"
            );
        }
        let (out, end) = streamed("erf", None, b"# only\n \n");
        assert_eq!((&*out, end), ("", Ok(Outcome::AsExpected)));
        let (_, end) = streamed("erf", Some(5), b"inf,0\n");
        assert!(end.unwrap_err().contains("must be finite"));
        let (_, end) = streamed("four-bar", None, b"1,1,1,2.5,3,1\n");
        assert!(end.unwrap_err().starts_with("line 1 ("));
    }

    /// Its line is right, and its value cannot be had.
    #[test]
    fn some_errors_are_no_fault_of_the_line() {
        use mechaudit::audit::Uncertified as Why;
        for (e, due) in [
            (EvalError::TooLong, false),
            (EvalError::Refused("no"), false),
            (EvalError::OutsideDomain("no".into()), false),
            (EvalError::NotAnInput("cut off"), false),
            (EvalError::NoAnswer(SolverAnswer::Declines(None)), true),
            (EvalError::Uncertified(Why::Refused("no")), true),
            (EvalError::Digits(5), true),
        ] {
            assert_eq!(e.is_undecided(), due, "{e}");
        }
    }
}
