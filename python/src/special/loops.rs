//! The loops that NumPy calls, without the GIL.

use super::float_status::FloatStatus;
use super::functions::Function;
use super::stored::Stored;
use mechaudit::solvers::faddeeva as solver;
use numpy::npyffi::npy_intp;
use std::ffi::{c_char, c_void};
use std::mem::MaybeUninit;
use std::ptr::{read, write};
use std::slice::{from_raw_parts, from_raw_parts_mut};

/// Points gathered at a time where an array cannot be handed over as it is: enough for the batches
/// to sort them well.
const BLOCK: usize = 2048;
/// The same for the Voigt profile, whose points are not sorted.
const WIDTHS: usize = 256;
/// Up to here points are computed one by one.
const FEW: usize = 4;

/// A column of numbers as NumPy describes it.
struct Column<S> {
    start: *mut S,
    /// In bytes.
    step: isize,
}

impl<S: Stored> Column<S> {
    /// # Safety
    /// Both arrays have more than `i` entries.
    unsafe fn new(args: *mut *mut c_char, steps: *mut npy_intp, i: usize) -> Column<S> {
        // SAFETY: the caller's promise.
        let (start, step) = unsafe { (read(args.add(i)), read(steps.add(i))) };
        Column {
            start: start.cast(),
            step,
        }
    }

    /// # Safety
    /// The column has more than `i` numbers, aligned.
    unsafe fn at(&self, i: usize) -> *mut S {
        // SAFETY: the caller's promise; NumPy's strides lead from one number to the next.
        unsafe { self.start.byte_offset(i as isize * self.step) }
    }

    /// Where the numbers begin if they lie side by side and need no conversion.
    fn contiguous(&self) -> Option<*mut S::Wide> {
        match self.step == size_of::<S>() as isize {
            true => S::as_wide(self.start),
            false => None,
        }
    }
}

/// Returns true if two runs of `bytes` bytes share one.
fn overlap(a: *const c_void, b: *const c_void, bytes: usize) -> bool {
    (a as usize).abs_diff(b as usize) < bytes
}

/// `F` of one column.
///
/// # Safety
/// To be called by NumPy, for a ufunc with one input and one output of type `S`: `args`, `dims`,
/// and `steps` are those of a ufunc's loop, and the numbers are aligned (NumPy copies those that
/// are not). Input and output may be the same memory, number by number; it copies where they
/// overlap otherwise.
pub unsafe extern "C" fn unary<F, S>(
    args: *mut *mut c_char,
    dims: *mut npy_intp,
    steps: *mut npy_intp,
    _: *mut c_void,
) where
    S: Stored,
    F: Function<S::Wide>,
{
    let _status = FloatStatus::keep();
    // SAFETY: NumPy passes one dimension, two pointers and two strides.
    let (n, x, y) = unsafe {
        let n = read(dims).max(0) as usize;
        let [x, y] = [0, 1].map(|i| Column::<S>::new(args, steps, i));
        (n, x, y)
    };
    if n <= FEW {
        for i in 0..n {
            // SAFETY: both columns have n numbers.
            unsafe { write(y.at(i), S::round(F::one(read(x.at(i)).widen()))) };
        }
        return;
    }
    if let (Some(from), Some(to)) = (x.contiguous(), y.contiguous())
        && !overlap(from.cast(), to.cast(), n * size_of::<S>())
    {
        // SAFETY: n numbers lie side by side at each pointer; the runs are disjoint, and nobody
        // else writes to them while NumPy's loop runs (what other threads do to the same arrays is
        // theirs to guard, as for any ufunc).
        unsafe { F::many(from_raw_parts(from, n), from_raw_parts_mut(to, n)) };
        return;
    }
    let mut gathered = [const { MaybeUninit::<S::Wide>::uninit() }; BLOCK];
    let mut values = [const { MaybeUninit::<S::Wide>::uninit() }; BLOCK];
    for start in (0..n).step_by(BLOCK) {
        let count = BLOCK.min(n - start);
        for i in 0..count {
            // SAFETY: both columns have n numbers.
            gathered[i].write(unsafe { read(x.at(start + i)) }.widen());
            values[i].write(S::Wide::default());
        }
        // SAFETY: the first `count` of both blocks were just written.
        let (from, to) = unsafe {
            (
                from_raw_parts(gathered.as_ptr().cast::<S::Wide>(), count),
                from_raw_parts_mut(values.as_mut_ptr().cast::<S::Wide>(), count),
            )
        };
        F::many(from, to);
        for (i, value) in to.iter().enumerate() {
            // SAFETY: as above.
            unsafe { write(y.at(start + i), S::round(*value)) };
        }
    }
}

/// The Voigt profile of three columns: x, σ, γ.
///
/// # Safety
/// As [`unary`], with three inputs.
pub unsafe extern "C" fn voigt<S: Stored<Wide = f64>>(
    args: *mut *mut c_char,
    dims: *mut npy_intp,
    steps: *mut npy_intp,
    _: *mut c_void,
) {
    let _status = FloatStatus::keep();
    // SAFETY: NumPy passes one dimension, four pointers and four strides.
    let (n, [x, sigma, gamma, y]) = unsafe {
        let columns = [0, 1, 2, 3].map(|i| Column::<S>::new(args, steps, i));
        (read(dims).max(0) as usize, columns)
    };
    if n > FEW
        && sigma.step == 0
        && gamma.step == 0
        && let (Some(from), Some(to)) = (x.contiguous(), y.contiguous())
        && !overlap(from.cast(), to.cast(), n * size_of::<S>())
    {
        // SAFETY: as in `unary`; σ and γ are one number each, read before anything is written.
        let done = unsafe {
            let (sigma, gamma) = (read(sigma.at(0)).widen(), read(gamma.at(0)).widen());
            solver::voigt_batch(
                from_raw_parts(from, n),
                sigma,
                gamma,
                from_raw_parts_mut(to, n),
            )
        };
        debug_assert!(done.is_ok());
        return;
    }
    if n <= FEW {
        for i in 0..n {
            // SAFETY: all columns have n numbers.
            unsafe {
                let [x, sigma, gamma] = [&x, &sigma, &gamma].map(|c| read(c.at(i)).widen());
                write(y.at(i), S::round(solver::voigt(x, sigma, gamma)));
            }
        }
        return;
    }
    let mut gathered = [[0.0; WIDTHS]; 3];
    let mut values = [0.0; WIDTHS];
    for start in (0..n).step_by(WIDTHS) {
        let count = WIDTHS.min(n - start);
        for (column, gathered) in [&x, &sigma, &gamma].into_iter().zip(&mut gathered) {
            for (i, number) in gathered[..count].iter_mut().enumerate() {
                // SAFETY: all columns have n numbers.
                *number = unsafe { read(column.at(start + i)) }.widen();
            }
        }
        let [x, sigma, gamma] = gathered.each_ref().map(|c| &c[..count]);
        let done = solver::voigt_each(x, sigma, gamma, &mut values[..count]);
        debug_assert!(done.is_ok());
        for (i, value) in values[..count].iter().enumerate() {
            // SAFETY: as above.
            unsafe { write(y.at(start + i), S::round(*value)) };
        }
    }
}
