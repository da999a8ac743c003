//! The angles of the links.

use std::f64::consts::TAU;

/// Angles of the links, in radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Positions {
    /// Link 2, from A to B.
    pub phi2: f64,
    /// Rocker 3, from O3 to C.
    pub phi3: f64,
    /// Ternary link 4, from C to D.
    pub phi4: f64,
    /// Rocker 5, from O5 to D.
    pub phi5: f64,
}

impl Positions {
    /// As an array (φ2, φ3, φ4, φ5).
    pub fn to_array(self) -> [f64; 4] {
        [self.phi2, self.phi3, self.phi4, self.phi5]
    }

    /// From an array (φ2, φ3, φ4, φ5).
    pub fn from_array([phi2, phi3, phi4, phi5]: [f64; 4]) -> Positions {
        Positions {
            phi2,
            phi3,
            phi4,
            phi5,
        }
    }

    /// Every angle brought into (−π, π].
    pub fn wrapped(self) -> Positions {
        Positions::from_array(self.to_array().map(wrap))
    }

    pub(super) fn plus(self, d: [f64; 4]) -> Positions {
        let own = self.to_array();
        Positions::from_array(std::array::from_fn(|i| own[i] + d[i]))
    }

    /// The largest difference of an angle, on the circle.
    pub(super) fn distance(self, other: Positions) -> f64 {
        let (a, b) = (self.to_array(), other.to_array());
        a.iter()
            .zip(b)
            .fold(0.0, |m, (x, y)| m.max(wrap(x - y).abs()))
    }
}

/// `x` modulo 2π in (−π, π].
pub(super) fn wrap(x: f64) -> f64 {
    use std::f64::consts::PI;
    if x > -PI && x <= PI {
        return x;
    }
    let r = x - TAU * (x / TAU).round();
    if r <= -PI { r + TAU } else { r }
}
