//! Integrals to 30 digits against values of mpmath (`reference/independent/quadrature.csv`).

use super::*;

const WITNESS: &str = include_str!("../../../../reference/independent/quadrature.csv");

fn witness() -> Vec<(String, String)> {
    let row = |line: &str| {
        let (name, value) = line.rsplit_once(',').expect("two columns");
        (name.trim_matches('"').to_owned(), value.to_owned())
    };
    WITNESS.lines().skip(1).map(row).collect()
}

fn number_germ(n: i64) -> Germ {
    Germ::constant(&Ball::integer(64, n), 2)
}

fn tenths(n: i64, bits: u32) -> ComplexBall {
    ComplexBall::new(
        Ball::rational(bits, &(n, 10).into()),
        Ball::integer(bits, 0),
    )
}

fn scaled(z: &ComplexBall, n: i64) -> ComplexBall {
    z.scaled(&Ball::integer(64, n))
}

fn floor(z: &ComplexBall, holomorphic: bool) -> Option<ComplexBall> {
    let bits = z.re.prec();
    let [low, high] = [z.re.lower().floor(), z.re.upper().floor()];
    let at_jump = low != high || z.re.contains(&low.to_rational()?);
    if holomorphic && at_jump {
        return None;
    }
    let value = if low == high {
        Ball::new(low, Mag::ZERO)
    } else {
        Ball::between(bits, &low, &high)
    };
    Some(ComplexBall::new(value, Ball::integer(bits, 0)))
}

fn abs(z: &ComplexBall, holomorphic: bool) -> Option<ComplexBall> {
    match () {
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
    }
}

fn cosine(z: &ComplexBall) -> ComplexBall {
    let quarter = Ball::pi(z.re.prec()).shift(-1);
    c::sine(&(z + &ComplexBall::new(quarter, Ball::integer(64, 0))))
}

/// The integrand of a row, and its behaviour at ends.
fn enclosed(name: &str, z: &ComplexBall, holomorphic: bool, bits: u32) -> Option<ComplexBall> {
    let one = c::real(1, bits);
    let square = || z * z;
    match name {
        "sin(x)" => Some(c::sine(z)),
        "4/(1+x^2)" => c::div(&c::real(4, bits), &(&one + &square())),
        "1/(1+x^2)" => c::div(&one, &(&one + &square())),
        "4 sqrt(1-x^2)" => Some(scaled(&c::sqrt(&(&one - &square()))?, 4)),
        "sin(x+exp(x))" => Some(c::sine(&(z + &c::exp(z)))),
        "|x^4+10x^3+19x^2-6x-6| exp(x)" => {
            let mut p = c::real(1, bits);
            for n in [10, 19, -6, -6] {
                p = &(&p * z) + &c::real(n, bits);
            }
            Some(&abs(&p, holomorphic)? * &c::exp(z))
        }
        "exp(-x^2)" => Some(c::exp(&-&square())),
        "exp(-x^2+x)" => Some(c::exp(&(&(&one - z) * z))),
        "sech(x)" => c::sech(z),
        "x exp(-x)/(1+exp(-x))" => {
            let e = c::exp(&-z);
            c::div(&(z * &e), &(&one + &e))
        }
        "log(x)/x^3" => c::div(&c::ln(z)?, &(z * &square())),
        "log(x)" => c::ln(z),
        "1/sqrt(x)" => c::div(&one, &c::sqrt(z)?),
        "sqrt(x) log(x)" => Some(&c::sqrt(z)? * &c::ln(z)?),
        "-log(x)/(1+x)" => c::div(&-&c::ln(z)?, &(&one + z)),
        "exp(-x)/sqrt(x)" => c::div(&c::exp(&-z), &c::sqrt(z)?),
        "x^x" => Some(c::exp(&(z * &c::ln(z)?))),
        "max(sin(x),cos(x))" => {
            let (s, t) = (c::sine(z), cosine(z));
            let gap = abs(&(&s - &t), holomorphic)?;
            Some((&(&s + &t) + &gap).scaled(&Ball::exact(64, 0.5)))
        }
        "x sin(x)/(1+cos(x)^2)" => {
            let t = cosine(z);
            c::div(&(z * &c::sine(z)), &(&one + &(&t * &t)))
        }
        "(exp(x)-floor(exp(x))) sin(x+exp(x))" => {
            let e = c::exp(z);
            Some(&(&e - &floor(&e, holomorphic)?) * &c::sine(&(z + &e)))
        }
        "sech(10(x-0.2))^2+sech(100(x-0.4))^4+sech(1000(x-0.6))^6" => {
            let mut sum = c::real(0, bits);
            for (factor, at, power) in [(10, 2, 2), (100, 4, 4), (1000, 6, 6)] {
                let off = z - &tenths(at, bits.max(z.re.prec()));
                let sech = c::sech(&scaled(&off, factor))?;
                sum = &sum + &(0..power).fold(one.clone(), |p, _| &p * &sech);
            }
            Some(sum)
        }
        _ => panic!("no such integrand: {name}"),
    }
}

fn behaviour(name: &str, x: &Germ) -> Option<Germ> {
    let one = number_germ(1);
    match name {
        "1/(1+x^2)" => one.add(&x.mul(x)?)?.recip(),
        "4 sqrt(1-x^2)" => one.sub(&x.mul(x)?)?.sqrt()?.mul(&number_germ(4)),
        "exp(-x^2)" => x.mul(x)?.neg().exp(),
        "exp(-x^2+x)" => x.sub(&x.mul(x)?)?.exp(),
        "sech(x)" => number_germ(2).div(&x.exp()?.add(&x.neg().exp()?)?),
        "x exp(-x)/(1+exp(-x))" => {
            let e = x.neg().exp()?;
            x.mul(&e)?.div(&one.add(&e)?)
        }
        "log(x)/x^3" => x.ln()?.div(&x.powi(3)?),
        "log(x)" => x.ln(),
        "1/sqrt(x)" => x.sqrt()?.recip(),
        "sqrt(x) log(x)" => x.sqrt()?.mul(&x.ln()?),
        "-log(x)/(1+x)" => x.ln()?.div(&x.add(&one)?),
        "exp(-x)/sqrt(x)" => x.neg().exp()?.div(&x.sqrt()?),
        "x^x" => x.mul(&x.ln()?)?.exp(),
        _ => None,
    }
}

fn limit(text: &str) -> Limit {
    match text {
        "inf" => Limit::PlusInfinity,
        "-inf" => Limit::MinusInfinity,
        "pi" => Limit::Finite(Ball::pi(256)),
        n => number(n.parse().expect("a whole number")),
    }
}

#[test]
fn thirty_digits_agree_with_mpmath() {
    let rows = witness();
    assert!(rows.len() > 20);
    for (row, value) in &rows {
        let (name, range) = row.split_once(" from ").unwrap();
        let (from, to) = range.split_once(" to ").unwrap();
        let mut f = Formula {
            f: |z: &ComplexBall, holomorphic, bits| enclosed(name, z, holomorphic, bits),
            growth: |x: &Germ| behaviour(name, x),
        };
        let found = integrate(&mut f, &limit(from), &limit(to), &Goal::digits(30));
        // 40 digits, of which the last is rounded.
        let digits = Float::with_val(200, Float::parse(value).unwrap());
        let off = Mag::above(&digits).mul(Mag::power_of_two(-128));
        reached(&found, &Ball::new(digits, off), 30, row);
    }
}
