//! Class-III linkages in balls, in natural coordinates.
//!
//! The unknowns are the Cartesian coordinates of the joints C and D. With
//! `κ = (lB/l4) e^{iφB}` the third joint of the ternary link is `B = C + κ (D − C)`, and the four
//! rigid distances are quadratic equations:
//!
//! ```text
//! |C − O3|² = l3²   |D − O5|² = l5²   |D − C|² = l4²   |B − A|² = l2²
//! ```
//!
//! No angle but the crank's enters. Positions are enclosed by Krawczyk's operator, which proves
//! existence and uniqueness; derivatives follow by differentiating the four equations; angles and
//! their rates are read off the coordinates.

mod enclosure;
mod laurent;
mod modes;
mod motion;
mod sensitivity;
#[cfg(test)]
mod soundness_tests;
mod trigonometric;

pub use enclosure::Configuration;
pub use modes::Mode;
pub use motion::{Body, Kinematics, Masses, Reduced};
pub use sensitivity::Conditions;

use crate::{Ball, ComplexBall};
use rug::Rational;

/// An exactly given angle.
#[derive(Clone, Debug, PartialEq)]
pub enum ExactAngle {
    /// In radians.
    Radians(Rational),
    /// In degrees.
    Degrees(Rational),
}

impl ExactAngle {
    /// The angle in radians as a ball.
    pub fn to_ball(&self, bits: u32) -> Ball {
        match self {
            ExactAngle::Radians(q) => Ball::rational(bits, q),
            ExactAngle::Degrees(q) => {
                &Ball::pi(bits) * &Ball::rational(bits, &(Rational::from(q) / 180))
            }
        }
    }
}

/// Exactly given dimensions, in any one unit of length.
#[derive(Clone, Debug, PartialEq)]
pub struct Geometry {
    /// Crank.
    pub l1: Rational,
    /// Floating link A–B.
    pub l2: Rational,
    /// Rocker O3–C.
    pub l3: Rational,
    /// Ternary link, C–D.
    pub l4: Rational,
    /// Rocker O5–D.
    pub l5: Rational,
    /// Ternary link, C–B.
    pub lb: Rational,
    /// Angle from C–D to C–B.
    pub phi_b: ExactAngle,
    /// Pivot O3.
    pub o3: [Rational; 2],
    /// Pivot O5.
    pub o5: [Rational; 2],
}

impl Geometry {
    /// From `l1, l2, l3, l4, l5, lB, φB (rad), x3, y3, x5, y5`.
    pub fn from_values(v: &[Rational; 11]) -> Geometry {
        let q = |i: usize| v[i].clone();
        Geometry {
            l1: q(0),
            l2: q(1),
            l3: q(2),
            l4: q(3),
            l5: q(4),
            lb: q(5),
            phi_b: ExactAngle::Radians(q(6)),
            o3: [q(7), q(8)],
            o5: [q(9), q(10)],
        }
    }
}

/// The geometry at a working precision.
#[derive(Clone, Debug)]
pub struct Linkage {
    bits: u32,
    l1: Ball,
    l2: Ball,
    l3: Ball,
    l4: Ball,
    l5: Ball,
    o3: ComplexBall,
    o5: ComplexBall,
    phi_b: Ball,
    kappa: ComplexBall,
    one_minus_kappa: ComplexBall,
}

impl Linkage {
    /// Rounds the geometry outward to `bits`.
    pub fn new(g: &Geometry, bits: u32) -> Linkage {
        let b = |q: &Rational| Ball::rational(bits, q);
        let point = |p: &[Rational; 2]| ComplexBall::new(b(&p[0]), b(&p[1]));
        let ratio = b(&Rational::from(&g.lb / &g.l4));
        let phi_b = g.phi_b.to_ball(bits);
        let kappa = ComplexBall::unit(&phi_b).scaled(&ratio);
        let one = ComplexBall::new(Ball::integer(bits, 1), Ball::integer(bits, 0));
        Linkage {
            bits,
            l1: b(&g.l1),
            l2: b(&g.l2),
            l3: b(&g.l3),
            l4: b(&g.l4),
            l5: b(&g.l5),
            o3: point(&g.o3),
            o5: point(&g.o5),
            phi_b,
            one_minus_kappa: &one - &kappa,
            kappa,
        }
    }

    /// The working precision in bits.
    pub fn bits(&self) -> u32 {
        self.bits
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::Decimal;

    pub(crate) fn q(text: &str) -> Rational {
        Decimal::parse(text).unwrap().value
    }

    /// The linkage of Zinchenko (2008), in centimetres.
    pub(crate) fn zinchenko() -> Geometry {
        Geometry {
            l1: q("10"),
            l2: q("104"),
            l3: q("60"),
            l4: q("64"),
            l5: q("48.5"),
            lb: q("22"),
            phi_b: ExactAngle::Degrees(q("-39.3")),
            o3: [q("75"), q("93")],
            o5: [q("128.5"), q("103.5")],
        }
    }

    fn row(i: u32) -> ExactAngle {
        ExactAngle::Degrees(q("14.426") + Rational::from((15 * i, 2)))
    }

    #[test]
    fn the_modes_of_the_paper_and_their_number() {
        for (i, due) in [(0, 4), (27, 4), (28, 2), (35, 2), (36, 4), (47, 4)] {
            let linkage = Linkage::new(&zinchenko(), 128);
            let modes = linkage.modes(&row(i).to_ball(128)).unwrap();
            assert_eq!(modes.len(), due, "row {i}");
            assert!(modes.iter().all(|m| m.phi4.accuracy_bits() > 90));
        }
        let linkage = Linkage::new(&zinchenko(), 200);
        let modes = linkage.modes(&row(0).to_ball(200)).unwrap();
        let k = linkage.kinematics(&modes[2].configuration).unwrap();
        for (angle, printed) in k
            .angles
            .iter()
            .zip(["14.426", "-76.174", "22.558", "-65.721"])
        {
            let degrees = angle * &(Ball::integer(200, 180) / &Ball::pi(200));
            assert_eq!(degrees.to_fixed(3).unwrap(), printed);
        }
    }

    #[test]
    fn a_turn_closes_and_precisions_overlap() {
        let phi = |bits| row(0).to_ball(bits);
        let turned = |bits| ExactAngle::Degrees(q("374.426")).to_ball(bits);
        let mut coarse: Option<Vec<Ball>> = None;
        for bits in [80, 150, 400] {
            let linkage = Linkage::new(&zinchenko(), bits);
            let start = &linkage.modes(&phi(bits)).unwrap()[2].configuration;
            let end = linkage.follow(start, &phi(bits), &turned(bits)).unwrap();
            for (a, b) in [(&start.c.re, &end.c.re), (&start.d.im, &end.d.im)] {
                assert!(a.overlaps(b) && b.accuracy_bits() > i64::from(bits) - 20);
            }
            let k = linkage.kinematics(&end).unwrap();
            let all: Vec<Ball> = k
                .angles
                .into_iter()
                .chain(k.first)
                .chain(k.second)
                .collect();
            if let Some(before) = coarse {
                assert!(before.iter().zip(&all).all(|(a, b)| a.overlaps(b)));
            }
            coarse = Some(all);
        }
    }

    #[test]
    fn a_fold_is_not_crossed() {
        let linkage = Linkage::new(&zinchenko(), 128);
        let at = |d: &str| ExactAngle::Degrees(q(d)).to_ball(128);
        let modes = linkage.modes(&at("200")).unwrap();
        let crossing = modes
            .iter()
            .filter(|m| {
                linkage
                    .follow(&m.configuration, &at("200"), &at("230"))
                    .is_some()
            })
            .count();
        assert_eq!((modes.len(), crossing), (4, 2));
        // Within 1e-9 degrees of the fold the number is still proved on both sides.
        assert_eq!(linkage.modes(&at("217.270876405")).unwrap().len(), 4);
        assert_eq!(linkage.modes(&at("217.270876407")).unwrap().len(), 2);
    }

    proptest::proptest! {
        #![proptest_config(proptest::prelude::ProptestConfig::with_cases(60))]

        /// Balls of random low precision hold the values of a random higher one.
        #[test]
        fn low_precision_holds_high(
            lengths in proptest::array::uniform6(10i64..100),
            angles in proptest::array::uniform5(-300i64..300),
            phi_b in -300i64..300,
            low in 90u32..140,
            more in 1u32..300,
        ) {
            // Links in centimetres and angles in hundredths of a radian place the pivots, rounded
            // to micrometres, so that at least one mode exists or nearly exists.
            let f = |a: i64| a as f64 / 100.0;
            let end = |l: i64, a: f64| [f(l) * a.cos(), f(l) * a.sin()];
            let arms = [
                end(lengths[0], f(angles[0])),
                end(lengths[1], f(angles[1])),
                end(lengths[2], f(angles[2])),
                end(lengths[3], f(angles[3])),
                end(lengths[4], f(angles[4])),
                end(lengths[5], f(angles[3]) + f(phi_b)),
            ];
            let exact = |x: f64| Rational::from(((x * 1e6).round() as i64, 1_000_000));
            let o3 = [0, 1].map(|k| arms[0][k] + arms[1][k] - arms[2][k] - arms[5][k]);
            let o5 = [0, 1].map(|k| o3[k] + arms[2][k] + arms[3][k] - arms[4][k]);
            let length = |i: usize| Rational::from((lengths[i], 100));
            let g = Geometry {
                l1: length(0), l2: length(1), l3: length(2), l4: length(3), l5: length(4), lb: length(5),
                phi_b: ExactAngle::Radians(Rational::from((phi_b, 100))),
                o3: o3.map(exact),
                o5: o5.map(exact),
            };
            let phi1 = ExactAngle::Radians(Rational::from((angles[0], 100)));
            let at = |bits: u32| {
                let linkage = Linkage::new(&g, bits);
                let modes = linkage.modes(&phi1.to_ball(bits)).ok()?;
                let rates: Result<Vec<Kinematics>, _> =
                    modes.iter().map(|m| linkage.kinematics(&m.configuration)).collect();
                rates.ok()
            };
            // Undecided is allowed (a fold nearby), wrong is not.
            if let (Some(a), Some(b)) = (at(low), at(low + more)) {
                proptest::prop_assert_eq!(a.len(), b.len());
                for (x, y) in a.iter().zip(&b) {
                    for i in 0..4 {
                        proptest::prop_assert!(x.angles[i].overlaps(&y.angles[i]));
                        proptest::prop_assert!(x.first[i].overlaps(&y.first[i]));
                        proptest::prop_assert!(x.second[i].overlaps(&y.second[i]));
                    }
                }
            }
        }
    }
}
