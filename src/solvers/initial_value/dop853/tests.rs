use super::*;
use std::convert::Infallible;

fn circle(_: f64, y: &[f64], out: &mut [f64]) -> Result<(), Infallible> {
    (out[0], out[1]) = (y[1], -y[0]);
    Ok(())
}

/// The quadrature conditions of order 1 to 8 on the weights, and the nodes as row sums.
#[test]
fn coefficients_satisfy_the_conditions_of_order() {
    for power in 0..8 {
        let sum: f64 = WEIGHTS.iter().map(|(j, b)| b * NODES[*j].powi(power)).sum();
        assert!((sum * f64::from(power + 1) - 1.0).abs() < 1e-14, "{power}");
    }
    for (s, row) in STAGE.iter().enumerate() {
        let sum: f64 = row.iter().map(|a| a.1).sum();
        let size: f64 = row.iter().map(|a| a.1.abs()).sum();
        assert!((sum - NODES[s]).abs() <= 1e-15 * size, "stage {s}");
    }
    for estimate in [ERROR_3, ERROR_5] {
        assert!(estimate.iter().map(|e| e.1).sum::<f64>().abs() < 1e-15);
    }
}

/// Halving the step divides the error of the solution by 2⁸ and that of the interpolant by 2⁷.
#[test]
fn orders_of_method_and_interpolant() {
    let errors = |steps: u32| {
        let mut s = Dop853::new(0.0, &[1.0, 0.0], 1e9);
        let h = 4.0 / f64::from(steps);
        let mut between = 0.0f64;
        for k in 1..=steps {
            s.h = Some(h);
            s.step(h * f64::from(k), &mut circle).unwrap();
            let (t, mut y) = (h * (f64::from(k) - 0.4), [0.0; 2]);
            s.between(t, &mut circle, &mut y).unwrap();
            between = between
                .max((y[0] - t.cos()).abs())
                .max((y[1] + t.sin()).abs());
        }
        [(s.y()[0] - 4f64.cos()).abs(), between]
    };
    let (coarse, fine) = (errors(8), errors(16));
    assert!(
        (200.0..800.0).contains(&(coarse[0] / fine[0])),
        "{coarse:?} {fine:?}"
    );
    assert!(
        (100.0..600.0).contains(&(coarse[1] / fine[1])),
        "{coarse:?} {fine:?}"
    );
}

#[test]
fn a_solution_keeps_its_tolerance_between_its_steps() {
    let mut s = Dop853::new(0.0, &[1.0, 0.0], 1e-12);
    let (mut t, mut y) = (0.0, [0.0; 2]);
    while s.t() < 20.0 {
        s.step(20.0, &mut circle).unwrap();
        while t <= s.t() {
            s.between(t, &mut circle, &mut y).unwrap();
            assert!((y[0] - t.cos()).abs() < 1e-10, "{t}");
            t += 0.01;
        }
    }
    assert_eq!(s.t(), 20.0);
    assert!(s.evaluations() < 2000, "{}", s.evaluations());
}

/// y′ = y² has a pole at t = 1: the step becomes small before it, and nothing runs on.
#[test]
fn a_pole_is_not_passed() {
    let mut f = |_: f64, y: &[f64], out: &mut [f64]| {
        out[0] = y[0] * y[0];
        match out[0].is_finite() {
            true => Ok(()),
            false => Err("infinite"),
        }
    };
    let mut s = Dop853::new(0.0, &[1.0], 1e-10);
    let stopped = (0..100_000).find_map(|_| s.step(2.0, &mut f).err());
    assert!(
        stopped.is_some() && (s.t() - 1.0).abs() < 1e-6,
        "{stopped:?} {}",
        s.t()
    );
}
