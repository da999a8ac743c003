//! Points next to zeros of W and to the curves on which a component of W is zero.
//!
//! They are found with the reference, so that a case stays what it is when the solver changes.

use crate::audit::Draw;
use crate::methods::special::complex::{C, exponential};
use crate::reference::faddeeva::{w_ball, w_f64, zero as certified};
use crate::reference::{Ball, ComplexBall};
use std::f64::consts::{FRAC_2_SQRT_PI, PI};
use std::sync::OnceLock;

/// Zeros kept.
const ZEROS: usize = 400;

/// Bits of a zero that is rounded to `f64`.
pub(in crate::methods::special) const BITS_OF_ZEROS: u32 = 60;
/// Bits of a value that a zero is looked for from.
pub(in crate::methods::special) const FEW_BITS: u32 = 30;

/// The `f64` next to the k-th zero with positive real part, k = 1 … 400.
pub(in crate::methods::special) fn zero(k: usize) -> [f64; 2] {
    static ALL: [OnceLock<[f64; 2]>; ZEROS] = [const { OnceLock::new() }; ZEROS];
    *ALL[(k - 1) % ZEROS].get_or_init(|| match certified(k as u32, BITS_OF_ZEROS) {
        Ok(z) => [z.re.to_f64(), z.im.to_f64()],
        // An argument that the audit shows as not finite.
        Err(_) => [f64::NAN; 2],
    })
}

/// A component.
#[derive(Clone, Copy, PartialEq)]
pub(in crate::methods::special) enum Part {
    Re,
    Im,
}

/// The direction of a line in the plane.
#[derive(Clone, Copy)]
pub(in crate::methods::special) enum Along {
    Re,
    Im,
}

/// A line parallel to an axis on which a component of an analytic function is looked at.
#[derive(Clone, Copy)]
pub(in crate::methods::special) struct Line {
    pub part: Part,
    pub along: Along,
    /// Where the search begins.
    pub z: C,
    /// The longest step: over it a component turns by a quarter or less.
    pub most: f64,
}

impl Line {
    /// The coordinate along the line.
    fn begin(self) -> f64 {
        match self.along {
            Along::Re => self.z.re,
            Along::Im => self.z.im,
        }
    }

    /// From `t` to where the component would be zero if f, of that value and derivative at `t`,
    /// went on as an exponential function.
    fn step(self, t: f64, f: impl Fn(C) -> Option<[C; 2]>) -> Option<f64> {
        let (z, turned) = match self.along {
            Along::Re => (C::new(t, self.z.im), C::new(1.0, 0.0)),
            Along::Im => (C::new(self.z.re, t), C::i()),
        };
        let [value, slope] = f(z)?;
        // From where the argument of f is to where the component is zero.
        let turn = match self.part {
            Part::Re => libm::atan(value.re / value.im),
            Part::Im => -libm::atan(value.im / value.re),
        };
        let step = turn / (slope * turned / value).im;
        (!step.is_nan()).then_some(step)
    }

    /// A point beside the one where the component is zero. `f` gives value and derivative, the
    /// derivative to a few digits; `rough` the same without a proof and at a fraction of the time:
    /// it says where to begin, and that is all of it where the point is to lie farther off. Nothing
    /// where eight steps do not get there, or get to an axis.
    pub fn beside(
        self,
        beside: Beside,
        rough: impl Fn(C) -> Option<[C; 2]>,
        f: impl Fn(C) -> Option<[C; 2]>,
    ) -> Option<f64> {
        let near = self.steps(self.begin(), rough, |step, _| step <= 1e-6 * self.most)?;
        let zero = match beside.is_close() {
            true => self.zero_from(near, f)?,
            false => self.off_axis(near)?,
        };
        Some(beside.of(zero))
    }

    /// Where the component is zero, from `t` near it. A step whose square over `most` is less than
    /// a place of `f64` is the last.
    fn zero_from(self, t: f64, f: impl Fn(C) -> Option<[C; 2]>) -> Option<f64> {
        let place = f64::EPSILON / 16.0 * self.most;
        self.off_axis(self.steps(t, f, |step, t| step * step <= place * t.abs())?)
    }

    /// `t`, unless it is on an axis, where a component is zero by symmetry.
    fn off_axis(self, t: f64) -> Option<f64> {
        (t.abs() > self.most / 4.0).then_some(t)
    }

    /// Steps from `t` until one of that size, to that place, is the last.
    fn steps(
        self,
        mut t: f64,
        f: impl Fn(C) -> Option<[C; 2]>,
        last: impl Fn(f64, f64) -> bool,
    ) -> Option<f64> {
        for _ in 0..8 {
            let step = self.step(t, &f)?;
            t += step.clamp(-self.most, self.most);
            if last(step.abs(), t) {
                return Some(t);
            }
        }
        None
    }
}

/// W with a proof of its norm and its derivative −2zW + 2i/√π (DLMF 7.10.2), roughly.
fn w_and_slope(z: C) -> Option<[C; 2]> {
    /// As many as the quick evaluation has.
    const BITS: u32 = 80;
    let exact = |x: f64| x.is_finite().then(|| Ball::exact(BITS, x));
    let w = w_ball(&ComplexBall::new(exact(z.re)?, exact(z.im)?), BITS);
    Some(with_slope(z, C::new(w.re.to_f64(), w.im.to_f64())))
}

/// [`w_and_slope`] with proved components: beside the real axis Re W is far below the norm. More
/// bits would cost a second evaluation.
fn parts_and_slope(z: C) -> Option<[C; 2]> {
    let w = w_f64(z.re, z.im, FEW_BITS).ok()?;
    Some(with_slope(z, C::new(w.re.to_f64(), w.im.to_f64())))
}

fn with_slope(z: C, w: C) -> [C; 2] {
    [w, C::new(0.0, FRAC_2_SQRT_PI) - 2.0 * z * w]
}

/// W to some twelve digits of its norm, alike on every machine, or not finite: the midpoint rule in
/// steps of 1/2 for `w(z) = (iz/π) ∫ e^{−t²}/(z² − t²) dt` with the residue where the pole is near
/// (Chiarella & Reichel 1968).
pub(in crate::methods::special) fn w_roughly(z: C) -> C {
    const STEP: f64 = 0.5;
    if z.im < 0.0 {
        return 2.0 * exponential(-z * z) - w_roughly(-z);
    }
    let square = z * z;
    let terms = (0..12).map(|k| {
        let t = (f64::from(k) + 0.5) * STEP;
        libm::exp(-t * t) / (square - t * t)
    });
    let sum = C::new(0.0, 2.0 * STEP / PI) * z * terms.sum::<C>();
    match z.im < PI / STEP {
        true => {
            sum + 2.0 * exponential(-square)
                / (1.0 + exponential(z * C::new(0.0, -2.0 * PI / STEP)))
        }
        false => sum,
    }
}

/// How a number is moved: by up to three of its last places, so that the `f64` next to a crossing
/// is among them, or relative to itself.
#[derive(Clone, Copy)]
pub(in crate::methods::special) enum Beside {
    /// Three places down and as many up.
    Places(usize),
    Shift(f64),
}

impl Beside {
    /// A shift by a relative 1e-15 to `most` one time in two.
    pub fn draw(d: &mut Draw, most: f64) -> Beside {
        if d.chance(0.5) {
            return Beside::Places(d.integer(0, 6));
        }
        let shift = d.log_uniform(1e-15, most);
        Beside::Shift(d.signed(shift))
    }

    /// The number so moved.
    pub fn of(self, x: f64) -> f64 {
        match self {
            Beside::Places(up) => {
                let down = x.next_down().next_down().next_down();
                (0..up).fold(down, |x, _| x.next_up())
            }
            Beside::Shift(shift) => x + x * shift,
        }
    }

    /// Returns whether it is moved by less than what [`w_roughly`] may be off.
    fn is_close(self) -> bool {
        match self {
            Beside::Places(_) => true,
            Beside::Shift(shift) => shift.abs() < 1e-9,
        }
    }
}

/// A point of the lower half-plane next to a curve on which the component is zero; where none is
/// found, the point that it was looked for from.
pub(in crate::methods::special) fn beside_curve(d: &mut Draw, part: Part) -> Vec<f64> {
    let far = d.chance(0.25);
    let b = match far {
        true => d.log_uniform(20.0, 1e6),
        false => d.uniform(0.3, 20.0),
    };
    let a = match far {
        true => b + d.uniform(-300.0, 20.0) / (2.0 * b),
        false => d.uniform(0.0, b + 0.5),
    };
    // Where 2e^{-z^2} leads, a component turns like cos 2ab.
    let turn = PI / (4.0 * b);
    let line = Line {
        part,
        along: Along::Re,
        z: C::new(a, -b),
        most: turn,
    };
    let rough = |z| Some(with_slope(z, w_roughly(z)));
    let beside = Beside::draw(d, 1e-2);
    let x = line.beside(beside, rough, w_and_slope).unwrap_or(a);
    vec![d.signed(x), -b]
}

/// A point just below the real axis, next to the curve on which Re W = 0.
pub(in crate::methods::special) fn beside_flat_curve(d: &mut Draw) -> Vec<f64> {
    let x = d.uniform(2.3, 26.5);
    let y = match x < 6.5 {
        true => flat_zero(x),
        false => flat_zero_far_out(x),
    };
    let y = Beside::draw(d, 1e-1).of(y);
    vec![d.signed(x), -y]
}

/// `−y` where `Re W(x + iy) = 0`, by Newton's method.
fn flat_zero(x: f64) -> f64 {
    // Where the tangent of Re W at y = 0 is zero.
    let slope = FRAC_2_SQRT_PI - 2.0 * x * w_roughly(C::new(x, 0.0)).im;
    let guess = -libm::exp(-x * x) / slope;
    let line = Line {
        part: Part::Re,
        along: Along::Im,
        z: C::new(x, -0.0),
        most: guess,
    };
    let zero = line.zero_from(line.begin(), parts_and_slope);
    zero.map_or(guess, |y| -y)
}

/// [`flat_zero`] to a few places for x ≥ 6.5, where Re W is `e^{−x²} + y Im W′(x)` to 2⁻⁵³, by the
/// asymptotic series `−Im W′(x) = (2/√π) Σ (2n − 1)!!/(2x²)ⁿ`, n ≥ 1 (DLMF 7.12.1), whose terms
/// fall down to `e^{−x²}`.
fn flat_zero_far_out(x: f64) -> f64 {
    let square = x * x;
    let gaussian = libm::exp(-square) * (1.0 - x.mul_add(x, -square));
    let series = (1..42).rev();
    let series = series.fold(1.0, |sum, n| sum * (f64::from(n) + 0.5) / square + 1.0);
    PI.sqrt() * square * gaussian / series
}

#[cfg(test)]
mod tests;
