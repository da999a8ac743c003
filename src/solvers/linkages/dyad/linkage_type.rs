//! Types of four-bar linkage, crank ranges and dead positions.

use super::four_bar::FourBar;
use super::motion::Assembly;
use super::numeric::{HalfAngle, sum3};
use crate::double_double::sign_of_sum;
use crate::units::Angle;
use std::f64::consts::PI;

/// The type of a four-bar linkage by Grashof's rule: with the shortest length `s`, the longest
/// `l` and the others `p`, `q`, some link turns fully if and only if `s + l ≤ p + q`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum GrashofType {
    /// `s + l < p + q`, crank shortest: the crank turns fully, the rocker swings.
    CrankRocker,
    /// `s + l < p + q`, rocker shortest: the driving link swings, the driven one turns fully.
    RockerCrank,
    /// `s + l < p + q`, frame shortest: crank and rocker both turn fully (drag link).
    DoubleCrank,
    /// `s + l < p + q`, coupler shortest: both swing and the coupler turns fully.
    DoubleRocker,
    /// `s + l > p + q`: no link turns fully.
    TripleRocker,
    /// `s + l = p + q`: the linkage passes through positions with all links on one line, where
    /// the assembly may change. Parallelogram and kite are of this type.
    ChangePoint,
}

/// The crank angles at which the linkage can be joined, within one turn about zero.
///
/// At the ends coupler and rocker lie on one line: the dyad is singular there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CrankRange {
    /// Every angle.
    Full,
    /// `|φ1| ≤ limit`.
    Within {
        /// Coupler and rocker stretched.
        limit: Angle,
    },
    /// `limit ≤ |φ1| ≤ π`.
    Beyond {
        /// Coupler and rocker folded.
        limit: Angle,
    },
    /// `lower ≤ |φ1| ≤ upper`: two separate ranges.
    Between {
        /// Coupler and rocker folded.
        lower: Angle,
        /// Coupler and rocker stretched.
        upper: Angle,
    },
}

/// A dead (extreme) position of the rocker: crank and coupler on one line, `φ3' = 0`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DeadPosition {
    /// The crank angle, in `(−π, π]`.
    pub crank: Angle,
    /// The rocker angle, in `(−π, π]`.
    pub rocker: Angle,
}

/// The dead positions of one assembly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DeadPositions {
    /// Crank and coupler stretched, `|OC| = a + b`, if the linkage reaches it.
    pub extended: Option<DeadPosition>,
    /// Crank and coupler folded, `|OC| = |a − b|`, if the linkage reaches it.
    pub folded: Option<DeadPosition>,
}

impl DeadPositions {
    /// The swing of the rocker between its two dead positions, for a crank that turns fully.
    pub fn swing(&self) -> Option<Angle> {
        let (e, f) = (self.extended?, self.folded?);
        let d = (e.rocker.rad() - f.rocker.rad()).abs();
        Some(Angle::from_rad(d.min(2.0 * PI - d)))
    }
}

impl FourBar {
    /// The type of the linkage. The comparison of the sums is exact.
    ///
    /// ```
    /// use mechaudit_solvers::dyad::{FourBar, GrashofType};
    /// use mechaudit_solvers::units::Length;
    /// let [a, b, c, d] = [10.0, 40.0, 30.0, 35.0].map(Length::from_cm);
    /// assert_eq!(FourBar::new(a, b, c, d)?.grashof_type(), GrashofType::CrankRocker);
    /// assert_eq!(FourBar::new(d, b, c, a)?.grashof_type(), GrashofType::DoubleCrank);
    /// # Ok::<(), mechaudit_solvers::dyad::DyadError>(())
    /// ```
    pub fn grashof_type(&self) -> GrashofType {
        let [a, b, c, d] = self.scaled();
        let mut sorted = [a, b, c, d];
        sorted.sort_by(f64::total_cmp);
        let [s, p, q, l] = sorted;
        let excess = sign_of_sum(&[s, l, -p, -q]);
        if excess > 0.0 {
            GrashofType::TripleRocker
        } else if excess == 0.0 {
            GrashofType::ChangePoint
        } else if s == a {
            GrashofType::CrankRocker
        } else if s == c {
            GrashofType::RockerCrank
        } else if s == d {
            GrashofType::DoubleCrank
        } else {
            GrashofType::DoubleRocker
        }
    }

    /// The crank angles that can be reached.
    ///
    /// From `d(φ1)² = a² + d² − 2ad cos φ1` between `(b − c)²` and `(b + c)²`, each limit by the
    /// half-angle formula (1). Whether a limit exists is decided exactly.
    pub fn crank_range(&self) -> CrankRange {
        let [a, b, c, d] = self.scaled();
        let upper = (sign_of_sum(&[a, d, -b, -c]) > 0.0)
            .then(|| angle_opposite([a, d], [b, c], a + d + b + c))
            .map(Angle::from_rad);
        // |b − c| > |a − d|: one of the two differences of b and c exceeds both of a and d.
        let exceeds = |x: f64, y: f64| {
            sign_of_sum(&[x, -y, -a, d]) > 0.0 && sign_of_sum(&[x, -y, a, -d]) > 0.0
        };
        let lower = (exceeds(b, c) || exceeds(c, b))
            .then(|| {
                let (big, small) = (b.max(c), b.min(c));
                angle_opposite([a, d], [big, -small], sum4([a, d, big, -small]))
            })
            .map(Angle::from_rad);
        match (lower, upper) {
            (None, None) => CrankRange::Full,
            (None, Some(limit)) => CrankRange::Within { limit },
            (Some(limit), None) => CrankRange::Beyond { limit },
            (Some(lower), Some(upper)) => CrankRange::Between { lower, upper },
        }
    }

    /// The dead positions of the rocker.
    ///
    /// Crank and coupler on one line form with rocker and frame a triangle whose third side is
    /// `a + b` or `|a − b|`.
    pub fn dead_positions(&self, assembly: Assembly) -> DeadPositions {
        let [a, b, c, d] = self.scaled();
        let s = assembly.sign();
        // O–C at the angle ±ω to the frame; rocker at π − (angle at the rocker's pivot).
        let extended =
            triangle([a, b], [c, d], a + b + c + d).map(|(omega, rocker)| DeadPosition {
                crank: Angle::from_rad(s * omega),
                rocker: Angle::from_rad(s * rocker),
            });
        let folded = if a == b {
            None
        } else {
            let (big, small) = (a.max(b), a.min(b));
            let sum = sum4([big, -small, c, d]);
            triangle([big, -small], [c, d], sum).map(|(omega, rocker)| {
                // b > a: the crank points away from C. a > b: C lies on the crank.
                let (crank, rocker) = if b > a {
                    (s * (omega - PI), s * rocker)
                } else {
                    (-s * omega, -s * rocker)
                };
                let crank = if crank == -PI { PI } else { crank };
                DeadPosition {
                    crank: Angle::from_rad(crank),
                    rocker: Angle::from_rad(rocker),
                }
            })
        };
        DeadPositions { extended, folded }
    }
}

/// The angle between `p` and `q` opposite the side `b + c`, where the triangle is known to exist;
/// `sum` is that of all four.
fn angle_opposite([p, q]: [f64; 2], [b, c]: [f64; 2], sum: f64) -> f64 {
    let x = sum4([b, c, -p, q]);
    let y = sum4([b, c, p, -q]);
    let z = sum4([p, q, -b, -c]);
    HalfAngle::new(x, y, z, sum).angle()
}

/// The sum of four, exact in the first two pairs where they nearly cancel; not below zero.
fn sum4([a, b, c, d]: [f64; 4]) -> f64 {
    // The rounding error of the pair that has no partner of opposite sign is kept.
    let sum = a + b;
    let back = sum - a;
    let low = (a - (sum - back)) + (b - back);
    (sum3([sum, c, d]) + low).max(0.0)
}

/// Angle at the crank pivot and exterior angle at the rocker pivot, third side `m = a + b`: from
/// the factors `m − c + d`, `m + c − d`, `c + d − m` of the triangle, and the sum of all four.
fn triangle([a, b]: [f64; 2], [c, d]: [f64; 2], sum: f64) -> Option<(f64, f64)> {
    let sides = [[a, b, -c, d], [a, b, c, -d], [c, d, -a, -b]];
    if sides.iter().any(|f| sign_of_sum(f) < 0.0) {
        return None;
    }
    let [m_d_c, m_c_d, c_d_m] = sides.map(sum4);
    // At the crank pivot: between m and d, opposite c.
    let omega = HalfAngle::new(c_d_m, m_c_d, m_d_c, sum).angle();
    // At the rocker pivot: between c and d, opposite m.
    let rocker = HalfAngle::new(m_d_c, m_c_d, c_d_m, sum).supplement();
    Some((omega, rocker))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Checks that what the first pair loses in rounding is kept when the rest cancels it.
    #[test]
    fn sums_of_four_that_cancel() {
        let small = 2f64.powi(-60);
        assert_eq!(sum4([1.0, small, -1.0, 0.0]), small);
        assert_eq!(sum4([small, 1.0, 0.0, -1.0]), small);
        assert_eq!(sum4([1.0, -small, -1.0, 4.0 * small]), 3.0 * small);
        assert_eq!(sum4([3.0, small, -1.0, -2.0]), small);
        assert_eq!(sum4([1.0, -small, -1.0, 0.0]), 0.0);
    }
}
