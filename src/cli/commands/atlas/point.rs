//! Algorithms at one point, beside the certified value.

use crate::cli::failure::{Failure, Outcome};
use crate::cli::files::output::write_to;
use crate::cli::terminal::width;
use anstyle::Style;
use mechaudit::audit::{
    Case, Judge, Limit, Method, Origin, Settings, SolverAnswer, Variant, hex_float,
};
use mechaudit::claims::{Algorithm, HartmannTran, Parts, Plane, Profile, answer};
use mechaudit::methods;
use mechaudit::reference::{Decimal, HexFloat};
use mechaudit::report::text::style::{BAD, BOLD, PLAIN, paint};
use mechaudit::report::text::table::Table;
use num_complex::Complex;

/// An answer of an algorithm, or why there is none.
type Answer = Result<Vec<f64>, &'static str>;

/// Shows them: at a point of the plane, or at a line of eight parameters.
pub fn show(chosen: &[Algorithm], profiles: &[Profile], text: &str) -> Result<Outcome, Failure> {
    let at = read(text)?;
    let place = at
        .iter()
        .map(|x| hex_float(*x))
        .collect::<Vec<_>>()
        .join(",");
    match at[..] {
        [x, y] => {
            if chosen.is_empty() {
                let rule = "--at takes the eight numbers of a line here: Gamma_D,Gamma_0,Gamma_2,Delta_0,Delta_2,nu_VC,eta,detuning";
                return Err(Failure::new(rule));
            }
            let method = methods::find("faddeeva").ok_or_else(|| Failure::new("there is no W"))?;
            let answers = chosen.iter().map(|a| (a.name, of_w(a, [x, y])));
            let head = format!("z = {x} {y:+}i  ({place})");
            table(&*method, "faddeeva", &at, &head, answers.collect())
        }
        _ => {
            if profiles.is_empty() {
                return Err(Failure::new(format!(
                    "--at {text:?} must be two finite numbers RE,IM"
                )));
            }
            let answers = profiles.iter().map(|p| (p.name, of_line(p, &at)));
            let head = format!(
                "Gamma_D, Gamma_0, Gamma_2, Delta_0, Delta_2, nu_VC, eta, detuning = {}\n  ({place})",
                at.iter().map(f64::to_string).collect::<Vec<_>>().join(", ")
            );
            table(
                &HartmannTran,
                "hartmann-tran",
                &at,
                &head,
                answers.collect(),
            )
        }
    }
}

fn of_w(a: &Algorithm, [x, y]: [f64; 2]) -> Answer {
    if a.plane == Plane::Upper && y < 0.0 {
        return Err("not below the axis");
    }
    let w = (a.w)(Complex::new(x, y));
    Ok(match a.parts {
        Parts::Both => vec![w.re, w.im],
        Parts::Real => vec![w.re],
    })
}

fn of_line(profile: &Profile, at: &[f64]) -> Answer {
    if !profile.whole && (at[3] != 0.0 || at[4] != 0.0 || at[6] != 0.0) {
        return Err("without shifts and correlation");
    }
    match answer(profile, at) {
        SolverAnswer::Values(values) => Ok(values),
        _ => Err("no answer"),
    }
}

fn table(
    method: &dyn Method,
    name: &'static str,
    at: &[f64],
    head: &str,
    answers: Vec<(&str, Answer)>,
) -> Result<Outcome, Failure> {
    let variant = Variant::new(method).limit(Limit::Relative(1e-300));
    let settings = Settings::default();
    let case = Case {
        method: name,
        region: "given",
        input: at.to_vec(),
        origin: Origin::Given,
    };
    let judge = Judge::new(&variant, &settings);
    let mut referee = judge.referee(case);
    let [re, im]: [&'static str; 2] = match name {
        "faddeeva" => ["Re W", "Im W"],
        _ => ["Re HT", "Im HT"],
    };
    let mut table = Table::new(&["algorithm", re, "off by", im, "off by"], &[0, 1, 3]);
    let mut due: Vec<Option<String>> = Vec::new();
    let empty = || (String::new(), PLAIN);
    for (name, answer) in answers {
        let mut cells = vec![(name.to_string(), PLAIN)];
        let values = match answer {
            Ok(values) => values,
            Err(why) => {
                cells.extend([(why.into(), PLAIN), empty(), empty(), empty()]);
                table.row(cells);
                continue;
            }
        };
        // A part that is not computed is shown, and judged by nobody.
        let both = vec![values[0], values.get(1).copied().unwrap_or(f64::NAN)];
        let report = referee.judge(SolverAnswer::Values(both), true);
        due = report.reference.clone();
        for (k, value) in values.iter().enumerate() {
            let c = report.judgement.components.get(k);
            let error = c.map_or(f64::NAN, |c| c.of_budget * 1e-300);
            cells.push((format!("{value:.16e}"), PLAIN));
            cells.push(off_by(error));
        }
        if values.len() == 1 {
            cells.extend([("–".into(), PLAIN), empty()]);
        }
        table.row(cells);
    }
    let digits = |k: usize| due.get(k).cloned().flatten().unwrap_or("–".into());
    write_to(None, |out| {
        writeln!(out, "{}", paint(BOLD, head))?;
        if !due.is_empty() {
            writeln!(out, "  certified  {re} = {}", digits(0))?;
            writeln!(out, "             {im} = {}", digits(1))?;
        }
        let table = table.clone().fitted(width(), &[]);
        Ok(write!(out, "{}", table.render(2))?)
    })?;
    Ok(Outcome::AsExpected)
}

/// A relative error; a large one is marked.
fn off_by(error: f64) -> (String, Style) {
    match error {
        e if !e.is_finite() => ("no number".into(), BAD),
        e => (format!("{e:.1e}"), if e > 1e-6 { BAD } else { PLAIN }),
    }
}

/// Two numbers, or the eight of a line.
fn read(text: &str) -> Result<Vec<f64>, Failure> {
    let number = |text: &str| {
        let text = text.trim();
        let hex = text.trim_start_matches(['+', '-']).starts_with("0x");
        let x = match hex {
            true => HexFloat::parse(text).ok()?.to_f64(),
            false => Decimal::nearest(text).ok()?,
        };
        x.is_finite().then_some(x)
    };
    let parts: Option<Vec<f64>> = text.split(',').map(number).collect();
    match parts {
        Some(all) if all.len() == 2 || all.len() == 8 => Ok(all),
        _ => Err(Failure::new(format!(
            "--at {text:?} must be two finite numbers RE,IM (a line of the Hartmann-Tran profile: eight)"
        ))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use mechaudit::claims::PROFILES;

    /// A profile of fewer parameters says so of each of the others.
    #[test]
    fn shifts_and_correlation_are_not_for_every_profile() {
        let simple = PROFILES.iter().find(|p| !p.whole).unwrap();
        let line = [1.0, 0.5, 0.0625, 0.0, 0.0, 0.125, 0.0, 1.5];
        assert_eq!(of_line(simple, &line).unwrap().len(), 2);
        for k in [3, 4, 6] {
            let mut other = line;
            other[k] = 0.25;
            let due = Err("without shifts and correlation");
            assert_eq!(of_line(simple, &other), due, "{k}");
            let whole = PROFILES.iter().find(|p| p.whole).unwrap();
            assert!(of_line(whole, &other).is_ok(), "{k}");
        }
    }

    #[test]
    fn large_errors_are_marked() {
        for (error, text, style) in [
            (0.0, "0.0e0", PLAIN),
            (1e-6, "1.0e-6", PLAIN),
            (1.5e-6, "1.5e-6", BAD),
            (f64::INFINITY, "no number", BAD),
            (f64::NAN, "no number", BAD),
        ] {
            assert_eq!(off_by(error), (text.to_string(), style));
        }
    }
}
