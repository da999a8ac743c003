//! Rows of certified decimals: exact input to the reference, precision raised until every digit
//! asked for is proved.

use super::linkage_file::Linkage as Description;
use super::rows::Cell;
use mechaudit::reference::class_iii::{Configuration, ExactAngle, Kinematics, Linkage};
use mechaudit::reference::{Ball, ComplexBall};
use mechaudit::solvers::class_iii::State;
use rug::{Float, Integer, Rational};

/// A digit still open at this many times the first precision stays undecided.
const RAISED_AT_MOST: u32 = 16;

/// Follows a branch with proof and writes certified decimals.
pub struct Certifier<'a> {
    description: &'a Description,
    digits: usize,
    linkage: Linkage,
    /// Where the branch has been followed to.
    here: Option<(ExactAngle, Configuration)>,
}

impl<'a> Certifier<'a> {
    pub fn new(description: &'a Description, digits: u32) -> Certifier<'a> {
        let bits = (f64::from(digits) * std::f64::consts::LOG2_10).ceil() as u32 + 64;
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
            let [_, _, c, d] = state.joints();
            let found = match &self.here {
                None => self.linkage.near(&phi, c, d),
                Some((at, from)) => {
                    let guess = [c[0], c[1], d[0], d[1]].map(|x| Float::with_val(bits, x));
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
            if let Some((at, from)) = self.here.take() {
                let from = refined(&finer, &at, &from)?;
                self.here = Some((at, from));
            }
            self.linkage = finer;
        }
    }

    /// Forgets the branch: the next position is enclosed near its state alone.
    pub fn lift(&mut self) {
        self.here = None;
    }

    /// The row at a position, each value with the digits asked for.
    pub fn row(
        &self,
        shown: &Rational,
        at: &Rational,
        branch: usize,
        q: &Configuration,
    ) -> Vec<Cell> {
        let angle = ExactAngle::Degrees(at.clone());
        let mut cells: Vec<Option<String>> = Vec::new();
        let mut q = q.clone();
        let mut finer: Option<Linkage> = None;
        loop {
            let linkage = finer.as_ref().unwrap_or(&self.linkage);
            if let Some(values) = self.values(linkage, &q) {
                let texts = values.iter().map(|x| x.to_decimal(self.digits));
                if cells.is_empty() {
                    cells = texts.collect();
                } else {
                    for (cell, text) in cells.iter_mut().zip(texts) {
                        *cell = cell.take().or(text);
                    }
                }
                if cells.iter().all(Option::is_some) {
                    break;
                }
            }
            let bits = 2 * linkage.bits();
            if bits > RAISED_AT_MOST * self.linkage.bits() {
                break;
            }
            let next = Linkage::new(&self.description.exact, bits);
            match refined(&next, &angle, &q) {
                Some(better) => q = better,
                None => break,
            }
            finer = Some(next);
        }
        let due = super::linkage_columns::names(self.description, true).len() - 2;
        cells.resize(due, None);
        let head = [Cell::Decimal(decimal(shown)), Cell::Count(branch)];
        let body = cells
            .into_iter()
            .map(|c| c.map_or(Cell::Undecided, Cell::Decimal));
        head.into_iter().chain(body).collect()
    }

    /// The values of a row in the order of the columns, from the first angle on.
    fn values(&self, linkage: &Linkage, q: &Configuration) -> Option<Vec<Ball>> {
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

/// A rational number whose decimals end, written out.
pub fn decimal(q: &Rational) -> String {
    let mut scaled = q.clone();
    let mut places = 0;
    while *scaled.denom() != 1 && places < 1200 {
        scaled *= 10;
        places += 1;
    }
    let n: Integer = scaled.numer().clone();
    let digits = format!(
        "{:0>width$}",
        n.clone().abs().to_string(),
        width = places + 1
    );
    let (whole, fraction) = digits.split_at(digits.len() - places);
    let sign = if n < 0 { "-" } else { "" };
    match places {
        0 => format!("{sign}{whole}"),
        _ => format!("{sign}{whole}.{fraction}"),
    }
}

#[cfg(test)]
mod tests {
    use super::decimal;
    use rug::Rational;

    #[test]
    fn decimals_are_written_out() {
        for (n, d, text) in [
            (14_426, 1000, "14.426"),
            (-1, 8, "-0.125"),
            (360, 1, "360"),
            (0, 1, "0"),
        ] {
            assert_eq!(decimal(&Rational::from((n, d))), text);
        }
    }
}
