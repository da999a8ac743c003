//! Special values: NaN, infinities, the edges of the range.

use crate::accuracy::{evaluate, reference};
use crate::code::Code;
use crate::errors::{Outcome, compare};
use num_complex::Complex64;
use serde::Serialize;

const NAN: f64 = f64::NAN;
const INF: f64 = f64::INFINITY;
const TINY: f64 = 5e-324;

/// The right answer at a point.
#[derive(Clone, Copy, Debug)]
enum Right {
    /// The finite point's value by the reference.
    Reference,
    /// This limit; a zero of either sign, a NaN of any.
    Limit(f64, f64),
    /// The modulus grows without bound and the argument turns for ever: NaN in both parts, or an
    /// infinite part.
    Turning,
}

const POINTS: [(f64, f64, Right); 35] = {
    use Right::{Limit, Reference, Turning};
    [
        (0.0, 0.0, Reference),
        (-0.0, -0.0, Reference),
        (TINY, TINY, Reference),
        (TINY, -TINY, Reference),
        (NAN, NAN, Limit(NAN, NAN)),
        (NAN, 0.0, Limit(NAN, NAN)),
        (NAN, 1.0, Limit(NAN, NAN)),
        (1.0, NAN, Limit(NAN, NAN)),
        // Real on the imaginary axis whatever the imaginary part is.
        (0.0, NAN, Limit(NAN, 0.0)),
        (INF, 0.0, Limit(0.0, 0.0)),
        (-INF, 0.0, Limit(0.0, 0.0)),
        (INF, 1.0, Limit(0.0, 0.0)),
        (-INF, 1.0, Limit(0.0, 0.0)),
        (INF, -1.0, Limit(0.0, 0.0)),
        (-INF, -1.0, Limit(0.0, 0.0)),
        (0.0, INF, Limit(0.0, 0.0)),
        (1.0, INF, Limit(0.0, 0.0)),
        (INF, INF, Limit(0.0, 0.0)),
        (0.0, -INF, Limit(INF, 0.0)),
        (1.0, -INF, Turning),
        // No limit: 0, finite or infinite modulus, depending on the way.
        (INF, -INF, Limit(NAN, NAN)),
        (1e9, 1e-3, Reference),
        (1e-3, 1e9, Reference),
        (1e160, 1e160, Reference),
        (1e160, -1e160, Reference),
        (1e308, 1e308, Reference),
        (1e308, -1e308, Reference),
        (1e308, 1e-308, Reference),
        (1e308, -1.0, Reference),
        (0.0, -26.6286, Reference),
        (0.5, -26.62, Reference),
        (1e-3, -26.628, Reference),
        (1e-300, -26.6, Reference),
        (0.5, -26.7, Reference),
        (27.0, -37.8, Reference),
    ]
};

/// One code at one point.
#[derive(Clone, Debug, Serialize)]
pub struct Answer {
    /// The code.
    pub code: String,
    /// The value it gives.
    pub value: String,
    /// True if that is of the right kind.
    pub right_kind: bool,
    /// The larger of the errors of the parts, in ulps; where both are finite.
    pub ulps: Option<f64>,
}

/// One point.
#[derive(Clone, Debug, Serialize)]
pub struct SpecialValue {
    /// The point.
    pub z: String,
    /// The right answer.
    pub right: String,
    /// One entry for each code.
    pub answers: Vec<Answer>,
}

fn number(x: f64) -> String {
    if x == 0.0 {
        return if x.is_sign_negative() { "-0" } else { "0" }.into();
    }
    if x.is_nan() || x.is_infinite() || (1e-4..1e6).contains(&x.abs()) {
        return format!("{x}");
    }
    format!("{x:e}")
}

fn short(x: f64) -> String {
    if x == 0.0 || !x.is_finite() {
        return number(x);
    }
    if (1e-3..1e5).contains(&x.abs()) {
        format!("{x:.6}")
    } else {
        format!("{x:.5e}")
    }
}

fn complex(z: Complex64, part: fn(f64) -> String) -> String {
    let im = part(z.im);
    let (sign, im) = match im.strip_prefix('-') {
        Some(im) => ('-', im),
        None => ('+', im.as_str()),
    };
    let space = if z.im.is_finite() { "" } else { " " };
    format!("{} {sign} {im}{space}i", part(z.re))
}

/// Asks every code at every point; one that takes slices gets all points in one.
pub fn table(codes: &[&dyn Code]) -> Vec<SpecialValue> {
    let z = POINTS.map(|(x, y, _)| Complex64::new(x, y));
    let all: Vec<_> = codes
        .iter()
        .map(|code| {
            let mut got = z.map(|_| Complex64::ZERO);
            let panicked = evaluate(*code, &z, &mut got);
            (got, panicked)
        })
        .collect();
    POINTS
        .iter()
        .enumerate()
        .map(|(i, &(x, y, right))| {
            let z = Complex64::new(x, y);
            let ball = match right {
                Right::Reference => reference(z),
                _ => None,
            };
            let truth = match (right, &ball) {
                (Right::Limit(re, im), _) => complex(Complex64::new(re, im), short),
                (Right::Turning, _) => "infinite modulus, no direction".into(),
                (Right::Reference, None) => "undecided".into(),
                (Right::Reference, Some(b)) => {
                    let rounded = Complex64::new(b.re.mid().to_f64(), b.im.mid().to_f64());
                    complex(rounded, short)
                }
            };
            let answer =
                |(code, (got, panics)): (&&dyn Code, &([Complex64; POINTS.len()], Vec<usize>))| {
                    let got = got[i];
                    let panicked = panics.contains(&i);
                    let (right_kind, ulps) = match (right, &ball) {
                        _ if panicked => (false, None),
                        (Right::Limit(re, im), _) => (alike(got.re, re) && alike(got.im, im), None),
                        (Right::Turning, _) => (turning(got), None),
                        (Right::Reference, None) => (false, None),
                        (Right::Reference, Some(b)) => match compare(got, b) {
                            Outcome::Finite(e) => (true, Some(e.ulps[0].max(e.ulps[1]))),
                            Outcome::Infinite => (true, None),
                            Outcome::WrongKind | Outcome::Undecided => (false, None),
                        },
                    };
                    Answer {
                        code: code.name().to_owned(),
                        value: if panicked {
                            "panic".into()
                        } else {
                            complex(got, short)
                        },
                        right_kind,
                        ulps,
                    }
                };
            SpecialValue {
                z: complex(z, number),
                right: truth,
                answers: codes.iter().zip(&all).map(answer).collect(),
            }
        })
        .collect()
}

fn alike(got: f64, due: f64) -> bool {
    got == due || (got.is_nan() && due.is_nan())
}

fn turning(got: Complex64) -> bool {
    (got.re.is_nan() && got.im.is_nan()) || got.re.is_infinite() || got.im.is_infinite()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::code::Scalar;

    #[test]
    fn the_reference_decides_every_finite_point() {
        let zero = Scalar {
            name: "zero".into(),
            version: String::new(),
            own: false,
            w: |_| Complex64::ZERO,
        };
        for value in table(&[&zero]) {
            assert_ne!(value.right, "undecided", "{}", value.z);
        }
    }

    #[test]
    fn kinds_of_limits() {
        assert!(alike(-0.0, 0.0) && alike(-NAN, NAN) && !alike(NAN, 0.0) && !alike(-INF, INF));
        assert!(turning(Complex64::new(NAN, NAN)) && turning(Complex64::new(INF, NAN)));
        assert!(!turning(Complex64::new(NAN, 0.0)) && !turning(Complex64::ZERO));
    }
}
