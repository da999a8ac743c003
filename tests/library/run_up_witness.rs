//! The enclosed run-up beside a second method: extrapolation after Gragg, Bulirsch and Stoer in
//! MPFR, over time instead of the crank angle, with the link angles by Newton's method on the loop
//! equations instead of the joints' Taylor models.
//!
//! The second method proves nothing; it is a witness that the same problem was solved.

use mechaudit::reference::run_up::{Coefficients, LinkageCurve, Motor, Run, integrate};
use mechaudit::reference::{Ball, Decimal};
use mechaudit_cli::papers::zinchenko::data;
use rug::{Float, Rational};
use std::sync::Arc;

const BITS: u32 = 128;

fn q(text: &str) -> Rational {
    Decimal::parse(text).expect("a decimal").value
}

fn f(x: impl Into<Rational>) -> Float {
    Float::with_val(BITS, x.into())
}

fn degrees(text: &str) -> Float {
    f(q(text)) * Float::with_val(BITS, rug::float::Constant::Pi) / 180u32
}

type Vec2 = [Float; 2];

fn unit(a: &Float) -> Vec2 {
    let (s, c) = a.clone().sin_cos(Float::new(BITS));
    [c, s]
}

fn times(k: &Float, v: &Vec2) -> Vec2 {
    [
        Float::with_val(BITS, k * &v[0]),
        Float::with_val(BITS, k * &v[1]),
    ]
}

/// A quarter turn.
fn turned(v: &Vec2) -> Vec2 {
    [-v[1].clone(), v[0].clone()]
}

fn plus(a: &Vec2, b: &Vec2) -> Vec2 {
    [
        Float::with_val(BITS, &a[0] + &b[0]),
        Float::with_val(BITS, &a[1] + &b[1]),
    ]
}

fn dot(a: &Vec2, b: &Vec2) -> Float {
    Float::with_val(BITS, &a[0] * &b[0]) + Float::with_val(BITS, &a[1] * &b[1])
}

/// Gauss elimination with row pivots.
fn solve(mut m: [[Float; 4]; 4], mut b: [Float; 4]) -> [Float; 4] {
    for k in 0..4 {
        let size = |i: usize| m[i][k].clone().abs();
        let best = (k..4)
            .max_by(|&i, &j| size(i).total_cmp(&size(j)))
            .expect("not empty");
        m.swap(k, best);
        b.swap(k, best);
        for i in k + 1..4 {
            let ratio = Float::with_val(BITS, &m[i][k] / &m[k][k]);
            for j in k..4 {
                let t = Float::with_val(BITS, &ratio * &m[k][j]);
                m[i][j] -= t;
            }
            let t = Float::with_val(BITS, &ratio * &b[k]);
            b[i] -= t;
        }
    }
    for k in (0..4).rev() {
        for j in k + 1..4 {
            let t = Float::with_val(BITS, &m[k][j] * &b[j]);
            b[k] -= t;
        }
        b[k] /= &m[k][k];
    }
    b
}

/// Zinchenko's sand screen under a Kloss motor, formulas (1)-(7).
struct Machine {
    /// l1, l2, l3, l4, l5, lB.
    l: [Float; 6],
    phi_b: Float,
    o3: Vec2,
    o5: Vec2,
    /// For links 2 to 5: mass, inertia, about the pivot, radius, angle.
    bodies: [(Float, Float, bool, Float, Float); 4],
    gravity: Float,
    /// φ2 … φ5 where they were last.
    angles: [Float; 4],
}

impl Machine {
    fn new() -> Machine {
        let (g, m) = (data::geometry(), data::recovered());
        let angle = |a: &mechaudit::reference::class_iii::ExactAngle| a.to_ball(BITS).mid().clone();
        let point = |p: &[Rational; 2]| [f(p[0].clone()), f(p[1].clone())];
        Machine {
            l: [&g.l1, &g.l2, &g.l3, &g.l4, &g.l5, &g.lb].map(|x| f(x.clone())),
            phi_b: angle(&g.phi_b),
            o3: point(&g.o3),
            o5: point(&g.o5),
            bodies: [1, 2, 3, 4].map(|i| {
                let b = &m.bodies[i];
                (
                    f(b.mass.clone()),
                    f(b.inertia.clone()),
                    b.about_pivot,
                    f(b.radius.clone()),
                    angle(&b.angle),
                )
            }),
            gravity: f(m.gravity),
            angles: ["14.426", "-76.174", "22.558", "-65.721"].map(degrees),
        }
    }

    /// Link vectors: l2, l3, l4, l5 and C–B.
    fn vectors(&self) -> [Vec2; 5] {
        let p = &self.angles;
        let b = Float::with_val(BITS, &p[2] + &self.phi_b);
        [
            times(&self.l[1], &unit(&p[0])),
            times(&self.l[2], &unit(&p[1])),
            times(&self.l[3], &unit(&p[2])),
            times(&self.l[4], &unit(&p[3])),
            times(&self.l[5], &unit(&b)),
        ]
    }

    fn matrix(v: &[Vec2; 5]) -> [[Float; 4]; 4] {
        let t = v.clone().map(|v| turned(&v));
        let zero = || Float::new(BITS);
        std::array::from_fn(|r| {
            if r < 2 {
                [t[0][r].clone(), -t[1][r].clone(), -t[4][r].clone(), zero()]
            } else {
                [
                    zero(),
                    t[1][r - 2].clone(),
                    t[2][r - 2].clone(),
                    -t[3][r - 2].clone(),
                ]
            }
        })
    }

    /// I_n, dI_n/dφ and M_o.
    fn reduced(&mut self, phi: &Float) -> [Float; 3] {
        let crank = times(&self.l[0], &unit(phi));
        let minus = |v: &Vec2| [-v[0].clone(), -v[1].clone()];
        for _ in 0..60 {
            let v = self.vectors();
            let one = plus(
                &plus(&crank, &v[0]),
                &minus(&plus(&plus(&self.o3, &v[1]), &v[4])),
            );
            let two = plus(
                &plus(&plus(&self.o3, &v[1]), &v[2]),
                &minus(&plus(&self.o5, &v[3])),
            );
            let rhs = [
                -one[0].clone(),
                -one[1].clone(),
                -two[0].clone(),
                -two[1].clone(),
            ];
            let step = solve(Self::matrix(&v), rhs);
            let mut largest = 0f64;
            for (a, s) in self.angles.iter_mut().zip(&step) {
                *a += s;
                largest = largest.max(s.to_f64().abs());
            }
            if largest < 1e-25 {
                break;
            }
        }
        let v = self.vectors();
        let a1 = turned(&crank);
        let zero = || Float::new(BITS);
        let w = solve(
            Self::matrix(&v),
            [-a1[0].clone(), -a1[1].clone(), zero(), zero()],
        );
        let square = |k: usize| Float::with_val(BITS, w[k].square_ref());
        let bend = |r: usize| {
            Float::with_val(BITS, &crank[r] + &(square(0) * &v[0][r]))
                - square(1) * &v[1][r]
                - square(2) * &v[4][r]
        };
        let other = |r: usize| square(1) * &v[1][r] + square(2) * &v[2][r] - square(3) * &v[3][r];
        let e = solve(Self::matrix(&v), [bend(0), bend(1), other(0), other(1)]);
        let still = || [zero(), zero()];
        let c1 = times(&w[1], &turned(&v[1]));
        let c2 = plus(&times(&e[1], &turned(&v[1])), &times(&-square(1), &v[1]));
        let origins = [
            (a1, minus(&crank)),
            (still(), still()),
            (c1, c2),
            (still(), still()),
        ];
        let mut sums = [zero(), zero(), zero()];
        for (k, (mass, inertia, pivot, radius, angle)) in self.bodies.iter().enumerate() {
            let arm = times(
                radius,
                &unit(&Float::with_val(BITS, &self.angles[k] + angle)),
            );
            let v = plus(&origins[k].0, &times(&w[k], &turned(&arm)));
            let spin = times(&e[k], &turned(&arm));
            let a = plus(&origins[k].1, &plus(&spin, &times(&-square(k), &arm)));
            sums[0] += inertia * square(k);
            sums[1] += Float::with_val(BITS, &w[k] * &e[k]) * inertia * 2u32;
            if !pivot {
                sums[0] += mass * dot(&v, &v);
                sums[1] += mass * dot(&v, &a) * 2u32;
            }
            sums[2] -= Float::with_val(BITS, mass * &self.gravity) * &v[1];
        }
        sums
    }

    fn right_side(&mut self, y: &Vec2) -> Vec2 {
        let [inertia, slope, moment] = self.reduced(&y[0]);
        let k = f(q("2.2"));
        let root = (Float::with_val(BITS, k.square_ref()) - 1u32).sqrt();
        let sk = (root + &k) * f(q("0.05"));
        let s = 1u32 - Float::with_val(BITS, &y[1] / 10u32);
        let below = Float::with_val(BITS, s.square_ref()) + Float::with_val(BITS, sk.square_ref());
        let motor = s * sk * k * 400u32 / below;
        let square = Float::with_val(BITS, y[1].square_ref()) / 2u32;
        [y[1].clone(), (motor + moment - square * slope) / inertia]
    }

    /// Gragg's midpoint rule with n steps over h, smoothed.
    fn gragg(&mut self, y: &Vec2, h: &Float, n: u32) -> Vec2 {
        let h = Float::with_val(BITS, h / n);
        let twice = Float::with_val(BITS, &h * 2u32);
        let mut before = y.clone();
        let mut here = plus(y, &times(&h, &self.right_side(y)));
        for _ in 1..n {
            let next = plus(&before, &times(&twice, &self.right_side(&here)));
            before = std::mem::replace(&mut here, next);
        }
        let last = times(&h, &self.right_side(&here));
        times(
            &f(Rational::from((1, 2))),
            &plus(&plus(&here, &before), &last),
        )
    }

    /// A step with the columns that it takes; `None` if twelve do not reach the tolerance.
    fn step(&mut self, y: &Vec2, h: &Float, tolerance: f64) -> Option<Vec2> {
        let mut row: Vec<Vec2> = Vec::new();
        for j in 0..12u32 {
            let mut next = vec![self.gragg(y, h, 2 * (j + 1))];
            for k in 1..=j as usize {
                let ratio = f(Rational::from((j + 1, j + 1 - k as u32)));
                let below = ratio.square() - 1u32;
                let gap = plus(&next[k - 1], &times(&f(-1), &row[k - 1]));
                let more = times(&below.recip(), &gap);
                next.push(plus(&next[k - 1], &more));
            }
            if j > 3 {
                let (a, b) = (&next[j as usize], &next[j as usize - 1]);
                let off = (0..2).map(|i| Float::with_val(53, &a[i] - &b[i]).to_f64().abs());
                let off = off.fold(0.0, f64::max);
                if off < tolerance {
                    return next.pop();
                }
                if !off.is_finite() {
                    return None;
                }
            }
            row = next;
        }
        None
    }

    fn run(&mut self, until: &Float, tolerance: f64) -> Vec2 {
        let mut y = [degrees("14.426"), Float::new(BITS)];
        let mut t = Float::new(BITS);
        let mut h = f(q("0.00002"));
        while t < *until {
            let left = Float::with_val(BITS, until - &t);
            if h > left {
                h = left;
            }
            let angles = self.angles.clone();
            match self.step(&y, &h, tolerance) {
                Some(next) => {
                    y = next;
                    t += &h;
                    h *= f(q("1.5"));
                }
                None => {
                    self.angles = angles;
                    h /= 2u32;
                }
            }
        }
        y
    }
}

/// The sand screen from rest under its Kloss motor, exact coefficients.
pub fn certified_run(bits: u32) -> (Coefficients, Run) {
    let (_, start) = data::start(bits).expect("decided");
    let offset = data::row_angle(&Rational::new());
    let masses = data::recovered();
    let curve = LinkageCurve::new(&data::geometry(), &masses, &offset, &start, 48, bits);
    let run = Run {
        motor: Motor::Rated {
            torque: q("200"),
            overload: q("2.2"),
            slip: q("0.05"),
            synchronous: q("10"),
        },
        rotor_inertia: Rational::new(),
        angle: offset,
        speed: Rational::new(),
    };
    (Coefficients::exact(&Arc::new(curve)), run)
}

#[test]
fn extrapolation_in_time_agrees() {
    let times = [q("0.001"), q("0.01")];
    let (coefficients, run) = certified_run(BITS);
    let motion = integrate(&coefficients, &run, &times).expect("decided");
    for s in &motion.samples {
        let y = Machine::new().run(&f(s.time.clone()), 1e-24);
        for (ours, theirs) in [(&s.angle, &y[0]), (&s.speed, &y[1])] {
            let gap = Float::with_val(BITS, ours.mid() - theirs).abs();
            assert!(gap < 1e-20, "{}: {} and {theirs}", s.time, ours.mid());
            // And the enclosure is far narrower than what is compared.
            assert!(ours.rad().to_f64() < 1e-26);
        }
    }
}

#[test]
fn mpmath_agrees_to_fifteen_digits() {
    let text = include_str!("../../reference/independent/run_up.csv");
    let (_, start) = data::start(BITS).expect("decided");
    let offset = data::row_angle(&Rational::new());
    let masses = data::recovered();
    let curve = LinkageCurve::new(&data::geometry(), &masses, &offset, &start, 48, BITS);
    let screen = Coefficients::exact(&Arc::new(curve));
    let rotor = Coefficients::constant(&q("0.9"), &Rational::new(), BITS);
    let from_rest = |motor| Run {
        motor,
        rotor_inertia: Rational::new(),
        angle: offset.clone(),
        speed: Rational::new(),
    };
    let mut lines = 0;
    for line in text.lines().skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        let (model, run) = match cells[0] {
            "sand screen" => (
                &screen,
                from_rest(Motor::Rated {
                    torque: q("200"),
                    overload: q("2.2"),
                    slip: q("0.05"),
                    synchronous: q("10"),
                }),
            ),
            _ => (
                &rotor,
                from_rest(Motor::Kloss {
                    breakdown_torque: q("22"),
                    breakdown_slip: q("0.2"),
                    synchronous: q("157"),
                }),
            ),
        };
        let s = integrate(model, &run, &[q(cells[1])])
            .expect("decided")
            .samples
            .remove(0);
        for (ours, theirs) in [(&s.angle, cells[2]), (&s.speed, cells[3])] {
            if theirs.is_empty() {
                continue;
            }
            let gap = ours - &Ball::rational(BITS, &q(theirs));
            let allowed = ours.magnitude().to_f64() * 1e-15;
            assert!(gap.abs().upper() < allowed, "{line}: {}", ours.mid());
        }
        lines += 1;
    }
    assert_eq!(lines, 4);
}
