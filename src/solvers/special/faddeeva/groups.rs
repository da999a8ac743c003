//! Functions of one number or of a few, at one place and at many: places that need the same formulas
//! are brought together and computed side by side.

use super::places::{Mask, Number, One, Places};
use crate::lanes::{Lanes, Task, with_best};
use crate::real::Masked;
use num_complex::Complex;

/// A function of two numbers with a value of two.
#[cfg_attr(
    not(all(target_arch = "x86_64", feature = "vectors")),
    allow(dead_code)
)]
pub(super) trait Function: Copy {
    /// `ROUND` plus a number below 30: places that have it in common need the same formulas, mostly.
    fn class<R: Masked>(self, at: [R; 2]) -> R;
    /// The value, and where it holds.
    fn value<P: Places>(self, places: P, at: [Number<P>; 2]) -> ([Number<P>; 2], Mask<P>);
    /// The value where [`value`](Function::value) does not hold, and where this one does.
    fn again<P: Places>(self, places: P, at: [Number<P>; 2]) -> ([Number<P>; 2], Mask<P>);
    /// The value at one place where [`again`](Function::again) does not hold.
    fn alone<L: Lanes>(self, lanes: L, at: [f64; 2]) -> [f64; 2];
}

/// One place.
struct At<F>(F, [f64; 2]);

impl<F: Function> Task for At<F> {
    type Output = [f64; 2];
    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> [f64; 2] {
        let (value, kept) = self.0.value(One(lanes), self.1);
        match kept {
            true => value,
            false => lanes.call(OnceMore(self.0, self.1)),
        }
    }
}

/// One place where [`Function::value`] does not hold: a function of its own, because it is long.
struct OnceMore<F>(F, [f64; 2]);

impl<F: Function> Task for OnceMore<F> {
    type Output = [f64; 2];
    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> [f64; 2] {
        let (value, kept) = self.0.again(One(lanes), self.1);
        match kept {
            true => value,
            false => lanes.call(Alone(self.0, self.1)),
        }
    }
}

/// One place where [`Function::again`] does not hold, likewise.
struct Alone<F>(F, [f64; 2]);

impl<F: Function> Task for Alone<F> {
    type Output = [f64; 2];
    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> [f64; 2] {
        self.0.alone(lanes, self.1)
    }
}

/// A complex function at one point.
#[inline(always)]
pub(super) fn at_one(f: impl Function, z: Complex<f64>) -> Complex<f64> {
    let [re, im] = with_best(At(f, [z.re, z.im]));
    Complex::new(re, im)
}

/// A complex function at all points; the slices have one length.
pub(super) fn at_all<F: Function>(f: F, z: &[Complex<f64>], w: &mut [Complex<f64>]) {
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

impl<F: Function> Task for OneByOne<'_, F> {
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
pub(super) fn every_way<F: Function>(f: F, z: &[Complex<f64>]) -> Vec<Vec<Complex<f64>>> {
    use crate::pack::{Wide, WideTask};
    use pulp::x86::{V3, V4};

    fn with<S: Wide>(
        simd: S,
        lanes: impl Lanes,
        f: impl Function,
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

    impl<F: Function> WideTask for Many<'_, F> {
        type Output = ();
        #[inline(always)]
        fn run<S: Wide, L: Lanes>(self, simd: S, lanes: L) {
            let Many { f, z, w } = self;
            let mut at = [[0.0; ROOM]; 2];
            let mut order = Order::new();
            // Most short arrays need none of it.
            let mut left = None;
            let mut start = 0;
            while start < z.len() {
                let n = CHUNK.min(z.len() - start);
                let [x, y] = &mut at;
                for ((x, y), z) in x.iter_mut().zip(y).zip(&z[start..][..n]) {
                    (*x, *y) = (z.re, z.im);
                }
                simd.outlined(Chunk {
                    simd,
                    f,
                    at: &at,
                    w: &mut w[start..][..n],
                    order: &mut order,
                    left: &mut left,
                    start,
                });
                start += n;
                let last = start == z.len();
                if let Some(left) = &mut left
                    && (last || left.len >= S::Four::WIDTH)
                {
                    let simd = simd.four();
                    simd.outlined(Again {
                        simd,
                        lanes,
                        f,
                        left,
                        w,
                        last,
                    });
                }
            }
        }
    }

    /// Points where the value does not hold.
    struct Left {
        at: [[f64; ROOM]; 2],
        index: [usize; ROOM],
        len: usize,
    }

    /// A function at the places of a chunk, as many as there are values, and where it does not
    /// hold. A function of its own: it is long, and its registers are.
    struct Chunk<'a, S, F> {
        simd: S,
        f: F,
        at: &'a [[f64; ROOM]; 2],
        w: &'a mut [Complex<f64>],
        order: &'a mut Order,
        left: &'a mut Option<Left>,
        /// The index of the first place.
        start: usize,
    }

    impl<S: Wide, F: Function> NullaryFnOnce for Chunk<'_, S, F> {
        type Output = ();
        #[inline(always)]
        fn call(self) {
            let Chunk {
                simd,
                f,
                at,
                w,
                order,
                left,
                start,
            } = self;
            let n = w.len();
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
            // Without gaps: a group may have points of two classes, and the formulas of both.
            order.sort(simd, n, present, (0, 0));
            let first = present.trailing_zeros() as usize;
            let mut k = 0;
            while k < n {
                let numbers = order.numbers(first, k);
                let place = gather(simd, at, numbers);
                let (value, kept) = f.value(Several(simd), place);
                let [re, im] = value.map(Pack::array);
                let numbers = &numbers[..S::WIDTH.min(n - k)];
                for (m, i) in numbers.iter().enumerate() {
                    w[*i as usize] = Complex::new(re[m], im[m]);
                }
                if !value[0].all(kept) {
                    let left = left.get_or_insert_with(|| Left {
                        at: [[0.0; ROOM]; 2],
                        index: [0; ROOM],
                        len: 0,
                    });
                    left.add(numbers, place, value[0].flags(kept), start);
                }
                k += S::WIDTH;
            }
        }
    }

    impl Left {
        /// Takes the places whose flag is zero.
        #[inline(always)]
        fn add<S: Wide>(
            &mut self,
            numbers: &[u8],
            place: [Pack<S>; 2],
            flags: [f64; 8],
            start: usize,
        ) {
            let place = place.map(Pack::array);
            for (m, i) in numbers.iter().enumerate() {
                let len = self.len.min(ROOM - 1);
                for (column, place) in self.at.iter_mut().zip(place) {
                    column[len] = place[m];
                }
                self.index[len] = start + *i as usize;
                self.len += usize::from(flags[m] == 0.0);
            }
        }
    }

    /// The values at those points: of as many as make whole groups, or of all.
    struct Again<'a, S, L, F> {
        simd: S,
        lanes: L,
        f: F,
        left: &'a mut Left,
        w: &'a mut [Complex<f64>],
        last: bool,
    }

    impl<S: Wide, L: Lanes, F: Function> NullaryFnOnce for Again<'_, S, L, F> {
        type Output = ();
        #[inline(always)]
        fn call(self) {
            let Again {
                simd,
                lanes,
                f,
                left: Left { at, index, len },
                w,
                last,
            } = self;
            if last && *len > 0 {
                for column in at.iter_mut() {
                    let last = column[*len - 1];
                    column[*len..][..8].fill(last);
                }
            }
            let mut k = 0;
            while k + S::WIDTH <= *len || last && k < *len {
                let place = at.each_ref().map(
                    #[inline(always)]
                    |column| Pack::load(simd, column, k),
                );
                let (value, kept) = f.again(Several(simd), place);
                let kept = value[0].flags(kept);
                let [re, im] = value.map(Pack::array);
                for m in 0..S::WIDTH.min(*len - k) {
                    let [re, im] = match kept[m] == 0.0 {
                        true => lanes.call(Alone(f, at.each_ref().map(|column| column[k + m]))),
                        false => [re[m], im[m]],
                    };
                    w[index[k + m]] = Complex::new(re, im);
                }
                k += S::WIDTH;
            }
            let done = k.min(*len);
            for column in at {
                column.copy_within(done..*len, 0);
            }
            index.copy_within(done..*len, 0);
            *len -= done;
        }
    }

    /// The places with these numbers.
    #[inline(always)]
    fn gather<S: Wide>(simd: S, at: &[[f64; ROOM]; 2], numbers: &[u8; GROUPS]) -> [Pack<S>; 2] {
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
}
