//! Accuracy of the platform's elementary functions.

use super::{ProgramError, Setting, refused};
use mechaudit_symbolic::Func;
use mechaudit_symbolic::evaluation::Elementary;

/// The error of a function in units in the last place of its exact value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Accuracy {
    /// The largest error.
    pub ulps: f64,
    /// Who states it.
    pub source: &'static str,
}

/// Rounded to nearest.
const CORRECT: Accuracy = Accuracy {
    ulps: 0.5,
    source: "rounded correctly (MPFR)",
};

const TESTED: &str = "GNU C library, sysdeps/x86_64/fpu/libm-test-ulps";
const STATED: &str = "GNU C library, comments on the worst case in sysdeps/ieee754/dbl-64";

/// The error that the authors of the GNU C library state for binary64, rounded up: `e_exp.c` and
/// `e_exp2.c` less than `0.5 + 1.11/128 + 0.25/128` and a polynomial's error far below, `e_log.c`
/// `0.5 + 4.13/128 + 0.002` at most, `e_pow.c` 0.54, `s_sin.c` 0.55, `s_atan.c` 0.56.
fn stated(f: Func) -> Option<f64> {
    match f {
        Func::Exp | Func::Exp2 => Some(0.52),
        Func::Log | Func::Pow | Func::Sin | Func::Cos => Some(0.55),
        Func::Arctan => Some(0.56),
        _ => None,
    }
}

/// The units by which results of the GNU C library differ from the correctly rounded ones in its
/// own tests on x86-64, binary64 and binary32. Half a unit more is the distance from the exact
/// value.
fn tested(f: Func) -> Option<[u8; 2]> {
    Some(match f {
        Func::Exp | Func::Exp2 | Func::Log | Func::Sin | Func::Cos | Func::Pow => [1, 1],
        Func::Expm1 | Func::Log1p | Func::Asin | Func::Acos | Func::Arctan | Func::Hypot => [1, 1],
        Func::Tan => [1, 1],
        Func::Atan2 | Func::Log2 | Func::Log10 | Func::Sinh | Func::Cosh | Func::Tanh => [2, 2],
        Func::Cbrt => [4, 1],
        _ => return None,
    })
}

/// Returns the accuracy of a function.
///
/// The platform's accuracy is what its authors state, or the largest error of their tests: not a
/// theorem. Functions that the platform takes from the crate `libm` have no statement.
///
/// # Errors
/// A function without a stated accuracy, or without known derivatives.
pub(super) fn accuracy(f: Func, setting: Setting) -> Result<Accuracy, ProgramError> {
    let is_known = tested(f).is_some()
        || matches!(
            f,
            Func::Exp10 | Func::Asinh | Func::Acosh | Func::Atanh | Func::Erf | Func::Erfc
        );
    if !is_known {
        return refused(format!(
            "the derivatives of {} are not known here",
            f.name()
        ));
    }
    if setting.elementary == Elementary::Correct {
        return Ok(CORRECT);
    }
    let is_single = setting.is_single();
    match (stated(f).filter(|_| !is_single), tested(f)) {
        (Some(ulps), _) => Ok(Accuracy {
            ulps,
            source: STATED,
        }),
        (None, Some(units)) => Ok(Accuracy {
            ulps: 0.5 + f64::from(units[usize::from(is_single)]),
            source: TESTED,
        }),
        (None, None) => refused(format!(
            "nobody states the accuracy of the platform's {}: take correctly rounded functions",
            f.name()
        )),
    }
}
