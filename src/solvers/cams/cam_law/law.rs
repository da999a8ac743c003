//! Laws of motion.

use super::error::CamLawError;
use super::motion::{Motion, Peaks, factor, times};
use super::polynomial::Polynomial;
use super::scca::{Place, Scca};
use super::symmetric_polynomial::SymmetricPolynomial;
use super::tabulated::Tabulated;
use crate::cubic_spline::End;
use crate::double_double::{Dd, two_sum};

#[derive(Clone, Debug)]
pub(crate) enum Shape {
    Scca(Scca),
    Symmetric(SymmetricPolynomial),
    Polynomial(Polynomial),
    Tabulated(Tabulated),
}

/// A law of motion, normalised.
///
/// ```
/// use mechaudit_solvers::cam_law::MotionLaw;
/// let law = MotionLaw::cycloidal();
/// let m = law.motion(0.25)?;
/// assert!((m.displacement - (0.25 - 0.5 / std::f64::consts::PI)).abs() < 1e-15);
/// assert!((law.peaks().velocity - 2.0).abs() < 1e-15);
/// // Near the end 1 − s keeps its digits.
/// let left = 2f64.powi(-20);
/// assert!(law.remaining(1.0 - left)? / left.powi(3) > 6.579);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct MotionLaw {
    shape: Shape,
    /// The share of the stroke spent accelerating.
    fraction: f64,
    halves: [Stretch; 2],
}

/// How a half of the symmetric law is stretched: its share of the stroke, and the powers 1, −1 and
/// −2 of twice that, which scale displacement, acceleration and jerk.
#[derive(Clone, Copy, Debug)]
struct Stretch {
    share: Dd,
    displacement: Dd,
    acceleration: Dd,
    jerk: Dd,
}

impl Stretch {
    fn new(share: Dd) -> Stretch {
        let displacement = share.scale(2.0);
        let acceleration = Dd::from(1.0).div(displacement);
        Stretch {
            share,
            displacement,
            acceleration: factor(acceleration),
            jerk: factor(acceleration * acceleration),
        }
    }
}

/// The least share of the stroke that a half takes.
const LEAST: f64 = 1e-3;

impl MotionLaw {
    fn of(shape: Shape) -> MotionLaw {
        MotionLaw {
            shape,
            fraction: 0.5,
            halves: [Stretch::new(Dd::from(0.5)); 2],
        }
    }

    /// The SCCA law whose acceleration is a sine, a constant and a cosine over the shares `b`, `c`
    /// and `d` of the stroke. `c` is taken as `1 − b − d`.
    ///
    /// # Errors
    /// A share that is not finite or negative; shares that do not add up to one (four units of
    /// rounding are allowed).
    pub fn scca(b: f64, c: f64, d: f64) -> Result<MotionLaw, CamLawError> {
        Ok(MotionLaw::of(Shape::Scca(Scca::new(b, c, d)?)))
    }

    fn known(b: f64, c: f64, d: f64) -> MotionLaw {
        MotionLaw::scca(b, c, d).expect("shares of a known law")
    }

    /// Constant acceleration (parabolic), "0050" in Gembara & Senyk.
    pub fn constant_acceleration() -> MotionLaw {
        MotionLaw::known(0.0, 1.0, 0.0)
    }

    /// Cosine acceleration (simple harmonic), "К" in Gembara & Senyk.
    pub fn simple_harmonic() -> MotionLaw {
        MotionLaw::known(0.0, 0.0, 1.0)
    }

    /// Modified trapezoidal acceleration.
    pub fn modified_trapezoid() -> MotionLaw {
        MotionLaw::known(0.25, 0.5, 0.25)
    }

    /// Modified sine acceleration.
    pub fn modified_sine() -> MotionLaw {
        MotionLaw::known(0.25, 0.0, 0.75)
    }

    /// Sine acceleration (cycloidal).
    pub fn cycloidal() -> MotionLaw {
        MotionLaw::known(0.5, 0.0, 0.5)
    }

    /// `s = 10x³ − 15x⁴ + 6x⁵`.
    pub fn polynomial_345() -> MotionLaw {
        MotionLaw::of(Shape::Symmetric(SymmetricPolynomial::Degree5))
    }

    /// `s = 35x⁴ − 84x⁵ + 70x⁶ − 20x⁷`.
    pub fn polynomial_4567() -> MotionLaw {
        MotionLaw::of(Shape::Symmetric(SymmetricPolynomial::Degree7))
    }

    /// `s = Σ c_k x^k / Σ c_k` with `c_k = coefficients[k]`.
    ///
    /// ```
    /// use mechaudit_solvers::cam_law::MotionLaw;
    /// let law = MotionLaw::polynomial(&[0.0, 0.0, 3.0, -2.0])?;
    /// assert_eq!(law.motion(0.5)?.displacement, 0.5);
    /// assert_eq!(law.peaks().velocity, 1.5);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// A coefficient that is not finite, `c_0 ≠ 0`, a degree not between 1 and 24, a sum further
    /// than 1e-9 from one.
    pub fn polynomial(coefficients: &[f64]) -> Result<MotionLaw, CamLawError> {
        let p = Polynomial::new(coefficients)?;
        Ok(MotionLaw::of(Shape::Polynomial(p)))
    }

    /// The cubic spline through a table that leads from (0, 0) to (1, 1); between dwells both ends
    /// are [`End::FirstDerivative`]`(0.0)`.
    ///
    /// # Errors
    /// A table that starts or ends elsewhere, or has no spline.
    pub fn tabulated(x: Vec<f64>, y: Vec<f64>, ends: [End; 2]) -> Result<MotionLaw, CamLawError> {
        let t = Tabulated::new(x, y, ends)?;
        Ok(MotionLaw::of(Shape::Tabulated(t)))
    }

    /// The law of one of the [`NAMES`](super::NAMES); the Latin letter K is good too.
    ///
    /// # Errors
    /// A name that no law has, or that the paper leaves undefined.
    pub fn by_name(name: &str) -> Result<MotionLaw, CamLawError> {
        Ok(match name {
            "0050" | "constant-acceleration" => MotionLaw::constant_acceleration(),
            "К" | "K" | "simple-harmonic" => MotionLaw::simple_harmonic(),
            "modified-trapezoid" => MotionLaw::modified_trapezoid(),
            "modified-sine" => MotionLaw::modified_sine(),
            "cycloidal" => MotionLaw::cycloidal(),
            "3-4-5" => MotionLaw::polynomial_345(),
            "4-5-6-7" => MotionLaw::polynomial_4567(),
            // Both with a Latin and with a Cyrillic letter.
            "C0" | "С0" | "0000" => return Err(CamLawError::UndefinedLaw { name: name.into() }),
            _ => return Err(CamLawError::UnknownLaw { name: name.into() }),
        })
    }

    /// The same law with another share `λ` of the stroke spent accelerating. Both halves are
    /// stretched, and scaled so that the velocity is continuous; C_v stays, C_a becomes
    /// `C_a/(2λ)` accelerating and `C_a/(2 − 2λ)` decelerating.
    ///
    /// # Errors
    /// A share outside [10⁻³, 1 − 10⁻³], where derivatives overflow sooner or later and harmonics
    /// lose their digits; a polynomial or a table, which have no halves.
    pub fn with_acceleration_fraction(mut self, fraction: f64) -> Result<MotionLaw, CamLawError> {
        if let Shape::Polynomial(_) | Shape::Tabulated(_) = self.shape {
            return Err(CamLawError::NoHalves);
        }
        if !(LEAST..=1.0 - LEAST).contains(&fraction) {
            return Err(CamLawError::AccelerationFraction { value: fraction });
        }
        self.fraction = fraction;
        self.halves = [Dd::from(fraction), two_sum(1.0, -fraction)].map(Stretch::new);
        Ok(self)
    }

    /// The share of the stroke spent accelerating: one half unless set.
    pub fn acceleration_fraction(&self) -> f64 {
        self.fraction
    }

    pub(crate) fn shape(&self) -> &Shape {
        &self.shape
    }

    /// The accelerating half of a law that is symmetric about the middle of its stroke.
    fn half(&self, place: &Place) -> Option<Motion> {
        match &self.shape {
            Shape::Scca(law) => Some(law.half(place)),
            Shape::Symmetric(law) => Some(law.half(place.y, place.left)),
            Shape::Polynomial(_) | Shape::Tabulated(_) => None,
        }
    }

    /// Returns what the accelerating half still has to go to the middle of the stroke: `1/2 − s`.
    fn until_middle(&self, left: f64) -> f64 {
        match &self.shape {
            Shape::Scca(law) => law.until_middle(0.5 * left),
            Shape::Symmetric(law) => law.until_middle(0.5 * left),
            Shape::Polynomial(_) | Shape::Tabulated(_) => f64::NAN,
        }
    }

    /// The law at `x`, and `1 − s`.
    pub(super) fn both(&self, x: f64) -> Result<(Motion, f64), CamLawError> {
        if !(0.0..=1.0).contains(&x) {
            return Err(CamLawError::Outside { x });
        }
        let accelerating = x < self.fraction;
        let [up, down] = &self.halves;
        let (distance, half, other) = match accelerating {
            true => (Dd::from(x), up, down),
            false => (two_sum(1.0, -x), down, up),
        };
        let y = distance.hi / half.displacement.hi;
        // Beside the middle, with a short half before it, `1 − x` rounds away more than `x` says.
        let (y, left) = match y < 0.25 {
            true => (y, 1.0 - 2.0 * y),
            false => {
                let left = (x - self.fraction).abs() / half.share.hi;
                (0.5 * (1.0 - left), left)
            }
        };
        let place = Place {
            distance,
            share: half.share,
            y,
            left,
        };
        let Some(m) = self.half(&place) else {
            return match &self.shape {
                Shape::Polynomial(law) => Ok(law.motion(x)),
                Shape::Tabulated(law) => law.motion(x),
                _ => unreachable!("halved above"),
            };
        };
        let near = times(m.displacement, half.displacement);
        // In a half that is longer than the other one, from where they meet: the rounding of `near`
        // would be too large.
        let (near, far) = match near > 0.5 {
            true => {
                let far = other.share.hi + times(self.until_middle(left), half.displacement);
                (1.0 - far, far)
            }
            false => (near, 1.0 - near),
        };
        let (displacement, remaining, sign) = match accelerating {
            true => (near, far, 1.0),
            false => (far, near, -1.0),
        };
        let motion = Motion {
            displacement,
            velocity: m.velocity,
            acceleration: sign * times(m.acceleration, half.acceleration),
            jerk: times(m.jerk, half.jerk),
        };
        Ok((motion, remaining))
    }

    /// Displacement, velocity, acceleration and jerk at `0 ≤ x ≤ 1`.
    ///
    /// # Errors
    /// [`CamLawError::Outside`].
    pub fn motion(&self, x: f64) -> Result<Motion, CamLawError> {
        Ok(self.both(x)?.0)
    }

    /// `1 − s(x)`, to full relative accuracy near the end of the stroke.
    ///
    /// # Errors
    /// [`CamLawError::Outside`].
    pub fn remaining(&self, x: f64) -> Result<f64, CamLawError> {
        Ok(self.both(x)?.1)
    }

    /// C_v, C_a and C_j.
    pub fn peaks(&self) -> Peaks {
        let symmetric = match &self.shape {
            Shape::Scca(law) => law.peaks(),
            Shape::Symmetric(law) => law.peaks(),
            Shape::Polynomial(law) => return law.peaks(),
            Shape::Tabulated(law) => return law.peaks(),
        };
        let (up, down) = (2.0 * self.fraction, 2.0 * (1.0 - self.fraction));
        let shorter = up.min(down);
        Peaks {
            velocity: symmetric.velocity,
            acceleration: symmetric.acceleration / up,
            deceleration: symmetric.deceleration / down,
            jerk: symmetric.jerk / (shorter * shorter),
        }
    }
}
