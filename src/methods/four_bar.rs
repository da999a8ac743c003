//! The four-bar linkage.

use crate::audit::{HardCase, 
    Budget, CheckPoint, Domain, Draw, Input, Law, Limit, Method, Output, Proof, Reference,
    ReferenceAnswer, Region, SolverAnswer, conditions_by_differences,
};
use crate::reference::dyad::{DyadRefusal, four_bar};
use crate::solvers::dyad::{Assembly, CrankRange, FourBar, FourBarMotion};
use crate::solvers::units::{Angle, Length};
use rug::Rational;
use std::cmp::Ordering;
use std::f64::consts::{PI, TAU};

/// Crank and RRR dyad: position, both derivatives, transmission angle.
pub struct Audit;

const POSITION: &str = "a mixed forward-backward stable position: a few roundings of each length \
    and of the crank angle, and of the three angles that are added";
const FIRST: &str = "the position's errors pass through the link directions into two quotients";
const SECOND: &str = "two squares of the first derivatives and the position's errors once more";

fn motion(x: &[f64]) -> Result<FourBarMotion, &'static str> {
    let &[a, b, c, d, phi, side] = x else {
        return Err("layout");
    };
    let [a, b, c, d] = [a, b, c, d].map(Length::from_m);
    let side = if side > 0.0 {
        Assembly::Positive
    } else {
        Assembly::Negative
    };
    FourBar::new(a, b, c, d)
        .and_then(|bar| bar.position(Angle::from_rad(phi), side))
        .map_err(|e| e.name())
}

fn values(m: &FourBarMotion) -> Vec<f64> {
    let (b, c) = (m.coupler, m.rocker);
    vec![
        b.angle.rad(),
        c.angle.rad(),
        b.first,
        c.first,
        b.second,
        c.second,
        m.transmission.rad(),
        m.joint.position_m[0],
        m.joint.position_m[1],
    ]
}

/// The word of a reference that gives no values.
pub(super) fn refusal(why: DyadRefusal) -> ReferenceAnswer {
    match why {
        DyadRefusal::NotPositive => ReferenceAnswer::Refuses("not positive"),
        DyadRefusal::CannotClose => ReferenceAnswer::Refuses("cannot close"),
        DyadRefusal::Unreachable => ReferenceAnswer::Refuses("unreachable"),
        DyadRefusal::Singular => ReferenceAnswer::Refuses("singular"),
        DyadRefusal::Undecided(u) => ReferenceAnswer::Undecided(u.to_string()),
    }
}

impl Method for Audit {
    fn name(&self) -> &'static str {
        "four-bar"
    }

    fn summary(&self) -> &'static str {
        "four-bar linkage: angles, derivatives by the crank angle, transmission angle"
    }

    fn source(&self) -> &'static str {
        "loop equation a e1 + b e2 = (d, 0) + c e3 and its derivatives, equations (1) to (6) of \
         the solver; Artobolevskii, Theory of Mechanisms and Machines, class-II groups"
    }

    fn inputs(&self) -> Vec<Input> {
        let input = |name, unit| Input { name, unit };
        vec![
            input("a (crank)", "m"),
            input("b (coupler)", "m"),
            input("c (rocker)", "m"),
            input("d (frame)", "m"),
            input("phi1", "rad"),
            input("assembly (1 or -1)", "1"),
        ]
    }

    fn outputs(&self) -> Vec<Output> {
        let output = |name, unit, k, reason| Output {
            name,
            unit,
            budget: Budget::new(Limit::Conditioned(k), reason),
        };
        vec![
            output("phi2", "rad", 4.0, POSITION),
            output("phi3", "rad", 4.0, POSITION),
            output("phi2'", "1", 8.0, FIRST),
            output("phi3'", "1", 8.0, FIRST),
            output("phi2''", "1", 12.0, SECOND),
            output("phi3''", "1", 12.0, SECOND),
            output("mu", "rad", 4.0, POSITION),
            output("x_C", "m", 8.0, POSITION),
            output("y_C", "m", 8.0, POSITION),
        ]
    }

    fn domain(&self) -> Domain {
        let region = |name, description, sample| Region {
            name,
            description,
            sample,
        };
        let point = |name, input: [f64; 6]| CheckPoint {
            name,
            input: input.to_vec(),
        };
        Domain {
            regions: vec![
                region(
                    "crank-rocker",
                    "a in [0.1, 1], b, c, d in [1, 5] with s + l < p + q, phi1 in [-pi, pi]",
                    |r| turning(r, crank_rocker),
                ),
                region(
                    "double-crank",
                    "d in [0.1, 1], a, b, c in [1, 5] with s + l < p + q, phi1 over several turns",
                    |r| {
                        let mut x = turning(r, |r| {
                            let [d, a, b, c] = crank_rocker(r);
                            [a, b, c, d]
                        });
                        x[4] = r.uniform(-20.0, 20.0);
                        x
                    },
                ),
                region(
                    "near-change-point",
                    "s + l < p + q by 1e-9 to 1e-2 of l, phi1 down to 1e-6 from the change point",
                    near_change_point,
                ),
                region(
                    "near-stretched",
                    "coupler and rocker within 1e-10 to 1e-2 of stretched or folded",
                    near_stretched,
                ),
                region(
                    "different-lengths",
                    "two neighbours 1e-8 to 1 of the other two",
                    different_lengths,
                ),
                region(
                    "swinging-crank",
                    "s + l > p + q, phi1 within the crank's range",
                    swinging,
                ),
                region(
                    "unreachable",
                    "phi1 outside the crank's range, the span 1e-9 to 1 too long or too short",
                    unreachable,
                ),
            ],
            check_points: vec![
                point("triangle-3-4-5", [1.0, 3.0, 4.0, 6.0, 0.0, 1.0]),
                point("triangle-3-4-5-mirrored", [1.0, 3.0, 4.0, 6.0, 0.0, -1.0]),
                point("parallelogram", [2.0, 5.0, 2.0, 5.0, 1.0, 1.0]),
                point("antiparallelogram", [2.0, 5.0, 2.0, 5.0, 1.0, -1.0]),
                point("tall-parallelogram", [5.0, 2.0, 5.0, 2.0, 1.0, 1.0]),
                point("isosceles-dyad", [1.0, 3.0, 3.0, 4.0, 2.0, 1.0]),
                point("chebyshev", [2.0, 5.0, 5.0, 4.0, 1.25, 1.0]),
                point("never-closed", [1.0, 2.0, 3.0, 6.0, 0.0, 1.0]),
                point("folded-exactly", [2.0, 7.0, 3.0, 6.0, 0.0, 1.0]),
                point("out-of-reach", [1.0, 2.0, 3.5, 6.0, PI, 1.0]),
                point("too-near", [2.0, 8.0, 3.0, 6.0, 0.0, 1.0]),
                point("crank-along-frame", [1.0, 4.0, 3.5, 4.0, PI, -1.0]),
            ],
        }
    }

    fn hard(&self) -> Vec<HardCase> {
        HardCase::included(include_str!("../../reference/hard/four-bar.csv"))
    }

    fn admits(&self, x: &[f64]) -> bool {
        x.len() == 6 && x[5].abs() == 1.0
    }

    fn solve(&self, input: &[f64]) -> SolverAnswer {
        match motion(input) {
            Ok(m) => SolverAnswer::Values(values(&m)),
            Err(name) => SolverAnswer::Refuses(name),
        }
    }

    fn reference(&self, input: &[Rational], bits: u32) -> ReferenceAnswer {
        let [a, b, c, d, phi, side] = input else {
            return ReferenceAnswer::Failed("six inputs are due".into());
        };
        let lengths = [a, b, c, d].map(Rational::clone);
        let m = match four_bar(&lengths, phi, side.cmp0() == Ordering::Greater, bits) {
            Ok(m) => m,
            Err(why) => return refusal(why),
        };
        let [phi2, first2, second2] = m.coupler;
        let [phi3, first3, second3] = m.rocker;
        let [x, y] = m.joint;
        ReferenceAnswer::Values(Reference {
            values: vec![
                phi2,
                phi3,
                first2,
                first3,
                second2,
                second3,
                m.transmission,
                x,
                y,
            ],
            proof: Proof::Bounded(
                "intersection of circles in ball arithmetic, implicit differentiation",
            ),
        })
    }

    fn conditions(&self, input: &[f64]) -> Option<Vec<f64>> {
        conditions_by_differences(self, input, |j| j != 5)
    }

    fn laws(&self) -> Vec<Law> {
        vec![
            Law {
                name: "closure",
                statement: "a e1 + b e2 - c e3 = (d, 0) within 16 u of the perimeter and of the angles' size",
                residual: closure,
            },
            Law {
                name: "scale",
                statement: "lengths times 2^7 leave every angle and derivative bit for bit unchanged",
                residual: scale_law,
            },
            Law {
                name: "mirror",
                statement: "-phi1 in the other assembly negates angles and derivatives bit for bit",
                residual: mirror,
            },
            Law {
                name: "angle-sum",
                statement: "|phi3 - phi2| is the transmission angle within 8 u of the angles' size",
                residual: angle_sum,
            },
            Law {
                name: "velocity",
                statement: "phi3' is the central difference of phi3 within 1e-6 of its size, away from \
                            singular positions and for lengths within a factor 1000",
                residual: velocity,
            },
        ]
    }
}

/// Crank shortest, `s + l < p + q` by at least 1 %.
fn crank_rocker(r: &mut Draw) -> [f64; 4] {
    loop {
        let a = r.uniform(0.1, 1.0);
        let [b, c, d] = [(); 3].map(|()| r.uniform(1.0, 5.0));
        let longest = b.max(c).max(d);
        if a + 2.0 * longest < (b + c + d) * 0.99 {
            return [a, b, c, d];
        }
    }
}

fn with_angle(r: &mut Draw, [a, b, c, d]: [f64; 4], phi: f64) -> Vec<f64> {
    let side = r.signed(1.0);
    vec![a, b, c, d, phi, side]
}

fn turning(r: &mut Draw, lengths: fn(&mut Draw) -> [f64; 4]) -> Vec<f64> {
    let l = lengths(r);
    let phi = r.uniform(-PI, PI);
    with_angle(r, l, phi)
}

fn near_change_point(r: &mut Draw) -> Vec<f64> {
    let gap = r.log_uniform(1e-9, 1e-2);
    let (s, p) = (r.uniform(0.5, 1.0), r.uniform(1.0, 3.0));
    let q = p * r.uniform(1.0, 1.5);
    // s + l = p + q less a little; q and l next to each other or opposite.
    let l = (p + q - s) * (1.0 - gap);
    let lengths = match r.integer(0, 3) {
        0 => [s, p, q, l],
        1 => [s, l, p, q],
        2 => [p, q, l, s],
        _ => [l, q, p, s],
    };
    // The links lie on one line at φ1 = 0 or π.
    let at = [0.0, PI][r.integer(0, 1)];
    let away = r.log_uniform(1e-6, 1.0);
    let phi = at + r.signed(away);
    let side = r.signed(1.0);
    let [a, b, c, d] = lengths;
    let x = vec![a, b, c, d, phi, side];
    if motion(&x).is_ok() {
        x
    } else {
        // Rounding of the gap may leave the linkage open there: a quarter turn is always closed.
        vec![a, b, c, d, PI / 2.0, side]
    }
}

/// Lengths so that the dyad spans `(b + c)(1 − gap)` or `|b − c| (1 + gap)`.
fn near_limit(r: &mut Draw, gap: f64) -> Vec<f64> {
    let (a, d) = (r.uniform(0.5, 2.0), r.uniform(2.5, 5.0));
    let phi = r.uniform(-PI, PI);
    let span = (a * a + d * d - 2.0 * a * d * phi.cos()).sqrt();
    let (b, c) = if r.chance(0.5) {
        let sum = span / (1.0 - gap);
        let share = r.uniform(0.2, 0.8);
        (sum * share, sum * (1.0 - share))
    } else {
        let difference = span / (1.0 + gap);
        let short = r.uniform(0.5, 5.0);
        if r.chance(0.5) {
            (short + difference, short)
        } else {
            (short, short + difference)
        }
    };
    with_angle(r, [a, b, c, d], phi)
}

fn near_stretched(r: &mut Draw) -> Vec<f64> {
    let gap = r.log_uniform(1e-10, 1e-2);
    near_limit(r, gap)
}

fn unreachable(r: &mut Draw) -> Vec<f64> {
    let gap = r.log_uniform(1e-9, 0.5);
    loop {
        let x = near_limit(r, -gap);
        let [a, b, c, d] = [x[0], x[1], x[2], x[3]];
        // The linkage as such has to close.
        if 2.0 * a.max(b).max(c).max(d) < (a + b + c + d) * (1.0 - 1e-9) {
            return x;
        }
    }
}

fn different_lengths(r: &mut Draw) -> Vec<f64> {
    let small = r.log_uniform(1e-8, 1.0);
    loop {
        let (long, phi) = (r.uniform(1.0, 5.0), r.uniform(-PI, PI));
        // Two neighbours small, the other two long and nearly equal.
        let s = small * r.uniform(0.2, 1.0);
        let t = small * r.uniform(1.0, 2.0);
        let other = long + s * r.uniform(-0.9, 0.9);
        let l = match r.integer(0, 3) {
            0 => [s, t, other, long],
            1 => [s, other, t, long],
            2 => [s, other, long, t],
            _ => [other, t, long, s],
        };
        let x = with_angle(r, l, phi);
        if within(&x) {
            return x;
        }
    }
}

/// Closed, and not next to a limit of the crank.
fn within(x: &[f64]) -> bool {
    motion(x).is_ok_and(|m| m.transmission.rad().sin() > 1e-3)
}

fn swinging(r: &mut Draw) -> Vec<f64> {
    loop {
        let [a, b, c, d] = [(); 4].map(|()| r.uniform(0.5, 3.0));
        let Ok(bar) = FourBar::new(
            Length::from_m(a),
            Length::from_m(b),
            Length::from_m(c),
            Length::from_m(d),
        ) else {
            continue;
        };
        let t = r.uniform(0.001, 0.999);
        let phi = match bar.crank_range() {
            CrankRange::Full => continue,
            CrankRange::Within { limit } => limit.rad() * t,
            CrankRange::Beyond { limit } => limit.rad() + (PI - limit.rad()) * t,
            CrankRange::Between { lower, upper } => {
                lower.rad() + (upper.rad() - lower.rad()) * t
            }
        };
        let phi = r.signed(phi);
        return with_angle(r, [a, b, c, d], phi);
    }
}

const U: f64 = f64::EPSILON / 2.0;

fn closure(x: &[f64]) -> Option<f64> {
    let m = motion(x).ok()?;
    let [a, b, c, d, phi, _] = *x else { return None };
    let (p2, p3) = (m.coupler.angle.rad(), m.rocker.angle.rad());
    let (s1, c1) = phi.sin_cos();
    let (s2, c2) = p2.sin_cos();
    let (s3, c3) = p3.sin_cos();
    let along = a * c1 + b * c2 - c * c3 - d;
    let across = a * s1 + b * s2 - c * s3;
    // The residual of the rounded angles alone is u |φ| times the length.
    let size = (a + b + c + d) * (1.0 + p2.abs().max(p3.abs()));
    // Next to a singular position the angles move by √u without opening the loop that far, but
    // their errors need not cancel: there the law is not applied.
    (m.transmission.rad().sin() > 0.1).then(|| along.hypot(across) / (16.0 * U * size * spread(x)))
}

/// The sum of the lengths over the span of the dyad.
fn spread(x: &[f64]) -> f64 {
    let span = (x[3] - x[0] * x[4].cos()).hypot(x[0] * x[4].sin());
    (x[0] + x[1] + x[2] + x[3]) / span
}

fn scale_law(x: &[f64]) -> Option<f64> {
    let here = values(&motion(x).ok()?);
    let mut y = x.to_vec();
    y[..4].iter_mut().for_each(|l| *l *= 128.0);
    let there = values(&motion(&y).ok()?);
    Some(if here[..7] == there[..7] { 0.0 } else { f64::INFINITY })
}

fn mirror(x: &[f64]) -> Option<f64> {
    let here = values(&motion(x).ok()?);
    let mut y = x.to_vec();
    y[4] = -y[4];
    y[5] = -y[5];
    let there = values(&motion(&y).ok()?);
    // φ2, φ3 and their second derivatives are odd in φ1, the first derivatives even.
    let odd = [0, 1, 4, 5].iter().all(|&i| here[i] == -there[i]);
    let even = [2, 3, 6, 7].iter().all(|&i| here[i] == there[i]);
    Some(if odd && even { 0.0 } else { f64::INFINITY })
}

fn angle_sum(x: &[f64]) -> Option<f64> {
    let m = motion(x).ok()?;
    let (p2, p3) = (m.coupler.angle.rad(), m.rocker.angle.rad());
    let sine = m.transmission.rad().sin();
    let left = ((p3 - p2).abs() - m.transmission.rad()).abs();
    let size = p2.abs() + p3.abs() + TAU;
    (sine > 0.1).then(|| left / (8.0 * U * size * spread(x)))
}

fn velocity(x: &[f64]) -> Option<f64> {
    const H: f64 = 1e-4;
    let m = motion(x).ok()?;
    let at = |h: f64| {
        let mut y = x.to_vec();
        y[4] += h;
        motion(&y).ok().map(|m| (m.rocker.angle.rad(), y[4]))
    };
    let ((p, hi), (q, lo)) = (at(H)?, at(-H)?);
    let size = 1.0 + m.rocker.first.abs() + m.rocker.second.abs();
    // Where one step changes the second derivative by little, the third is of the size allowed.
    let lengths = &x[..4];
    let shortest = lengths.iter().copied().fold(f64::INFINITY, f64::min);
    let alike = lengths.iter().all(|&l| l < 1e3 * shortest);
    let calm = alike
        && m.transmission.rad().sin() > 0.3 && spread(x) < 10.0 && size < 10.0;
    calm.then(|| ((p - q) / (hi - lo) - m.rocker.first).abs() / (1e2 * H * H * size))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::audit::{Settings, audit_method};

    #[test]
    fn the_audit_passes_with_another_seed() {
        let settings = Settings {
            seed: 20_240_607,
            cases_per_region: 40,
            ..Settings::default()
        };
        let report = audit_method(&Audit, &settings, &|| ());
        let failed = report.failures.first().map(|f| (&f.case, &f.judgement.reason));
        assert!(report.passed(), "{failed:?} {:?}", report.laws);
        assert!(report.laws.iter().all(|l| l.cases > 100));
    }

    #[test]
    fn refusing_regions_refuse() {
        let refused = |name: &str, word: &'static str| {
            let point = Audit.domain().check_points.into_iter().find(|p| p.name == name);
            assert_eq!(Audit.solve(&point.unwrap().input), SolverAnswer::Refuses(word));
        };
        refused("folded-exactly", "singular");
        refused("never-closed", "cannot close");
        refused("out-of-reach", "unreachable");
        refused("too-near", "unreachable");
        let domain = Audit.domain();
        let region = domain.regions.iter().find(|r| r.name == "unreachable").unwrap();
        for i in 0..100 {
            let x = (region.sample)(&mut Draw::new(3, "m", "r", i));
            assert_eq!(Audit.solve(&x), SolverAnswer::Refuses("unreachable"));
        }
    }
}
