//! The RRR dyad: two links joined by a revolute joint, between two points that move as they like.

use super::error::DyadError;
use super::motion::{Assembly, LinkMotion, PointMotion};
use super::numeric::{HalfAngle, check_lengths, dot, exponent, scale, sum3};
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
        let k = solve_span(&span, scale(first, -e), scale(second, -e), self.assembly, e)?;
        let angle = |v: [f64; 2]| v[1].atan2(v[0]);
        let joint = joint_motion(a, first, k.e2, k.rates2);
        let m = RrrMotion {
            joint,
            first: link(angle(k.e2), k.rates2),
            second: link(angle(k.e3), k.rates3),
            transmission: Angle::from_rad(k.gamma),
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
pub(super) struct Span {
    pub d: [f64; 2],
    pub d1: [f64; 2],
    pub d2: [f64; 2],
    /// `D·D'` and `D·D''`, where the caller knows them better than from the coordinates.
    pub radial: Option<[f64; 2]>,
}

/// The dyad in scaled lengths.
pub(super) struct Kernel {
    /// Unit vector from A to C.
    pub e2: [f64; 2],
    /// Unit vector from B to C.
    pub e3: [f64; 2],
    /// Angle at A.
    pub alpha: HalfAngle,
    /// Angle at B.
    pub beta: HalfAngle,
    /// Angle at C.
    pub gamma: f64,
    /// First and second derivative of the angle of AC.
    pub rates2: [f64; 2],
    /// First and second derivative of the angle of BC.
    pub rates3: [f64; 2],
    /// `(C − A) × (C − B)`.
    pub determinant: f64,
}

/// The loop equation `b e2 − c e3 = D` and its derivatives. With `σ = e2 × e3`,
///
/// ```text
/// φ2' = D'·e3 / (b σ)                         φ3' = D'·e2 / (c σ)                        (2)
/// φ2'' = (D''·e3 + b φ2'² cos γ − c φ3'²) / (b σ)                                        (3)
/// φ3'' = (D''·e2 + b φ2'² − c φ3'² cos γ) / (c σ)                                        (4)
/// ```
pub(super) fn solve_span(
    span: &Span,
    b: f64,
    c: f64,
    assembly: Assembly,
    e: i32,
) -> Result<Kernel, DyadError> {
    let s = assembly.sign();
    let d = span.d[0].hypot(span.d[1]);
    // The four factors of 16 area² (Heron).
    let stretched = sum3([b, c, -d]);
    let folded_b = sum3([d, c, -b]);
    let folded_c = sum3([d, b, -c]);
    let sum = d + b + c;
    let (span_m, least_m, most_m) = (scale(d, e), scale((b - c).abs(), e), scale(b + c, e));
    if !(stretched >= 0.0 && folded_b >= 0.0 && folded_c >= 0.0) {
        return Err(DyadError::Unreachable {
            span_m,
            least_m,
            most_m,
        });
    }
    let area4 = ((stretched * folded_b) * (folded_c * sum)).sqrt();
    if area4 == 0.0 {
        return Err(DyadError::Singular {
            span_m,
            least_m,
            most_m,
        });
    }
    let alpha = HalfAngle::new(stretched, folded_b, folded_c, sum);
    let beta = HalfAngle::new(stretched, folded_c, folded_b, sum);
    let gamma = HalfAngle::new(folded_b, folded_c, stretched, sum);
    let unit = [span.d[0] / d, span.d[1] / d];
    let turned =
        |sin: f64, cos: f64| [unit[0] * cos - unit[1] * sin, unit[1] * cos + unit[0] * sin];
    let (sa, ca) = alpha.sin_cos();
    let (sb, cb) = beta.sin_cos();
    let e2 = turned(s * sa, ca);
    let e3 = turned(s * sb, -cb);
    let cos_gamma = gamma.sin_cos().1;
    let determinant = s * area4 / 2.0;
    let sigma_b = determinant / c; // b σ
    let sigma_c = determinant / b; // c σ
    // D'·e3 = (b D'·e2 − D·D')/c and D'·e2 = (c D'·e3 + D·D')/b: the shorter links win.
    let project = |v: [f64; 2], radial: Option<f64>| {
        let (v2, v3) = (dot(v, e2), dot(v, e3));
        match radial {
            Some(r) if b < c / 4.0 => (v2, (b * v2 - r) / c),
            Some(r) if c < b / 4.0 => ((c * v3 + r) / b, v3),
            _ => (v2, v3),
        }
    };
    let (v2, v3) = project(span.d1, span.radial.map(|r| r[0]));
    let (w2, w3) = (v3 / sigma_b, v2 / sigma_c);
    let (a2, a3) = project(span.d2, span.radial.map(|r| r[1]));
    // The centripetal terms of (3) and (4). Where the span is the shortest side, links and rates
    // are nearly equal and their difference is taken first: b cos γ − c = D·e3,
    // b − c cos γ = D·e2 and φ3' − φ2' = D·D'/(b c σ).
    let (m2, m3) = if d < b.min(c) {
        let radial = span.radial.map_or_else(|| dot(span.d, span.d1), |r| r[0]);
        let both = radial / determinant * (w2 + w3);
        (
            w2 * w2 * dot(span.d, e3) - c * both,
            w3 * w3 * dot(span.d, e2) - b * both,
        )
    } else {
        let (n2, n3) = (b * w2 * w2, c * w3 * w3);
        (n2 * cos_gamma - n3, n2 - n3 * cos_gamma)
    };
    let x2 = (a3 + m2) / sigma_b;
    let x3 = (a2 + m3) / sigma_c;
    Ok(Kernel {
        e2,
        e3,
        alpha,
        beta,
        gamma: gamma.angle(),
        rates2: [w2, x2],
        rates3: [w3, x3],
        determinant,
    })
}
