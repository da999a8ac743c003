//! The results of functions that can fail.

use std::any::Any;
use std::ffi::{c_char, c_int};
use std::panic::{AssertUnwindSafe, catch_unwind};

/// The status that a function returns if it can fail.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// Done.
    Ok = 0,
    /// A pointer that is needed is NULL.
    NullPointer = 1,
    /// A number of elements or a stride beyond what memory can hold, fewer elements than the method needs, or
    /// a stride of 0 between elements that are written.
    Size = 2,
    /// A code that names none of the choices.
    Argument = 3,
    /// A number that has to be finite is not.
    NotFinite = 4,
    /// Knots that do not increase, a step that is not positive, points that are not sorted.
    Order = 5,
    /// The ends of a periodic spline differ.
    NotPeriodic = 6,
    /// A point outside the knots of a spline that is not to be continued.
    Outside = 7,
    /// A pivot of the elimination is zero, subnormal or overflows.
    Pivot = 8,
    /// The result does not fit in a double.
    Overflow = 9,
    /// No memory for a copy of the input.
    Memory = 10,
    /// A defect of this library; please report it. Builds that abort on one never return it.
    Internal = 11,
}

/// Characters of a message, its final zero included.
pub const MESSAGE: usize = 160;

/// Why a function failed, for a reader and for a program.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct Error {
    /// The status returned.
    pub status: Status,
    /// The place in the array that the message is about, counted from 0; 0 where it is about none.
    pub index: usize,
    /// The number that was refused; NaN where the message is about none.
    pub value: f64,
    /// The value and the rule, UTF-8 with a final zero; empty after success.
    pub message: [c_char; MESSAGE],
}

/// Why a call fails, before it crosses the border.
#[derive(Debug)]
pub(crate) struct Failure {
    pub status: Status,
    pub index: usize,
    pub value: f64,
    pub message: String,
}

impl Failure {
    pub fn new(status: Status, message: impl Into<String>) -> Failure {
        Failure {
            status,
            index: 0,
            value: f64::NAN,
            message: message.into(),
        }
    }
    pub fn at(self, index: usize) -> Failure {
        Failure { index, ..self }
    }
    pub fn because_of(self, value: f64) -> Failure {
        Failure { value, ..self }
    }
    pub fn null(name: &str) -> Failure {
        Failure::new(Status::NullPointer, format!("{name} is NULL"))
    }
}

/// A message as C holds it; cut between characters where it is too long.
fn message(text: &str) -> [c_char; MESSAGE] {
    let mut end = text.len().min(MESSAGE - 1);
    while !text.is_char_boundary(end) {
        end -= 1;
    }
    let mut out = [0; MESSAGE];
    for (to, from) in out.iter_mut().zip(&text.as_bytes()[..end]) {
        *to = *from as c_char;
    }
    out
}

fn internal(panic: Box<dyn Any + Send>) -> Failure {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    let text = text.or_else(|| panic.downcast_ref::<&str>().copied());
    let failure = Failure::new(Status::Internal, text.unwrap_or("panic"));
    // Its destructor might panic again, beyond this guard.
    std::mem::forget(panic);
    failure
}

/// Runs what can fail, and tells what happened in both ways.
///
/// # Safety
/// `error` is NULL or can be written to.
pub(crate) unsafe fn guarded(
    error: *mut Error,
    run: impl FnOnce() -> Result<(), Failure>,
) -> Status {
    let outcome = catch_unwind(AssertUnwindSafe(run)).unwrap_or_else(|panic| Err(internal(panic)));
    let failure = outcome
        .err()
        .unwrap_or_else(|| Failure::new(Status::Ok, ""));
    if !error.is_null() {
        let told = Error {
            status: failure.status,
            index: failure.index,
            value: failure.value,
            message: message(&failure.message),
        };
        // SAFETY: not NULL, so the caller promises room for one.
        unsafe { error.write(told) };
    }
    failure.status
}

/// Returns the meaning of the status, a constant string; that of `INTERNAL` for any other number.
#[unsafe(no_mangle)]
pub extern "C" fn mechaudit_status_message(status: c_int) -> *const c_char {
    let text = match status {
        0 => c"done",
        1 => c"a pointer that is needed is NULL",
        2 => c"too many or too few elements",
        3 => c"a code that names none of the choices",
        4 => c"a number that has to be finite is not",
        5 => c"not in increasing order",
        6 => c"the ends of a periodic spline differ",
        7 => c"a point outside the knots",
        8 => c"a pivot is zero, subnormal or overflows",
        9 => c"the result does not fit in a double",
        10 => c"no memory for a copy of the input",
        _ => c"a defect of this library",
    };
    text.as_ptr()
}

/// The version of the library, `"MAJOR.MINOR.PATCH"`, a constant string.
#[unsafe(no_mangle)]
pub extern "C" fn mechaudit_version() -> *const c_char {
    const TEXT: &str = concat!(env!("CARGO_PKG_VERSION"), "\0");
    TEXT.as_ptr().cast()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::ffi::CStr;

    /// An error to be written over.
    fn unwritten() -> Error {
        Error {
            status: Status::Ok,
            index: 7,
            value: 7.0,
            message: [1; MESSAGE],
        }
    }

    fn text(error: &Error) -> &str {
        // SAFETY: `message` ends with a zero.
        let text = unsafe { CStr::from_ptr(error.message.as_ptr()) };
        text.to_str().expect("UTF-8")
    }

    #[test]
    fn a_panic_becomes_a_status() {
        let hook = std::panic::take_hook();
        std::panic::set_hook(Box::new(|_| ()));
        let mut error = unwritten();
        // SAFETY: `error` can be written to; NULL is allowed.
        let status = unsafe { guarded(&mut error, || panic!("planted {}", 1)) };
        assert_eq!((status, error.status), (Status::Internal, Status::Internal));
        assert_eq!(text(&error), "planted 1");
        // SAFETY: as above.
        let status = unsafe { guarded(std::ptr::null_mut(), || panic!("planted")) };
        assert_eq!(status, Status::Internal);
        std::panic::set_hook(hook);
    }

    #[test]
    fn messages_are_cut_between_characters() {
        for length in 150..170 {
            let long = "é".repeat(length);
            let mut error = unwritten();
            // SAFETY: `error` can be written to.
            unsafe { guarded(&mut error, || Err(Failure::new(Status::Size, long.clone()))) };
            assert_eq!(text(&error), "é".repeat(79));
        }
        let mut error = unwritten();
        // SAFETY: `error` can be written to.
        unsafe { guarded(&mut error, || Ok(())) };
        assert_eq!(text(&error), "");
        assert!(error.value.is_nan() && error.index == 0);
    }

    #[test]
    fn every_status_has_a_message_of_its_own() {
        let of = |k: c_int| {
            // SAFETY: a constant string.
            unsafe { CStr::from_ptr(mechaudit_status_message(k)) }
        };
        let all: std::collections::HashSet<_> = (0..=Status::Internal as c_int).map(of).collect();
        assert_eq!(all.len(), 12);
        assert_eq!(of(-1), of(Status::Internal as c_int));
    }
}
