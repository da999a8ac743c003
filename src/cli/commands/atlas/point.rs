//! Algorithms at one point, beside the certified value.

use crate::cli::failure::{Failure, Outcome};
use crate::cli::files::output::print;
use crate::cli::number::Number;
use crate::cli::process::wire;
use crate::cli::terminal::width;
use crate::cli::workload::given;
use anstyle::Style;
use mechaudit::audit::{Judge, Limit, Method, Settings, SolverAnswer, Variant};
use mechaudit::claims::{Algorithm, HartmannTran, Parts, Plane, Profile, answer};
use mechaudit::methods;
use mechaudit::report::text::style::{BAD, BOLD, PLAIN, paint};
use mechaudit::report::text::table::Table;
use num_complex::Complex;

/// An answer of an algorithm, or why there is none.
type Answer = Result<Vec<f64>, &'static str>;

/// Shows them: at a point of the plane, or at a line of eight parameters.
pub fn show(chosen: &[Algorithm], profiles: &[Profile], text: &str) -> Result<Outcome, Failure> {
    print(&shown(chosen, profiles, text)?)?;
    Ok(Outcome::AsExpected)
}

fn shown(chosen: &[Algorithm], profiles: &[Profile], text: &str) -> Result<String, Failure> {
    let at = read(text)?;
    let place = wire::line(&at, false);
    match at[..] {
        [x, y] => {
            if chosen.is_empty() {
                let rule = "--at takes the eight numbers of a line here: Gamma_D,Gamma_0,Gamma_2,Delta_0,Delta_2,nu_VC,eta,detuning";
                return Err(Failure::new(rule));
            }
            let method = methods::find("faddeeva").ok_or_else(|| Failure::new("there is no W"))?;
            let answers = chosen.iter().map(|a| (a.name, of_w(a, [x, y])));
            let head = format!("z = {x} {y:+}i  ({place})");
            Ok(table(&*method, "faddeeva", &at, &head, answers.collect()))
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
            let answers = answers.collect();
            Ok(table(&HartmannTran, "hartmann-tran", &at, &head, answers))
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
) -> String {
    let variant = Variant::new(method).limit(Limit::Relative(1e-300));
    let settings = Settings::default();
    let judge = Judge::new(&variant, &settings);
    let mut referee = judge.referee(given(name, at.to_vec()));
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
    let mut text = format!("{}\n", paint(BOLD, head));
    if !due.is_empty() {
        text += &format!("  certified  {re} = {}\n", digits(0));
        text += &format!("             {im} = {}\n", digits(1));
    }
    text + &table.fitted(width(), &[]).render(2)
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
    let number = |text| {
        let x = Number::parse(text).ok()?.nearest();
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

    /// An algorithm of the upper half-plane that gives a fixed value.
    fn fixed(parts: Parts, plane: Plane) -> Algorithm {
        let mut a = mechaudit::claims::algorithms().swap_remove(0);
        (a.name, a.parts, a.plane) = ("fixed", parts, plane);
        a.w = |_| Complex::new(1.0, 0.5);
        a
    }

    /// W(0) = 1, of which 1 + i/2 is right in one part, and wrong without measure in the other.
    #[test]
    fn algorithms_are_shown_beside_the_certified_value() {
        use mechaudit::report::text::style::plain;
        let lines = |chosen: &[Algorithm], at: &str| -> Vec<Vec<String>> {
            let text = plain(&shown(chosen, &[], at).unwrap());
            let words = |l: &str| {
                l.split("  ")
                    .map(str::trim)
                    .filter(|w| !w.is_empty())
                    .map(String::from)
                    .collect()
            };
            text.lines().map(words).collect()
        };
        let [both, real] = [Parts::Both, Parts::Real].map(|p| fixed(p, Plane::Upper));
        let found = lines(&[both, real], "0,0");
        assert_eq!(found[0], ["z = 0 +0i", "(0x0p+0,0x0p+0)"]);
        assert!(
            found[1][0] == "certified" && found[1][1].starts_with("Re W = 1"),
            "{found:?}"
        );
        assert_eq!(found[2], ["Im W = 0"]);
        assert_eq!(found[3], ["algorithm", "Re W", "off by", "Im W", "off by"]);
        let one = "1.0000000000000000e0";
        // An upper bound of an error of nothing.
        let little = |text: &str| text.parse::<f64>().unwrap() < 1e-30;
        assert_eq!(found[4][..2], ["fixed", one]);
        assert_eq!(found[4][3], "5.0000000000000000e-1");
        assert_eq!(
            [&found[5][0], &found[5][1], &found[5][3]],
            ["fixed", one, "–"]
        );
        assert!(little(&found[4][2]) && little(&found[5][2]));
        // e^(-z^2) erfc(-iz) at i: e erfc 1 = 0.42758357615580700441…; 1 is off by 1.33872.
        let found = lines(&[fixed(Parts::Real, Plane::Whole)], "0x0p+0, +1");
        assert_eq!(found[0], ["z = 0 +1i", "(0x0p+0,0x1p+0)"]);
        assert!(
            found[1][1].starts_with("Re W = 0.4275835761558070044"),
            "{found:?}"
        );
        assert_eq!(found[4], ["fixed", one, "1.3e0", "–"]);
        // Below the axis an algorithm of the upper half-plane has no answer, and nothing is
        // certified for nobody.
        let found = lines(&[fixed(Parts::Both, Plane::Upper)], "0,-1");
        assert_eq!(found[1], ["algorithm", "Re W", "off by", "Im W", "off by"]);
        assert_eq!(found[2], ["fixed", "not below the axis"]);
        let found = lines(&[fixed(Parts::Both, Plane::Whole)], "0,-1");
        assert_eq!(found[1][0], "certified");
    }

    #[test]
    fn lines_have_eight_numbers() {
        use mechaudit::report::text::style::plain;
        let line = "1,0.5,0.0625,0.25,-0.03125,0.125,0.25,1.5";
        let text = plain(&shown(&[], &PROFILES, line).unwrap());
        let head = "Gamma_D, Gamma_0, Gamma_2, Delta_0, Delta_2, nu_VC, eta, detuning = \
                    1, 0.5, 0.0625, 0.25, -0.03125, 0.125, 0.25, 1.5\n  (0x1p+0,0x1p-1,0x1p-4,0x1p-2,-0x1p-5,";
        assert!(text.starts_with(head), "{text}");
        assert!(
            text.contains("\n  certified  Re HT = 0.1609504096421070246"),
            "{text}"
        );
        for p in &PROFILES {
            let row = text
                .lines()
                .find(|l| l.trim_start().starts_with(p.name))
                .unwrap();
            assert_eq!(
                row.contains("without shifts and correlation"),
                !p.whole,
                "{row}"
            );
        }
        let why = |chosen: &[Algorithm], profiles: &[Profile], at: &str| {
            shown(chosen, profiles, at).unwrap_err().to_string()
        };
        let some = [fixed(Parts::Both, Plane::Whole)];
        assert!(
            why(&[], &PROFILES, "1,1")
                .starts_with("--at takes the eight numbers of a line here: Gamma_D,")
        );
        let due = format!("--at {line:?} must be two finite numbers RE,IM");
        assert_eq!(why(&some, &[], line), due);
    }

    #[test]
    fn a_place_is_two_numbers_or_eight() {
        let found = |text: &str| read(text).ok();
        assert_eq!(found("1.5,-2"), Some(vec![1.5, -2.0]));
        assert_eq!(found(" 0x1p-1 , -0x1p+1"), Some(vec![0.5, -2.0]));
        assert_eq!(found("+0x1p0,1e-3"), Some(vec![1.0, 1e-3]));
        assert_eq!(found("1,2,3,4,5,6,7,8").map(|v| v.len()), Some(8));
        for bad in [
            "",
            "1",
            "1,2,3",
            "1,2,3,4,5,6,7",
            "1,2,3,4,5,6,7,8,9",
            "x,1",
            "inf,0",
            "0,nan",
            "1e999,0",
        ] {
            assert_eq!(found(bad), None, "{bad}");
        }
    }
}
