//! The closed form by the Faddeeva function w.
//!
//! For `κ > 0` (otherwise all of `k`, δ change sign and `A` is conjugated) and a root λ
//!
//! ```text
//! E(λ) = ∫_0^t e^{(λ + iω)s − iκs²/2} ds = C [w(z_t) − G w(z_0)],
//! C = (1 − i)√π/(2√κ),   z = (1 − i)(ω − iλ)/(2√κ) with ω = ν + κt and ν,
//! G = e^{λt + i(νt + κt²/2)}:
//! ```
//!
//! both sides vanish at `t = 0` and satisfy `dE/dt = iκ∂E/∂(iω)…`, or complete the square in the
//! exponent. `A = w² E[λ₊, λ₋]`, the divided difference, and `w²(λE)[λ₊, λ₋]` that of `ψ′`; at
//! critical damping both are derivatives, by `w′ = −2zw + 2i/√π`. Nowhere is there an exponential
//! that grows: `Re(−z²) = (Re λ)(ω + Im λ)/κ ≤ 0` wherever z is in the lower half-plane.

use super::parts::Parts;
use super::problem::{Problem, Response};
use crate::{Ball, ComplexBall, Undecided, faddeeva};
use rug::Rational;
use std::cmp::Ordering;

/// The response enclosed at a working precision of `prec` bits; nothing is promised about the
/// radii.
pub fn enclose(problem: &Problem, prec: u32) -> Response {
    parts(problem, prec).response()
}

/// The problem with `κ ≥ 0`, and whether it is another one: `k` and `δ` change their signs.
pub(super) fn mirrored(problem: &Problem) -> (Problem, bool) {
    let mut p = problem.clone();
    let mirrored = p.kappa().cmp0() == Ordering::Less;
    if mirrored {
        p.k = -p.k;
        p.delta = -p.delta;
    }
    (p, mirrored)
}

pub(super) fn parts(problem: &Problem, prec: u32) -> Parts {
    let (p, mirrored) = mirrored(problem);
    let (mut amplitude, mut rate) = convolution(&p, prec);
    if p.nu() == 0 && p.kappa() == 0 {
        // A constant force: the integrand of (1) is real.
        amplitude.im = Ball::integer(prec, 0);
        rate.im = Ball::integer(prec, 0);
    }
    if mirrored {
        (amplitude, rate) = (amplitude.conj(), rate.conj());
    }
    Parts::new(problem, prec, &amplitude, &rate)
}

/// The response, each component with a relative radius of at most 2^-bits.
///
/// ```
/// use mechaudit_reference::chirp_oscillator::{Problem, response};
/// use rug::Rational;
/// // w, n, ε, Ω₀, k, δ, y₀, v₀, t
/// let values = [(10, 1), (1, 2), (4, 1), (0, 1), (2, 1), (0, 1), (0, 1), (0, 1), (3, 2)];
/// let problem = Problem::new(&values.map(Rational::from)).unwrap();
/// let r = response(&problem, 100)?;
/// assert!(r.y.accuracy_bits() >= 99);
/// # Ok::<(), mechaudit_reference::Undecided>(())
/// ```
///
/// # Errors
/// [`Undecided`] where that takes more than `4 bits + 16384` bits: a component then is zero or
/// indistinguishable from zero.
pub fn response(problem: &Problem, bits: u32) -> Result<Response, Undecided> {
    let cap = 4 * bits + 16384;
    let mut guard = 48;
    loop {
        let prec = bits + guard;
        let found = enclose(problem, prec);
        let due = i64::from(bits);
        if found
            .components()
            .iter()
            .all(|b| b.is_zero() || b.accuracy_bits() >= due)
        {
            return Ok(found);
        }
        if prec >= cap {
            return Err(Undecided::new(
                prec,
                "a component of the response cannot be told from zero",
            ));
        }
        guard = (3 * guard).min(cap - bits);
    }
}

/// `E[λ₊, λ₋]` and `(λE)[λ₊, λ₋]`, κ ≥ 0.
fn convolution(p: &Problem, prec: u32) -> (ComplexBall, ComplexBall) {
    if p.t == 0 {
        return (ComplexBall::zero(prec), ComplexBall::zero(prec));
    }
    let exponent = Exponent::new(p, prec);
    let Some(Roots { slow, fast, gap }) = roots(p, prec) else {
        let zero = Ball::integer(prec, 0);
        let lambda = ComplexBall::new(-Ball::rational(prec, &p.n), zero);
        let (e, slope) = exponent.integral(&lambda, true);
        let rate = &e + &(&lambda * &slope);
        return (slope, rate);
    };
    let e = [&slow, &fast].map(|lambda| exponent.integral(lambda, false).0);
    let amplitude = (&e[0] - &e[1]).div(&gap);
    let rate = (&(&slow * &e[0]) - &(&fast * &e[1])).div(&gap);
    (amplitude, rate)
}

/// λ₊, λ₋ and their distance.
pub(super) struct Roots {
    pub slow: ComplexBall,
    pub fast: ComplexBall,
    pub gap: ComplexBall,
}

/// `None` at critical damping.
pub(super) fn roots(p: &Problem, prec: u32) -> Option<Roots> {
    let real = |q: &Rational| Ball::rational(prec, q);
    let square = p.square();
    let zero = Ball::integer(prec, 0);
    if square == 0 {
        return None;
    }
    let root = real(&Rational::from(square.abs_ref())).sqrt();
    Some(if square > 0 {
        let fast = real(&p.n) + &root;
        let slow = real(&Rational::from(p.w.square_ref())) / &fast;
        let at = |x: Ball| ComplexBall::new(-x, zero.clone());
        Roots {
            slow: at(slow),
            fast: at(fast),
            gap: ComplexBall::new(root.shift(1), zero),
        }
    } else {
        let slow = ComplexBall::new(-real(&p.n), root.clone());
        Roots {
            fast: slow.conj(),
            slow,
            gap: ComplexBall::new(zero, root.shift(1)),
        }
    })
}

/// `(λ + iω)s − iκs²/2` without λ.
pub(super) struct Exponent {
    prec: u32,
    t: Ball,
    /// ω at the ends: now and at `t = 0`.
    omega: [Ball; 2],
    kappa: Option<Chirped>,
    /// `e^{i(νt + κt²/2)}`
    turn: ComplexBall,
    /// `λ + iω = 0` needs ω's zero exactly.
    still: bool,
}

struct Chirped {
    /// `(1 − i)√π/(2√κ)`
    factor: ComplexBall,
    /// `(1 − i)/(2√κ)`
    scale: ComplexBall,
}

impl Exponent {
    pub fn new(p: &Problem, prec: u32) -> Exponent {
        let real = |q: &Rational| Ball::rational(prec, q);
        let (nu, kappa) = (p.nu(), p.kappa());
        let omega = Rational::from(&kappa * &p.t) + &nu;
        let kappa = (kappa != 0).then(|| {
            let half = real(&kappa).sqrt().recip().shift(-1);
            let scale = ComplexBall::new(half.clone(), -half);
            let factor = scale.scaled(&Ball::pi(prec).sqrt());
            Chirped { factor, scale }
        });
        Exponent {
            prec,
            t: real(&p.t),
            omega: [real(&omega), real(&nu)],
            kappa,
            turn: ComplexBall::unit(&real(&p.turned())),
            // Undamped and in resonance from the beginning.
            still: p.n == 0 && Rational::from(nu.abs_ref()) == p.w,
        }
    }

    /// `E(λ)` and, on demand, `E′(λ)`.
    fn integral(&self, lambda: &ComplexBall, with_slope: bool) -> (ComplexBall, ComplexBall) {
        let grown = self.grown(lambda);
        match &self.kappa {
            Some(chirped) => self.chirped(chirped, lambda, &grown, with_slope),
            None => self.steady(lambda, &grown, with_slope),
        }
    }

    /// `e^{λt + i(νt + κt²/2)}`
    fn grown(&self, lambda: &ComplexBall) -> ComplexBall {
        &lambda.scaled(&self.t).exp() * &self.turn
    }

    /// `e^{λt + i(νt + κt²/2)}`, `E`, `E′` and `E″`, for `κ > 0`: by parts,
    ///
    /// ```text
    /// iκE′ = (λ + iω)E − (G − 1),   iκE″ = (λ + iω)E′ + E − tG
    /// ```
    pub fn derivatives(&self, lambda: &ComplexBall, kappa: &Ball) -> Option<[ComplexBall; 4]> {
        let grown = self.grown(lambda);
        let e = self.chirped(self.kappa.as_ref()?, lambda, &grown, false).0;
        let p = ComplexBall::new(lambda.re.clone(), &lambda.im + &self.omega[0]);
        let one = ComplexBall::new(Ball::integer(self.prec, 1), Ball::integer(self.prec, 0));
        let per_kappa = kappa.recip();
        // Division by iκ.
        let divided = |z: &ComplexBall| -&z.turned().scaled(&per_kappa);
        let first = divided(&(&(&p * &e) - &(&grown - &one)));
        let second = divided(&(&(&(&p * &first) + &e) - &grown.scaled(&self.t)));
        Some([grown, e, first, second])
    }

    fn chirped(
        &self,
        Chirped { factor, scale }: &Chirped,
        lambda: &ComplexBall,
        grown: &ComplexBall,
        with_slope: bool,
    ) -> (ComplexBall, ComplexBall) {
        let z = [0, 1].map(|end| {
            // ω − iλ
            let x = ComplexBall::new(&self.omega[end] + &lambda.im, -&lambda.re);
            scale * &x
        });
        let w = [0, 1].map(|end| self.w(&z[end]));
        let e = factor * &(&w[0] - &(grown * &w[1]));
        if !with_slope {
            return (e, ComplexBall::zero(self.prec));
        }
        let root = Ball::pi(self.prec).sqrt().recip().shift(1);
        let slope = [0, 1].map(|end| {
            let product = &z[end] * &w[end];
            let two = |b: &Ball| -b.shift(1);
            ComplexBall::new(two(&product.re), two(&product.im) + &root)
        });
        // dz/dλ = −i (1 − i)/(2√κ)
        let rate = -&scale.turned();
        let now = &rate * &slope[0];
        let then = &w[1].scaled(&self.t) + &(&rate * &slope[1]);
        (e, factor * &(&now - &(grown * &then)))
    }

    /// w, asked again with more bits where the working precision does not enclose it at all.
    fn w(&self, z: &ComplexBall) -> ComplexBall {
        [0, 24, 64]
            .into_iter()
            .map(|more| faddeeva::w_ball(z, self.prec + more))
            .find(ComplexBall::is_finite)
            .unwrap_or_else(|| faddeeva::w_ball(z, 2 * self.prec))
    }

    /// κ = 0: `E = (e^{pt} − 1)/p`, `E′ = (t e^{pt} − E)/p` with `p = λ + iν`, or `E = t`.
    fn steady(
        &self,
        lambda: &ComplexBall,
        grown: &ComplexBall,
        with_slope: bool,
    ) -> (ComplexBall, ComplexBall) {
        let p = ComplexBall::new(lambda.re.clone(), &lambda.im + &self.omega[1]);
        let zero = Ball::integer(self.prec, 0);
        // Only one of the two roots; the other is 2ν away. Undamped, they are distinct and need no
        // slope.
        if self.still && p.im.contains_zero() {
            let slope = ComplexBall::zero(self.prec);
            return (ComplexBall::new(self.t.clone(), zero), slope);
        }
        let one = ComplexBall::new(Ball::integer(self.prec, 1), zero);
        let e = (grown - &one).div(&p);
        let slope = if with_slope {
            (&grown.scaled(&self.t) - &e).div(&p)
        } else {
            ComplexBall::zero(self.prec)
        };
        (e, slope)
    }
}
