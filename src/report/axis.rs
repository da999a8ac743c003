//! Axes: their ends, and marks at round numbers, all written in one format.

/// How the marks of an axis are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Format {
    decimals: usize,
    exponent: bool,
}

impl Format {
    /// The shortest format that tells these marks apart and shows each of them exactly.
    pub fn of(marks: &[f64]) -> Format {
        let largest = marks.iter().fold(0.0, |a: f64, x| a.max(x.abs()));
        let steps = marks.windows(2).map(|w| (w[1] - w[0]).abs());
        let step = steps.fold(f64::INFINITY, f64::min).min(largest);
        let exponent = largest != 0.0 && !(1e-3..1e6).contains(&largest);
        let with = |decimals| Format { decimals, exponent };
        let exact = |f: &Format| {
            let back = |x: &f64| f.text(*x).replace('−', "-").parse().unwrap_or(f64::NAN);
            marks.iter().all(|x| (back(x) - x).abs() <= 1e-6 * step)
        };
        (0..12).map(with).find(exact).unwrap_or(with(12))
    }

    /// A mark.
    pub fn text(&self, x: f64) -> String {
        // Zero has no sign.
        let x = if x == 0.0 { 0.0 } else { x };
        let text = match self.exponent {
            _ if x == 0.0 => "0".to_string(),
            true => format!("{x:.*e}", self.decimals),
            false => format!("{x:.*}", self.decimals),
        };
        text.replacen('-', "−", usize::from(x < 0.0))
    }
}

/// At most `most` round numbers within a range: multiples of 1, 2 or 5 times a power of ten.
pub fn at_most(low: f64, high: f64, most: usize) -> Vec<f64> {
    let raw = (high - low) / most.max(1) as f64;
    if !(raw > 0.0 && raw.is_finite()) {
        return vec![low];
    }
    let decade = 10f64.powf(raw.log10().floor());
    let within = |step: f64| {
        let ends = [(low / step - 1e-9).ceil(), (high / step + 1e-9).floor()];
        ends.map(|k| k as i64)
    };
    let few = |step: &f64| {
        let [first, last] = within(*step);
        last - first < most as i64
    };
    let steps = [0.5, 1.0, 2.0, 5.0, 10.0].map(|f| f * decade);
    let step = steps.into_iter().find(few).unwrap_or(20.0 * decade);
    let [first, last] = within(step);
    (first..=last).map(|k| k as f64 * step).collect()
}

/// An axis: its name, its ends, and the marks on it. A logarithmic axis has logarithms for values.
pub struct Axis {
    pub label: String,
    pub range: (f64, f64),
    pub marks: Vec<(f64, String)>,
}

impl Axis {
    /// An axis with at most `most` round numbers on it.
    pub fn linear(label: &str, range: (f64, f64), most: usize) -> Axis {
        let marks = at_most(range.0, range.1, most);
        let format = Format::of(&marks);
        Axis {
            label: label.into(),
            range,
            marks: marks.iter().map(|x| (*x, format.text(*x))).collect(),
        }
    }

    /// An axis of powers of ten, at most `most` of which are named by `name`, with exponents that
    /// are multiples of one number.
    pub fn decades(label: &str, range: (f64, f64), most: i32, name: fn(f64) -> String) -> Axis {
        let powers = || range.0.ceil() as i32..=range.1.floor() as i32;
        let every = (powers().count() as i32 + most - 1) / most;
        let named = powers().filter(|k| k % every.max(1) == 0).map(f64::from);
        Axis {
            label: label.into(),
            range,
            marks: named.map(|k| (k, name(k))).collect(),
        }
    }

    /// The place of a value along the axis, from 0 to 1.
    pub fn part(&self, x: f64) -> f64 {
        (x - self.range.0) / (self.range.1 - self.range.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_marks_of_an_axis_are_written_alike() {
        for (marks, due) in [
            (
                &[0.0, 0.0005, 0.001, 0.0015][..],
                &["0", "0.0005", "0.0010", "0.0015"][..],
            ),
            (&[0.0, 2.5e-4, 5e-4], &["0", "2.5e-4", "5.0e-4"]),
            (&[-0.5, 0.0, 0.5, 1.0], &["−0.5", "0", "0.5", "1.0"]),
            (
                &[500_000.0, 1_000_000.0, 1_500_000.0],
                &["5.0e5", "1.0e6", "1.5e6"],
            ),
            (&[0.0, 50.0, 100.0], &["0", "50", "100"]),
            (&[1000.0, 1000.25], &["1000.00", "1000.25"]),
            (&[0.1 + 0.2, 0.4], &["0.3", "0.4"]),
            (&[-0.0], &["0"]),
        ] {
            let format = Format::of(marks);
            let texts: Vec<String> = marks.iter().map(|x| format.text(*x)).collect();
            assert_eq!(texts, due);
        }
    }

    #[test]
    fn marks_are_round_within_the_range_and_not_too_many() {
        for (low, high, most, due) in [
            (0.0, 1.0, 6, &[0.0, 0.2, 0.4, 0.6, 0.8, 1.0][..]),
            (0.0, 1.0, 5, &[0.0, 0.5, 1.0]),
            (-3.0, 12.0, 4, &[0.0, 5.0, 10.0]),
            (
                0.0,
                10.0,
                11,
                &[0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0],
            ),
            (0.0, 0.7, 3, &[0.0, 0.5]),
            (0.9, 2.1, 2, &[1.0, 2.0]),
            (5.0, 5.0, 3, &[5.0]),
        ] {
            let found = at_most(low, high, most);
            let same = |(a, b): (&f64, &f64)| (a - b).abs() < 1e-12;
            assert!(
                found.len() == due.len() && found.iter().zip(due).all(same),
                "{found:?}"
            );
        }
    }
}
