//! I_n(φ), dI_n/dφ and M_o(φ) of a class-III linkage as Taylor models over a panel of crank angles.
//!
//! The joints (C, D) solve `G(x, z) = 0`, the four half-squared distance equations of
//! [`class_iii`], with the crank at `φ = φ_c + H x`. Their Taylor polynomial z̃ about the centre
//! follows order by order from one 4×4 matrix. The proof is a contraction on the whole complex
//! disc `|x| ≤ 1`, where G is a polynomial in z and the crank's cosine and sine are entire:
//! with a constant matrix Y, `z ↦ z − Y G(x, z)` maps the polydisc of radius r about z̃(x) into
//! itself if
//!
//! ```text
//! sup_x ‖Y G(x, z̃(x))‖ + q r ≤ r,    q = sup_{x, |z − z̃(x)| ≤ r} ‖I − Y G_z(x, z)‖ ≤ ½
//! ```
//!
//! (Banach's fixed-point theorem; q < 1 also makes Y regular.) The fixed point is unique, hence
//! the zero that continues the one at the centre, and analytic in x, being the uniform limit of
//! analytic iterates. So `z − z̃` is analytic and at most r on the disc, and Cauchy's estimate
//! `|f'(x)| ≤ sup |f| / (distance to the circle)` bounds derivatives on smaller discs: rates on
//! `|x| ≤ ¾`, dI_n/dφ on `|x| ≤ ½`, which is the panel.

use crate::class_iii::{Configuration, Geometry, Masses};
use crate::taylor_model::{TaylorModel, convolution};
use crate::{Ball, ComplexBall, Mag};
use nalgebra::Matrix4;
use rug::{Float, Rational};

/// The coefficient functions of the equation of motion over one panel, in `w = (φ − φ_c)/h` with
/// `|w| ≤ 1` (real).
#[derive(Clone, Debug)]
pub(super) struct Panel {
    /// I_n.
    pub inertia: TaylorModel,
    /// dI_n/dφ, or what the model puts in its place.
    pub slope: TaylorModel,
    /// M_o.
    pub moment: TaylorModel,
}

/// A vector of the plane whose components are Taylor models.
#[derive(Clone)]
struct Vector([TaylorModel; 2]);

impl Vector {
    fn minus(&self, o: &Vector) -> Vector {
        Vector([self.0[0].minus(&o.0[0]), self.0[1].minus(&o.0[1])])
    }

    fn plus(&self, o: &Vector) -> Vector {
        Vector([self.0[0].plus(&o.0[0]), self.0[1].plus(&o.0[1])])
    }

    fn minus_point(&self, p: &ComplexBall) -> Vector {
        Vector([self.0[0].plus_ball(&-&p.re), self.0[1].plus_ball(&-&p.im)])
    }

    /// The complex product with a constant.
    fn turned(&self, k: &ComplexBall) -> Vector {
        let [x, y] = &self.0;
        Vector([
            x.scaled(&k.re).minus(&y.scaled(&k.im)),
            x.scaled(&k.im).plus(&y.scaled(&k.re)),
        ])
    }

    fn squared(&self, order: usize) -> TaylorModel {
        self.0[0].squared(order).plus(&self.0[1].squared(order))
    }

    fn map(&self, f: impl Fn(&TaylorModel) -> TaylorModel) -> Vector {
        Vector([f(&self.0[0]), f(&self.0[1])])
    }
}

/// Precision of what only has to be smaller than a half, or tells when the terms are small.
const BITS: u32 = 64;

/// Row i of `Y F` for a column F.
fn combined(
    y: &Matrix4<f64>,
    i: usize,
    column: impl Fn(usize) -> TaylorModel,
    bits: u32,
) -> TaylorModel {
    (0..4).fold(TaylorModel::constant(&Ball::integer(bits, 0)), |s, m| {
        s.plus(&column(m).scaled(&Ball::exact(bits, y[(i, m)])))
    })
}

/// Upper bounds on `‖I − Y J‖` over the disc and on `‖Y‖`.
fn norms(y: &Matrix4<f64>, jacobian: &[[TaylorModel; 4]; 4]) -> (Mag, Mag) {
    let (mut off, mut rows) = (Mag::ZERO, Mag::ZERO);
    for i in 0..4 {
        let mut row = Mag::ZERO;
        for k in 0..4 {
            let e = combined(y, i, |m| jacobian[m][k].clone(), BITS);
            row = row.add(e.plus_ball(&Ball::integer(BITS, -i64::from(i == k))).norm());
        }
        off = off.max(row);
        let weights = (0..4).fold(Mag::ZERO, |s, m| s.add(Mag::from_f64(y[(i, m)])));
        rows = rows.max(weights);
    }
    (off, rows)
}

/// `df/dy` with `x = ¾ y`, of what misses t by r on `|x| ≤ 1`: `|d(f − t)/dx| ≤ r/(1 − ¾)`.
fn rate(t: &TaylorModel, outer: &Ball, r: Mag) -> TaylorModel {
    t.contracted(outer).derivative(r.mul(Mag::from_f64(3.0)))
}

/// `dI/dy` on `y = ⅔ w`: what I's model leaves out has a derivative of at most rad/(1 − ⅔) there.
fn slope(inertia: &TaylorModel, inner: &Ball) -> TaylorModel {
    inertia
        .derivative(inertia.rad().mul(Mag::from_f64(3.0)))
        .contracted(inner)
}

/// The linkage with its masses at a working precision.
pub(super) struct Mechanism {
    bits: u32,
    length: [Ball; 4],
    pivot: [ComplexBall; 2],
    crank: Ball,
    kappa: ComplexBall,
    one_minus_kappa: ComplexBall,
    /// For each link: mass, inertia, whether about the pivot, centre of mass as a share of the
    /// link's vector.
    bodies: [(Ball, Ball, bool, ComplexBall); 5],
    gravity: Ball,
}

impl Mechanism {
    pub(super) fn new(g: &Geometry, masses: &Masses, bits: u32) -> Mechanism {
        let b = |q: &Rational| Ball::rational(bits, q);
        let point = |p: &[Rational; 2]| ComplexBall::new(b(&p[0]), b(&p[1]));
        let share = |angle: Ball, ratio: Rational| ComplexBall::unit(&angle).scaled(&b(&ratio));
        let kappa = share(g.phi_b.to_ball(bits), Rational::from(&g.lb / &g.l4));
        let one = ComplexBall::new(Ball::integer(bits, 1), Ball::integer(bits, 0));
        let lengths = [&g.l1, &g.l2, &g.l3, &g.l4, &g.l5];
        Mechanism {
            bits,
            length: [&g.l3, &g.l5, &g.l4, &g.l2].map(b),
            pivot: [point(&g.o3), point(&g.o5)],
            crank: b(&g.l1),
            one_minus_kappa: &one - &kappa,
            kappa,
            bodies: std::array::from_fn(|i| {
                let body = &masses.bodies[i];
                let ratio = Rational::from(&body.radius / lengths[i]);
                let turn = share(body.angle.to_ball(bits), ratio);
                (b(&body.mass), b(&body.inertia), body.about_pivot, turn)
            }),
            gravity: b(&masses.gravity),
        }
    }

    fn joint_b(&self, c: &Vector, d: &Vector) -> Vector {
        c.turned(&self.one_minus_kappa).plus(&d.turned(&self.kappa))
    }

    /// The vectors whose lengths are fixed: O3–C, O5–D, C–D, A–B.
    fn links(&self, a: &Vector, c: &Vector, d: &Vector) -> [Vector; 4] {
        [
            c.minus_point(&self.pivot[0]),
            d.minus_point(&self.pivot[1]),
            d.minus(c),
            self.joint_b(c, d).minus(a),
        ]
    }

    /// The panel about the crank angle `phi` (with the joints there) of half-width `h`; `None` if
    /// the contraction cannot be shown.
    pub(super) fn panel(&self, phi: &Ball, at: &Configuration, h: &Ball) -> Option<Panel> {
        let disc = h.shift(1);
        let order_max = self.bits as usize;
        let crank = |order: usize| {
            let (c, s) = TaylorModel::cos_sin(phi, &disc, order);
            Vector([c.scaled(&self.crank), s.scaled(&self.crank)])
        };
        let series = self.series(&crank(order_max), at, order_max)?;
        let [cx, cy, dx, dy] = series.map(TaylorModel::polynomial);
        let order = cx.coefficients().len() - 1;
        let a = crank(order);
        let (c, d) = (Vector([cx, cy]), Vector([dx, dy]));
        let known = at.balls().iter().fold(Mag::ZERO, |m, b| m.max(b.rad()));
        let r = self.contraction(&a, &c, &d, order, known)?;
        Some(self.reduced(&a, &c, &d, r, &disc, order))
    }

    /// Taylor coefficients of (Cx, Cy, Dx, Dy), not proved: as many as it takes to bring them
    /// below the working precision.
    fn series(&self, a: &Vector, at: &Configuration, order_max: usize) -> Option<[Vec<Float>; 4]> {
        let bits = self.bits;
        let zero = || Float::new(bits);
        let mut z: [Vec<Float>; 4] = at.coordinates().map(|x| vec![Float::with_val(bits, x)]);
        let mid = |b: &ComplexBall| [b.re.mid().clone(), b.im.mid().clone()];
        let (o3, o5) = (mid(&self.pivot[0]), mid(&self.pivot[1]));
        let (k, l) = (mid(&self.kappa), mid(&self.one_minus_kappa));
        // Coefficient j of the four links' vectors from that of z.
        let link = |z: [&Float; 4], first: bool| -> [[Float; 2]; 4] {
            let [cx, cy, dx, dy] = z;
            let mut v = [
                [cx.clone(), cy.clone()],
                [dx.clone(), dy.clone()],
                [
                    Float::with_val(bits, dx - cx),
                    Float::with_val(bits, dy - cy),
                ],
                [
                    Float::with_val(bits, &l[0] * cx - &l[1] * cy)
                        + Float::with_val(bits, &k[0] * dx - &k[1] * dy),
                    Float::with_val(bits, &l[0] * cy + &l[1] * cx)
                        + Float::with_val(bits, &k[0] * dy + &k[1] * dx),
                ],
            ];
            if first {
                for i in 0..2 {
                    v[0][i] -= &o3[i];
                    v[1][i] -= &o5[i];
                }
            }
            v
        };
        let pin = |j: usize, i: usize| a.0[i].coefficients().get(j).cloned().unwrap_or_else(zero);
        let mut p: [[Vec<Float>; 2]; 4] = Default::default();
        let push = |p: &mut [[Vec<Float>; 2]; 4], v: [[Float; 2]; 4], j: usize| {
            for (e, x) in v.into_iter().enumerate() {
                for (i, mut x) in x.into_iter().enumerate() {
                    if e == 3 {
                        x -= pin(j, i);
                    }
                    p[e][i].push(x);
                }
            }
        };
        push(&mut p, link(z.each_ref().map(|z| &z[0]), true), 0);
        let q = |e: usize, i: usize| p[e][i][0].clone();
        let conj = |k: &[Float; 2]| {
            [
                Float::with_val(bits, &k[0] * q(3, 0)) + Float::with_val(bits, &k[1] * q(3, 1)),
                Float::with_val(bits, &k[0] * q(3, 1)) - Float::with_val(bits, &k[1] * q(3, 0)),
            ]
        };
        let (gc, gd) = (conj(&l), conj(&k));
        let jacobian = vec![
            vec![q(0, 0), q(0, 1), zero(), zero()],
            vec![zero(), zero(), q(1, 0), q(1, 1)],
            vec![-q(2, 0), -q(2, 1), q(2, 0), q(2, 1)],
            [gc, gd].concat(),
        ];
        let inverse = invert(jacobian, bits)?;
        let small = Float::with_val(BITS, 1) >> (bits + 2);
        let scale = Float::with_val(BITS, self.length[0].mid());
        let mut quiet = 0;
        for j in 1..=order_max {
            let rhs: [Float; 4] = std::array::from_fn(|e| {
                let mut sum = zero();
                for i in 0..2 {
                    // The coefficients so far: without those of z's own coefficient j.
                    sum -= convolution(&p[e][i], &p[e][i], j, 0, j, bits);
                }
                sum >>= 1u32;
                if e == 3 {
                    for i in 0..2 {
                        sum += &p[3][i][0] * &pin(j, i);
                    }
                }
                sum
            });
            let mut largest = Float::new(BITS);
            for (row, z) in inverse.iter().zip(&mut z) {
                let mut x = zero();
                for (y, r) in row.iter().zip(&rhs) {
                    x += y * r;
                }
                largest.max_mut(&Float::with_val(BITS, x.abs_ref()));
                z.push(x);
            }
            push(&mut p, link(z.each_ref().map(|z| &z[j]), false), j);
            quiet = match largest < Float::with_val(BITS, &scale * &small) {
                true => quiet + 1,
                false => 0,
            };
            if quiet == 3 {
                return Some(z);
            }
        }
        None
    }

    /// The radius r of the contraction about the polynomials, at least `known`; see the module.
    fn contraction(
        &self,
        a: &Vector,
        c: &Vector,
        d: &Vector,
        order: usize,
        known: Mag,
    ) -> Option<Mag> {
        let links = self.links(a, c, d);
        let residual: [TaylorModel; 4] = std::array::from_fn(|e| {
            let excess = links[e].squared(order).plus_ball(&-self.length[e].square());
            excess.scaled(&Ball::exact(self.bits, 0.5))
        });
        let jacobian = self.jacobian(&links);
        let first = |t: &TaylorModel| t.coefficients()[0].to_f64();
        let y = Matrix4::from_fn(|i, j| first(&jacobian[i][j])).try_inverse()?;
        if !y.iter().all(|x| x.is_finite()) {
            return None;
        }
        let row = |i: usize| combined(&y, i, |m| residual[m].clone(), self.bits).norm();
        let size = (0..4).map(row).fold(Mag::ZERO, Mag::max);
        let (off, rows) = norms(&y, &jacobian);
        // At least as wide as the enclosure at the centre, so that its zero is the one found here.
        let r = size.shift(1).max(known);
        // Over |z − z̃| ≤ r, four entries in a row.
        let q = off.add(rows.mul(self.lipschitz().shift(2)).mul(r));
        (q <= Mag::from_f64(0.5) && r.is_finite()).then_some(r)
    }

    /// G_z at 64 bits over the disc, from the links' vectors.
    fn jacobian(&self, links: &[Vector; 4]) -> [[TaylorModel; 4]; 4] {
        let low: Vec<Vector> = links.iter().map(|v| v.map(|t| t.with_prec(BITS))).collect();
        let Vector([gx, gy]) = low[3].turned(&self.one_minus_kappa.conj());
        let Vector([hx, hy]) = low[3].turned(&self.kappa.conj());
        let zero = || TaylorModel::constant(&Ball::integer(BITS, 0));
        let [u, v, w] = [&low[0].0, &low[1].0, &low[2].0];
        let negative = |t: &TaylorModel| t.scaled(&Ball::integer(BITS, -1));
        [
            [u[0].clone(), u[1].clone(), zero(), zero()],
            [zero(), zero(), v[0].clone(), v[1].clone()],
            [negative(&w[0]), negative(&w[1]), w[0].clone(), w[1].clone()],
            [gx, gy, hx, hy],
        ]
    }

    /// Bounds the change of an entry of G_z, linear in z, per change of z: at most max(2, s²) with
    /// s = |Re κ| + |Im κ| + |Re (1 − κ)| + |Im (1 − κ)|.
    fn lipschitz(&self) -> Mag {
        let s = [&self.kappa, &self.one_minus_kappa].map(|k| [&k.re, &k.im]);
        let s = s
            .iter()
            .flatten()
            .fold(Mag::ZERO, |s, x| s.add(x.magnitude()));
        s.mul(s).max(Mag::from_f64(2.0))
    }

    /// I_n, dI_n/dφ and M_o from the joints' models and the radius r on the disc of half-width
    /// `disc`.
    fn reduced(
        &self,
        a: &Vector,
        c: &Vector,
        d: &Vector,
        r: Mag,
        disc: &Ball,
        order: usize,
    ) -> Panel {
        let bits = self.bits;
        let fraction = |p: i32, q: i32| Ball::rational(bits, &Rational::from((p, q)));
        let outer = fraction(3, 4);
        let rates = |v: &Vector| v.map(|t| rate(t, &outer, r));
        let (c1, d1) = (rates(c), rates(d));
        // dA/dy = ¾ H i A, exactly.
        let step = disc * &outer;
        let a1 = a.map(|t| t.contracted(&outer).scaled(&step));
        let a1 = Vector([a1.0[1].scaled(&Ball::integer(bits, -1)), a1.0[0].clone()]);
        let b1 = self.joint_b(&c1, &d1);
        // Vectors of links 1 to 5 and the velocities of their origins.
        let zero = TaylorModel::constant(&Ball::integer(bits, 0));
        let none = Vector([zero.clone(), zero.clone()]);
        let [l3, l5, l4, l2] = &self.length;
        let frames = [
            (&none, &a1, &self.crank),
            (&a1, &b1.minus(&a1), l2),
            (&none, &c1, l3),
            (&c1, &d1.minus(&c1), l4),
            (&none, &d1, l5),
        ];
        let (mut inertia, mut height) = (zero.clone(), zero);
        for (body, (origin, vector, length)) in self.bodies.iter().zip(frames) {
            let (m, j, about_pivot, share) = body;
            let centre = origin.plus(&vector.turned(share));
            if !about_pivot && !m.is_zero() {
                inertia = inertia.plus(&centre.squared(order).scaled(m));
            }
            if !m.is_zero() {
                height = height.plus(&centre.0[1].scaled(m));
            }
            if !j.is_zero() {
                // The vector keeps its length, so its rate has the size length · dφ_i/dφ.
                let weight = j / &length.square();
                inertia = inertia.plus(&vector.squared(order).scaled(&weight));
            }
        }
        let inertia = inertia.scaled(&step.square().recip());
        let moment = height.scaled(&-(&self.gravity / &step));
        let inner = fraction(2, 3);
        let slope = slope(&inertia, &inner).scaled(&step.recip());
        Panel {
            inertia: inertia.contracted(&inner),
            slope,
            moment: moment.contracted(&inner),
        }
    }
}

/// The inverse by Gauss-Jordan elimination with row pivots, not proved.
fn invert(mut a: Vec<Vec<Float>>, bits: u32) -> Option<Vec<Vec<Float>>> {
    let n = a.len();
    for (i, row) in a.iter_mut().enumerate() {
        row.extend((0..n).map(|k| Float::with_val(bits, u32::from(i == k))));
    }
    for k in 0..n {
        let size = |i: usize| Float::with_val(bits, a[i][k].abs_ref());
        let best = (k..n).max_by(|&i, &j| size(i).total_cmp(&size(j)))?;
        a.swap(k, best);
        if a[k][k].is_zero() || !a[k][k].is_finite() {
            return None;
        }
        let pivot = a[k][k].clone();
        for x in &mut a[k] {
            *x /= &pivot;
        }
        let own = a[k].clone();
        for (i, row) in a.iter_mut().enumerate() {
            if i != k {
                let f = row[k].clone();
                for (x, y) in row.iter_mut().zip(&own) {
                    *x -= &f * y;
                }
            }
        }
    }
    Some(a.into_iter().map(|r| r[n..].to_vec()).collect())
}

#[cfg(test)]
mod tests;
