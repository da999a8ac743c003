//! Many points at a time: put into buckets by the formula they need, a few hundred at a time on the
//! stack, then computed side by side.

use super::Points;
use super::asymptotic::{series, series_rounded};
use super::double_double::Dd;
use super::exponential::{LARGE_PHASE, exp_minus_square};
use super::lanes::Lanes;
use super::maclaurin::maclaurin;
use super::pack::{Pack, Wide};
use super::plane::{
    ALONE, BUCKETS, Cancelled, Kind, LOWER, above_real_axis, below_real_axis, bucket,
    cancels_beside_real_axis, from_erfcx, from_erfcx_rounded, in_strip, negligible, reflect, w,
};
use super::real::{ROUND, Real};
use super::rows::{Cells, ImaginaryAxis, LowerDisc, NoRows, On, RealAxis, Rows};
use super::taylor::{complex_rows, complex_rows_rounded, real_rows, real_rows_rounded};
use super::zeros;

/// Points sorted at a time.
const CHUNK: usize = 256;
/// Places of a bucket: room for all points, and for repeating the last one.
const ROOM: usize = CHUNK + 8;

/// The buffers for one chunk.
struct Chunk<'a, P> {
    points: &'a mut P,
    start: usize,
    /// The points as they come, and the numbers of their buckets plus `ROUND`.
    x: [f64; CHUNK],
    y: [f64; CHUNK],
    code: [f64; CHUNK],
    /// How many points each bucket has, and which.
    len: [usize; BUCKETS],
    order: [[u8; ROOM]; BUCKETS],
    /// The points of the bucket at work, and on which rows at what distances from the centres.
    a: [f64; ROOM],
    b: [f64; ROOM],
    row: [u16; ROOM],
    dx: [f64; ROOM],
    dy: [f64; ROOM],
    /// The values.
    re: [f64; CHUNK],
    im: [f64; CHUNK],
    /// The points next to a zero.
    zeros: [u8; ROOM],
    near_zeros: usize,
}

/// Computes W at all points.
#[inline(always)]
pub(super) fn batch<S: Wide, L: Lanes, P: Points>(simd: S, lanes: L, points: &mut P) {
    let total = points.len();
    let mut chunk = Chunk {
        points,
        start: 0,
        x: [0.0; CHUNK],
        y: [0.0; CHUNK],
        code: [0.0; CHUNK],
        len: [0; BUCKETS],
        order: [[0; ROOM]; BUCKETS],
        a: [0.0; ROOM],
        b: [0.0; ROOM],
        row: [0; ROOM],
        dx: [0.0; ROOM],
        dy: [0.0; ROOM],
        re: [0.0; CHUNK],
        im: [0.0; CHUNK],
        zeros: [0; ROOM],
        near_zeros: 0,
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
        self.near_zeros = 0;
        self.sort(simd, n);

        self.rounded(
            simd,
            lanes,
            Cells,
            Kind::Cell as usize,
            #[inline(always)]
            |simd, _, _, on| complex_rows_rounded(simd, &on.rows, on.dx, on.dy),
        );
        self.reflected(
            simd,
            lanes,
            Cells,
            Kind::Cell,
            #[inline(always)]
            |simd, _, _, on| complex_rows(simd, &on.rows, on.dx, on.dy),
        );
        self.rounded(
            simd,
            lanes,
            ImaginaryAxis,
            Kind::ImaginaryAxis as usize,
            #[inline(always)]
            |simd, a, _, on| from_erfcx_rounded(a, real_rows_rounded(simd, &on.rows, on.dx, a)),
        );
        self.reflected(
            simd,
            lanes,
            ImaginaryAxis,
            Kind::ImaginaryAxis,
            #[inline(always)]
            |simd, a, _, on| from_erfcx(a, real_rows(simd, &on.rows, on.dx, a)),
        );
        self.asymptotic::<S, L, 24>(simd, lanes, Kind::Series24);
        self.asymptotic::<S, L, 14>(simd, lanes, Kind::Series14);
        self.asymptotic::<S, L, 6>(simd, lanes, Kind::Series6);

        self.rounded(
            simd,
            lanes,
            NoRows,
            Kind::Small as usize,
            #[inline(always)]
            |_, a, y, _| maclaurin(a, y),
        );
        self.rounded(
            simd,
            lanes,
            NoRows,
            Kind::Series4 as usize,
            #[inline(always)]
            |_, a, y, _| series_rounded::<_, 4>(a, y.magnitude()),
        );
        self.rounded(
            simd,
            lanes,
            LowerDisc,
            Kind::Disc as usize,
            #[inline(always)]
            |simd, _, _, on| complex_rows_rounded(simd, &on.rows, on.dx, on.dy),
        );
        self.rounded(
            simd,
            lanes,
            RealAxis,
            Kind::RealAxis as usize,
            #[inline(always)]
            |simd, _, y, on| {
                let y = above_real_axis(y.magnitude());
                complex_rows_rounded(simd, &on.rows, on.dx, y)
            },
        );
        self.points(
            simd,
            lanes,
            RealAxis,
            Kind::RealAxis as usize + LOWER,
            #[inline(always)]
            |simd, a, y, on| {
                let (re, im) = complex_rows(simd, &on.rows, on.dx, below_real_axis(y));
                let cancels = cancels_beside_real_axis(a, y, re.hi, im.hi);
                lost((re.hi, im.hi, cancels))
            },
        );
        self.points(
            simd,
            lanes,
            NoRows,
            Kind::Strip as usize,
            #[inline(always)]
            |_, a, y, _| lost(in_strip(a, y)),
        );

        for at in 0..self.len[Kind::Other as usize].min(CHUNK) {
            self.alone(lanes, self.order[Kind::Other as usize][at]);
        }
        self.next_to_zeros(simd, lanes);
        let (re, im) = (&self.re, &self.im);
        self.points.store(
            self.start,
            n,
            #[inline(always)]
            |i| (re[i & (CHUNK - 1)], im[i & (CHUNK - 1)]),
        );
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
            bucket(x.magnitude(), y).store_at(&mut self.code, at);
            at += S::WIDTH;
        }
        for (i, code) in self.code[..n].iter().enumerate() {
            // Below 2⁵¹ and whole: the low bits after adding ROUND.
            let bucket = (code.to_bits() as usize & 31).min(BUCKETS - 1);
            let len = self.len[bucket];
            self.order[bucket][len & (CHUNK - 1)] = i as u8;
            self.len[bucket] = len + 1;
        }
    }

    /// Takes the value at point `i`.
    #[inline(always)]
    fn put(&mut self, i: u8, (re, im): (f64, f64)) {
        self.re[i as usize] = re;
        self.im[i as usize] = im;
    }

    /// Point `i` by the scalar code.
    #[cold]
    #[inline(always)]
    fn alone<L: Lanes>(&mut self, lanes: L, i: u8) {
        let value = w(lanes, self.x[i as usize], self.y[i as usize]);
        self.put(i, value);
    }

    /// Point `i` in double-double.
    #[inline(always)]
    fn cancelled<L: Lanes>(&mut self, lanes: L, i: u8) {
        let (x, y) = (self.x[i as usize], self.y[i as usize]);
        let (re, im) = lanes.call(Cancelled {
            a: x.abs(),
            b: y.abs(),
        });
        self.put(i, (re, if x.is_sign_negative() { -im } else { im }));
    }

    /// The points next to a zero.
    #[inline(always)]
    fn next_to_zeros<S: Wide, L: Lanes>(&mut self, simd: S, lanes: L) {
        let len = self.near_zeros;
        if len == 0 {
            return;
        }
        let last = self.zeros[(len - 1).min(CHUNK)];
        self.zeros[len.min(CHUNK)..][..8].fill(last);
        let mut at = 0;
        while at < len {
            let (mut x, mut y) = ([0.0; 8], [0.0; 8]);
            let mut rows = [zeros::row(0); 8];
            for m in 0..S::WIDTH {
                let i = self.zeros[at + m] as usize;
                (x[m], y[m]) = (self.x[i], self.y[i]);
                rows[m] = zeros::row(zeros::nearest(x[m].abs(), -y[m]).unwrap_or(0));
            }
            let (x, y) = (Pack::load(simd, &x, 0), Pack::load(simd, &y, 0));
            let (re, im, lost) = lost(zeros::near_zeros(simd, &rows, x.magnitude(), y));
            let (re, im, lost) = (array(re), array(im.with_sign_of(x)), array(lost));
            let n = (len - at).min(S::WIDTH);
            for m in 0..n {
                let i = self.zeros[at + m];
                if lost[m] == 0.0 {
                    self.put(i, (re[m], im[m]));
                } else {
                    self.cancelled(lanes, i);
                }
            }
            at += n;
        }
    }

    /// The buckets of the asymptotic series.
    #[inline(always)]
    fn asymptotic<S: Wide, L: Lanes, const N: usize>(&mut self, simd: S, lanes: L, kind: Kind) {
        self.rounded(
            simd,
            lanes,
            NoRows,
            kind as usize,
            #[inline(always)]
            |_, a, y, _| series_rounded::<_, N>(a, y.magnitude()),
        );
        self.reflected(
            simd,
            lanes,
            NoRows,
            kind,
            #[inline(always)]
            |_, a, b, _| series::<_, N>(a, b),
        );
    }

    /// A bucket whose formula gives the value.
    #[inline(always)]
    fn rounded<S: Wide, L: Lanes, const N: usize>(
        &mut self,
        simd: S,
        lanes: L,
        rows: impl Rows<N>,
        bucket: usize,
        formula: impl Fn(S, Pack<S>, Pack<S>, On<'_, S, N>) -> (Pack<S>, Pack<S>),
    ) {
        self.points(
            simd,
            lanes,
            rows,
            bucket,
            #[inline(always)]
            |simd, a, y, on| {
                let (re, im) = formula(simd, a, y, on);
                (re, im, a.like(0.0))
            },
        );
    }

    /// The bucket in the lower half-plane of a formula that gives `w(a + i|y|)`.
    #[inline(always)]
    fn reflected<S: Wide, L: Lanes, const N: usize>(
        &mut self,
        simd: S,
        lanes: L,
        rows: impl Rows<N>,
        kind: Kind,
        formula: impl Fn(S, Pack<S>, Pack<S>, On<'_, S, N>) -> (Dd<Pack<S>>, Dd<Pack<S>>),
    ) {
        self.points(
            simd,
            lanes,
            rows,
            kind as usize + LOWER,
            #[inline(always)]
            |simd, a, y, on| {
                let (u, v) = formula(simd, a, y.magnitude(), on);
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

    /// Brings the points of a bucket together; the last one is repeated, so that groups are whole.
    #[inline(always)]
    fn gather(&mut self, bucket: usize, len: usize) {
        let order = &mut self.order[bucket];
        let last = order[len - 1];
        order[len..len + 8].fill(last);
        let parts = self.a.iter_mut().zip(&mut self.b);
        for (&i, (a, b)) in order[..len + 8].iter().zip(parts) {
            *a = self.x[i as usize];
            *b = self.y[i as usize];
        }
    }

    /// Finds the rows of the points of a bucket and their distances from the centres: beforehand,
    /// because all that follows waits for the row.
    #[inline(always)]
    fn locate<S: Wide, const N: usize>(&mut self, simd: S, rows: impl Rows<N>, len: usize) {
        let mut at = 0;
        while at < len {
            let (x, y) = (Pack::load(simd, &self.a, at), Pack::load(simd, &self.b, at));
            let [codes, dx, dy] = rows.locate(x.magnitude(), y);
            let codes = array(codes);
            for m in 0..S::WIDTH {
                self.row[at + m] = rows.number(codes[m]);
            }
            dx.store_at(&mut self.dx, at);
            dy.store_at(&mut self.dy, at);
            at += S::WIDTH;
        }
    }

    /// A bucket: the formula gives both parts and a state for each point: 0 is done, 1 asks for
    /// double-double, 2 for the scalar code; with 4 added the point may lie next to a zero.
    #[inline(always)]
    fn points<S: Wide, L: Lanes, R: Rows<N>, const N: usize>(
        &mut self,
        simd: S,
        lanes: L,
        rows: R,
        bucket: usize,
        formula: impl Fn(S, Pack<S>, Pack<S>, On<'_, S, N>) -> (Pack<S>, Pack<S>, Pack<S>),
    ) {
        let len = self.len[bucket].min(CHUNK);
        if len == 0 {
            return;
        }
        self.gather(bucket, len);
        if R::SOME {
            self.locate(simd, rows, len);
        }
        let mut at = 0;
        while at < len {
            let (x, y) = (Pack::load(simd, &self.a, at), Pack::load(simd, &self.b, at));
            let mut group = [rows.row(0); 8];
            for m in 0..S::WIDTH {
                group[m] = rows.row(self.row[at + m]);
            }
            let on = On {
                rows: group,
                dx: Pack::load(simd, &self.dx, at),
                dy: Pack::load(simd, &self.dy, at),
            };
            let (re, im, state) = formula(simd, x.magnitude(), y, on);
            let done = state.is_zero();
            let (re, im) = (array(re), array(im.with_sign_of(x)));
            if done {
                for m in 0..S::WIDTH {
                    self.put(self.order[bucket][at + m], (re[m], im[m]));
                }
            } else {
                let state = array(state);
                for m in 0..(len - at).min(S::WIDTH) {
                    self.take(lanes, self.order[bucket][at + m], (re[m], im[m]), state[m]);
                }
            }
            at += S::WIDTH;
        }
    }

    /// Takes the value for point `i`, or another as its state asks.
    #[inline(always)]
    fn take<L: Lanes>(&mut self, lanes: L, i: u8, value: (f64, f64), state: f64) {
        let (x, y) = (self.x[i as usize], self.y[i as usize]);
        if state >= 4.0 && zeros::nearest(x.abs(), -y).is_some() {
            self.zeros[self.near_zeros.min(CHUNK)] = i;
            self.near_zeros += 1;
            return;
        }
        match state as u8 & 3 {
            0 => self.put(i, value),
            1 => self.cancelled(lanes, i),
            _ => self.alone(lanes, i),
        }
    }
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
