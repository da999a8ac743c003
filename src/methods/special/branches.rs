//! Where an argument stands among the formulas of w(z) and of the functions built on it.

use crate::audit::BranchAt;
use crate::solvers::faddeeva::Seams;
use num_complex::Complex;

/// The nearest seam to `z`; cells of Taylor series are all one formula here. The distance to a hyperbola
/// is that of its tangent's first order.
pub(super) fn nearest(z: Complex<f64>, seams: &Seams, branch: Option<String>) -> Option<BranchAt> {
    if !(z.re.is_finite() && z.im.is_finite()) {
        return None;
    }
    let size = z.re.hypot(z.im);
    let circles = seams.circles.iter().map(|&c| {
        let distance = (size - c.sqrt()).abs();
        (distance, format!("|z|^2 = {c}"))
    });
    let upright = seams.re.iter().map(|&a| {
        let distance = (z.re.abs() - a).abs();
        (distance, format!("|Re z| = {a:e}"))
    });
    let level = seams.im.iter().map(|&a| {
        let distance = (z.im.abs() - a).abs();
        (distance, format!("|Im z| = {a:e}"))
    });
    // Only there do they part anything.
    let below = seams
        .hyperbolas
        .iter()
        .filter(|_| z.im < 0.0 && size < 1e100);
    let hyperbolas = below.map(|&h| {
        let real = (z.re - z.im) * (z.re + z.im);
        let distance = (real.abs() - h).abs() / (2.0 * size);
        (distance, format!("|Re z^2| = {h}"))
    });
    let all = circles.chain(upright).chain(level).chain(hyperbolas);
    let (distance, seam) = all.min_by(|a, b| a.0.total_cmp(&b.0))?;
    Some(BranchAt {
        branch,
        seam,
        distance,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solvers::faddeeva::SEAMS;

    #[test]
    fn seams_are_found_from_either_side() {
        let at = |re, im| nearest(Complex::new(re, im), &SEAMS, None).unwrap();
        let circle = at(
            48f64.sqrt() / 2f64.sqrt() + 1e-6,
            48f64.sqrt() / 2f64.sqrt(),
        );
        assert_eq!(circle.seam, "|z|^2 = 48");
        assert!((circle.distance - 1e-6 / 2f64.sqrt()).abs() < 1e-9);
        let line = at(2.0, 3.75 - 1e-3);
        assert_eq!(line.seam, "|Im z| = 3.75e0");
        assert!((line.distance - 1e-3).abs() < 1e-12);
        let x = (7.0f64 + 4.0).sqrt() + 1e-5;
        assert_eq!(at(x, -2.0).seam, "|Re z^2| = 7");
        assert_ne!(at(x, 2.0).seam, "|Re z^2| = 7");
        assert!(nearest(Complex::new(f64::NAN, 0.0), &SEAMS, None).is_none());
    }
}
