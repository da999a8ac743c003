//! The class-III linkage on a chosen assembly mode: positions, rates and reduced quantities.

use crate::audit::{
    Budget, CheckPoint, Domain, Draw, HardCase, Input, Law, Limit, Method, Output, Proof,
    Reference, ReferenceAnswer, Region, SolverAnswer,
};
use crate::reference::class_iii::{self as exact, Configuration, ExactAngle, Linkage};
use crate::reference::{Ball, Mag};
use crate::solvers::class_iii::{ClassIii, Geometry, State};
use crate::solvers::reduction::{Body, Masses, MomentOfInertia, Row};
use crate::solvers::units::{Acceleration, Angle, Inertia, Length, Mass};
use rug::Rational;
use std::f64::consts::TAU;

/// See the module.
pub struct Audit;

/// Where the parts of the input begin.
pub(super) const PHI1: usize = 11;
pub(super) const MODE: usize = 12;
pub(super) const GRAVITY: usize = 13;
pub(super) const BODIES: usize = 14;
pub(super) const PIVOTS: usize = 34;
pub(super) const LENGTH: usize = 37;
const BITS_OF_CONDITIONS: u32 = 192;

const LINKAGE: Budget = Budget {
    limit: Limit::Conditioned(4.0),
    reason: "the last Newton correction leaves a residual of a few rounding errors in each loop; \
             that is the effect of perturbing each length and angle by a few units",
};
const REDUCED: Budget = Budget {
    limit: Limit::Conditioned(4.0),
    reason: "five bodies summed from rates that carry the linkage's error",
};

/// Lengths, pivots and crank angle.
pub(super) const GEOMETRY: [(&str, &str); 12] = [
    ("l1", "m"),
    ("l2", "m"),
    ("l3", "m"),
    ("l4", "m"),
    ("l5", "m"),
    ("lB", "m"),
    ("phiB", "rad"),
    ("x3", "m"),
    ("y3", "m"),
    ("x5", "m"),
    ("y5", "m"),
    ("phi1", "rad"),
];

/// Masses, inertias and centres of mass of links 1 to 5.
const LINKS: [[&str; 4]; 5] = [
    ["m1", "J1", "r1", "a1"],
    ["m2", "J2", "r2", "a2"],
    ["m3", "J3", "r3", "a3"],
    ["m4", "J4", "r4", "a4"],
    ["m5", "J5", "r5", "a5"],
];

/// The linkage with its masses, as the run-up takes it too.
pub(super) fn inputs() -> Vec<Input> {
    let i = |name, unit| Input { name, unit };
    let mut all = GEOMETRY.map(|(name, unit)| i(name, unit)).to_vec();
    all.extend([
        i("mode (index by phi4, modulo their number)", "1"),
        i("gravity", "m/s^2"),
    ]);
    for names in LINKS {
        let units = ["kg", "kg m^2", "m", "rad"];
        all.extend(
            names
                .into_iter()
                .zip(units)
                .map(|(name, unit)| i(name, unit)),
        );
    }
    all.extend([
        i(
            "pivot1 (1: J1 is about the pivot; 0: about the centre of mass)",
            "1",
        ),
        i("pivot3 (the same of J3)", "1"),
        i("pivot5 (the same of J5)", "1"),
    ]);
    all
}

fn outputs() -> Vec<Output> {
    let o = |name, unit, budget| Output { name, unit, budget };
    vec![
        o("phi2", "rad", LINKAGE),
        o("phi3", "rad", LINKAGE),
        o("phi4", "rad", LINKAGE),
        o("phi5", "rad", LINKAGE),
        o("phi2'", "1", LINKAGE),
        o("phi3'", "1", LINKAGE),
        o("phi4'", "1", LINKAGE),
        o("phi5'", "1", LINKAGE),
        o("phi2''", "1/rad", LINKAGE),
        o("phi3''", "1/rad", LINKAGE),
        o("phi4''", "1/rad", LINKAGE),
        o("phi5''", "1/rad", LINKAGE),
        o("I_n", "kg m^2", REDUCED),
        o("dI_n/dphi1", "kg m^2", REDUCED),
        o("M_o", "N m", REDUCED),
        o("dM_o/dphi1", "N m", REDUCED),
    ]
}

/// Whether the mode is a whole number and the flags of the pivots are 0 or 1.
pub(super) fn choices_are_whole(x: &[f64]) -> bool {
    let flag = |v: &f64| *v == 0.0 || *v == 1.0;
    x[MODE].fract() == 0.0 && x[PIVOTS..LENGTH].iter().all(flag)
}

/// The linkage and masses of an input, as the solver takes them.
fn solver_row(x: &[f64]) -> Result<Row, &'static str> {
    if x.len() != LENGTH {
        return Err("layout");
    }
    let linkage = linkage(x).ok_or("geometry")?;
    let masses = masses(x).ok_or("masses")?;
    let modes = linkage.assembly_modes(x[PHI1]).modes;
    if modes.is_empty() {
        return Err("cannot be assembled");
    }
    let mode = modes[x[MODE] as usize % modes.len()];
    let state: State = linkage.state(x[PHI1], mode).ok_or("singular")?;
    Ok(Row {
        reduced: masses.reduce(&state),
        state,
    })
}

pub(super) fn linkage(x: &[f64]) -> Option<ClassIii> {
    ClassIii::new(Geometry::from_values(x[..11].try_into().ok()?)).ok()
}

pub(super) fn masses(x: &[f64]) -> Option<Masses> {
    let bodies = std::array::from_fn(|i| {
        let b = &x[BODIES + 4 * i..BODIES + 4 * i + 4];
        let inertia = Inertia::from_kg_m2(b[1]);
        Body {
            mass: Mass::from_kg(b[0]),
            inertia: if about_pivot(i, |k| x[k] != 0.0) {
                MomentOfInertia::AboutPivot(inertia)
            } else {
                MomentOfInertia::AboutCentreOfMass(inertia)
            },
            radius: Length::from_m(b[2]),
            angle: Angle::from_rad(b[3]),
        }
    });
    Masses::new(bodies, Acceleration::from_m_per_s2(x[GRAVITY])).ok()
}

/// Links 1, 3 and 5 (indices 0, 2, 4) may have their inertia about the pivot.
fn about_pivot(i: usize, flag: impl Fn(usize) -> bool) -> bool {
    i.is_multiple_of(2) && flag(PIVOTS + i / 2)
}

pub(super) fn exact_masses(x: &[Rational]) -> exact::Masses {
    exact::Masses {
        bodies: std::array::from_fn(|i| {
            let b = &x[BODIES + 4 * i..BODIES + 4 * i + 4];
            exact::Body {
                mass: b[0].clone(),
                inertia: b[1].clone(),
                about_pivot: about_pivot(i, |k| x[k] != 0),
                radius: b[2].clone(),
                angle: ExactAngle::Radians(b[3].clone()),
            }
        }),
        gravity: x[GRAVITY].clone(),
    }
}

fn exact_linkage(x: &[Rational], bits: u32) -> Option<Linkage> {
    let values: &[Rational; 11] = x.get(..11)?.try_into().ok()?;
    Some(Linkage::new(&exact::Geometry::from_values(values), bits))
}

/// All outputs at an enclosed configuration.
fn values(linkage: &Linkage, at: &Configuration, x: &[Rational]) -> Result<Vec<Ball>, String> {
    let k = linkage.kinematics(at).map_err(|e| e.reason)?;
    let r = linkage.reduce(&k, &exact_masses(x));
    let mut all: Vec<Ball> = Vec::with_capacity(16);
    all.extend(k.angles);
    all.extend(k.first);
    all.extend(k.second);
    all.extend([
        r.inertia,
        r.inertia_derivative,
        r.moment,
        r.moment_derivative,
    ]);
    Ok(all)
}

/// The configuration that the input's mode index selects.
fn configuration(linkage: &Linkage, x: &[Rational]) -> Result<Configuration, ReferenceAnswer> {
    let phi1 = Ball::rational(linkage.bits(), &x[PHI1]);
    let mut modes = linkage
        .modes(&phi1)
        .map_err(|e| ReferenceAnswer::Undecided(e.reason))?;
    if modes.is_empty() {
        return Err(ReferenceAnswer::Refuses("cannot be assembled"));
    }
    let index = x[MODE].to_f64() as usize % modes.len();
    Ok(modes.swap_remove(index).configuration)
}

/// Conditions by implicit differentiation, at the reference's angles.
fn at_angles(x: &[f64], reference: &ReferenceAnswer) -> Option<Vec<f64>> {
    let ReferenceAnswer::Values(Reference { values, .. }) = reference else {
        return None;
    };
    let (bits, phi3, phi5) = (values[1].prec(), &values[1], &values[3]);
    let exact: Option<Vec<Rational>> = x.iter().map(|&v| Rational::from_f64(v)).collect();
    let exact = exact?;
    let linkage = exact_linkage(&exact, bits)?;
    let phi1 = Ball::rational(bits, &exact[PHI1]);
    let at = linkage.placed(&phi1, phi3, phi5);
    let c = linkage.conditions(&phi1, &at, &exact_masses(&exact))?;
    let all = [c.angles, c.first, c.second, c.reduced].concat();
    Some(all.into_iter().map(Mag::to_f64).collect())
}

impl Method for Audit {
    fn name(&self) -> &'static str {
        "class-iii"
    }

    fn summary(&self) -> &'static str {
        "class-III linkage on one assembly mode: angles, rates, I_n, dI_n/dphi, M_o, dM_o/dphi"
    }

    fn source(&self) -> &'static str {
        "Zinchenko (2008), eqs (3)-(7) and the velocity and acceleration systems"
    }

    fn inputs(&self) -> Vec<Input> {
        inputs()
    }

    fn outputs(&self) -> Vec<Output> {
        outputs()
    }

    fn domain(&self) -> Domain {
        let region = |name, description, sample| Region {
            name,
            description,
            sample,
        };
        Domain {
            regions: vec![
                region(
                    "paper",
                    "Zinchenko's linkage at any crank angle and assembly mode",
                    paper,
                ),
                region(
                    "perturbed",
                    "its dimensions and masses each changed by up to 30 %",
                    perturbed,
                ),
                region(
                    "random",
                    "random lengths (factor 10), pivots placed so that it can be assembled",
                    random,
                ),
                region(
                    "scaled",
                    "the paper's linkage from micrometres to kilometres",
                    scaled,
                ),
                region(
                    "near-dead",
                    "crank angles 1e-1 to 1e-12 rad from a dead position",
                    |d| near(d, 14.426_037_5, 1e-12),
                ),
                region(
                    "near-fold",
                    "crank angles 1e-1 to 1e-9 rad from where two modes merge",
                    |d| near(d, 217.270_876_406, 1e-9),
                ),
                region(
                    "apart",
                    "pivots too far apart for the links: must be refused",
                    apart,
                ),
            ],
            check_points: vec![
                CheckPoint {
                    name: "paper-row-0",
                    input: at_degrees(14.426, 2.0),
                },
                CheckPoint {
                    name: "paper-row-41",
                    input: at_degrees(14.426 + 41.0 * 7.5, 2.0),
                },
            ],
        }
    }

    fn hard(&self) -> Vec<HardCase> {
        HardCase::included(include_str!("../../reference/hard/class-iii.csv"))
    }

    fn admits(&self, x: &[f64]) -> bool {
        x.len() == LENGTH && choices_are_whole(x)
    }

    fn solve(&self, x: &[f64]) -> SolverAnswer {
        match solver_row(x) {
            Err(word) => SolverAnswer::Refuses(word),
            Ok(row) => {
                let (s, r) = (&row.state, &row.reduced);
                let mut all = s.positions.to_array().to_vec();
                all.extend(s.rates.first);
                all.extend(s.rates.second);
                all.extend([
                    r.inertia_kg_m2,
                    r.inertia_derivative_kg_m2,
                    r.moment_n_m,
                    r.moment_derivative_n_m,
                ]);
                SolverAnswer::Values(all)
            }
        }
    }

    fn reference(&self, x: &[Rational], bits: u32) -> ReferenceAnswer {
        if x.len() != LENGTH {
            return ReferenceAnswer::Refuses("layout");
        }
        let Some(linkage) = exact_linkage(x, bits) else {
            return ReferenceAnswer::Refuses("layout");
        };
        let at = match configuration(&linkage, x) {
            Ok(at) => at,
            Err(answer) => return answer,
        };
        match values(&linkage, &at, x) {
            Ok(values) => ReferenceAnswer::Values(Reference {
                values,
                proof: Proof::Bounded(
                    "Krawczyk (1969); Neumaier (1990), Thm 5.1.8; all modes by bisection with a \
                     Taylor bound",
                ),
            }),
            Err(reason) => ReferenceAnswer::Undecided(reason),
        }
    }

    fn conditions(&self, x: &[f64]) -> Option<Vec<f64>> {
        let exact: Option<Vec<Rational>> = x.iter().map(|&v| Rational::from_f64(v)).collect();
        let reference = self.reference(&exact?, BITS_OF_CONDITIONS);
        at_angles(x, &reference)
    }

    fn conditions_beside(&self, x: &[f64], reference: &ReferenceAnswer) -> Option<Vec<f64>> {
        match reference {
            ReferenceAnswer::Undecided(_) => self.conditions(x),
            _ => at_angles(x, reference),
        }
    }

    fn laws(&self) -> Vec<Law> {
        vec![
            Law {
                name: "scale",
                statement: "lengths times 2 leave angles and rates bit for bit the same",
                residual: scale_law,
            },
            Law {
                name: "round-trip",
                statement: "turning the crank by 1e-3 rad and back returns within 1e-12 rad of \
                            conditioning",
                residual: round_trip_law,
            },
        ]
    }
}

fn scale_law(x: &[f64]) -> Option<f64> {
    let a = solver_row(x).ok()?;
    let mut y = x.to_vec();
    for k in (0..11).filter(|&k| k != 6) {
        y[k] *= 2.0;
    }
    let b = solver_row(&y).ok()?;
    let same = a.state.positions == b.state.positions && a.state.rates == b.state.rates;
    Some(if same { 0.0 } else { f64::INFINITY })
}

fn round_trip_law(x: &[f64]) -> Option<f64> {
    let linkage = linkage(x)?;
    let start = solver_row(x).ok()?.state;
    let there = linkage.follow(&start, start.phi1 + 1e-3).ok()?;
    let back = linkage.follow(&there, start.phi1).ok()?;
    let (a, b) = (start.positions.to_array(), back.positions.to_array());
    let moved = a
        .iter()
        .zip(b)
        .fold(0.0f64, |m, (x, y)| m.max((x - y).abs()));
    Some(moved / (1e-12 * start.condition.max(1.0)))
}

/// The paper's dimensions in metres, angle φB, a mode and the recovered masses.
pub(super) fn at_degrees(phi1_deg: f64, mode: f64) -> Vec<f64> {
    let mut x = vec![
        0.10,
        1.04,
        0.60,
        0.64,
        0.485,
        0.22,
        (-39.3f64).to_radians(),
        0.75,
        0.93,
        1.285,
        1.035,
        phi1_deg.to_radians(),
        mode,
        9.81,
    ];
    let bodies = [
        [0.0, 0.0, 0.0, 0.0],
        [10.0, 0.8, 0.5, 0.0],
        [5.0, 0.5, 0.3, 0.0],
        [550.0, 18.0, 0.25, (-12.0f64).to_radians()],
        [3.5, 0.2, 0.2, 0.0],
    ];
    x.extend(bodies.concat());
    x.extend([1.0, 1.0, 1.0]);
    x
}

fn paper(d: &mut Draw) -> Vec<f64> {
    let mut x = at_degrees(0.0, 0.0);
    x[PHI1] = d.uniform(0.0, TAU);
    x[MODE] = d.integer(0, 5) as f64;
    x
}

fn perturbed(d: &mut Draw) -> Vec<f64> {
    let mut x = paper(d);
    for (k, v) in x.iter_mut().enumerate() {
        if k != PHI1 && k != MODE && k < PIVOTS {
            *v *= d.uniform(0.7, 1.3);
        }
    }
    for flag in &mut x[PIVOTS..] {
        *flag = d.integer(0, 1) as f64;
    }
    // A crank with a mass and an inertia of its own.
    x[BODIES] = d.uniform(0.0, 5.0);
    x[BODIES + 1] = d.uniform(0.0, 1.0);
    x[BODIES + 2] = d.uniform(0.0, 0.1);
    x[BODIES + 3] = d.uniform(-3.0, 3.0);
    x
}

fn random(d: &mut Draw) -> Vec<f64> {
    let mut x = perturbed(d);
    for length in &mut x[..6] {
        *length = d.log_uniform(0.1, 1.0);
    }
    x[6] = d.uniform(-3.1, 3.1);
    let phi: [f64; 5] = std::array::from_fn(|_| d.uniform(-3.1, 3.1));
    let end = |l: f64, a: f64| [l * a.cos(), l * a.sin()];
    let arms = [
        end(x[0], phi[0]),
        end(x[1], phi[1]),
        end(x[2], phi[2]),
        end(x[3], phi[3]),
        end(x[4], phi[4]),
        end(x[5], phi[3] + x[6]),
    ];
    for k in 0..2 {
        x[7 + k] = arms[0][k] + arms[1][k] - arms[2][k] - arms[5][k];
        x[9 + k] = x[7 + k] + arms[2][k] + arms[3][k] - arms[4][k];
    }
    x[PHI1] = phi[0];
    x
}

fn scaled(d: &mut Draw) -> Vec<f64> {
    let mut x = paper(d);
    let scale = d.log_uniform(1e-6, 1e3);
    for k in (0..11).filter(|&k| k != 6) {
        x[k] *= scale;
    }
    for i in 0..5 {
        x[BODIES + 4 * i + 2] *= scale;
    }
    x
}

fn near(d: &mut Draw, degrees: f64, closest: f64) -> Vec<f64> {
    let mut x = paper(d);
    let offset = d.log_uniform(closest, 0.1);
    x[PHI1] = degrees.to_radians() + d.signed(offset);
    x
}

fn apart(d: &mut Draw) -> Vec<f64> {
    let mut x = perturbed(d);
    let reach = x[2] + x[3] + x[4];
    let direction = d.uniform(-3.1, 3.1);
    let far = reach * d.uniform(1.001, 3.0);
    x[9] = x[7] + far * direction.cos();
    x[10] = x[8] + far * direction.sin();
    x
}
