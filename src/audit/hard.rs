//! Hard cases: the worst inputs that a hunt has found, kept and judged in every audit.
//!
//! A file holds lines `share,output,reason,input`: the share of the budget found, rounded up, for
//! that output, how the input was found, and the input as hexadecimal floats. Lines are only added.

use super::csv_line::csv_line;
use super::hex_float::hex_float;
use super::no_such::NoSuch;
use mechaudit_reference::{HexFloat, HexFloatError};

/// A hard case as recorded.
#[derive(Clone, Debug, PartialEq)]
pub struct HardCase {
    /// The largest share of the budget of any value of [`HardCase::output`], rounded up. Above one,
    /// the case is a recorded finding: it is over budget, and it may not get worse.
    pub share: f64,
    /// The output.
    pub output: String,
    /// The way it was found.
    pub reason: String,
    /// The input.
    pub input: Vec<f64>,
    /// The folder whose file holds it, if it is not one that is part of this crate.
    pub folder: Option<String>,
}

/// The error that another platform's elementary functions may add.
const SLACK: f64 = 1.01;

/// A line that is no hard case.
#[derive(Debug, thiserror::Error)]
#[error("hard case on line {line}: {fault}")]
pub struct HardCaseError {
    /// Counted from one.
    pub line: u64,
    /// The fault.
    #[source]
    pub fault: HardCaseFault,
}

/// The fault of a line of hard cases.
#[derive(Debug, thiserror::Error)]
pub enum HardCaseFault {
    /// No CSV.
    #[error(transparent)]
    Csv(#[from] csv::Error),
    /// Other names than [`HARD_HEADER`].
    #[error("the names are {0:?} where {HARD_HEADER:?} is due")]
    Header(String),
    /// Too few or too many fields.
    #[error("{0} fields where 4 are due")]
    Fields(usize),
    /// A negative share or none.
    #[error("{0:?} is no share of a budget")]
    Share(String),
    /// A number of the input.
    #[error(transparent)]
    Number(#[from] HexFloatError),
    /// An output that the method does not have.
    #[error(transparent)]
    NoSuch(#[from] NoSuch),
    /// An input that the method does not admit.
    #[error("the input is outside of the domain of {0}")]
    OutsideDomain(&'static str),
}

/// The line of names.
pub const HARD_HEADER: &str = "share,output,reason,input";

impl HardCase {
    /// Reads a file of them.
    ///
    /// # Errors
    /// A line that cannot be read, with its number.
    pub fn read(text: &str) -> Result<Vec<HardCase>, HardCaseError> {
        HardCase::read_if(text, |_| Ok(()))
    }

    pub(super) fn read_if(
        text: &str,
        check: impl Fn(&HardCase) -> Result<(), HardCaseFault>,
    ) -> Result<Vec<HardCase>, HardCaseError> {
        let mut reader = csv::ReaderBuilder::new()
            .comment(Some(b'#'))
            .from_reader(text.as_bytes());
        let mut all = Vec::new();
        let bad = |line, fault| HardCaseError { line, fault };
        let header = reader.headers().map_err(|e| bad(1, e.into()))?;
        let names: Vec<&str> = header.iter().collect();
        let names = names.join(",");
        // Without any line there is nothing that could be misread.
        if !names.is_empty() && names != HARD_HEADER {
            let line = csv_line(text.as_bytes(), &csv::Position::new());
            let names = names.chars().take(80).collect();
            return Err(bad(line, HardCaseFault::Header(names)));
        }
        for record in reader.records() {
            let at =
                |from: Option<&csv::Position>| from.map_or(0, |p| csv_line(text.as_bytes(), p));
            let record = record.map_err(|e| bad(at(e.position()), e.into()))?;
            let line = at(record.position());
            let fields: Vec<&str> = record.iter().collect();
            let &[share, output, reason, input] = fields.as_slice() else {
                return Err(bad(line, HardCaseFault::Fields(fields.len())));
            };
            let input: Result<Vec<f64>, _> = input
                .split_whitespace()
                .map(|x| HexFloat::parse(x).map(|x| x.to_f64()))
                .collect();
            let positive = share.parse().ok().filter(|s: &f64| *s >= 0.0);
            let case = HardCase {
                share: positive.ok_or_else(|| bad(line, HardCaseFault::Share(share.into())))?,
                output: output.into(),
                reason: reason.into(),
                input: input.map_err(|e| bad(line, e.into()))?,
                folder: None,
            };
            check(&case).map_err(|fault| bad(line, fault))?;
            all.push(case);
        }
        Ok(all)
    }

    /// Reads a file that is part of this crate.
    ///
    /// # Panics
    /// When it cannot be read; a test reads every such file.
    pub fn included(text: &str) -> Vec<HardCase> {
        HardCase::read(text).unwrap_or_else(|e| panic!("{e}"))
    }

    /// The line of a file, with its end.
    pub fn line(&self) -> String {
        let input: Vec<String> = self.input.iter().map(|x| hex_float(*x)).collect();
        let quoted = self.reason.replace('"', "'");
        let (share, output) = (self.share, &self.output);
        format!("{share},{output},\"{quoted}\",{}\n", input.join(" "))
    }

    /// Returns true if a share of the budget above one is what was recorded, or less.
    pub fn allows(&self, share: f64) -> bool {
        share <= self.share * SLACK
    }
}

/// A share rounded up to four figures, as it is recorded.
pub fn rounded_up(share: f64) -> f64 {
    if !(share.is_finite() && share > 0.0) {
        return share;
    }
    let unit = 10f64.powi(share.log10().floor() as i32 - 3);
    let up = (share / unit).ceil() * unit;
    // The shortest text of four figures.
    format!("{up:.3e}").parse().unwrap_or(up)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_come_back() {
        let case = HardCase {
            share: rounded_up(0.123_41),
            output: "Re W".into(),
            reason: "random, climbed".into(),
            input: vec![0.1, -0.0, 5e-324],
            folder: None,
        };
        assert_eq!(case.share, 0.1235);
        let text = format!("{HARD_HEADER}\n# comment\n{}", case.line());
        assert_eq!(HardCase::read(&text).unwrap(), vec![case.clone()]);
        assert!(case.allows(0.1235) && !case.allows(0.13));
        assert_eq!(rounded_up(f64::INFINITY), f64::INFINITY);
        for bad in ["1,x,y", "-1,x,y,0x1p0", "a,x,y,0x1p0", "1,x,y,1.5"] {
            let e = HardCase::read(&format!("{HARD_HEADER}\n{bad}\n")).unwrap_err();
            assert_eq!(e.line, 2, "{bad}");
        }
        // A file without hard cases loses no line as its header.
        for bad in ["garbage", "1,Re W,climbed,0x1p0", "a,b,c,d"] {
            let e = HardCase::read(&format!("# comment\n{bad}\n")).unwrap_err();
            assert_eq!(e.line, 2, "{e}");
            assert!(matches!(e.fault, HardCaseFault::Header(_)), "{e}");
            assert!(e.to_string().contains(HARD_HEADER), "{e}");
        }
        // A long line is cut.
        let e = HardCase::read(&"x".repeat(100)).unwrap_err();
        assert!(matches!(e.fault, HardCaseFault::Header(names) if names == "x".repeat(80)));
        for nothing in ["", "\n", "# comment\n", "# comment", "\n# comment"] {
            assert_eq!(HardCase::read(nothing).unwrap(), Vec::new(), "{nothing:?}");
        }
    }

    /// A fault is on its line, comments and good lines before it counted.
    #[test]
    fn faults_are_found_on_their_lines() {
        let good = "0.5,x,planted,0x1p0";
        for bad in ["1,x,y", "1,x,y,0x1p0,z", "-1,x,y,0x1p0", "1,x,y,1.5"] {
            let text = format!("{HARD_HEADER}\n# one\n# two\n{good}\n# three\n\n{bad}\n");
            assert_eq!(HardCase::read(&text).unwrap_err().line, 7, "{bad}");
        }
        let zero = HardCase::read(&format!("{HARD_HEADER}\n0,x,planted,0x1p0\n")).unwrap();
        assert_eq!(zero[0].share, 0.0);
        assert_eq!(
            HardCase::included(&format!("{HARD_HEADER}\n{good}\n")).len(),
            1
        );
    }

    /// Four figures, never less than the share, and one unit more at most.
    #[test]
    fn shares_are_rounded_up_to_four_figures() {
        for (share, expected) in [
            (0.123_41, 0.1235),
            (1234.1, 1235.0),
            (9.999_1, 10.0),
            (1.0, 1.0),
            (2.5, 2.5),
            (7.000_01e-9, 7.001e-9),
            (3.000_5e20, 3.001e20),
            (0.0, 0.0),
        ] {
            assert_eq!(rounded_up(share), expected, "{share}");
        }
        assert!(rounded_up(f64::NAN).is_nan());
        // Recorded to a hundredth more, and no farther.
        let mut case = HardCase::included(&format!("{HARD_HEADER}\n1,x,planted,0x1p0\n"));
        let case = case.remove(0);
        assert!(case.allows(SLACK) && !case.allows(SLACK.next_up()));
    }
}
