//! Free motion over one turn: what an inconsistent dI_n/dφ does to the speed.
//!
//! With `M_d = M_o = 0` the equation of motion is linear in the speed along the path,
//! `dψ/dφ = −½ ψ S/(I_n + I_1)` with S in the place of dI_n/dφ, so one turn multiplies ψ by
//! `exp(−½ ∮ S/(I_n + I_1) dφ)`. If S is the derivative of I_n, the integral is zero and the turn
//! conserves the speed.
//!
//! The integral is taken panel by panel: with a polynomial q ≈ 1/J over a part of a panel,
//! `|S/J − S q| ≤ |S| |1 − J q|/J`, all in Taylor models; parts are halved until q is good.

use super::coefficients::Coefficients;
use super::linkage_panel::Panel;
use super::series::reciprocal;
use crate::taylor_model::TaylorModel;
use crate::{Ball, Mag, Undecided};
use rug::float::Round;
use rug::{Float, Rational};

/// One turn in free motion.
#[derive(Clone, Debug)]
pub struct FreeTurn {
    /// `∮ S/(I_n + I_1) dφ`.
    pub integral: Ball,
    /// The factor by which the turn multiplies the speed: `exp(−½ integral)`.
    pub factor: Ball,
}

/// Halvings of a panel before it is given up.
const DEEPEST: u32 = 30;

/// Encloses `∮ S/(I_n + I_1) dφ` over one turn and the factor of the speed.
///
/// # Errors
/// [`Undecided`] when I_n + I_1 cannot be told from zero somewhere, or the linkage cannot be
/// followed over the turn.
pub fn free_motion_factor(
    model: &Coefficients,
    rotor_inertia: &Rational,
) -> Result<FreeTurn, Undecided> {
    let bits = model.bits;
    let rotor = Ball::rational(bits, rotor_inertia);
    let order = bits as usize / 3 + 8;
    let mut sum = Ball::integer(bits, 0);
    for k in 0..i64::from(model.panels) {
        let panel = model.panel(k)?;
        let mut parts = vec![(Float::new(64), 0u32)];
        while let Some((centre, depth)) = parts.pop() {
            match part(&panel, &rotor, &centre, depth, order) {
                Some(x) => sum = sum + x,
                None if depth < DEEPEST => {
                    let by = Float::with_val(64, 1) >> (depth + 1);
                    parts.push((Float::with_val(64, &centre - &by), depth + 1));
                    parts.push((centre + by, depth + 1));
                }
                None => {
                    return Err(Undecided::new(bits, "I_n + I_1 cannot be told from zero"));
                }
            }
        }
    }
    let integral = sum * &model.half_width() / Ball::integer(bits, i64::from(model.turns));
    let factor = exp(&-integral.shift(-1));
    Ok(FreeTurn { integral, factor })
}

/// `∫ S/J dw` over `|w − centre| ≤ 2^−depth`; `None` if 1/J has no good polynomial there.
fn part(panel: &Panel, rotor: &Ball, centre: &Float, depth: u32, order: usize) -> Option<Ball> {
    let bits = rotor.prec();
    let reach = Mag::power_of_two(-i64::from(depth));
    let width = Ball::new(reach.to_float(), Mag::ZERO);
    let near = |m: &TaylorModel| m.shifted(centre, reach).contracted(&width);
    let inertia = near(&panel.inertia).plus_ball(rotor);
    let range = inertia.range();
    if !range.is_positive() {
        return None;
    }
    let q = TaylorModel::polynomial(reciprocal(inertia.coefficients(), order, bits));
    let off = inertia
        .times(&q, order)
        .plus_ball(&Ball::integer(bits, -1))
        .norm();
    // As good as the coefficients are, or as the arithmetic allows.
    let inherent = inertia.rad().div(range.mignitude()).shift(2);
    if !(off <= inherent.max(Mag::power_of_two(12 - i64::from(bits)))) {
        return None;
    }
    let slope = near(&panel.slope);
    let lost = slope.norm().mul(off).div(range.mignitude());
    let primitive = slope.times(&q, order).integral().widened(lost);
    let one = Ball::integer(bits, 1);
    Some((primitive.eval(&one) - primitive.eval(&-one)) * width)
}

/// `e^x`: the midpoint correctly rounded, `|e^x − e^m| ≤ e^m (e^r − 1)`.
fn exp(x: &Ball) -> Ball {
    let bits = x.prec();
    let mid = Float::with_val_round(bits, x.mid().exp_ref(), Round::Nearest).0;
    let mut growth = x.rad().to_float();
    growth.exp_m1_round(Round::Up);
    let size = Mag::above(&mid).add(Mag::above(&mid).shift(-i64::from(bits)));
    let rad = size
        .mul(Mag::above(&growth))
        .add(size.shift(-i64::from(bits)));
    Ball::new(mid, rad)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::draw::Draw;

    /// `∫ S/J dw` over −1 … 1 for the models of S and J.
    fn over(slope: &[f64], inertia: &[f64], rad: f64, order: usize) -> Option<Ball> {
        let model = |c: &[f64], rad: f64| {
            let c: Vec<Ball> = c.iter().map(|x| Ball::exact(120, *x)).collect();
            TaylorModel::from_balls(&c).widened(Mag::from_f64(rad))
        };
        let panel = Panel {
            inertia: model(inertia, rad),
            slope: model(slope, 0.0),
            moment: model(&[0.0], 0.0),
        };
        part(&panel, &Ball::integer(120, 0), &Float::new(64), 0, order)
    }

    /// An inertia of 2 ± 1/10: from 2/2.1 to 2/1.9, and no more than that.
    #[test]
    fn the_radius_of_the_inertia_is_carried_on() {
        let found = over(&[1.0], &[2.0], 0.1, 10).unwrap();
        for end in [(20, 21), (20, 19)] {
            assert!(found.contains(&Rational::from(end)), "{found:?}");
        }
        assert!(found.rad() < Mag::from_f64(0.0527), "{found:?}");
    }

    /// S = 1 and I = 2 in a panel of that number of turns: π for one of them.
    #[test]
    fn the_integral_is_that_of_one_turn() {
        for turns in [1, 2, 7] {
            let constant = |x: i64| TaylorModel::constant(&Ball::integer(120, x));
            let panel = Panel {
                inertia: constant(1),
                slope: constant(1),
                moment: constant(0),
            };
            let mut model = Coefficients::of_panels(vec![panel], 120);
            model.turns = turns;
            let found = free_motion_factor(&model, &Rational::from(1)).unwrap();
            assert!(found.integral.overlaps(&Ball::pi(200)), "{turns}");
            assert!(found.factor.overlaps(&(-Ball::pi(200).shift(-1)).exp()));
        }
    }

    /// From a half to 3.5 with a radius that outweighs the truncation: `(ln 7)/1.5`.
    #[test]
    fn a_quotient_as_good_as_its_coefficients_is_good() {
        let due = 7f64.ln() / 1.5;
        for (rad, order, good) in [(1e-2, 40, true), (1e-6, 80, true), (1e-6, 20, false)] {
            let found = over(&[1.0], &[2.0, 1.5], rad, order);
            assert_eq!(found.is_some(), good, "{rad} {order}");
            if let Some(found) = found {
                let off = (found.to_f64() - due).abs();
                assert!(off < rad && found.rad().to_f64() < 20.0 * rad, "{found:?}");
            }
        }
    }

    /// Radii of all sizes, in all 53 bits: both ends are held, and little more.
    #[test]
    fn exponentials_hold_both_ends() {
        let mut draw = Draw(1);
        for k in 0..2000 {
            let r = (draw.next() >> 11) as f64 * 2f64.powi(-53 - k % 30);
            let x = [0.3f64, -2.0, 1.5][k as usize % 3];
            let e = exp(&Ball::new(Float::with_val(120, x), Mag::from_f64(r)));
            let end = |sign: f64| (Float::with_val(400, r) * sign + x).exp();
            assert!(e.lower() <= end(-1.0) && e.upper() >= end(1.0), "{x} {r}");
            let width = Float::with_val(400, end(1.0) - end(0.0));
            assert!(e.rad().to_float() <= width * (1.0 + 1e-12), "{x} {r}");
        }
        assert!(exp(&Ball::exact(90, 0.3)).rad() < Mag::power_of_two(-80));
    }
}
