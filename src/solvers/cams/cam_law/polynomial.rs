//! Laws that are any polynomial `s = Σ c_k x^k` with `s(0) = 0`, `s(1) = 1`.

use super::error::{CamLawError, finite};
use super::motion::{Motion, Peaks};
use crate::double_double::{Dd, two_sum};

const LARGEST_DEGREE: usize = 24;
const SUM_TOLERANCE: f64 = 1e-9;

/// The law in powers of `x` and its mirror image `1 − s` in powers of `1 − x`.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Polynomial {
    start: Vec<Dd>,
    end: Vec<Dd>,
    peaks: Peaks,
}

/// By Horner's rule in double-double.
fn value(c: &[Dd], x: f64) -> Dd {
    let sum = c.iter().rev();
    sum.fold(Dd::ZERO, |sum, &c| sum.mul_f(x) + c)
}

fn derivative(c: &[Dd]) -> Vec<Dd> {
    let terms = c.iter().enumerate().skip(1);
    terms.map(|(k, c)| c.mul_f(k as f64)).collect()
}

/// The coefficients of `p(1 − z)` in powers of `z`, by repeated synthetic division.
fn mirrored(c: &[Dd]) -> Vec<Dd> {
    let mut a = c.to_vec();
    for i in 0..a.len() {
        for j in (i..a.len() - 1).rev() {
            a[j] = a[j] + a[j + 1];
        }
    }
    let sign = |k: usize, c: Dd| if k % 2 == 1 { -c } else { c };
    a.into_iter().enumerate().map(|(k, c)| sign(k, c)).collect()
}

/// The places in (0, 1) where `p` changes sign: one in each interval between the places where its
/// derivative does, at most.
fn sign_changes(p: &[Dd]) -> Vec<f64> {
    if p.len() < 2 {
        return Vec::new();
    }
    let mut ends = vec![0.0];
    ends.extend(sign_changes(&derivative(p)));
    ends.push(1.0);
    let positive = |x: f64| value(p, x).hi > 0.0;
    let mut found = Vec::new();
    for pair in ends.windows(2) {
        let (mut lo, mut hi) = (pair[0], pair[1]);
        let left = positive(lo);
        if left == positive(hi) {
            continue;
        }
        loop {
            let mid = 0.5 * (lo + hi);
            if mid <= lo || mid >= hi {
                break;
            }
            *(if positive(mid) == left {
                &mut lo
            } else {
                &mut hi
            }) = mid;
        }
        found.push(hi);
    }
    found
}

/// The largest and the smallest value of `p` on [0, 1].
fn extremes(p: &[Dd]) -> (f64, f64) {
    let places = sign_changes(&derivative(p));
    let all = places.into_iter().chain([0.0, 1.0]);
    let values = all.map(|x| value(p, x).value());
    values.fold((f64::NEG_INFINITY, f64::INFINITY), |(hi, lo), v| {
        (hi.max(v), lo.min(v))
    })
}

impl Polynomial {
    /// `coefficients[k]` belongs to `x^k`.
    pub(super) fn new(coefficients: &[f64]) -> Result<Polynomial, CamLawError> {
        let mut sum = Dd::ZERO;
        for &c in coefficients {
            sum = sum.add_f(finite("coefficient", c)?);
        }
        let used = coefficients.iter().rposition(|&c| c != 0.0);
        let degree = used.unwrap_or(0);
        if let Some(&value) = coefficients.first().filter(|c| **c != 0.0) {
            return Err(CamLawError::PolynomialStart { value });
        }
        if !(1..=LARGEST_DEGREE).contains(&degree) {
            return Err(CamLawError::PolynomialDegree { degree });
        }
        if !((sum.value() - 1.0).abs() <= SUM_TOLERANCE) {
            return Err(CamLawError::PolynomialEnd { sum: sum.value() });
        }
        let start: Vec<Dd> = coefficients[..=degree]
            .iter()
            .map(|&c| Dd::from(c).div(sum))
            .collect();
        let mut end: Vec<Dd> = mirrored(&start).into_iter().map(|c| -c).collect();
        // 1 − s(1) = 0.
        end[0] = Dd::ZERO;
        let first = derivative(&start);
        let second = derivative(&first);
        let (fastest, slowest) = extremes(&first);
        let (acceleration, deceleration) = extremes(&second);
        let (jerk, least) = extremes(&derivative(&second));
        let peaks = Peaks {
            velocity: fastest.max(-slowest),
            acceleration: acceleration.max(0.0),
            deceleration: (-deceleration).max(0.0),
            jerk: jerk.max(-least),
        };
        let peaks = match (start[1].hi != 0.0 || end[1].hi != 0.0, degree) {
            // A velocity that jumps.
            (true, _) => Peaks {
                acceleration: f64::INFINITY,
                jerk: f64::INFINITY,
                ..peaks
            },
            (false, _) if start[2].hi != 0.0 || end[2].hi != 0.0 => Peaks {
                jerk: f64::INFINITY,
                ..peaks
            },
            _ => peaks,
        };
        Ok(Polynomial { start, end, peaks })
    }

    pub(super) fn peaks(&self) -> Peaks {
        self.peaks
    }

    /// The law, and `1 − s`.
    pub(super) fn motion(&self, x: f64) -> (Motion, f64) {
        let near_start = x <= 0.5;
        let (c, at) = match near_start {
            true => (&self.start, x),
            false => (&self.end, 1.0 - x),
        };
        let first = derivative(c);
        let second = derivative(&first);
        let third = derivative(&second);
        let [s, v, a, j] = [c, &first, &second, &third].map(|c| value(c, at));
        let other = {
            let t = two_sum(1.0, -s.hi);
            t.add_f(-s.lo).value()
        };
        let motion = Motion {
            displacement: s.value(),
            velocity: v.value(),
            acceleration: a.value(),
            jerk: j.value(),
        };
        match near_start {
            true => (motion, other),
            false => {
                let remaining = motion.displacement;
                let mirrored = Motion {
                    displacement: other,
                    acceleration: -motion.acceleration,
                    ..motion
                };
                (mirrored, remaining)
            }
        }
    }

    /// Derivatives of orders 1, 2, … at the start and at the end of the stroke.
    pub(crate) fn at_ends(&self) -> [Vec<f64>; 2] {
        let mut factorial = 1.0;
        let mut ends = [Vec::new(), Vec::new()];
        for k in 1..self.start.len() {
            factorial *= k as f64;
            let sign = if k % 2 == 0 { -factorial } else { factorial };
            ends[0].push(self.start[k].mul_f(factorial).value());
            ends[1].push(self.end[k].mul_f(sign).value());
        }
        ends
    }

    /// The derivative of an order, in powers of `x`.
    pub(crate) fn derivative(&self, order: usize) -> Vec<f64> {
        let c = (0..order).fold(self.start.clone(), |c, _| derivative(&c));
        c.into_iter().map(Dd::value).collect()
    }

    /// `∫ s dx` over the stroke.
    pub(crate) fn mean(&self) -> Dd {
        let terms = self.start.iter().enumerate();
        terms.fold(Dd::ZERO, |sum, (k, &c)| {
            sum + c.div(Dd::from((k + 1) as f64))
        })
    }
}
