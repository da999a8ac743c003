//! Interpolating cubic splines behind an opaque pointer.

use crate::border::{Error, Failure, Status, guarded};
use crate::strided::{apply_real, copied};
use mechaudit_solvers::cubic_spline::{
    Boundary, CubicSpline, CubicSplineError, End, EvaluationError, Extrapolation, Jet,
    UniformCubicSpline,
};
use std::ffi::c_int;

/// A cubic spline. Made by one of the `mechaudit_spline_fit` functions, never changed afterwards, so that
/// any number of threads may evaluate it at once; given back to `mechaudit_spline_free` once.
pub struct Spline(Kind);

enum Kind {
    Knots(CubicSpline),
    Uniform(UniformCubicSpline),
}

/// The condition at an end of a spline.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SplineEnd {
    /// The second derivative; 0 makes a natural spline.
    SecondDerivative = 0,
    /// The first derivative (clamped).
    FirstDerivative = 1,
    /// Nothing: the third derivative is continuous at the neighbouring knot.
    NotAKnot = 2,
}

/// The continuation of a spline outside its knots.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SplineOutside {
    /// No value there: `MECHAUDIT_STATUS_OUTSIDE`.
    Refuse = 0,
    /// The cubic of the first or last segment goes on.
    Polynomial = 1,
    /// The tangent at the end goes on.
    Tangent = 2,
    /// The ordinate of the end is held.
    Hold = 3,
    /// The spline repeats with the period from first to last knot.
    Repeat = 4,
}

impl From<CubicSplineError> for Failure {
    fn from(e: CubicSplineError) -> Failure {
        use CubicSplineError as E;
        let (status, index, value) = match &e {
            E::TooFewKnots { .. } | E::TooManyKnots { .. } | E::Length { .. } => {
                (Status::Size, 0, f64::NAN)
            }
            E::NotFinite { index, value, .. } => (Status::NotFinite, *index, *value),
            E::NotIncreasing { index, value, .. } => (Status::Order, *index, *value),
            E::Step { value } => (Status::Order, 0, *value),
            E::NotPeriodic { last, .. } => (Status::NotPeriodic, 0, *last),
            E::Overflow { knot } => (Status::Overflow, *knot, f64::NAN),
        };
        Failure::new(status, e.to_string())
            .at(index)
            .because_of(value)
    }
}

/// The failure at a point, the pieces before it having had `start` points.
fn evaluation(start: usize, e: EvaluationError) -> Failure {
    use EvaluationError as E;
    let mut e = e;
    match &mut e {
        E::NotFinite { index, .. } | E::Outside { index, .. } | E::NotSorted { index } => {
            *index += start;
        }
        E::Length { .. } => (),
    }
    let (status, index, value) = match e {
        E::NotFinite { index, x } => (Status::NotFinite, index, x),
        E::Outside { index, x, .. } => (Status::Outside, index, x),
        E::NotSorted { index } => (Status::Order, index, f64::NAN),
        E::Length { .. } => (Status::Internal, 0, f64::NAN),
    };
    Failure::new(status, e.to_string())
        .at(index)
        .because_of(value)
}

fn end(name: &str, kind: c_int, value: f64) -> Result<End, Failure> {
    match kind {
        0 => Ok(End::SecondDerivative(value)),
        1 => Ok(End::FirstDerivative(value)),
        2 => Ok(End::NotAKnot),
        other => {
            let text = format!("{name} {other} is none of mechaudit_spline_end");
            Err(Failure::new(Status::Argument, text))
        }
    }
}

fn extrapolation(kind: c_int) -> Result<Extrapolation, Failure> {
    match kind {
        0 => Ok(Extrapolation::Error),
        1 => Ok(Extrapolation::EndPolynomial),
        2 => Ok(Extrapolation::Linear),
        3 => Ok(Extrapolation::Clamp),
        4 => Ok(Extrapolation::Wrap),
        other => {
            let text = format!("outside {other} is none of mechaudit_spline_outside");
            Err(Failure::new(Status::Argument, text))
        }
    }
}

/// Makes a spline and hands it over.
///
/// # Safety
/// `spline` is NULL or can be written to, `error` likewise.
unsafe fn made(
    outside: c_int,
    spline: *mut *mut Spline,
    error: *mut Error,
    fit: impl FnOnce() -> Result<Kind, Failure>,
) -> Status {
    let run = || {
        if spline.is_null() {
            return Err(Failure::null("spline"));
        }
        // SAFETY: not NULL, so it can be written to.
        unsafe { spline.write(std::ptr::null_mut()) };
        let outside = extrapolation(outside)?;
        let made = match fit()? {
            Kind::Knots(s) => Kind::Knots(s.with_extrapolation(outside)),
            Kind::Uniform(s) => Kind::Uniform(s.with_extrapolation(outside)),
        };
        // SAFETY: as above; `mechaudit_spline_free` takes the box back.
        unsafe { spline.write(Box::into_raw(Box::new(Spline(made)))) };
        Ok(())
    };
    // SAFETY: NULL or writable, as promised.
    unsafe { guarded(error, run) }
}

/// Fits the interpolating cubic spline through n points `(x[k], y[k])`, x increasing. At each end the kind
/// is one of `mechaudit_spline_end` with its value (ignored for not-a-knot); `outside` is one of
/// `mechaudit_spline_outside`. Units: first derivatives y/x, second y/x^2. On success `*spline` has to be
/// given to `mechaudit_spline_free`; else it is NULL. The arrays are copied. Accuracy: `mechaudit audit
/// cubic-spline-second-derivatives`, `-clamped`, `-not-a-knot`.
///
/// Errors: `NULL_POINTER`, `SIZE` (n < 2), `ARGUMENT`, `NOT_FINITE`, `ORDER`, `OVERFLOW`, `MEMORY`.
///
/// # Safety
/// `x` and `y` have n doubles; `spline` can be written to, `error` is NULL or can be written to.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mechaudit_spline_fit(
    n: usize,
    x: *const f64,
    y: *const f64,
    first_kind: c_int,
    first_value: f64,
    last_kind: c_int,
    last_value: f64,
    outside: c_int,
    spline: *mut *mut Spline,
    error: *mut Error,
) -> Status {
    let fit = || {
        let first = end("first_kind", first_kind, first_value)?;
        let ends = Boundary::Ends(first, end("last_kind", last_kind, last_value)?);
        // SAFETY: the caller promises n numbers of each.
        let [x, y] = unsafe { [copied("x", x, n)?, copied("y", y, n)?] };
        Ok(Kind::Knots(CubicSpline::fit(x, y, ends)?))
    };
    // SAFETY: NULL or writable, as the caller promises.
    unsafe { made(outside, spline, error, fit) }
}

/// As `mechaudit_spline_fit`, periodic: `y[0] = y[n-1]`, first and second derivative agree at the ends.
/// Accuracy: `mechaudit audit cubic-spline-periodic`.
///
/// Errors: those, and `NOT_PERIODIC`.
///
/// # Safety
/// As `mechaudit_spline_fit`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mechaudit_spline_fit_periodic(
    n: usize,
    x: *const f64,
    y: *const f64,
    outside: c_int,
    spline: *mut *mut Spline,
    error: *mut Error,
) -> Status {
    let fit = || {
        // SAFETY: the caller promises n numbers of each.
        let [x, y] = unsafe { [copied("x", x, n)?, copied("y", y, n)?] };
        Ok(Kind::Knots(CubicSpline::fit(x, y, Boundary::Periodic)?))
    };
    // SAFETY: NULL or writable, as the caller promises.
    unsafe { made(outside, spline, error, fit) }
}

/// As `mechaudit_spline_fit` on the knots `origin + k step`, taken exactly; faster to fit and to evaluate.
/// Accuracy: `mechaudit audit cubic-spline-uniform`.
///
/// Errors: those; `SIZE` beyond 2^26 + 1 knots too, `ORDER` for a step that is not positive or too
/// small beside the knots.
///
/// # Safety
/// `y` has n doubles; `spline` can be written to, `error` is NULL or can be written to.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mechaudit_spline_fit_uniform(
    n: usize,
    origin: f64,
    step: f64,
    y: *const f64,
    first_kind: c_int,
    first_value: f64,
    last_kind: c_int,
    last_value: f64,
    outside: c_int,
    spline: *mut *mut Spline,
    error: *mut Error,
) -> Status {
    let fit = || {
        let first = end("first_kind", first_kind, first_value)?;
        let ends = Boundary::Ends(first, end("last_kind", last_kind, last_value)?);
        // SAFETY: the caller promises n numbers.
        let y = unsafe { copied("y", y, n)? };
        Ok(Kind::Uniform(UniformCubicSpline::fit(
            origin, step, y, ends,
        )?))
    };
    // SAFETY: NULL or writable, as the caller promises.
    unsafe { made(outside, spline, error, fit) }
}

/// Gives a spline back. NULL does nothing.
///
/// # Safety
/// `spline` is NULL or came from one of the fits and was not given back before.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mechaudit_spline_free(spline: *mut Spline) {
    if !spline.is_null() {
        // SAFETY: a box handed out by `made`, as the caller promises, and no longer used.
        drop(unsafe { Box::from_raw(spline) });
    }
}

/// The spline behind the pointer.
///
/// # Safety
/// `spline` is NULL or a spline that was not given back.
unsafe fn known<'a>(spline: *const Spline) -> Result<&'a Kind, Failure> {
    // SAFETY: as promised; nothing changes a spline.
    let spline = unsafe { spline.as_ref() };
    spline.map(|s| &s.0).ok_or_else(|| Failure::null("spline"))
}

/// The ordinate at x, to `*value`. The quickest way to many of them is `mechaudit_spline_values`.
///
/// Errors: `NULL_POINTER`, `NOT_FINITE`, `OUTSIDE`; nothing is written then. `error` may be NULL.
///
/// # Safety
/// `spline` is NULL or a spline that was not given back; `value` and `error` are NULL or can be written to.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mechaudit_spline_value(
    spline: *const Spline,
    x: f64,
    value: *mut f64,
    error: *mut Error,
) -> Status {
    let run = || {
        // SAFETY: as the caller promises.
        let found = match unsafe { known(spline) }? {
            Kind::Knots(s) => s.value(x),
            Kind::Uniform(s) => s.value(x),
        };
        let found = found.map_err(|e| evaluation(0, e))?;
        if value.is_null() {
            return Err(Failure::null("value"));
        }
        // SAFETY: not NULL, so it can be written to.
        unsafe { value.write(found) };
        Ok(())
    };
    // SAFETY: NULL or writable, as the caller promises.
    unsafe { guarded(error, run) }
}

/// The ordinate and the first three derivatives at x, to `jet[0]` ... `jet[3]`. At a knot the third
/// derivative is that to the right.
///
/// Errors: as `mechaudit_spline_value`.
///
/// # Safety
/// As `mechaudit_spline_value`; `jet` is NULL or has room for four doubles.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mechaudit_spline_jet(
    spline: *const Spline,
    x: f64,
    jet: *mut f64,
    error: *mut Error,
) -> Status {
    let run = || {
        // SAFETY: as the caller promises.
        let found = match unsafe { known(spline) }? {
            Kind::Knots(s) => s.jet(x),
            Kind::Uniform(s) => s.jet(x),
        };
        let found: Jet = found.map_err(|e| evaluation(0, e))?;
        if jet.is_null() {
            return Err(Failure::null("jet"));
        }
        let all = [found.value, found.first, found.second, found.third];
        // SAFETY: not NULL, so there is room for four doubles.
        unsafe { std::ptr::copy_nonoverlapping(all.as_ptr(), jet, 4) };
        Ok(())
    };
    // SAFETY: NULL or writable, as the caller promises.
    unsafe { guarded(error, run) }
}

/// The ordinates at n points `x[k*incx]`, to `y[k*incy]`: those of `mechaudit_spline_value`, bit for bit.
/// `y` may be `x` with the same stride; `incy` is not 0 for n > 1.
///
/// Errors: as there; `error` has the place of the first point refused. What `y` holds then is not specified.
///
/// # Safety
/// `spline` is NULL or a spline that was not given back; `x` and `y` have n doubles at these strides;
/// `error` is NULL or can be written to.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mechaudit_spline_values(
    spline: *const Spline,
    n: usize,
    x: *const f64,
    incx: isize,
    y: *mut f64,
    incy: isize,
    error: *mut Error,
) -> Status {
    let run = || {
        // SAFETY: as the caller promises.
        let kind = unsafe { known(spline) }?;
        let some = |start, x: &[f64], y: &mut [f64]| {
            let done = match kind {
                Kind::Knots(s) => s.values(x, y),
                Kind::Uniform(s) => s.values(x, y),
            };
            done.map_err(|e| evaluation(start, e))
        };
        // SAFETY: the caller promises n numbers of each array at these strides.
        unsafe { apply_real(n, (x, incx), (y, incy), some) }
    };
    // SAFETY: NULL or writable, as the caller promises.
    unsafe { guarded(error, run) }
}

/// The integral of the spline from a to b, to `*value`; b < a gives the negative of that from b to a.
///
/// Errors: as `mechaudit_spline_value`, index 0 for a, 1 for b.
///
/// # Safety
/// As `mechaudit_spline_value`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mechaudit_spline_integral(
    spline: *const Spline,
    a: f64,
    b: f64,
    value: *mut f64,
    error: *mut Error,
) -> Status {
    let run = || {
        // SAFETY: as the caller promises.
        let found = match unsafe { known(spline) }? {
            Kind::Knots(s) => s.integral(a, b),
            Kind::Uniform(s) => s.integral(a, b),
        };
        let found = found.map_err(|e| evaluation(0, e))?;
        if value.is_null() {
            return Err(Failure::null("value"));
        }
        // SAFETY: not NULL, so it can be written to.
        unsafe { value.write(found) };
        Ok(())
    };
    // SAFETY: NULL or writable, as the caller promises.
    unsafe { guarded(error, run) }
}
