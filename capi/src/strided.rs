//! The caller's arrays: n numbers, each a stride from the one before.

use crate::border::{Failure, Status};
use num_complex::Complex64;
use std::ops::Range;

/// Points taken over at a time: enough for sorting by formula to pay, 32 kB on the stack.
const CHUNK: usize = 1024;

/// Where n numbers lie: from `first` on, `stride` doubles apart.
#[derive(Clone, Copy)]
pub(crate) struct Numbers<P> {
    first: P,
    stride: isize,
}

/// An array that is read.
pub(crate) type Input = Numbers<*const f64>;
/// An array that is written to.
pub(crate) type Output = Numbers<*mut f64>;

/// The addresses of n numbers, one byte after another; an error if n is too large.
fn addresses(name: &str, first: usize, stride: isize, n: usize) -> Result<Range<usize>, Failure> {
    if first == 0 {
        return Err(Failure::null(name));
    }
    let last = isize::try_from(n - 1).ok().and_then(|k| {
        let bytes = k.checked_mul(stride)?.checked_mul(8)?;
        first.checked_add_signed(bytes)
    });
    let end = |address: usize| address.checked_add(8);
    match last.map(|last| (first.min(last), end(first.max(last)))) {
        // No object is larger than half of the address space.
        Some((low, Some(high))) if high - low <= isize::MAX as usize => Ok(low..high),
        _ => Err(Failure::new(
            Status::Size,
            format!("{name}: {n} elements {stride} doubles apart do not fit in memory"),
        )),
    }
}

fn overlap(a: &Range<usize>, b: &Range<usize>) -> bool {
    a.start < b.end && b.start < a.end
}

impl Input {
    /// `n > 0` numbers and the addresses they take.
    pub fn new(
        name: &str,
        first: *const f64,
        stride: isize,
        n: usize,
    ) -> Result<(Input, Range<usize>), Failure> {
        let range = addresses(name, first.addr(), stride, n)?;
        Ok((Input { first, stride }, range))
    }

    /// # Safety
    /// The k-th number can be read.
    unsafe fn read(self, k: usize) -> f64 {
        // SAFETY: as promised; the offset was checked in `new`.
        unsafe { self.first.offset(k as isize * self.stride).read() }
    }
}

impl Output {
    /// `n > 0` places and the addresses they take.
    pub fn new(
        name: &str,
        first: *mut f64,
        stride: isize,
        n: usize,
    ) -> Result<(Output, Range<usize>), Failure> {
        let range = addresses(name, first.addr(), stride, n)?;
        if stride == 0 && n > 1 {
            // All but the last value would be lost.
            let text = format!("{name}: a stride of 0 leaves one place for {n} values");
            return Err(Failure::new(Status::Size, text));
        }
        Ok((Output { first, stride }, range))
    }

    /// # Safety
    /// The k-th number can be written.
    unsafe fn write(self, k: usize, x: f64) {
        // SAFETY: as promised; the offset was checked in `new`.
        unsafe { self.first.offset(k as isize * self.stride).write(x) }
    }
}

/// A complex array that is read and one that is written to.
pub(crate) struct Complexes {
    n: usize,
    re: (Input, Input),
    out: (Output, Output),
    /// No output lies where input does.
    apart: bool,
}

impl Complexes {
    /// Real and imaginary parts in arrays of their own; `None` if there are none.
    pub fn split(
        n: usize,
        [x, y]: [(*const f64, isize); 2],
        [u, v]: [(*mut f64, isize); 2],
    ) -> Result<Option<Complexes>, Failure> {
        if n == 0 {
            return Ok(None);
        }
        let (x, at_x) = Input::new("x", x.0, x.1, n)?;
        let (y, at_y) = Input::new("y", y.0, y.1, n)?;
        let (u, at_u) = Output::new("re", u.0, u.1, n)?;
        let (v, at_v) = Output::new("im", v.0, v.1, n)?;
        let apart = ![&at_x, &at_y]
            .iter()
            .any(|a| overlap(a, &at_u) || overlap(a, &at_v))
            && !overlap(&at_u, &at_v);
        Ok(Some(Complexes {
            n,
            re: (x, y),
            out: (u, v),
            apart,
        }))
    }

    /// Complex numbers; strides count those.
    pub fn interleaved(
        n: usize,
        z: (*const f64, isize),
        w: (*mut f64, isize),
    ) -> Result<Option<Complexes>, Failure> {
        if n == 0 {
            return Ok(None);
        }
        let doubled = |name: &str, stride: isize| {
            stride.checked_mul(2).ok_or_else(|| {
                Failure::new(
                    Status::Size,
                    format!("{name}: the stride {stride} does not fit"),
                )
            })
        };
        let (sz, sw) = (doubled("z", z.1)?, doubled("w", w.1)?);
        let (re, at_re) = Input::new("z", z.0, sz, n)?;
        let (im, at_im) = Input::new("z", z.0.wrapping_add(1), sz, n)?;
        let (u, at_u) = Output::new("w", w.0, sw, n)?;
        let (v, at_v) = Output::new("w", w.0.wrapping_add(1), sw, n)?;
        let hull = |a: Range<usize>, b: Range<usize>| a.start.min(b.start)..a.end.max(b.end);
        let apart = !overlap(&hull(at_re, at_im), &hull(at_u, at_v));
        Ok(Some(Complexes {
            n,
            re: (re, im),
            out: (u, v),
            apart,
        }))
    }

    /// Both arrays as slices of complex numbers, where they are that and lie apart.
    ///
    /// # Safety
    /// All input can be read and all output written; nothing else does either meanwhile.
    unsafe fn slices<'a>(&self) -> Option<(&'a [Complex64], &'a mut [Complex64])> {
        let ((x, y), (u, v)) = (self.re, self.out);
        let dense = [x.stride, y.stride, u.stride, v.stride] == [2; 4];
        let pairs = y.first == x.first.wrapping_add(1) && v.first == u.first.wrapping_add(1);
        (self.apart && dense && pairs).then(|| {
            // SAFETY: n pairs of doubles one after another, readable and apart from the output,
            // aligned for doubles and so for `Complex64`, which is `repr(C)`.
            let z = unsafe { std::slice::from_raw_parts(x.first.cast(), self.n) };
            // SAFETY: n pairs one after another, writable. A double has no invalid bits; whether
            // the caller ever wrote there is not known, but the solver only writes.
            let w = unsafe { std::slice::from_raw_parts_mut(u.first.cast(), self.n) };
            (z, w)
        })
    }

    /// Puts `f` of all numbers into their places.
    ///
    /// # Safety
    /// All input can be read and all output written; nothing else does either meanwhile.
    pub unsafe fn apply(self, f: impl Fn(&[Complex64], &mut [Complex64])) {
        // SAFETY: as promised.
        if let Some((z, w)) = unsafe { self.slices() } {
            return f(z, w);
        }
        let mut z = [Complex64::ZERO; CHUNK];
        let mut w = [Complex64::ZERO; CHUNK];
        let mut start = 0;
        while start < self.n {
            let m = CHUNK.min(self.n - start);
            for (k, z) in z[..m].iter_mut().enumerate() {
                let k = start + k;
                // SAFETY: `k < n`.
                *z = unsafe { Complex64::new(self.re.0.read(k), self.re.1.read(k)) };
            }
            f(&z[..m], &mut w[..m]);
            for (k, w) in w[..m].iter().enumerate() {
                // SAFETY: `start + k < n`.
                unsafe {
                    self.out.0.write(start + k, w.re);
                    self.out.1.write(start + k, w.im);
                }
            }
            start += m;
        }
    }
}

/// Puts `f` of n real numbers into their places, a piece at a time; `f` is told where the piece
/// begins.
///
/// # Safety
/// All input can be read and all output written; nothing else does either meanwhile.
pub(crate) unsafe fn apply_real(
    n: usize,
    x: (*const f64, isize),
    y: (*mut f64, isize),
    mut f: impl FnMut(usize, &[f64], &mut [f64]) -> Result<(), Failure>,
) -> Result<(), Failure> {
    if n == 0 {
        return Ok(());
    }
    let (from, at_x) = Input::new("x", x.0, x.1, n)?;
    let (to, at_y) = Output::new("y", y.0, y.1, n)?;
    if x.1 == 1 && y.1 == 1 && !overlap(&at_x, &at_y) {
        // SAFETY: n doubles one after another, readable and apart from the output.
        let x = unsafe { std::slice::from_raw_parts(x.0, n) };
        // SAFETY: n doubles one after another, writable; the solvers only write.
        let y = unsafe { std::slice::from_raw_parts_mut(y.0, n) };
        return f(0, x, y);
    }
    let (mut a, mut b) = ([0.0; CHUNK], [0.0; CHUNK]);
    let mut start = 0;
    while start < n {
        let m = CHUNK.min(n - start);
        for (k, a) in a[..m].iter_mut().enumerate() {
            // SAFETY: `start + k < n`.
            *a = unsafe { from.read(start + k) };
        }
        f(start, &a[..m], &mut b[..m])?;
        for (k, b) in b[..m].iter().enumerate() {
            // SAFETY: `start + k < n`.
            unsafe { to.write(start + k, *b) };
        }
        start += m;
    }
    Ok(())
}

/// An array of the caller that is only read; empty for n = 0.
///
/// # Safety
/// n doubles can be read there and are not written to while the slice is used.
pub(crate) unsafe fn slice<'a>(
    name: &str,
    first: *const f64,
    n: usize,
) -> Result<&'a [f64], Failure> {
    if n == 0 {
        return Ok(&[]);
    }
    Input::new(name, first, 1, n)?;
    // SAFETY: not NULL and within memory; the rest is promised.
    Ok(unsafe { std::slice::from_raw_parts(first, n) })
}

/// A copy of an array of the caller.
///
/// # Safety
/// As [`slice`].
pub(crate) unsafe fn copied(name: &str, first: *const f64, n: usize) -> Result<Vec<f64>, Failure> {
    // SAFETY: as promised.
    let all = unsafe { slice(name, first, n) }?;
    let mut copy = Vec::new();
    copy.try_reserve_exact(n).map_err(|_| {
        Failure::new(
            Status::Memory,
            format!("no memory for a copy of {name}, {n} numbers"),
        )
    })?;
    copy.extend_from_slice(all);
    Ok(copy)
}
