//! One group as polynomial equations.
//!
//! With the pose of a body written as the complex numbers p (origin) and z = e^{iθ}, a pin is
//! linear in them: `p_a + c z_a = p_b + d z_b`; so is the tie of two angles. Eliminating these
//! leaves n complex unknowns x. What remains are `z z̄ = 1` for each free angle and
//! `Im(conj(u z_a) D) = 0` for each point on a line, all bilinear in `(1, x)` and `(1, x̄)`:
//!
//! ```text
//! (1, x)ᵀ M_k (1, x̄) = 0,   k = 1 … 2n,   M_k Hermitian.
//! ```
//!
//! These are the isotropic coordinates of Wampler (*Solving the kinematics of planar mechanisms by
//! Dixon determinant and a complex-plane formulation*, J. Mech. Des. 123 (2001)). With x̄ replaced
//! by an independent y there are at most C(2n, n) isolated solutions, by Bézout's theorem for two
//! groups of variables: 2 for every dyad, 6 for a triad.

use super::chain::{Block, Chain, Closure, Entry, Rail, Spot, Travel};
use super::plane::{cross, dot, wrapped};
use super::pose::Pose;
use num_complex::Complex64;

/// Coefficients of `(1, x)`.
type Form = Vec<Complex64>;

/// A square matrix over `(1, x)` and `(1, y)`.
pub(super) type Bilinear = Vec<Vec<Complex64>>;

/// The equations of one group.
#[derive(Clone, Debug)]
pub(super) struct Isotropic {
    /// Number of complex unknowns.
    pub n: usize,
    /// Hermitian matrices.
    pub forms: Vec<Bilinear>,
    /// For each body of the group, p and z.
    bodies: Vec<[Form; 2]>,
}

/// Why a group has no such equations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum NoForms {
    /// A gear or rack among its unknowns.
    Gears,
    /// The linear equations contradict one another: no position.
    Contradiction,
    /// Not twice as many forms as unknowns: the dimensions are special.
    Special,
}

const ZERO: Complex64 = Complex64::new(0.0, 0.0);
const ONE: Complex64 = Complex64::new(1.0, 0.0);

/// Describes what is gathered about a group.
struct Gathering<'a> {
    chain: &'a Chain,
    block: &'a Block,
    pose: &'a Pose,
    /// Linear equations over the p and z of the group's bodies, the right side last.
    rows: Vec<Form>,
    lines: Vec<(Rail, Spot)>,
    /// Angles that a gear or rack gives.
    geared: Vec<usize>,
}

impl Gathering<'_> {
    fn member(&self, body: usize) -> Option<usize> {
        self.block.bodies.iter().position(|&b| b == body)
    }

    fn known(&self, body: usize) -> bool {
        self.member(body).is_none()
    }

    fn blank(&self) -> Form {
        vec![ZERO; 2 * self.block.bodies.len() + 1]
    }

    /// Adds `factor (p + at z)` of a body to a row.
    fn add(&self, row: &mut Form, spot: Spot, factor: f64) {
        match self.member(spot.body) {
            Some(k) => {
                row[2 * k] += factor;
                row[2 * k + 1] += spot.at * factor;
            }
            None => {
                let last = row.len() - 1;
                row[last] -= self.pose.at(spot) * factor;
            }
        }
    }

    fn pin(&mut self, a: Spot, b: Spot) {
        let mut row = self.blank();
        self.add(&mut row, a, 1.0);
        self.add(&mut row, b, -1.0);
        self.rows.push(row);
    }

    /// `z_b = turn z_a`.
    fn tie(&mut self, a: usize, b: usize, turn: Complex64) {
        let mut row = self.blank();
        let last = row.len() - 1;
        for (body, factor) in [(b, ONE), (a, -turn)] {
            match self.member(body) {
                Some(k) => row[2 * k + 1] += factor,
                None => row[last] -= factor * self.pose.e[body],
            }
        }
        self.rows.push(row);
    }

    fn geared_angle(&mut self, body: usize, angle: f64) {
        let mut row = self.blank();
        let last = row.len() - 1;
        if let Some(k) = self.member(body) {
            row[2 * k + 1] = ONE;
            row[last] = Complex64::from_polar(1.0, angle);
            self.rows.push(row);
            self.geared.push(body);
        }
    }

    fn entries(&mut self) {
        for &body in &self.block.bodies {
            match self.chain.entries[body] {
                Entry::Ground => {}
                Entry::Pin { on, own } => self.pin(Spot { body, at: own }, on),
                Entry::OnRail { rail, own, travel } => {
                    self.on_rail(rail, Spot { body, at: own }, travel);
                }
                Entry::WithRail {
                    on,
                    at,
                    along,
                    travel,
                } => {
                    self.on_rail(Rail { body, at, along }, on, travel);
                }
            }
        }
    }

    fn on_rail(&mut self, rail: Rail, point: Spot, travel: Travel) {
        match travel {
            Travel::Drive => self.pin(point, rail.at(self.pose.drive)),
            Travel::Unknown(_) => self.lines.push((rail, point)),
        }
    }

    fn closures(&mut self) -> Result<(), NoForms> {
        let angle = |g: &Self, b: usize| g.pose.angle(g.chain, b);
        for closure in &self.chain.closures[self.block.closures.clone()] {
            match *closure {
                Closure::Pin { a, b } => self.pin(a, b),
                Closure::Line { rail, point } => self.lines.push((rail, point)),
                // Among the ties of the chain.
                Closure::Tie { .. } => {}
                Closure::Gears {
                    wheels: [a, b],
                    carrier: c,
                    ratio,
                    phase,
                } => {
                    if self.known(c) && self.known(a) {
                        let (a, c) = (angle(self, a), angle(self, c));
                        self.geared_angle(b, c + ratio * (a - c) + phase);
                    } else if self.known(c) && self.known(b) {
                        let (b, c) = (angle(self, b), angle(self, c));
                        self.geared_angle(a, c + (b - c - phase) / ratio);
                    } else {
                        return Err(NoForms::Gears);
                    }
                }
                Closure::Rack {
                    rail,
                    point,
                    wheel,
                    radius,
                    phase,
                } => {
                    if self.known(rail.body) && self.known(point.body) {
                        let (u, d) = self.pose.along(rail, point);
                        let turn = (dot(u, d) - phase) / radius;
                        self.geared_angle(wheel, angle(self, rail.body) + turn);
                    } else if self.known(wheel) && self.known(rail.body) {
                        let turn = angle(self, wheel) - angle(self, rail.body);
                        self.lines
                            .retain(|(_, p)| p.body != point.body || p.at != point.at);
                        self.pin(point, rail.at(radius * turn + phase));
                    } else {
                        return Err(NoForms::Gears);
                    }
                }
            }
        }
        Ok(())
    }

    /// The ties with a body of the group and none of a later one.
    fn ties(&mut self) {
        let own = |g: &Self, b: usize| g.member(b).is_some();
        for t in &self.chain.ties {
            let placed = |b: usize| own(self, b) || self.before(b);
            if (own(self, t.a) || own(self, t.b)) && placed(t.a) && placed(t.b) {
                let turn = Complex64::from_polar(1.0, t.offset + t.drive * self.pose.drive);
                self.tie(t.a, t.b, turn);
            }
        }
    }

    /// Returns whether a body is known before this group.
    fn before(&self, body: usize) -> bool {
        self.chain.precedes(body, self.block.bodies[0])
    }

    /// One body of each set of bodies whose angles are tied to one another and to no known one.
    fn free_angles(&self) -> Vec<usize> {
        let n = self.block.bodies.len();
        let mut class: Vec<usize> = (0..n).collect();
        let mut given = vec![false; n];
        let merge = |class: &mut Vec<usize>, a: usize, b: usize| {
            let (from, to) = (class[a], class[b]);
            class
                .iter_mut()
                .filter(|c| **c == from)
                .for_each(|c| *c = to);
        };
        for t in &self.chain.ties {
            match (self.member(t.a), self.member(t.b)) {
                (Some(a), Some(b)) => merge(&mut class, a, b),
                (Some(a), None) if self.before(t.b) => given[a] = true,
                (None, Some(b)) if self.before(t.a) => given[b] = true,
                _ => {}
            }
        }
        for &b in &self.geared {
            self.member(b).into_iter().for_each(|k| given[k] = true);
        }
        let known: Vec<usize> = (0..n).filter(|&k| given[k]).map(|k| class[k]).collect();
        (0..n)
            .filter(|&k| class[k] == k && !known.contains(&k))
            .collect()
    }
}

impl Isotropic {
    /// The equations of a group whose predecessors are placed in `pose`.
    pub(super) fn new(chain: &Chain, block: &Block, pose: &Pose) -> Result<Isotropic, NoForms> {
        let mut g = Gathering {
            chain,
            block,
            pose,
            rows: Vec::new(),
            lines: Vec::new(),
            geared: Vec::new(),
        };
        g.entries();
        g.closures()?;
        g.ties();
        let variables = 2 * block.bodies.len();
        let (n, solved) = eliminate(&mut g.rows, variables).ok_or(NoForms::Contradiction)?;
        let bodies: Vec<[Form; 2]> = solved
            .chunks(2)
            .map(|pair| [pair[0].clone(), pair[1].clone()])
            .collect();
        let constant = |z: Complex64| -> Form {
            let mut form = vec![ZERO; n + 1];
            form[0] = z;
            form
        };
        let pose_of = |body: usize| match g.member(body) {
            Some(k) => bodies[k].clone(),
            None => [constant(pose.p[body]), constant(pose.e[body])],
        };
        let at = |s: Spot| -> Form {
            let [p, z] = pose_of(s.body);
            p.iter().zip(&z).map(|(p, z)| p + z * s.at).collect()
        };
        let along = |rail: Rail, point: Spot| -> [Form; 2] {
            let [_, z] = pose_of(rail.body);
            let from = at(rail.at(0.0));
            let d = at(point).iter().zip(&from).map(|(a, b)| a - b).collect();
            [z.iter().map(|z| z * rail.along).collect(), d]
        };
        let mut forms = Vec::new();
        for k in g.free_angles() {
            let z = &bodies[k][1];
            let mut m = outer(z, z, ONE);
            m[0][0] -= 1.0;
            forms.push(m);
        }
        for &(rail, point) in &g.lines {
            let [u, d] = along(rail, point);
            // Twice the imaginary part, times i.
            let i = Complex64::i();
            forms.push(sum(outer(&d, &u, i), outer(&u, &d, -i)));
        }
        match forms.len() == 2 * n {
            true => Ok(Isotropic { n, forms, bodies }),
            false => Err(NoForms::Special),
        }
    }

    /// The unknowns of the group for x, into the pose, whose bodies of the group are then placed.
    pub(super) fn settle(&self, chain: &Chain, block: &Block, pose: &mut Pose, x: &[Complex64]) {
        let value = |form: &Form| -> Complex64 {
            form[0]
                + form[1..]
                    .iter()
                    .zip(x)
                    .map(|(a, b)| a * b)
                    .sum::<Complex64>()
        };
        for (k, &body) in block.bodies.iter().enumerate() {
            let [p, z] = [0, 1].map(|i| value(&self.bodies[k][i]));
            pose.p[body] = p;
            pose.e[body] = z / z.norm();
        }
        for &body in &block.bodies {
            let t = chain.turns[body];
            if let Some(k) = t.unknown.filter(|k| block.unknowns.contains(k)) {
                let angle = pose.e[body].arg() - t.offset - t.drive * pose.drive;
                pose.u[k] = wrapped(angle);
            }
            let (rail, point, travel) = match chain.entries[body] {
                Entry::OnRail { rail, own, travel } => (rail, Spot { body, at: own }, travel),
                Entry::WithRail {
                    on,
                    at,
                    along,
                    travel,
                } => (Rail { body, at, along }, on, travel),
                _ => continue,
            };
            if let Travel::Unknown(k) = travel {
                let (u, d) = pose.along(rail, point);
                pose.u[k] = dot(u, d);
                debug_assert!(cross(u, d).is_finite() || !d.is_finite());
            }
        }
        pose.place(chain, &block.placed);
    }
}

/// `factor a bᴴ`.
fn outer(a: &Form, b: &Form, factor: Complex64) -> Bilinear {
    a.iter()
        .map(|x| b.iter().map(|y| x * y.conj() * factor).collect())
        .collect()
}

fn sum(mut a: Bilinear, b: Bilinear) -> Bilinear {
    for (r, s) in a.iter_mut().zip(b) {
        r.iter_mut().zip(s).for_each(|(x, y)| *x += y);
    }
    a
}

/// Solves linear equations (right side last) by Gauss–Jordan elimination with full pivoting: the
/// number of free variables and every variable as a form of them; `None` if they contradict one
/// another.
fn eliminate(rows: &mut [Form], variables: usize) -> Option<(usize, Vec<Form>)> {
    const TINY: f64 = 1e-12;
    let size = |z: &Complex64| z.re.abs() + z.im.abs();
    let mut pivots: Vec<usize> = Vec::new();
    for r in 0..rows.len() {
        let mut best = (0.0, r, 0);
        for (i, row) in rows.iter().enumerate().skip(r) {
            for (c, z) in row[..variables].iter().enumerate() {
                if size(z) > best.0 {
                    best = (size(z), i, c);
                }
            }
        }
        let (largest, i, c) = best;
        if largest <= TINY {
            let rest = rows[r..].iter().map(|row| size(&row[variables]));
            if rest.fold(0.0, f64::max) > 1e-9 {
                return None;
            }
            break;
        }
        rows.swap(r, i);
        let inverse = rows[r][c].inv();
        rows[r].iter_mut().for_each(|z| *z *= inverse);
        let pivot = rows[r].clone();
        for (k, row) in rows.iter_mut().enumerate() {
            let factor = row[c];
            if k != r && factor != ZERO {
                row.iter_mut()
                    .zip(&pivot)
                    .for_each(|(z, p)| *z -= factor * p);
                row[c] = ZERO;
            }
        }
        pivots.push(c);
    }
    let free: Vec<usize> = (0..variables).filter(|c| !pivots.contains(c)).collect();
    let n = free.len();
    let forms = (0..variables).map(|v| {
        let mut form = vec![ZERO; n + 1];
        match pivots.iter().position(|&c| c == v) {
            Some(r) => {
                form[0] = rows[r][variables];
                free.iter()
                    .enumerate()
                    .for_each(|(k, &c)| form[k + 1] = -rows[r][c]);
            }
            None => free
                .iter()
                .enumerate()
                .filter(|f| *f.1 == v)
                .for_each(|f| form[f.0 + 1] = ONE),
        }
        form
    });
    Some((n, forms.collect()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{PI, TAU};

    #[test]
    fn angles_are_wrapped_into_a_half_open_turn() {
        for (angle, due) in [
            (-PI, PI),
            (PI, PI),
            (3.0 * PI, PI),
            (-3.0, -3.0),
            (3.0, 3.0),
            (TAU + 0.5, 0.5),
            (-TAU - 0.5, -0.5),
            (4.0, 4.0 - TAU),
        ] {
            assert!((wrapped(angle) - due).abs() < 1e-14, "{angle}");
        }
    }

    fn form(x: &[f64]) -> Form {
        x.iter().map(|&x| Complex64::new(x, 0.0)).collect()
    }

    /// x + y = 3 with another row: independent, the same once more, or contradicting it by so much.
    #[test]
    fn linear_equations_are_solved_or_contradict() {
        let first = form(&[1.0, 1.0, 3.0]);
        let (n, found) = eliminate(&mut [first.clone(), form(&[1.0, -1.0, 1.0])], 2).unwrap();
        assert_eq!((n, found), (0, vec![form(&[2.0]), form(&[1.0])]));
        for (off, solved) in [
            (0.0, true),
            (0.9e-9, true),
            (1.1e-9, false),
            (-1.1e-9, false),
            (0.5, false),
        ] {
            let rows = &mut [first.clone(), form(&[1.0, 1.0, 3.0 + off])];
            match eliminate(rows, 2) {
                Some((n, found)) => {
                    assert!(solved && n == 1);
                    // One is free, the other three less it.
                    let both = [form(&[0.0, 1.0]), form(&[3.0, -1.0])];
                    let near =
                        |a: &Form, b: &Form| a.iter().zip(b).all(|(a, b)| (a - b).norm() < 1e-8);
                    assert!((0..2).all(|k| both.iter().any(|b| near(&found[k], b))));
                    assert!(!near(&found[0], &found[1]));
                }
                None => assert!(!solved, "{off}"),
            }
        }
        // A rest of 1e-12 is no equation; a little more is.
        let (n, _) = eliminate(&mut [form(&[0.9e-12, 0.0, 0.0])], 2).unwrap();
        assert_eq!(n, 2);
        let (n, found) = eliminate(&mut [form(&[1.1e-12, 0.0, 2.2e-12])], 2).unwrap();
        assert!(n == 1 && (found[0][0].re - 2.0).abs() < 1e-12);
    }
}
