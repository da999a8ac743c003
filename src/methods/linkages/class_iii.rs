//! The class-III linkage on a chosen assembly mode: positions, rates and reduced quantities.

use crate::audit::{
    Budget, Domain, Draw, Law, Limit, Output, ReferenceAnswer, Uncertified, largest,
};
use crate::methods::common::{held, output, point, region};
use crate::methods::definition::{Definition, conditions_at_reference, exact, method};
use crate::methods::inputs::{Number, inputs};
use crate::reference::class_iii::{self as reference, Configuration, ExactAngle, Linkage};
use crate::reference::{Ball, Mag, Undecided};
use crate::solvers::class_iii::{self as solver, Geometry, State};
use crate::solvers::reduction::{Body, Masses, MomentOfInertia, Row};
use crate::solvers::units::{Acceleration, Angle, Inertia, Length, Mass};
use rug::Rational;
use std::f64::consts::TAU;

inputs! {
    /// Lengths of the links and places of the pivots.
    pub struct ClassIiiGeometry {
        l1: number "l1", "m";
        l2: number "l2", "m";
        l3: number "l3", "m";
        l4: number "l4", "m";
        l5: number "l5", "m";
        lb: number "lB", "m";
        phi_b: number "phiB", "rad";
        x3: number "x3", "m";
        y3: number "y3", "m";
        x5: number "x5", "m";
        y5: number "y5", "m";
    }
}

impl<'a, T: Number> ClassIiiGeometry<'a, T> {
    /// `l1, l2, l3, l4, l5, lB, phiB, x3, y3, x5, y5`.
    pub fn values(&self) -> [T::Of<'a>; 11] {
        let ClassIiiGeometry {
            l1,
            l2,
            l3,
            l4,
            l5,
            lb,
            phi_b,
            x3,
            y3,
            x5,
            y5,
        } = *self;
        [l1, l2, l3, l4, l5, lb, phi_b, x3, y3, x5, y5]
    }
}

impl ClassIiiGeometry<'_> {
    /// The linkage, as the solver takes it.
    pub(in crate::methods) fn solver(&self) -> Result<solver::ClassIii, &'static str> {
        solver::ClassIii::new(Geometry::from_values(&self.values())).map_err(|e| e.name())
    }

    /// Every length times the factor.
    fn scaled(mut self, factor: f64) -> Self {
        let phi_b = self.phi_b;
        self.numbers_mut().into_iter().for_each(|v| *v *= factor);
        Self { phi_b, ..self }
    }
}

impl ClassIiiGeometry<'_, Rational> {
    /// The geometry, as the reference takes it.
    ///
    /// A link without length has no direction, and a negative length has no meaning: both are
    /// refused.
    pub(in crate::methods) fn exact(&self) -> Result<reference::Geometry, Uncertified> {
        let values = self.values();
        match values[..6].iter().all(|l| l.cmp0().is_gt()) {
            true => Ok(reference::Geometry::from_values(
                &values.map(Rational::clone),
            )),
            false => Err(Uncertified::Refused("not positive")),
        }
    }
}

inputs! {
    /// A class-III linkage with its masses, on an assembly mode at a crank angle.
    pub struct ClassIiiInput {
        geometry: (ClassIiiGeometry);
        phi1: number "phi1", "rad";
        mode: choice "mode (index by phi4, modulo their number)", "1";
        gravity: number "gravity", "m/s^2";
        m1: number "m1", "kg";
        j1: number "J1", "kg m^2";
        r1: number "r1", "m";
        a1: number "a1", "rad";
        m2: number "m2", "kg";
        j2: number "J2", "kg m^2";
        r2: number "r2", "m";
        a2: number "a2", "rad";
        m3: number "m3", "kg";
        j3: number "J3", "kg m^2";
        r3: number "r3", "m";
        a3: number "a3", "rad";
        m4: number "m4", "kg";
        j4: number "J4", "kg m^2";
        r4: number "r4", "m";
        a4: number "a4", "rad";
        m5: number "m5", "kg";
        j5: number "J5", "kg m^2";
        r5: number "r5", "m";
        a5: number "a5", "rad";
        pivot1: choice "pivot1 (1: J1 is about the pivot; 0: about the centre of mass)", "1";
        pivot3: choice "pivot3 (the same of J3)", "1";
        pivot5: choice "pivot5 (the same of J5)", "1";
    }
}

impl<'a, T: Number> ClassIiiInput<'a, T> {
    /// Mass, moment of inertia, radius and angle of the centre of mass of links 1 to 5.
    fn bodies(&self) -> [[T::Of<'a>; 4]; 5] {
        [
            [self.m1, self.j1, self.r1, self.a1],
            [self.m2, self.j2, self.r2, self.a2],
            [self.m3, self.j3, self.r3, self.a3],
            [self.m4, self.j4, self.r4, self.a4],
            [self.m5, self.j5, self.r5, self.a5],
        ]
    }

    fn pivots(&self) -> [T::Of<'a>; 3] {
        [self.pivot1, self.pivot3, self.pivot5]
    }
}

/// The class-III linkage on a chosen assembly mode: angles, rates and reduced quantities.
///
/// A candidate is a `Fn(ClassIiiInput) -> ` 16 values, as `mechaudit describe class-iii` lays them
/// out.
#[derive(Clone, Copy, Debug)]
pub struct ClassIii;

method! {
    ClassIii "class-iii": Fn(ClassIiiInput<'_>), |f, i| f(i)
}

const BITS_OF_CONDITIONS: u32 = 192;

const LINKAGE: Budget = Budget {
    limit: Limit::Conditioned(4.0),
    reason: "the last Newton correction leaves a residual of a few rounding errors in each loop; \
             that is the effect of perturbing each length and angle by a few units",
};
const RATES: Budget = Budget {
    limit: Limit::Conditioned(2.0),
    reason: "rounded once from systems refined on loops that close to double-double; what is left are \
             the roundings of the sines of phi1 and phiB, which perturb these by less than a unit",
};
const REDUCED: Budget = Budget {
    limit: Limit::Conditioned(4.0),
    reason: "five bodies summed from rates that carry the linkage's error",
};

impl ClassIiiInput<'_> {
    /// Returns whether the mode is a whole number and the flags of the pivots are 0 or 1.
    pub(in crate::methods) fn is_whole(&self) -> bool {
        let flag = |v: &f64| *v == 0.0 || *v == 1.0;
        self.mode.fract() == 0.0 && self.pivots().iter().all(flag)
    }

    /// The state that the solver finds.
    pub(in crate::methods) fn state(
        &self,
        linkage: &solver::ClassIii,
    ) -> Result<State, &'static str> {
        let modes = linkage.assembly_modes(Angle::from_rad(self.phi1)).modes;
        if modes.is_empty() {
            return Err("cannot be assembled");
        }
        let mode = modes[self.mode as usize % modes.len()];
        linkage
            .state(Angle::from_rad(self.phi1), mode)
            .map_err(|_| "singular")
    }

    /// The masses, as the solver takes them.
    pub(in crate::methods) fn masses(&self) -> Option<Masses> {
        let about_pivot = about_pivot(self.pivots().map(|flag| flag != 0.0));
        let bodies = self.bodies();
        let bodies = std::array::from_fn(|i| {
            let [mass, inertia, radius, angle] = bodies[i];
            let inertia = Inertia::from_kg_m2(inertia);
            Body {
                mass: Mass::from_kg(mass),
                inertia: match about_pivot[i] {
                    true => MomentOfInertia::AboutPivot(inertia),
                    false => MomentOfInertia::AboutCentreOfMass(inertia),
                },
                radius: Length::from_m(radius),
                angle: Angle::from_rad(angle),
            }
        });
        Masses::new(bodies, Acceleration::from_m_per_s2(self.gravity)).ok()
    }

    /// Positions and reduced quantities that the solver finds.
    fn row(&self) -> Result<Row, &'static str> {
        let linkage = self.geometry.solver()?;
        let masses = self.masses().ok_or("masses")?;
        let state = self.state(&linkage)?;
        Ok(Row {
            reduced: masses.reduce(&state),
            state,
        })
    }
}

/// Links 1, 3 and 5 may have their inertia about the pivot.
fn about_pivot([first, third, fifth]: [bool; 3]) -> [bool; 5] {
    [first, false, third, false, fifth]
}

impl ClassIiiInput<'_, Rational> {
    /// The masses, as the reference takes them.
    pub(in crate::methods) fn exact_masses(&self) -> reference::Masses {
        let about_pivot = about_pivot(self.pivots().map(|flag| *flag != 0));
        let bodies = self.bodies();
        reference::Masses {
            bodies: std::array::from_fn(|i| {
                let [mass, inertia, radius, angle] = bodies[i].map(Rational::clone);
                reference::Body {
                    mass,
                    inertia,
                    about_pivot: about_pivot[i],
                    radius,
                    angle: ExactAngle::Radians(angle),
                }
            }),
            gravity: self.gravity.clone(),
        }
    }

    /// All its numbers.
    pub(in crate::methods) fn to_fractions(self) -> Vec<Rational> {
        let mut all = self.geometry.values().to_vec();
        all.extend([self.phi1, self.mode, self.gravity]);
        all.extend(self.bodies().concat());
        all.extend(self.pivots());
        all.into_iter().cloned().collect()
    }

    /// The configuration that the mode's index selects at the crank angle.
    pub(in crate::methods) fn configuration(
        &self,
        linkage: &Linkage,
        phi1: &Ball,
    ) -> Result<Configuration, Uncertified> {
        let mut modes = linkage.modes(phi1)?;
        if modes.is_empty() {
            return Err(Uncertified::Refused("cannot be assembled"));
        }
        let index = self.mode.to_f64() as usize % modes.len();
        Ok(modes.swap_remove(index).configuration)
    }
}

/// All outputs at an enclosed configuration.
fn values(
    linkage: &Linkage,
    at: &Configuration,
    i: ClassIiiInput<Rational>,
) -> Result<Vec<Ball>, Undecided> {
    let k = linkage.kinematics(at)?;
    let r = linkage.reduce(&k, &i.exact_masses());
    let mut all: Vec<Ball> = Vec::new();
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

/// Why the reference holds.
pub(super) const PROOF: &str =
    "Krawczyk (1969); Neumaier (1990), Thm 5.1.8; all modes by bisection with a Taylor bound";

impl Definition for ClassIii {
    type Input<'a, T: Number> = ClassIiiInput<'a, T>;
    const SUMMARY: &'static str =
        "class-III linkage on one assembly mode: angles, rates, I_n, dI_n/dphi, M_o, dM_o/dphi";
    const SOURCE: &'static str =
        "Zinchenko (2008), eqs (3)-(7) and the velocity and acceleration systems";

    fn outputs() -> Vec<Output> {
        let angles = [
            (["phi2", "phi3", "phi4", "phi5"], "rad", LINKAGE),
            (["phi2'", "phi3'", "phi4'", "phi5'"], "1", RATES),
            (["phi2''", "phi3''", "phi4''", "phi5''"], "1/rad", RATES),
        ];
        let angles =
            angles.map(|(names, unit, budget)| names.map(|name| output(name, unit, budget)));
        let reduced = [
            ("I_n", "kg m^2"),
            ("dI_n/dphi1", "kg m^2"),
            ("M_o", "N m"),
            ("dM_o/dphi1", "N m"),
        ];
        let reduced = reduced.map(|(name, unit)| output(name, unit, REDUCED));
        angles.into_iter().flatten().chain(reduced).collect()
    }

    fn domain() -> Domain {
        Domain {
            regions: vec![
                region(
                    "paper",
                    "Zinchenko's linkage at any crank angle and assembly mode",
                    |d| paper(d).to_vec(),
                ),
                region(
                    "perturbed",
                    "its dimensions and masses each changed by up to 30 %",
                    |d| perturbed(d).to_vec(),
                ),
                region(
                    "random",
                    "random lengths (factor 10), pivots placed so that it can be assembled",
                    |d| random(d).to_vec(),
                ),
                region(
                    "scaled",
                    "the paper's linkage from micrometres to kilometres",
                    |d| scaled(d).to_vec(),
                ),
                region(
                    "near-dead",
                    "crank angles 1e-1 to 1e-12 rad from a dead position",
                    |d| near(d, 14.426_037_5, 1e-12).to_vec(),
                ),
                region(
                    "near-fold",
                    "crank angles 1e-1 to 1e-9 rad from where two modes merge",
                    |d| near(d, 217.270_876_406, 1e-9).to_vec(),
                ),
                region(
                    "apart",
                    "pivots too far apart for the links: must be refused",
                    |d| apart(d).to_vec(),
                ),
                region("coinciding", COINCIDING, |d| changed(d, coincide)),
                region("no-length", NO_LENGTH, |d| changed(d, shorten)),
            ],
            check_points: vec![
                point("paper-row-0", at_degrees(14.426, 2.0).to_vec()),
                point(
                    "paper-row-41",
                    at_degrees(14.426 + 41.0 * 7.5, 2.0).to_vec(),
                ),
            ],
        }
    }

    fn admits(i: Self::Input<'_, f64>) -> bool {
        i.is_whole()
    }

    fn solve(i: Self::Input<'_, f64>) -> Result<Vec<f64>, &'static str> {
        let row = i.row()?;
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
        Ok(all)
    }

    fn reference(i: Self::Input<'_, Rational>, bits: u32) -> Result<ReferenceAnswer, Uncertified> {
        let linkage = Linkage::new(&i.geometry.exact()?, bits);
        let at = i.configuration(&linkage, &Ball::rational(bits, i.phi1))?;
        Ok(ReferenceAnswer::bounded(values(&linkage, &at, i)?, PROOF))
    }

    fn conditions(numbers: &[f64]) -> Option<Vec<f64>> {
        conditions_at_reference::<Self>(numbers, BITS_OF_CONDITIONS)
    }

    /// By implicit differentiation, at the reference's angles.
    fn conditions_at(numbers: &[f64], values: &[Ball]) -> Option<Vec<f64>> {
        let (bits, phi3, phi5) = (values[1].prec(), &values[1], &values[3]);
        let exact = exact(numbers)?;
        let i = ClassIii::unpack(&exact)?;
        let linkage = Linkage::new(&i.geometry.exact().ok()?, bits);
        let phi1 = Ball::rational(bits, i.phi1);
        let at = linkage.placed(&phi1, phi3, phi5);
        let c = linkage.conditions(&phi1, &at, &i.exact_masses())?;
        let all = [c.angles, c.first, c.second, c.reduced].concat();
        Some(all.into_iter().map(Mag::to_f64).collect())
    }

    fn laws() -> Vec<Law> {
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
    let i = ClassIii::unpack(x)?;
    let a = i.row().ok()?;
    let geometry = i.geometry.scaled(2.0);
    let b = ClassIiiInput { geometry, ..i }.row().ok()?;
    held(same_turns(&a.state, &b.state))
}

/// Returns whether angles and rates are the same.
fn same_turns(a: &State, b: &State) -> bool {
    a.positions == b.positions && a.rates == b.rates
}

fn round_trip_law(x: &[f64]) -> Option<f64> {
    let i = ClassIii::unpack(x)?;
    let linkage = i.geometry.solver().ok()?;
    let start = i.row().ok()?.state;
    let there = linkage
        .follow(&start, Angle::from_rad(start.phi1 + 1e-3))
        .ok()?;
    let back = linkage.follow(&there, Angle::from_rad(start.phi1)).ok()?;
    let (a, b) = (start.positions.to_array(), back.positions.to_array());
    let moved = largest(a.iter().zip(b).map(|(x, y)| (x - y).abs()));
    Some(moved / (1e-12 * start.condition))
}

/// The paper's dimensions in metres, angle φB, a mode and the recovered masses.
pub(in crate::methods) fn at_degrees(phi1_deg: f64, mode: f64) -> ClassIiiInput<'static> {
    #[rustfmt::skip]
    let input = ClassIiiInput {
        geometry: ClassIiiGeometry {
            l1: 0.10, l2: 1.04, l3: 0.60, l4: 0.64, l5: 0.485,
            lb: 0.22, phi_b: (-39.3f64).to_radians(),
            x3: 0.75, y3: 0.93, x5: 1.285, y5: 1.035,
        },
        phi1: phi1_deg.to_radians(),
        mode,
        gravity: 9.81,
        m1: 0.0, j1: 0.0, r1: 0.0, a1: 0.0,
        m2: 10.0, j2: 0.8, r2: 0.5, a2: 0.0,
        m3: 5.0, j3: 0.5, r3: 0.3, a3: 0.0,
        m4: 550.0, j4: 18.0, r4: 0.25, a4: (-12.0f64).to_radians(),
        m5: 3.5, j5: 0.2, r5: 0.2, a5: 0.0,
        pivot1: 1.0, pivot3: 1.0, pivot5: 1.0,
    };
    input
}

fn paper(d: &mut Draw) -> ClassIiiInput<'static> {
    let phi1 = d.uniform(0.0, TAU);
    let mode = d.integer(0, 5) as f64;
    ClassIiiInput {
        phi1,
        ..at_degrees(0.0, mode)
    }
}

fn perturbed(d: &mut Draw) -> ClassIiiInput<'static> {
    let mut i = paper(d);
    for (v, field) in i.numbers_mut().into_iter().zip(ClassIii::fields()) {
        if field.is_data && field.input.name != "phi1" {
            *v *= d.uniform(0.7, 1.3);
        }
    }
    for flag in [&mut i.pivot1, &mut i.pivot3, &mut i.pivot5] {
        *flag = d.integer(0, 1) as f64;
    }
    // A crank with a mass and an inertia of its own.
    i.m1 = d.uniform(0.0, 5.0);
    i.j1 = d.uniform(0.0, 1.0);
    i.r1 = d.uniform(0.0, 0.1);
    i.a1 = d.uniform(-3.0, 3.0);
    i
}

fn random(d: &mut Draw) -> ClassIiiInput<'static> {
    let mut i = perturbed(d);
    let g = &mut i.geometry;
    for length in [
        &mut g.l1, &mut g.l2, &mut g.l3, &mut g.l4, &mut g.l5, &mut g.lb,
    ] {
        *length = d.log_uniform(0.1, 1.0);
    }
    g.phi_b = d.uniform(-3.1, 3.1);
    let phi: [f64; 5] = std::array::from_fn(|_| d.uniform(-3.1, 3.1));
    let end = |l: f64, a: f64| [l * libm::cos(a), l * libm::sin(a)];
    let [a1, a2, a3, a4, a5] =
        [(g.l1, 0), (g.l2, 1), (g.l3, 2), (g.l4, 3), (g.l5, 4)].map(|(l, k)| end(l, phi[k]));
    let b = end(g.lb, phi[3] + g.phi_b);
    let o3 = [0, 1].map(|k| a1[k] + a2[k] - a3[k] - b[k]);
    [g.x3, g.y3] = o3;
    [g.x5, g.y5] = [0, 1].map(|k| o3[k] + a3[k] + a4[k] - a5[k]);
    i.phi1 = phi[0];
    i
}

/// A random linkage whose geometry is changed.
fn changed(d: &mut Draw, change: fn(&mut Draw, &mut ClassIiiGeometry)) -> Vec<f64> {
    let mut i = random(d);
    change(d, &mut i.geometry);
    i.to_vec()
}

/// The region of [`coincide`].
pub(super) const COINCIDING: &str =
    "O3 on O5, B on D, both, O3 or O5 on O1, or B, C and D on one line; often not to be assembled";

/// Brings joints or pivots to one place or on one line.
pub(super) fn coincide(d: &mut Draw, g: &mut ClassIiiGeometry) {
    let chosen = d.integer(0, 5);
    if matches!(chosen, 0 | 1) {
        (g.x5, g.y5) = (g.x3, g.y3);
    }
    if matches!(chosen, 1 | 2) {
        (g.lb, g.phi_b) = (g.l4, 0.0);
    }
    match chosen {
        3 => (g.x3, g.y3) = (0.0, 0.0),
        4 => (g.x5, g.y5) = (0.0, 0.0),
        5 => g.phi_b = 0.0,
        _ => {}
    }
}

/// The region of [`shorten`].
pub(super) const NO_LENGTH: &str = "one length is zero or negative: must be refused";

/// Makes a length zero or negative.
pub(super) fn shorten(d: &mut Draw, g: &mut ClassIiiGeometry) {
    let lengths = [
        &mut g.l1, &mut g.l2, &mut g.l3, &mut g.l4, &mut g.l5, &mut g.lb,
    ];
    *lengths[d.integer(0, 5)] *= d.integer(0, 1) as f64 - 1.0;
}

fn scaled(d: &mut Draw) -> ClassIiiInput<'static> {
    let mut i = paper(d);
    let scale = d.log_uniform(1e-6, 1e3);
    i.geometry = i.geometry.scaled(scale);
    for radius in [&mut i.r1, &mut i.r2, &mut i.r3, &mut i.r4, &mut i.r5] {
        *radius *= scale;
    }
    i
}

fn near(d: &mut Draw, degrees: f64, closest: f64) -> ClassIiiInput<'static> {
    let i = paper(d);
    let offset = d.log_uniform(closest, 0.1);
    let phi1 = degrees.to_radians() + d.signed(offset);
    ClassIiiInput { phi1, ..i }
}

fn apart(d: &mut Draw) -> ClassIiiInput<'static> {
    let mut i = perturbed(d);
    let g = &mut i.geometry;
    let reach = g.l3 + g.l4 + g.l5;
    let direction = d.uniform(-3.1, 3.1);
    let far = reach * d.uniform(1.001, 3.0);
    g.x5 = g.x3 + far * libm::cos(direction);
    g.y5 = g.y3 + far * libm::sin(direction);
    i
}

#[cfg(test)]
mod tests;
