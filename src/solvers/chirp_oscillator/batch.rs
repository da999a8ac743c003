//! Displacements at many times: particular solutions four at a time, free vibrations once for all
//! harmonics.
//!
//! Past its first few radians every harmonic leaves a free vibration with a fixed initial state
//! `(a, b)`, which a passage through resonance changes once. So each time needs the sum of the states
//! and one evaluation of the impulse response, whatever the number of harmonics.

use super::free::Free;
use super::harmonic::{Prepared, SHORT};
use super::inlined::two;
use super::passage::passage;
use super::response::ChirpResponse;
use super::roots::Roots;
use super::series::{FAR, Z, difference, of_both, terms};
use crate::solvers::faddeeva::double_double::Dd;
use crate::solvers::faddeeva::exponential::{LARGE_PHASE, reduce, sin_cos_reduced, turn};
use crate::solvers::faddeeva::faddeeva_soa;
use crate::solvers::faddeeva::lanes::{Lanes, Task, with_best};
use crate::solvers::faddeeva::real::Real;
use num_complex::Complex;

type C = Complex<f64>;

/// Times taken together.
pub(super) const CHUNK: usize = 512;

/// Up to [`CHUNK`] times, padded to a multiple of four by the last one.
struct Times<'a> {
    t: &'a [f64],
    last: f64,
}

/// What is gathered for each time.
struct Sums {
    /// Forced parts.
    y: [f64; CHUNK],
    /// States of the free vibration at `t = 0`.
    a: [f64; CHUNK],
    b: [f64; CHUNK],
}

/// Points beside a resonance: W is computed for all of them together.
#[derive(Default)]
struct Near {
    /// Place of the time, and `e^{−iθ}`.
    place: Vec<(usize, C)>,
    /// For each point and root where its W is, or F itself where it is far.
    parts: Vec<[Part; 2]>,
    x: Vec<f64>,
    y: Vec<f64>,
    re: Vec<f64>,
    im: Vec<f64>,
}

#[derive(Clone, Copy)]
enum Part {
    /// F.
    Value(C),
    /// Number of the argument, and whether it was reflected.
    Computed(usize, bool),
}

/// The free vibration that a harmonic leaves, where constants will do.
struct Constants {
    start: [f64; 2],
    /// Of either resonance, when passed.
    passed: [[f64; 2]; 2],
    /// Whether the passages are constants.
    folded: bool,
}

pub(super) fn displacements(response: &ChirpResponse, times: &[f64], out: &mut [f64]) {
    let mut near = Near::default();
    for (t, out) in times.chunks(CHUNK).zip(out.chunks_mut(CHUNK)) {
        let scaled: Vec<f64> = t.iter().map(|t| t * response.unit).collect();
        chunk(response, &scaled, out, &mut near);
    }
}

fn chunk(response: &ChirpResponse, t: &[f64], out: &mut [f64], near: &mut Near) {
    let roots = &response.roots;
    let [a, b] = response.start;
    let mut sums = Sums {
        y: [0.0; CHUNK],
        a: [a; CHUNK],
        b: [b; CHUNK],
    };
    let free = with_best(FreeAt { roots, t });
    let largest = t.iter().fold(0.0, |m, t| t.max(m));
    for harmonic in response.constant.iter().chain(&response.harmonics) {
        let s = &harmonic.sweep;
        let phase = (s.nu.hi.abs() + s.kappa.hi * largest) * largest + s.delta.abs();
        if !(phase < LARGE_PHASE) {
            for ((y, free), t) in sums.y.iter_mut().zip(&free).zip(t) {
                let carrier = harmonic.sweep.carrier(*t);
                *y += harmonic.psi(roots, free, carrier, *t)[0].re;
            }
            continue;
        }
        near.clear();
        let last = *t.last().expect("chunks are not empty");
        with_best(Forced {
            harmonic,
            roots,
            free: &free,
            times: Times { t, last },
            sums: &mut sums,
            near,
        });
        near.add(harmonic, roots, &mut sums.y);
    }
    for (i, out) in out.iter_mut().enumerate() {
        let Free { k, k0, .. } = free[i];
        *out = sums.a[i].mul_add(k0, sums.b[i].mul_add(k, sums.y[i]));
    }
}

impl Near {
    fn clear(&mut self) {
        self.place.clear();
        self.parts.clear();
        self.x.clear();
        self.y.clear();
    }

    /// A point; `false` if its roots have to be told apart in double-double.
    #[inline(always)]
    fn push(
        &mut self,
        harmonic: &Prepared,
        roots: &Roots,
        i: usize,
        omega: Dd,
        carrier: C,
    ) -> bool {
        let sweep = &harmonic.sweep;
        let p = two(
            #[inline(always)]
            |r| roots.p(r, omega),
        );
        if !sweep.apart(roots, p) {
            return false;
        }
        let mut parts = [Part::Value(C::ZERO); 2];
        for r in [0, 1] {
            parts[r] = match sweep.far_single(p[r]) {
                Some(f) => Part::Value(f),
                None => {
                    let beyond = sweep.beyond(roots, r, omega);
                    let z = sweep.z(p[r]);
                    let z = if beyond { -z } else { z };
                    self.x.push(z.re);
                    self.y.push(z.im);
                    Part::Computed(self.x.len() - 1, beyond)
                }
            };
        }
        self.place.push((i, carrier));
        self.parts.push(parts);
        true
    }

    /// Adds `Re e^{−iθ} F[·]` at all points.
    fn add(&mut self, harmonic: &Prepared, roots: &Roots, y: &mut [f64; CHUNK]) {
        self.re.resize(self.x.len(), 0.0);
        self.im.resize(self.x.len(), 0.0);
        faddeeva_soa(&self.x, &self.y, &mut self.re, &mut self.im).expect("slices of one length");
        let factor = harmonic.sweep.factor();
        for ((i, carrier), parts) in self.place.iter().zip(&self.parts) {
            let [f, g] = parts.map(|part| match part {
                Part::Value(f) => f,
                Part::Computed(j, beyond) => {
                    let f = factor * C::new(self.re[j], self.im[j]);
                    if beyond { -f } else { f }
                }
            });
            y[*i] += (carrier * ((f - g) / roots.gap)).re * harmonic.scale;
        }
    }
}

impl Constants {
    fn new(harmonic: &Prepared) -> Constants {
        let by = harmonic.scale;
        let state = |[a, b]: [C; 2]| [a.re * by, b.re * by];
        let zero = [[0.0; 2]; 2];
        Constants {
            start: state(harmonic.start),
            passed: harmonic.left.map_or(zero, |left| left.map(state)),
            folded: harmonic.left.is_some(),
        }
    }
}

/// The forced parts of one harmonic at some times.
struct Forced<'a> {
    harmonic: &'a Prepared,
    roots: &'a Roots,
    free: &'a [Free],
    times: Times<'a>,
    sums: &'a mut Sums,
    near: &'a mut Near,
}

/// The free vibration at some times.
struct FreeAt<'a> {
    roots: &'a Roots,
    t: &'a [f64],
}

impl Task for FreeAt<'_> {
    type Output = Vec<Free>;

    #[inline(always)]
    fn run<L: Lanes>(self, _: L) -> Vec<Free> {
        let mut free = Vec::with_capacity(self.t.len());
        for t in self.t {
            free.push(Free::at(self.roots, *t));
        }
        free
    }
}

/// One harmonic's displacement and the state of the free vibration it has left.
#[inline(always)]
fn forced_once(harmonic: &Prepared, roots: &Roots, free: &Free, t: f64) -> [f64; 3] {
    let sweep = &harmonic.sweep;
    let carrier = sweep.carrier(t);
    let omega = sweep.omega(t);
    let p = two(
        #[inline(always)]
        |i| roots.p(i, omega),
    );
    let norms = [p[0].norm_sqr(), p[1].norm_sqr()];
    if !harmonic.is_closed(norms, t) {
        return [harmonic.psi(roots, free, carrier, t)[0].re, 0.0, 0.0];
    }
    let distance = sweep.distance(p[0]).min(sweep.distance(p[1]));
    let f = match distance >= FAR {
        true => sweep.far_displacement(roots, p, distance),
        false => sweep.displacement_near(roots, omega),
    };
    let mut y = (carrier * f).re;
    let [mut a, mut b] = harmonic.start;
    match &harmonic.left {
        Some(left) => {
            for i in [0, 1] {
                if p[i].im > -roots.lambda[i].re {
                    a += left[i][0];
                    b += left[i][1];
                }
            }
        }
        None => y += passage(sweep, roots, t, omega)[0].re,
    }
    let by = harmonic.scale;
    [y * by, a.re * by, b.re * by]
}

/// The displacement at one time.
pub(super) struct Once<'a> {
    pub response: &'a ChirpResponse,
    pub t: f64,
}

impl Task for Once<'_> {
    type Output = f64;

    #[inline(always)]
    fn run<L: Lanes>(self, _: L) -> f64 {
        let Once { response, t } = self;
        let roots = &response.roots;
        let free = Free::at(roots, t);
        let [mut a, mut b] = response.start;
        let mut sum = 0.0;
        for harmonic in response.constant.iter().chain(&response.harmonics) {
            let [y, c, d] = forced_once(harmonic, roots, &free, t);
            sum += y;
            a += c;
            b += d;
        }
        a.mul_add(free.k0, b.mul_add(free.k, sum))
    }
}

/// One harmonic's numbers at several times.
struct Wide<R> {
    carrier: Z<R>,
    p: [Z<R>; 2],
    sizes: [R; 2],
}

#[inline(always)]
fn like<R: Real>(t: R, x: Dd) -> Dd<R> {
    Dd::new(t.like(x.hi), t.like(x.lo))
}

#[inline(always)]
fn wide<R: Real>(harmonic: &Prepared, roots: &Roots, t: R) -> Wide<R> {
    let s = &harmonic.sweep;
    let (nu, kappa) = (like(t, s.nu), like(t, s.kappa));
    let omega = nu + kappa.mul_f(t);
    let turned = (nu + kappa.mul_f(t * t.like(0.5))).mul_f(t);
    let (rest, quadrant) = reduce(turned.add_f(t.like(s.delta)));
    let (sin, cos) = sin_cos_reduced(rest);
    let (sin, cos) = turn(sin, cos, quadrant);
    let p = two(
        #[inline(always)]
        |i| {
            let x = (omega + like(t, roots.beta[i])).value();
            Z(t.like(roots.lambda[i].re), x)
        },
    );
    Wide {
        carrier: Z(cos.value(), -sin.value()),
        sizes: two(
            #[inline(always)]
            |i| p[i].0.fma(p[i].0, p[i].1 * p[i].1),
        ),
        p,
    }
}

impl Task for Forced<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) {
        let Forced {
            harmonic,
            roots,
            free,
            times: Times { t, last },
            sums,
            near,
        } = self;
        let constants = Constants::new(harmonic);
        let sweep = &harmonic.sweep;
        let kappa = sweep.kappa.hi;
        // A passage is behind from here on; a little early where both roots pass as one.
        let edge = two(|r| match sweep.joint {
            true => roots.n - roots.half.hi.abs(),
            false => -roots.lambda[r].re,
        });
        // Finite, so that a distance of zero stays zero.
        let to_distance = if kappa == 0.0 { f64::MAX } else { 0.5 / kappa };
        let mut start = 0;
        while start < t.len() {
            let count = (t.len() - start).min(4);
            let mut four = [last; 4];
            four[..count].copy_from_slice(&t[start..start + count]);
            let time = lanes.quad(four);
            let like = |x: f64| time.like(x);
            let w = wide(harmonic, roots, time);
            let nearer = w.sizes[0].at_most(w.sizes[1]);
            let distance = nearer * like(to_distance);
            let [m, n] = two(
                #[inline(always)]
                |i| w.sizes[i].at_least(like(harmonic.norms[i])) * time * time,
            );
            let x = [w.p[0].1, w.p[1].1];
            let passed = two(
                #[inline(always)]
                |r| like(edge[r]).below(x[r]),
            );
            // Above one where the closed form serves and both resonances are far.
            let clear = m.at_most(n) * like(1.0 / (SHORT * SHORT));
            let mut clear = clear.at_most(distance * like(1.0 / FAR));
            if !constants.folded {
                clear = clear.pick(time.or(passed[0], passed[1]), like(0.0), clear);
            }
            let distances = lanes.array(distance);
            let least = distances.into_iter().fold(f64::INFINITY, f64::min);
            let terms = terms(least.max(FAR));
            let f = match time.all(sweep.apart_far(roots, nearer)) {
                true => difference(w.p, roots.gap, kappa, terms),
                false => of_both(w.p, kappa, terms),
            };
            let forced = w.carrier.0.fma(f.0, -(w.carrier.1 * f.1));
            if time.all(like(1.0).below(clear)) {
                let add = |sum: &mut [f64; CHUNK], x| {
                    let sum: &mut [f64] = &mut sum[start..start + 4];
                    let old = lanes.quad([sum[0], sum[1], sum[2], sum[3]]);
                    sum.copy_from_slice(&lanes.array(old + x));
                };
                let state = |i: usize| {
                    let zero = like(0.0);
                    let part = |r: usize| time.pick(passed[r], like(constants.passed[r][i]), zero);
                    like(constants.start[i]) + (part(0) + part(1))
                };
                add(&mut sums.y, forced * like(harmonic.scale));
                add(&mut sums.a, state(0));
                add(&mut sums.b, state(1));
                start += 4;
                continue;
            }
            let forced = lanes.array(forced);
            let carrier = [lanes.array(w.carrier.0), lanes.array(w.carrier.1)];
            let x = [lanes.array(x[0]), lanes.array(x[1])];
            let sizes = [lanes.array(w.sizes[0]), lanes.array(w.sizes[1])];
            for i in 0..count {
                let at = start + i;
                let time = t[at];
                if !harmonic.is_closed([sizes[0][i], sizes[1][i]], time) {
                    let carrier = sweep.carrier(time);
                    sums.y[at] += harmonic.psi(roots, &free[at], carrier, time)[0].re;
                    continue;
                }
                if distances[i] >= FAR {
                    sums.y[at] += forced[i] * harmonic.scale;
                } else {
                    let omega = sweep.omega(time);
                    let carrier = C::new(carrier[0][i], carrier[1][i]);
                    if !near.push(harmonic, roots, at, omega, carrier) {
                        let y = sweep.particular(roots, omega).y;
                        sums.y[at] += (carrier * y).re * harmonic.scale;
                    }
                }
                let [mut a, mut b] = constants.start;
                for r in [0, 1] {
                    if x[r][i] > edge[r] {
                        a += constants.passed[r][0];
                        b += constants.passed[r][1];
                    }
                }
                if !constants.folded && (x[0][i] > edge[0]) | (x[1][i] > edge[1]) {
                    let left = passage(sweep, roots, time, sweep.omega(time));
                    sums.y[at] += left[0].re * harmonic.scale;
                }
                sums.a[at] += a;
                sums.b[at] += b;
            }
            start += 4;
        }
    }
}
