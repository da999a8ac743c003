//! Groups with one complex unknown, all dyads among them: two circles or lines meet.

use super::isotropic::Bilinear;
use num_complex::Complex64;

/// Where two circles meet.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Meeting {
    /// None, one or two points.
    pub points: Vec<Complex64>,
    /// Tells whether rounding may have decided on their number.
    pub near: bool,
    /// Tells whether they are one circle.
    pub same: bool,
}

impl Meeting {
    /// Of circles about one centre or parallel lines: everywhere or nowhere.
    fn parallel(same: bool) -> Meeting {
        Meeting {
            same,
            near: same,
            ..Meeting::default()
        }
    }
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

/// The points of `2 Re(b x) + c = 0` on a circle whose `a` is not zero.
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
    let points = if square < 0.0 && !near {
        Vec::new()
    } else if square <= 0.0 {
        vec![at(-h / a)]
    } else {
        // Of the two forms of each root the one without cancellation.
        let q = -(h + square.sqrt().copysign(h));
        [q / a, k / q].map(at).to_vec()
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
    let (round, other) = match f.a.abs() >= g.a.abs() {
        true => (f, g),
        false => (g, f),
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
        return Meeting::parallel(same);
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
        return Meeting::parallel(same);
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
        // x + y = 0.1 and x − y = 0.3.
        let cross = meet(&[line(z(0.5, -0.5), -0.1), line(z(0.5, 0.5), -0.3)]);
        assert!((cross.points[0] - z(0.2, -0.1)).norm() < 1e-15, "{cross:?}");
        // x + y = 3 and x − y = 5.
        let cross = meet(&[line(z(0.5, -0.5), -3.0), line(z(0.5, 0.5), -5.0)]);
        assert!((cross.points[0] - z(4.0, -1.0)).norm() < 4e-15, "{cross:?}");
    }

    /// A line and a circle of centre iβ that touch but for `s` in the circle's constant: whether
    /// they may touch is said within the rounding of the terms.
    #[test]
    fn touching_within_rounding_is_told() {
        // a, β, the line's length of b, its x.
        for [a, beta, length, x] in [
            [1.0f64, 2.0, 0.5, 3.0],
            [0.5, 2.0, 0.5, 3.0],
            [0.25, 8.0, 0.5, 1.0],
            [1.0, 0.5, 2.0, 64.0],
            [1.0, 1.0, 1048576.0, 0.0],
            [1.0, 16.0, 0.5, 16.0],
        ] {
            let c = beta * beta / a - a * x * x;
            let terms = a * x * x + 2.0 * beta * x + c.abs();
            let rounding =
                f64::EPSILON * (32.0 * terms * (1.0 + 1.0 / length) * a + 16.0 * beta * beta);
            let found = |share: f64| {
                let circle = Circle {
                    a,
                    b: Complex64::new(0.0, beta),
                    c: c + share * rounding / a,
                };
                line_on_circle(Complex64::new(length, 0.0), -2.0 * length * x, circle)
            };
            let top = Complex64::new(x, beta / a);
            for share in [0.9, 0.2, 0.0, -0.2, -0.9] {
                let meeting = found(share);
                assert!(meeting.near, "{a} {beta} {length} {x} {share}");
                assert_eq!(meeting.points.len(), if share < 0.0 { 2 } else { 1 });
                let off = |p: &Complex64| (p - top).norm();
                let size = rounding.sqrt() / a;
                assert!(meeting.points.iter().all(|p| off(p) <= 1.01 * size));
            }
            assert_eq!((found(1.1).near, found(1.1).points.len()), (false, 0));
            assert_eq!((found(-1.1).near, found(-1.1).points.len()), (false, 2));
        }
    }

    /// Two points on a line whose distances from its foot differ by 1e8, both to the last digits.
    #[test]
    fn neither_point_cancels() {
        for h in [5e7, -5e7] {
            let circle = Circle {
                a: 1.0,
                b: Complex64::new(0.0, h),
                c: 1.0,
            };
            // y² − 2 h y + 1 = 0 on x = 0.
            let points = line_on_circle(Complex64::new(1.0, 0.0), 0.0, circle).points;
            let mut sizes: Vec<f64> = points.iter().map(|p| p.im / h).collect();
            sizes.sort_by(f64::total_cmp);
            let small = 0.5 / (h * h) * (1.0 + 0.25 / (h * h));
            assert!((sizes[0] / small - 1.0).abs() < 1e-15 && (sizes[1] - 2.0).abs() < 1e-15);
        }
    }

    /// Which circles are lines, and how near two may be to one another to count as one.
    #[test]
    fn what_counts_as_a_line_or_as_the_same() {
        let z = Complex64::new;
        let upright = line(z(1.0, 0.0), -1.0);
        for (a, points) in [(0.7e-14, 1), (1.5e-14, 2)] {
            // a |x|² + 2 Im x = 0 beside x = 0.5.
            let wide = vec![
                vec![z(0.0, 0.0), z(0.0, 1.0)],
                vec![z(0.0, -1.0), z(a, 0.0)],
            ];
            assert_eq!(meet(&[upright.clone(), wide]).points.len(), points);
        }
        // Unit circles but for a shift, and for a radius.
        let shifted = |by: f64| {
            vec![
                vec![z(-1.0, 0.0), z(by, 0.0)],
                vec![z(by, 0.0), z(1.0, 0.0)],
            ]
        };
        for (by, same) in [(1.8e-13, true), (2.2e-13, false)] {
            let meeting = meet(&[circle(z(0.0, 0.0), 1.0), shifted(by)]);
            assert_eq!((meeting.same, meeting.points.is_empty()), (same, same));
        }
        let larger = |by: f64| {
            vec![
                vec![z(-1.0 + by, 0.0), z(0.0, 0.0)],
                vec![z(0.0, 0.0), z(1.0, 0.0)],
            ]
        };
        for (by, same) in [(1.8e-12, true), (2.2e-12, false)] {
            let meeting = meet(&[circle(z(0.0, 0.0), 1.0), larger(by)]);
            assert_eq!(
                (meeting.same, meeting.near, meeting.points.len()),
                (same, same, 0)
            );
        }
        // Circles through the origin, whose constant is none of their size.
        let through = |by: f64| {
            let b = z(0.6 + by, -0.8);
            vec![vec![z(0.0, 0.0), b.conj()], vec![b, z(0.2, 0.0)]]
        };
        for (by, same) in [(1.8e-13, true), (2.2e-13, false)] {
            assert_eq!(meet(&[through(0.0), through(by)]).same, same, "{by}");
        }
        // The same far circle in another scale, and ones whose radius differs by about 1e-12 of the
        // squared distance.
        let far = circle(z(30.0, -40.0), 2.0);
        let scaled = |m: &Bilinear| -> Bilinear {
            let row = |r: &Vec<Complex64>| r.iter().map(|x| x * 0.7).collect();
            m.iter().map(row).collect()
        };
        assert!(meet(&[far.clone(), scaled(&far)]).same);
        let wider = |by: f64| circle(z(30.0, -40.0), 2.0 + by);
        assert!(meet(&[far.clone(), wider(1e-9)]).same);
        assert!(!meet(&[far, wider(3e-9)]).same);
    }

    #[test]
    fn parallel_lines() {
        let z = Complex64::new;
        for c in [2.0, 10.0, -40.0] {
            let first = line(z(3.0, 4.0), c);
            // Turned: 1e-14 of an angle is none.
            for (angle, points) in [(0.7e-14, 0), (1.5e-14, 1)] {
                let turned = line(z(3.0 - 4.0 * angle, 4.0 + 3.0 * angle), c);
                assert_eq!(
                    meet(&[first.clone(), turned]).points.len(),
                    points,
                    "{c} {angle}"
                );
            }
            assert!(meet(&[first.clone(), line(z(6.0, 8.0), 2.0 * c)]).same);
            assert!(meet(&[first.clone(), line(z(-3.0, -4.0), -c)]).same);
            for by in [1.0, 1e-3, 1e-9] {
                for (b, c) in [(z(3.0, 4.0), c + by), (z(-3.0, -4.0), -c - by)] {
                    let meeting = meet(&[first.clone(), line(b, c)]);
                    assert!(!meeting.same && !meeting.near && meeting.points.is_empty());
                }
            }
        }
        // (0.6 + 0.8) / 5 of a difference counts.
        let oblique = |by: f64| meet(&[line(z(3.0, 4.0), 0.0), line(z(3.0, 4.0), by)]).same;
        assert!(oblique(3.3e-13) && !oblique(3.8e-13));
        let far = |by: f64| meet(&[line(z(1.0, 0.0), 1e6), line(z(1.0, 0.0), 1e6 + by)]).same;
        assert!(far(1e-8) && !far(0.15));
        let upright = |by: f64| meet(&[line(z(1.0, 0.0), 0.0), line(z(1.0, 0.0), by)]).same;
        assert!(upright(0.9e-13) && !upright(1.1e-13));
    }
}
