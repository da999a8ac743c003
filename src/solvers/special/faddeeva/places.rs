//! One point, or several side by side: how formulas that are written for both find rows of tables.

use super::taylor::{ComplexRow, axis_row, real_row, summed_real_row, summed_row};
use crate::double_double::Dd;
use crate::lanes::Lanes;
use crate::numbers::Numbers;
pub(super) use crate::numbers::One;
use crate::real::Real;

#[cfg(all(target_arch = "x86_64", feature = "vectors"))]
use super::taylor::{OnRows, axis_rows, real_rows, summed_real_rows};
#[cfg(all(target_arch = "x86_64", feature = "vectors"))]
pub(super) use crate::numbers::Several;
#[cfg(all(target_arch = "x86_64", feature = "vectors"))]
use crate::pack::{Pack, Wide, columns};

/// One point or several.
pub(super) trait Places: Numbers {
    /// The rows that belong to the numbers in `n`, number by number.
    fn rows(self, row: impl Fn(f64) -> &'static [f64; 4], n: Self::Number) -> [Self::Number; 4];
    /// [`axis_row`] at each, `t` from the centre of the row that belongs to the number in `n`.
    fn axis_rows<const N: usize>(
        self,
        row: impl Fn(f64) -> &'static [f64; N],
        n: Self::Number,
        t: Self::Number,
    ) -> Dd<Self::Number>;
    /// [`real_row`] likewise.
    fn real_rows(
        self,
        row: impl Fn(f64) -> &'static [f64; 20],
        n: Self::Number,
        delta: (Self::Number, Self::Number),
    ) -> (Dd<Self::Number>, Dd<Self::Number>);
    /// [`summed_row`] likewise, from the centre and the distance to it.
    fn summed_rows<const SUM: u8>(
        self,
        row: impl Fn(f64) -> &'static ComplexRow,
        n: Self::Number,
        centre: (Self::Number, Self::Number),
        delta: (Self::Number, Self::Number),
    ) -> (Dd<Self::Number>, Dd<Self::Number>);
    /// [`summed_real_row`] likewise.
    fn summed_real_rows<const SUM: u8>(
        self,
        row: impl Fn(f64) -> &'static [f64; 20],
        n: Self::Number,
        centre: Self::Number,
        delta: (Self::Number, Self::Number),
    ) -> (Dd<Self::Number>, Dd<Self::Number>);
}

/// The number at one point or several.
pub(super) type Number<P> = <P as Numbers>::Number;
/// Where something holds.
pub(super) type Mask<P> = <Number<P> as Real>::Mask;

/// Values that are chosen place by place.
pub(super) trait Choose: Copy {
    type Number: Real;
    /// `self` where the mask is true, `other` elsewhere.
    fn or_else(self, mask: <Self::Number as Real>::Mask, other: Self) -> Self;
    /// Zero everywhere.
    fn none(like: Self::Number) -> Self;
}

impl<R: Real> Choose for Dd<R> {
    type Number = R;
    #[inline(always)]
    fn or_else(self, mask: R::Mask, other: Self) -> Self {
        let pick = |yes: R, no: R| yes.pick(mask, yes, no);
        Dd::new(pick(self.hi, other.hi), pick(self.lo, other.lo))
    }
    #[inline(always)]
    fn none(like: R) -> Self {
        Dd::new(like.like(0.0), like.like(0.0))
    }
}

impl<R: Real> Choose for (Dd<R>, Dd<R>) {
    type Number = R;
    #[inline(always)]
    fn or_else(self, mask: R::Mask, other: Self) -> Self {
        (self.0.or_else(mask, other.0), self.1.or_else(mask, other.1))
    }
    #[inline(always)]
    fn none(like: R) -> Self {
        (Dd::none(like), Dd::none(like))
    }
}

/// In the places `among` the first of the formulas whose end a number is below; elsewhere anything.
macro_rules! by_ends {
    ($number:expr, $among:expr; $($end:expr => $formula:expr),+) => {'found: {
        let (number, mut among) = ($number, $among);
        let mut value = $crate::faddeeva::places::Choose::none(number);
        $(
            let inside = number.below(number.like($end));
            let here = number.both(among, inside);
            if number.any(here) {
                let found = $formula;
                // As a rule.
                if number.all(here) {
                    break 'found found;
                }
                value = $crate::faddeeva::places::Choose::or_else(found, here, value);
            }
            among = number.except(among, inside);
        )+
        let _ = among;
        value
    }};
}
pub(super) use by_ends;

impl<L: Lanes> Places for One<L> {
    #[inline(always)]
    fn rows(self, row: impl Fn(f64) -> &'static [f64; 4], n: f64) -> [f64; 4] {
        *row(n)
    }
    #[inline(always)]
    fn axis_rows<const N: usize>(
        self,
        row: impl Fn(f64) -> &'static [f64; N],
        n: f64,
        t: f64,
    ) -> Dd {
        axis_row(self.0, row(n), t)
    }
    #[inline(always)]
    fn real_rows(
        self,
        row: impl Fn(f64) -> &'static [f64; 20],
        n: f64,
        (t, b): (f64, f64),
    ) -> (Dd, Dd) {
        real_row(self.0, row(n), t, b)
    }
    #[inline(always)]
    fn summed_rows<const SUM: u8>(
        self,
        row: impl Fn(f64) -> &'static ComplexRow,
        n: f64,
        centre: (f64, f64),
        delta: (f64, f64),
    ) -> (Dd, Dd) {
        summed_row::<_, SUM>(self.0, row(n), centre, delta)
    }
    #[inline(always)]
    fn summed_real_rows<const SUM: u8>(
        self,
        row: impl Fn(f64) -> &'static [f64; 20],
        n: f64,
        centre: f64,
        delta: (f64, f64),
    ) -> (Dd, Dd) {
        summed_real_row::<_, SUM>(self.0, row(n), centre, delta)
    }
}

/// The rows of as many points as there are.
#[cfg(all(target_arch = "x86_64", feature = "vectors"))]
#[inline(always)]
fn rows_of<S: Wide, T: 'static>(n: Pack<S>, row: impl Fn(f64) -> &'static T) -> [&'static T; 8] {
    let n = n.array();
    let mut rows = [row(n[0]); 8];
    for m in 1..S::WIDTH {
        rows[m] = row(n[m]);
    }
    rows
}

#[cfg(all(target_arch = "x86_64", feature = "vectors"))]
impl<S: Wide> Places for Several<S> {
    #[inline(always)]
    fn rows(self, row: impl Fn(f64) -> &'static [f64; 4], n: Pack<S>) -> [Pack<S>; 4] {
        columns(self.0, &rows_of(n, row), 0)
    }
    #[inline(always)]
    fn axis_rows<const N: usize>(
        self,
        row: impl Fn(f64) -> &'static [f64; N],
        n: Pack<S>,
        t: Pack<S>,
    ) -> Dd<Pack<S>> {
        axis_rows(self.0, &rows_of(n, row), t)
    }
    #[inline(always)]
    fn real_rows(
        self,
        row: impl Fn(f64) -> &'static [f64; 20],
        n: Pack<S>,
        (t, b): (Pack<S>, Pack<S>),
    ) -> (Dd<Pack<S>>, Dd<Pack<S>>) {
        real_rows(self.0, &rows_of(n, row), t, b)
    }
    #[inline(always)]
    fn summed_rows<const SUM: u8>(
        self,
        row: impl Fn(f64) -> &'static ComplexRow,
        n: Pack<S>,
        centre: (Pack<S>, Pack<S>),
        (dx, dy): (Pack<S>, Pack<S>),
    ) -> (Dd<Pack<S>>, Dd<Pack<S>>) {
        let rows = rows_of(n, row).map(|r| &r.0);
        OnRows { rows, dx, dy }.summed::<SUM>(self.0, centre)
    }
    #[inline(always)]
    fn summed_real_rows<const SUM: u8>(
        self,
        row: impl Fn(f64) -> &'static [f64; 20],
        n: Pack<S>,
        centre: Pack<S>,
        delta: (Pack<S>, Pack<S>),
    ) -> (Dd<Pack<S>>, Dd<Pack<S>>) {
        summed_real_rows::<_, SUM>(self.0, &rows_of(n, row), centre, delta)
    }
}
