//! Nodes and weights of Gauss and Legendre's quadrature, enclosed, and its error for an analytic
//! integrand.

use crate::{Ball, Mag, Undecided};
use rug::Float;

/// The rule of N nodes on `[−1, 1]`.
#[derive(Clone, Debug)]
pub(crate) struct GaussLegendre {
    /// Node and weight, nodes ascending.
    pub nodes: Vec<(Ball, Ball)>,
}

/// `P_n(x)` and `P_n'(x)` by the recurrence `(k+1) P_{k+1} = (2k+1) x P_k − k P_{k−1}` and
/// `(x² − 1) P_n' = n (x P_n − P_{n−1})`.
fn legendre(n: usize, x: &Ball) -> (Ball, Ball) {
    let bits = x.prec();
    let whole = |k: usize| Ball::integer(bits, k as i64);
    let (mut before, mut p) = (whole(1), x.clone());
    for k in 1..n {
        let next = (&whole(2 * k + 1) * &(x * &p) - &whole(k) * &before) / whole(k + 1);
        before = p;
        p = next;
    }
    let slope = &whole(n) * &(x * &p - &before) / (x.square() - whole(1));
    (p, slope)
}

/// The zero of `P_n` within a radius of x, if the interval Newton step proves it.
fn node(n: usize, x: &Float, radius: Mag) -> Option<Ball> {
    let (p, _) = legendre(n, &Ball::new(x.clone(), Mag::ZERO));
    let (_, slope) = legendre(n, &Ball::new(x.clone(), radius));
    let step = (&p / &slope).magnitude();
    (step < radius).then(|| Ball::new(x.clone(), step))
}

impl GaussLegendre {
    /// Encloses the nodes by the interval Newton method, `x − P(x)/P'(X)` in the interior of X,
    /// which proves one zero in X; n zeros in balls that do not meet are all. Weights are `2/((1 −
    /// x²) P'(x)²)`.
    ///
    /// # Errors
    /// [`Undecided`] if a zero is not proved at this precision.
    pub(crate) fn new(n: usize, bits: u32) -> Result<GaussLegendre, Undecided> {
        debug_assert!(n >= 2);
        // The recurrence in balls may lose as many as (1 + √2)^n.
        let work = bits + 2 * n as u32 + 32;
        let undecided = |reason: &str| Undecided::new(bits, reason);
        let mut nodes = Vec::with_capacity(n);
        for i in 0..n {
            // Tricomi's approximation; by MPFR, so that the last bits are the same on every
            // machine.
            let angle = std::f64::consts::PI * (i as f64 + 0.75) / (n as f64 + 0.5);
            let mut x = Float::with_val(work, -Float::with_val(53, angle).cos());
            for _ in 0..8 + work.ilog2() {
                let (p, slope) = legendre(n, &Ball::new(x.clone(), Mag::ZERO));
                x -= Float::with_val(work, p.mid() / slope.mid());
            }
            let radius = Mag::power_of_two(-i64::from(bits) - 8);
            let node = node(n, &x, radius);
            nodes.push(node.ok_or_else(|| undecided("a node of the quadrature is not proved"))?);
        }
        GaussLegendre::of_nodes(nodes).ok_or_else(|| undecided("two nodes of the quadrature meet"))
    }

    /// The rule whose nodes are these, ascending, if they do not meet.
    fn of_nodes(nodes: Vec<Ball>) -> Option<GaussLegendre> {
        let apart = nodes.windows(2).all(|w| (&w[1] - &w[0]).is_positive());
        if !apart {
            return None;
        }
        let n = nodes.len();
        let weighted = nodes.into_iter().map(|x| {
            let (_, slope) = legendre(n, &x);
            let whole = |k: i64| Ball::integer(x.prec(), k);
            let weight = whole(2) / ((whole(1) - x.square()) * slope.square());
            (x, weight)
        });
        Some(GaussLegendre {
            nodes: weighted.collect(),
        })
    }

    /// A bound on the error for an integrand that is analytic and at most `most` within the ellipse
    /// with the foci ±1 and the half-axes `(ρ ± 1/ρ)/2`, for an integer ρ > 1.
    ///
    /// The Chebyshev coefficients are at most `2 M ρ^−k`; the rule is exact below degree 2N and odd
    /// terms vanish; `|∫ T_k| ≤ 2/(k² − 1)`, and the rule's value is at most 2. The even terms from
    /// 2N on add up to `(64/15) M ρ^−2N/(1 − ρ^−2)` at most for N ≥ 2 (Trefethen, *Approximation
    /// Theory and Approximation Practice*, 2013, Thm 19.3).
    pub(crate) fn error(&self, most: Mag, rho: u32) -> Mag {
        let inverse = Mag::from_f64(1.0).div(Mag::from_f64(f64::from(rho)));
        let square = inverse.mul(inverse);
        let power = self
            .nodes
            .iter()
            .fold(Mag::from_f64(1.0), |p, _| p.mul(square));
        let rest = Mag::from_f64(1.0).sub_below(square);
        let factor = Mag::from_f64(64.0).div(Mag::from_f64(15.0));
        factor.mul(most).mul(power).div(rest)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rug::Rational;

    /// Of `P_2`, whose zeros are ±1/√3, the box decides, and the step is of the size of the
    /// distance.
    #[test]
    fn a_node_is_where_the_newton_step_stays_inside() {
        let due = (Ball::integer(200, 1) / Ball::integer(200, 3)).sqrt();
        let radius = Mag::power_of_two(-20);
        for (off, inside) in [
            (0.0, true),
            (0.9, true),
            (-0.9, true),
            (1.1, false),
            (-40.0, false),
        ] {
            let away = radius.to_float() * off;
            let x = Float::with_val(200, due.mid() + away);
            let found = node(2, &x, radius);
            assert_eq!(found.is_some(), inside, "{off}");
            if let Some(found) = found {
                assert!(found.contains_ball(&due.widened(Mag::power_of_two(-150))) || off == 0.0);
                assert!(off == 0.0 || found.rad() < radius.mul(Mag::from_f64(0.91)));
            }
        }
        // Between two zeros the slope may vanish.
        assert!(node(3, &Float::with_val(200, 0.447), Mag::from_f64(0.1)).is_none());
    }

    /// N nodes are all of them only if no two are the same zero.
    #[test]
    fn nodes_that_meet_are_no_rule() {
        let rule = GaussLegendre::new(3, 64).unwrap();
        let nodes: Vec<Ball> = rule.nodes.iter().map(|(x, _)| x.clone()).collect();
        assert!(GaussLegendre::of_nodes(nodes.clone()).is_some());
        for [to, from] in [[0, 1], [2, 1]] {
            let mut met = nodes.clone();
            met[to] = nodes[from].clone();
            assert!(GaussLegendre::of_nodes(met).is_none());
        }
    }

    /// `(64/15) M ρ^−2N/(1 − ρ^−2)`, rounded up and no farther.
    #[test]
    fn the_bound_is_the_theorem_s() {
        for (n, rho, most) in [(2, 2u32, 1.0), (6, 4, 3.0), (9, 3, 0.125)] {
            let rule = GaussLegendre::new(n, 64).unwrap();
            let bound = rule.error(Mag::from_f64(most), rho).to_float();
            let square = Rational::from((1, rho * rho));
            let power = (0..n).fold(Rational::from(1), |p, _| p * &square);
            let due = Rational::from((64, 15)) * power / (1 - square);
            let due = due * Rational::from_f64(most).unwrap();
            assert!(bound >= due, "{n} {rho}");
            assert!(
                bound <= due * Rational::from_f64(1.0 + 1e-13).unwrap(),
                "{n} {rho}"
            );
        }
    }

    #[test]
    fn powers_are_exact_below_twice_the_nodes() {
        for n in [2usize, 3, 10, 31] {
            let rule = GaussLegendre::new(n, 128).unwrap();
            for k in 0..2 * n {
                let mut sum = Ball::integer(128, 0);
                for (x, w) in &rule.nodes {
                    let power = (0..k).fold(Ball::integer(128, 1), |p, _| p * x);
                    sum = sum + &power * w;
                }
                let due = match k % 2 {
                    0 => Rational::from((2, k as u32 + 1)),
                    _ => Rational::new(),
                };
                assert!(sum.contains(&due), "{n} {k}");
                assert!(sum.rad().to_f64() < 1e-30);
            }
        }
    }

    /// ∫ 1/(x² + a²) with poles at ±ia: the bound holds just inside them, and a hundredth of it
    /// does not.
    #[test]
    fn the_bound_holds_and_is_near() {
        // ρ − 1/ρ = 2a for a = 3/4 and ρ = 2: the ellipse goes through the poles; with a little
        // more it does not.
        let a = Rational::from((77, 100));
        let rule = GaussLegendre::new(6, 128).unwrap();
        let square = Ball::rational(128, &Rational::from(a.square_ref()));
        let mut sum = Ball::integer(128, 0);
        for (x, w) in &rule.nodes {
            sum = sum + w / &(x.square() + &square);
        }
        let a = Ball::rational(128, &a);
        let due = Ball::integer(128, 1).atan2(&a).shift(1) / &a;
        // |x² + a²| is least where the ellipse is nearest to a pole, on the imaginary axis.
        let most =
            Ball::integer(128, 1) / (&square - Ball::rational(128, &Rational::from((9, 16))));
        let bound = rule.error(most.magnitude(), 2);
        let off = (sum - due).abs();
        assert!((Ball::new(bound.to_float(), Mag::ZERO) - &off).is_positive());
        let small = Ball::new(bound.to_float(), Mag::ZERO) / Ball::integer(128, 1000);
        assert!((small - &off).is_negative(), "{off:?} {bound:?}");
    }
}
