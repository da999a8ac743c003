//! Many points at a time: put into buckets by the formula they need, a few hundred at a time on the
//! stack, then computed side by side.

pub(super) mod bucket;
mod buckets;
pub(super) mod chunk;
mod formulas;
mod later;
mod reflection;
mod sort;
mod tables;

use super::branch::{
    Branch, CELL, IN_STRIP, LOWER_CELL, MACLAURIN_9, MACLAURIN_21, REAL_AXIS, REAL_LINE, SERIES_2,
    SERIES_4, SERIES_6, SERIES_14, SERIES_26,
};
use super::plane::{Cancelled, cancels_beside_real_axis, w};
use super::points::Points;
use super::rows::{nearest_zero, zero_row};
use super::zeros;
use crate::lanes::Lanes;
use crate::pack::{Wide, WideTask, with_widest};
use crate::real::{Masked, Real, with_sign_of};
use bucket::LOWER;
use chunk::{Buffers, CHUNK, Chunk, GROUPS, ROOM};
use formulas::{InStrip, Maclaurin9, Maclaurin21, OnRealLine, Series, TwoTerms, UnlessLost};
use later::Later;
use num_complex::Complex;
use pulp::NullaryFnOnce;
use tables::{Cells, LowerDisc, RealAxis};

/// Batches of fewer points do not let any wait for others.
const MANY: usize = 4 * CHUNK;

/// Computes W at all points.
#[inline(always)]
pub(super) fn batch<S: Wide, L: Lanes, P: Points>(simd: S, lanes: L, points: &mut P) {
    let buffers = &mut Buffers::new();
    let total = points.len();
    let mut moved = None;
    let mut later = if total < MANY {
        None
    } else {
        Some(Later::new())
    };
    let mut start = 0;
    loop {
        if let Some(later) = &mut later
            && (later.is_full() || start == total && !later.is_empty())
        {
            let w = &mut own(&mut moved).w;
            let z = later.points();
            let mut chunk = Chunk { z, w, buffers };
            let (n, present, room) = (later.len(), later.classify(&mut chunk), 0);
            let chunk = chunk.lent();
            simd.outlined(Compute {
                simd,
                lanes,
                chunk,
                n,
                present,
                room,
            });
            later.store(&own(&mut moved).w, points);
            continue;
        }
        if start == total {
            break;
        }
        let n = CHUNK.min(total - start);
        let mut apart = false;
        let (z, w) = if let Some((z, w)) = points.chunk(start) {
            (z, w)
        } else {
            let Moved { z, w } = own(&mut moved);
            points.load(start, &mut z[..n]);
            apart = true;
            (&*z, w)
        };
        let mut chunk = Chunk { z, w, buffers };
        let present = chunk.classify(simd, n);
        let room = match &later {
            Some(later) => later.room(),
            None => 0,
        };
        simd.outlined(Compute {
            simd,
            lanes,
            chunk: chunk.lent(),
            n,
            present,
            room,
        });
        if let Some(later) = &mut later {
            later.take(&chunk, start);
        }
        if apart {
            points.store(start, &own(&mut moved).w[..n]);
        }
        start += n;
    }
}

/// Points and values that are not side by side in the batch.
struct Moved {
    z: [Complex<f64>; CHUNK],
    w: [Complex<f64>; CHUNK],
}

/// The room for them, made when it is needed first: short batches notice.
#[inline(always)]
fn own(moved: &mut Option<Moved>) -> &mut Moved {
    moved.get_or_insert_with(|| Moved {
        z: [Complex::ZERO; CHUNK],
        w: [Complex::ZERO; CHUNK],
    })
}

/// The values at the first `n` points of a chunk, whose buckets are known, but for those left for
/// later, as many as there is room for. A function of its own, because it is long and there are
/// several kinds of batches.
struct Compute<'a, S, L> {
    simd: S,
    lanes: L,
    chunk: Chunk<'a>,
    n: usize,
    present: u32,
    room: usize,
}

impl<S: Wide, L: Lanes> NullaryFnOnce for Compute<'_, S, L> {
    type Output = ();
    #[inline(always)]
    fn call(self) {
        let Compute {
            simd,
            lanes,
            mut chunk,
            n,
            present,
            room,
        } = self;
        chunk.buffers.order.sort(simd, n, present, (room, GROUPS));
        chunk.run(simd, lanes);
    }
}

/// In development builds a part of [`Chunk::run`] is a function of its own: without optimisation
/// all of them together need 3.5 MB of stack, more than a thread has.
#[inline(always)]
fn apart<S: Wide>(simd: S, part: impl FnOnce()) {
    if cfg!(debug_assertions) {
        simd.outlined(part);
    } else {
        part();
    }
}

impl Chunk<'_> {
    #[inline(always)]
    fn run<S: Wide, L: Lanes>(&mut self, simd: S, lanes: L) {
        self.buffers.near_zeros = 0;
        apart(
            simd,
            #[inline(always)]
            || self.upper(simd),
        );
        apart(
            simd,
            #[inline(always)]
            || self.one_term_dominates(simd, lanes),
        );
        apart(
            simd,
            #[inline(always)]
            || self.both_terms(simd, lanes),
        );
        apart(
            simd,
            #[inline(always)]
            || self.beside_real_axis(simd, lanes),
        );
        for at in 0..self.buffers.order.len(Branch::Huge.number()) {
            let i = self.buffers.order.numbers(Branch::Huge.number(), at)[0];
            self.alone(lanes, i);
        }
        self.next_to_zeros(simd, lanes);
    }

    /// The buckets whose formula gives the value.
    #[inline(always)]
    fn upper<S: Wide>(&mut self, simd: S) {
        self.rounded(simd, Cells::new(), CELL.number());
        self.without_rows(simd, SERIES_26.number(), Series::<26>);
        self.without_rows(simd, SERIES_14.number(), Series::<14>);
        self.without_rows(simd, SERIES_6.number(), Series::<6>);
        self.without_rows(simd, SERIES_4.number(), Series::<4>);
        self.without_rows(simd, SERIES_2.number(), TwoTerms);
        self.without_rows(simd, MACLAURIN_9.number(), Maclaurin9);
        self.without_rows(simd, MACLAURIN_21.number(), Maclaurin21);
        self.rounded(simd, LowerDisc::new(), LOWER_CELL.number());
        self.rounded(simd, RealAxis::new(), REAL_AXIS.number());
    }

    /// The buckets beside the real axis in which terms may cancel.
    #[inline(always)]
    fn beside_real_axis<S: Wide, L: Lanes>(&mut self, simd: S, lanes: L) {
        let bucket = REAL_AXIS.number() + LOWER;
        self.on_rows(
            simd,
            RealAxis::new(),
            bucket,
            #[inline(always)]
            |chunk, at, x, y, on| {
                let (re, im) = on.unevaluated(simd);
                chunk.scatter(bucket, at, re.hi, im.hi.with_sign_of(x));
                let lost = cancels_beside_real_axis(x.magnitude(), y, re.hi, im.hi);
                chunk.recompute(lanes, bucket, at, [(lost, x)]);
            },
        );
        self.strip(simd, lanes, IN_STRIP.number(), InStrip);
        self.strip(simd, lanes, REAL_LINE.number(), OnRealLine);
    }

    /// The asymptotic series and the exponential beside the real axis.
    #[inline(always)]
    fn strip<S: Wide, L: Lanes>(
        &mut self,
        simd: S,
        lanes: L,
        bucket: usize,
        formula: impl UnlessLost,
    ) {
        let len = self.buffers.order.len(bucket);
        let mut at = 0;
        while at < len {
            let (x, y) = self.gather_two(simd, self.buffers.order.numbers(bucket, at));
            let (re, im, lost) = formula.value(x.magnitude(), y);
            let im = im.with_sign_of(x);
            self.scatter(bucket, at, re.0, im.0);
            self.scatter(bucket, at + S::WIDTH, re.1, im.1);
            self.recompute(lanes, bucket, at, [(lost.0, x.0), (lost.1, x.1)]);
            at += 2 * S::WIDTH;
        }
    }

    /// Point `i` by the scalar code.
    #[cold]
    #[inline(always)]
    fn alone<L: Lanes>(&mut self, lanes: L, i: u8) {
        let [x, y] = self.at(i);
        let value = w(lanes, x, y);
        self.put(i, value);
    }

    /// Point `i` in double-double.
    #[inline(always)]
    fn cancelled<L: Lanes>(&mut self, lanes: L, i: u8) {
        let [x, y] = self.at(i);
        let (re, im) = lanes.call(Cancelled {
            a: x.abs(),
            b: y.abs(),
        });
        self.put(i, (re, with_sign_of(im, x)));
    }

    /// The points next to a zero.
    #[inline(always)]
    fn next_to_zeros<S: Wide, L: Lanes>(&mut self, simd: S, lanes: L) {
        let len = self.buffers.near_zeros.min(CHUNK);
        if len == 0 {
            return;
        }
        let last = self.buffers.zeros[len - 1];
        self.buffers.zeros[len..][..GROUPS].fill(last);
        let mut at = 0;
        while at < len {
            let numbers = window(&self.buffers.zeros, at);
            let (x, y) = self.gather(simd, numbers, 0);
            let mut rows = [zero_row(0); 8];
            for m in 0..S::WIDTH {
                let [x, y] = self.at(numbers[m]);
                rows[m] = zero_row(nearest_zero(x.abs(), -y).unwrap_or(0));
            }
            let (re, im, lost) = zeros::near_zeros(simd, &rows, x.magnitude(), y);
            let im = im.with_sign_of(x);
            let lost = re.pick(lost, re.like(1.0), re.like(0.0));
            let (re, im, lost) = (re.array(), im.array(), lost.array());
            for m in 0..(len - at).min(S::WIDTH) {
                let i = self.buffers.zeros[at + m];
                if lost[m] == 0.0 {
                    self.put(i, (re[m], im[m]));
                } else {
                    self.cancelled(lanes, i);
                }
            }
            at += S::WIDTH;
        }
    }
}

/// The numbers of two groups.
#[inline(always)]
fn window(numbers: &[u8; ROOM], at: usize) -> &[u8; GROUPS] {
    numbers[at.min(CHUNK)..]
        .first_chunk()
        .expect("there is room")
}

/// W at all points.
struct Batch<'a, P>(&'a mut P);

impl<P: Points> WideTask for Batch<'_, P> {
    type Output = ();
    #[inline(always)]
    fn run<S: Wide, L: Lanes>(self, simd: S, lanes: L) {
        batch(simd, lanes, self.0);
    }
}

/// Runs the batch with the widest vectors of this processor; `false` if it has none.
pub(super) fn with_best_vectors<P: Points>(points: &mut P) -> bool {
    with_widest(Batch(points)).is_ok()
}
