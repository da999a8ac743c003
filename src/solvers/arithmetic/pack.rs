//! Vectors of four (AVX2) and eight (AVX-512) numbers as [`Real`]s, and the rows of a table for
//! as many points, transposed.

use crate::lanes::Lanes;
use crate::real::{Masked, Real};
use pulp::x86::{V3, V4};
use pulp::{NullaryFnOnce, Simd, cast, f64x4};
use std::ops::{Add, Div, Mul, Neg, Sub};
use std::sync::OnceLock;

/// A set of instructions for several points at once.
pub(crate) trait Wide: Simd {
    /// Points side by side.
    const WIDTH: usize;
    /// Four points side by side: for what is long and rare, compiled for one width only.
    type Four: Wide;
    fn four(self) -> Self::Four;
    /// Runs the task as a function of its own, compiled for these instructions.
    fn outlined<T: NullaryFnOnce>(self, task: T) -> T::Output;
    /// `(x + add) << 52`
    fn exponent(self, x: Self::u64s, add: Self::u64s) -> Self::u64s;
    /// Which bytes equal `k`, the first one in the lowest bit.
    fn equal(self, bytes: &[u8; 32], k: u8) -> u32;
    /// `bit` where the mask is true, 0 elsewhere.
    #[inline(always)]
    fn flag(self, mask: Self::m64s, bit: u64) -> Self::u64s {
        self.select_u64s(mask, self.splat_u64s(bit), self.splat_u64s(0))
    }
    /// The second number where the mask is true, else the first.
    #[inline(always)]
    fn either(self, second: Self::m64s, [a, b]: [f64; 2]) -> Self::f64s {
        self.select_f64s(second, self.splat_f64s(b), self.splat_f64s(a))
    }
    /// The larger and the smaller of two numbers; the second one if one is not a number.
    fn larger(self, a: Self::f64s, b: Self::f64s) -> Self::f64s;
    fn smaller(self, a: Self::f64s, b: Self::f64s) -> Self::f64s;
    /// `x >> 50`
    fn leading(self, x: Self::u64s) -> Self::u64s;
    /// `x << 62`
    fn to_sign(self, x: Self::u64s) -> Self::u64s;
    /// Returns whether `a = b` as integers, for 0 and 1 only.
    #[inline(always)]
    fn is_one(self, a: Self::u64s) -> Self::m64s {
        self.equal_u64s(a, self.splat_u64s(1))
    }
    /// Numbers `at … at + 3` of each row: four vectors, one place for each row.
    fn columns<const N: usize>(self, rows: &[&[f64; N]; 8], at: usize) -> [Self::f64s; 4];
    /// The four interleaved polynomials of Taylor rows in δ⁴; the last block of coefficients stands
    /// at the second of the ends.
    #[inline(always)]
    fn polynomials<const N: usize>(
        self,
        rows: &[&[f64; N]; 8],
        ends: (usize, usize),
        d4: (Pack<Self>, Pack<Self>),
    ) -> Parts<Self> {
        by_columns(self, rows, ends, d4)
    }
    /// Four interleaved polynomials of real rows in t⁴; the last coefficients stand at the second of
    /// the ends.
    #[inline(always)]
    fn real_polynomials<const N: usize>(
        self,
        rows: &[&[f64; N]; 8],
        (first, last): (usize, usize),
        t4: Pack<Self>,
    ) -> [Pack<Self>; 4] {
        let mut sums = columns(self, rows, last);
        let mut at = last;
        while at > first {
            at -= 4;
            let c = columns(self, rows, at);
            for m in 0..4 {
                sums[m] = t4.fma(sums[m], c[m]);
            }
        }
        sums
    }
    /// The numbers from `at` on.
    fn load(self, x: &[f64], at: usize) -> Self::f64s;
    /// Stores the numbers from `at` on.
    fn store_at(self, v: Self::f64s, x: &mut [f64], at: usize);
    /// The first and the second numbers of pairs `p(0)`, `p(1)`, …, as many as a vector has places.
    fn deinterleave(self, p: impl Fn(usize) -> [f64; 2]) -> (Self::f64s, Self::f64s);
    /// The reverse of it.
    fn interleave(self, first: Self::f64s, second: Self::f64s) -> [[f64; 2]; 8];
}

#[inline(always)]
fn four<const N: usize>(row: &[f64; N], at: usize) -> [f64; 4] {
    [row[at], row[at + 1], row[at + 2], row[at + 3]]
}

/// Four vectors, transposed.
#[inline(always)]
fn transposed(simd: V3, [a, b, c, d]: [f64x4; 4]) -> [f64x4; 4] {
    let x = simd.avx;
    let (a, b, c, d) = (cast(a), cast(b), cast(c), cast(d));
    let (p, q) = (x._mm256_unpacklo_pd(a, b), x._mm256_unpackhi_pd(a, b));
    let (s, t) = (x._mm256_unpacklo_pd(c, d), x._mm256_unpackhi_pd(c, d));
    [
        cast(x._mm256_permute2f128_pd::<0x20>(p, s)),
        cast(x._mm256_permute2f128_pd::<0x20>(q, t)),
        cast(x._mm256_permute2f128_pd::<0x31>(p, s)),
        cast(x._mm256_permute2f128_pd::<0x31>(q, t)),
    ]
}

/// Holds what the two sets differ in by their names and widths only.
macro_rules! by_width {
    ($width:literal, $add:ident, $shl:ident, $shr:ident, $avx:ident:
     $max:ident, $min:ident, $low:ident, $high:ident, [$($even:literal),*]) => {
        const WIDTH: usize = $width;
        #[cfg_attr(debug_assertions, inline(never))]
        #[cfg_attr(not(debug_assertions), inline(always))]
        fn outlined<T: NullaryFnOnce>(self, task: T) -> T::Output {
            self.vectorize(task)
        }
        #[inline(always)]
        fn exponent(self, x: Self::u64s, add: Self::u64s) -> Self::u64s {
            self.$shl::<52>(self.$add(x, add))
        }
        #[inline(always)]
        fn leading(self, x: Self::u64s) -> Self::u64s {
            self.$shr::<50>(x)
        }
        #[inline(always)]
        fn to_sign(self, x: Self::u64s) -> Self::u64s {
            self.$shl::<62>(x)
        }
        #[inline(always)]
        fn larger(self, a: Self::f64s, b: Self::f64s) -> Self::f64s {
            cast(self.$avx.$max(cast(a), cast(b)))
        }
        #[inline(always)]
        fn smaller(self, a: Self::f64s, b: Self::f64s) -> Self::f64s {
            cast(self.$avx.$min(cast(a), cast(b)))
        }
        #[inline(always)]
        fn load(self, x: &[f64], at: usize) -> Self::f64s {
            let v: &[f64; $width] = x[at..at + $width].try_into().expect("the width");
            cast(*v)
        }
        #[inline(always)]
        fn store_at(self, v: Self::f64s, x: &mut [f64], at: usize) {
            let v: [f64; $width] = cast(v);
            x[at..at + $width].copy_from_slice(&v);
        }
        #[inline(always)]
        fn deinterleave(self, p: impl Fn(usize) -> [f64; 2]) -> (Self::f64s, Self::f64s) {
            let (a, b) = (cast([$(p($even)),*]), cast([$(p($even + 1)),*]));
            (cast(self.$avx.$low(a, b)), cast(self.$avx.$high(a, b)))
        }
        #[inline(always)]
        fn interleave(self, first: Self::f64s, second: Self::f64s) -> [[f64; 2]; 8] {
            let (a, b, mut pairs) = (cast(first), cast(second), [[0.0; 2]; 8]);
            let p: [[f64; 2]; $width / 2] = cast(self.$avx.$low(a, b));
            let q: [[f64; 2]; $width / 2] = cast(self.$avx.$high(a, b));
            $((pairs[$even], pairs[$even + 1]) = (p[$even / 2], q[$even / 2]);)*
            pairs
        }
    };
}

impl Wide for V3 {
    by_width!(
        4, wrapping_add_u64x4, shl_const_u64x4, shr_const_u64x4,
        avx: _mm256_max_pd, _mm256_min_pd, _mm256_unpacklo_pd, _mm256_unpackhi_pd, [0, 2]
    );
    type Four = V3;
    #[inline(always)]
    fn four(self) -> V3 {
        self
    }
    /// One instruction, where a choice by a mask takes three.
    #[inline(always)]
    fn either(self, second: Self::m64s, [a, b]: [f64; 2]) -> Self::f64s {
        let pairs: f64x4 = cast([a, b, a, b]);
        cast(self.avx._mm256_permutevar_pd(cast(pairs), cast(second)))
    }
    #[inline(always)]
    fn equal(self, bytes: &[u8; 32], k: u8) -> u32 {
        let equal = self.avx2._mm256_cmpeq_epi8(cast(*bytes), cast([k; 32]));
        self.avx2._mm256_movemask_epi8(equal) as u32
    }
    #[inline(always)]
    fn columns<const N: usize>(self, rows: &[&[f64; N]; 8], at: usize) -> [Self::f64s; 4] {
        let row = |i: usize| cast(four(rows[i], at));
        transposed(self, [row(0), row(1), row(2), row(3)])
    }
    #[inline(always)]
    fn polynomials<const N: usize>(
        self,
        rows: &[&[f64; N]; 8],
        ends: (usize, usize),
        d4: (Pack<Self>, Pack<Self>),
    ) -> Parts<Self> {
        by_rows(self, rows, ends, d4)
    }
    #[inline(always)]
    fn real_polynomials<const N: usize>(
        self,
        rows: &[&[f64; N]; 8],
        (first, last): (usize, usize),
        t4: Pack<Self>,
    ) -> [Pack<Self>; 4] {
        let t4: [f64; 4] = cast(t4.1);
        let mut sums = [self.splat_f64x4(0.0); 4];
        for m in 0..4 {
            let t4 = self.splat_f64x4(t4[m]);
            sums[m] = cast(four(rows[m], last));
            let mut at = last;
            while at > first {
                at -= 4;
                sums[m] = self.mul_add_f64x4(t4, sums[m], cast(four(rows[m], at)));
            }
        }
        transposed(self, sums).map(|v| Pack(self, v))
    }
}

impl Wide for V4 {
    by_width!(
        8, wrapping_add_u64x8, shl_const_u64x8, shr_const_u64x8,
        avx512f: _mm512_max_pd, _mm512_min_pd, _mm512_unpacklo_pd, _mm512_unpackhi_pd, [0, 2, 4, 6]
    );
    type Four = V3;
    #[inline(always)]
    fn four(self) -> V3 {
        *self
    }
    #[inline(always)]
    fn equal(self, bytes: &[u8; 32], k: u8) -> u32 {
        let v: V3 = *self;
        v.equal(bytes, k)
    }
    #[inline(always)]
    fn columns<const N: usize>(self, rows: &[&[f64; N]; 8], at: usize) -> [Self::f64s; 4] {
        let x = self.avx512f;
        // Two rows side by side; the order of the rows is such that the shuffles restore it. By
        // instructions: of numbers side by side in memory the compiler makes twice as many.
        let r = |i: usize, j: usize| {
            let (p, q) = (cast(four(rows[i], at)), cast(four(rows[j], at)));
            x._mm512_insertf64x4::<1>(x._mm512_castpd256_pd512(p), q)
        };
        let (a, b, c, d) = (r(0, 2), r(1, 3), r(4, 6), r(5, 7));
        let (p, q) = (x._mm512_unpacklo_pd(a, b), x._mm512_unpackhi_pd(a, b));
        let (s, t) = (x._mm512_unpacklo_pd(c, d), x._mm512_unpackhi_pd(c, d));
        [
            cast(x._mm512_shuffle_f64x2::<0b10_00_10_00>(p, s)),
            cast(x._mm512_shuffle_f64x2::<0b10_00_10_00>(q, t)),
            cast(x._mm512_shuffle_f64x2::<0b11_01_11_01>(p, s)),
            cast(x._mm512_shuffle_f64x2::<0b11_01_11_01>(q, t)),
        ]
    }
}

/// Several numbers.
#[derive(Clone, Copy)]
pub(crate) struct Pack<S: Wide>(pub S, pub S::f64s);

impl<S: Wide> Pack<S> {
    /// The numbers from `at` on.
    #[inline(always)]
    pub(crate) fn load(simd: S, x: &[f64], at: usize) -> Pack<S> {
        Pack(simd, simd.load(x, at))
    }

    /// Stores the numbers from `at` on.
    #[inline(always)]
    pub(crate) fn store_at(self, x: &mut [f64], at: usize) {
        self.0.store_at(self.1, x, at);
    }

    /// The numbers; those beyond its width are zero.
    #[inline(always)]
    pub(crate) fn array(self) -> [f64; 8] {
        let mut v = [0.0; 8];
        self.store_at(&mut v, 0);
        v
    }

    /// 1 where the mask is true, else 0.
    #[inline(always)]
    pub(crate) fn flags(self, mask: S::m64s) -> [f64; 8] {
        self.pick(mask, self.like(1.0), self.like(0.0)).array()
    }

    /// Returns whether all numbers, none of them negative, are zero.
    #[inline(always)]
    pub(crate) fn is_zero(self) -> bool {
        let s = self.0;
        s.first_true_m64s(s.less_than_f64s(s.splat_f64s(0.0), self.1)) >= S::WIDTH
    }
}

macro_rules! operator {
    ($trait:ident, $method:ident, $f:ident) => {
        impl<S: Wide> $trait for Pack<S> {
            type Output = Pack<S>;
            #[inline(always)]
            fn $method(self, other: Pack<S>) -> Pack<S> {
                Pack(self.0, self.0.$f(self.1, other.1))
            }
        }
    };
}
operator!(Add, add, add_f64s);
operator!(Sub, sub, sub_f64s);
operator!(Mul, mul, mul_f64s);
operator!(Div, div, div_f64s);

impl<S: Wide> Neg for Pack<S> {
    type Output = Pack<S>;
    #[inline(always)]
    fn neg(self) -> Pack<S> {
        Pack(self.0, self.0.neg_f64s(self.1))
    }
}

impl<S: Wide> Real for Pack<S> {
    type Mask = S::m64s;
    #[inline(always)]
    fn like(self, x: f64) -> Self {
        Pack(self.0, self.0.splat_f64s(x))
    }
    #[inline(always)]
    fn fma(self, b: Self, c: Self) -> Self {
        Pack(self.0, self.0.mul_add_e_f64s(self.1, b.1, c.1))
    }
    #[inline(always)]
    fn magnitude(self) -> Self {
        Pack(self.0, self.0.abs_f64s(self.1))
    }
    #[inline(always)]
    fn at_least(self, low: Self) -> Self {
        // As the scalar code: `self` unless it is smaller.
        Pack(self.0, self.0.larger(low.1, self.1))
    }
    #[inline(always)]
    fn raised(self, least: f64) -> Self {
        self.at_least(self.like(least))
    }
    #[inline(always)]
    fn at_most(self, high: Self) -> Self {
        Pack(self.0, self.0.smaller(high.1, self.1))
    }
    #[inline(always)]
    fn below(self, other: Self) -> S::m64s {
        self.0.less_than_f64s(self.1, other.1)
    }
    #[inline(always)]
    fn or(self, a: S::m64s, b: S::m64s) -> S::m64s {
        self.0.or_m64s(a, b)
    }
    #[inline(always)]
    fn pick(self, mask: S::m64s, yes: Self, no: Self) -> Self {
        Pack(self.0, self.0.select_f64s(mask, yes.1, no.1))
    }
    #[inline(always)]
    fn either(self, second: S::m64s, numbers: [f64; 2]) -> Self {
        Pack(self.0, self.0.either(second, numbers))
    }
    #[inline(always)]
    fn all(self, mask: S::m64s) -> bool {
        let s = self.0;
        s.first_true_m64s(s.not_m64s(mask)) >= S::WIDTH
    }
    #[inline(always)]
    fn power_of_two(self) -> Self {
        let s = self.0;
        let bits = s.transmute_u64s_f64s(self.1);
        Pack(
            s,
            s.transmute_f64s_u64s(s.exponent(bits, s.splat_u64s(1023))),
        )
    }
    #[inline(always)]
    fn is_odd(self) -> S::m64s {
        let s = self.0;
        let bits = s.transmute_u64s_f64s(self.1);
        s.is_one(s.and_u64s(bits, s.splat_u64s(1)))
    }
    #[inline(always)]
    fn flip(self, x: Self) -> Self {
        let s = self.0;
        let bits = s.and_u64s(s.transmute_u64s_f64s(self.1), s.splat_u64s(2));
        let x = s.transmute_u64s_f64s(x.1);
        Pack(s, s.transmute_f64s_u64s(s.xor_u64s(x, s.to_sign(bits))))
    }
}

impl<S: Wide> Masked for Pack<S> {
    #[inline(always)]
    fn any(self, mask: S::m64s) -> bool {
        self.0.first_true_m64s(mask) < S::WIDTH
    }
    #[inline(always)]
    fn both(self, a: S::m64s, b: S::m64s) -> S::m64s {
        self.0.and_m64s(a, b)
    }
    #[inline(always)]
    fn except(self, a: S::m64s, b: S::m64s) -> S::m64s {
        self.0.and_m64s(a, self.0.not_m64s(b))
    }
    #[inline(always)]
    fn with_sign_of(self, x: Self) -> Self {
        let s = self.0;
        let sign = s.and_u64s(s.transmute_u64s_f64s(x.1), s.splat_u64s(1 << 63));
        let bits = s.xor_u64s(s.transmute_u64s_f64s(self.1), sign);
        Pack(s, s.transmute_f64s_u64s(bits))
    }
    #[inline(always)]
    fn root(self) -> Self {
        Pack(self.0, self.0.sqrt_f64s(self.1))
    }
}

/// Something to be computed by vectors.
pub(crate) trait WideTask: Sized {
    type Output;
    /// Computes it, inlined.
    fn run<S: Wide, L: Lanes>(self, simd: S, lanes: L) -> Self::Output;
}

/// The widest vectors of this processor.
#[derive(Clone, Copy)]
enum Widest {
    Eight(V4),
    Four(V3),
}

/// Runs the task with the widest vectors of this processor; without vectors it comes back.
#[inline(always)]
pub(crate) fn with_widest<T: WideTask>(task: T) -> Result<T::Output, T> {
    static WIDEST: OnceLock<Option<Widest>> = OnceLock::new();
    let find = || {
        let eight = V4::try_new().map(Widest::Eight);
        eight.or_else(|| V3::try_new().map(Widest::Four))
    };
    match *WIDEST.get_or_init(find) {
        Some(Widest::Eight(v)) => Ok(v.vectorize(
            #[inline(always)]
            || task.run(v, *v),
        )),
        Some(Widest::Four(v)) => Ok(v.vectorize(
            #[inline(always)]
            || task.run(v, v),
        )),
        None => Err(task),
    }
}

/// Puts `f` of the numbers of N columns, as many at a time as a vector has places, into `values`. A
/// column has as many numbers, or one for all.
#[inline(always)]
pub(crate) fn by_groups<S: Wide, const N: usize>(
    simd: S,
    columns: [&[f64]; N],
    values: &mut [f64],
    f: impl Fn([Pack<S>; N]) -> Pack<S>,
) {
    let n = values.len();
    let mut at = 0;
    while at + S::WIDTH <= n {
        let group = columns.map(
            #[inline(always)]
            |c| match c {
                [one] => Pack(simd, simd.splat_f64s(*one)),
                _ => Pack::load(simd, c, at),
            },
        );
        f(group).store_at(values, at);
        at += S::WIDTH;
    }
    if at < n {
        // The last number again in the places that are left: it needs no other formula.
        let group = columns.map(
            #[inline(always)]
            |c| {
                let mut block = [c[c.len() - 1]; 8];
                if c.len() > 1 {
                    block[..n - at].copy_from_slice(&c[at..]);
                }
                Pack::load(simd, &block, 0)
            },
        );
        values[at..].copy_from_slice(&f(group).array()[..n - at]);
    }
}

// The coefficients of a row lie side by side. With 32 vector registers they are transposed, so that
// each vector holds one coefficient of all points; with 16 there is no room for that, and each
// point's four interleaved polynomials stay in one vector until their sums are transposed. Both
// carry out the same operations on the same numbers.

/// Numbers `at … at + 3` of each row.
#[inline(always)]
pub(crate) fn columns<S: Wide, const N: usize>(
    simd: S,
    rows: &[&[f64; N]; 8],
    at: usize,
) -> [Pack<S>; 4] {
    let [a, b, c, d] = simd.columns(rows, at);
    [Pack(simd, a), Pack(simd, b), Pack(simd, c), Pack(simd, d)]
}

/// The four interleaved polynomials of each point in `δ⁴ = x + i y`: real parts, and imaginary
/// parts.
pub(crate) type Parts<S> = ([Pack<S>; 4], [Pack<S>; 4]);

/// `p_m = q_m + q_{m+4}δ⁴ + …`
#[inline(always)]
pub(crate) fn by_columns<S: Wide, const N: usize>(
    simd: S,
    rows: &[&[f64; N]; 8],
    (first, last): (usize, usize),
    (x, y): (Pack<S>, Pack<S>),
) -> Parts<S> {
    let (mut re, mut im) = (columns(simd, rows, last), columns(simd, rows, last + 4));
    let mut at = last;
    while at > first {
        at -= 8;
        let (a, b) = (columns(simd, rows, at), columns(simd, rows, at + 4));
        for m in 0..4 {
            let r = x.fma(re[m], (-y).fma(im[m], a[m]));
            im[m] = x.fma(im[m], y.fma(re[m], b[m]));
            re[m] = r;
        }
    }
    (re, im)
}

/// The same as [`by_columns`] for four points.
#[inline(always)]
pub(crate) fn by_rows<const N: usize>(
    simd: V3,
    rows: &[&[f64; N]; 8],
    (first, last): (usize, usize),
    (x, y): (Pack<V3>, Pack<V3>),
) -> Parts<V3> {
    let numbers = |v: f64x4| -> [f64; 4] { cast(v) };
    let (x, y) = (numbers(x.1), numbers(y.1));
    let load = |m: usize, at: usize| -> f64x4 { cast(four(rows[m], at)) };
    let zero = simd.splat_f64x4(0.0);
    let (mut re, mut im) = ([zero; 4], [zero; 4]);
    for m in 0..4 {
        let (x, y) = (simd.splat_f64x4(x[m]), simd.splat_f64x4(y[m]));
        (re[m], im[m]) = (load(m, last), load(m, last + 4));
        let mut at = last;
        while at > first {
            at -= 8;
            let r = simd.negate_mul_add_f64x4(y, im[m], load(m, at));
            let i = simd.mul_add_f64x4(y, re[m], load(m, at + 4));
            re[m] = simd.mul_add_f64x4(x, re[m], r);
            im[m] = simd.mul_add_f64x4(x, im[m], i);
        }
    }
    let pack = |v| Pack(simd, v);
    (
        transposed(simd, re).map(pack),
        transposed(simd, im).map(pack),
    )
}
