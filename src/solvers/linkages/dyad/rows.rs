//! Positions of a linkage at one crank angle, and at many of them in vectors. Both have the same
//! bits: they are the same formulas for one number or several.

use super::error::DyadError;
use super::four_bar::FourBar;
use super::motion::Assembly;
use super::slider_crank::SliderCrank;
use crate::arctangent::{is_moderate, sin_cos};
use crate::lanes::{Lanes, Task, with_best};
use crate::real::{Masked, Real};

/// A linkage that is driven by a crank.
pub(super) trait Rows {
    /// A position.
    type Moved<R>;
    /// The angle from which the crank is seen.
    fn relative<R: Masked>(&self, phi: R) -> R;
    /// The position at the crank angle φ1; `sin_cos` belongs to the relative angle, `s` to the
    /// assembly.
    fn moved<R: Masked>(&self, phi: R, sin_cos: (R, R), s: f64) -> Self::Moved<R>;
    /// Its row, and where there is one.
    fn row<R: Masked>(&self, moved: &Self::Moved<R>) -> ([R; 8], R::Mask);
}

/// One position.
struct One<'a, T>(&'a T, f64, f64);

impl<T: Rows> Task for One<'_, T> {
    type Output = T::Moved<f64>;
    #[inline(always)]
    fn run<L: Lanes>(self, _: L) -> T::Moved<f64> {
        one(self.0, self.1, self.2)
    }
}

#[inline(always)]
fn one<T: Rows>(linkage: &T, phi: f64, s: f64) -> T::Moved<f64> {
    let relative = linkage.relative(phi);
    let found = match is_moderate(relative) {
        true => sin_cos(relative),
        false => relative.sin_cos(),
    };
    linkage.moved(phi, found, s)
}

/// The position at one crank angle.
pub(super) fn at<T: Rows>(linkage: &T, phi: f64, assembly: Assembly) -> T::Moved<f64> {
    with_best(One(linkage, phi, assembly.sign()))
}

/// Rows at many crank angles, column by column.
struct Many<'a, T> {
    linkage: &'a T,
    phi: &'a [f64],
    s: f64,
    columns: [&'a mut [f64]; 8],
}

impl<T: Rows> Many<'_, T> {
    #[inline(always)]
    fn singly(&mut self, range: std::ops::Range<usize>) {
        for i in range {
            let (row, there) = self.linkage.row(&one(self.linkage, self.phi[i], self.s));
            for (column, x) in self.columns.iter_mut().zip(row) {
                column[i] = if there { x } else { f64::NAN };
            }
        }
    }
}

impl<T: Rows> Task for Many<'_, T> {
    type Output = ();
    #[inline(always)]
    fn run<L: Lanes>(mut self, _: L) {
        self.singly(0..self.phi.len());
    }
}

#[cfg(all(target_arch = "x86_64", feature = "vectors"))]
impl<T: Rows> crate::pack::WideTask for Many<'_, T> {
    type Output = ();
    #[inline(always)]
    fn run<S: crate::pack::Wide, L: Lanes>(mut self, simd: S, _: L) {
        use crate::pack::Pack;
        let whole = self.phi.len() / S::WIDTH * S::WIDTH;
        for at in (0..whole).step_by(S::WIDTH) {
            let phi = Pack::load(simd, self.phi, at);
            let relative = self.linkage.relative(phi);
            let all = &self.phi[at..at + S::WIDTH];
            if !all
                .iter()
                .all(|phi| is_moderate(self.linkage.relative(*phi)))
            {
                self.singly(at..at + S::WIDTH);
                continue;
            }
            let moved = self.linkage.moved(phi, sin_cos(relative), self.s);
            let (row, there) = self.linkage.row(&moved);
            let none = Pack(simd, simd.splat_f64s(f64::NAN));
            for (column, x) in self.columns.iter_mut().zip(row) {
                phi.pick(there, x, none).store_at(column, at);
            }
        }
        self.singly(whole..self.phi.len());
    }
}

fn many<T: Rows>(
    linkage: &T,
    phi: &[f64],
    assembly: Assembly,
    columns: [&mut [f64]; 8],
) -> Result<(), DyadError> {
    if let Some(column) = columns.iter().find(|c| c.len() != phi.len()) {
        return Err(DyadError::Room {
            angles: phi.len(),
            room: column.len(),
        });
    }
    let task = Many {
        linkage,
        phi,
        s: assembly.sign(),
        columns,
    };
    #[cfg(all(target_arch = "x86_64", feature = "vectors"))]
    let Err(task) = crate::pack::with_widest(task) else {
        return Ok(());
    };
    with_best(task);
    Ok(())
}

impl FourBar {
    /// Rows at many crank angles in radians, column by column: φ2, φ3, φ2', φ3', φ2'', φ3'', the
    /// transmission angle and the determinant, as [`FourBar::position`] has them, bit for bit. Where
    /// the linkage cannot be joined or is singular, the row is NaN; a value beyond the range of `f64`
    /// is not finite.
    ///
    /// ```
    /// use mechaudit_solvers::dyad::{Assembly, FourBar};
    /// use mechaudit_solvers::units::Length;
    /// let [a, b, c, d] = [0.1, 0.4, 0.3, 0.35].map(Length::from_m);
    /// let mut columns = [[0.0; 3]; 8];
    /// let rows = columns.each_mut().map(|column| &mut column[..]);
    /// FourBar::new(a, b, c, d)?.rows(&[0.0, 1.0, 2.0], Assembly::Positive, rows)?;
    /// assert!(columns.as_flattened().iter().all(|x| x.is_finite()));
    /// # Ok::<(), mechaudit_solvers::dyad::DyadError>(())
    /// ```
    ///
    /// # Errors
    /// [`DyadError::Room`] where a column has not as many places as there are angles.
    pub fn rows(
        &self,
        phi1_rad: &[f64],
        assembly: Assembly,
        columns: [&mut [f64]; 8],
    ) -> Result<(), DyadError> {
        many(self, phi1_rad, assembly, columns)
    }
}

impl SliderCrank {
    /// Rows at many crank angles in radians, column by column: the slider's coordinate, the rod's
    /// angle, their first and their second derivatives, the transmission angle and the determinant,
    /// as [`SliderCrank::position`] has them, bit for bit. Where the linkage cannot be joined or is
    /// singular, the row is NaN; a value beyond the range of `f64` is not finite.
    ///
    /// # Errors
    /// [`DyadError::Room`] where a column has not as many places as there are angles.
    pub fn rows(
        &self,
        phi1_rad: &[f64],
        assembly: Assembly,
        columns: [&mut [f64]; 8],
    ) -> Result<(), DyadError> {
        many(self, phi1_rad, assembly, columns)
    }
}

#[cfg(test)]
mod tests;
