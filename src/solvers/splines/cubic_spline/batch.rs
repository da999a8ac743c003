//! Values at many points.

use super::error::EvaluationError as Error;
use super::grid::Grid;
use super::lookup::{GROUP, Lookup, Work, with_best};
use super::spline::Spline;
use crate::splines::piecewise::{Jet, Piecewise};

/// Points examined at a time, so that they stay in the first-level cache.
const BLOCK: usize = 1024;

impl<G: Grid> Spline<G> {
    /// `S` at points in any order.
    ///
    /// # Errors
    /// Lengths that differ; as [`Spline::value`] for the first point that fails. `out` is then
    /// partly written.
    pub fn values(&self, x: &[f64], out: &mut [f64]) -> Result<(), Error> {
        check_room(x, out)?;
        self.values_from(0, x, out)
    }

    fn values_from(&self, offset: usize, x: &[f64], out: &mut [f64]) -> Result<(), Error> {
        with_best(Batch {
            spline: self,
            offset,
            x,
            out,
            sorted: false,
        })
    }

    fn sorted_from(&self, offset: usize, x: &[f64], out: &mut [f64]) -> Result<(), Error> {
        with_best(Batch {
            spline: self,
            offset,
            x,
            out,
            sorted: true,
        })
    }

    /// `PLAIN`: no point lies beside a given slope.
    #[inline(always)]
    fn any_order<L: Lookup, const PLAIN: bool>(
        &self,
        lookup: L,
        offset: usize,
        x: &[f64],
        out: &mut [f64],
    ) -> Result<(), Error> {
        let plain = |x: &[f64; GROUP]| x.iter().fold(true, |all, x| all & self.is_plain(*x, *x));
        let mut start = 0;
        while start < x.len() {
            let found = x[start..]
                .first_chunk::<GROUP>()
                .filter(|x| PLAIN || plain(x))
                .and_then(|x| self.grid.group(lookup, &self.y, &self.bend, x, None));
            if let Some(found) = found {
                out[start..start + GROUP].copy_from_slice(&found);
                start += GROUP;
                continue;
            }
            let stop = x.len().min(start + GROUP);
            for i in start..stop {
                out[i] = self.value_in_batch(offset + i, x[i])?;
            }
            start = stop;
        }
        Ok(())
    }

    /// `S`, `S'`, `S''`, `S'''` at points in any order.
    ///
    /// # Errors
    /// As [`Spline::value`]; the index is the place in `x`.
    pub fn jets(&self, x: &[f64]) -> Result<Vec<Jet>, Error> {
        let one = |(i, x): (usize, &f64)| {
            self.place(i, *x)?;
            self.jet(*x)
        };
        x.iter().enumerate().map(one).collect()
    }

    /// `S` at points in ascending order: each segment is prepared once. The values are those of
    /// [`Spline::value`], bit for bit. On uniform knots this is [`Spline::values`] with a check of
    /// the order; points close together are quick either way.
    ///
    /// # Errors
    /// Lengths that differ; a point smaller than its predecessor; as [`Spline::value`]. `out` is
    /// then partly written.
    ///
    /// ```
    /// use mechaudit_solvers::cubic_spline::{Boundary, UniformCubicSpline};
    /// let s = UniformCubicSpline::fit(0.0, 1.0, vec![0.0, 1.0, 0.0], Boundary::NATURAL)?;
    /// let mut out = [0.0; 3];
    /// s.values_sorted(&[0.5, 1.0, 1.5], &mut out)?;
    /// assert_eq!(out, [0.6875, 1.0, 0.6875]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn values_sorted(&self, x: &[f64], out: &mut [f64]) -> Result<(), Error> {
        check_room(x, out)?;
        self.sorted_from(0, x, out)
    }

    #[inline(always)]
    fn ascending<L: Lookup>(
        &self,
        lookup: L,
        offset: usize,
        x: &[f64],
        out: &mut [f64],
    ) -> Result<(), Error> {
        let mut before = f64::NEG_INFINITY;
        let mut segment = 0;
        let mut done = 0;
        for (x, out) in x.chunks(BLOCK).zip(out.chunks_mut(BLOCK)) {
            // Without an early end, so that it becomes vector instructions.
            let pairs = x.iter().zip(&x[1..]);
            let ascending = pairs.fold(x[0] >= before, |all, (a, b)| all & (a <= b));
            let (first, last) = self.grid.span();
            let (least, greatest) = (x[0], x[x.len() - 1]);
            let plain = self.is_plain(least, greatest);
            if !ascending || least < first || greatest > last || !(G::GROUPS || plain) {
                self.exceptional(offset + done, before, x, out)?;
            } else if G::GROUPS && plain {
                self.any_order::<L, true>(lookup, offset + done, x, out)?;
            } else if G::GROUPS {
                self.any_order::<L, false>(lookup, offset + done, x, out)?;
            } else {
                segment = self.block(lookup, segment, x, out);
            }
            before = greatest;
            done += x.len();
        }
        Ok(())
    }

    /// A block that is out of order, reaches beyond the knots or beside a given slope.
    fn exceptional(
        &self,
        offset: usize,
        mut before: f64,
        x: &[f64],
        out: &mut [f64],
    ) -> Result<(), Error> {
        for (i, (&x, out)) in x.iter().zip(out).enumerate() {
            let index = offset + i;
            if x < before {
                return Err(Error::NotSorted { index });
            }
            *out = self.value_in_batch(index, x)?;
            before = x;
        }
        Ok(())
    }

    /// An ascending block between the knots; `segment` does not begin after its first point.
    /// Returns the segment of the last point.
    #[inline(always)]
    fn block<L: Lookup>(&self, lookup: L, mut segment: usize, x: &[f64], out: &mut [f64]) -> usize {
        let end = self.grid.segments() - 1;
        for (x, out) in x.chunks(GROUP).zip(out.chunks_mut(GROUP)) {
            let group = x.first_chunk().and_then(|x| {
                self.grid
                    .group(lookup, &self.y, &self.bend, x, Some(&mut segment))
            });
            if let Some(found) = group {
                out.copy_from_slice(&found);
                continue;
            }
            for (x, out) in x.iter().zip(out) {
                // The next segment is the usual case; a search when it is further away.
                let mut steps = 0;
                while segment < end && self.grid.knot(segment + 1) <= *x {
                    steps += 1;
                    segment = match steps < 8 {
                        true => segment + 1,
                        false => self.grid.locate(*x),
                    };
                }
                *out = self.cell(segment).value(*x);
            }
        }
        segment
    }
}

/// Points of which the first is number `offset` of those given by the caller.
pub(super) struct Batch<'a, G: Grid> {
    pub(super) spline: &'a Spline<G>,
    pub(super) offset: usize,
    pub(super) x: &'a [f64],
    pub(super) out: &'a mut [f64],
    pub(super) sorted: bool,
}

impl<G: Grid> Work for Batch<'_, G> {
    type Output = Result<(), Error>;

    #[inline(always)]
    fn run<L: Lookup>(self, lookup: L) -> Result<(), Error> {
        let Batch { spline, x, out, .. } = self;
        if self.sorted {
            spline.ascending(lookup, self.offset, x, out)
        } else if spline.is_plain(f64::NEG_INFINITY, f64::INFINITY) {
            spline.any_order::<L, true>(lookup, self.offset, x, out)
        } else {
            spline.any_order::<L, false>(lookup, self.offset, x, out)
        }
    }
}

#[cfg(feature = "parallel")]
impl<G: Grid> Spline<G> {
    /// [`Spline::values`] over all cores.
    ///
    /// # Errors
    /// As [`Spline::values`]; of several points that fail, any may be named.
    pub fn par_values(&self, x: &[f64], out: &mut [f64]) -> Result<(), Error> {
        use rayon::prelude::*;
        check_room(x, out)?;
        x.par_chunks(PARALLEL)
            .zip(out.par_chunks_mut(PARALLEL))
            .enumerate()
            .try_for_each(|(i, (x, out))| self.values_from(i * PARALLEL, x, out))
    }

    /// [`Spline::values_sorted`] over all cores.
    ///
    /// # Errors
    /// As [`Spline::values_sorted`]; of several points that fail, any may be named.
    pub fn par_values_sorted(&self, x: &[f64], out: &mut [f64]) -> Result<(), Error> {
        use rayon::prelude::*;
        check_room(x, out)?;
        x.par_chunks(PARALLEL)
            .zip(out.par_chunks_mut(PARALLEL))
            .enumerate()
            .try_for_each(|(i, (part, out))| {
                let start = i * PARALLEL;
                if start > 0 && part[0] < x[start - 1] {
                    return Err(Error::NotSorted { index: start });
                }
                self.sorted_from(start, part, out)
            })
    }
}

/// Points handed to a core at a time.
#[cfg(feature = "parallel")]
const PARALLEL: usize = 1 << 16;

fn check_room(x: &[f64], out: &[f64]) -> Result<(), Error> {
    if x.len() == out.len() {
        Ok(())
    } else {
        Err(Error::Length {
            points: x.len(),
            room: out.len(),
        })
    }
}

#[cfg(test)]
mod tests;
