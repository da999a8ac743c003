//! An estimate of the work that a value takes, by which it is bounded.
//!
//! The clock would do, but the same value has to have the same answer on every machine.

use super::Goal;
use crate::Func;
use crate::graph::Node;

/// Reason of a value that takes more work than is allowed.
pub(super) const REASON: &str = "the limit on the work for one value";

/// Units, some nanoseconds each, for a value of few digits. Sums of plain functions take some ten
/// seconds; the nodes of integrals cost more than is counted.
const ALL: u64 = 10_000_000_000;

/// Bits of a goal from which on more is allowed.
const FEW_BITS: u64 = 256;

/// The work allowed for one value.
pub(super) fn allowed(goal: Goal) -> u64 {
    let bits = match goal {
        Goal::Nearest => FEW_BITS,
        Goal::Bits(bits) | Goal::Double(bits) => u64::from(bits).max(FEW_BITS),
    };
    ALL.saturating_mul(bits * bits) / (FEW_BITS * FEW_BITS)
}

/// The work of one operation at a precision.
pub(super) fn of(node: Node, prec: u32) -> u64 {
    use Func::*;
    let words = u64::from(prec / 64) + 1;
    let square = words * words;
    let arithmetic = 200 + square / 4;
    let function = match node {
        Node::Unary(f, _) | Node::Binary(f, ..) | Node::Ternary(f, ..) => f,
        _ => return arithmetic,
    };
    match function {
        Re | Im | Abs | Conj | Floor | Ceil | Round | Trunc | Nearbyint | Fmin | Fmax | Fdim
        | Fmod | Remainder | Copysign | Fma | Sqrt | Hypot => arithmetic,
        Exp | Exp2 | Exp10 | Expm1 | Log | Log2 | Log10 | Log1p | Cbrt | Sin | Cos | Tan | Asin
        | Acos | Arctan | Atan2 | Arg | Sinh | Cosh | Tanh | Asinh | Acosh | Atanh | Pow => {
            3_000 + 20 * square
        }
        Erf | Erfc | Erfcx | Erfi | Dawson | W | Voigt | Tgamma | Lgamma | Digamma | AiryAi
        | AiryAiPrime | AiryBi | AiryBiPrime | SinInt | CosInt | Ei | ExpInt | LambertW
        | LambertWm1 | BesselJ | BesselI | BesselIe => {
            30_000 + 2_000 * square + 20 * square * words
        }
        // Sums whose terms grow in number and in length.
        Zeta | ZetaDerivative | WeierstrassP | WeierstrassPPrime => {
            200_000 + 5_000 * square + 1_000 * square * words
        }
    }
}
