//! Small arrays by index. `array::map` is compiled as a function of its own, without the
//! instructions of the code that calls it.

/// `[f(0), f(1)]`
#[inline(always)]
pub(super) fn two<T>(f: impl Fn(usize) -> T) -> [T; 2] {
    [f(0), f(1)]
}

/// `[f(0), f(1), f(2)]`
#[inline(always)]
pub(super) fn three<T>(f: impl Fn(usize) -> T) -> [T; 3] {
    [f(0), f(1), f(2)]
}
