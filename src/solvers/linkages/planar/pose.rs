//! Where the bodies are, the closures' residual and their Jacobian.

use super::chain::{Chain, Closure, Entry, Rail, Spot, Travel};
use super::dense::Matrix;
use super::model::GROUND;
use super::plane::{cross, dot, quarter};
use num_complex::Complex64;
use std::f64::consts::TAU;
use std::ops::Range;

/// Angles below this have squares that rounding hides.
pub(super) const LITTLE: f64 = 1e-8;

/// Steps up to this turn directions by a series.
const SMALL: f64 = 0.015_625;

/// `e^{id} − 1` for `|d| ≤` [`SMALL`], by the series to d⁷: the next term is below 1e-19.
#[inline(always)]
fn turn_less_one(d: f64) -> Complex64 {
    if d.abs() <= LITTLE {
        return Complex64::new(0.0, d);
    }
    let q = d * d;
    let cosine = -q * (0.5 - q * (1.0 / 24.0 - q / 720.0));
    let sine = d * (1.0 - q * (1.0 / 6.0 - q * (1.0 / 120.0 - q / 5040.0)));
    Complex64::new(cosine, sine)
}

/// Directions and origins of all bodies for given unknowns.
#[derive(Clone, Debug, Default)]
pub(super) struct Pose {
    pub drive: f64,
    /// The unknowns.
    pub u: Vec<f64>,
    /// `e^{iθ}` of each body.
    pub e: Vec<Complex64>,
    /// Origins of their frames.
    pub p: Vec<Complex64>,
}

impl Pose {
    pub(super) fn new(chain: &Chain, drive: f64, u: Vec<f64>) -> Pose {
        let n = chain.body_count();
        let mut pose = Pose {
            drive,
            u,
            e: vec![Complex64::new(1.0, 0.0); n],
            p: vec![Complex64::new(0.0, 0.0); n],
        };
        pose.place(chain, &chain.order);
        pose
    }

    /// Becomes that of another one of the same chain.
    pub(super) fn copy(&mut self, other: &Pose) {
        self.drive = other.drive;
        self.u.copy_from_slice(&other.u);
        self.e.copy_from_slice(&other.e);
        self.p.copy_from_slice(&other.p);
    }

    /// Places these bodies, in the chain's order, on those that they hang on.
    pub(super) fn place(&mut self, chain: &Chain, bodies: &[usize]) {
        self.hang(chain, bodies, |pose, b| pose.direction(chain, b));
    }

    /// Places these bodies with directions of `turned`.
    #[inline(always)]
    fn hang(
        &mut self,
        chain: &Chain,
        bodies: &[usize],
        turned: impl Fn(&Pose, usize) -> Complex64,
    ) {
        for &b in bodies {
            let e = turned(self, b);
            self.e[b] = e;
            self.p[b] = match chain.entries[b] {
                Entry::Ground => continue,
                Entry::Pin { on, own } => self.at(on) - e * own,
                Entry::OnRail { rail, own, travel } => {
                    let s = self.travel(travel);
                    self.p[rail.body] + self.e[rail.body] * (rail.at + rail.along * s) - e * own
                }
                Entry::WithRail {
                    on,
                    at,
                    along,
                    travel,
                } => self.at(on) - e * (at + along * self.travel(travel)),
            };
        }
    }

    /// [`Pose::place`] after the unknowns have moved by a step: directions turn by it where it is
    /// small, to a rounding error.
    pub(super) fn turn_by(&mut self, chain: &Chain, step: &[f64]) {
        self.turn_some_by(chain, &chain.order, step);
    }

    /// [`Pose::turn_by`] of these bodies in the chain's order, where the others do not move.
    pub(super) fn turn_some_by(&mut self, chain: &Chain, bodies: &[usize], step: &[f64]) {
        self.hang(chain, bodies, |pose, b| match chain.turns[b].unknown {
            Some(k) if step[k].abs() <= SMALL => {
                let e = pose.e[b];
                e + e * turn_less_one(step[k])
            }
            Some(_) => pose.direction(chain, b),
            None => pose.e[b],
        });
    }

    fn direction(&self, chain: &Chain, body: usize) -> Complex64 {
        let (s, c) = self.angle(chain, body).sin_cos();
        Complex64::new(c, s)
    }

    /// The body's angle, not reduced by whole turns.
    pub(super) fn angle(&self, chain: &Chain, body: usize) -> f64 {
        let t = &chain.turns[body];
        let own = t.unknown.map_or(0.0, |k| self.u[k]) + t.offset;
        if t.drive == 0.0 {
            own
        } else {
            own + t.drive * self.drive
        }
    }

    pub(super) fn travel(&self, travel: Travel) -> f64 {
        match travel {
            Travel::Unknown(k) => self.u[k],
            Travel::Drive => self.drive,
        }
    }

    pub(super) fn at(&self, spot: Spot) -> Complex64 {
        if spot.body == GROUND {
            return spot.at;
        }
        self.p[spot.body] + self.e[spot.body] * spot.at
    }

    /// Direction of a rail and the vector from its origin to a point.
    pub(super) fn along(&self, rail: Rail, point: Spot) -> (Complex64, Complex64) {
        let origin = self.p[rail.body] + self.e[rail.body] * rail.at;
        (self.e[rail.body] * rail.along, self.at(point) - origin)
    }

    /// Residuals of closures, row by row.
    pub(super) fn residual(&self, chain: &Chain, closures: &[Closure], out: &mut Vec<f64>) {
        out.clear();
        for closure in closures {
            match *closure {
                Closure::Pin { a, b } => {
                    let d = self.at(a) - self.at(b);
                    out.extend([d.re, d.im]);
                }
                Closure::Line { rail, point } => {
                    let (u, d) = self.along(rail, point);
                    out.push(cross(u, d));
                }
                Closure::Tie {
                    a,
                    b,
                    offset,
                    drive,
                } => {
                    let d = self.angle(chain, b) - self.angle(chain, a);
                    let d = d - offset - drive * self.drive;
                    out.push(d - (d / TAU).round() * TAU);
                }
                Closure::Gears {
                    wheels: [a, b],
                    carrier,
                    ratio,
                    phase,
                } => {
                    let [a, b, c] = [a, b, carrier].map(|x| self.angle(chain, x));
                    out.push((b - c) - ratio * (a - c) - phase);
                }
                Closure::Rack {
                    rail,
                    point,
                    wheel,
                    radius,
                    phase,
                } => {
                    let (u, d) = self.along(rail, point);
                    let turn = self.angle(chain, wheel) - self.angle(chain, rail.body);
                    out.push(dot(u, d) - radius * turn - phase);
                }
            }
        }
    }

    /// The point of a body at which it hangs, in its own frame.
    pub(super) fn hinge(&self, chain: &Chain, body: usize) -> Complex64 {
        match chain.entries[body] {
            Entry::Ground => Complex64::ZERO,
            Entry::Pin { own, .. } | Entry::OnRail { own, .. } => own,
            Entry::WithRail {
                at, along, travel, ..
            } => at + along * self.travel(travel),
        }
    }

    /// Calls `add` with the columns that a point depends on and its derivatives; the drive's column
    /// is [`Chain::unknowns`]. Arms are differences in the bodies' own frames: those of the places
    /// would lose the digits of links shorter than their distance from the origin.
    fn walk(&self, chain: &Chain, mut spot: Spot, add: &mut impl FnMut(usize, Complex64)) {
        loop {
            let body = spot.body;
            let next = match chain.entries[body] {
                Entry::Ground => return,
                Entry::Pin { on, .. } => on,
                Entry::OnRail { rail, travel, .. } => {
                    add(chain.column(travel), self.e[rail.body] * rail.along);
                    rail.at(self.travel(travel))
                }
                Entry::WithRail {
                    on, along, travel, ..
                } => {
                    add(chain.column(travel), -(self.e[body] * along));
                    on
                }
            };
            let arm = self.e[body] * (spot.at - self.hinge(chain, body));
            self.turned(chain, body, quarter(arm), add);
            spot = next;
        }
    }

    /// The columns of a body's angle, with a factor.
    fn turned(
        &self,
        chain: &Chain,
        body: usize,
        factor: Complex64,
        add: &mut impl FnMut(usize, Complex64),
    ) {
        let t = &chain.turns[body];
        if let Some(k) = t.unknown {
            add(k, factor);
        }
        if t.drive != 0.0 {
            add(chain.unknowns, factor * t.drive);
        }
    }

    /// The Jacobian of closures; its last column is the derivative with respect to the drive. The
    /// first row of `out` is that of the first closure.
    pub(super) fn jacobian(&self, chain: &Chain, closures: Range<usize>, out: &mut Matrix) {
        out.clear();
        let drive = chain.unknowns;
        let mut row = 0;
        let real = Complex64::from;
        for (closure, arms) in chain.closures[closures.clone()]
            .iter()
            .zip(&chain.arms[closures])
        {
            if let Some(arms) = arms {
                let (x, y) = out.pair(row);
                for arm in arms {
                    let d = quarter(self.e[arm.body] * arm.arm) * arm.by;
                    x[arm.column] += d.re;
                    y[arm.column] += d.im;
                }
                row += 2;
                continue;
            }
            match *closure {
                Closure::Pin { a, b } => {
                    self.walk(chain, a, &mut |k, d| {
                        out[(row, k)] += d.re;
                        out[(row + 1, k)] += d.im;
                    });
                    self.walk(chain, b, &mut |k, d| {
                        out[(row, k)] -= d.re;
                        out[(row + 1, k)] -= d.im;
                    });
                }
                Closure::Line { rail, point } => {
                    let (u, d) = self.along(rail, point);
                    let origin = rail.at(0.0);
                    self.walk(chain, point, &mut |k, x| out[(row, k)] += cross(u, x));
                    self.walk(chain, origin, &mut |k, x| out[(row, k)] -= cross(u, x));
                    self.turned(chain, rail.body, real(-dot(u, d)), &mut |k, x| {
                        out[(row, k)] += x.re;
                    });
                }
                Closure::Rack {
                    rail,
                    point,
                    wheel,
                    radius,
                    ..
                } => {
                    self.travelled(chain, rail, point, row, out);
                    let mut add = |k, x: Complex64| out[(row, k)] += x.re;
                    self.turned(chain, wheel, real(-radius), &mut add);
                    self.turned(chain, rail.body, real(radius), &mut add);
                }
                Closure::Tie {
                    a, b, drive: by, ..
                } => {
                    let mut add = |k, x: Complex64| out[(row, k)] += x.re;
                    self.turned(chain, b, real(1.0), &mut add);
                    self.turned(chain, a, real(-1.0), &mut add);
                    out[(row, drive)] -= by;
                }
                Closure::Gears {
                    wheels: [a, b],
                    carrier,
                    ratio,
                    ..
                } => {
                    let mut add = |k, x: Complex64| out[(row, k)] += x.re;
                    self.turned(chain, b, real(1.0), &mut add);
                    self.turned(chain, a, real(-ratio), &mut add);
                    self.turned(chain, carrier, real(ratio - 1.0), &mut add);
                }
            }
            row += closure.rows();
        }
    }

    /// The row of a point's displacement along a rail.
    pub(super) fn travelled(
        &self,
        chain: &Chain,
        rail: Rail,
        point: Spot,
        row: usize,
        out: &mut Matrix,
    ) {
        let (u, d) = self.along(rail, point);
        let origin = rail.at(0.0);
        self.walk(chain, point, &mut |k, x| out[(row, k)] += dot(u, x));
        self.walk(chain, origin, &mut |k, x| out[(row, k)] -= dot(u, x));
        self.turned(
            chain,
            rail.body,
            Complex64::from(cross(u, d)),
            &mut |k, x| {
                out[(row, k)] += x.re;
            },
        );
    }
}

#[cfg(test)]
mod tests;
