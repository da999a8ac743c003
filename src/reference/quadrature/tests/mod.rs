mod functions;
mod soundness;
mod table;

use super::*;
use functions as c;

/// An integrand from closures: the values, and the behaviour at ends.
struct Formula<F, G> {
    f: F,
    growth: G,
}

impl<F, G> Integrand for Formula<F, G>
where
    F: FnMut(&ComplexBall, bool, u32) -> Option<ComplexBall>,
    G: FnMut(&Germ) -> Option<Germ>,
{
    fn enclose(&mut self, z: &ComplexBall, holomorphic: bool, bits: u32) -> Option<ComplexBall> {
        (self.f)(z, holomorphic, bits)
    }

    fn growth(&mut self, end: &End, k: u32) -> Option<Growth> {
        (self.growth)(&Germ::variable(end, k, 128))?.growth()
    }
}

fn smooth<F>(f: F) -> Formula<F, fn(&Germ) -> Option<Germ>>
where
    F: FnMut(&ComplexBall, bool, u32) -> Option<ComplexBall>,
{
    Formula {
        f,
        growth: |_| None,
    }
}

fn number(n: i64) -> Limit {
    Limit::Finite(Ball::integer(64, n))
}

fn reached(found: &Integral<Ball>, due: &Ball, digits: i64, name: &str) {
    let value = found
        .value
        .as_ref()
        .unwrap_or_else(|| panic!("{name}: {:?}", found.hindrance));
    assert_eq!(found.hindrance, None, "{name}: {value:?}");
    assert!(value.overlaps(due), "{name}: {value:?} {due:?}");
    let bits = (digits as f64 * std::f64::consts::LOG2_10) as i64;
    assert!(
        value.rad() <= Mag::power_of_two(-bits).mul(due.magnitude().max(Mag::from_f64(1.0))),
        "{name}"
    );
}

#[test]
fn smooth_integrands() {
    for digits in [15, 30, 100] {
        let goal = Goal::digits(digits);
        let bits = 4 * digits + 64;
        let check = |found: Integral<Ball>, due: Ball, name: &str| {
            reached(&found, &due, i64::from(digits), name);
        };
        let mut sine = smooth(|z, _, _| Some(c::sine(z)));
        let due = Ball::integer(bits, 1) - Ball::integer(bits, 100).sin_cos().1;
        check(
            integrate(&mut sine, &number(0), &number(100), &goal),
            due.clone(),
            "sin",
        );
        check(
            integrate(&mut sine, &number(100), &number(0), &goal),
            -due,
            "sin downwards",
        );
        let mut lorentz =
            smooth(|z, _, bits| c::div(&c::real(4, bits), &(&c::real(1, bits) + &(z * z))));
        check(
            integrate(&mut lorentz, &number(0), &number(1), &goal),
            Ball::pi(bits),
            "4/(1+x^2)",
        );
        let pi = Limit::Finite(Ball::pi(bits));
        check(
            integrate(&mut sine, &number(0), &pi, &goal),
            Ball::integer(bits, 2),
            "sin to pi",
        );
        let mut exponential = smooth(|z, _, _| Some(c::exp(z)));
        let e = Ball::integer(bits, 1).exp();
        check(
            integrate(&mut exponential, &number(0), &number(1), &goal),
            e - Ball::integer(bits, 1),
            "exp",
        );
    }
}

#[test]
fn singular_ends() {
    for digits in [15, 30, 100] {
        let goal = Goal::digits(digits);
        let bits = 4 * digits + 64;
        let check = |found: Integral<Ball>, due: Ball, name: &str| {
            reached(&found, &due, i64::from(digits), name);
        };
        let of = |n: i64| Ball::integer(bits, n);
        let mut log = Formula {
            f: |z: &ComplexBall, _, _| c::ln(z),
            growth: |x: &Germ| x.ln(),
        };
        check(
            integrate(&mut log, &number(0), &number(1), &goal),
            of(-1),
            "log",
        );
        let mut root = Formula {
            f: |z: &ComplexBall, _, bits| c::div(&c::real(1, bits), &c::sqrt(z)?),
            growth: |x: &Germ| x.sqrt()?.recip(),
        };
        check(
            integrate(&mut root, &number(0), &number(1), &goal),
            of(2),
            "1/sqrt",
        );
        let mut both = Formula {
            f: |z: &ComplexBall, _, _| Some(&c::sqrt(z)? * &c::ln(z)?),
            growth: |x: &Germ| x.sqrt()?.mul(&x.ln()?),
        };
        check(
            integrate(&mut both, &number(0), &number(1), &goal),
            of(-4) / of(9),
            "sqrt log",
        );
        let mut quotient = Formula {
            f: |z: &ComplexBall, _, bits| c::div(&-&c::ln(z)?, &(&c::real(1, bits) + z)),
            growth: |x: &Germ| {
                x.ln()?
                    .div(&x.add(&Germ::constant(&Ball::integer(64, 1), 2))?)
            },
        };
        check(
            integrate(&mut quotient, &number(0), &number(1), &goal),
            Ball::pi(bits).square() / of(12),
            "-log(x)/(1+x)",
        );
        let one = Germ::constant(&Ball::integer(64, 1), 2);
        let four = Germ::constant(&Ball::integer(64, 4), 2);
        let mut circle = Formula {
            f: |z: &ComplexBall, _, bits| {
                Some(c::sqrt(&(&c::real(1, bits) - &(z * z)))?.scaled(&Ball::integer(bits, 4)))
            },
            growth: |x: &Germ| one.sub(&x.mul(x)?)?.sqrt()?.mul(&four),
        };
        check(
            integrate(&mut circle, &number(0), &number(1), &goal),
            Ball::pi(bits),
            "4 sqrt(1-x^2)",
        );
        let mut arcsine = Formula {
            f: |z: &ComplexBall, _, bits| {
                c::div(
                    &c::real(1, bits),
                    &c::sqrt(&(&c::real(1, bits) - &(z * z)))?,
                )
            },
            growth: |x: &Germ| one.sub(&x.mul(x)?)?.sqrt()?.recip(),
        };
        check(
            integrate(&mut arcsine, &number(-1), &number(1), &goal),
            Ball::pi(bits),
            "1/sqrt(1-x^2)",
        );
    }
}

#[test]
fn infinite_ends() {
    let all = [Limit::MinusInfinity, Limit::PlusInfinity];
    for digits in [15, 30, 100] {
        let goal = Goal::digits(digits);
        let bits = 4 * digits + 64;
        let check = |found: Integral<Ball>, due: Ball, name: &str| {
            reached(&found, &due, i64::from(digits), name);
        };
        let of = |n: i64| Ball::integer(bits, n);
        let one = Germ::constant(&Ball::integer(64, 1), 2);
        let half_line =
            |f: &mut dyn FnMut(&Limit, &Limit) -> Integral<Ball>| f(&number(0), &all[1]);
        let mut gauss = Formula {
            f: |z: &ComplexBall, _, _| Some(c::exp(&-&(z * z))),
            growth: |x: &Germ| x.mul(x)?.neg().exp(),
        };
        let root = Ball::pi(bits).sqrt();
        check(
            half_line(&mut |a, b| integrate(&mut gauss, a, b, &goal)),
            root.shift(-1),
            "gauss",
        );
        check(
            integrate(&mut gauss, &all[0], &all[1], &goal),
            root,
            "gauss, both ends",
        );
        let mut lorentz = Formula {
            f: |z: &ComplexBall, _, bits| {
                c::div(&c::real(1, bits), &(&c::real(1, bits) + &(z * z)))
            },
            growth: |x: &Germ| one.add(&x.mul(x)?)?.recip(),
        };
        check(
            half_line(&mut |a, b| integrate(&mut lorentz, a, b, &goal)),
            Ball::pi(bits).shift(-1),
            "lorentz",
        );
        check(
            integrate(&mut lorentz, &all[0], &all[1], &goal),
            Ball::pi(bits),
            "lorentz, both ends",
        );
        let mut sech = Formula {
            f: |z: &ComplexBall, _, bits| c::div(&c::real(2, bits), &(&c::exp(z) + &c::exp(&-z))),
            growth: |x: &Germ| {
                Germ::constant(&Ball::integer(64, 2), 2).div(&x.exp()?.add(&x.neg().exp()?)?)
            },
        };
        check(
            half_line(&mut |a, b| integrate(&mut sech, a, b, &goal)),
            Ball::pi(bits).shift(-1),
            "sech",
        );
        let mut bose = Formula {
            f: |z: &ComplexBall, _, bits| {
                let e = c::exp(&-z);
                c::div(&(z * &e), &(&c::real(1, bits) + &e))
            },
            growth: |x: &Germ| {
                let e = x.neg().exp()?;
                x.mul(&e)?.div(&one.add(&e)?)
            },
        };
        check(
            half_line(&mut |a, b| integrate(&mut bose, a, b, &goal)),
            Ball::pi(bits).square() / of(12),
            "x e^-x/(1+e^-x)",
        );
        let mut slow = Formula {
            f: |z: &ComplexBall, _, _| c::div(&c::ln(z)?, &(z * &(z * z))),
            growth: |x: &Germ| x.ln()?.div(&x.powi(3)?),
        };
        check(
            integrate(&mut slow, &number(1), &all[1], &goal),
            of(1).shift(-2),
            "log(x)/x^3",
        );
        // Singular at one end and infinite at the other: Γ(1/2).
        let mut gamma = Formula {
            f: |z: &ComplexBall, _, _| c::div(&c::exp(&-z), &c::sqrt(z)?),
            growth: |x: &Germ| x.neg().exp()?.div(&x.sqrt()?),
        };
        check(
            half_line(&mut |a, b| integrate(&mut gamma, a, b, &goal)),
            Ball::pi(bits).sqrt(),
            "e^-x/sqrt(x)",
        );
    }
}

/// A square root has a limit from above on its cut, where it is not real: a panel at its branch
/// point is not continued by reflection.
#[test]
fn branch_points_at_a_limit() {
    let mut root = Formula {
        f: |z: &ComplexBall, _: bool, bits: u32| crate::elementary::complex::sqrt(z, bits).ok(),
        growth: |x: &Germ| x.sqrt(),
    };
    for digits in [15, 30] {
        let found = integrate(&mut root, &number(0), &number(1), &Goal::digits(digits));
        let due = Ball::rational(4 * digits + 64, &(2, 3).into());
        reached(&found, &due, i64::from(digits), "sqrt(x)");
    }
}

/// Steps and kinks, which are holomorphic between them.
#[test]
fn jumps_and_kinks() {
    let floor = |z: &ComplexBall, holomorphic: bool, bits: u32| {
        let low = z.re.lower().floor();
        let high = z.re.upper().floor();
        match low == high && !(holomorphic && z.re.contains(&low.to_rational()?)) {
            true => Some(ComplexBall::new(
                Ball::new(low, Mag::ZERO),
                Ball::integer(bits, 0),
            )),
            false if holomorphic => None,
            false => Some(ComplexBall::new(
                Ball::between(bits, &low, &high),
                Ball::integer(bits, 0),
            )),
        }
    };
    let abs = |z: &ComplexBall, holomorphic: bool| match () {
        () if z.re.is_positive() => Some(z.clone()),
        () if z.re.is_negative() => Some(-z),
        () if holomorphic || !c::is_real(z) => None,
        () => {
            let top = Ball::new(z.re.magnitude().to_float(), Mag::ZERO).with_prec(z.re.prec());
            Some(ComplexBall::new(
                top.union(&Ball::integer(64, 0)),
                z.im.clone(),
            ))
        }
    };
    for digits in [15, 30, 60] {
        let goal = Goal::digits(digits);
        let bits = 4 * digits + 64;
        let check = |found: Integral<Ball>, due: Ball, name: &str| {
            reached(&found, &due, i64::from(digits), name);
        };
        let mut steps = smooth(|z, holomorphic, bits| floor(z, holomorphic, bits));
        check(
            integrate(&mut steps, &number(1), &number(101), &goal),
            Ball::integer(bits, 5050),
            "floor",
        );
        let mut kink = smooth(|z, holomorphic, bits| {
            let third = Ball::rational(bits, &(1, 3).into());
            let off = z - &ComplexBall::new(third, Ball::integer(bits, 0));
            Some(&abs(&off, holomorphic)? * &c::exp(z))
        });
        // ∫ (1/3 − x) e^x + ∫ (x − 1/3) e^x with the antiderivative (x − 4/3) e^x.
        let third = Ball::rational(bits, &(1, 3).into());
        let due = third.exp().shift(1)
            - Ball::rational(bits, &(4, 3).into())
            - Ball::integer(bits, 1).exp() / Ball::integer(bits, 3);
        check(
            integrate(&mut kink, &number(0), &number(1), &goal),
            due,
            "|x-1/3| exp(x)",
        );
        let mut greater = smooth(|z, holomorphic, _| {
            let (s, co) = (
                c::sine(z),
                c::sine(
                    &(z + &ComplexBall::new(Ball::pi(z.re.prec()).shift(-1), Ball::integer(64, 0))),
                ),
            );
            let sum = &s + &co;
            Some((&sum + &abs(&(&s - &co), holomorphic)?).scaled(&Ball::exact(64, 0.5)))
        });
        let pi = Limit::Finite(Ball::pi(bits));
        let due = Ball::integer(bits, 1) + Ball::integer(bits, 2).sqrt();
        check(
            integrate(&mut greater, &number(0), &pi, &goal),
            due,
            "max(sin, cos)",
        );
    }
}

/// Along the left side of a square about zero: `∫ √x`, which is not analytic across the negative
/// axis.
#[test]
fn segments() {
    let goal = Goal::digits(30);
    let corner = |y: i64| ComplexBall::new(Ball::integer(128, -1), Ball::integer(128, y));
    let mut entire = smooth(|z, _, _| Some(c::exp(z)));
    let found = integrate_segment(&mut entire, &corner(-1), &corner(1), &goal);
    let due = &corner(1).exp() - &corner(-1).exp();
    assert!(found.hindrance.is_none() && found.value.unwrap().overlaps(&due));
    // 1/x from −1 − i to −1 + i past the pole on its left: ln is continued to −i π/2.
    let mut pole = smooth(|z, _, bits| c::div(&c::real(1, bits), z));
    let found = integrate_segment(&mut pole, &corner(-1), &corner(1), &goal)
        .value
        .unwrap();
    let due = -Ball::pi(128).shift(-1);
    assert!(found.im.overlaps(&due) && found.re.contains_zero() && found.radius().to_f64() < 1e-29);
    let mut root = smooth(|z, holomorphic, bits| {
        if holomorphic || z.im.is_positive() || z.im.is_negative() {
            return c::sqrt(z);
        }
        let most = Ball::integer(bits, 0).widened(z.magnitude().sqrt());
        Some(ComplexBall::new(most.clone(), most))
    });
    let found = integrate_segment(&mut root, &corner(-1), &corner(1), &goal);
    assert!(found.hindrance.is_none());
    // Twice the imaginary part of (2/3) z^(3/2) at −1 + i, in polar form, less that at −1: real
    // parts cancel.
    let value = found.value.unwrap();
    assert!(value.re.contains_zero() && value.radius().to_f64() < 1e-29);
}

#[test]
fn what_hinders_is_named() {
    let goal = Goal {
        evaluations: 20_000,
        ..Goal::digits(30)
    };
    let mut wild = smooth(|z, _, bits| Some(c::sine(&c::div(&c::real(1, bits), z)?)));
    let mut bounded = smooth(|z, holomorphic, bits| match c::div(&c::real(1, bits), z) {
        Some(inverse) => Some(c::sine(&inverse)),
        None if holomorphic => None,
        None => Some(ComplexBall::new(
            Ball::integer(bits, 0).widened(Mag::from_f64(1.0)),
            Ball::integer(bits, 0),
        )),
    });
    let found = integrate(&mut wild, &number(0), &number(1), &goal);
    assert_eq!(found.hindrance, Some(Hindrance::End("the lower limit")));
    let found = integrate(&mut bounded, &number(0), &number(1), &goal);
    assert!(
        matches!(&found.hindrance, Some(Hindrance::Interval(a, b)) if *a < 0.1 && *b < 0.1),
        "{:?}",
        found.hindrance
    );
    // sin(1) − Ci(1).
    let due = Ball::exact(64, 0.504_067_061_906_928_4);
    let value = found.value.unwrap();
    assert!(
        value.overlaps(&due.widened(Mag::from_f64(1e-16))) && value.rad().to_f64() < 1e-2,
        "{value:?}"
    );
    assert!(found.evaluations < 21_000);
    // Not integrable, at an end and inside.
    let mut pole = Formula {
        f: |z: &ComplexBall, _, bits| c::div(&c::real(1, bits), z),
        growth: |x: &Germ| x.recip(),
    };
    let found = integrate(&mut pole, &number(0), &number(1), &goal);
    assert_eq!(found.hindrance, Some(Hindrance::End("the lower limit")));
    let found = integrate(&mut pole, &number(1), &Limit::PlusInfinity, &goal);
    assert_eq!(found.hindrance, Some(Hindrance::End("infinity")));
    let found = integrate(&mut pole, &number(-1), &number(2), &goal);
    assert!(found.value.is_none());
    assert!(matches!(&found.hindrance, Some(Hindrance::Interval(a, b)) if *a <= 0 && *b >= 0));
}
