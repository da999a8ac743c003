//! The problems of the atlas, as in `examples/studies/motion`, over numbers that may carry a
//! derivative.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// A number of a right-hand side.
pub trait Number:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + From<f64>
{
    /// Returns the square root.
    fn sqrt(self) -> Self;
}

impl Number for f64 {
    fn sqrt(self) -> f64 {
        f64::sqrt(self)
    }
}

/// A value with its derivative in one direction.
#[derive(Clone, Copy)]
pub struct Dual(pub f64, pub f64);

impl From<f64> for Dual {
    fn from(x: f64) -> Dual {
        Dual(x, 0.0)
    }
}

impl Add for Dual {
    type Output = Dual;
    fn add(self, o: Dual) -> Dual {
        Dual(self.0 + o.0, self.1 + o.1)
    }
}

impl Sub for Dual {
    type Output = Dual;
    fn sub(self, o: Dual) -> Dual {
        Dual(self.0 - o.0, self.1 - o.1)
    }
}

impl Mul for Dual {
    type Output = Dual;
    fn mul(self, o: Dual) -> Dual {
        Dual(self.0 * o.0, self.1 * o.0 + self.0 * o.1)
    }
}

impl Div for Dual {
    type Output = Dual;
    fn div(self, o: Dual) -> Dual {
        let q = self.0 / o.0;
        Dual(q, (self.1 - q * o.1) / o.0)
    }
}

impl Neg for Dual {
    type Output = Dual;
    fn neg(self) -> Dual {
        Dual(-self.0, -self.1)
    }
}

impl Number for Dual {
    fn sqrt(self) -> Dual {
        let root = self.0.sqrt();
        Dual(root, self.1 / (2.0 * root))
    }
}

/// An autonomous initial value problem with N states, from t = 0.
pub trait Problem<const N: usize>: 'static {
    /// Its name, that of its file.
    const NAME: &'static str;
    /// The end of the run.
    const END: f64;
    /// Returns the states at the start.
    fn start() -> [f64; N];
    /// Writes the rates.
    fn rate<S: Number>(y: &[S], out: &mut [S]);
}

/// x⁻³ of a squared length.
fn cubed<S: Number>(square: S) -> S {
    S::from(1.0) / (square * square.sqrt())
}

/// Lorenz's system.
pub struct Lorenz;

impl Problem<3> for Lorenz {
    const NAME: &'static str = "lorenz";
    const END: f64 = 10.0;

    fn start() -> [f64; 3] {
        [1.0; 3]
    }

    fn rate<S: Number>(y: &[S], out: &mut [S]) {
        out[0] = S::from(10.0) * (y[1] - y[0]);
        out[1] = y[0] * (S::from(28.0) - y[2]) - y[1];
        out[2] = y[0] * y[1] - S::from(8.0 / 3.0) * y[2];
    }
}

/// Kepler's orbit of eccentricity 0.9.
pub struct Kepler;

impl Problem<4> for Kepler {
    const NAME: &'static str = "kepler-orbit";
    const END: f64 = 20.0;

    fn start() -> [f64; 4] {
        let e: f64 = 0.9;
        [1.0 - e, 0.0, 0.0, ((1.0 + e) / (1.0 - e)).sqrt()]
    }

    fn rate<S: Number>(y: &[S], out: &mut [S]) {
        let w = cubed(y[0] * y[0] + y[1] * y[1]);
        (out[0], out[1]) = (y[2], y[3]);
        (out[2], out[3]) = (-(y[0] * w), -(y[1] * w));
    }
}

/// Arenstorf's orbit.
pub struct Arenstorf;

impl Problem<4> for Arenstorf {
    const NAME: &'static str = "arenstorf";
    const END: f64 = 17.065_216_560_157_963;

    fn start() -> [f64; 4] {
        [0.994, 0.0, 0.0, -2.001_585_106_379_082_5]
    }

    fn rate<S: Number>(y: &[S], out: &mut [S]) {
        const MU: f64 = 0.012277471;
        let (mu, nu) = (S::from(MU), S::from(1.0 - MU));
        let (a, b) = (y[0] + mu, y[0] - nu);
        let (c, d) = (
            nu * cubed(a * a + y[1] * y[1]),
            mu * cubed(b * b + y[1] * y[1]),
        );
        let two = S::from(2.0);
        (out[0], out[1]) = (y[2], y[3]);
        out[2] = y[0] + two * y[3] - a * c - b * d;
        out[3] = y[1] - two * y[2] - y[1] * (c + d);
    }
}

/// The seven Pleiades.
pub struct Pleiades;

impl Problem<28> for Pleiades {
    const NAME: &'static str = "pleiades";
    const END: f64 = 3.0;

    fn start() -> [f64; 28] {
        [
            3.0, 3.0, -1.0, -3.0, 2.0, -2.0, 2.0, 3.0, -3.0, 2.0, 0.0, 0.0, -4.0, 4.0, 0.0, 0.0,
            0.0, 0.0, 0.0, 1.75, -1.5, 0.0, 0.0, 0.0, -1.25, 1.0, 0.0, 0.0,
        ]
    }

    fn rate<S: Number>(y: &[S], out: &mut [S]) {
        for i in 0..14 {
            (out[i], out[14 + i]) = (y[14 + i], S::from(0.0));
        }
        for i in 0..7 {
            for j in 0..i {
                let (dx, dy) = (y[j] - y[i], y[7 + j] - y[7 + i]);
                let w = cubed(dx * dx + dy * dy);
                let (of_i, of_j) = (S::from(i as f64 + 1.0) * w, S::from(j as f64 + 1.0) * w);
                out[14 + i] = out[14 + i] + of_j * dx;
                out[21 + i] = out[21 + i] + of_j * dy;
                out[14 + j] = out[14 + j] - of_i * dx;
                out[21 + j] = out[21 + j] - of_i * dy;
            }
        }
    }
}

/// Van der Pol's oscillator with μ = 10.
pub struct VanDerPol;

impl Problem<2> for VanDerPol {
    const NAME: &'static str = "van-der-pol";
    const END: f64 = 20.0;

    fn start() -> [f64; 2] {
        [2.0, 0.0]
    }

    fn rate<S: Number>(y: &[S], out: &mut [S]) {
        out[0] = y[1];
        out[1] = S::from(10.0) * (S::from(1.0) - y[0] * y[0]) * y[1] - y[0];
    }
}

/// High irradiance response.
pub struct Hires;

impl Problem<8> for Hires {
    const NAME: &'static str = "hires";
    const END: f64 = 321.8122;

    fn start() -> [f64; 8] {
        [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0057]
    }

    fn rate<S: Number>(y: &[S], out: &mut [S]) {
        let k = |x: f64| S::from(x);
        let fast = k(280.0) * y[5] * y[7];
        out[0] = k(-1.71) * y[0] + k(0.43) * y[1] + k(8.32) * y[2] + k(0.0007);
        out[1] = k(1.71) * y[0] - k(8.75) * y[1];
        out[2] = k(-10.03) * y[2] + k(0.43) * y[3] + k(0.035) * y[4];
        out[3] = k(8.32) * y[1] + k(1.71) * y[2] - k(1.12) * y[3];
        out[4] = k(-1.745) * y[4] + k(0.43) * y[5] + k(0.43) * y[6];
        out[5] = k(0.69) * y[3] + k(1.71) * y[4] - k(0.43) * y[5] + k(0.69) * y[6] - fast;
        out[6] = fast - k(1.81) * y[6];
        out[7] = -out[6];
    }
}
