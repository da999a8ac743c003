//! Displacements at many times: particular solutions four at a time, free vibrations once for all
//! harmonics.
//!
//! Past its first few radians every harmonic leaves a free vibration with a fixed initial state
//! `(a, b)`, which a passage through resonance changes once. So each time needs the sum of the
//! states and one evaluation of the impulse response, whatever the number of harmonics.

use super::free::Free;
use super::group::{CHUNK, Groups, add, four};
use super::harmonic::Prepared;
use super::inlined::two;
use super::passage::passage;
use super::response::ChirpResponse;
use super::roots::Roots;
use super::series::{FAR, Z, of_both, of_both_apart};
use crate::double_double::Dd;
use crate::faddeeva::faddeeva_soa;
use crate::lanes::{Lanes, Task, with_best};
use crate::real::Real;
use num_complex::Complex;

type C = Complex<f64>;

/// Describes what is gathered for each time.
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
        if !harmonic.sweep.phases_are_small(largest) {
            for ((y, free), t) in sums.y.iter_mut().zip(&free).zip(t) {
                let carrier = harmonic.sweep.carrier(*t);
                *y += harmonic.psi(roots, free, carrier, *t)[0].re;
            }
            continue;
        }
        near.clear();
        with_best(Forced {
            harmonic,
            roots,
            free: &free,
            t,
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

/// The forced parts of one harmonic at some times.
struct Forced<'a> {
    harmonic: &'a Prepared,
    roots: &'a Roots,
    free: &'a [Free],
    t: &'a [f64],
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

impl Task for Forced<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) {
        let Forced {
            harmonic,
            roots,
            free,
            t,
            sums,
            near,
        } = self;
        let groups = Groups::new(harmonic, roots);
        let sweep = &harmonic.sweep;
        let kappa = sweep.kappa.hi;
        let mut start = 0;
        while start < t.len() {
            let group = groups.at(lanes, four(t, start));
            let f = match group.apart {
                true => of_both_apart(group.p, roots, kappa, group.terms),
                false => of_both(group.p, kappa, group.terms),
            };
            let Z(cos, minus_sin) = group.carrier;
            let forced = cos.fma(f.0, -(minus_sin * f.1));
            if group.clear {
                let scale = cos.like(harmonic.scale);
                add(lanes, &mut sums.y, start, forced * scale);
                add(lanes, &mut sums.a, start, groups.left(&group, 0));
                add(lanes, &mut sums.b, start, groups.left(&group, 1));
                start += 4;
                continue;
            }
            let forced = lanes.array(forced);
            let carrier = [lanes.array(cos), lanes.array(minus_sin)];
            let x = [lanes.array(group.p[0].1), lanes.array(group.p[1].1)];
            let sizes = [lanes.array(group.sizes[0]), lanes.array(group.sizes[1])];
            for i in 0..(t.len() - start).min(4) {
                let at = start + i;
                let time = t[at];
                let carrier = C::new(carrier[0][i], carrier[1][i]);
                if !harmonic.is_closed([sizes[0][i], sizes[1][i]], time) {
                    sums.y[at] += harmonic.psi(roots, &free[at], carrier, time)[0].re;
                    continue;
                }
                if group.distances[i] >= FAR {
                    sums.y[at] += forced[i] * harmonic.scale;
                } else {
                    let omega = sweep.omega(time);
                    if !near.push(harmonic, roots, at, omega, carrier) {
                        let y = sweep.particular(roots, omega).y;
                        sums.y[at] += (carrier * y).re * harmonic.scale;
                    }
                }
                let x = [x[0][i], x[1][i]];
                if !groups.folded && (groups.has_passed(x[0], 0) | groups.has_passed(x[1], 1)) {
                    let left = passage(sweep, roots, time, sweep.omega(time));
                    sums.y[at] += left[0].re * harmonic.scale;
                }
                let [a, b] = groups.left_at(x);
                sums.a[at] += a;
                sums.b[at] += b;
            }
            start += 4;
        }
    }
}

#[cfg(test)]
mod tests;
