use super::*;
use mechaudit_reference::Mag;
use rug::Float;

#[test]
fn the_interval_holds_all_of_the_ball() {
    let ball = Ball::exact(BITS, 1.5).widened(Mag::power_of_two(-20));
    let found = around(&ball);
    let due = 2f64.powi(-20);
    assert!(found.lo <= 1.5 - due && found.lo > 1.5 - 1.01 * due);
    assert!(found.hi >= 1.5 + due && found.hi < 1.5 + 1.01 * due);
    let third = Ball::rational(BITS, &Rational::from((1, 3)));
    let found = around(&third);
    assert!(found.lo < found.hi && found.lo.next_up() == found.hi);
}

/// `stored − exact` within the error, of all that are listed.
#[test]
fn stored_constants_are_off_by_their_errors() {
    let all = [&*ASYMPTOTIC, &*MACLAURIN, &*TWO_OVER_SQRT_PI];
    for c in all.into_iter().flatten() {
        let off = |exact: f64| Float::with_val(200, c.stored) - exact;
        assert!(
            off(c.exact.hi) <= c.error.hi && off(c.exact.lo) >= c.error.lo,
            "{c:?}"
        );
        assert!(
            c.exact.hi - c.exact.lo <= 2.3e-16 * c.stored.abs().max(1e-300) || c.exact.is_zero()
        );
        assert!(c.error.hi - c.error.lo <= 1e-15 * c.error.magnitude());
    }
    let [inverse, low] = [ASYMPTOTIC[0], ASYMPTOTIC[1]];
    // The second part takes back what the first is off by.
    assert!((inverse.error.hi + low.stored).abs() < 1e-15 * low.stored.abs());
    assert!(low.exact.is_zero() && low.error.lo <= low.stored && low.stored <= low.error.hi);
}
