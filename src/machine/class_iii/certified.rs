//! Rows of certified decimals: exact input to the reference, precision raised until every digit
//! asked for is proved.

use super::Linkage as Description;
use crate::machine::first_bits;
use crate::reference::class_iii::{Configuration, ExactAngle, Kinematics, Linkage};
use crate::reference::{Ball, ComplexBall};
use crate::solvers::class_iii::State;
use rug::{Float, Rational};

/// A digit still open at this many times the first precision stays undecided.
const RAISED_AT_MOST: u32 = 16;

/// Follows a branch with proof and writes certified decimals.
///
/// ```
/// use mechaudit_cli::machine::{class_iii, Linkage, Source};
/// let source = Source::toml(include_str!(concat!(
///     env!("CARGO_MANIFEST_DIR"), "/../../examples/sand-screen.toml"
/// )));
/// let Linkage::ClassIii(linkage) = Linkage::read(&source)? else { unreachable!() };
/// let start = linkage.start_degrees().unwrap();
/// let branch = class_iii::choose(&linkage.solver, &start, None, &linkage.start)?;
/// let mut certifier = class_iii::Certifier::new(&linkage, 30);
/// let position = certifier.advance(&start, &branch.start).expect("proved");
/// let digits = certifier.values(&start, &position);
/// let phi2 = digits[0].as_deref().expect("30 digits");
/// let near = class_iii::values(&linkage, &branch.start)[0];
/// assert!((phi2.parse::<f64>()? - near).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Certifier<'a> {
    description: &'a Description,
    digits: usize,
    linkage: Linkage,
    /// Where the branch has been followed to.
    here: Option<(ExactAngle, Configuration)>,
}

impl<'a> Certifier<'a> {
    /// For `digits` significant digits of every value.
    pub fn new(description: &'a Description, digits: u32) -> Certifier<'a> {
        let bits = first_bits(digits);
        Certifier {
            description,
            digits: digits as usize,
            linkage: Linkage::new(&description.exact, bits.max(128)),
            here: None,
        }
    }

    /// The position at the crank angle on the branch that the last call left off at; at the first
    /// call, the one enclosed near `state`, which is also the first guess for the others.
    ///
    /// `None` where no position near it, or no connection to the last one, could be proved.
    pub fn advance(&mut self, degrees: &Rational, state: &State) -> Option<Configuration> {
        let angle = ExactAngle::Degrees(degrees.clone());
        let most = self.linkage.bits() * RAISED_AT_MOST;
        loop {
            let bits = self.linkage.bits();
            let phi = angle.to_ball(bits);
            let [_, _, [cx, cy], [dx, dy]] = state.joints();
            let found = match &self.here {
                None => self.linkage.near(&phi, [cx, cy], [dx, dy]),
                Some((at, from)) => {
                    let guess = [cx, cy, dx, dy].map(|x| Float::with_val(bits, x));
                    let at = at.to_ball(bits);
                    self.linkage.follow_from(from, &at, &phi, Some(guess))
                }
            };
            if let Some(found) = found {
                self.here = Some((angle, found.clone()));
                return Some(found);
            }
            if 2 * bits > most {
                return None;
            }
            let finer = Linkage::new(&self.description.exact, 2 * bits);
            if let Some((at, from)) = &mut self.here
                && let Some(better) = refined(&finer, at, from)
            {
                *from = better;
            }
            self.linkage = finer;
        }
    }

    /// Forgets the branch: the next position is enclosed near its state alone.
    pub fn lift(&mut self) {
        self.here = None;
    }

    /// The values of a row at a position, from the column `phi2_deg` on, each with the digits
    /// asked for; `None` where they could not be proved.
    pub fn values(&self, at: &Rational, q: &Configuration) -> Vec<Option<String>> {
        let angle = ExactAngle::Degrees(at.clone());
        let mut digits: Vec<Option<String>> = Vec::new();
        let mut q = q.clone();
        let mut finer: Option<Linkage> = None;
        loop {
            let linkage = finer.as_ref().unwrap_or(&self.linkage);
            if let Some(values) = self.enclosed(linkage, &q) {
                // Finer balls have the digits that coarser ones had.
                digits = values.iter().map(|x| x.to_decimal(self.digits)).collect();
                if digits.iter().all(Option::is_some) {
                    break;
                }
            }
            let bits = 2 * linkage.bits();
            if bits > RAISED_AT_MOST * self.linkage.bits() {
                break;
            }
            let next = Linkage::new(&self.description.exact, bits);
            // Where that fails the coarser position still holds, and a later precision may do.
            if let Some(better) = refined(&next, &angle, &q) {
                q = better;
            }
            finer = Some(next);
        }
        let due = super::names(self.description, true).len() - 2;
        digits.resize(due, None);
        digits
    }

    /// The values of a row in the order of the columns, enclosed.
    fn enclosed(&self, linkage: &Linkage, q: &Configuration) -> Option<Vec<Ball>> {
        let bits = linkage.bits();
        let k = linkage.kinematics(q).ok()?;
        let per_radian = &Ball::integer(bits, 180) / &Ball::pi(bits);
        let mut all: Vec<Ball> = k.angles.iter().map(|a| a * &per_radian).collect();
        match &self.description.crank {
            None => {
                all.extend(k.first.iter().cloned());
                all.extend(k.second.iter().cloned());
            }
            Some(crank) => {
                let (w, e) = (crank.omega.to_ball(bits), crank.epsilon.to_ball(bits));
                all.extend(k.first.iter().map(|f| f * &w));
                let w2 = w.square();
                let epsilon = |i: usize| &k.second[i] * &w2 + &k.first[i] * &e;
                all.extend((0..4).map(epsilon));
            }
        }
        if let Some(masses) = &self.description.masses {
            let r = linkage.reduce(&k, &masses.exact);
            all.extend([
                r.inertia,
                r.inertia_derivative,
                r.moment,
                r.moment_derivative,
            ]);
        }
        let (determinant, pressure) = self.transmission(bits, &k);
        all.push(determinant);
        all.push(&pressure * &per_radian);
        Some(all)
    }

    /// The determinant of the loop equations and the pressure angle in radians.
    ///
    /// With the links as vectors, `det J = (v4b × v2)(v3 × v5) − (v3 × v2)(v4 × v5)`, and B moves
    /// along `v3⊥ (v5 × v4) + v4b⊥ (v3 × v5)` when the crank's loop is cut at B.
    fn transmission(&self, bits: u32, k: &Kinematics) -> (Ball, Ball) {
        let g = &self.description.exact;
        let point = |p: &[Rational; 2]| {
            ComplexBall::new(Ball::rational(bits, &p[0]), Ball::rational(bits, &p[1]))
        };
        let [a, b, c, d] = &k.joints;
        let v2 = &b.r - &a.r;
        let v3 = &c.r - &point(&g.o3);
        let v4 = &d.r - &c.r;
        let v4b = &b.r - &c.r;
        let v5 = &d.r - &point(&g.o5);
        let (c35, c45) = (v3.cross(&v5), v4.cross(&v5));
        let determinant = &v4b.cross(&v2) * &c35 - &v3.cross(&v2) * &c45;
        let path = &v4b.turned().scaled(&c35) - &v3.turned().scaled(&c45);
        let across = v2.cross(&path).abs();
        let pressure = across.atan2(&v2.dot(&path).abs());
        (determinant, pressure)
    }
}

/// The same position at a higher precision; `None` if it cannot be shown to be the same.
fn refined(linkage: &Linkage, angle: &ExactAngle, q: &Configuration) -> Option<Configuration> {
    let near = |b: &Ball| b.to_f64();
    let (c, d) = (&q.c, &q.d);
    let found = linkage.near(
        &angle.to_ball(linkage.bits()),
        [near(&c.re), near(&c.im)],
        [near(&d.re), near(&d.im)],
    )?;
    // The coarse enclosure holds one position only, so whatever lies in it is that one.
    let inside = [
        (&c.re, &found.c.re),
        (&c.im, &found.c.im),
        (&d.re, &found.d.re),
        (&d.im, &found.d.im),
    ];
    inside
        .iter()
        .all(|(coarse, fine)| coarse.contains_ball(fine))
        .then_some(found)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::{Linkage as File, Source};

    /// A position at a higher precision is the same one only where all four coordinates lie in the
    /// old ones.
    #[test]
    fn another_position_is_not_the_same_one_refined() {
        let text = include_str!("../../../examples/sand-screen.toml");
        let File::ClassIii(file) = File::read(&Source::toml(text)).unwrap() else {
            unreachable!("of class III");
        };
        let at = file.start_degrees().unwrap();
        let branch = super::super::choose(&file.solver, &at, None, &file.start).unwrap();
        let angle = ExactAngle::Degrees(at);
        let [_, _, c, d] = branch.start.joints();
        let q = Linkage::new(&file.exact, 128)
            .near(&angle.to_ball(128), c, d)
            .unwrap();
        let finer = Linkage::new(&file.exact, 256);
        let same = refined(&finer, &angle, &q).unwrap();
        assert!(q.c.re.contains_ball(&same.c.re) && q.d.im.contains_ball(&same.d.im));
        let beside = |x: &Ball| x + &Ball::rational(128, &Rational::from((1, 1_000_000)));
        for k in 0..4 {
            let mut other = q.clone();
            let moved = match k {
                0 => &mut other.c.re,
                1 => &mut other.c.im,
                2 => &mut other.d.re,
                _ => &mut other.d.im,
            };
            *moved = beside(moved);
            assert!(refined(&finer, &angle, &other).is_none(), "coordinate {k}");
        }
    }

    /// A position of another mode is not taken for the next of the branch, until the branch is
    /// left.
    #[test]
    fn a_branch_is_not_left_for_another_mode() {
        let text = include_str!("../../../examples/sand-screen.toml");
        let File::ClassIii(file) = File::read(&Source::toml(text)).unwrap() else {
            unreachable!("of class III");
        };
        let [here, next] = [15, 16].map(Rational::from);
        let at = |degrees: &Rational, mode: usize| {
            super::super::choose(&file.solver, degrees, Some(mode), &file.start)
                .unwrap()
                .start
        };
        let phi4 = |q: &Configuration, degrees: &Rational, certifier: &Certifier| {
            let values = certifier.values(degrees, q);
            values[2].as_ref().unwrap().parse::<f64>().unwrap()
        };
        let (ours, other) = (at(&next, 2), at(&next, 0));
        let mut certifier = Certifier::new(&file, 15);
        certifier.advance(&here, &at(&here, 2)).unwrap();
        for due in [&ours, &other] {
            let found = certifier.advance(&next, &other).unwrap();
            let off = phi4(&found, &next, &certifier) - due.positions.phi4.to_degrees();
            assert!((off / 360.0 - (off / 360.0).round()).abs() < 1e-12, "{off}");
            certifier.lift();
        }
    }
}
