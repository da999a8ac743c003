//! Many points at a time: sorted by the formula they need, a few hundred at a time on the stack,
//! then computed side by side.

use super::asymptotic::series;
use super::double_double::Dd;
use super::exponential::{LARGE_PHASE, exp_minus_square};
use super::lanes::Lanes;
use super::pack::{Pack, Wide};
use super::plane::{
    ALONE, Cancelled, Kind, axis_row, cell, cell_row, from_dawson, from_erfcx, in_strip, kind,
    negligible, on_axis, reflect, right_half_plane,
};
use super::real::{ROUND, Real};
use super::tables::{CELLS, IMAGINARY_AXIS, REAL_AXIS};
use super::taylor::{complex_rows, real_rows};

/// Points sorted at a time.
const CHUNK: usize = 256;

/// Where points come from and values go to.
pub(super) trait Points {
    /// How many there are.
    fn len(&self) -> usize;
    /// The real and the imaginary part of point `i`.
    fn get(&self, i: usize) -> (f64, f64);
    /// Takes the value at point `i`.
    fn put(&mut self, i: usize, re: f64, im: f64);
}

/// Eight numbers from `at` on; the `n`-th is repeated.
#[inline(always)]
fn repeated(v: &[f64; CHUNK], at: usize, n: usize) -> [f64; 8] {
    let mut x = [0.0; 8];
    for (i, x) in x.iter_mut().enumerate() {
        *x = v[(at + i.min(n - 1)) & (CHUNK - 1)];
    }
    x
}

/// Points that need the same formula: where they are, `|Re z|` and `Im z`.
#[derive(Clone, Copy)]
struct Bucket {
    len: usize,
    index: [u16; CHUNK],
    a: [f64; CHUNK],
    y: [f64; CHUNK],
}

impl Bucket {
    const EMPTY: Bucket = Bucket {
        len: 0,
        index: [0; CHUNK],
        a: [0.0; CHUNK],
        y: [0.0; CHUNK],
    };

    #[inline(always)]
    fn push(&mut self, index: usize, a: f64, y: f64) {
        let at = self.len & (CHUNK - 1);
        self.index[at] = index as u16;
        self.a[at] = a;
        self.y[at] = y;
        self.len += 1;
    }

    /// The points from `at` on, up to eight; the last one is repeated.
    #[inline(always)]
    fn group(&self, at: usize, width: usize) -> ([f64; 8], [f64; 8], usize) {
        let n = (self.len - at).min(width);
        if let (Some(a), Some(y)) = (
            self.a.get(at..).and_then(|s| s.first_chunk::<8>()),
            self.y.get(at..).and_then(|s| s.first_chunk::<8>()),
        ) && n == width
        {
            return (*a, *y, n);
        }
        (repeated(&self.a, at, n), repeated(&self.y, at, n), n)
    }
}

/// Points in the lower half-plane with `w(−z̄)`, to be combined with `e^{−z²}`.
struct Mirrored {
    points: Bucket,
    u: [[f64; CHUNK]; 2],
    v: [[f64; CHUNK]; 2],
}

/// The buffers for one chunk.
struct Chunk<'a, P> {
    points: &'a mut P,
    start: usize,
    buckets: [Bucket; Kind::COUNT],
    mirrored: Mirrored,
    /// Points whose terms cancel.
    cancelled: Bucket,
    /// Points for the scalar code.
    other: Bucket,
}

/// Computes W at all points.
#[inline(always)]
pub(super) fn batch<S: Wide, L: Lanes, P: Points>(simd: S, lanes: L, points: &mut P) {
    let total = points.len();
    let mut chunk = Chunk {
        points,
        start: 0,
        buckets: [Bucket::EMPTY; Kind::COUNT],
        mirrored: Mirrored {
            points: Bucket::EMPTY,
            u: [[0.0; CHUNK]; 2],
            v: [[0.0; CHUNK]; 2],
        },
        cancelled: Bucket::EMPTY,
        other: Bucket::EMPTY,
    };
    while chunk.start < total {
        chunk.run(simd, lanes, (total - chunk.start).min(CHUNK));
        chunk.start += CHUNK;
    }
}

impl<P: Points> Chunk<'_, P> {
    #[inline(always)]
    fn run<S: Wide, L: Lanes>(&mut self, simd: S, lanes: L, n: usize) {
        for b in &mut self.buckets {
            b.len = 0;
        }
        self.mirrored.points.len = 0;
        self.cancelled.len = 0;
        self.other.len = 0;
        for i in 0..n {
            let (x, y) = self.points.get(self.start + i);
            let a = x.abs();
            self.buckets[kind(a, y.abs()) as usize].push(i, a, y);
        }

        self.upper(
            simd,
            Kind::Cell,
            #[inline(always)]
            |simd, a, b| {
                let [i, j, dx, dy] = cell(a, b);
                let (ai, bi) = (array(a), array(b));
                let (i, j) = (array(i), array(j));
                let rows = std::array::from_fn(
                    #[inline(always)]
                    |m| {
                        let m = m & (S::WIDTH - 1);
                        &CELLS[cell_row(ai[m], bi[m], i[m], j[m])].0
                    },
                );
                complex_rows(simd, &rows, dx, dy)
            },
        );
        self.upper(
            simd,
            Kind::ImaginaryAxis,
            #[inline(always)]
            |simd, a, b| {
                let (n, t) = on_axis(b);
                let n = array(n);
                let rows = std::array::from_fn(
                    #[inline(always)]
                    |m| &IMAGINARY_AXIS[axis_row(n[m & (S::WIDTH - 1)])].0,
                );
                from_erfcx(a, real_rows(simd, &rows, t, a))
            },
        );
        self.upper(
            simd,
            Kind::Series23,
            #[inline(always)]
            |_, a, b| series::<_, 23>(a, b),
        );
        self.upper(
            simd,
            Kind::Series13,
            #[inline(always)]
            |_, a, b| series::<_, 13>(a, b),
        );
        self.upper(
            simd,
            Kind::Series6,
            #[inline(always)]
            |_, a, b| series::<_, 6>(a, b),
        );
        self.upper(
            simd,
            Kind::Series2,
            #[inline(always)]
            |_, a, b| series::<_, 2>(a, b),
        );

        self.strip(
            simd,
            Kind::RealAxis,
            #[inline(always)]
            |simd, a, y| {
                let (n, t) = on_axis(a);
                let n = array(n);
                let rows = std::array::from_fn(
                    #[inline(always)]
                    |m| &REAL_AXIS[axis_row(n[m & (S::WIDTH - 1)])].0,
                );
                from_dawson(a, y, real_rows(simd, &rows, t, y))
            },
        );
        self.strip(
            simd,
            Kind::Strip23,
            #[inline(always)]
            |_, a, y| {
                let (u, v) = series::<_, 23>(a, y.magnitude());
                in_strip(a, y, u.hi, v.hi)
            },
        );
        self.strip(
            simd,
            Kind::Strip13,
            #[inline(always)]
            |_, a, y| {
                let (u, v) = series::<_, 13>(a, y.magnitude());
                in_strip(a, y, u.hi, v.hi)
            },
        );

        self.lower(simd);

        for i in 0..self.cancelled.len {
            let (a, b) = (self.cancelled.a[i], self.cancelled.y[i].abs());
            let (re, im) = lanes.call(Cancelled { a, b });
            self.put(self.cancelled.index[i], re, im);
        }
        for bucket in [self.other, self.buckets[Kind::Other as usize]] {
            for i in 0..bucket.len {
                let (re, im) = right_half_plane(lanes, bucket.a[i], bucket.y[i]);
                self.put(bucket.index[i], re, im);
            }
        }
    }

    /// Hands over a value at `|Re z| + i Im z`.
    #[inline(always)]
    fn put(&mut self, index: u16, re: f64, im: f64) {
        let i = self.start + index as usize;
        let (x, _) = self.points.get(i);
        let sign = x.to_bits() & (1 << 63);
        self.points.put(i, re, f64::from_bits(im.to_bits() ^ sign));
    }

    /// A bucket whose formula gives `w(a + i|y|)`.
    #[inline(always)]
    fn upper<S: Wide>(
        &mut self,
        simd: S,
        kind: Kind,
        formula: impl Fn(S, Pack<S>, Pack<S>) -> (Dd<Pack<S>>, Dd<Pack<S>>),
    ) {
        let mut at = 0;
        while at < self.buckets[kind as usize].len {
            let bucket = &self.buckets[kind as usize];
            let (a, y, n) = bucket.group(at, S::WIDTH);
            let b = Pack::load(simd, &y).magnitude();
            let (u, v) = formula(simd, Pack::load(simd, &a), b);
            let (uh, ul, vh, vl) = (array(u.hi), array(u.lo), array(v.hi), array(v.lo));
            for m in 0..n {
                let index = self.buckets[kind as usize].index[(at + m) & (CHUNK - 1)];
                if y[m] < 0.0 {
                    let k = self.mirrored.points.len & (CHUNK - 1);
                    self.mirrored.points.push(index as usize, a[m], y[m]);
                    self.mirrored.u[0][k] = uh[m];
                    self.mirrored.u[1][k] = ul[m];
                    self.mirrored.v[0][k] = vh[m];
                    self.mirrored.v[1][k] = vl[m];
                } else {
                    self.put(index, uh[m], vh[m]);
                }
            }
            at += n;
        }
    }

    /// A bucket whose formula holds on both sides of the real axis.
    #[inline(always)]
    fn strip<S: Wide>(
        &mut self,
        simd: S,
        kind: Kind,
        formula: impl Fn(S, Pack<S>, Pack<S>) -> (Pack<S>, Pack<S>, S::m64s),
    ) {
        let mut at = 0;
        while at < self.buckets[kind as usize].len {
            let bucket = &self.buckets[kind as usize];
            let (a, y, n) = bucket.group(at, S::WIDTH);
            let (re, im, lost) = formula(simd, Pack::load(simd, &a), Pack::load(simd, &y));
            let lost = array(re.pick(lost, re.like(1.0), re.like(0.0)));
            let (re, im) = (array(re), array(im));
            for m in 0..n {
                let index = self.buckets[kind as usize].index[(at + m) & (CHUNK - 1)];
                if lost[m] != 0.0 {
                    self.cancelled.push(index as usize, a[m], y[m]);
                } else {
                    self.put(index, re[m], im[m]);
                }
            }
            at += n;
        }
    }

    /// The points in the lower half-plane.
    #[inline(always)]
    fn lower<S: Wide>(&mut self, simd: S) {
        let mut at = 0;
        while at < self.mirrored.points.len {
            let (a, y, n) = self.mirrored.points.group(at, S::WIDTH);
            let (pa, py) = (Pack::load(simd, &a), Pack::load(simd, &y));
            let u = Dd::new(
                Pack::load(simd, &repeated(&self.mirrored.u[0], at, n)),
                Pack::load(simd, &repeated(&self.mirrored.u[1], at, n)),
            );
            let v = Dd::new(
                Pack::load(simd, &repeated(&self.mirrored.v[0], at, n)),
                Pack::load(simd, &repeated(&self.mirrored.v[1], at, n)),
            );
            let none = negligible(pa, py, u.hi, v.hi);
            let e = exp_minus_square(pa, py);
            let large = ((pa + pa) * py).magnitude();
            let (n_hi, n_large) = (array(e.2), array(large));
            let (re, im, lost) = reflect((u, v), e);
            let (re, im) = (re.pick(none, -u.hi, re), im.pick(none, v.hi, im));
            let (zero, one) = (re.like(0.0), re.like(1.0));
            let lost = array(re.pick(none, zero, re.pick(lost, one, zero)));
            let none = array(re.pick(none, one, zero));
            let (re, im) = (array(re), array(im));
            for m in 0..n {
                let index = self.mirrored.points.index[(at + m) & (CHUNK - 1)];
                let scalar =
                    none[m] == 0.0 && (n_hi[m] >= ROUND + ALONE || !(n_large[m] < LARGE_PHASE));
                if scalar {
                    self.other.push(index as usize, a[m], y[m]);
                } else if lost[m] != 0.0 {
                    self.cancelled.push(index as usize, a[m], y[m]);
                } else {
                    self.put(index, re[m], im[m]);
                }
            }
            at += n;
        }
    }
}

/// The numbers of a pack; those beyond its width are zero.
#[inline(always)]
fn array<S: Wide>(x: Pack<S>) -> [f64; 8] {
    let mut v = [0.0; 8];
    x.store(&mut v);
    v
}
