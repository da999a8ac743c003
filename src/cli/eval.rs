//! Values of a function at the cases given on standard input, one a line.

use super::args::EvalArgs;
use super::complain;
use super::eval_functions::{Function, find, functions};
use super::eval_number::Number;
use super::failure::{Failure, Outcome};
use super::output::write_to;
use mechaudit::audit::hex_float;
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
enum Trouble {
    /// The line is wrong.
    Input(String),
    /// The digits could not be certified.
    Undecided(String),
}

/// Evaluates, or lists what can be evaluated.
pub fn eval(args: &EvalArgs) -> Result<Outcome, Failure> {
    let Some(name) = args.name.as_deref().filter(|_| !args.list) else {
        return list();
    };
    let function = find(name).ok_or_else(|| {
        let known: Vec<&str> = functions().iter().map(|f| f.name).collect();
        Failure::no_such("function", name, &known)
    })?;
    let threads = args.threads.unwrap_or(0);
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .map_err(|e| Failure::new(format!("cannot start {threads} threads: {e}")))?;
    let mut outcome = Outcome::AsExpected;
    write_to(None, |out| {
        let input = BufReader::with_capacity(BUFFER, std::io::stdin().lock());
        outcome = stream(function, args.digits, &pool, input, out)?;
        Ok(())
    })?;
    Ok(outcome)
}

fn list() -> Result<Outcome, Failure> {
    write_to(None, |out| {
        for f in functions() {
            let (from, to) = (f.arguments.join(","), f.values.join(","));
            writeln!(out, "{:<22} {from:<13} -> {to:<6} {}", f.name, f.summary)?;
        }
        Ok(())
    })?;
    Ok(Outcome::AsExpected)
}

/// Reads some lines, computes them side by side, writes them in order, and so on.
pub(super) fn stream(
    function: &Function,
    digits: Option<u32>,
    pool: &rayon::ThreadPool,
    mut input: BufReader<impl Read>,
    out: &mut dyn Write,
) -> Result<Outcome, Failure> {
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
                .map_err(|e| Failure::new(format!("cannot read standard input: {e}")))?;
            more = read > 0 && text.len() <= LONGEST;
            number += 1;
            if read > 0 {
                lines.push(Line { number, text });
            }
        }
        let answers: Vec<_> = match pool.current_num_threads() {
            1 => lines.iter().map(|l| answer(function, digits, l)).collect(),
            _ => pool.install(|| {
                let lines = lines.par_iter();
                lines.map(|l| answer(function, digits, l)).collect()
            }),
        };
        for (line, answer) in lines.iter().zip(answers) {
            let why = match answer {
                Ok(None) => continue,
                Ok(Some(text)) => {
                    writeln!(out, "{text}")?;
                    continue;
                }
                Err(why) => why,
            };
            out.flush()?;
            let shown = format!("line {} ({:?})", line.number, shortened(&line.text));
            return match why {
                Trouble::Input(why) => Err(Failure::new(format!("{shown}: {why}"))),
                Trouble::Undecided(why) => {
                    complain(&format!("{shown}: {why}"));
                    Ok(Outcome::Finding)
                }
            };
        }
        out.flush()?;
    }
    Ok(Outcome::AsExpected)
}

fn has_line(buffer: &[u8]) -> bool {
    buffer.contains(&b'\n')
}

/// The beginning of a line, for messages.
pub fn shortened(text: &[u8]) -> String {
    const SHOWN: usize = 80;
    let text = String::from_utf8_lossy(&text[..text.len().min(4 * SHOWN)]);
    let text = text.trim();
    match text.char_indices().nth(SHOWN) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text.into(),
    }
}

/// The values of a line; nothing for a blank one or a comment.
fn answer(
    function: &Function,
    digits: Option<u32>,
    line: &Line,
) -> Result<Option<String>, Trouble> {
    let input = Trouble::Input;
    if line.text.len() > LONGEST {
        return Err(input(format!("longer than {LONGEST} bytes")));
    }
    let text = std::str::from_utf8(&line.text).map_err(|_| input("not UTF-8".into()))?;
    let text = text.trim();
    if text.is_empty() || text.starts_with('#') {
        return Ok(None);
    }
    let fields: Vec<&str> = text.split(',').collect();
    if fields.len() != function.arguments.len() {
        let due = function.arguments.join(",");
        let (n, k) = (fields.len(), function.arguments.len());
        return Err(input(format!("{n} fields where {k} are due: {due}")));
    }
    let numbers: Vec<Number> = fields
        .iter()
        .map(|f| Number::parse(f).map_err(|e| input(e.to_string())))
        .collect::<Result<_, _>>()?;
    let x: Vec<f64> = numbers.iter().map(Number::nearest).collect();
    if let Some(why) = (function.refusal)(&x) {
        return Err(input(why));
    }
    let values = match digits {
        None => {
            let values = (function.solve)(&x);
            values.iter().map(|v| hex_float(*v)).collect::<Vec<_>>()
        }
        Some(digits) => {
            let x: Vec<Rational> = numbers
                .iter()
                .map(|n| n.exact().map_err(|e| input(e.to_string())))
                .collect::<Result<_, _>>()?;
            function
                .digits(&x, digits as usize)
                .map_err(Trouble::Undecided)?
        }
    };
    Ok(Some(values.join(",")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_function_has_a_name_and_both_sides() {
        for f in functions() {
            let x = vec![0.5; f.arguments.len()];
            assert_eq!((f.solve)(&x).len(), f.values.len(), "{}", f.name);
            let q: Vec<Rational> = x.iter().filter_map(|x| Rational::from_f64(*x)).collect();
            let digits = f.digits(&q, 30).unwrap();
            assert_eq!(digits.len(), f.values.len(), "{}", f.name);
            for (text, value) in digits.iter().zip((f.solve)(&x)) {
                let certified: f64 = text.parse().unwrap();
                assert!(
                    (certified - value).abs() <= 1e-14 * value.abs(),
                    "{}",
                    f.name
                );
            }
        }
    }

    #[test]
    fn long_lines_are_shortened_in_messages() {
        assert_eq!(shortened(b" 1,2\r\n"), "1,2");
        let long = shortened("é".repeat(500).as_bytes());
        assert_eq!(long.chars().count(), 81);
    }
}
