use super::*;
use rug::Float;

/// `x (1 + Σ c_n x^{2n})` for the sine: what any polynomial differs from it by is below the bound.
#[test]
fn odd_series_are_within_their_errors() {
    let next: Next = |n, before| before * Rational::from((-1, 2 * n * (2 * n + 1)));
    let sine = |terms: u32| -> Vec<f64> {
        let mut exact = Rational::from(1);
        (1..=terms)
            .map(|n| {
                let c = exact.to_f64();
                exact = next(n, exact.clone());
                c
            })
            .collect()
    };
    let worst = |c: &[f64], low: f64| {
        let all = (1..=50).map(|i| {
            let x: Float = Float::with_val(200, i) / 100;
            let square = x.clone().square();
            let mut sum = Float::with_val(200, 0);
            for (n, c) in c.iter().enumerate().rev() {
                sum = sum * &square + *c + if n == 1 { low } else { 0.0 };
            }
            let due = x.clone().sin() / x;
            ((sum - &due) / due).abs().to_f64()
        });
        all.fold(0.0, f64::max)
    };
    for terms in [2, 3, 5] {
        let c = sine(terms);
        let found = odd_series_error(&c, 0.0, next);
        let off = worst(&c, 0.0);
        assert!(
            off <= found && found <= 1.6 * off,
            "{terms} {off:e} {found:e}"
        );
    }
    // One coefficient off, by so much that what is left out does not count.
    for (i, by) in [(0, 1e-3), (1, 1e-3), (2, -1e-3), (4, 1e-2)] {
        let mut c = sine(9);
        c[i] += by;
        let found = odd_series_error(&c, 0.0, next);
        let due = by.abs() * 0.25f64.powi(i as i32) / 0.8;
        assert!(
            found >= due * (1.0 - 1e-6) && found <= due * (1.0 + 1e-6),
            "{i} {found}"
        );
        assert!(worst(&c, 0.0) <= found);
    }
    // The low part restores the deficit of the second coefficient.
    let mut c = sine(9);
    c[1] -= 1e-3;
    let found = odd_series_error(&c, 1e-3, next);
    assert!(found < 1e-15 && worst(&c, 1e-3) <= found);
}

#[test]
fn pairs_are_within_their_errors() {
    let third = &Ball::integer(300, 1) * &Ball::rational(300, &Rational::from((1, 3)));
    let hi = 1.0 / 3.0;
    let lo = Float::with_val(200, third.mid() - &Float::with_val(200, hi)).to_f64();
    let of = |pair: [f64; 2]| pair_error(pair, &third);
    let due = |pair: [f64; 2]| {
        let sum = rational(pair[0]) + rational(pair[1]);
        let off: Rational = (sum - Rational::from((1, 3))) * 3;
        off.abs().to_f64()
    };
    for pair in [[hi, lo], [hi, 0.0], [hi, 2.0 * lo]] {
        let (found, due) = (of(pair), due(pair));
        assert!(
            found >= due && found <= 1.05 * due,
            "{pair:?} {found:e} {due:e}"
        );
    }
}
