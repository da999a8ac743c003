//! Functions of one number or of a few, at one place and at many: places that need the same formulas
//! are brought together and computed side by side.

use super::places::{Mask, Number, One, Places};
use crate::lanes::{Lanes, Task, with_best};
use crate::real::Masked;
use num_complex::Complex;

/// A function of N numbers with a value of M numbers.
#[cfg_attr(
    not(all(target_arch = "x86_64", feature = "vectors")),
    allow(dead_code)
)]
pub(super) trait Function<const N: usize, const M: usize>: Copy {
    /// `ROUND` plus a number below 30: places that have it in common need the same formulas, mostly.
    fn class<R: Masked>(self, at: [R; N]) -> R;
    /// The value, and where it holds.
    fn value<P: Places>(self, places: P, at: [Number<P>; N]) -> ([Number<P>; M], Mask<P>);
    /// The value where [`value`](Function::value) does not hold, and where this one does. Where it
    /// holds it has the bits of [`alone`](Function::alone).
    fn again<P: Places>(self, places: P, at: [Number<P>; N]) -> ([Number<P>; M], Mask<P>);
    /// The value at one place where [`value`](Function::value) does not hold.
    fn alone<L: Lanes>(self, lanes: L, at: [f64; N]) -> [f64; M];
}

/// One place.
struct At<F, const N: usize, const M: usize>(F, [f64; N]);

impl<F: Function<N, M>, const N: usize, const M: usize> Task for At<F, N, M> {
    type Output = [f64; M];
    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> [f64; M] {
        let (value, kept) = self.0.value(One(lanes), self.1);
        match kept {
            true => value,
            false => lanes.call(Alone(self.0, self.1)),
        }
    }
}

/// One place where [`Function::value`] does not hold: a function of its own, because it is long.
struct Alone<F, const N: usize, const M: usize>(F, [f64; N]);

impl<F: Function<N, M>, const N: usize, const M: usize> Task for Alone<F, N, M> {
    type Output = [f64; M];
    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> [f64; M] {
        self.0.alone(lanes, self.1)
    }
}

/// A complex function at one point.
#[inline(always)]
pub(super) fn at_one(f: impl Function<2, 2>, z: Complex<f64>) -> Complex<f64> {
    let [re, im] = with_best(At(f, [z.re, z.im]));
    Complex::new(re, im)
}

/// A complex function at all points; the slices have one length.
pub(super) fn at_all<F: Function<2, 2>>(f: F, z: &[Complex<f64>], w: &mut [Complex<f64>]) {
    #[cfg(all(target_arch = "x86_64", feature = "vectors"))]
    if z.len() >= vectors::FEW
        && crate::pack::with_widest(vectors::Many { f, z, w: &mut *w }).is_ok()
    {
        return;
    }
    with_best(OneByOne(f, z, w));
}

/// All points, one after the other.
struct OneByOne<'a, F>(F, &'a [Complex<f64>], &'a mut [Complex<f64>]);

impl<F: Function<2, 2>> Task for OneByOne<'_, F> {
    type Output = ();
    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) {
        for (w, z) in self.2.iter_mut().zip(self.1) {
            let [re, im] = lanes.call(At(self.0, [z.re, z.im]));
            *w = Complex::new(re, im);
        }
    }
}

/// A complex function at all points with every set of vectors that this processor has.
#[cfg(all(test, target_arch = "x86_64", feature = "vectors"))]
pub(super) fn every_way<F: Function<2, 2>>(f: F, z: &[Complex<f64>]) -> Vec<Vec<Complex<f64>>> {
    use crate::pack::{Wide, WideTask};
    use pulp::x86::{V3, V4};

    fn with<S: Wide>(
        simd: S,
        lanes: impl Lanes,
        f: impl Function<2, 2>,
        z: &[Complex<f64>],
    ) -> Vec<Complex<f64>> {
        let mut w = vec![Complex::new(7.0, 7.0); z.len()];
        let task = vectors::Many { f, z, w: &mut w };
        simd.vectorize(
            #[inline(always)]
            || WideTask::run(task, simd, lanes),
        );
        w
    }
    let three = V3::try_new().map(|v| with(v, v, f, z));
    let four = V4::try_new().map(|v| with(v, *v, f, z));
    three.into_iter().chain(four).collect()
}

#[cfg(all(target_arch = "x86_64", feature = "vectors"))]
mod vectors {
    use super::super::batch::chunk::{CHUNK, GROUPS, Order, ROOM};
    use super::super::places::Several;
    use super::{Alone, Function};
    use crate::lanes::Lanes;
    use crate::pack::{Pack, Wide, WideTask};
    use crate::real::Real;
    use num_complex::Complex;
    use pulp::NullaryFnOnce;

    /// As many points as vectors pay for.
    pub(super) const FEW: usize = 8;

    /// A complex function at all points.
    pub(super) struct Many<'a, F> {
        pub f: F,
        pub z: &'a [Complex<f64>],
        pub w: &'a mut [Complex<f64>],
    }

    impl<F: Function<2, 2>> WideTask for Many<'_, F> {
        type Output = ();
        #[inline(always)]
        fn run<S: Wide, L: Lanes>(self, simd: S, lanes: L) {
            let Many { f, z, w } = self;
            let mut at = [[0.0; ROOM]; 2];
            let mut values = [[0.0; CHUNK]; 2];
            let mut order = Order::new();
            for (z, w) in z.chunks(CHUNK).zip(w.chunks_mut(CHUNK)) {
                let [x, y] = &mut at;
                for ((x, y), z) in x.iter_mut().zip(y).zip(z) {
                    (*x, *y) = (z.re, z.im);
                }
                let n = z.len();
                simd.outlined(Chunk {
                    simd,
                    lanes,
                    f,
                    n,
                    at: &at,
                    values: &mut values,
                    order: &mut order,
                });
                let [re, im] = &values;
                for (w, (re, im)) in w.iter_mut().zip(re.iter().zip(im)) {
                    *w = Complex::new(*re, *im);
                }
            }
        }
    }

    /// A function at the first n places of a chunk. A function of its own: it is long, and its
    /// registers are.
    struct Chunk<'a, S, L, F, const N: usize, const M: usize> {
        simd: S,
        lanes: L,
        f: F,
        n: usize,
        at: &'a [[f64; ROOM]; N],
        values: &'a mut [[f64; CHUNK]; M],
        order: &'a mut Order,
    }

    impl<S, L, F, const N: usize, const M: usize> NullaryFnOnce for Chunk<'_, S, L, F, N, M>
    where
        S: Wide,
        L: Lanes,
        F: Function<N, M>,
    {
        type Output = ();
        #[inline(always)]
        fn call(self) {
            let Chunk {
                simd,
                lanes,
                f,
                n,
                at,
                values,
                order,
            } = self;
            let mut present = 0;
            let mut i = 0;
            while i < n {
                let place = at.each_ref().map(
                    #[inline(always)]
                    |column| Pack::load(simd, column, i),
                );
                let classes = f.class(place).array();
                for m in 0..S::WIDTH {
                    order.codes[i + m] = classes[m].to_bits() as u8 & 31;
                }
                i += S::WIDTH;
            }
            for code in &order.codes[..n] {
                present |= 1 << (code & 31);
            }
            order.sort(simd, n, present, 0);
            // The places where the value does not hold.
            let (mut left, mut lost) = ([0_u8; ROOM], 0);
            while present != 0 {
                let class = present.trailing_zeros() as usize;
                present &= present - 1;
                let len = order.len(class);
                let mut k = 0;
                while k < len {
                    let numbers = *order.numbers(class, k);
                    let (value, kept) = f.value(Several(simd), gather(simd, at, &numbers));
                    scatter(&numbers, value, values);
                    mark(
                        &numbers[..S::WIDTH.min(len - k)],
                        value[0],
                        kept,
                        &mut left,
                        &mut lost,
                    );
                    k += S::WIDTH;
                }
            }
            if lost == 0 {
                return;
            }
            let last = left[lost - 1];
            left[lost..][..GROUPS].fill(last);
            let mut k = 0;
            while k < lost {
                let numbers: [u8; GROUPS] = *left[k..].first_chunk().expect("there is room");
                let (value, kept) = f.again(Several(simd), gather(simd, at, &numbers));
                scatter(&numbers, value, values);
                let (mut alone, mut len) = ([0_u8; ROOM], 0);
                mark(
                    &numbers[..S::WIDTH.min(lost - k)],
                    value[0],
                    kept,
                    &mut alone,
                    &mut len,
                );
                for i in alone[..len].iter().map(|i| *i as usize) {
                    let value = lanes.call(Alone(f, at.each_ref().map(|column| column[i])));
                    for (values, value) in values.iter_mut().zip(value) {
                        values[i] = value;
                    }
                }
                k += S::WIDTH;
            }
        }
    }

    /// The places with these numbers.
    #[inline(always)]
    fn gather<S: Wide, const N: usize>(
        simd: S,
        at: &[[f64; ROOM]; N],
        numbers: &[u8; GROUPS],
    ) -> [Pack<S>; N] {
        at.each_ref().map(
            #[inline(always)]
            |column| {
                let mut group = [0.0; 8];
                for m in 0..S::WIDTH {
                    group[m] = column[numbers[m] as usize];
                }
                Pack::load(simd, &group, 0)
            },
        )
    }

    /// Takes the values of a group.
    #[inline(always)]
    fn scatter<S: Wide, const M: usize>(
        numbers: &[u8; GROUPS],
        group: [Pack<S>; M],
        values: &mut [[f64; CHUNK]; M],
    ) {
        for (values, group) in values.iter_mut().zip(group) {
            let group = group.array();
            for m in 0..S::WIDTH {
                values[numbers[m] as usize] = group[m];
            }
        }
    }

    /// Lists the numbers where the mask is false.
    #[inline(always)]
    fn mark<S: Wide>(
        numbers: &[u8],
        any: Pack<S>,
        kept: S::m64s,
        left: &mut [u8; ROOM],
        len: &mut usize,
    ) {
        if any.all(kept) {
            return;
        }
        let kept = any.pick(kept, any.like(1.0), any.like(0.0)).array();
        for (number, kept) in numbers.iter().zip(kept) {
            left[*len & (CHUNK - 1)] = *number;
            *len += usize::from(kept == 0.0);
        }
    }
}
