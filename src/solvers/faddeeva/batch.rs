//! Many points at a time: put into buckets by the formula they need, a few hundred at a time on the
//! stack, then computed side by side.

use super::Points;
use super::asymptotic::{series, series_rounded};
use super::double_double::Dd;
use super::exponential::{LARGE_PHASE, exp_minus_square};
use super::lanes::Lanes;
use super::maclaurin::maclaurin;
use super::pack::{Pack, Wide};
use super::branch::{BUCKETS, Kind, LOWER, SERIES_ALONE, bucket, places};
use super::plane::{
    ALONE, Cancelled, above_real_axis, below_real_axis, cancels_beside_real_axis, from_erfcx,
    from_erfcx_rounded, in_strip, negligible, reflect, w,
};
use super::real::{ROUND, Real, Two};
use super::rows::{Cells, ImaginaryAxis, LowerDisc, NoRows, On, RealAxis, Rows};
use super::taylor::{complex_rows, complex_rows_rounded, real_rows, real_rows_rounded};
use super::zeros;
use num_complex::Complex;

/// Points sorted at a time.
const CHUNK: usize = 256;
/// Places of a bucket: room for all points, and for repeating the last one.
const ROOM: usize = CHUNK + 16;
/// Room for all buckets, a power of two.
const SETS: usize = BUCKETS.next_power_of_two();

/// A formula for both parts of w at `a + i y`.
trait Formula: Copy {
    fn value<R: Real>(self, a: R, y: R) -> (R, R);
}

#[derive(Clone, Copy)]
struct Maclaurin;

impl Formula for Maclaurin {
    #[inline(always)]
    fn value<R: Real>(self, a: R, y: R) -> (R, R) {
        maclaurin(a, y)
    }
}

/// The asymptotic series with N terms.
#[derive(Clone, Copy)]
struct Series<const N: usize>;

impl<const N: usize> Formula for Series<N> {
    #[inline(always)]
    fn value<R: Real>(self, a: R, y: R) -> (R, R) {
        series_rounded::<_, N>(a, y.magnitude())
    }
}

/// A chunk of points and the place for their values, and what is needed to sort them.
struct Chunk<'a> {
    z: &'a [Complex<f64>; CHUNK],
    w: &'a mut [Complex<f64>; CHUNK],
    buffers: &'a mut Buffers,
}

struct Buffers {
    /// How many points each bucket has, and which.
    len: [usize; SETS],
    order: [[u8; ROOM]; SETS],
    /// The same of points with odd numbers, until both are brought together: one count need not
    /// wait for the other.
    odd: [[u8; CHUNK / 2]; SETS],
    /// The points of the bucket at work that needs rows, these, and the distances from the centres.
    a: [f64; ROOM],
    b: [f64; ROOM],
    row: [u16; ROOM],
    dx: [f64; ROOM],
    dy: [f64; ROOM],
    /// The points in the lower half-plane for which W at their mirror images is done, and that.
    below: [u8; ROOM],
    w: [[f64; ROOM]; 4],
    mirrored: usize,
    /// The points next to a zero.
    zeros: [u8; ROOM],
    near_zeros: usize,
}

/// Computes W at all points.
#[inline(always)]
pub(super) fn batch<S: Wide, L: Lanes, P: Points>(simd: S, lanes: L, points: &mut P) {
    let mut buffers = Buffers {
        len: [0; SETS],
        order: [[0; ROOM]; SETS],
        odd: [[0; CHUNK / 2]; SETS],
        a: [0.0; ROOM],
        b: [0.0; ROOM],
        row: [0; ROOM],
        dx: [0.0; ROOM],
        dy: [0.0; ROOM],
        below: [0; ROOM],
        w: [[0.0; ROOM]; 4],
        mirrored: 0,
        zeros: [0; ROOM],
        near_zeros: 0,
    };
    let buffers = &mut buffers;
    let total = points.len();
    let mut start = 0;
    while start < total {
        let n = (total - start).min(CHUNK);
        if let Some((z, w)) = points.chunk(start) {
            Chunk { z, w, buffers }.run(simd, lanes, n);
        } else {
            let (mut z, mut w) = ([Complex::ZERO; CHUNK], [Complex::ZERO; CHUNK]);
            points.load(start, &mut z[..n]);
            let (z, w) = (&z, &mut w);
            Chunk { z, w, buffers }.run(simd, lanes, n);
            points.store(start, &w[..n]);
        }
        start += n;
    }
}

impl Chunk<'_> {
    #[inline(always)]
    fn run<S: Wide, L: Lanes>(&mut self, simd: S, lanes: L, n: usize) {
        self.buffers.near_zeros = 0;
        self.buffers.mirrored = 0;
        self.sort(simd, n);

        self.rounded(
            simd,
            Cells,
            Kind::Cell as usize,
            #[inline(always)]
            |simd, _, _, on| complex_rows_rounded(simd, &on.rows, on.dx, on.dy),
        );
        self.mirrored(
            simd,
            Cells,
            Kind::Cell as usize + LOWER,
            #[inline(always)]
            |simd, _, _, on| complex_rows(simd, &on.rows, on.dx, on.dy),
        );
        self.rounded(
            simd,
            ImaginaryAxis,
            Kind::ImaginaryAxis as usize,
            #[inline(always)]
            |simd, a, _, on| from_erfcx_rounded(a, real_rows_rounded(simd, &on.rows, on.dx, a)),
        );
        self.mirrored(
            simd,
            ImaginaryAxis,
            Kind::ImaginaryAxis as usize + LOWER,
            #[inline(always)]
            |simd, a, _, on| from_erfcx(a, real_rows(simd, &on.rows, on.dx, a)),
        );
        self.asymptotic::<S, 26>(simd, Kind::Series26);
        self.asymptotic::<S, 14>(simd, Kind::Series14);
        self.asymptotic::<S, 6>(simd, Kind::Series6);

        self.by_formula(simd, Kind::Small as usize, Maclaurin);
        self.by_formula(simd, Kind::Series4 as usize, Series::<4>);
        self.rounded(
            simd,
            LowerDisc,
            Kind::Disc as usize,
            #[inline(always)]
            |simd, _, _, on| complex_rows_rounded(simd, &on.rows, on.dx, on.dy),
        );
        self.rounded(
            simd,
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

        self.reflected(simd, lanes);
        for at in 0..self.buffers.len[Kind::Other as usize] {
            self.alone(lanes, self.buffers.order[Kind::Other as usize][at.min(CHUNK)]);
        }
        self.next_to_zeros(simd, lanes);
    }

    /// Sorts `n` points into the buckets.
    #[inline(always)]
    fn sort<S: Wide>(&mut self, simd: S, n: usize) {
        let buffers = &mut *self.buffers;
        let mut at = 0;
        while at < n {
            let (x, y) = simd.from_pairs(
                #[inline(always)]
                |m| pair(self.z[(at + m) & (CHUNK - 1)]),
            );
            let places = places(Pack(simd, x), Pack(simd, y));
            simd.store_at(simd.transmute_f64s_u64s(places), &mut buffers.a, at);
            at += S::WIDTH;
        }
        buffers.len = [0; SETS];
        let mut odd = [0; SETS];
        for (i, places) in buffers.a[..n].chunks(2).enumerate() {
            let k = bucket(places[0].to_bits()) & (SETS - 1);
            let len = buffers.len[k];
            buffers.order[k][len & (CHUNK / 2 - 1)] = (2 * i) as u8;
            buffers.len[k] = len + 1;
            if let Some(place) = places.get(1) {
                let k = bucket(place.to_bits()) & (SETS - 1);
                let len = odd[k];
                buffers.odd[k][len & (CHUNK / 2 - 1)] = (2 * i + 1) as u8;
                odd[k] = len + 1;
            }
        }
        for k in 0..BUCKETS {
            if odd[k] > 0 {
                let len = buffers.len[k].min(CHUNK / 2);
                buffers.order[k][len..len + CHUNK / 2].copy_from_slice(&buffers.odd[k]);
                buffers.len[k] = len + odd[k].min(CHUNK / 2);
            }
        }
    }

    /// Point `i`.
    #[inline(always)]
    fn at(&self, i: u8) -> [f64; 2] {
        pair(self.z[i as usize])
    }

    /// The numbers of a group of points.
    #[inline(always)]
    fn group(&self, bucket: usize, at: usize) -> &[u8; 8] {
        let order = &self.buffers.order[bucket];
        order[at.min(CHUNK)..].first_chunk().expect("there is room")
    }

    /// The points of a group.
    #[inline(always)]
    fn gather<S: Wide>(&self, simd: S, numbers: &[u8; 8]) -> (Pack<S>, Pack<S>) {
        let (x, y) = simd.from_pairs(
            #[inline(always)]
            |m| self.at(numbers[m]),
        );
        (Pack(simd, x), Pack(simd, y))
    }

    /// Takes the value at point `i`.
    #[inline(always)]
    fn put(&mut self, i: u8, (re, im): (f64, f64)) {
        self.w[i as usize] = Complex::new(re, im);
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
        self.put(i, (re, if x.is_sign_negative() { -im } else { im }));
    }

    /// The points next to a zero.
    #[inline(always)]
    fn next_to_zeros<S: Wide, L: Lanes>(&mut self, simd: S, lanes: L) {
        let len = self.buffers.near_zeros;
        if len == 0 {
            return;
        }
        let last = self.buffers.zeros[(len - 1).min(CHUNK)];
        self.buffers.zeros[len.min(CHUNK)..][..8].fill(last);
        let mut at = 0;
        while at < len {
            let (mut x, mut y) = ([0.0; 8], [0.0; 8]);
            let mut rows = [zeros::row(0); 8];
            for m in 0..S::WIDTH {
                [x[m], y[m]] = self.at(self.buffers.zeros[at + m]);
                rows[m] = zeros::row(zeros::nearest(x[m].abs(), -y[m]).unwrap_or(0));
            }
            let (x, y) = (Pack::load(simd, &x, 0), Pack::load(simd, &y, 0));
            let (re, im, lost) = lost(zeros::near_zeros(simd, &rows, x.magnitude(), y));
            let (re, im, lost) = (array(re), array(im.with_sign_of(x)), array(lost));
            let n = (len - at).min(S::WIDTH);
            for m in 0..n {
                let i = self.buffers.zeros[at + m];
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
    fn asymptotic<S: Wide, const N: usize>(&mut self, simd: S, kind: Kind) {
        self.by_formula(simd, kind as usize, Series::<N>);
        self.mirrored(
            simd,
            NoRows,
            kind as usize + LOWER,
            #[inline(always)]
            |_, a, b, _| series::<_, N>(a, b),
        );
        self.mirrored(
            simd,
            NoRows,
            kind as usize + LOWER + SERIES_ALONE,
            #[inline(always)]
            |_, a, b, _| series::<_, N>(a, b),
        );
    }

    /// A bucket whose formula gives the value and needs no table: two groups at a time, because
    /// each operation of one waits for the one before.
    #[inline(always)]
    fn by_formula<S: Wide>(&mut self, simd: S, bucket: usize, formula: impl Formula) {
        let len = self.groups::<S>(bucket);
        let mut at = 0;
        while at < len {
            let next = at + S::WIDTH;
            let (x, y) = self.gather(simd, self.group(bucket, at));
            let (p, q) = self.gather(simd, self.group(bucket, next));
            let (re, im) = formula.value(Two(x.magnitude(), p.magnitude()), Two(y, q));
            self.scatter(simd, bucket, at, re.0, im.0.with_sign_of(x));
            self.scatter(simd, bucket, next, re.1, im.1.with_sign_of(p));
            at += 2 * S::WIDTH;
        }
    }

    /// A bucket whose formula gives the value by rows.
    #[inline(always)]
    fn rounded<S: Wide, R: Rows<N>, const N: usize>(
        &mut self,
        simd: S,
        rows: R,
        bucket: usize,
        formula: impl Fn(S, Pack<S>, Pack<S>, On<'_, S, N>) -> (Pack<S>, Pack<S>),
    ) {
        let len = self.groups::<S>(bucket);
        self.locate(simd, rows, bucket, len);
        let mut at = 0;
        while at < len {
            let (x, y, on) = self.on(simd, rows, at);
            let (re, im) = formula(simd, x.magnitude(), y, on);
            self.scatter(simd, bucket, at, re, im.with_sign_of(x));
            at += S::WIDTH;
        }
    }

    /// The bucket in the lower half-plane of a formula that gives `w(a + i|y|)`: to be reflected
    /// together with the others.
    #[inline(always)]
    fn mirrored<S: Wide, R: Rows<N>, const N: usize>(
        &mut self,
        simd: S,
        rows: R,
        bucket: usize,
        formula: impl Fn(S, Pack<S>, Pack<S>, On<'_, S, N>) -> (Dd<Pack<S>>, Dd<Pack<S>>),
    ) {
        let len = self.groups::<S>(bucket);
        self.locate(simd, rows, bucket, len);
        let alone = bucket >= Kind::Series26 as usize + LOWER + SERIES_ALONE;
        let mut at = 0;
        while at < len {
            let (mut x, mut y, on) = self.on(simd, rows, at);
            if !R::SOME {
                (x, y) = self.gather(simd, self.group(bucket, at));
            }
            let (a, b) = (x.magnitude(), y.magnitude());
            let (u, v) = formula(simd, a, b, on);
            if alone && a.all(negligible(a, b, u.hi, v.hi)) {
                self.scatter(simd, bucket, at, -u.hi, v.hi.with_sign_of(x));
            } else {
                let buffers = &mut *self.buffers;
                let to = buffers.mirrored.min(CHUNK);
                let from = at.min(CHUNK);
                let numbers = &buffers.order[bucket][from..from + 8];
                buffers.below[to..to + 8].copy_from_slice(numbers);
                u.hi.store_at(&mut buffers.w[0], to);
                u.lo.store_at(&mut buffers.w[1], to);
                v.hi.store_at(&mut buffers.w[2], to);
                v.lo.store_at(&mut buffers.w[3], to);
                buffers.mirrored = to + (len - at).min(S::WIDTH);
            }
            at += S::WIDTH;
        }
    }

    /// The points in the lower half-plane whose mirror images are done, two groups at a time.
    #[inline(always)]
    fn reflected<S: Wide, L: Lanes>(&mut self, simd: S, lanes: L) {
        let end = self.buffers.mirrored.min(CHUNK);
        if end == 0 {
            return;
        }
        let buffers = &mut *self.buffers;
        let last = buffers.below[end - 1];
        buffers.below[end..end + 2 * S::WIDTH - 1].fill(last);
        let mut at = 0;
        while at < end {
            let buffers = &*self.buffers;
            let next = at + S::WIDTH;
            let two = |x: &[f64]| Two(Pack::load(simd, x, at), Pack::load(simd, x, next));
            let u = Dd::new(two(&buffers.w[0]), two(&buffers.w[1]));
            let v = Dd::new(two(&buffers.w[2]), two(&buffers.w[3]));
            let point = |at: usize| {
                let (x, y) = simd.from_pairs(
                    #[inline(always)]
                    |m| self.at(buffers.below[at + m]),
                );
                (Pack(simd, x), Pack(simd, y))
            };
            let ((x, y), (p, q)) = (point(at), point(next));
            let (a, y) = (Two(x.magnitude(), p.magnitude()), Two(y, q));
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
            let re = re.pick(none, -u.hi, re);
            let im = im.pick(none, v.hi, im);
            let state = re.pick(none, zero, state);
            let im = Two(im.0.with_sign_of(x), im.1.with_sign_of(p));
            self.finish(simd, lanes, (at, end), re.0, im.0, state.0);
            self.finish(simd, lanes, (next, end), re.1, im.1, state.1);
            at += 2 * S::WIDTH;
        }
    }

    /// Takes the values of a group of reflected points, or others as the states ask.
    #[inline(always)]
    fn finish<S: Wide, L: Lanes>(
        &mut self,
        simd: S,
        lanes: L,
        (at, end): (usize, usize),
        re: Pack<S>,
        im: Pack<S>,
        state: Pack<S>,
    ) {
        if state.is_zero() {
            let pairs = simd.to_pairs(re.1, im.1);
            for m in 0..S::WIDTH {
                let [re, im] = pairs[m];
                self.put(self.buffers.below[at + m], (re, im));
            }
        } else {
            let (re, im, state) = (array(re), array(im), array(state));
            for m in 0..end.saturating_sub(at).min(S::WIDTH) {
                self.take(lanes, self.buffers.below[at + m], (re[m], im[m]), state[m]);
            }
        }
    }

    /// How many points a bucket has; the last one is repeated, so that groups are whole.
    #[inline(always)]
    fn groups<S: Wide>(&mut self, bucket: usize) -> usize {
        let buffers = &mut *self.buffers;
        let len = buffers.len[bucket].min(CHUNK);
        if len > 0 {
            let last = buffers.order[bucket][len - 1];
            buffers.order[bucket][len..len + 16].fill(last);
        }
        len
    }

    /// Takes the values of a group.
    #[inline(always)]
    fn scatter<S: Wide>(
        &mut self,
        simd: S,
        bucket: usize,
        at: usize,
        re: Pack<S>,
        im: Pack<S>,
    ) {
        let pairs = simd.to_pairs(re.1, im.1);
        let order = &self.buffers.order[bucket];
        let numbers: &[u8; 8] = order[at.min(CHUNK)..].first_chunk().expect("there is room");
        for m in 0..S::WIDTH {
            let [re, im] = pairs[m];
            self.w[numbers[m] as usize] = Complex::new(re, im);
        }
    }

    /// Brings the points of a bucket together, finds their rows and the distances from the centres:
    /// beforehand, because all that follows waits for the row.
    #[inline(always)]
    fn locate<S: Wide, R: Rows<N>, const N: usize>(
        &mut self,
        simd: S,
        rows: R,
        bucket: usize,
        len: usize,
    ) {
        if !R::SOME {
            return;
        }
        let mut at = 0;
        while at < len {
            let (x, y) = self.gather(simd, self.group(bucket, at));
            let buffers = &mut *self.buffers;
            let [codes, dx, dy] = rows.locate(x.magnitude(), y);
            let codes = array(codes);
            for m in 0..S::WIDTH {
                buffers.row[at + m] = rows.number(codes[m]);
            }
            x.store_at(&mut buffers.a, at);
            y.store_at(&mut buffers.b, at);
            dx.store_at(&mut buffers.dx, at);
            dy.store_at(&mut buffers.dy, at);
            at += S::WIDTH;
        }
    }

    /// A group of located points, and on which rows they are.
    #[inline(always)]
    fn on<S: Wide, R: Rows<N>, const N: usize>(
        &self,
        simd: S,
        rows: R,
        at: usize,
    ) -> (Pack<S>, Pack<S>, On<'static, S, N>) {
        let buffers = &*self.buffers;
        let mut group = [rows.row(0); 8];
        for m in 0..S::WIDTH {
            group[m] = rows.row(buffers.row[at + m]);
        }
        let on = On {
            rows: group,
            dx: Pack::load(simd, &buffers.dx, at),
            dy: Pack::load(simd, &buffers.dy, at),
        };
        (
            Pack::load(simd, &buffers.a, at),
            Pack::load(simd, &buffers.b, at),
            on,
        )
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
        let len = self.groups::<S>(bucket);
        self.locate(simd, rows, bucket, len);
        let mut at = 0;
        while at < len {
            let (mut x, mut y, on) = self.on(simd, rows, at);
            if !R::SOME {
                (x, y) = self.gather(simd, self.group(bucket, at));
            }
            let (re, im, state) = formula(simd, x.magnitude(), y, on);
            let im = im.with_sign_of(x);
            if state.is_zero() {
                self.scatter(simd, bucket, at, re, im);
            } else {
                let (re, im, state) = (array(re), array(im), array(state));
                for m in 0..(len - at).min(S::WIDTH) {
                    let i = self.buffers.order[bucket][(at + m).min(CHUNK)];
                    self.take(lanes, i, (re[m], im[m]), state[m]);
                }
            }
            at += S::WIDTH;
        }
    }

    /// Takes the value for point `i`, or another as its state asks.
    #[inline(always)]
    fn take<L: Lanes>(&mut self, lanes: L, i: u8, value: (f64, f64), state: f64) {
        let [x, y] = self.at(i);
        if state >= 4.0 && zeros::nearest(x.abs(), -y).is_some() {
            let buffers = &mut *self.buffers;
            buffers.zeros[buffers.near_zeros.min(CHUNK)] = i;
            buffers.near_zeros += 1;
            return;
        }
        match state as u8 & 3 {
            0 => self.put(i, value),
            1 => self.cancelled(lanes, i),
            _ => self.alone(lanes, i),
        }
    }
}

#[inline(always)]
fn pair(z: Complex<f64>) -> [f64; 2] {
    [z.re, z.im]
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
