//! Where an argument stands among the formulas of w(z) and of the functions built on it.

use crate::audit::BranchAt;
use crate::solvers::faddeeva::Seams;
use num_complex::Complex;

/// The nearest seam to `z`; cells of Taylor series are all one formula here. The distance to a
/// hyperbola is that of its tangent's first order.
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

    /// A circle of radius 2, |Re z| = 1, |Im z| = 0.5 and |Re z²| = 3.
    #[test]
    fn the_nearest_of_all_seams_is_named() {
        let mut seams = SEAMS;
        (seams.circles, seams.re) = (&[4.0], &[1.0]);
        (seams.im, seams.hyperbolas) = (&[0.5], &[3.0]);
        let at = |re, im| {
            let found = nearest(Complex::new(re, im), &seams, Some("series".into())).unwrap();
            assert_eq!(found.branch.as_deref(), Some("series"));
            (found.seam, found.distance)
        };
        for (re, im, seam, distance) in [
            (1.1, 0.25, "|Re z| = 1e0", 0.1),
            (-0.9, 0.0, "|Re z| = 1e0", 0.1),
            (0.0, 0.375, "|Im z| = 5e-1", 0.125),
            (0.0, -0.625, "|Im z| = 5e-1", 0.125),
            (0.0, 2.25, "|z|^2 = 4", 0.25),
            (-1.8, 0.0, "|z|^2 = 4", 0.2),
            // |Re z²| = 2.88 at |z| = 1.8: 0.12/3.6 away.
            (
                0.42426406871192845,
                -1.7492855684535902,
                "|Re z^2| = 3",
                0.12 / 3.6,
            ),
            // Above the axis no hyperbola parts anything.
            (0.42426406871192845, 1.7492855684535902, "|z|^2 = 4", 0.2),
        ] {
            let (name, off) = at(re, im);
            assert_eq!(name, seam, "{re} {im}");
            assert!((off - distance).abs() < 1e-12, "{re} {im}: {off}");
        }
        // Squares do not overflow.
        for im in [-1e99, -1e200] {
            assert!(at(1.0, im).1.is_finite(), "{im:e}");
        }
        for z in [
            Complex::new(f64::INFINITY, 0.0),
            Complex::new(0.0, f64::NAN),
        ] {
            assert!(nearest(z, &seams, None).is_none());
        }
    }

    /// W and what is W at another argument name the formula, too.
    #[test]
    fn functions_of_a_complex_argument_have_seams() {
        for (name, formula) in [
            ("faddeeva", true),
            ("erfcx", true),
            ("faddeeva-derivative", false),
            ("dawson", false),
            ("erf", false),
            ("erfc", false),
            ("erfi", false),
        ] {
            let method = crate::methods::find(name).unwrap();
            let found = method.branch(&[0.5, 0.75]).expect(name);
            assert_eq!(found.branch.is_some(), formula, "{name}");
            assert!(found.distance < 1.0, "{name}: {found:?}");
            assert!(method.branch(&[f64::INFINITY, 0.0]).is_none(), "{name}");
        }
        let real = crate::methods::find("voigt-hwhm").unwrap();
        assert!(real.branch(&[1.0, 1.0]).is_none());
    }

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
