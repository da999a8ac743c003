//! Our certified values beside those of another program: mpmath, through the loop equations in
//! angles and numerical differentiation (`reference/independent/class_iii_rows.py`).
//!
//! The other program proves nothing; it is a witness that the same problem was solved.

use mechaudit::reference::{Ball, Decimal};
use mechaudit_cli::papers::zinchenko::data;
use rug::Rational;

const BITS: u32 = 256;

#[test]
fn mpmath_agrees_to_thirty_digits() {
    let text = include_str!("../../reference/independent/class_iii_rows.csv");
    let (linkage, start) = data::start(BITS).expect("decided");
    let masses = data::recovered();
    let mut here = start;
    let mut rows = 0;
    for (row, line) in text.lines().skip(1).enumerate() {
        let angle = |r: usize| data::row_angle(&Rational::from(r as u32)).to_ball(BITS);
        if row > 0 {
            here = linkage
                .follow(&here, &angle(row - 1), &angle(row))
                .expect("the branch goes on");
        }
        let k = linkage.kinematics(&here).expect("decided");
        let r = linkage.reduce(&k, &masses);
        let mut ours = k.angles.to_vec();
        ours.extend([
            r.inertia,
            r.inertia_derivative,
            r.moment,
            r.moment_derivative,
        ]);
        let theirs: Vec<&str> = line.split(',').skip(1).collect();
        assert_eq!(theirs.len(), ours.len());
        for (a, b) in ours.iter().zip(theirs) {
            let b = Ball::rational(BITS, &Decimal::parse(b).expect("a number").value);
            let gap = (a - &b).abs().upper();
            assert!(gap < 1e-30, "row {row}: {} and {}", a.mid(), b.mid());
            assert!(a.accuracy_bits() > 150, "row {row}");
        }
        rows += 1;
    }
    assert_eq!(rows, 48);
}

#[test]
fn mpmath_agrees_on_the_chirp_forced_oscillator() {
    use mechaudit::reference::chirp_oscillator::{Problem, response, taylor};
    let text = include_str!("../../reference/independent/chirp_response.csv");
    let mut rows = 0;
    for line in text.lines().skip(1) {
        let cells: Vec<Rational> = line
            .split(',')
            .map(|text| Decimal::parse(text).expect("a number").value)
            .collect();
        let (inputs, theirs) = cells.split_at(9);
        let problem = Problem::new(inputs.try_into().expect("nine")).expect("a problem");
        let ours = response(&problem, BITS).expect("decided");
        let panels = taylor::enclose(&problem, BITS).expect("few panels");
        for ((a, c), b) in ours
            .components()
            .iter()
            .zip(panels.components())
            .zip(theirs)
        {
            assert!(a.overlaps(c), "{line}");
            let gap = (*a - &Ball::rational(BITS, b)).abs().upper();
            let size = a.magnitude().max(mechaudit::reference::Mag::from_f64(1e-5));
            assert!(gap <= 1e-28 * size.to_float(), "{line}: {}", a.mid());
        }
        rows += 1;
    }
    assert_eq!(rows, 14);
}

#[test]
fn mpmath_and_arb_agree_on_the_faddeeva_function() {
    use mechaudit::reference::faddeeva as f;
    const DIGITS: usize = 38;
    let text = include_str!("../../reference/independent/faddeeva_values.csv");
    let mut rows = 0;
    for line in text.lines().skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        let [name, re, im, theirs @ ..] = &cells[..] else {
            panic!("{line}");
        };
        let number = |text: &str| Decimal::parse(text).expect("a number").value;
        let (x, y) = (number(re), number(im));
        let ours = match *name {
            "w" => f::w(&x, &y, BITS),
            "erf" => f::erf(&x, &y, BITS),
            "erfc" => f::erfc(&x, &y, BITS),
            "erfcx" => f::erfcx(&x, &y, BITS),
            "erfi" => f::erfi(&x, &y, BITS),
            "dawson" => f::dawson(&x, &y, BITS),
            "w_derivative_1" => f::w_derivative(1, &x, &y, BITS),
            "w_derivative_5" => f::w_derivative(5, &x, &y, BITS),
            "w_zero" => f::zero(x.numer().to_u32().expect("small"), BITS),
            other => panic!("{other}"),
        }
        .expect("decided");
        for (i, text) in theirs.iter().enumerate() {
            let part = if i % 2 == 0 { &ours.re } else { &ours.im };
            let there = Ball::rational(BITS, &number(text));
            if there.is_zero() {
                assert!(part.is_zero(), "{line}");
                continue;
            }
            assert!(part.accuracy_bits() >= i64::from(BITS) - 1, "{line}");
            let gap = ((part - &there) / &there).abs().upper();
            let allowed = rug::Float::with_val(64, rug::Float::u_pow_u(10, DIGITS as u32)).recip();
            assert!(gap < allowed, "{line}: {}", part.mid());
        }
        rows += 1;
    }
    assert_eq!(rows, 113);
}

/// Extrapolation of the printed equations in time beside the enclosed motion, which integrates
/// nothing in time.
#[test]
fn mpmath_agrees_on_andrews_mechanism() {
    use mechaudit_cli::papers::andrews::{BITS, QUANTITIES, TIMES, motion};
    let text = include_str!("../../reference/independent/andrews.csv");
    let motion = motion(BITS).expect("decided");
    let mut rows = 0;
    for line in text.lines().skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        let at = TIMES.iter().position(|t| *t == cells[0]).expect("a time");
        let quantity = QUANTITIES.iter().position(|q| *q == cells[1]);
        let ours = &motion.values[at + 1][quantity.expect("a quantity")];
        let theirs = Ball::rational(BITS, &Decimal::parse(cells[2]).expect("a number").value);
        let gap = ((ours - &theirs) / ours).abs().upper();
        assert!(gap < 1e-18, "{line}: {}", ours.mid());
        assert!(ours.accuracy_bits() > 100, "{line}");
        rows += 1;
    }
    assert_eq!(rows, 3 * QUANTITIES.len());
}

/// Energies summed over the bars and integrated in time, beside the pendulum by means.
#[test]
fn mpmath_agrees_on_the_n_four_bar() {
    use mechaudit_cli::papers::n_four_bar::data::{pendulum, state};
    use mechaudit_cli::papers::n_four_bar::{BITS, QUANTITIES};
    let text = include_str!("../../reference/independent/n_four_bar.csv");
    let mut rows = 0;
    for line in text.lines().skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        let motion = pendulum(cells[0].parse().expect("N"), BITS).expect("decided");
        let ours = match cells[2] {
            "period" => motion.period().expect("decided"),
            "passage" => {
                let quarter = Ball::pi(BITS).shift(-1);
                motion.time(&quarter).expect("decided")
            }
            name => {
                let at = state(&motion, &cells[1].parse().expect("a time")).expect("decided");
                let k = QUANTITIES.iter().position(|(q, _)| *q == name);
                at.values[k.expect("a quantity")].clone()
            }
        };
        let theirs = Ball::rational(BITS, &Decimal::parse(cells[3]).expect("a number").value);
        let gap = ((&ours - &theirs) / &ours).abs().upper();
        assert!(gap < 1e-18, "{line}: {}", ours.mid());
        assert!(ours.accuracy_bits() > 130, "{line}");
        rows += 1;
    }
    assert_eq!(rows, 72);
}

/// scipy computes in floats, with values of the order of 10.
#[test]
fn scipy_agrees_on_interpolants() {
    use mechaudit::audit::{ReferenceAnswer, SolverAnswer};
    let text = include_str!("../../reference/independent/splines.csv");
    let numbers = |text: &str| -> Vec<f64> {
        let number = |t: &str| t.parse().expect("a number");
        text.split_whitespace().map(number).collect()
    };
    let mut rows = 0;
    for line in text.lines().skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        let [name, x, y, ends, q, due @ ..] = &cells[..] else {
            panic!("{line}");
        };
        let method = mechaudit::methods::find(name).expect("a method");
        let input = [x, y, ends, q, q].map(|cell| numbers(cell)).concat();
        let exact: Vec<Rational> = input
            .iter()
            .filter_map(|x| Rational::from_f64(*x))
            .collect();
        let ReferenceAnswer::Values(reference) = method.reference(&exact, BITS) else {
            panic!("{line}: no values");
        };
        let SolverAnswer::Values(solved) = method.solve(&input) else {
            panic!("{line}: our solver refuses");
        };
        assert_eq!(due.len(), 4);
        for (k, due) in due.iter().enumerate() {
            let due: f64 = due.parse().expect("a number");
            for ours in [reference.values[k].to_f64(), solved[k]] {
                let allowed = 1e-11 * due.abs().max(10.0);
                assert!(
                    (ours - due).abs() <= allowed,
                    "{line}: {ours}, expected {due}"
                );
            }
        }
        rows += 1;
    }
    assert_eq!(rows, 200);
}
