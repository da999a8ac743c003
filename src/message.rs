//! The words of an error, as a reader meets them.

use std::borrow::Cow;

/// Characters from which on a number of a message is written with an exponent.
const LONG: usize = 22;
/// Significant digits of an `f64` at most.
const DIGITS: usize = 17;

/// A message in which numbers with long rows of zeros, which a large or small `f64` has without an
/// exponent, are written with one. Quoted text stays as it is: it is the reader's.
///
/// ```
/// use mechaudit::message::readable;
/// let error = format!("l1 = {} m is outside 1e-60 … 1e60 m", 1e300);
/// assert_eq!(readable(&error), "l1 = 1e300 m is outside 1e-60 … 1e60 m");
/// ```
pub fn readable(text: &str) -> Cow<'_, str> {
    let is_part = |c: char| c.is_ascii_digit() || c == '.';
    let mut out = String::new();
    let (mut rest, mut quoted, mut changed, mut before) = (text, false, false, ' ');
    while let Some(first) = rest.chars().next() {
        let end = match first.is_ascii_digit() {
            true => rest.find(|c| !is_part(c)).unwrap_or(rest.len()),
            false => first.len_utf8(),
        };
        let (token, after) = rest.split_at(end);
        let alone = !before.is_alphanumeric() && !after.starts_with(char::is_alphanumeric);
        match short(token).filter(|_| alone && !quoted) {
            Some(number) => {
                changed = true;
                out += &number;
            }
            None => out += token,
        }
        quoted ^= first == '"';
        before = token.chars().next_back().unwrap_or(first);
        rest = after;
    }
    match changed {
        true => Cow::Owned(out),
        false => Cow::Borrowed(text),
    }
}

/// A long number in exponent form, if it is an `f64` as Rust writes it.
fn short(token: &str) -> Option<String> {
    // A full stop may follow.
    let number = token.trim_end_matches('.');
    if number.len() < LONG {
        return None;
    }
    let figures: String = number.chars().filter(char::is_ascii_digit).collect();
    let significant = figures.trim_matches('0').len();
    let value: f64 = number.parse().ok()?;
    let stop = &token[number.len()..];
    (significant <= DIGITS && value.is_finite()).then(|| format!("{value:e}{stop}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_numbers_have_an_exponent() {
        for x in [
            1e300,
            -2.5e300,
            1e-300,
            f64::MIN_POSITIVE,
            f64::MAX,
            5e-324,
            1e25,
        ] {
            for (text, due) in [
                (format!("{x}"), format!("{x:e}")),
                (format!("x = {x}"), format!("x = {x:e}")),
                (
                    format!("from {x} to {x} m."),
                    format!("from {x:e} to {x:e} m."),
                ),
                (format!("({x}, 1)"), format!("({x:e}, 1)")),
                (format!("it is {x}."), format!("it is {x:e}.")),
            ] {
                assert_eq!(readable(&text), due);
            }
        }
    }

    #[test]
    fn everything_else_stays() {
        let long = "3.14159265358979323846264338327950288";
        let zeros = format!("{}", 1e300);
        for text in [
            "".into(),
            "0.25 m, 1e300 m and 18446744073709551615 cases".into(),
            format!("{long} has more digits than an f64"),
            format!("\"{zeros}\" is what was written"),
            format!("a{zeros} and {zeros}b are no numbers"),
            "12:30, 1.2.3, …, ± 5 %".into(),
        ] {
            assert!(
                matches!(readable(&text), Cow::Borrowed(t) if t == text),
                "{text}"
            );
        }
    }
}
