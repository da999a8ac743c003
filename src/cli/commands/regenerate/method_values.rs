//! Certified values of a method at inputs from every region of its domain.

use crate::cli::files::artefact::{Made, MakeError, Outcome};
use crate::cli::process::wire;
use mechaudit::audit::{
    Case, Cases, Expected, Layout, Method, Origin, ReferenceAnswer, Settings, Uncertified,
};
use mechaudit::reference::Ball;
use rayon::prelude::*;
use rug::Rational;
use std::fmt::Write as _;

/// Random cases of each region, out of the first [`TRIES`].
const PER_REGION: usize = 3;
const TRIES: u64 = 30;
/// Numbers of an input; longer ones are left out.
const LONGEST: usize = 50;
/// Significant digits written, and bits of each value that they need.
const DIGITS: usize = 22;
const NEEDED: i64 = 74;
/// Where a value is left with the digits that it has.
const LAST_BITS: u32 = 512;

const COLUMNS: &str = "region,case,input,value,radius,condition";

/// The columns in words.
const MEANING: &str = "\
Fields with many numbers separate them by blanks. `input` holds hexadecimal floats, exact; `value` what\n\
is due, decimals, inf, -inf or nan, or `refuse` and a reason where there is no value; `radius` how far\n\
from the true value each of them may be; `condition` the estimated condition number\n\
sum_j |x_j df/dx_j| / |f|, `-` where there is none. `case` is the name of a check point or the number\n\
of a random case, see `mechaudit points --help`.";

/// The values of a method.
pub fn made(method: &dyn Method) -> Outcome<Made> {
    let settings = Settings::default();
    let cases = chosen(method, &settings)?;
    let rows: Result<Vec<Row>, MakeError> = cases
        .par_iter()
        .map(|case| row(method, case, &settings))
        .collect();
    let mut body = format!("{COLUMNS}\n");
    let mut recipe = format!("{} {DIGITS} {NEEDED} {LAST_BITS}\n", method.name());
    for (case, row) in cases.iter().zip(rows?) {
        let place = match &case.origin {
            Origin::CheckPoint { name } => (*name).to_string(),
            Origin::Random { index, .. } => index.to_string(),
            other => return Err(MakeError::NotOfRegion(other.clone()).into()),
        };
        let input = wire::line(&case.input, false).replace(',', " ");
        let start = format!("{},{place},{input}", case.region);
        writeln!(recipe, "{start}")?;
        let (value, radius, condition) = (row.value, row.radius, row.condition);
        writeln!(body, "{start},{value},{radius},{condition}")?;
    }
    let layout = Layout::new(method);
    let regions = method.domain().regions.len();
    Ok(Made {
        title: format!("{}: {}.\n\n{MEANING}", method.name(), method.summary()),
        facts: vec![
            ("input", layout.input()),
            ("value", layout.answer()),
            (
                "precision",
                format!(
                    "{DIGITS} digits, from {} to {LAST_BITS} bits as the radius asks for",
                    settings.first_bits
                ),
            ),
            ("seed", settings.seed.to_string()),
            (
                "counts",
                format!(
                    "{} cases: check points, {PER_REGION} from each of {regions} regions, inputs of at \
                     most {LONGEST} numbers",
                    cases.len()
                ),
            ),
        ],
        recipe,
        body,
    })
}

fn chosen(method: &dyn Method, settings: &Settings) -> Outcome<Vec<Case>> {
    let cases = Cases::new(method, settings);
    let domain = method.domain();
    let short = |case: &Case| case.input.len() <= LONGEST;
    let mut all = Vec::new();
    for point in &domain.check_points {
        all.push(cases.at_check_point(point.name)?);
    }
    all.retain(short);
    for region in &domain.regions {
        let drawn = (0..TRIES).map(|i| cases.in_region(region.name, i));
        let drawn: Result<Vec<Case>, _> = drawn.collect();
        all.extend(drawn?.into_iter().filter(short).take(PER_REGION));
    }
    Ok(all)
}

/// Returns the rows of a case.
struct Row {
    value: String,
    radius: String,
    condition: String,
}

fn row(method: &dyn Method, case: &Case, settings: &Settings) -> Result<Row, MakeError> {
    let exact: Option<Vec<Rational>> = case.input.iter().map(|&x| Rational::from_f64(x)).collect();
    let failed = |source| MakeError::Case {
        case: case.reproduce(),
        source,
    };
    let mut bits = settings.first_bits;
    let expected = loop {
        let answer = match &exact {
            Some(x) => method.reference(x, bits),
            None => method.reference_not_finite(&case.input),
        };
        let expected = match answer {
            ReferenceAnswer::Values(r) => r.values.into_iter().map(Expected::Number).collect(),
            ReferenceAnswer::Expected(expected, _) => expected,
            ReferenceAnswer::Refuses(word) => {
                return Ok(Row {
                    value: format!("refuse {word}"),
                    radius: String::new(),
                    condition: String::new(),
                });
            }
            ReferenceAnswer::Undecided(_) if bits < settings.last_bits => {
                bits *= 2;
                continue;
            }
            ReferenceAnswer::Undecided(why) => return Err(failed(Uncertified::Undecided(why))),
            ReferenceAnswer::Failed(why) => return Err(failed(Uncertified::Failed(why))),
        };
        let open = |b: &Ball| match b.is_finite() {
            true => bits < LAST_BITS && !b.is_zero() && b.accuracy_bits() < NEEDED,
            false => bits < settings.last_bits,
        };
        if !expected.iter().filter_map(Expected::number).any(open) {
            break expected;
        }
        bits *= 2;
    };
    let conditions = exact.and_then(|_| method.conditions(&case.input));
    let conditions = conditions.filter(|c| c.len() == expected.len());
    let (mut values, mut radii, mut relative) = (Vec::new(), Vec::new(), Vec::new());
    for (i, due) in expected.iter().enumerate() {
        let (value, radius) = match due.number() {
            Some(ball) => ball.to_decimal_with_radius(DIGITS),
            None => due.to_decimal(DIGITS).map(|text| (text, "0".to_string())),
        }
        .ok_or_else(|| MakeError::Value {
            case: case.reproduce(),
            value: i,
        })?;
        values.push(value);
        radii.push(radius);
        let size = due.number().map_or(f64::NAN, |b| b.to_f64().abs());
        let condition = conditions.as_ref().map(|c| c[i] / size);
        relative.push(match condition.filter(|c| c.is_finite()) {
            Some(c) => format!("{c:.2e}"),
            None => "-".into(),
        });
    }
    Ok(Row {
        value: values.join(" "),
        radius: radii.join(" "),
        condition: relative.join(" "),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use mechaudit::methods;

    /// The start of a file as it is committed: the same numbers from the same code.
    #[test]
    fn values_are_those_that_are_held() {
        for name in ["slider-crank", "erf", "tridiagonal"] {
            let method = methods::find(name).unwrap();
            let root = std::path::Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."));
            let file = root.join("reference/values").join(format!("{name}.csv"));
            let held = std::fs::read_to_string(file).unwrap();
            let at = held.find(COLUMNS).unwrap();
            let rows: Vec<&str> = held[at..].lines().skip(1).collect();
            let settings = Settings::default();
            let cases = chosen(&*method, &settings).unwrap();
            assert_eq!(rows.len(), cases.len(), "{name}");
            for (line, case) in rows.iter().zip(&cases) {
                let found = row(&*method, case, &settings).unwrap();
                let end = format!(",{},{},{}", found.value, found.radius, found.condition);
                assert!(line.ends_with(&end), "{line} for {end}");
                let place = match &case.origin {
                    Origin::CheckPoint { name } => (*name).to_string(),
                    Origin::Random { index, .. } => index.to_string(),
                    other => panic!("{other:?}"),
                };
                assert!(
                    line.starts_with(&format!("{},{place},", case.region)),
                    "{line}"
                );
            }
        }
    }

    /// Check points in their order, then a few short cases of each region.
    #[test]
    fn cases_are_few_and_short() {
        for method in methods::registry() {
            let (name, domain) = (method.name(), method.domain());
            let cases = chosen(&*method, &Settings::default()).unwrap();
            assert!(cases.iter().all(|c| c.input.len() <= LONGEST), "{name}");
            let points = domain
                .check_points
                .iter()
                .filter(|p| p.input.len() <= LONGEST);
            let points: Vec<&str> = points.map(|p| p.name).collect();
            let found = cases.iter().map_while(|c| match &c.origin {
                Origin::CheckPoint { name } => Some(*name),
                _ => None,
            });
            assert_eq!(found.collect::<Vec<_>>(), points, "{name}");
            for region in &domain.regions {
                let own: Vec<u64> = cases
                    .iter()
                    .filter(|c| c.region == region.name)
                    .filter_map(|c| match c.origin {
                        Origin::Random { index, .. } => Some(index),
                        _ => None,
                    })
                    .collect();
                assert!(
                    own.len() <= PER_REGION && own.is_sorted() && own.iter().all(|i| *i < TRIES)
                );
            }
        }
    }
}
