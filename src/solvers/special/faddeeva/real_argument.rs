//! Error functions and Dawson's function of a real argument, at one point or at many.
//!
//! Each function is written once, for one number or several side by side ([`Places`]): places that
//! need different formulas take all of these, and each keeps the value of its own.

use super::axis::erf_row;
use super::branch::{HUGE, modulus_squared};
use super::erfc_rows::{self, erfc_row, erfcx_row, erfi_row};
use super::lengths::{LengthMismatch, same_length};
use super::pairs::{dawson_right, erfcx_right};
use super::places::{Number, One, Places};
use super::real_line::{
    BEYOND, FAR, ONE, SERIES, dawson_beyond, dawson_near, erfc_left, erfc_right, growth,
};
use super::rows::on_real_axis;
use super::special;
use crate::lanes::{Lanes, Task, with_best};
use crate::real::{Masked, Real, scaled};

#[cfg(all(target_arch = "x86_64", feature = "vectors"))]
use super::places::Several;
#[cfg(all(target_arch = "x86_64", feature = "vectors"))]
use crate::pack::{Wide, WideTask, by_groups, with_widest};

/// A function of a real argument.
trait Function: Copy {
    fn at<P: Places>(self, places: P, x: Number<P>) -> Number<P>;
}

/// erf x, real.
#[derive(Clone, Copy)]
struct Erf;

impl Function for Erf {
    #[inline(always)]
    fn at<P: Places>(self, places: P, x: Number<P>) -> Number<P> {
        let a = x.magnitude();
        let among = a.below(x.like(ONE));
        // NaN stays NaN.
        let mut value = a.at_most(x.like(1.0));
        if x.any(among) {
            let (n, t) = on_real_axis(a);
            value = x.pick(among, places.axis_rows(erf_row, n, t).hi, value);
        }
        value.with_sign_of(x)
    }
}

/// erfc x, real.
#[derive(Clone, Copy)]
struct Erfc;

impl Function for Erfc {
    #[inline(always)]
    fn at<P: Places>(self, places: P, x: Number<P>) -> Number<P> {
        let like = |c: f64| x.like(c);
        let b = x.magnitude();
        let positive = like(0.0).below(x);
        let among = b.below(like(BEYOND));
        let mut value = b;
        if x.any(among) {
            let (n, c, t) = erfc_rows::centre(b);
            let sum = erfc_rows::value(places.rows(erfc_row, n), c, t);
            let left = erfc_left(sum).value();
            value = x.pick(positive, sum.hi, left);
            if x.all(among) {
                return value;
            }
        }
        // 0 or 2, or NaN.
        let limit = (-x).at_least(like(-1.0)).at_most(like(1.0)) + like(1.0);
        value = x.pick(among, value, limit);
        let right = x.both(x.except(b.below(like(FAR)), among), positive);
        if x.any(right) {
            let (t, n) = erfc_right(b, erfcx_right(b, right));
            value = x.pick(right, scaled(t.value(), n), value);
        }
        value
    }
}

/// erfcx x = `e^{x²} erfc x`, real.
#[derive(Clone, Copy)]
struct Erfcx;

impl Function for Erfcx {
    #[inline(always)]
    fn at<P: Places>(self, places: P, x: Number<P>) -> Number<P> {
        let like = |c: f64| x.like(c);
        let b = x.magnitude();
        let negative = x.below(like(0.0));
        let among = b.below(like(BEYOND));
        let mut value = like(f64::INFINITY);
        if x.any(among) {
            let (n, c, t) = erfc_rows::centre(b);
            let [hi, lo, left_hi, left_lo] = places.rows(erfcx_row, n);
            let row = [x.pick(negative, left_hi, hi), x.pick(negative, left_lo, lo)];
            let sum = erfc_rows::erfcx_value(row, c.with_sign_of(x), t.with_sign_of(x));
            value = x.pick(among, sum.value(), value);
        }
        if x.all(among) {
            return value;
        }
        let finite = modulus_squared(like(0.0), b).below(like(HUGE));
        let right = x.except(finite, x.or(among, negative));
        if x.any(right) {
            value = x.pick(right, erfcx_right(b, right).value(), value);
        }
        let left = x.except(x.both(b.below(like(FAR)), negative), among);
        if x.any(left) {
            let (e, n) = growth(b);
            value = x.pick(left, scaled(e.value(), n + like(1.0)), value);
        }
        let [value] = places.replaced(finite, [value], [x], |at| [limit_of_erfcx(at)]);
        value
    }
}

/// erfcx of a huge argument, infinity or NaN.
#[cold]
#[inline(never)]
fn limit_of_erfcx([x]: [f64; 1]) -> f64 {
    if x < 0.0 {
        return f64::INFINITY;
    }
    special::on_imaginary_axis(x)
}

/// erfi x, real: beyond the rows `(2/√π) e^{x²} F(x)`.
#[derive(Clone, Copy)]
struct Erfi;

impl Function for Erfi {
    #[inline(always)]
    fn at<P: Places>(self, places: P, x: Number<P>) -> Number<P> {
        let a = x.magnitude();
        let among = a.below(x.like(BEYOND));
        let mut value = a;
        if x.any(among) {
            let (n, c, t) = erfc_rows::centre(a);
            value = erfc_rows::erfi_value(places.rows(erfi_row, n), c, t).hi;
            if x.all(among) {
                return value.with_sign_of(x);
            }
        }
        // NaN stays NaN.
        value = x.pick(among, value, a + x.like(f64::INFINITY));
        let right = x.except(a.below(x.like(FAR)), among);
        if x.any(right) {
            let (e, n) = growth(a);
            let p = dawson_right(places, a, right);
            value = x.pick(right, scaled((e * p).value(), n), value);
        }
        value.with_sign_of(x)
    }
}

/// Dawson's function of a real argument.
#[derive(Clone, Copy)]
struct Dawson;

impl Function for Dawson {
    #[inline(always)]
    fn at<P: Places>(self, places: P, x: Number<P>) -> Number<P> {
        let a = x.magnitude();
        let finite = modulus_squared(a, x.like(0.0)).below(x.like(HUGE));
        let near = a.below(x.like(SERIES));
        let middle = x.except(finite, near);
        let mut value = a;
        if x.any(middle) {
            value = dawson_beyond(dawson_right(places, a, middle)).value();
        }
        if x.any(near) {
            value = x.pick(near, dawson_near(a).value(), value);
        }
        if !x.all(finite) {
            // NaN stays NaN.
            value = x.pick(finite, value, x.like(0.5) / a);
        }
        value.with_sign_of(x)
    }
}

/// One point.
struct At<F>(F, f64);

impl<F: Function> Task for At<F> {
    type Output = f64;
    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> f64 {
        self.0.at(One(lanes), self.1)
    }
}

/// Many points; the slices have one length.
struct Many<'a, F>(F, &'a [f64], &'a mut [f64]);

impl<F: Function> Task for Many<'_, F> {
    type Output = ();
    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) {
        for (y, x) in self.2.iter_mut().zip(self.1) {
            *y = self.0.at(One(lanes), *x);
        }
    }
}

#[cfg(all(target_arch = "x86_64", feature = "vectors"))]
impl<F: Function> WideTask for Many<'_, F> {
    type Output = ();
    #[inline(always)]
    fn run<S: Wide, L: Lanes>(self, simd: S, _: L) {
        let Many(f, x, y) = self;
        by_groups(
            simd,
            [x],
            y,
            #[inline(always)]
            |[x]| f.at(Several(simd), x),
        );
    }
}

/// As many points as vectors pay for.
#[cfg(all(target_arch = "x86_64", feature = "vectors"))]
const FEW: usize = 3;

/// The function at many points.
fn many<F: Function>(f: F, x: &[f64], y: &mut [f64]) -> Result<(), LengthMismatch> {
    same_length(x.len(), [y.len()])?;
    let task = Many(f, x, y);
    #[cfg(all(target_arch = "x86_64", feature = "vectors"))]
    let task = match task.1.len() {
        0..FEW => task,
        _ => match with_widest(task) {
            Ok(()) => return Ok(()),
            Err(task) => task,
        },
    };
    with_best(task);
    Ok(())
}

/// A function at one point and at many.
macro_rules! functions {
    ($($(#[$documented:meta])* $name:ident, $many:ident, $function:expr;)+) => {$(
        $(#[$documented])*
        pub fn $name(x: f64) -> f64 {
            with_best(At($function, x))
        }

        #[doc = concat!("[`", stringify!($name), "`] at many points, by vectors; the values have the same bits.")]
        ///
        /// # Errors
        /// [`LengthMismatch`] if the slices differ in length; nothing is written then.
        ///
        /// ```
        #[doc = concat!("use mechaudit_solvers::faddeeva::{", stringify!($name), ", ", stringify!($many), "};")]
        /// let x = [-0.5, 0.3, 2.5];
        /// let mut y = [0.0; 3];
        #[doc = concat!(stringify!($many), "(&x, &mut y)?;")]
        #[doc = concat!("assert_eq!(y, x.map(", stringify!($name), "));")]
        /// # Ok::<(), mechaudit_solvers::faddeeva::LengthMismatch>(())
        /// ```
        pub fn $many(x: &[f64], y: &mut [f64]) -> Result<(), LengthMismatch> {
            many($function, x, y)
        }
    )+};
}

functions! {
    /// [`erf`](super::erf()) of a real argument.
    ///
    /// Proved for every finite argument: within 7/8 of a unit in the last place
    /// (`mechaudit prove erf`). `erf(±∞) = ±1`, NaN for NaN.
    ///
    /// ```
    /// use mechaudit_solvers::faddeeva::erf_real;
    /// assert_eq!(erf_real(0.5), 0.5204998778130465);
    /// ```
    erf_real, erf_real_batch, Erf;

    /// [`erfc`](super::erfc()) of a real argument.
    ///
    /// Proved for every finite argument: within 7/8 of a unit in the last place
    /// (`mechaudit prove erfc`), gradual underflow from 26.5 to 27.2 included. `erfc(∞) = 0`,
    /// `erfc(−∞) = 2`, NaN for NaN.
    ///
    /// ```
    /// use mechaudit_solvers::faddeeva::erfc_real;
    /// assert!((erfc_real(27.0) / 5.23705e-319 - 1.0).abs() < 1e-4);
    /// ```
    erfc_real, erfc_real_batch, Erfc;

    /// [`erfcx`](super::erfcx()) of a real argument.
    ///
    /// Proved for every finite argument: within 7/8 of a unit in the last place (`mechaudit prove
    /// erfcx`), or +∞ where the value is above the range, below −26.62873571375149. `erfcx(∞) = 0`,
    /// NaN for NaN.
    ///
    /// ```
    /// use mechaudit_solvers::faddeeva::erfcx_real;
    /// assert!((erfcx_real(1.0) - 0.427583576155807).abs() < 1e-15);
    /// ```
    erfcx_real, erfcx_real_batch, Erfcx;

    /// [`erfi`](super::erfi()) of a real argument.
    ///
    /// Worst found, 10⁵ arguments: 0.55 units in the last place from 1e-290 on, 0.73 below. ±∞ beyond
    /// ±26.714, NaN for NaN.
    ///
    /// ```
    /// use mechaudit_solvers::faddeeva::erfi_real;
    /// assert_eq!(erfi_real(27.0), f64::INFINITY);
    /// ```
    erfi_real, erfi_real_batch, Erfi;

    /// [`dawson`](super::dawson()) of a real argument.
    ///
    /// Proved for every finite argument: within 7/8 of a unit in the last place
    /// (`mechaudit prove dawson`). ±0 at ±∞, NaN for NaN.
    ///
    /// ```
    /// use mechaudit_solvers::faddeeva::dawson_real;
    /// assert!((dawson_real(1.0) - 0.5380795069127684).abs() < 1e-15);
    /// ```
    dawson_real, dawson_real_batch, Dawson;
}

/// The function of this name with given instructions.
#[cfg(test)]
pub(super) fn by_lanes<L: Lanes>(lanes: L, name: &str, x: &[f64], y: &mut [f64]) {
    match name {
        "erf" => Task::run(Many(Erf, x, y), lanes),
        "erfc" => Task::run(Many(Erfc, x, y), lanes),
        "erfcx" => Task::run(Many(Erfcx, x, y), lanes),
        "erfi" => Task::run(Many(Erfi, x, y), lanes),
        _ => Task::run(Many(Dawson, x, y), lanes),
    }
}

/// Computes the function of a name at many points.
#[cfg(test)]
type Way = fn(&str, &[f64], &mut [f64]);

/// With every set of vectors that this processor has.
#[cfg(all(test, target_arch = "x86_64", feature = "vectors"))]
pub(super) fn every_way() -> Vec<Way> {
    use pulp::x86::{V3, V4};

    fn with<S: Wide>(simd: S, lanes: impl Lanes, name: &str, x: &[f64], y: &mut [f64]) {
        simd.vectorize(
            #[inline(always)]
            || match name {
                "erf" => WideTask::run(Many(Erf, x, y), simd, lanes),
                "erfc" => WideTask::run(Many(Erfc, x, y), simd, lanes),
                "erfcx" => WideTask::run(Many(Erfcx, x, y), simd, lanes),
                "erfi" => WideTask::run(Many(Erfi, x, y), simd, lanes),
                _ => WideTask::run(Many(Dawson, x, y), simd, lanes),
            },
        );
    }
    let mut all: Vec<Way> = Vec::new();
    if V3::try_new().is_some() {
        all.push(|name, x, y| {
            let v = V3::try_new().expect("found before");
            with(v, v, name, x, y);
        });
    }
    if V4::try_new().is_some() {
        all.push(|name, x, y| {
            let v = V4::try_new().expect("found before");
            with(v, *v, name, x, y);
        });
    }
    all
}

/// There are none.
#[cfg(all(test, not(all(target_arch = "x86_64", feature = "vectors"))))]
pub(super) fn every_way() -> Vec<Way> {
    Vec::new()
}
