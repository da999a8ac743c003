//! Groups with one complex unknown, all dyads among them: two circles or lines meet.

use super::isotropic::Bilinear;
use num_complex::Complex64;

/// Where two circles meet.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Meeting {
    /// None, one or two points.
    pub points: Vec<Complex64>,
    /// Whether rounding may have decided on their number.
    pub near: bool,
    /// Whether they are one circle.
    pub same: bool,
}

/// `a |x|² + 2 Re(b x) + c = 0`.
#[derive(Clone, Copy, Debug)]
struct Circle {
    a: f64,
    b: Complex64,
    c: f64,
}

impl Circle {
    fn new(m: &Bilinear) -> Circle {
        let circle = Circle {
            a: m[1][1].re,
            b: m[1][0],
            c: m[0][0].re,
        };
        let size = circle.a.abs().max(circle.b.norm()).max(circle.c.abs());
        Circle {
            a: circle.a / size,
            b: circle.b / size,
            c: circle.c / size,
        }
    }

    fn value(&self, x: Complex64) -> f64 {
        self.a * x.norm_sqr() + 2.0 * (self.b * x).re + self.c
    }
}

/// The points of `2 Re(b x) + c = 0` on a circle.
fn line_on_circle(b: Complex64, c: f64, circle: Circle) -> Meeting {
    let length = b.norm();
    let e = b.conj() / length;
    let foot = e * (-0.5 * c / length);
    let along = Complex64::i() * e;
    // a t² + 2 h t + k
    let (a, k) = (circle.a, circle.value(foot));
    let h = (circle.b * along).re;
    let doubt = 32.0
        * f64::EPSILON
        * (a.abs() * foot.norm_sqr() + 2.0 * circle.b.norm() * foot.norm() + circle.c.abs())
        * (1.0 + 1.0 / length);
    let square = h * h - a * k;
    let near = square.abs() <= doubt * a.abs() + 16.0 * f64::EPSILON * h * h;
    let at = |t: f64| foot + along * t;
    let points = if a == 0.0 {
        if h == 0.0 {
            Vec::new()
        } else {
            vec![at(-0.5 * k / h)]
        }
    } else if square < 0.0 && !near {
        Vec::new()
    } else {
        let root = square.max(0.0).sqrt();
        // Of the two forms of each root the one without cancellation.
        let q = -(h + root.copysign(h));
        let ts = if q == 0.0 { [0.0, 0.0] } else { [q / a, k / q] };
        match root == 0.0 {
            true => vec![at(-h / a)],
            false => ts.map(at).to_vec(),
        }
    };
    Meeting {
        points,
        near,
        same: false,
    }
}

/// The common points of two circles or lines.
pub(super) fn meet(forms: &[Bilinear]) -> Meeting {
    let (f, g) = (Circle::new(&forms[0]), Circle::new(&forms[1]));
    let (round, other) = if f.a.abs() >= g.a.abs() {
        (f, g)
    } else {
        (g, f)
    };
    if round.a.abs() < 1e-14 {
        return lines(f, g);
    }
    // The radical line.
    let b = other.b * round.a - round.b * other.a;
    let c = other.c * round.a - round.c * other.a;
    let size = (other.b * round.a).norm() + (round.b * other.a).norm();
    let constant = (other.c * round.a).abs() + (round.c * other.a).abs();
    if b.norm() <= 1e-13 * (size + constant) {
        let same = c.abs() <= 1e-12 * (size + constant);
        return Meeting {
            same,
            near: same,
            ..Meeting::default()
        };
    }
    line_on_circle(b, c, round)
}

/// Two lines.
fn lines(f: Circle, g: Circle) -> Meeting {
    // Re(b x) = b.re x.re − b.im x.im
    let determinant = -f.b.re * g.b.im + f.b.im * g.b.re;
    if determinant.abs() <= 1e-14 * f.b.norm() * g.b.norm() {
        let same =
            (f.b.re * g.c - g.b.re * f.c).abs() + (f.b.im * g.c - g.b.im * f.c).abs() < 1e-13;
        return Meeting {
            same,
            near: same,
            ..Meeting::default()
        };
    }
    let (p, q) = (-0.5 * f.c, -0.5 * g.c);
    let x = (-p * g.b.im + q * f.b.im) / determinant;
    let y = (f.b.re * q - g.b.re * p) / determinant;
    Meeting {
        points: vec![Complex64::new(x, y)],
        ..Meeting::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn circle(at: Complex64, r: f64) -> Bilinear {
        let c = at.norm_sqr() - r * r;
        let z = Complex64::new;
        vec![vec![z(c, 0.0), -at], vec![-at.conj(), z(1.0, 0.0)]]
    }

    fn line(b: Complex64, c: f64) -> Bilinear {
        vec![
            vec![Complex64::new(c, 0.0), b.conj()],
            vec![b, Complex64::new(0.0, 0.0)],
        ]
    }

    #[test]
    fn circles_and_lines() {
        let z = Complex64::new;
        let two = meet(&[circle(z(0.0, 0.0), 3.0), circle(z(5.0, 0.0), 4.0)]);
        assert!(!two.near && two.points.len() == 2);
        for p in &two.points {
            assert!((p.re - 1.8).abs() < 1e-15 && (p.im.abs() - 2.4).abs() < 1e-15);
        }
        assert!(
            meet(&[circle(z(0.0, 0.0), 1.0), circle(z(5.0, 1.0), 2.0)])
                .points
                .is_empty()
        );
        assert!(meet(&[circle(z(0.0, 0.0), 1.0), circle(z(3.0, 0.0), 2.0)]).near);
        assert!(meet(&[circle(z(1.0, 2.0), 1.5), circle(z(1.0, 2.0), 1.5)]).same);
        let none = meet(&[circle(z(1.0, 2.0), 1.5), circle(z(1.0, 2.0), 1.0)]);
        assert!(none.points.is_empty() && !none.same);
        // x = 0.5 and the unit circle; x = 0.5 and y = 2.
        let upright = line(z(1.0, 0.0), -1.0);
        let on = meet(&[upright.clone(), circle(z(0.0, 0.0), 1.0)]);
        assert!(on.points.iter().all(|p| (p.re - 0.5).abs() < 1e-15));
        assert!((on.points[0].im + on.points[1].im).abs() < 1e-15);
        let cross = meet(&[upright, line(z(0.0, 1.0), 4.0)]);
        assert!((cross.points[0] - z(0.5, 2.0)).norm() < 1e-15, "{cross:?}");
    }
}
