//! Many points at a time: sorted by the formula they need, a few hundred at a time on the stack,
//! then computed side by side.

use super::Points;
use super::asymptotic::series;
use super::double_double::Dd;
use super::exponential::{LARGE_PHASE, exp_minus_square};
use super::lanes::Lanes;
use super::maclaurin::maclaurin;
use super::pack::{Pack, Wide};
use super::plane::{
    ALONE, BUCKETS, Cancelled, Kind, LOWER, bucket, cancels_beside_real_axis, cell, cell_row,
    disc_cell, disc_row, from_erfcx, imaginary_axis_row, in_strip, negligible, on_axis,
    on_real_axis, real_axis_row, reflect, right_half_plane,
};
use super::real::{ROUND, Real};
use super::taylor::{ComplexRow, complex_rows, real_rows};
use super::zeros;

/// Points sorted at a time: their numbers fit into a byte.
const CHUNK: usize = 256;
/// Room for the numbers of the points in a bucket, and some to repeat the last one.
const ROOM: usize = 512;

/// The buffers for one chunk.
struct Chunk<'a, P> {
    points: &'a mut P,
    start: usize,
    x: [f64; CHUNK],
    y: [f64; CHUNK],
    /// The points of each bucket: how many, and their numbers.
    len: [usize; BUCKETS],
    index: [[u8; ROOM]; BUCKETS],
}

/// Points whose terms cancel.
const CANCELLED: usize = BUCKETS - 2;
/// Points next to a zero.
const ZERO: usize = BUCKETS - 3;
/// Points that turn out to need the scalar code.
const SCALAR: usize = BUCKETS - 1;

/// Computes W at all points.
#[inline(always)]
pub(super) fn batch<S: Wide, L: Lanes, P: Points>(simd: S, lanes: L, points: &mut P) {
    let total = points.len();
    let mut chunk = Chunk {
        points,
        start: 0,
        x: [0.0; CHUNK],
        y: [0.0; CHUNK],
        len: [0; BUCKETS],
        index: [[0; ROOM]; BUCKETS],
    };
    while chunk.start < total {
        chunk.run(simd, lanes, (total - chunk.start).min(CHUNK));
        chunk.start += CHUNK;
    }
}

impl<P: Points> Chunk<'_, P> {
    #[inline(always)]
    fn run<S: Wide, L: Lanes>(&mut self, simd: S, lanes: L, n: usize) {
        self.len = [0; BUCKETS];
        self.sort(simd, n);

        self.both(
            simd,
            Kind::Cell,
            #[inline(always)]
            |simd, a, b| {
                let [n, dx, dy] = cell(a, b);
                complex_rows(simd, &rows(n, cell_row), dx, dy)
            },
        );
        self.both(
            simd,
            Kind::ImaginaryAxis,
            #[inline(always)]
            |simd, a, b| {
                let (n, t) = on_axis(b);
                let n = array(n);
                let mut rows = [&imaginary_axis_row(ROUND).0; 8];
                for m in 0..S::WIDTH {
                    rows[m] = &imaginary_axis_row(n[m]).0;
                }
                from_erfcx(a, real_rows(simd, &rows, t, a))
            },
        );
        self.both(
            simd,
            Kind::Series24,
            #[inline(always)]
            |_, a, b| series::<_, 24>(a, b),
        );
        self.both(
            simd,
            Kind::Series14,
            #[inline(always)]
            |_, a, b| series::<_, 14>(a, b),
        );
        self.both(
            simd,
            Kind::Series6,
            #[inline(always)]
            |_, a, b| series::<_, 6>(a, b),
        );

        self.points(
            simd,
            Kind::Small as usize,
            #[inline(always)]
            |_, a, y| {
                let (re, im) = maclaurin(a, y);
                (re, im, a.like(0.0))
            },
        );
        self.points(
            simd,
            Kind::Disc as usize,
            #[inline(always)]
            |simd, a, y| {
                let [n, dx, dy] = disc_cell(a, y);
                let (re, im) = complex_rows(simd, &rows(n, disc_row), dx, dy);
                (re.hi, im.hi, a.like(0.0))
            },
        );
        self.points(
            simd,
            Kind::RealAxis as usize,
            #[inline(always)]
            |simd, a, y| {
                let (n, t) = on_real_axis(a);
                let (re, im) = complex_rows(simd, &rows(n, real_axis_row), t, y);
                let cancels = cancels_beside_real_axis(a, y, re.hi, im.hi);
                lost((re.hi, im.hi, cancels))
            },
        );
        self.points(
            simd,
            Kind::Strip as usize,
            #[inline(always)]
            |_, a, y| lost(in_strip(a, y)),
        );

        self.near_zeros(simd);
        self.one_by_one(
            CANCELLED,
            #[inline(always)]
            |a, y| lanes.call(Cancelled { a, b: y.abs() }),
        );
        for bucket in [SCALAR, Kind::Other as usize] {
            self.one_by_one(
                bucket,
                #[inline(always)]
                |a, y| right_half_plane(lanes, a, y),
            );
        }
    }

    #[inline(always)]
    fn push(&mut self, bucket: usize, point: usize) {
        let at = self.len[bucket];
        self.index[bucket][at & (ROOM - 1)] = point as u8;
        self.len[bucket] = at + 1;
    }

    /// Sorts `n` points into the buckets.
    #[inline(always)]
    fn sort<S: Wide>(&mut self, simd: S, n: usize) {
        self.points
            .load(self.start, &mut self.x[..n], &mut self.y[..n]);
        let mut at = 0;
        while at < n {
            let x = Pack::load(simd, &self.x, at);
            let y = Pack::load(simd, &self.y, at);
            let code = array(bucket(x.magnitude(), y));
            for (i, code) in code.iter().enumerate().take((n - at).min(S::WIDTH)) {
                // Below 2⁵¹ and whole: the low bits after adding ROUND.
                self.push(code.to_bits() as usize & (BUCKETS - 1), at + i);
            }
            at += S::WIDTH;
        }
    }

    /// The points next to a zero.
    #[inline(always)]
    fn near_zeros<S: Wide>(&mut self, simd: S) {
        self.points(
            simd,
            ZERO,
            #[inline(always)]
            |simd, a, y| {
                let (ai, yi) = (array(a), array(y));
                let mut rows = [zeros::row(0); 8];
                for m in 0..S::WIDTH {
                    rows[m] = zeros::row(zeros::nearest(ai[m], -yi[m]).unwrap_or(0));
                }
                lost(zeros::near_zeros(simd, &rows, a, y))
            },
        );
    }

    /// A bucket whose points are computed one after the other.
    #[inline(always)]
    fn one_by_one(&mut self, bucket: usize, formula: impl Fn(f64, f64) -> (f64, f64)) {
        for i in 0..self.len[bucket] {
            let k = self.index[bucket][i & (ROOM - 1)] as usize;
            let (x, y) = (self.x[k], self.y[k]);
            let (re, im) = formula(x.abs(), y);
            let im = if x.is_sign_negative() { -im } else { im };
            self.points.put(self.start + k, re, im);
        }
    }

    /// The two buckets of a formula that gives `w(a + i|y|)`.
    #[inline(always)]
    fn both<S: Wide>(
        &mut self,
        simd: S,
        kind: Kind,
        formula: impl Fn(S, Pack<S>, Pack<S>) -> (Dd<Pack<S>>, Dd<Pack<S>>),
    ) {
        self.points(
            simd,
            kind as usize,
            #[inline(always)]
            |simd, a, y| {
                let (u, v) = formula(simd, a, y.magnitude());
                (u.hi, v.hi, a.like(0.0))
            },
        );
        self.points(
            simd,
            kind as usize + LOWER,
            #[inline(always)]
            |simd, a, y| {
                let (u, v) = formula(simd, a, y.magnitude());
                let none = negligible(a, y.magnitude(), u.hi, v.hi);
                let e = exp_minus_square(a, y);
                let (re, im, lost) = reflect((u, v), e);
                let (zero, one, two) = (re.like(0.0), re.like(1.0), re.like(2.0));
                let state = re.pick(lost, one, zero);
                let phase = ((a + a) * y).magnitude();
                let state = re.pick(phase.below(re.like(LARGE_PHASE)), state, two);
                let state = re.pick(e.2.below(re.like(ROUND + ALONE)), state, two);
                // Four more: perhaps next to a zero.
                let more = re.pick(zeros::candidate(a, y.magnitude()), re.like(4.0), zero);
                let state = state + more;
                (
                    re.pick(none, -u.hi, re),
                    im.pick(none, v.hi, im),
                    re.pick(none, zero, state),
                )
            },
        );
    }

    /// A bucket: the formula gives both parts and a state for each point: 0 is done, 1 asks for
    /// double-double, 2 for the scalar code.
    #[inline(always)]
    fn points<S: Wide>(
        &mut self,
        simd: S,
        bucket: usize,
        formula: impl Fn(S, Pack<S>, Pack<S>) -> (Pack<S>, Pack<S>, Pack<S>),
    ) {
        let len = self.len[bucket];
        if len == 0 {
            return;
        }
        // The last group repeats the last point.
        let last = self.index[bucket][len - 1];
        self.index[bucket][len..len + 8].fill(last);
        let mut at = 0;
        while at < len {
            let mut index = [0usize; 8];
            let (mut x, mut y) = ([0.0; 8], [0.0; 8]);
            for m in 0..S::WIDTH {
                index[m] = self.index[bucket][(at + m) & (ROOM - 1)] as usize;
                x[m] = self.x[index[m]];
                y[m] = self.y[index[m]];
            }
            let (x, y) = (Pack::load(simd, &x, 0), Pack::load(simd, &y, 0));
            let (re, im, state) = formula(simd, x.magnitude(), y);
            let im = im.with_sign_of(x);
            let (re, im) = (array(re), array(im));
            let n = (len - at).min(S::WIDTH);
            if state.is_zero() {
                for m in 0..n {
                    self.points.put(self.start + index[m], re[m], im[m]);
                }
            } else {
                let state = array(state);
                for m in 0..n {
                    let k = index[m];
                    if state[m] >= 4.0 && zeros::nearest(self.x[k].abs(), -self.y[k]).is_some() {
                        self.push(ZERO, k);
                        continue;
                    }
                    match state[m] as u8 & 3 {
                        0 => self.points.put(self.start + k, re[m], im[m]),
                        1 => self.push(CANCELLED, k),
                        _ => self.push(SCALAR, k),
                    }
                }
            }
            at += n;
        }
    }
}

/// The rows with the numbers `n`.
#[inline(always)]
fn rows<S: Wide>(n: Pack<S>, row: impl Fn(f64) -> &'static ComplexRow) -> [&'static [f64; 40]; 8] {
    let n = array(n);
    let mut rows = [&row(ROUND).0; 8];
    for m in 0..S::WIDTH {
        rows[m] = &row(n[m]).0;
    }
    rows
}

/// The state of points whose terms may cancel.
#[inline(always)]
fn lost<S: Wide>((re, im, lost): (Pack<S>, Pack<S>, S::m64s)) -> (Pack<S>, Pack<S>, Pack<S>) {
    (re, im, re.pick(lost, re.like(1.0), re.like(0.0)))
}

/// The numbers of a pack; those beyond its width are zero.
#[inline(always)]
fn array<S: Wide>(x: Pack<S>) -> [f64; 8] {
    let mut v = [0.0; 8];
    x.store(&mut v);
    v
}
