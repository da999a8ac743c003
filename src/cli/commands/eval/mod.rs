//! Values of a function at the cases given on standard input, one a line.

mod binary;

use crate::cli::args::EvalArgs;
use crate::cli::commands::describe::short;
use crate::cli::complain;
use crate::cli::failure::{Failure, Outcome, chain};
use crate::cli::files::output::write_to;
use crate::cli::lookup;
use crate::cli::number::{Number, NumberError, shortened};
use mechaudit::audit::{
    Layout, LayoutError, SolverAnswer, Uncertified, answer_of, hex_float, selected_outputs,
};
use mechaudit::methods::{CertifiedValue, Evaluable, certified_digits, registry};
use mechaudit::reference::nearest_f64;
use rayon::prelude::*;
use rug::Rational;
use std::io::{BufRead, BufReader, Read, Write};

/// Lines computed at a time, for each thread.
const LINES: usize = 1024;
/// The longest line: a dense matrix of order 1000 fits in, each entry with 17 digits and an
/// exponent.
const LONGEST: usize = 1 << 25;
/// The number of bytes of text held at a time.
const BUFFER: usize = 1 << 16;

/// The word in the place of a value without certified digits.
const UNDECIDED: &str = "undecided";

/// A line with its number, counted from one.
struct Line {
    number: u64,
    text: Vec<u8>,
}

/// The reason why there is no value.
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
    #[error("refused: {}", refused(.word, .why.as_deref()))]
    Refused {
        word: &'static str,
        why: Option<String>,
    },
    #[error("{0}, no input")]
    NotAnInput(&'static str),
    /// A solver that answers neither with values nor with a refusal.
    #[error("{0:?}")]
    NoAnswer(SolverAnswer),
    /// There is no number of which digits could be certified.
    #[error(transparent)]
    Uncertified(Uncertified),
}

/// The name of a refusal, and what is known of it beyond that.
fn refused(word: &str, why: Option<&str>) -> String {
    match why {
        Some(why) => format!("{word}: {why}"),
        None => word.into(),
    }
}

impl EvalError {
    /// Returns true if the line is right and its value is unavailable.
    fn is_undecided(&self) -> bool {
        use EvalError::{NoAnswer, Uncertified};
        matches!(self, NoAnswer(_) | Uncertified(_))
    }
}

/// Evaluates, or lists what can be evaluated.
pub fn eval(args: &EvalArgs) -> Result<Outcome, Failure> {
    let Some(name) = args.name.as_deref().filter(|_| !args.list) else {
        return list();
    };
    let method = lookup::method(name)?;
    if args.digits.is_none() {
        lookup::has_solver(&*method)?;
    }
    let mut evaluation = Evaluation::new(&*method, args.digits);
    if let Some(names) = &args.outputs {
        evaluation.selected = selected_outputs(&*method, names)?;
    }
    if binary::is_asked_for() && args.digits.is_none() {
        return binary::stream(&evaluation);
    }
    let threads = args.threads.unwrap_or(0);
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .map_err(|e| Failure::caused(e).about(format!("cannot start {threads} threads")))?;
    let mut outcome = Outcome::AsExpected;
    write_to(|out| {
        let input = BufReader::with_capacity(BUFFER, std::io::stdin().lock());
        outcome = stream(&evaluation, &pool, input, out)?;
        Ok(())
    })?;
    Ok(outcome)
}

fn list() -> Result<Outcome, Failure> {
    write_to(|out| {
        for m in registry() {
            write!(out, "{}", short(&*m, usize::MAX))?;
        }
        Ok(())
    })?;
    Ok(Outcome::AsExpected)
}

/// Reads some lines, computes them side by side, writes them in order, and so on.
pub fn stream(
    evaluation: &Evaluation,
    pool: &rayon::ThreadPool,
    mut input: BufReader<impl Read>,
    out: &mut dyn Write,
) -> Result<Outcome, Failure> {
    let most = LINES * pool.current_num_threads();
    let mut lines = Vec::new();
    let mut number = 0;
    let mut more = true;
    let mut outcome = Outcome::AsExpected;
    while more {
        lines.clear();
        // Lines that have arrived are answered before more are waited for.
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
            let Some(answer) = answer.transpose() else {
                continue;
            };
            let shown = || format!("line {} ({:?})", line.number, shortened(&line.text));
            let open = match answer {
                Ok(answer) => {
                    writeln!(out, "{}", answer.text)?;
                    if let Some(why) = answer.undefined {
                        out.flush()?;
                        complain(&format!("{}: {why}", shown()));
                    }
                    answer.open
                }
                Err(e) => {
                    out.flush()?;
                    if !e.is_undecided() {
                        return Err(Failure::caused(e).about(shown()));
                    }
                    complain(&format!("{}: {}", shown(), chain(&e)));
                    return Ok(Outcome::Finding);
                }
            };
            if let Some(why) = open {
                outcome = Outcome::Finding;
                // In the order of the lines, where both go to a terminal.
                out.flush()?;
                complain(&format!("{}: {why}", shown()));
            }
        }
        out.flush()?;
    }
    Ok(outcome)
}

fn has_line(buffer: &[u8]) -> bool {
    buffer.contains(&b'\n')
}

/// The answer to a line.
struct Answer {
    /// The values, separated by commas.
    text: String,
    /// The reason why some of them are undecided, if some are.
    open: Option<String>,
    /// The reason why some of them are undefined, where the method says it.
    undefined: Option<String>,
}

/// The evaluation of every line.
pub struct Evaluation<'a> {
    method: &'a dyn Evaluable,
    layout: Layout,
    digits: Option<u32>,
    /// For each output, whether its values are asked for.
    selected: Vec<bool>,
}

impl<'a> Evaluation<'a> {
    /// All outputs of a method, in floating point or with `digits` certified digits.
    pub fn new(method: &'a dyn Evaluable, digits: Option<u32>) -> Evaluation<'a> {
        Evaluation {
            layout: Layout::new(method),
            selected: vec![true; method.outputs().len()],
            method,
            digits,
        }
    }

    /// Returns true if value `i` of an answer is asked for.
    fn is_selected(&self, i: usize) -> bool {
        self.selected[i % self.selected.len()]
    }

    /// The values that are asked for, of all.
    fn selected<T>(&self, values: Vec<T>) -> Vec<T> {
        let all = values.into_iter().enumerate();
        all.filter(|(i, _)| self.is_selected(*i))
            .map(|(_, value)| value)
            .collect()
    }

    /// The values of a line; nothing for a comment, and for a blank one where there are inputs.
    fn answer(&self, line: &Line) -> Result<Option<Answer>, EvalError> {
        if line.text.len() > LONGEST {
            return Err(EvalError::TooLong);
        }
        let text = std::str::from_utf8(&line.text)?.trim();
        if text.starts_with('#') || text.is_empty() && self.layout.parts() > 0 {
            return Ok(None);
        }
        let fields = text.split(',').filter(|_| !text.is_empty());
        let numbers: Vec<Number> = fields.map(Number::parse).collect::<Result<_, _>>()?;
        let x: Vec<f64> = numbers.iter().map(Number::nearest).collect();
        self.layout.lengths(&x)?;
        if let Some(why) = self.method.refusal(&x) {
            return Err(EvalError::OutsideDomain(why));
        }
        let answer = match self.digits {
            None => match answer_of(self.method, &x) {
                SolverAnswer::Values(values) => {
                    let values = self.selected(values);
                    let is_undefined = values.iter().any(|v| v.is_nan());
                    Answer {
                        text: joined(values.into_iter().map(hex_float)),
                        open: None,
                        undefined: match is_undefined {
                            true => self.method.explanation(&x),
                            false => None,
                        },
                    }
                }
                SolverAnswer::Refuses(word) => {
                    let why = self.method.explanation(&x);
                    return Err(EvalError::Refused { word, why });
                }
                other => return Err(EvalError::NoAnswer(other)),
            },
            Some(count) => {
                let exact: Result<Vec<_>, _> = numbers.iter().map(Number::exact).collect();
                self.certified(&exact?, count)?
            }
        };
        Ok(Some(answer))
    }

    /// That many certified digits of each value.
    fn certified(&self, x: &[Rational], digits: u32) -> Result<Answer, EvalError> {
        let found = certified_digits(self.method, x, digits, |i| self.is_selected(i));
        let values = match found {
            Ok(values) => self.selected(values),
            Err(Uncertified::Refused(word)) => {
                let nearest: Vec<f64> = x.iter().map(nearest_f64).collect();
                let why = self.method.explanation(&nearest);
                return Err(EvalError::Refused { word, why });
            }
            Err(other) => return Err(EvalError::Uncertified(other)),
        };
        Ok(Answer::certified(values, digits))
    }
}

impl Answer {
    /// The decimals of the values, `undecided` in the place of one that has none.
    fn certified(values: Vec<CertifiedValue>, digits: u32) -> Answer {
        let open = values.iter().filter(|v| v.decimal.is_none()).count();
        let all = values.len();
        let known = values.iter().filter(|v| v.decimal.is_none());
        let mut reasons: Vec<String> = known.filter_map(|v| v.why.clone()).collect();
        // One reason may be that of several values: all states of a motion end together.
        reasons.dedup();
        let is_undefined = |v: &&CertifiedValue| v.decimal.as_deref() == Some("nan");
        let undefined = values.iter().filter(is_undefined);
        let mut undefined: Vec<String> = undefined.filter_map(|v| v.why.clone()).collect();
        undefined.dedup();
        let word = |decimal: Option<String>| decimal.unwrap_or_else(|| UNDECIDED.into());
        Answer {
            text: joined(values.into_iter().map(|v| word(v.decimal))),
            undefined: (!undefined.is_empty())
                .then(|| format!("undefined: {}", undefined.join("; "))),
            open: (open > 0).then(|| match reasons.is_empty() {
                true => {
                    format!(
                        "{open} of {all} values undecided: {digits} digits could not be certified"
                    )
                }
                false => format!("{open} of {all} values undecided: {}", reasons.join("; ")),
            }),
        }
    }
}

fn joined(values: impl Iterator<Item = String>) -> String {
    values.collect::<Vec<_>>().join(",")
}

#[cfg(test)]
mod tests {
    use super::*;
    use mechaudit::reference::{Ball, Mag};

    /// A value that is zero is proved to be, others have all digits, and the next line is answered
    /// too.
    #[test]
    fn a_zero_costs_no_line() {
        for (name, line, zeros) in [
            ("cam-law", "0.5,0,0.5,2,0.25,0.75", 1),
            ("slider-crank", "0.1,0.3,0,0,0,1", 3),
            ("four-bar", "2,3,2,3,0.5,1", 4),
        ] {
            let lines = format!("{line}\n{line}\n");
            let (out, end) = streamed(name, Some(20), lines.as_bytes());
            assert_eq!(end, Ok(Outcome::AsExpected), "{name}: {out}");
            assert_eq!(out.lines().count(), 2, "{name}: {out}");
            for line in out.lines() {
                let found = line.split(',').filter(|v| *v == "0").count();
                assert_eq!(found, zeros, "{name}: {line}");
            }
        }
    }

    /// A ball about zero has no digits; the values beside it keep theirs.
    #[test]
    fn an_undecided_value_has_a_word_in_its_place() {
        let value = |radius: f64, decimal: Option<&str>| CertifiedValue {
            value: Ball::exact(64, 0.0).widened(Mag::from_f64(radius)).into(),
            decimal: decimal.map(String::from),
            why: None,
        };
        let values = vec![
            value(0.0, Some("0")),
            value(1e-300, None),
            value(0.0, Some("0")),
        ];
        let answer = Answer::certified(values, 5);
        assert_eq!(answer.text, "0,undecided,0");
        let why = "1 of 3 values undecided: 5 digits could not be certified";
        assert_eq!(answer.open.as_deref(), Some(why));
        let answer = Answer::certified(vec![value(0.0, Some("0"))], 5);
        assert_eq!((&*answer.text, answer.open), ("0", None));
    }

    /// Outputs that are not asked for are left out, in every row, with digits and without.
    #[test]
    fn outputs_are_those_asked_for() {
        let method = lookup::method("class-iii-assembly-modes").unwrap();
        let selected = selected_outputs(&*method, &["phi3[k]", "phi5"]).unwrap();
        let pool = rayon::ThreadPoolBuilder::new().num_threads(1);
        let pool = pool.build().unwrap();
        let line = "0.1,1.04,0.6,0.64,0.485,0.22,-0.6859,0.75,0.93,1.285,1.035,0.25178\n";
        let values = |digits, selected: Vec<bool>| {
            let evaluation = Evaluation {
                selected,
                ..Evaluation::new(&*method, digits)
            };
            let mut out = Vec::new();
            stream(
                &evaluation,
                &pool,
                BufReader::new(line.as_bytes()),
                &mut out,
            )
            .unwrap();
            let out = String::from_utf8(out).unwrap();
            let texts = out.trim().split(',').map(String::from);
            texts.collect::<Vec<String>>()
        };
        for digits in [None, Some(12)] {
            let all = values(digits, vec![true; 4]);
            let some = values(digits, selected.clone());
            let due = all
                .chunks(4)
                .flat_map(|row| [row[1].clone(), row[3].clone()]);
            assert_eq!(some, due.collect::<Vec<String>>());
        }
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

    /// Lines that have arrived are answered together, a fixed number for each thread; the end is
    /// looked for once more.
    #[test]
    fn lines_are_answered_together() {
        let method = lookup::method("erf").unwrap();
        let handed = |text: &str, threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
            let input = BufReader::with_capacity(text.len(), text.as_bytes());
            let mut out = Handed::default();
            let pool = pool.build().unwrap();
            let end = stream(&Evaluation::new(&*method, None), &pool, input, &mut out);
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
        for method in registry() {
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
                let Ok(answer) = Evaluation::new(&*method, Some(20)).certified(&exact, 20) else {
                    return false;
                };
                let texts: Vec<&str> = answer.text.split(',').collect();
                assert_eq!(texts.len(), values.len(), "{name}");
                for (text, value) in texts.iter().zip(values) {
                    if *text == UNDECIDED {
                        return false;
                    }
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

    /// Returns the output of a stream by one thread, and its outcome or the reason for its end.
    fn streamed(
        name: &str,
        digits: Option<u32>,
        input: &[u8],
    ) -> (String, Result<Outcome, String>) {
        let method = lookup::method(name).unwrap();
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(1)
            .build()
            .unwrap();
        let mut out = Vec::new();
        let end = stream(
            &Evaluation::new(&*method, digits),
            &pool,
            BufReader::new(input),
            &mut out,
        );
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
            why.starts_with("line 1 (") && why.ends_with("): longer than 33554432 bytes"),
            "{why}"
        );
    }

    /// Which knot or entry a refusal is about.
    #[test]
    fn refusals_name_the_place() {
        for (name, line, due) in [
            (
                "cubic-spline-not-a-knot",
                "0,1,1,2,5,6,7,8,0.5,1.5",
                "refused: knots not increasing: knots[2] = 1 is not greater than its predecessor 1",
            ),
            (
                "tridiagonal",
                "1,0,0,1,3,4",
                "refused: zero pivot: the pivot of row 0 is 0: elimination without row exchanges ends here, \
                 tridiagonal-pivoting exchanges rows",
            ),
            (
                "tridiagonal",
                "1,inf,2,1,3,4",
                "refused: not finite: diagonal[0] = inf is not finite",
            ),
        ] {
            let (_, end) = streamed(name, None, format!("{line}\n").as_bytes());
            let why = end.unwrap_err();
            assert!(why.ends_with(due), "{why}");
        }
        let line = b"0,1,1,2,5,6,7,8,0.5,1.5\n";
        let (_, end) = streamed("cubic-spline-not-a-knot", Some(9), line);
        assert!(end.unwrap_err().contains("knots[2] = 1 is not greater"));
    }

    /// Its line is right, and its value is unavailable.
    #[test]
    fn some_errors_are_no_fault_of_the_line() {
        use mechaudit::audit::Uncertified as Why;
        for (e, due) in [
            (EvalError::TooLong, false),
            (
                EvalError::Refused {
                    word: "no",
                    why: None,
                },
                false,
            ),
            (EvalError::OutsideDomain("no".into()), false),
            (EvalError::NotAnInput("cut off"), false),
            (EvalError::NoAnswer(SolverAnswer::Declines(None)), true),
            (EvalError::Uncertified(Why::Refused("no")), true),
        ] {
            assert_eq!(e.is_undecided(), due, "{e}");
        }
    }
}
