//! Displacement, velocity and acceleration at many times: four at a time where both resonances are
//! far, one by one elsewhere.

use super::free::Free;
use super::group::{CHUNK, Groups, add, four};
use super::response::ChirpResponse;
use super::roots::Roots;
use super::series::{Z, motion_apart, motion_of_both};
use super::types::Motion;
use crate::lanes::{Lanes, Task, with_best};
use crate::real::Real;

/// Describes what is gathered for each time.
struct Sums {
    /// Forced parts of y, y′, y″.
    motion: [[f64; CHUNK]; 3],
    /// States of the free vibration at `t = 0`.
    left: [[f64; CHUNK]; 2],
}

pub(super) fn motions(response: &ChirpResponse, times: &[f64], out: &mut [Motion]) {
    for (t, out) in times.chunks(CHUNK).zip(out.chunks_mut(CHUNK)) {
        let scaled: Vec<f64> = t.iter().map(|t| t * response.unit).collect();
        with_best(Chunk {
            response,
            t: &scaled,
            out,
        });
    }
}

struct Chunk<'a> {
    response: &'a ChirpResponse,
    t: &'a [f64],
    out: &'a mut [Motion],
}

impl Task for Chunk<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) {
        let Chunk { response, t, out } = self;
        let roots = &response.roots;
        let mut sums = Sums {
            motion: [[0.0; CHUNK]; 3],
            left: [[response.start[0]; CHUNK], [response.start[1]; CHUNK]],
        };
        let mut free = Vec::with_capacity(t.len());
        let mut largest: f64 = 0.0;
        for &t in t {
            free.push(Free::at(roots, t));
            largest = largest.max(t);
        }
        for harmonic in response.constant.iter().chain(&response.harmonics) {
            let groups = Groups::new(harmonic, roots);
            let s = &harmonic.sweep;
            let small = s.phases_are_small(largest);
            let mut start = 0;
            while start < t.len() {
                let group = groups.at(lanes, four(t, start));
                if group.clear && small {
                    let [y, v, a] = if group.apart {
                        motion_apart(group.p, roots, s.kappa.hi, group.omega, group.terms)
                    } else {
                        motion_of_both(
                            group.p,
                            response.roots.n,
                            s.kappa.hi,
                            group.omega,
                            group.terms,
                        )
                    };
                    forced(lanes, &groups, group.carrier, [y, v, a], &mut sums, start);
                    for i in [0, 1] {
                        add(lanes, &mut sums.left[i], start, groups.left(&group, i));
                    }
                } else {
                    for at in start..(start + 4).min(t.len()) {
                        let psi = harmonic.psi(roots, &free[at], s.carrier(t[at]), t[at]);
                        for (sum, psi) in sums.motion.iter_mut().zip(psi) {
                            sum[at] += psi.re;
                        }
                    }
                }
                start += 4;
            }
        }
        finish(response, roots, &free, &sums, out);
    }
}

/// Adds the forced part from its amplitudes.
#[inline(always)]
fn forced<L: Lanes>(
    lanes: L,
    groups: &Groups,
    carrier: Z<L::Quad>,
    amplitudes: [Z<L::Quad>; 3],
    sums: &mut Sums,
    start: usize,
) {
    let scale = carrier.0.like(groups.harmonic.scale);
    for j in 0..3 {
        let Z(re, im) = amplitudes[j];
        let x = carrier.0.fma(re, -(carrier.1 * im));
        add(lanes, &mut sums.motion[j], start, x * scale);
    }
}

#[inline(always)]
fn finish(response: &ChirpResponse, roots: &Roots, free: &[Free], sums: &Sums, out: &mut [Motion]) {
    for (i, out) in out.iter_mut().enumerate() {
        let (a, b) = (sums.left[0][i], sums.left[1][i]);
        let own = free[i].motion(roots.w, a.into(), b.into());
        let mut sum = [0.0; 3];
        for j in 0..3 {
            sum[j] = sums.motion[j][i] + own[j].re;
        }
        *out = response.scaled(sum);
    }
}
