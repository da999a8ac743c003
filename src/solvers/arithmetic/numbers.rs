//! One number, or several side by side with a value of their own each.

use crate::lanes::Lanes;
use crate::real::{Masked, Real};

#[cfg(all(target_arch = "x86_64", feature = "vectors"))]
use crate::pack::{Pack, Wide};
#[cfg(all(target_arch = "x86_64", feature = "vectors"))]
use crate::two::Two;

/// One number or several.
pub(crate) trait Numbers: Copy {
    /// A number for each.
    type Number: Masked;
    /// Four of them.
    type Quad: Real;
    fn quad(self, x: [Self::Number; 4]) -> Self::Quad;
    fn quarters(self, x: Self::Quad) -> [Self::Number; 4];
    /// The values where the mask is true, and `f` of the places elsewhere.
    fn replaced<const N: usize, const M: usize>(
        self,
        mask: <Self::Number as Real>::Mask,
        values: [Self::Number; M],
        arguments: [Self::Number; N],
        f: impl Fn([f64; N]) -> [f64; M],
    ) -> [Self::Number; M];
}

/// One number.
#[derive(Clone, Copy)]
pub(crate) struct One<L>(pub L);

impl<L: Lanes> Numbers for One<L> {
    type Number = f64;
    type Quad = L::Quad;
    #[inline(always)]
    fn quad(self, x: [f64; 4]) -> L::Quad {
        self.0.quad(x)
    }
    #[inline(always)]
    fn quarters(self, x: L::Quad) -> [f64; 4] {
        self.0.array(x)
    }
    #[inline(always)]
    fn replaced<const N: usize, const M: usize>(
        self,
        mask: bool,
        values: [f64; M],
        arguments: [f64; N],
        f: impl Fn([f64; N]) -> [f64; M],
    ) -> [f64; M] {
        if mask { values } else { f(arguments) }
    }
}

/// As many numbers as a vector has places.
#[cfg(all(target_arch = "x86_64", feature = "vectors"))]
#[derive(Clone, Copy)]
pub(crate) struct Several<S>(pub S);

#[cfg(all(target_arch = "x86_64", feature = "vectors"))]
impl<S: Wide> Numbers for Several<S> {
    type Number = Pack<S>;
    type Quad = Two<Two<Pack<S>>>;
    #[inline(always)]
    fn quad(self, [a, b, c, d]: [Pack<S>; 4]) -> Self::Quad {
        Two(Two(a, b), Two(c, d))
    }
    #[inline(always)]
    fn quarters(self, Two(Two(a, b), Two(c, d)): Self::Quad) -> [Pack<S>; 4] {
        [a, b, c, d]
    }
    #[inline(always)]
    fn replaced<const N: usize, const M: usize>(
        self,
        mask: S::m64s,
        values: [Pack<S>; M],
        arguments: [Pack<S>; N],
        f: impl Fn([f64; N]) -> [f64; M],
    ) -> [Pack<S>; M] {
        let any = arguments[0];
        if any.all(mask) {
            return values;
        }
        let kept = any.flags(mask);
        let arguments = arguments.map(Pack::array);
        let mut values = values.map(Pack::array);
        for m in 0..S::WIDTH {
            if kept[m] == 0.0 {
                let alone = f(arguments.map(|a| a[m]));
                for (value, alone) in values.iter_mut().zip(alone) {
                    value[m] = alone;
                }
            }
        }
        values.map(|v| Pack::load(self.0, &v, 0))
    }
}
