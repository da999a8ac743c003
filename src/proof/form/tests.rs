use super::*;

/// A number `m + Σ c_k ε_k + r` with everything a point, σ left out.
fn form(main: f64, terms: &[(u32, f64)], rest: f64) -> Form {
    let mut form = Form::point(main);
    form.terms = mapped_points(terms);
    form.rest = rest;
    form.summed()
}

fn mapped_points(terms: &[(u32, f64)]) -> Vec<(u32, Interval)> {
    let point = |&(k, c): &(u32, f64)| (k, Interval::point(c));
    terms.iter().map(point).collect()
}

/// `Σ c_k ε_k`, where the signs are the bits of a number.
fn turned(form: &Form, signs: u32) -> f64 {
    let sign = |k: u32| if signs >> k & 1 == 0 { 1.0 } else { -1.0 };
    let each = form.terms.iter();
    each.map(|&(k, c)| sign(k) * 0.5 * (c.lo + c.hi)).sum()
}

/// The largest distance of `of(x, y)` from `m + Σ c_k ε_k` of a result, over all signs of ε and of
/// what is left of x and y.
fn farthest(result: &Form, [x, y]: [&Form; 2], of: impl Fn(f64, f64) -> f64) -> f64 {
    let mut most = 0.0f64;
    for signs in 0..16 {
        for [p, q] in [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]] {
            let value = |f: &Form, sign: f64| f.main.range.lo + turned(f, signs) + sign * f.rest;
            let main = result.main.range.lo;
            let exact = of(value(x, p), value(y, q)) - main - turned(result, signs);
            most = most.max(exact.abs());
        }
    }
    most
}

fn is_near(x: f64, due: f64) -> bool {
    (x - due).abs() <= 1e-13 * due.abs()
}

/// Numbers of all signs with errors of their own and one in common.
fn operands() -> Vec<[Form; 2]> {
    let mut all = Vec::new();
    for (a, b) in [(2.0, 4.0), (-2.0, 4.0), (2.0, -0.5), (-8.0, -0.5)] {
        for (r, q) in [(0.0, 0.0), (0.03125, 0.0), (0.0, 0.0625), (0.03125, 0.0625)] {
            for shared in [0.0, 0.125] {
                let x = form(a, &[(1, 0.0625), (3, shared)], r);
                let y = form(b, &[(2, 0.03125), (3, 0.0625)], q);
                all.push([x, y]);
            }
        }
    }
    all
}

/// With an error of its own for each the rest is attained, so that no smaller one is a bound and
/// this one is.
#[test]
fn what_sums_and_products_leave_out_is_attained() {
    for [x, y] in operands() {
        let added = sum(&x, &y);
        assert!(is_near(
            added.main.range.lo,
            x.main.range.lo + y.main.range.lo
        ));
        let off = farthest(&added, [&x, &y], |p, q| p + q);
        assert!((added.rest - off).abs() < 1e-14 && added.rest >= x.rest + y.rest);
        let times = product(&x, &y, Exact::ZERO, false);
        let off = farthest(&times, [&x, &y], |p, q| p * q);
        assert!(
            times.rest >= off - 1e-14 && times.rest <= 2.2 * off + 1e-14,
            "{x:?} {y:?}"
        );
        assert!(is_near(
            times.main.range.lo,
            x.main.range.lo * y.main.range.lo
        ));
        for f in [&added, &times] {
            let all: f64 = f.terms.iter().map(|(_, c)| c.magnitude()).sum();
            assert!(is_near(f.deviation, all + f.rest) && f.deviation >= all + f.rest);
        }
    }
    // Where all signs are positive nothing is lost.
    let x = form(2.0, &[(1, 0.0625)], 0.03125);
    let y = form(4.0, &[(2, 0.125)], 0.0625);
    let times = product(&x, &y, Exact::ZERO, false);
    assert!(is_near(
        times.rest,
        farthest(&times, [&x, &y], |p, q| p * q)
    ));
    // The first-order part by hand, with an error in common.
    let y = form(4.0, &[(1, 0.125), (2, 0.5)], 0.0);
    let [(1, c), (2, d)] = product(&x, &y, Exact::ZERO, false).terms[..] else {
        panic!("two terms");
    };
    assert!(is_near(c.lo, 4.0 * 0.0625 + 2.0 * 0.125) && is_near(d.hi, 2.0 * 0.5));
    // Subtracted terms vanish.
    assert!(sum(&x, &x.negative()).deviation <= 2.0 * x.rest + 1e-15);
}

#[test]
fn what_quotients_leave_out_is_attained() {
    for [x, y] in operands() {
        let found = quotient(&x, &y).expect("no zero");
        let off = farthest(&found, [&x, &y], |p, q| p / q);
        assert!(
            found.rest >= off * (1.0 - 1e-12),
            "{x:?} {y:?} {found:?} {off}"
        );
        assert!(
            found.rest <= 2.2 * off + 1e-13,
            "{x:?} {y:?} {found:?} {off}"
        );
        assert!(is_near(
            found.main.range.lo,
            x.main.range.lo / y.main.range.lo
        ));
    }
    // Of one error each: `(|d| + |Q||e|)|e|/(|Y|(|Y| − |e|))`, plus `(r + |Q|q)/|Y|`.
    let (x, y) = (form(3.0, &[(1, 0.25)], 0.0), form(2.0, &[(2, 0.125)], 0.0));
    let second = (0.25 + 1.5 * 0.125) * 0.125 / (2.0 * 1.875);
    assert!(is_near(quotient(&x, &y).expect("no zero").rest, second));
    let (x, y) = (form(3.0, &[], 0.25), form(2.0, &[], 0.125));
    let first = (0.25 + 1.5 * 0.125) / 2.0;
    assert!(is_near(
        quotient(&x, &y).expect("no zero").rest,
        first + second
    ));
    let terms = quotient(
        &form(3.0, &[(1, 0.25)], 0.0),
        &form(2.0, &[(1, 0.125)], 0.0),
    );
    let c = terms.expect("no zero").terms[0].1;
    assert!(is_near(0.5 * (c.lo + c.hi), (0.25 - 1.5 * 0.125) / 2.0));
}

#[test]
fn no_quotient_by_what_may_be_zero() {
    let x = form(1.0, &[], 0.0);
    assert!(quotient(&x, &form(1.0, &[(1, 1.0)], 0.0)).is_none());
    assert!(quotient(&x, &form(1.0, &[], 1.0)).is_none());
    let mut tiny = form(1.0, &[], 0.0);
    tiny.tiny = 1.0;
    assert!(quotient(&x, &tiny).is_none());
    let mut small = form(1.0, &[], 0.0);
    small.small = true;
    assert!(quotient(&x, &small).is_none());
    // An underflow of the dividend is divided by the least divisor.
    let divided = quotient(&tiny, &form(0.5, &[(1, 0.25)], 0.0)).expect("no zero");
    assert!(is_near(divided.tiny, 4.0));
    assert_eq!(divided.grain, i32::MIN);
}

/// `s (m + …) + t` is enclosed for every σ, and t is a number beside σ.
#[test]
fn the_small_factor_and_what_underflows_are_in_the_range() {
    let sigma = Exact::within(Interval::new(0.25, 0.5));
    let mut x = form(2.0, &[(1, 0.5)], 0.25);
    let enclosed = |f: &Form| [f.range(sigma).lo, f.range(sigma).hi];
    let [lo, hi] = enclosed(&x);
    assert!(lo <= 1.25 && lo > 1.2499 && (2.75..2.7501).contains(&hi));
    x.small = true;
    let [lo, hi] = enclosed(&x);
    assert!(lo <= 0.3125 && lo > 0.3124 && (1.375..1.3751).contains(&hi));
    let plain = x.plain(sigma);
    assert!(!plain.small && plain.terms[0].0 == 1);
    assert!(is_near(plain.rest, 0.125) && is_near(plain.terms[0].1.hi, 0.25));
    assert!(is_near(plain.main.range.lo, 0.5) && is_near(plain.main.range.hi, 1.0));
    assert!(is_near(plain.deviation, 0.375));
    // In units of half the smallest number.
    let mut t = form(0.0, &[], 0.0);
    t.tiny = 6.0;
    assert!(t.range(sigma).hi >= 3.0 * TINIEST && t.range(sigma).lo <= -3.0 * TINIEST);
    assert!(t.range(sigma).hi <= 8.0 * TINIEST);
    let mut y = form(3.0, &[], 0.0);
    y.tiny = 2.0;
    x.tiny = 5.0;
    let times = product(&x, &y, sigma, false);
    // 5 · 3 and 2 · 1.375
    assert!(
        times.small && times.tiny >= 17.75 && times.tiny <= 17.7501,
        "{times:?}"
    );
    assert!(product(&y, &x, sigma, false).small);
    assert_eq!(
        product(&form(2.0, &[], 0.0), &form(3.0, &[], 0.0), sigma, false).tiny,
        0.0
    );
    assert_eq!(sum(&y, &y).tiny, 4.0f64.next_up());
    // Far out it is counted as a number: its unit would overflow.
    let mut far = form(1.0, &[], 0.5);
    far.tiny = 1e200;
    far.share = 0.0;
    let summed = far.clone().summed();
    assert!(summed.tiny == 0.0 && summed.rest >= 0.5 + 1e200 * TINIEST / 2.0);
    assert_eq!(summed.share, f64::INFINITY);
    let mut alone = form(1.0, &[], 0.0);
    alone.tiny = 1e200;
    assert!(alone.summed().rest >= 1e200 * TINIEST);
    far.small = true;
    assert_eq!(far.summed().tiny, 1e200);
}

/// A constant is a number without any error.
#[test]
fn what_has_an_error_is_no_constant() {
    let x = form(3.0, &[], 0.0);
    assert_eq!(x.constant(), Some(3.0));
    assert!(!x.is_zero() && form(0.0, &[], 0.0).is_zero());
    let with = |change: fn(&mut Form)| {
        let mut zero = form(0.0, &[], 0.0);
        change(&mut zero);
        zero
    };
    for other in [
        with(|f| f.rest = 1.0),
        with(|f| f.tiny = 1.0),
        with(|f| f.terms.push((1, Interval::point(1.0)))),
        with(|f| f.main = Exact::within(Interval::new(0.0, 1.0))),
    ] {
        assert!(other.constant().is_none() && !other.is_zero(), "{other:?}");
    }
    assert!(with(|f| f.small = true).constant().is_none());
}

/// A sum of two numbers of one sign is wrong by no larger a part of it than one of them; a product
/// by both.
#[test]
fn parts_of_sums_and_products() {
    let with_share = |main: Interval, share: f64| {
        let mut f = Form::exact(Exact::within(main), -1074);
        (f.share, f.rest) = (share, 1e9);
        f.summed()
    };
    let (x, y) = (
        with_share(Interval::new(0.0, 1.0), 0.25),
        with_share(Interval::new(0.0, 1.0), 0.5),
    );
    assert_eq!(
        [x.relative(), sum(&x, &y).share, sum(&y, &x).share],
        [0.25, 0.5, 0.5]
    );
    let other = with_share(Interval::new(-1.0, 1.0), 0.5);
    assert_eq!(sum(&x, &other).share, f64::INFINITY);
    assert_eq!(sum(&other, &x).share, f64::INFINITY);
    assert!(is_near(product(&x, &y, Exact::ZERO, false).share, 0.875));
    assert!(product(&x, &y, Exact::ZERO, false).share >= 0.875);
    // By its size, where that is better.
    assert!(is_near(form(-4.0, &[(1, 0.5)], 0.5).relative(), 0.25));
    assert_eq!(
        quotient(&x, &form(1.0, &[], 0.0)).expect("no zero").share,
        f64::INFINITY
    );
}

/// Half the spacing at the largest number, unless all of them are `f64`s.
#[test]
fn one_rounding_is_half_a_unit_of_the_largest() {
    let over = |lo: f64, hi: f64, grain: i32| {
        let f = Form::exact(Exact::within(Interval::new(lo, hi)), grain);
        rounding(&f, Exact::ZERO, 1.0)
    };
    for (lo, hi) in [
        (1.0, 1.5),
        (1.0, 1.99),
        (-3.9, 1.0),
        (1e-300, 2e-300),
        (1e15, 1e16),
    ] {
        let most = f64::max(hi, -lo);
        let half = 0.5 * (most.next_up() - most);
        assert_eq!(over(lo, hi, -1074 - 60), Some((half, 0.0)));
    }
    // Multiples of 2^g below 2^{g+53} are numbers, those beyond are not.
    assert_eq!(over(1.0, 1.5, -52), None);
    assert_eq!(over(1.0, 2.0, -52), Some((2f64.powi(-52), 0.0)));
    assert_eq!(over(1.0, 1.5, -53), Some((2f64.powi(-53), 0.0)));
    assert_eq!(over(0.0, 0.0, i32::MIN), None);
    // Below the normal numbers half a unit is half the smallest number, which may overflow nowhere.
    assert_eq!(over(0.0, 1e-310, -1080), Some((0.0, 1.0)));
    assert_eq!(over(0.0, 1e-310, -1074), None);
    let least = f64::MIN_POSITIVE;
    assert_eq!(over(0.0, 1.5 * least, -1080), Some((0.0, 1.0)));
    assert_eq!(over(0.0, 3.0 * least, -1080), Some((TINIEST, 0.0)));
    assert_eq!(over(0.0, 1e308, -1080), Some((f64::INFINITY, 0.0)));
    assert_eq!(over(0.0, 8e307, -1080), Some((2f64.powi(969), 0.0)));
    // Truncation is off by a whole unit.
    let f = Form::exact(Exact::within(Interval::new(1.0, 1.5)), -60);
    assert_eq!(rounding(&f, Exact::ZERO, 2.0), Some((2f64.powi(-52), 0.0)));
    let f = Form::exact(Exact::within(Interval::new(0.0, 1e-310)), -1080);
    assert_eq!(rounding(&f, Exact::ZERO, 2.0), Some((0.0, 2.0)));
}

/// Beside the factor σ: half a unit in the last place is at most `2⁻⁵³ |v|`, or half a unit of the
/// largest for all σ.
#[test]
fn one_rounding_beside_the_small_factor() {
    let u = 2f64.powi(-53);
    let with = |m: f64, tiny: f64, sigma: Interval| {
        let mut f = Form::exact(Exact::point(m), -2000);
        (f.small, f.tiny) = (true, tiny);
        rounding(&f, Exact::within(sigma), 1.0).expect("rounded")
    };
    // σ m from 1.5 to 1.6 is wrong by half a unit there, 1.75 σ by 1.75u.
    let (error, absolute) = with(1.0, 0.0, Interval::new(1.5, 1.6));
    assert!(absolute == 0.0 && error >= u / 1.5 && error <= u / 1.4999);
    let (error, absolute) = with(1.75, 0.0, Interval::new(1e-9, 1.0));
    assert!(absolute == 0.0 && error >= 1.75 * u && error <= 1.7501 * u);
    // Where σ may be zero, subnormal numbers are half the smallest off.
    let (error, absolute) = with(1.75, 0.0, Interval::new(0.0, 1.0));
    assert!(absolute == 1.0 && error >= 1.75 * u && error <= 1.7501 * u);
    let (error, absolute) = with(1.0, 0.0, Interval::new(f64::MIN_POSITIVE, 1.0));
    assert!(absolute == 1.0 || error >= u, "{error} {absolute}");
    let below = f64::MIN_POSITIVE.next_down();
    assert!(with(1.75, 0.0, Interval::new(below / 1.75, 1.0)).1 >= 1.0);
    // An earlier underflow is rounded with the number.
    let (_, absolute) = with(1.75, 8.0, Interval::new(1e-200, 1.0));
    assert!((1.0..1.01).contains(&absolute));
    let (_, absolute) = with(1.75, 8.0, Interval::new(0.0, 1.0));
    assert!((2.0..2.01).contains(&absolute));
    let (_, absolute) = with(1.75, 1e20, Interval::new(0.0, 1.0));
    assert!(absolute > 1e4);
    // All below the normal numbers: no unit of size.
    let (error, absolute) = with(1.0, 0.0, Interval::new(1e-310, 2e-310));
    assert!(absolute >= 1.0 && error >= u);
}

/// After its rounding a number has one error more, and its part counts if no number may be
/// subnormal.
#[test]
fn a_rounded_number() {
    let u = 2f64.powi(-53);
    let x = Form::exact(Exact::within(Interval::new(1.25, 1.5)), -80);
    let error = rounding(&x, Exact::ZERO, 1.0).expect("rounded");
    let r = rounded(x.clone(), Exact::ZERO, error, 1.0, 7);
    assert_eq!(r.terms, mapped_points(&[(7, u)]));
    assert!(r.deviation >= u && r.deviation <= 1.01 * u && r.tiny == 0.0);
    assert_eq!((r.share, r.grain), (u, -52));
    let mut with_share = x.clone();
    (with_share.share, with_share.deviation) = (0.25, 4.0);
    let r = rounded(with_share, Exact::ZERO, (u, 0.0), 1.0, 7);
    assert!(r.share >= 0.25 + 1.25 * u && r.share < 0.25 + 3.0 * u);
    let r = rounded(x.clone(), Exact::ZERO, (u, 0.0), 2.0, 7);
    assert_eq!(r.share, 2.0 * u);
    let r = rounded(x, Exact::ZERO, (0.0, 3.0), 1.0, 7);
    assert!(r.terms.is_empty() && r.tiny == 3.0);
    // From 0, or with what underflowed, no part is known.
    let from_zero = Form::exact(Exact::within(Interval::new(0.0, 1.5)), -80);
    assert_eq!(
        rounded(from_zero, Exact::ZERO, (u, 0.0), 1.0, 7).share,
        f64::INFINITY
    );
    let mut tiny = Form::exact(Exact::within(Interval::new(1.0, 1.5)), -80);
    tiny.tiny = 1.0;
    assert_eq!(
        rounded(tiny, Exact::ZERO, (u, 0.0), 1.0, 7).share,
        f64::INFINITY
    );
    let least = f64::MIN_POSITIVE;
    let of = |lo: f64| {
        let f = Form::exact(Exact::within(Interval::new(lo, 1.0)), -1090);
        rounded(f, Exact::ZERO, (u, 0.0), 1.0, 7).share
    };
    assert_eq!([of(2.0 * least), of(1.9 * least)], [u, f64::INFINITY]);
}

#[test]
fn exponents_and_spacings() {
    for k in [-1074, -1073, -1023, -1022, -1, 0, 52, 1023] {
        let x = power_of_two(k);
        assert_eq!(
            (x, exponent(x)),
            (2f64.powi(k / 2) * 2f64.powi(k - k / 2), k)
        );
        assert!(k == -1074 || exponent(x.next_down()) == k - 1);
        let grain = grain_of(x);
        assert_eq!(power_of_two(grain), x.next_up() - x);
    }
    assert_eq!(exponent(f64::INFINITY), 1024);
    assert_eq!((grain_of(0.0), grain_of_point(0.0)), (-1074, -1074));
    for (x, grain) in [
        (1.0, 0),
        (-3.0, 0),
        (0.75, -2),
        (1.5e-323, -1074),
        (2e-323, -1072),
    ] {
        assert_eq!(grain_of_point(x), grain, "{x}");
    }
    assert_eq!(grain_of_point(1.0f64.next_up()), -52);
    assert_eq!(grain_of_point(f64::MIN_POSITIVE), -1022);
    // The sum has the finer grid, the product both.
    let (x, y) = (Form::point(0.5), Form::point(0.25));
    assert_eq!(sum(&x, &y).grain, -2);
    assert_eq!(product(&x, &y, Exact::ZERO, false).grain, -3);
    let far = Form::exact(Exact::within(Interval::new(8.0, 9.0)), -90);
    assert_eq!(regrained(far, Exact::ZERO).grain, -49);
}
