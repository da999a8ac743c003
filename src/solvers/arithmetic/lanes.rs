//! Four numbers at once: the processor's vectors behind an interface that plain arrays satisfy too.
//!
//! Every operation is one correctly rounded operation on each number, so that the results have the
//! same bits whatever carries them out.

use crate::real::{Four, Real};

/// Operations on four numbers side by side.
pub trait Vectors: Copy {
    /// One number.
    type Scalar: Real;
    /// Four of them.
    type V: Copy;
    /// Four numbers.
    fn load(self, x: [Self::Scalar; 4]) -> Self::V;
    /// Four entries of a table.
    fn entries(self, x: [f64; 4]) -> Self::V;
    /// The same number four times.
    fn splat(self, x: Self::Scalar) -> Self::V;
    /// `a b`
    fn mul(self, a: Self::V, b: Self::V) -> Self::V;
    /// `a b + c`
    fn mul_add(self, a: Self::V, b: Self::V, c: Self::V) -> Self::V;
    /// `c − a b`
    fn neg_mul_add(self, a: Self::V, b: Self::V, c: Self::V) -> Self::V;
    /// The four numbers.
    fn parts(self, x: Self::V) -> [Self::Scalar; 4];
    /// `(x₀ + x₂) + (x₁ + x₃)`
    fn sum(self, x: Self::V) -> Self::Scalar;
}

/// A set of instructions.
pub(crate) trait Lanes: Vectors<Scalar = f64> {
    /// Four numbers as a [`Real`].
    type Quad: Real;
    fn quad(self, x: [f64; 4]) -> Self::Quad;
    fn array(self, x: Self::Quad) -> [f64; 4];
    /// Runs the task as a function of its own, compiled for these instructions.
    fn call<T: Task>(self, task: T) -> T::Output;
}

/// Something to be run with a set of instructions. `run` has to be inlined.
pub(crate) trait Task: Sized {
    type Output;
    fn run<L: Lanes>(self, lanes: L) -> Self::Output;
    // Methods of the task: incremental builds keep them with the module of the task, so that a
    // change there compiles no other task again.
    /// Runs it with arrays, as a function of its own.
    #[inline(never)]
    fn with_arrays(self) -> Self::Output {
        self.run(Plain)
    }
    /// Runs it with AVX2 and FMA, as a function of its own. In development builds there is one of
    /// it, not one for each module that calls it.
    #[cfg(all(target_arch = "x86_64", feature = "vectors"))]
    #[cfg_attr(debug_assertions, inline(never))]
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn with_avx2(self, v: pulp::x86::V3) -> Self::Output {
        v.vectorize(x86::Compiled(v, self))
    }
}

/// Runs the task with the best instructions of this processor.
#[inline(always)]
pub(crate) fn with_best<T: Task>(task: T) -> T::Output {
    #[cfg(all(target_arch = "x86_64", feature = "vectors"))]
    match x86::BEST.get() {
        Some(Some(v)) => return v.call(task),
        None => return x86::first(task),
        Some(None) => (),
    }
    plain(task)
}

/// Runs the task where the processor has no vectors of four numbers.
#[cfg(not(all(target_feature = "avx2", target_feature = "fma")))]
#[inline(always)]
fn plain<T: Task>(task: T) -> T::Output {
    task.with_arrays()
}

/// Code for such processors alone has no other: half of its size would be for processors it does
/// not run on.
#[cfg(all(target_feature = "avx2", target_feature = "fma"))]
#[cold]
fn plain<T: Task>(_: T) -> T::Output {
    panic!("compiled for AVX2 and FMA, which this processor does not have");
}

/// Arrays.
#[derive(Clone, Copy)]
pub(crate) struct Plain;

impl Vectors for Plain {
    type Scalar = f64;
    type V = [f64; 4];
    #[inline(always)]
    fn load(self, x: [f64; 4]) -> [f64; 4] {
        x
    }
    #[inline(always)]
    fn entries(self, x: [f64; 4]) -> [f64; 4] {
        x
    }
    #[inline(always)]
    fn splat(self, x: f64) -> [f64; 4] {
        [x; 4]
    }
    #[inline(always)]
    fn mul(self, a: [f64; 4], b: [f64; 4]) -> [f64; 4] {
        std::array::from_fn(|i| a[i] * b[i])
    }
    #[cfg_attr(debug_assertions, inline(never))]
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn mul_add(self, a: [f64; 4], b: [f64; 4], c: [f64; 4]) -> [f64; 4] {
        std::array::from_fn(|i| a[i].mul_add(b[i], c[i]))
    }
    #[cfg_attr(debug_assertions, inline(never))]
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn neg_mul_add(self, a: [f64; 4], b: [f64; 4], c: [f64; 4]) -> [f64; 4] {
        std::array::from_fn(|i| (-a[i]).mul_add(b[i], c[i]))
    }
    #[inline(always)]
    fn parts(self, x: [f64; 4]) -> [f64; 4] {
        x
    }
    #[inline(always)]
    fn sum(self, x: [f64; 4]) -> f64 {
        (x[0] + x[2]) + (x[1] + x[3])
    }
}

impl Lanes for Plain {
    type Quad = Four;
    #[inline(always)]
    fn quad(self, x: [f64; 4]) -> Four {
        Four(x)
    }
    #[inline(always)]
    fn array(self, x: Four) -> [f64; 4] {
        x.0
    }
    #[inline(always)]
    fn call<T: Task>(self, task: T) -> T::Output {
        task.with_arrays()
    }
}

#[cfg(all(target_arch = "x86_64", feature = "vectors"))]
mod x86 {
    use super::{Lanes, Task, Vectors};
    use crate::pack::Pack;
    use pulp::x86::V3;
    use pulp::{NullaryFnOnce, cast, f64x4};
    use std::sync::OnceLock;

    /// States what the processor was found to have.
    pub(crate) static BEST: OnceLock<Option<V3>> = OnceLock::new();

    /// Looks what the processor has. A function of its own, and away from the others: where it may
    /// be called in between, numbers in vector registers go to memory and back, for every value.
    #[cold]
    #[inline(never)]
    pub(crate) fn first<T: Task>(task: T) -> T::Output {
        match BEST.get_or_init(V3::try_new) {
            Some(v) => v.call(task),
            None => super::plain(task),
        }
    }

    pub(super) struct Compiled<T>(pub V3, pub T);

    impl<T: Task> NullaryFnOnce for Compiled<T> {
        type Output = T::Output;
        #[inline(always)]
        fn call(self) -> T::Output {
            self.1.run(self.0)
        }
    }

    impl Vectors for V3 {
        type Scalar = f64;
        type V = f64x4;
        #[inline(always)]
        fn load(self, x: [f64; 4]) -> f64x4 {
            cast(x)
        }
        #[inline(always)]
        fn entries(self, x: [f64; 4]) -> f64x4 {
            cast(x)
        }
        #[inline(always)]
        fn splat(self, x: f64) -> f64x4 {
            self.splat_f64x4(x)
        }
        #[inline(always)]
        fn mul(self, a: f64x4, b: f64x4) -> f64x4 {
            self.mul_f64x4(a, b)
        }
        #[inline(always)]
        fn mul_add(self, a: f64x4, b: f64x4, c: f64x4) -> f64x4 {
            self.mul_add_f64x4(a, b, c)
        }
        #[inline(always)]
        fn neg_mul_add(self, a: f64x4, b: f64x4, c: f64x4) -> f64x4 {
            self.negate_mul_add_f64x4(a, b, c)
        }
        #[inline(always)]
        fn parts(self, x: f64x4) -> [f64; 4] {
            cast(x)
        }
        #[inline(always)]
        fn sum(self, x: f64x4) -> f64 {
            (x.0 + x.2) + (x.1 + x.3)
        }
    }

    impl Lanes for V3 {
        type Quad = Pack<V3>;
        #[inline(always)]
        fn quad(self, x: [f64; 4]) -> Pack<V3> {
            Pack(self, cast(x))
        }
        #[inline(always)]
        fn array(self, x: Pack<V3>) -> [f64; 4] {
            cast(x.1)
        }
        #[inline(always)]
        fn call<T: Task>(self, task: T) -> T::Output {
            task.with_avx2(self)
        }
    }
}
