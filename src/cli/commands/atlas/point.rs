//! Algorithms at one point, beside the certified value.

use crate::cli::failure::{Failure, Outcome};
use crate::cli::files::output::write_to;
use crate::cli::terminal::width;
use mechaudit::audit::{Case, Limit, Origin, Referee, Settings, SolverAnswer, Variant, hex_float};
use mechaudit::claims::{Algorithm, Parts, Plane};
use mechaudit::methods;
use mechaudit::reference::{Decimal, HexFloat};
use mechaudit::report::text::style::{BAD, BOLD, PLAIN, paint};
use mechaudit::report::text::table::Table;
use num_complex::Complex;

/// Shows them.
pub fn show(chosen: &[Algorithm], text: &str) -> Result<Outcome, Failure> {
    let z = read(text)?;
    let method = methods::find("faddeeva").ok_or_else(|| Failure::new("there is no W"))?;
    let variant = Variant::new(&*method).limit(Limit::Relative(1e-300));
    let settings = Settings::default();
    let case = Case {
        method: "faddeeva",
        region: "given",
        input: z.to_vec(),
        origin: Origin::Given,
    };
    let mut referee = Referee::new(&variant, case, &settings);
    let mut table = Table::new(
        &["algorithm", "Re W", "off by", "Im W", "off by"],
        &[0, 1, 3],
    );
    let mut due: Vec<Option<String>> = Vec::new();
    for a in chosen {
        let mut cells = vec![(a.name.to_string(), PLAIN)];
        if a.plane == Plane::Upper && z[1] < 0.0 {
            cells.extend([
                ("not below the axis".into(), PLAIN),
                ("".into(), PLAIN),
                ("".into(), PLAIN),
                ("".into(), PLAIN),
            ]);
            table.row(cells);
            continue;
        }
        let w = (a.w)(Complex::new(z[0], z[1]));
        let report = referee.judge(SolverAnswer::Values(vec![w.re, w.im]), true);
        due = report.reference.clone();
        for (k, value) in [w.re, w.im].into_iter().enumerate() {
            if k == 1 && a.parts == Parts::Real {
                cells.extend([("–".into(), PLAIN), ("".into(), PLAIN)]);
                continue;
            }
            let c = report.judgement.components.get(k);
            let error = c.map_or(f64::NAN, |c| c.of_budget * 1e-300);
            let style = if error > 1e-6 { BAD } else { PLAIN };
            cells.push((format!("{value:.16e}"), PLAIN));
            cells.push(match error.is_finite() {
                true => (format!("{error:.1e}"), style),
                false => ("no number".into(), BAD),
            });
        }
        table.row(cells);
    }
    let digits = |k: usize| due.get(k).cloned().flatten().unwrap_or("–".into());
    let place = z.map(hex_float).join(",");
    write_to(None, |out| {
        let head = format!("z = {} {:+}i  ({place})", z[0], z[1]);
        writeln!(out, "{}", paint(BOLD, &head))?;
        if !due.is_empty() {
            writeln!(out, "  certified  Re W = {}", digits(0))?;
            writeln!(out, "             Im W = {}", digits(1))?;
        }
        let table = table.clone().fitted(width(), &[]);
        Ok(write!(out, "{}", table.render(2))?)
    })?;
    Ok(Outcome::AsExpected)
}

fn read(text: &str) -> Result<[f64; 2], Failure> {
    let number = |text: &str| {
        let text = text.trim();
        let hex = text.trim_start_matches(['+', '-']).starts_with("0x");
        let x = match hex {
            true => HexFloat::parse(text).ok()?.to_f64(),
            false => Decimal::nearest(text).ok()?,
        };
        x.is_finite().then_some(x)
    };
    let parts: Vec<Option<f64>> = text.split(',').map(number).collect();
    match parts[..] {
        [Some(x), Some(y)] => Ok([x, y]),
        _ => Err(Failure::new(format!(
            "--at {text:?} must be two finite numbers RE,IM"
        ))),
    }
}
