//! Reduction to the crank: formulas (3) to (7).

use super::exact::{Grid, Identity, Q};
use super::sample::{
    BITS, Dimensions, Loads, Position, ROWS, Rockers, Sample, ball, masses, number,
};
use super::{Outcome, agree, decimals, draft, greatest, largest};
use crate::papers::{Finding, FindingVerdict, figures};
use crate::reference::class_iii::{Masses, Reduced};
use crate::reference::{Ball, ComplexBall, Mag};
use rug::Rational;

/// A crank speed at which powers of ω1 show.
const FAST: i64 = 2;
/// The row whose values are shown.
const FIRST: u32 = ROWS[0];

/// Speeds of links and centres of mass 2 to 5 as the formulas ask for them, in the unit of length
/// of the dimensions used.
pub(super) struct Speeds {
    omega1: Ball,
    /// ω2 … ω5 and their derivatives by φ.
    omega: [Ball; 4],
    omega_slope: [Ball; 4],
    /// Magnitudes V_S2 … V_S5, their derivatives by φ, and sines of their directions θ.
    v: [Ball; 4],
    v_slope: [Ball; 4],
    sin_theta: [Ball; 4],
}

/// The formulas, as functions.
#[derive(Clone, Copy)]
pub(super) struct Forms {
    /// Twice the kinetic energy (3) over ω1².
    energy: fn(&Speeds, &Loads) -> Ball,
    /// m_n from I_n and l1.
    mass: fn(&Q, &Q) -> Q,
    /// (4).
    inertia: fn(&Speeds, &Loads) -> Ball,
    /// (5).
    derivative: fn(&Speeds, &Loads) -> Ball,
    /// (6) from forces P, speeds V, cosines, ω_n; without moments.
    power: fn(&[Ball; 4], &[Ball; 4], &[Ball; 4], &Ball) -> Ball,
    /// (7).
    moment: fn(&Speeds, &Loads) -> Ball,
}

/// As printed.
pub(super) const PRINTED: Forms = Forms {
    energy: |s, b| {
        let part = |x: &Ball| (x / &s.omega1).square();
        let [w2, w3, w4, w5] = &s.omega;
        &b.i[0]
            + &b.m[0] * &part(&s.v[0])
            + &b.i[1] * &part(w2)
            + &b.i[2] * &part(w3)
            + &b.m[2] * &part(&s.v[2])
            + &b.i[3] * &part(w4)
            + &b.i[4] * &part(w5)
    },
    mass: |inertia, l1| inertia / (l1 * l1),
    inertia: |s, b| {
        let [w2, w3, w4, w5] = &s.omega;
        let sum = &b.m[0] * &s.v[0].square()
            + &b.i[1] * &w2.square()
            + &b.i[2] * &w3.square()
            + &b.i[3] * &w4.square()
            + &b.m[2] * &s.v[2].square()
            + &b.i[4] * &w5.square();
        s.omega1.square().recip() * sum
    },
    derivative: |s, b| {
        let two = Ball::integer(BITS, 2);
        let speed = |i: usize| &two * &b.m[i] * &s.v[i] * &s.v_slope[i];
        let turn = |i: usize| &two * &b.i[i + 1] * &s.omega[i] * &s.omega_slope[i];
        speed(0) + turn(0) + turn(1) + speed(2) + turn(2) + turn(3)
    },
    power: |p, v, cosine, omega| {
        (0..4).fold(Ball::integer(BITS, 0), |sum, i| {
            sum + &p[i] * &(&v[i] / omega) * &cosine[i]
        })
    },
    moment: |s, b| {
        (0..4).fold(Ball::integer(BITS, 0), |sum, i| {
            sum - &b.m[i] * &b.g * &s.v[i] * &s.sin_theta[i]
        })
    },
};

/// Metres per centimetre.
fn per_centimetre() -> Ball {
    Ball::rational(BITS, &Rational::from((1, 100)))
}

/// Speeds from the angles and their rates: each centre of mass is the end of a chain of turning
/// vectors, `r i ω e(φ)` for the velocity and `r (i ε − ω²) e(φ)` for the acceleration.
fn speeds(d: &Dimensions, at: &Position, omega1: i64, length: &Ball) -> Speeds {
    let omega1 = Ball::integer(BITS, omega1);
    let rate: [Ball; 5] = at.first.clone().map(|x| x * &omega1);
    // At a constant crank speed dω/dφ = φ'' ω1.
    let slope: [Ball; 5] = at.second.clone().map(|x| x * &omega1);
    let vector = |r: &Ball, link: usize, angle: &Ball| {
        let e = ComplexBall::unit(&(&at.phi[link - 1] + angle)).scaled(&(r * length));
        let (w, dw) = (&rate[link - 1], &slope[link - 1]);
        let velocity = e.turned().scaled(w);
        // d/dφ of the velocity: e turns by ω/ω1 per unit of φ.
        let bend = &at.first[link - 1] * w;
        (velocity, &e.turned().scaled(dw) - &e.scaled(&bend))
    };
    let zero = Ball::integer(BITS, 0);
    let sum =
        |a: (ComplexBall, ComplexBall), b: (ComplexBall, ComplexBall)| (&a.0 + &b.0, &a.1 + &b.1);
    let own = |link: usize| {
        let (r, angle) = &d.centres[link - 2];
        vector(r, link, angle)
    };
    let centres = [
        sum(vector(&d.l1, 1, &zero), own(2)),
        own(3),
        sum(vector(&d.l3, 3, &zero), own(4)),
        own(5),
    ];
    let v: [Ball; 4] = std::array::from_fn(|i| centres[i].0.norm_sqr().sqrt());
    Speeds {
        omega1,
        omega: std::array::from_fn(|i| rate[i + 1].clone()),
        omega_slope: std::array::from_fn(|i| slope[i + 1].clone()),
        v_slope: std::array::from_fn(|i| &centres[i].0.dot(&centres[i].1) / &v[i]),
        sin_theta: std::array::from_fn(|i| centres[i].0.arg().sin_cos().0),
        v,
    }
}

/// Everything the checks compare: a value of the formula and the certified one, per row.
struct Comparison<'a> {
    sample: &'a Sample,
    loads: Loads,
    masses: Masses,
}

impl<'a> Comparison<'a> {
    fn new(sample: &'a Sample, crank: &Rational) -> Comparison<'a> {
        Comparison {
            sample,
            loads: Loads::new(crank),
            masses: masses(Rockers::AboutPivot, crank),
        }
    }

    fn reduced(&self, at: &Position, masses: &Masses) -> Reduced {
        self.sample.linkage.reduce(&at.kinematics, masses)
    }

    /// Formula minus reference at every row.
    fn residuals(
        &self,
        form: impl Fn(&Speeds, &Loads) -> Ball,
        due: impl Fn(&Reduced) -> Ball,
        omega1: i64,
        length: &Ball,
    ) -> Vec<Ball> {
        let row = |at: &Position| {
            let s = speeds(&self.sample.dimensions, at, omega1, length);
            form(&s, &self.loads) - due(&self.reduced(at, &self.masses))
        };
        self.sample.positions.iter().map(row).collect()
    }

    /// The formula's value at one of the rows.
    fn value(
        &self,
        form: impl Fn(&Speeds, &Loads) -> Ball,
        i: usize,
        omega1: i64,
        length: &Ball,
    ) -> Ball {
        let at = &self.sample.positions[i];
        form(
            &speeds(&self.sample.dimensions, at, omega1, length),
            &self.loads,
        )
    }
}

fn inertia(r: &Reduced) -> Ball {
    r.inertia.clone()
}

fn derivative(r: &Reduced) -> Ball {
    r.inertia_derivative.clone()
}

fn moment(r: &Reduced) -> Ball {
    r.moment.clone()
}

/// A crank inertia that is not zero, to see who keeps it.
fn some_crank() -> Rational {
    number("1.4")
}

fn positive(masses: &Masses) -> bool {
    masses.bodies.iter().all(|b| b.inertia > 0)
}

/// m_n (l1 ω)² = I_n ω² over ω², of degree at most 2 after multiplication by l1².
fn same_energy(f: &Forms) -> Identity {
    Grid::new(&[2, 2]).vanishes(|v| (f.mass)(&v[0], &v[1]) * &v[1] * &v[1] - &v[0])
}

fn energy(f: &Forms, sample: &Sample) -> Finding {
    let m = per_centimetre();
    let c = Comparison::new(sample, &some_crank());
    let pivot = c.residuals(f.energy, inertia, FAST, &m);
    // The same links by König: centre of mass, with I − m s².
    let steiner = masses(Rockers::Steiner, &some_crank());
    let positive = positive(&steiner);
    let centre = masses(Rockers::AboutCentre, &some_crank());
    let against = |masses: &Masses| -> Vec<Ball> {
        let at = |(i, p): (usize, &Position)| {
            c.value(f.energy, i, FAST, &m) - c.reduced(p, masses).inertia
        };
        sample.positions.iter().enumerate().map(at).collect()
    };
    let konig = against(&steiner);
    let other = against(&centre);
    let gap = greatest(&other, BITS);
    let small = (ball("0.02") - &gap).is_positive();
    let same_energy = same_energy(f);
    draft("formula-3", "(3)")
        .verdict(FindingVerdict::Confirmed)
        .titled("The kinetic energy is right if I_3 and I_5 are about the fixed pivots")
        .text(
            "Links 3 and 5 appear in (3) with I ω² alone, so their moments of inertia have to be \
             taken about O_3 and O_5; I_2 and I_4 are about the centres of mass. Read so, the braces \
             of (3) agree with the reduced moment of inertia of the certified motion, and with \
             König's sum over centres of mass after Steiner's theorem. Read as moments about the \
             centres of mass they would leave out m s² ω² of both rockers, less than \
             0.02 kg·m² on the rows tried. The paper does not say which is meant. The reduced mass \
             m_n = I_n/l_1² that follows is right, too.",
        )
        .figures(figures! {
            "largest possible residual": "{}", largest(pivot.iter().chain(&konig)) => "kg m^2";
            "largest part left out by the other reading": "{}", decimals(&gap, 6) => "kg m^2";
        })
        .recorded_if(agree(&[
            (Outcome::enclosed(&pivot), Outcome::Holds),
            (Outcome::enclosed(&konig), Outcome::Holds),
            (Outcome::of(positive), Outcome::Holds),
            (Outcome::enclosed(&other), Outcome::Fails),
            (Outcome::of(small), Outcome::Holds),
            (same_energy.outcome(), Outcome::Holds),
        ]))
}

fn reduced_inertia(f: &Forms, sample: &Sample) -> Finding {
    let (m, cm) = (per_centimetre(), Ball::integer(BITS, 1));
    let paper = Comparison::new(sample, &Rational::new());
    let with_crank = Comparison::new(sample, &some_crank());
    let crankless = paper.residuals(f.inertia, inertia, FAST, &m);
    let lost = with_crank.residuals(f.inertia, inertia, FAST, &m);
    let centimetres = paper.residuals(f.inertia, inertia, 1, &cm);
    let corrected = |s: &Speeds, b: &Loads| (f.inertia)(s, b) + &b.i[0];
    let right = with_crank.residuals(corrected, inertia, FAST, &m);
    // What is lost is I_1, nothing else.
    let crank = Ball::rational(BITS, &some_crank());
    let exactly: Vec<Ball> = lost.iter().map(|r| r + &crank).collect();
    draft("formula-4", "(4)")
        .verdict(FindingVerdict::ErrorOfPaper)
        .titled("(4) drops I_1, and its speeds have to be in metres per second")
        .text(
            "Formula (4) is the braces of (3) without I_1. The data have I_1 = 0, so the tables do \
             not suffer, but a real crank with its motor would be forgotten. The lengths are given \
             without a unit and are centimetres, while the inertias are in kg·m²: put in as they \
             stand the speeds have to be multiplied by 0.01. The paper does not say so; its tables \
             have it.",
        )
        .figures(figures! {
            "I_n at row {FIRST}, lengths in metres":
                "{}", decimals(&paper.value(f.inertia, 0, 1, &m), 6) => "kg m^2";
            "I_n at row {FIRST}, lengths as printed":
                "{}", decimals(&paper.value(f.inertia, 0, 1, &cm), 3) => "mixed units";
            "largest possible residual with I_1 = 0, metres": "{}", largest(&crankless) => "kg m^2";
        })
        .recorded_if(agree(&[
            (Outcome::enclosed(&crankless), Outcome::Holds),
            (Outcome::enclosed(&lost), Outcome::Fails),
            (Outcome::enclosed(&exactly), Outcome::Holds),
            (Outcome::enclosed(&centimetres), Outcome::Fails),
            (Outcome::enclosed(&right), Outcome::Holds),
        ]))
}

/// Width of the arc of the mean value test: 2^-ARC radians.
const ARC: i32 = 100;

/// `I_n(φ + δ) − I_n(φ)` lies in δ times the derivative over the arc: the mean value theorem, which
/// knows I_n only. The derivative tested is the one that (5) is compared with. Returns the enclosure
/// of the difference quotient and of the derivative over the arc.
fn mean_value(sample: &Sample) -> Option<(Ball, Ball)> {
    let at = sample.positions.first()?;
    let loads = masses(Rockers::AboutPivot, &Rational::new());
    let delta = Ball::integer(BITS, 1).shift(-ARC);
    let from = at.phi[0].clone();
    let to = &from + &delta;
    let l = &sample.linkage;
    let reduced = |phi: &Ball| {
        let there = l.follow(&at.configuration, &from, phi)?;
        Some(l.reduce(&l.kinematics(&there).ok()?, &loads))
    };
    let here = l.reduce(&at.kinematics, &loads).inertia;
    let quotient = (reduced(&to)?.inertia - here).shift(ARC);
    let arc = from.widened(Mag::power_of_two(1 - i64::from(ARC)));
    Some((quotient, reduced(&arc)?.inertia_derivative))
}

/// Enclosures narrower than 1e-20 that share a point, as the theorem says they must.
fn consistent((quotient, slope): &(Ball, Ball)) -> Outcome {
    let narrow = [quotient, slope].iter().all(|x| x.rad().to_f64() < 1e-20);
    match (quotient.overlaps(slope), narrow) {
        (false, _) => Outcome::Fails,
        (true, true) => Outcome::Holds,
        (true, false) => Outcome::Undecided,
    }
}

fn inertia_derivative(f: &Forms, sample: &Sample) -> Finding {
    let m = per_centimetre();
    let c = Comparison::new(sample, &Rational::new());
    let unit_speed = c.residuals(f.derivative, derivative, 1, &m);
    let printed = c.residuals(f.derivative, derivative, FAST, &m);
    let fourfold = c.residuals(f.derivative, |r| derivative(r).shift(2), FAST, &m);
    let divided = |s: &Speeds, b: &Loads| &(f.derivative)(s, b) / &s.omega1.square();
    let corrected = c.residuals(divided, derivative, FAST, &m);
    let mean = mean_value(sample);
    let consistent = mean.as_ref().map_or(Outcome::Undecided, consistent);
    let mut figures = figures! {
        "dI_n/dφ at row {FIRST}, omega_1 = 1":
            "{}", decimals(&c.value(f.derivative, 0, 1, &m), 9) => "kg m^2/rad";
        "the same as printed, omega_1 = 2":
            "{}", decimals(&c.value(f.derivative, 0, FAST, &m), 9) => "kg m^2/rad";
        "largest possible residual at omega_1 = 1": "{}", largest(&unit_speed) => "kg m^2/rad";
    };
    if let Some((quotient, _)) = &mean {
        figures.extend(figures! {
            "difference quotient of I_n at row {FIRST} over 2^-100 rad":
                "{}", decimals(quotient, 20) => "kg m^2/rad";
        });
    }
    draft("formula-5", "(5)")
        .verdict(FindingVerdict::ErrorOfPaper)
        .titled("The derivative of I_n lacks the factor 1/ω_1²")
        .text(
            "All terms of the derivative of (4) are there, but the factor 1/ω_1² in front of (4) is \
             lost. At ω_1 = 1, the paper's value, (5) agrees with the certified derivative; at \
             ω_1 = 2 it gives four times too much, and divided by ω_1² it is right again. That the \
             reference is the derivative of I_n was checked through the mean value theorem over \
             an arc of 2⁻¹⁰⁰ rad. The scan prints part of the formula twice, the first time as noise.",
        )
        .figures(figures)
        .recorded_if(agree(&[
            (Outcome::enclosed(&unit_speed), Outcome::Holds),
            (Outcome::enclosed(&printed), Outcome::Fails),
            (Outcome::enclosed(&fourfold), Outcome::Holds),
            (Outcome::enclosed(&corrected), Outcome::Holds),
            (consistent, Outcome::Holds),
        ]))
}

/// (6) with the weights as forces.
fn by_power(f: &Forms, s: &Speeds, b: &Loads) -> Ball {
    let weights: [Ball; 4] = std::array::from_fn(|i| &b.m[i] * &b.g);
    // The angle from the downward weight to the velocity is θ + 90°; its cosine is −sin θ.
    let cosines: [Ball; 4] = std::array::from_fn(|i| -&s.sin_theta[i]);
    (f.power)(&weights, &s.v, &cosines, &s.omega1)
}

fn power(f: &Forms, sample: &Sample) -> Finding {
    let m = per_centimetre();
    let c = Comparison::new(sample, &Rational::new());
    let r = [1, -2]
        .iter()
        .flat_map(|&omega| c.residuals(|s, b| by_power(f, s, b), moment, omega, &m))
        .collect::<Vec<_>>();
    draft("formula-6", "(6)")
        .verdict(FindingVerdict::Confirmed)
        .titled("The reduction of forces by equal power is right")
        .text(
            "With the weights as forces, (6) gives −dU/dφ_1, the reduced moment that follows from \
             the potential energy of the certified positions; tried with crank speeds 1 and \
             −2 rad/s, so for both senses of rotation. No moments M_j act on the links here, so only the first sum was tried.",
        )
        .figures(figures! {
            "rows and crank speeds tried": "{}", r.len() => "1";
            "largest possible residual": "{}", largest(&r) => "N m";
        })
        .recorded_if(agree(&[(Outcome::enclosed(&r), Outcome::Holds)]))
}

fn reduced_moment(f: &Forms, sample: &Sample) -> Finding {
    let (m, cm) = (per_centimetre(), Ball::integer(BITS, 1));
    let c = Comparison::new(sample, &Rational::new());
    let unit_speed = c.residuals(f.moment, moment, 1, &m);
    let printed = c.residuals(f.moment, moment, FAST, &m);
    let centimetres = c.residuals(f.moment, moment, 1, &cm);
    let divided = |s: &Speeds, b: &Loads| &(f.moment)(s, b) / &s.omega1 * per_centimetre();
    let corrected = c.residuals(divided, moment, FAST, &cm);
    draft("formula-7", "(7)")
        .verdict(FindingVerdict::ErrorOfPaper)
        .titled("M_o lacks the factor 1/ω_1 that (6) has, and the factor 0.01 for centimetres")
        .text(
            "Signs and angles of (7) are right with y upwards: a rising centre of mass gives a \
             negative share, −m g V sin θ. Compared with (6) the division by ω_1 is missing, which \
             does not matter at the paper's ω_1 = 1, and speeds in cm/s make the moment a hundred \
             times too large. With both factors it equals −dU/dφ_1 at every row tried.",
        )
        .figures(figures! {
            "M_o at row {FIRST} with both factors":
                "{}", decimals(&c.value(divided, 0, FAST, &cm), 6) => "N m";
            "M_o at row {FIRST} with omega_1 = 2, metres":
                "{}", decimals(&c.value(f.moment, 0, FAST, &m), 6) => "N m";
            "M_o at row {FIRST} with omega_1 = 1, centimetres":
                "{}", decimals(&c.value(f.moment, 0, 1, &cm), 4) => "N cm";
            "largest possible residual with both factors": "{}", largest(&corrected) => "N m";
        })
        .recorded_if(agree(&[
            (Outcome::enclosed(&unit_speed), Outcome::Holds),
            (Outcome::enclosed(&printed), Outcome::Fails),
            (Outcome::enclosed(&centimetres), Outcome::Fails),
            (Outcome::enclosed(&corrected), Outcome::Holds),
        ]))
}

/// The findings on the reduction.
pub(super) fn findings(f: &Forms, sample: &Sample) -> Vec<Finding> {
    vec![
        energy(f, sample),
        reduced_inertia(f, sample),
        inertia_derivative(f, sample),
        power(f, sample),
        reduced_moment(f, sample),
    ]
}

#[cfg(test)]
#[path = "reduction_tests.rs"]
mod tests;
