//! The RRR dyad: two links joined by a revolute joint, between two points that move as they like.

use super::error::DyadError;
use super::motion::{Assembly, LinkMotion, PointMotion};
use super::numeric::{HalfAngle, check_lengths, dot, exponent, length, root, scale, sum3};
use crate::double_double::Dd;
use crate::lanes::{Lanes, Task, with_best};
use crate::real::Masked;
use crate::units::{Angle, Length};

/// The links `AC` and `BC` with the inner joint `C`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RrrDyad {
    first: Length,
    second: Length,
    assembly: Assembly,
}

/// Position and derivatives of an RRR dyad.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RrrMotion {
    /// The inner joint `C`.
    pub joint: PointMotion,
    /// The link from `A` to `C`; angle in `(−π, π]`.
    pub first: LinkMotion,
    /// The link from `B` to `C`; angle in `(−π, π]`.
    pub second: LinkMotion,
    /// The transmission angle `ACB`, in `(0, π)`.
    pub transmission: Angle,
    /// `(C − A) × (C − B)` in m², the determinant of the velocity equations.
    pub determinant_m2: f64,
}

impl RrrMotion {
    /// The pressure angle `|π/2 − transmission|`, zero where force is passed on best.
    pub fn pressure_angle(&self) -> Angle {
        Angle::from_rad((std::f64::consts::FRAC_PI_2 - self.transmission.rad()).abs())
    }
}

impl RrrDyad {
    /// A dyad with the links `first = |AC|` and `second = |BC|`.
    ///
    /// # Errors
    /// [`DyadError::NotFinite`], [`DyadError::NotPositive`], [`DyadError::LengthRatio`].
    pub fn new(first: Length, second: Length, assembly: Assembly) -> Result<RrrDyad, DyadError> {
        check_lengths(&[("first link", first), ("second link", second)], &[])?;
        Ok(RrrDyad {
            first,
            second,
            assembly,
        })
    }

    /// Solves the dyad between the points `A` and `B`.
    ///
    /// ```
    /// use mechaudit_solvers::dyad::{Assembly, PointMotion, RrrDyad};
    /// use mechaudit_solvers::units::Length;
    /// let dyad = RrrDyad::new(Length::from_m(3.0), Length::from_m(4.0), Assembly::Positive)?;
    /// // A at the origin, B at (5, 0) moving away along x: a right triangle.
    /// let b = PointMotion { position_m: [5.0, 0.0], first_m: [1.0, 0.0], second_m: [0.0, 0.0] };
    /// let m = dyad.solve(&PointMotion::fixed([0.0, 0.0]), &b)?;
    /// assert!((m.joint.position_m[0] - 1.8).abs() < 1e-15);
    /// assert!((m.joint.position_m[1] - 2.4).abs() < 1e-15);
    /// assert!((m.transmission.deg() - 90.0).abs() < 1e-13);
    /// assert!((m.determinant_m2 - 12.0).abs() < 1e-14);
    /// # Ok::<(), mechaudit_solvers::dyad::DyadError>(())
    /// ```
    ///
    /// # Errors
    /// [`DyadError::Unreachable`] where no such triangle exists, [`DyadError::Singular`] where it
    /// is flat, [`DyadError::NotFinite`] for a bad point, [`DyadError::Overflow`] where a result
    /// exceeds the range of `f64`.
    pub fn solve(&self, a: &PointMotion, b: &PointMotion) -> Result<RrrMotion, DyadError> {
        a.check("the first point")?;
        b.check("the second point")?;
        let (first, second) = (self.first.m(), self.second.m());
        let e = exponent(first.max(second));
        let diff = |p: [f64; 2], q: [f64; 2]| [0, 1].map(|i| scale(q[i] - p[i], -e));
        let span = Span {
            d: diff(a.position_m, b.position_m),
            d1: diff(a.first_m, b.first_m),
            d2: diff(a.second_m, b.second_m),
            radial: None,
        };
        let (first_scaled, second_scaled) = (scale(first, -e), scale(second, -e));
        let k = with_best(Alone {
            span: &span,
            links: [first_scaled, second_scaled],
            assembly: self.assembly,
        });
        k.check([first_scaled, second_scaled], e)?;
        let angle = |v: [f64; 2]| v[1].atan2(v[0]);
        let joint = joint_motion(a, first, k.e2, k.rates2);
        let m = RrrMotion {
            joint,
            first: link(angle(k.e2), k.rates2),
            second: link(angle(k.e3), k.rates3),
            transmission: Angle::from_rad(k.gamma.angle()),
            determinant_m2: scale(k.determinant, 2 * e),
        };
        check_finite(&joint, &[k.rates2, k.rates3], m.determinant_m2)?;
        Ok(m)
    }
}

/// Refuses results beyond the range of `f64`.
pub(super) fn check_finite(
    joint: &PointMotion,
    rates: &[[f64; 2]],
    determinant: f64,
) -> Result<(), DyadError> {
    let point = [joint.position_m, joint.first_m, joint.second_m];
    let good = |v: &[[f64; 2]]| v.as_flattened().iter().all(|x| x.is_finite());
    let what = if !good(&point) {
        "the motion of the joint"
    } else if !good(rates) {
        "a derivative of an angle"
    } else if !determinant.is_finite() {
        "the determinant"
    } else {
        return Ok(());
    };
    Err(DyadError::Overflow { what })
}

pub(super) fn link(angle: f64, [first, second]: [f64; 2]) -> LinkMotion {
    LinkMotion {
        angle: Angle::from_rad(angle),
        first,
        second,
    }
}

/// `A + l e` with its derivatives `A' + l φ' i e` and `A'' + l (i φ'' − φ'²) e`.
pub(super) fn joint_motion(a: &PointMotion, l: f64, e: [f64; 2], [w, x]: [f64; 2]) -> PointMotion {
    let normal = [-e[1], e[0]];
    let by = |f: &dyn Fn(usize) -> f64| [f(0), f(1)];
    PointMotion {
        position_m: by(&|i| a.position_m[i] + l * e[i]),
        first_m: by(&|i| a.first_m[i] + l * w * normal[i]),
        second_m: by(&|i| a.second_m[i] + l * (x * normal[i] - w * w * e[i])),
    }
}

/// `D = B − A` with its derivatives, scaled so that the longer link lies in `[1, 2)`.
pub(super) struct Span<R> {
    pub d: [R; 2],
    pub d1: [R; 2],
    pub d2: [R; 2],
    /// `D·D'` and `D·D''`, where the caller knows them better than from the coordinates.
    pub radial: Option<[R; 2]>,
}

/// The dyad in scaled lengths.
pub(super) struct Kernel<R> {
    /// Unit vector from A to C.
    pub e2: [R; 2],
    /// Unit vector from B to C.
    pub e3: [R; 2],
    /// Angle at A.
    pub alpha: HalfAngle<R>,
    /// Angle at B.
    pub beta: HalfAngle<R>,
    /// Angle at C.
    pub gamma: HalfAngle<R>,
    /// First and second derivative of the angle of AC.
    pub rates2: [R; 2],
    /// First and second derivative of the angle of BC.
    pub rates3: [R; 2],
    /// `(C − A) × (C − B)`.
    pub determinant: R,
    /// The least of the sums of two sides less the third one: negative where the links do not reach.
    least: R,
    /// `|AB|`
    span: R,
}

impl Kernel<f64> {
    /// Refuses a dyad that does not reach or is flat.
    pub fn check(&self, [b, c]: [f64; 2], e: i32) -> Result<(), DyadError> {
        let (span_m, least_m) = (scale(self.span, e), scale((b - c).abs(), e));
        let most_m = scale(b + c, e);
        // Also where the span has overflowed.
        if self.least.is_nan() || self.least < 0.0 {
            return Err(DyadError::Unreachable {
                span_m,
                least_m,
                most_m,
            });
        }
        if self.determinant == 0.0 {
            return Err(DyadError::Singular {
                span_m,
                least_m,
                most_m,
            });
        }
        Ok(())
    }
}

/// One dyad by itself.
struct Alone<'a> {
    span: &'a Span<f64>,
    links: [f64; 2],
    assembly: Assembly,
}

impl Task for Alone<'_> {
    type Output = Kernel<f64>;
    #[inline(always)]
    fn run<L: Lanes>(self, _: L) -> Kernel<f64> {
        solve_span(self.span, self.links, self.assembly.sign())
    }
}

/// `(p q − r t) f`
#[inline(always)]
fn difference<R: Masked>([p, q]: [R; 2], [r, t]: [R; 2], f: R) -> R {
    let (high, low) = r.two_prod(t);
    (p.fma(q, -high) - low) * f
}

/// A unit vector, turned.
#[inline(always)]
fn turned<R: Masked>(unit: [R; 2], sin: R, cos: R) -> [R; 2] {
    [
        unit[0].fma(cos, -(unit[1] * sin)),
        unit[1].fma(cos, unit[0] * sin),
    ]
}

/// `D'·e2` and `D'·e3`, where `D'·e3 = (b D'·e2 − D·D')/c` and `D'·e2 = (c D'·e3 + D·D')/b`: the
/// shorter links win.
#[inline(always)]
fn project<R: Masked>(
    v: [R; 2],
    [e2, e3]: [[R; 2]; 2],
    [b, c]: [f64; 2],
    radial: Option<R>,
) -> (R, R) {
    let like = |x: f64| v[0].like(x);
    let (v2, v3) = (dot(v, e2), dot(v, e3));
    match radial {
        Some(r) if b < c / 4.0 => (v2, like(b).fma(v2, -r) / like(c)),
        Some(r) if c < b / 4.0 => (like(c).fma(v3, r) / like(b), v3),
        _ => (v2, v3),
    }
}

/// The loop equation `b e2 − c e3 = D` and its derivatives. With `σ = e2 × e3`,
///
/// ```text
/// φ2' = D'·e3 / (b σ)                         φ3' = D'·e2 / (c σ)                        (2)
/// φ2'' = (D''·e3 + b φ2'² cos γ − c φ3'²) / (b σ)                                        (3)
/// φ3'' = (D''·e2 + b φ2'² − c φ3'² cos γ) / (c σ)                                        (4)
/// ```
///
/// Where the links do not reach or lie in one line, the rates say nothing.
#[inline(always)]
pub(super) fn solve_span<R: Masked>(span: &Span<R>, [b, c]: [f64; 2], s: f64) -> Kernel<R> {
    let like = |v: f64| span.d[0].like(v);
    let (d, per_d) = length(span.d);
    // The four factors of 16 area² (Heron).
    let stretched = sum3([like(b), like(c), -d]);
    let folded_b = sum3([d, like(c), like(-b)]);
    let folded_c = sum3([d, like(b), like(-c)]);
    let sum = d + like(b) + like(c);
    let least = stretched.at_most(folded_b).at_most(folded_c);
    // 16 area² in two parts: with the cosine of half an angle it is its sine.
    let ((p, p_low), (q, q_low)) = (stretched.two_prod(folded_b), folded_c.two_prod(sum));
    let (square, low) = p.two_prod(q);
    let (area4, per_area4) = root(Dd::new(square, p.fma(q_low, p_low.fma(q, low))));
    let half = |p_q_o: R| HalfAngle {
        sin: area4,
        cos: p_q_o * sum,
    };
    let (alpha, beta, gamma) = (half(folded_c), half(folded_b), half(stretched));
    let unit = [span.d[0] * per_d, span.d[1] * per_d];
    // sin α = 4 area/(2 b d), cos α by the same factors over 4 b d.
    let (per_b, per_c) = (like(0.5 / b) * per_d, like(0.5 / c) * per_d);
    let of_half = like(0.5);
    let ca = difference([folded_c, sum], [stretched, folded_b], of_half * per_b);
    let cb = difference([folded_b, sum], [stretched, folded_c], of_half * per_c);
    let e2 = turned(unit, like(s) * (area4 * per_b), ca);
    let e3 = turned(unit, like(s) * (area4 * per_c), -cb);
    let cos_gamma = difference([stretched, sum], [folded_b, folded_c], like(0.25 / (b * c)));
    // b c σ, and 1/(b σ) and 1/(c σ).
    let determinant = like(0.5 * s) * area4;
    let per = like(2.0 * s) * per_area4;
    let (per_sigma_b, per_sigma_c) = (like(c) * per, like(b) * per);
    let (v2, v3) = project(span.d1, [e2, e3], [b, c], span.radial.map(|r| r[0]));
    let (w2, w3) = (v3 * per_sigma_b, v2 * per_sigma_c);
    let (a2, a3) = project(span.d2, [e2, e3], [b, c], span.radial.map(|r| r[1]));
    // The centripetal terms of (3) and (4). Where the span is the shortest side, links and rates
    // are nearly equal and their difference is taken first: b cos γ − c = D·e3,
    // b − c cos γ = D·e2 and φ3' − φ2' = D·D'/(b c σ).
    let radial = span.radial.map_or_else(|| dot(span.d, span.d1), |r| r[0]);
    let both = radial * per * (w2 + w3);
    let (p2, p3) = (w2 * w2, w3 * w3);
    let near = [
        p2.fma(dot(span.d, e3), -(like(c) * both)),
        p3.fma(dot(span.d, e2), -(like(b) * both)),
    ];
    let (n2, n3) = (like(b) * p2, like(c) * p3);
    let far = [n2.fma(cos_gamma, -n3), (-n3).fma(cos_gamma, n2)];
    let is_near = d.below(like(b.min(c)));
    let centripetal = |i: usize| d.pick(is_near, near[i], far[i]);
    Kernel {
        e2,
        e3,
        alpha,
        beta,
        gamma,
        rates2: [w2, (a3 + centripetal(0)) * per_sigma_b],
        rates3: [w3, (a2 + centripetal(1)) * per_sigma_c],
        determinant,
        least,
        span: d,
    }
}
