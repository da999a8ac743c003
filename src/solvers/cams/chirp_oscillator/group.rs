//! One harmonic at four times side by side.

use super::harmonic::{Prepared, SHORT};
use super::inlined::two;
use super::roots::Roots;
use super::series::{FAR, Z, terms};
use crate::double_double::Dd;
use crate::exponential::{reduce, sin_cos_reduced, turn};
use crate::lanes::Lanes;
use crate::real::Real;
use num_complex::Complex;

type C = Complex<f64>;

/// Times taken together.
pub(super) const CHUNK: usize = 512;

/// A harmonic made ready for groups of times.
pub(super) struct Groups<'a> {
    pub harmonic: &'a Prepared,
    pub roots: &'a Roots,
    /// The state of the free vibration that it leaves.
    start: [f64; 2],
    /// Holds what the passage of either resonance adds to it.
    passed: [[f64; 2]; 2],
    /// Tells whether the passages are constants.
    pub folded: bool,
    /// The passages are behind from here on; a little early where both roots pass as one.
    edge: [f64; 2],
    /// From `|p|²` to `|z|²`.
    to_distance: f64,
}

/// The numbers of four times.
pub(super) struct Group<R: Real> {
    pub carrier: Z<R>,
    pub omega: R,
    pub p: [Z<R>; 2],
    /// `|p|²`
    pub sizes: [R; 2],
    /// Tells whether either resonance is behind.
    pub passed: [R::Mask; 2],
    /// The nearer `|z|²`.
    pub distances: [f64; 4],
    /// Terms of the series.
    pub terms: usize,
    /// Tells whether the values of the series for both roots are told apart.
    pub apart: bool,
    /// Tells whether at all four times the closed form serves, both resonances are far, and the
    /// state left behind is a constant.
    pub clear: bool,
}

#[inline(always)]
fn like<R: Real>(t: R, x: Dd) -> Dd<R> {
    Dd::new(t.like(x.hi), t.like(x.lo))
}

impl<'a> Groups<'a> {
    pub fn new(harmonic: &'a Prepared, roots: &'a Roots) -> Groups<'a> {
        let by = harmonic.scale;
        let state = |[a, b]: [C; 2]| [a.re * by, b.re * by];
        let zero = [[0.0; 2]; 2];
        let kappa = harmonic.sweep.kappa.hi;
        Groups {
            harmonic,
            roots,
            start: state(harmonic.start),
            passed: harmonic.left.map_or(zero, |left| left.map(state)),
            folded: harmonic.left.is_some(),
            edge: two(|r| match harmonic.sweep.joint {
                true => roots.n - roots.half.hi.abs(),
                false => -roots.lambda[r].re,
            }),
            // Finite, so that a distance of zero stays zero.
            to_distance: if kappa == 0.0 { f64::MAX } else { 0.5 / kappa },
        }
    }

    #[inline(always)]
    pub fn at<L: Lanes>(&self, lanes: L, four: [f64; 4]) -> Group<L::Quad> {
        let Groups {
            harmonic, roots, ..
        } = *self;
        let t = lanes.quad(four);
        let sweep = &harmonic.sweep;
        let (nu, kappa) = (like(t, sweep.nu), like(t, sweep.kappa));
        let omega = nu + kappa.mul_f(t);
        let turned = (nu + kappa.mul_f(t * t.like(0.5))).mul_f(t);
        let (rest, quadrant) = reduce(turned.add_f(t.like(sweep.delta)));
        let (sin, cos) = sin_cos_reduced(rest);
        let (sin, cos) = turn(sin, cos, quadrant);
        let p = two(
            #[inline(always)]
            |i| {
                let x = (omega + like(t, roots.beta[i])).value();
                Z(t.like(roots.lambda[i].re), x)
            },
        );
        let sizes = two(
            #[inline(always)]
            |i| p[i].0.fma(p[i].0, p[i].1 * p[i].1),
        );
        let passed = two(
            #[inline(always)]
            |r| t.like(self.edge[r]).below(p[r].1),
        );
        let nearer = sizes[0].at_most(sizes[1]);
        let distance = nearer * t.like(self.to_distance);
        let [m, n] = two(
            #[inline(always)]
            |i| sizes[i].at_least(t.like(harmonic.norms[i])) * t * t,
        );
        // Above one where everything is clear.
        let clear = m.at_most(n) * t.like(1.0 / (SHORT * SHORT));
        let mut clear = clear.at_most(distance * t.like(1.0 / FAR));
        if !self.folded {
            clear = clear.pick(t.or(passed[0], passed[1]), t.like(0.0), clear);
        }
        let distances = lanes.array(distance);
        let least = distances.into_iter().fold(f64::INFINITY, f64::min);
        Group {
            carrier: Z(cos.value(), -sin.value()),
            omega: omega.value(),
            p,
            sizes,
            passed,
            distances,
            terms: terms(least.max(FAR)),
            apart: t.all(sweep.apart_far(roots, nearer)),
            clear: t.all(t.like(1.0).below(clear)),
        }
    }

    /// The state of the free vibration that is left, component `i`.
    #[inline(always)]
    pub fn left<R: Real>(&self, group: &Group<R>, i: usize) -> R {
        let t = group.omega;
        let [a, b] = two(
            #[inline(always)]
            |r| t.pick(group.passed[r], t.like(self.passed[r][i]), t.like(0.0)),
        );
        t.like(self.start[i]) + (a + b)
    }

    /// The same at a single time, from `Im p`.
    #[inline(always)]
    pub fn left_at(&self, x: [f64; 2]) -> [f64; 2] {
        let mut state = self.start;
        for r in [0, 1] {
            if self.has_passed(x[r], r) {
                state[0] += self.passed[r][0];
                state[1] += self.passed[r][1];
            }
        }
        state
    }

    /// Returns whether a resonance is behind, from `Im p`.
    #[inline(always)]
    pub fn has_passed(&self, x: f64, r: usize) -> bool {
        x > self.edge[r]
    }
}

/// The four times from `start` on, the last one repeated.
#[inline(always)]
pub(super) fn four(t: &[f64], start: usize) -> [f64; 4] {
    let last = t[t.len() - 1];
    let mut four = [last; 4];
    let count = (t.len() - start).min(4);
    four[..count].copy_from_slice(&t[start..start + count]);
    four
}

/// Adds to the four sums from `start` on.
#[inline(always)]
pub(super) fn add<L: Lanes>(lanes: L, sums: &mut [f64; CHUNK], start: usize, x: L::Quad) {
    let sums: &mut [f64] = &mut sums[start..start + 4];
    let old = lanes.quad([sums[0], sums[1], sums[2], sums[3]]);
    sums.copy_from_slice(&lanes.array(old + x));
}

#[cfg(test)]
mod tests;
