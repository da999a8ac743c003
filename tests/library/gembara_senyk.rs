//! The paper of Gembara and Senyk: what follows from its formulas.

use mechaudit_cli::papers::gembara_senyk::charts;
use rug::Rational;
use std::fmt::Write;

const LAWS: [charts::Law; 2] = [charts::Law::K, charts::Law::Constant];

#[test]
fn charts_of_both_laws() {
    let mut text = String::new();
    for law in LAWS {
        writeln!(
            text,
            "law {}: xi, sum of |A_k|, k = 1 ... {}",
            law.name(),
            charts::HARMONICS
        )
        .unwrap();
        for xi in 2..=14 {
            let sum = charts::certified(law, &Rational::from(xi), 240);
            assert!(sum.rad().to_f64() < 1e-26, "{xi}: {:?}", sum.rad());
            writeln!(text, "{xi:2}  {:.25}", sum.mid()).unwrap();
        }
    }
    insta::with_settings!({snapshot_path => "../../snapshots", prepend_module_to_snapshot => false}, {
        insta::assert_snapshot!("gembara-senyk-charts", text);
    });
}

#[test]
fn solver_against_certified_charts() {
    for law in LAWS {
        let chart = charts::chart(law, charts::Programme::RunUp).unwrap();
        for xi in [2u32, 5, 9, 14] {
            let due = charts::certified(law, &Rational::from(xi), 140)
                .mid()
                .to_f64();
            let point = chart
                .points
                .iter()
                .find(|p| (p.xi_rise - f64::from(xi)).abs() < 1e-9);
            let got = point.expect("on the grid").bound;
            assert!(
                (got / due - 1.0).abs() < 1e-12,
                "{} {xi}: {got} {due}",
                law.name()
            );
        }
    }
}
