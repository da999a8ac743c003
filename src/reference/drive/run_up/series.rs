//! Taylor coefficients of the speed along the path. Nothing here is proved; [`super::step`] bounds
//! what is wrong with them.
//!
//! With `p = u^w χ(u)` (w = 0 for a moving start, 1 for a start from rest) and `σ'(u) = σ_1 u^w`
//! the equation of motion times the motor's denominator D, divided by `u^w`, is
//!
//! ```text
//! J χ p_u D = (σ_1 M_o − ½ σ_1 S p²) D + σ_1 N
//! ```
//!
//! so the coefficients follow one after the other.

use crate::taylor_model::convolution;
use rug::Float;

/// The data of the recurrence: midpoints of the models' coefficients in u.
pub(super) struct Equation<'a> {
    /// I_n + I_1.
    pub inertia: &'a [Float],
    /// `σ_1` times the slope of I_n along the path.
    pub slope: &'a [Float],
    /// `σ_1 M_o` along the path.
    pub moment: &'a [Float],
    /// σ_1 times the motor's numerator.
    pub numerator: [Float; 2],
    /// The motor's denominator.
    pub denominator: Option<[Float; 3]>,
    pub bits: u32,
}

impl Equation<'_> {
    /// χ up to the power `order`: from the speed `start`, or from rest.
    ///
    /// `None` when the acceleration at rest is not positive or a division fails.
    pub(super) fn solve(&self, start: Option<&Float>, order: usize) -> Option<Vec<Float>> {
        let bits = self.bits;
        let rest = start.is_none();
        let zero = || Float::new(bits);
        let get = |v: &[Float], k: usize| v.get(k).cloned().unwrap_or_else(zero);
        let conv = |a: &[Float], b: &[Float], k: usize, from: usize, to: usize| {
            convolution(a, b, k, from, to, bits)
        };
        let mut chi: Vec<Float> = start.into_iter().cloned().collect();
        let mut p: Vec<Float> = Vec::with_capacity(order + 2);
        let (mut p2, mut x, mut d) = (Vec::new(), Vec::new(), Vec::<Float>::new());
        let (mut a, mut v) = (Vec::<Float>::new(), Vec::<Float>::new());
        for k in 0..=order {
            p.push(match (rest, k) {
                (false, _) => chi[k].clone(),
                (true, 0) => zero(),
                (true, _) => chi[k - 1].clone(),
            });
            p2.push(conv(&p, &p, k, 0, k));
            let half = conv(self.slope, &p2, k, 0, k) >> 1u32;
            x.push(get(self.moment, k) - half);
            let mut own = if k == 0 {
                self.numerator[0].clone()
            } else {
                zero()
            };
            own += &self.numerator[1] * &p[k];
            let r = match &self.denominator {
                None => x[k].clone() + own,
                Some([d0, d1, d2]) => {
                    let mut e = if k == 0 { d0.clone() } else { zero() };
                    e += d1 * &p[k];
                    e += d2 * &p2[k];
                    d.push(e);
                    conv(&x, &d, k, 0, k) + own
                }
            };
            // V = J χ D without the term of χ_k, if that is not known yet.
            let whole = |a: &[Float], d: &[Float], k: usize| match self.denominator {
                None => get(a, k),
                Some(_) => conv(a, d, k, 0, k),
            };
            if !rest {
                a.push(conv(self.inertia, &chi, k, 0, k));
                v.push(whole(&a, &d, k));
                let mut sum = r;
                for i in 1..=k {
                    let term = Float::with_val(bits, &chi[k + 1 - i] * (k + 1 - i) as u32);
                    sum -= &v[i] * &term;
                }
                sum /= Float::with_val(bits, &v[0] * (k as u32 + 1));
                chi.push(sum);
            } else if k == 0 {
                let jd = Float::with_val(
                    bits,
                    &self.inertia[0] * d.first().unwrap_or(&Float::with_val(bits, 1)),
                );
                let square = r / &jd;
                if !(square > 0) {
                    return None;
                }
                chi.push(square.sqrt());
                a.push(Float::with_val(bits, &self.inertia[0] * &chi[0]));
                v.push(jd * &chi[0]);
            } else {
                a.push(conv(self.inertia, &chi, k, 1, k));
                v.push(whole(&a, &d, k));
                let mut sum = r - Float::with_val(bits, &v[k] * &chi[0]);
                for i in 1..k {
                    let term = Float::with_val(bits, &chi[k - i] * (k - i + 1) as u32);
                    sum -= &v[i] * &term;
                }
                sum /= Float::with_val(bits, &v[0] * (k as u32 + 2));
                a[k] += &self.inertia[0] * &sum;
                let more = Float::with_val(bits, &v[0] / &chi[0]);
                v[k] += &more * &sum;
                chi.push(sum);
            }
        }
        chi.truncate(order + 1);
        chi.iter().all(Float::is_finite).then_some(chi)
    }
}

/// Coefficients of the reciprocal.
pub(super) fn reciprocal(f: &[Float], order: usize, bits: u32) -> Vec<Float> {
    let inverse = Float::with_val(bits, 1) / &f[0];
    let mut q = vec![inverse.clone()];
    for k in 1..=order {
        let sum = convolution(f, &q, k, 1, k, bits);
        q.push(-(sum * &inverse));
    }
    q
}
