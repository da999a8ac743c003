//! Stands in for functions of complex balls.
use mechaudit_reference::elementary::{ComplexEvaluated, NoValue};
use mechaudit_reference::{ComplexBall, faddeeva};
const NO: NoValue = NoValue::Undecided("a complex function");
pub fn div(a: &ComplexBall, b: &ComplexBall, _: u32) -> ComplexEvaluated {
    let q = a.div(b);
    if q.is_finite() { Ok(q) } else { Err(NO) }
}
pub fn exp(a: &ComplexBall, _: u32) -> ComplexEvaluated {
    let q = a.exp();
    if q.is_finite() { Ok(q) } else { Err(NO) }
}
pub fn w(a: &ComplexBall, p: u32) -> ComplexEvaluated {
    let q = faddeeva::w_ball(a, p);
    if q.is_finite() { Ok(q) } else { Err(NO) }
}
pub fn sqrt(a: &ComplexBall, _: u32) -> ComplexEvaluated {
    crate::complex::sqrt(a).map_err(|_| NO)
}
pub fn sin(a: &ComplexBall, _: u32) -> ComplexEvaluated {
    Ok(crate::complex::sine_and_cosine(crate::Func::Sin, a))
}
pub fn cos(a: &ComplexBall, _: u32) -> ComplexEvaluated {
    Ok(crate::complex::sine_and_cosine(crate::Func::Cos, a))
}
macro_rules! none { ($($f:ident)*) => { $(pub fn $f(_: &ComplexBall, _: u32) -> ComplexEvaluated { Err(NO) })* } }
none!(expm1 log log1p cbrt tan asin acos atan sinh cosh tanh asinh acosh atanh erf erfc erfcx erfi dawson tgamma lgamma);
pub fn pow(_: &ComplexBall, _: &ComplexBall, _: u32) -> ComplexEvaluated {
    Err(NO)
}
