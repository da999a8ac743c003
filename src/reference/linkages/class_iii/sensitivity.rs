//! Condition numbers of a configuration and of the quantities derived from it.
//!
//! Along a change δ of the dimensions the distance equations `P·P = l²` and their first two
//! derivatives with respect to φ1 (primes) give
//!
//! ```text
//! P·δP = l δl,   P·δP' = −P'·δP,   P·δP'' = −2P'·δP' − P''·δP
//! ```
//!
//! for each link: linear systems in (δC, δD), (δC', δD') and (δC'', δD'') with the matrix of the
//! velocities. Each `δ` here is `x ∂/∂x` for one number x of the input.

use super::motion::Jet;
use super::{Configuration, Linkage, Masses};
use crate::{Ball, BallLu, ComplexBall, Mag};
use rug::Rational;

/// `Σ_j |x_j ∂f/∂x_j|` over lengths, pivots, angles and masses.
#[derive(Clone, Debug)]
pub struct Conditions {
    /// Of φ2 … φ5.
    pub angles: [Mag; 4],
    /// Of their first derivatives.
    pub first: [Mag; 4],
    /// Of their second derivatives.
    pub second: [Mag; 4],
    /// Of I_n, dI_n/dφ1, M_o and dM_o/dφ1.
    pub reduced: [Mag; 4],
}

/// A change of the dimensions.
struct Direction {
    /// l1 … l5.
    lengths: [Ball; 5],
    o3: ComplexBall,
    o5: ComplexBall,
    kappa: ComplexBall,
    /// The crank pin with its derivatives.
    pin: [ComplexBall; 3],
}

/// Describes what changes along a direction: derivatives 0, 1, … of each.
struct Tangent {
    c: Vec<ComplexBall>,
    /// Links 2 to 5.
    links: Vec<[ComplexBall; 4]>,
}

/// A configuration with what all directions share.
struct Base<'a> {
    linkage: &'a Linkage,
    matrix: BallLu,
    joints: [Jet; 4],
    pin: [ComplexBall; 3],
    /// Links 2 to 5.
    links: [[ComplexBall; 3]; 4],
    /// `φ'`, `φ''`.
    rates: [[Ball; 4]; 2],
    lengths: [&'a Ball; 4],
    per_square: [Ball; 4],
}

fn orders(jet: &Jet) -> [ComplexBall; 3] {
    [jet.r.clone(), jet.first.clone(), jet.second.clone()]
}

impl<'a> Base<'a> {
    fn new(linkage: &'a Linkage, at: &Configuration) -> Option<Base<'a>> {
        let lengths = [&linkage.l2, &linkage.l3, &linkage.l4, &linkage.l5];
        let per_square = lengths.map(|l| l.square().recip());
        let matrix = linkage.velocity_matrix(at)?;
        let joints = linkage.joints(at, &matrix);
        let links = linkage.links(&joints).map(|jet| orders(&jet));
        let rate =
            |j: usize| std::array::from_fn(|i| links[i][0].cross(&links[i][j]) * &per_square[i]);
        Some(Base {
            linkage,
            matrix,
            pin: orders(&joints[0]),
            rates: [rate(1), rate(2)],
            joints,
            links,
            per_square,
            lengths,
        })
    }

    /// One direction for each dimension and φ1, zeros left out.
    fn directions(&self, phi1: &Ball) -> Vec<Direction> {
        let l = self.linkage;
        let zero = || Ball::integer(l.bits, 0);
        let still = || ComplexBall::zero(l.bits);
        let none = || Direction {
            lengths: std::array::from_fn(|_| zero()),
            o3: still(),
            o5: still(),
            kappa: still(),
            pin: std::array::from_fn(|_| still()),
        };
        let mut all = Vec::new();
        for (i, length) in [&l.l1, &l.l2, &l.l3, &l.l4, &l.l5].into_iter().enumerate() {
            let mut d = none();
            d.lengths[i] = length.clone();
            match i {
                0 => d.pin = self.pin.clone(),
                3 => d.kappa = -&l.kappa,
                _ => {}
            }
            all.push(d);
        }
        let mut turned = |change: &dyn Fn(&mut Direction)| {
            let mut d = none();
            change(&mut d);
            all.push(d);
        };
        turned(&|d| d.kappa = l.kappa.clone());
        if !l.phi_b.is_zero() {
            turned(&|d| d.kappa = l.kappa.turned().scaled(&l.phi_b));
        }
        for x in [false, true] {
            let part = |p: &ComplexBall| match x {
                true => ComplexBall::new(p.re.clone(), zero()),
                false => ComplexBall::new(zero(), p.im.clone()),
            };
            turned(&|d| d.o3 = part(&l.o3));
            turned(&|d| d.o5 = part(&l.o5));
        }
        if !phi1.is_zero() {
            turned(&|d| d.pin = [0, 1, 2].map(|j| self.pin[j].turned().scaled(phi1)));
        }
        all
    }

    /// Up to the derivative of that order, at most the second.
    fn tangent(&self, d: &Direction, order: usize) -> Tangent {
        let l = self.linkage;
        let mut found = Tangent {
            c: Vec::new(),
            links: Vec::new(),
        };
        for j in 0..=order {
            // The change of the links while C and D stay.
            let arm = &(&d.kappa * &self.links[2][j]) - &d.pin[j];
            let pivots = [-&d.o3, -&d.o5];
            let [u, v] = pivots.each_ref().map(|own| (j == 0).then_some(own));
            let right = |link: usize, own: Option<&ComplexBall>| {
                let p = &self.links[link];
                let mut sum = match j {
                    0 => self.lengths[link] * &d.lengths[link + 1],
                    1 => -p[1].dot(&found.links[0][link]),
                    _ => {
                        let twice = p[1].dot(&found.links[1][link]).shift(1);
                        -(twice + p[2].dot(&found.links[0][link]))
                    }
                };
                if let Some(own) = own {
                    sum = sum - p[0].dot(own);
                }
                sum
            };
            // Rows as in the Jacobian.
            let rows = [
                right(1, u),
                right(3, v),
                right(2, None),
                right(0, Some(&arm)),
            ];
            let x = self.matrix.solve(&rows);
            let c = ComplexBall::new(x[0].clone(), x[1].clone());
            let e = ComplexBall::new(x[2].clone(), x[3].clone());
            let plus = |z: &ComplexBall, own: Option<&ComplexBall>| {
                own.map_or_else(|| z.clone(), |own| z + own)
            };
            let links = [&l.joint_b(&c, &e) + &arm, plus(&c, u), &e - &c, plus(&e, v)];
            found.c.push(c);
            found.links.push(links);
        }
        found
    }

    /// Returns what φ2 … φ5 (order 0) or their derivatives change by.
    fn angles(&self, d: &Direction, t: &Tangent, order: usize) -> [Ball; 4] {
        std::array::from_fn(|i| {
            let p = &self.links[i];
            let mut turned = p[0].cross(&t.links[order][i]);
            if order == 0 {
                return turned * &self.per_square[i];
            }
            turned = turned + t.links[0][i].cross(&p[order]);
            // The l² of φ' = P × P'/l².
            let longer = &d.lengths[i + 1];
            if !longer.is_zero() {
                let square = (longer * self.lengths[i]).shift(1);
                turned = turned - &self.rates[order - 1][i] * square;
            }
            turned * &self.per_square[i]
        })
    }
}

/// A link as it enters the reduced quantities.
struct Part {
    mass: Ball,
    inertia: Ball,
    about_pivot: bool,
    /// Of the centre of mass.
    first: ComplexBall,
    second: ComplexBall,
    rate: Ball,
    acceleration: Ball,
}

impl Part {
    /// Returns what I_n, dI_n/dφ1, Σ m y' and Σ m y'' change by with the motion of the centre of
    /// mass.
    fn moved(&self, first: &ComplexBall, second: &ComplexBall) -> [Ball; 4] {
        let m = &self.mass;
        let zero = || Ball::integer(m.prec(), 0);
        let [i, di] = match self.about_pivot {
            true => [zero(), zero()],
            false => [
                (m * &self.first.dot(first)).shift(1),
                (m * &(first.dot(&self.second) + self.first.dot(second))).shift(1),
            ],
        };
        [i, di, m * &first.im, m * &second.im]
    }

    /// … and with the rates of the link.
    fn turned(&self, rate: &Ball, acceleration: &Ball) -> [Ball; 2] {
        let j = &self.inertia;
        [
            (j * &(&self.rate * rate)).shift(1),
            (j * &(rate * &self.acceleration + &self.rate * acceleration)).shift(1),
        ]
    }

    /// Returns what the mass gives to the four.
    fn of_mass(&self) -> [Ball; 4] {
        let [i, di, y, dy] = self.moved(&self.first, &self.second);
        // Both are quadratic in the motion.
        [i.shift(-1), di.shift(-1), y, dy]
    }

    /// Returns what the inertia gives to I_n and dI_n/dφ1.
    fn of_inertia(&self) -> [Ball; 2] {
        self.turned(&self.rate, &self.acceleration)
            .map(|twice| twice.shift(-1))
    }
}

fn add(sums: &mut [Mag; 4], changes: &[Ball]) {
    for (sum, change) in sums.iter_mut().zip(changes) {
        *sum = sum.add(change.magnitude());
    }
}

impl Linkage {
    /// The configuration with the angles φ3 and φ5, from balls that hold those of one.
    pub fn placed(&self, phi1: &Ball, phi3: &Ball, phi5: &Ball) -> Configuration {
        let e1 = ComplexBall::unit(phi1);
        let c = &self.o3 + &ComplexBall::unit(phi3).scaled(&self.l3);
        let d = &self.o5 + &ComplexBall::unit(phi5).scaled(&self.l5);
        let a = e1.scaled(&self.l1);
        let b = self.joint_b(&c, &d);
        Configuration { e1, a, b, c, d }
    }

    /// The conditions of φ2 … φ5 alone; `None` when the matrix cannot be told from a singular one.
    pub fn angle_conditions(&self, phi1: &Ball, at: &Configuration) -> Option<[Mag; 4]> {
        let base = Base::new(self, at)?;
        let mut sums = [Mag::ZERO; 4];
        for d in base.directions(phi1) {
            let t = base.tangent(&d, 0);
            add(&mut sums, &base.angles(&d, &t, 0));
        }
        Some(sums)
    }

    /// All conditions; `None` when the matrix cannot be told from a singular one.
    pub fn conditions(
        &self,
        phi1: &Ball,
        at: &Configuration,
        masses: &Masses,
    ) -> Option<Conditions> {
        let base = Base::new(self, at)?;
        let ball = |q: &Rational| Ball::rational(self.bits, q);
        let zero = || Ball::integer(self.bits, 0);
        let gravity = ball(&masses.gravity);
        let turns = self.centre_turns(masses);
        let centres = self.centres(&base.joints, masses);
        let parts: [Part; 5] = std::array::from_fn(|i| {
            let body = &masses.bodies[i];
            let (rate, acceleration) = match i {
                0 => (Ball::integer(self.bits, 1), zero()),
                _ => (base.rates[0][i - 1].clone(), base.rates[1][i - 1].clone()),
            };
            Part {
                mass: ball(&body.mass),
                inertia: ball(&body.inertia),
                about_pivot: body.about_pivot,
                first: centres[i].first.clone(),
                second: centres[i].second.clone(),
                rate,
                acceleration,
            }
        });
        let with_gravity = |[i, di, y, dy]: [Ball; 4]| [i, di, y * &gravity, dy * &gravity];
        let mut sums = Conditions {
            angles: [Mag::ZERO; 4],
            first: [Mag::ZERO; 4],
            second: [Mag::ZERO; 4],
            reduced: [Mag::ZERO; 4],
        };
        let lengths = [&self.l1, &self.l2, &self.l3, &self.l4, &self.l5];
        // Derivatives of a link from its origin to its end.
        let link = |i: usize, j: usize| match i {
            0 => &base.pin[j],
            _ => &base.links[i - 1][j],
        };
        for d in base.directions(phi1) {
            let t = base.tangent(&d, 2);
            let [angles, first, second] = [0, 1, 2].map(|order| base.angles(&d, &t, order));
            add(&mut sums.angles, &angles);
            add(&mut sums.first, &first);
            add(&mut sums.second, &second);
            let mut total: [Ball; 4] = std::array::from_fn(|_| zero());
            for (i, part) in parts.iter().enumerate() {
                let longer = (!d.lengths[i].is_zero()).then(|| -(&d.lengths[i] / lengths[i]));
                let [to_first, to_second] = [1, 2].map(|j| {
                    let (own, from) = match i {
                        0 => (&d.pin[j], None),
                        1 => (&t.links[j][0], Some(&d.pin[j])),
                        3 => (&t.links[j][2], Some(&t.c[j])),
                        _ => (&t.links[j][i - 1], None),
                    };
                    let mut moved = own * &turns[i];
                    if let Some(from) = from {
                        moved = &moved + from;
                    }
                    if let Some(longer) = &longer {
                        moved = &moved + &(link(i, j) * &turns[i]).scaled(longer);
                    }
                    moved
                });
                for (sum, x) in total.iter_mut().zip(part.moved(&to_first, &to_second)) {
                    *sum = &*sum + x;
                }
                if i > 0 {
                    let own = part.turned(&first[i - 1], &second[i - 1]);
                    for (sum, x) in total.iter_mut().zip(own) {
                        *sum = &*sum + x;
                    }
                }
            }
            add(&mut sums.reduced, &with_gravity(total));
        }
        let mut moments = [zero(), zero()];
        for (i, part) in parts.iter().enumerate() {
            let of_mass = part.of_mass();
            moments = [&moments[0] + &of_mass[2], &moments[1] + &of_mass[3]];
            add(&mut sums.reduced, &with_gravity(of_mass));
            add(&mut sums.reduced, &part.of_inertia());
            let arms = [1, 2].map(|j| link(i, j) * &turns[i]);
            add(
                &mut sums.reduced,
                &with_gravity(part.moved(&arms[0], &arms[1])),
            );
            let angle = masses.bodies[i].angle.to_ball(self.bits);
            let [first, second] = arms.map(|arm| arm.turned().scaled(&angle));
            add(
                &mut sums.reduced,
                &with_gravity(part.moved(&first, &second)),
            );
        }
        let [y, dy] = moments;
        add(&mut sums.reduced, &with_gravity([zero(), zero(), y, dy]));
        Some(sums)
    }
}

#[cfg(test)]
mod tests;
