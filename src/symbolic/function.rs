//! The functions of the language.

use rug::Rational;

/// Declares the functions once: variant, number of arguments, name, other names.
macro_rules! functions {
    ($($(#[doc = $doc:literal])* $function:ident/$arity:literal $name:literal $(| $alias:literal)*;)*) => {
        /// A function of one, two or three arguments.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum Func {
            $($(#[doc = $doc])* $function,)*
        }

        impl Func {
            /// All of them with their names in the text form.
            pub const ALL: &'static [(Func, &'static str)] = &[$((Func::$function, $name)),*];

            /// The name in the text form.
            pub fn name(self) -> &'static str {
                match self {
                    $(Func::$function => $name,)*
                }
            }

            /// The number of arguments.
            pub fn arity(self) -> usize {
                match self {
                    $(Func::$function => $arity,)*
                }
            }

            /// The function of a name or of an alias.
            pub fn named(name: &str) -> Option<Func> {
                match name {
                    $($name $(| $alias)* => Some(Func::$function),)*
                    _ => None,
                }
            }
        }
    };
}

functions! {
    /// `e^x`.
    Exp/1 "exp";
    /// Square root, the principal one of complex numbers.
    Sqrt/1 "sqrt";
    /// Sine.
    Sin/1 "sin";
    /// Cosine.
    Cos/1 "cos";
    /// `W(z) = e^{−z²}(1 + (2i/√π) ∫_0^z e^{s²} ds)`.
    W/1 "W" | "wofz";
    /// Real part.
    Re/1 "re";
    /// Imaginary part.
    Im/1 "im";
    /// Absolute value.
    Abs/1 "abs" | "fabs";
    /// Argument in (−π, π].
    Arg/1 "arg";
    /// Conjugate.
    Conj/1 "conj";
    /// Principal arc tangent.
    Arctan/1 "arctan" | "atan";
    /// `2^x`.
    Exp2/1 "exp2";
    /// `10^x`.
    Exp10/1 "exp10";
    /// `e^x − 1`.
    Expm1/1 "expm1";
    /// Natural logarithm, the principal one of complex numbers.
    Log/1 "log" | "ln";
    /// Logarithm to base 2.
    Log2/1 "log2";
    /// Logarithm to base 10.
    Log10/1 "log10";
    /// `log(1 + x)`.
    Log1p/1 "log1p";
    /// Cube root, odd on the real line.
    Cbrt/1 "cbrt";
    /// Tangent.
    Tan/1 "tan";
    /// Principal arc sine.
    Asin/1 "asin" | "arcsin";
    /// Principal arc cosine.
    Acos/1 "acos" | "arccos";
    /// Hyperbolic sine.
    Sinh/1 "sinh";
    /// Hyperbolic cosine.
    Cosh/1 "cosh";
    /// Hyperbolic tangent.
    Tanh/1 "tanh";
    /// Inverse hyperbolic sine.
    Asinh/1 "asinh" | "arsinh";
    /// Inverse hyperbolic cosine, not negative.
    Acosh/1 "acosh" | "arcosh";
    /// Inverse hyperbolic tangent.
    Atanh/1 "atanh" | "artanh";
    /// Error function.
    Erf/1 "erf";
    /// `1 − erf(x)`.
    Erfc/1 "erfc";
    /// `e^{x²} erfc(x)`.
    Erfcx/1 "erfcx";
    /// `−i erf(ix)`.
    Erfi/1 "erfi";
    /// Dawson's integral `e^{−x²} ∫_0^x e^{t²} dt`.
    Dawson/1 "dawson" | "dawsn";
    /// Gamma function.
    Tgamma/1 "tgamma" | "gamma";
    /// `log |Γ(x)|` of real numbers; off the axis the logarithm that is real for x > 0.
    Lgamma/1 "lgamma";
    /// `Γ′(x)/Γ(x)`.
    Digamma/1 "digamma";
    /// Airy function Ai.
    AiryAi/1 "airyai";
    /// `Ai′(x)`.
    AiryAiPrime/1 "airyaiprime";
    /// Airy function Bi.
    AiryBi/1 "airybi";
    /// `Bi′(x)`.
    AiryBiPrime/1 "airybiprime";
    /// Sine integral `∫_0^x sin(t)/t dt`.
    SinInt/1 "sinint";
    /// Cosine integral `−∫_x^∞ cos(t)/t dt`.
    CosInt/1 "cosint";
    /// Exponential integral Ei, a principal value.
    Ei/1 "expi";
    /// Exponential integral `E₁(x) = ∫_x^∞ e^{−t}/t dt`.
    ExpInt/1 "expint";
    /// Lambert's function W₀, the inverse of `w e^w` for w ≥ −1.
    LambertW/1 "lambertw";
    /// Lambert's function W₋₁, the inverse of `w e^w` for w ≤ −1.
    LambertWm1/1 "lambertwm1";
    /// Riemann's zeta function.
    Zeta/1 "riemannzeta";
    /// Its n-th derivative: `zetaderivative(n, s)`.
    ZetaDerivative/2 "zetaderivative";
    /// Bessel function of the first kind: `besselj(ν, x)`.
    BesselJ/2 "besselj";
    /// Modified Bessel function of the first kind: `besseli(ν, x)`.
    BesselI/2 "besseli";
    /// `e^{−x} I_ν(x)`.
    BesselIe/2 "besselie";
    /// Weierstrass's function ℘(z) with the periods 1 and τ: `weierp(z, τ)`.
    WeierstrassP/2 "weierp";
    /// `℘′(z)`.
    WeierstrassPPrime/2 "weierpprime";
    /// Largest integer not above x.
    Floor/1 "floor";
    /// Smallest integer not below x.
    Ceil/1 "ceil";
    /// Nearest integer, halves away from zero.
    Round/1 "round";
    /// Integer part.
    Trunc/1 "trunc";
    /// Nearest integer, halves to even.
    Nearbyint/1 "nearbyint" | "rint";
    /// `x^y` of real numbers; of complex ones `e^{y log x}`.
    Pow/2 "pow";
    /// `atan2(y, x)`: the angle of the point (x, y) in (−π, π].
    Atan2/2 "atan2";
    /// `√(x² + y²)`.
    Hypot/2 "hypot";
    /// The smaller of two numbers.
    Fmin/2 "fmin" | "min";
    /// The larger of two numbers.
    Fmax/2 "fmax" | "max";
    /// `max(x − y, 0)`.
    Fdim/2 "fdim";
    /// Remainder of x/y with the sign of x.
    Fmod/2 "fmod";
    /// `x − n y` with n the integer nearest to x/y, halves to even.
    Remainder/2 "remainder";
    /// The magnitude of x with the sign of y.
    Copysign/2 "copysign";
    /// `x y + z`, rounded once in floating point.
    Fma/3 "fma";
    /// Voigt profile of x, σ and γ, whose integral over x is 1.
    Voigt/3 "voigt" | "voigt_profile";
}

impl Func {
    /// Returns true if the values at rational numbers are rational.
    pub(crate) fn is_rational(self) -> bool {
        use Func::*;
        matches!(
            self,
            Abs | Floor
                | Ceil
                | Trunc
                | Round
                | Nearbyint
                | Fmin
                | Fmax
                | Fdim
                | Fmod
                | Remainder
                | Copysign
                | Fma
        )
    }

    /// The value at rational numbers where it is rational; none where it is undefined.
    pub(crate) fn at_rationals(self, x: &[Rational]) -> Option<Rational> {
        let remainder = |x: &Rational, y: &Rational, whole: Func| {
            let quotient = (*y != 0).then(|| Rational::from(x / y))?;
            Some(x - whole.at_rationals(&[quotient])? * y)
        };
        Some(match (self, x) {
            (Func::Abs, [x]) => x.abs_ref().into(),
            (Func::Floor, [x]) => x.floor_ref().into(),
            (Func::Ceil, [x]) => x.ceil_ref().into(),
            (Func::Trunc, [x]) => x.trunc_ref().into(),
            // Halves away from zero.
            (Func::Round, [x]) => x.round_ref().into(),
            (Func::Nearbyint, [x]) => {
                let half = Rational::from(x * 2u32);
                let is_tie = half.is_integer() && !x.is_integer();
                match is_tie {
                    // The even one of two neighbours is twice the nearest integer to half of x.
                    true => Rational::from(x / 2u32).round() * 2u32,
                    false => x.round_ref().into(),
                }
            }
            (Func::Fmin, [x, y]) => x.min(y).clone(),
            (Func::Fmax, [x, y]) => x.max(y).clone(),
            (Func::Fdim, [x, y]) => Rational::from(x - y).max(Rational::new()),
            (Func::Fmod, [x, y]) => remainder(x, y, Func::Trunc)?,
            (Func::Remainder, [x, y]) => remainder(x, y, Func::Nearbyint)?,
            (Func::Copysign, [x, y]) => match *y < 0 {
                true => -Rational::from(x.abs_ref()),
                false => x.abs_ref().into(),
            },
            (Func::Fma, [x, y, z]) => Rational::from(x * y) + z,
            _ => return None,
        })
    }
}
