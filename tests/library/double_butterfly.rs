//! All assembly modes of `examples/double-butterfly.toml` at four positions of its drive: how many
//! there are by exact elimination, each enclosed, and beside mpmath
//! (`reference/independent/double_butterfly.csv`).
//!
//! With ACD in place and `t = tan(β/2)`, x, y for the turns β of BFJ, ξ of EFG, η of DHI from the
//! drawing, the bars CE, IJ, GH keep their lengths: p(t, x) = 0, q(t, y) = 0, r(t, x, y) = 0,
//! quadratic in each. `R(t) = Res_y(Res_x(p, r), q)` has degree 24 and vanishes wherever the three
//! have a common zero, x or y at infinity among them; at a real t of two of them it has a double
//! root. So where R, freed of factors 1 + t², is square-free and of full degree (no zero at
//! infinity), there are as many real modes at most as real roots, and Sturm's sequence counts
//! those.

use mechaudit::reference::planar::{Attachment, Body, Drive, Joint, Linkage, Mechanism, Position};
use mechaudit::reference::{Ball, Decimal};
use rug::{Float, Rational};

const BITS: u32 = 192;
const FILE: &str = include_str!("../../examples/double-butterfly.toml");
const WITNESS: &str = include_str!("../../reference/independent/double_butterfly.csv");
/// The ground is AB; the first body is driven.
const BODIES: [&str; 7] = ["ACD", "CE", "EFG", "BFJ", "DHI", "GH", "IJ"];

type Vector = [Rational; 2];
/// By ascending powers.
type Poly = Vec<Rational>;

fn q(text: &str) -> Rational {
    Decimal::parse(text).expect("a number").value
}

/// A point as the file draws it, in centimetres.
fn drawn(name: char) -> Vector {
    let (_, rest) = FILE.split_once(&format!("{name} = [")).expect("a point");
    let (inside, _) = rest.split_once(']').expect("a point");
    let parts: Vec<Rational> = inside
        .split(',')
        .map(|t| q(t.trim().trim_matches('"').trim_end_matches(" cm")))
        .collect();
    parts.try_into().expect("two coordinates")
}

fn way(a: char, b: char) -> Vector {
    less(&drawn(b), &drawn(a))
}

fn plus(a: &Vector, b: &Vector) -> Vector {
    [0, 1].map(|i| Rational::from(&a[i] + &b[i]))
}

fn less(a: &Vector, b: &Vector) -> Vector {
    [0, 1].map(|i| Rational::from(&a[i] - &b[i]))
}

fn dot(a: &Vector, b: &Vector) -> Rational {
    Rational::from(&a[0] * &b[0]) + Rational::from(&a[1] * &b[1])
}

fn cross(a: &Vector, b: &Vector) -> Rational {
    Rational::from(&a[0] * &b[1]) - Rational::from(&a[1] * &b[0])
}

/// A vector turned by the angle whose half has the tangent t.
fn turned(v: &Vector, t: &Rational) -> Vector {
    let square = t.clone().square();
    let whole = Rational::from(1 + &square);
    let (c, s) = (1 - square, Rational::from(2 * t));
    let x = Rational::from(&c * &v[0]) - Rational::from(&s * &v[1]);
    let y = Rational::from(&s * &v[0]) + Rational::from(&c * &v[1]);
    [x / &whole, y / whole]
}

/// `|p + R(x) a|² − square = 0` times 1 + x²: its coefficients by descending powers of x.
fn bar(p: &Vector, a: &Vector, square: &Rational) -> [Rational; 3] {
    let middle = dot(p, p) + dot(a, a) - square;
    let along = dot(p, a) * 2u32;
    [
        Rational::from(&middle - &along),
        cross(a, p) * 4u32,
        middle + along,
    ]
}

/// The resultant of two quadratics.
fn eliminated([a, b, c]: &[Rational; 3], [d, e, f]: &[Rational; 3]) -> Rational {
    let minor = |x: &Rational, y: &Rational, z: &Rational, w: &Rational| {
        Rational::from(x * y) - Rational::from(z * w)
    };
    minor(a, f, c, d).square() - minor(a, e, b, d) * minor(b, f, c, e)
}

fn determinant(mut m: Vec<Vec<Rational>>) -> Rational {
    let n = m.len();
    let mut product = Rational::from(1);
    for k in 0..n {
        let Some(pivot) = (k..n).find(|&i| !m[i][k].is_zero()) else {
            return Rational::new();
        };
        if pivot != k {
            m.swap(pivot, k);
            product = -product;
        }
        product *= &m[k][k];
        let top = m[k].clone();
        for row in &mut m[k + 1..] {
            let factor = Rational::from(&row[k] / &top[k]);
            for (x, y) in row.iter_mut().zip(&top).skip(k) {
                *x -= Rational::from(&factor * y);
            }
        }
    }
    product
}

/// The polynomial of least degree through values at 0, 1, 2, ….
fn interpolated(values: &[Rational]) -> Poly {
    let mut differences = values.to_vec();
    let mut out = vec![Rational::new(); values.len()];
    let mut basis = vec![Rational::from(1)];
    for k in 0..values.len() {
        for (o, b) in out.iter_mut().zip(&basis) {
            *o += Rational::from(b * &differences[0]);
        }
        let node = Rational::from(k as u32);
        let mut next = vec![Rational::new(); basis.len() + 1];
        for (i, b) in basis.iter().enumerate() {
            next[i + 1] += Rational::from(b / (k as u32 + 1));
            next[i] -= Rational::from(b * &node) / (k as u32 + 1);
        }
        basis = next;
        differences = differences
            .windows(2)
            .map(|w| Rational::from(&w[1] - &w[0]))
            .collect();
    }
    trimmed(out)
}

fn trimmed(mut p: Poly) -> Poly {
    while p.last().is_some_and(Rational::is_zero) {
        p.pop();
    }
    p
}

/// Quotient and remainder.
fn divided(p: &Poly, d: &Poly) -> (Poly, Poly) {
    let mut rest = p.clone();
    let mut quotient = vec![Rational::new(); (p.len() + 1).saturating_sub(d.len())];
    while rest.len() >= d.len() {
        let shift = rest.len() - d.len();
        let factor = Rational::from(&rest[rest.len() - 1] / &d[d.len() - 1]);
        for (r, x) in rest[shift..].iter_mut().zip(d) {
            *r -= Rational::from(&factor * x);
        }
        quotient[shift] = factor;
        rest.pop();
        rest = trimmed(rest);
    }
    (quotient, rest)
}

/// R at the position of ACD given by the unit vector that turns it from the drawing.
struct Elimination {
    c: Vector,
    d: Vector,
}

impl Elimination {
    /// p, q and r at a number t, r as coefficients of x at a number y; all times what clears their
    /// fractions.
    fn at(
        &self,
        t: &Rational,
    ) -> (
        [Rational; 3],
        [Rational; 3],
        impl Fn(&Rational) -> [Rational; 3],
    ) {
        let square = |a, b| dot(&way(a, b), &way(a, b));
        let [f, j] = ['F', 'J'].map(|n| plus(&drawn('B'), &turned(&way('B', n), t)));
        let clear = Rational::from(1) + t.clone().square();
        let times = move |k: Rational| move |[a, b, c]: [Rational; 3]| [a * &k, b * &k, c * &k];
        let for_x =
            times(clear.clone())(bar(&less(&f, &self.c), &way('F', 'E'), &square('C', 'E')));
        let for_y =
            times(clear.clone())(bar(&less(&self.d, &j), &way('D', 'I'), &square('I', 'J')));
        let (d, gh) = (self.d.clone(), square('G', 'H'));
        let joined = move |y: &Rational| {
            let h = plus(&d, &turned(&way('D', 'H'), y));
            let both = (1 + y.clone().square()) * &clear;
            times(both)(bar(&less(&f, &h), &way('F', 'G'), &gh))
        };
        (for_x, for_y, joined)
    }

    fn value(&self, t: &Rational) -> Rational {
        let (for_x, [a, b, c], joined) = self.at(t);
        let values: Vec<Rational> = (0..5u32)
            .map(|y| eliminated(&for_x, &joined(&Rational::from(y))))
            .collect();
        let mut quartic = interpolated(&values);
        quartic.resize(5, Rational::new());
        // Sylvester's matrix, rows by descending powers.
        let row = |p: &[Rational], shift: usize| {
            let mut row = vec![Rational::new(); 6];
            row[shift..shift + p.len()].clone_from_slice(p);
            row
        };
        quartic.reverse();
        let mut rows: Vec<_> = (0..2).map(|k| row(&quartic, k)).collect();
        rows.extend((0..4).map(|k| row(&[a.clone(), b.clone(), c.clone()], k)));
        determinant(rows)
    }

    /// R without its factors 1 + t².
    fn polynomial(&self) -> Poly {
        // Three values more than the degree needs: a mistake in it would show.
        let values: Vec<Rational> = (0..28u32).map(|t| self.value(&Rational::from(t))).collect();
        let mut p = interpolated(&values);
        assert!(p.len() <= 25);
        let circle = [1, 0, 1].map(Rational::from).to_vec();
        let mut degree = 24;
        loop {
            let (quotient, rest) = divided(&p, &circle);
            if !rest.is_empty() {
                break;
            }
            p = quotient;
            degree -= 2;
        }
        assert_eq!(p.len(), degree + 1, "a zero at infinity");
        p
    }
}

/// The number of real roots of a square-free polynomial, by Sturm's sequence.
fn real_roots(p: &Poly) -> usize {
    let derivative = (1..p.len()).map(|k| Rational::from(&p[k] * k as u32));
    let mut sequence = vec![p.clone(), derivative.collect()];
    loop {
        let [.., a, b] = &sequence[..] else {
            unreachable!("two to begin with")
        };
        let (_, rest) = divided(a, b);
        if rest.is_empty() {
            break;
        }
        sequence.push(rest.into_iter().map(|x| -x).collect());
    }
    assert_eq!(sequence[sequence.len() - 1].len(), 1, "a multiple root");
    let changes = |far: bool| {
        let sign = |p: &Poly| {
            let positive = p[p.len() - 1].is_positive();
            positive != (far && p.len().is_multiple_of(2))
        };
        let signs: Vec<bool> = sequence.iter().map(sign).collect();
        signs.windows(2).filter(|w| w[0] != w[1]).count()
    };
    changes(true) - changes(false)
}

/// The file's bodies in axes that are those of the drawing there.
fn linkage() -> Linkage {
    let mut joints = Vec::new();
    for point in 'A'..='J' {
        let mut on = Vec::new();
        if "AB".contains(point) {
            on.push(Attachment::ground(drawn(point)));
        }
        let bodies = (0..7).filter(|&k| BODIES[k].contains(point));
        on.extend(bodies.map(|k| Attachment::body(k, drawn(point))));
        let [a, b] = &on[..] else {
            panic!("{point} joins two bodies");
        };
        let (a, b) = (a.clone(), b.clone());
        joints.push(Joint::Pin { a, b });
    }
    let bodies = BODIES.map(Body::massless).to_vec();
    let mechanism = Mechanism::new(bodies, joints).expect("one degree of freedom");
    Linkage::new(&mechanism, &Drive::coordinate(0), BITS).expect("a drive")
}

#[test]
fn the_file_is_as_published() {
    for body in BODIES {
        let points: Vec<String> = body.chars().map(|c| format!("\"{c}\"")).collect();
        let text = format!("name = \"{body}\"\ndrawn = [{}]\n", points.join(", "));
        assert!(FILE.contains(&text), "{body}");
    }
    assert_eq!(FILE.matches("[[body]]").count(), 7);
    assert!(FILE.contains("[ground]\ndrawn = [\"A\", \"B\"]"));
}

#[test]
fn every_real_mode_is_enclosed_and_none_is_missing() {
    let linkage = linkage();
    for (quarter, due) in [(0, 8), (1, 2), (2, 2), (3, 8)] {
        let degrees = 90 * quarter;
        let seat = |name| {
            let [x, y] = drawn(name);
            match quarter {
                0 => [x, y],
                1 => [-y, x],
                2 => [-x, -y],
                _ => [y, -x],
            }
        };
        let elimination = Elimination {
            c: seat('C'),
            d: seat('D'),
        };
        let p = elimination.polynomial();
        assert_eq!(real_roots(&p), due, "{degrees}");
        let drive = Ball::pi(BITS).shift(-1) * Ball::integer(BITS, quarter);
        let mut found: Vec<Position> = Vec::new();
        let rows = WITNESS
            .lines()
            .filter(|l| l.starts_with(&format!("{degrees},")));
        for line in rows {
            let cells: Vec<&str> = line.split(',').collect();
            // Solutions in complex numbers are roots as well.
            assert_eq!(cells[1], (p.len() - 1).to_string(), "{line}");
            let theirs: Vec<Rational> = cells[3..].iter().map(|c| q(c)).collect();
            let mut guess = vec![Float::with_val(64, drive.mid())];
            guess.extend(theirs.iter().map(|x| Float::with_val(64, x)));
            let ours = linkage.position(&drive, &guess).expect("proved");
            for (a, b) in ours.x[1..].iter().zip(&theirs) {
                let gap = (a - &Ball::rational(BITS, b)).abs().upper();
                assert!(gap < 1e-35, "{line}: {}", a.mid());
                assert!(a.accuracy_bits() > 150 || b.is_zero(), "{line}");
            }
            // Another mode than those before: BFJ, between −π and π, stands elsewhere.
            assert!(found.iter().all(|f| !f.x[3].overlaps(&ours.x[3])), "{line}");
            found.push(ours);
        }
        assert_eq!(found.len(), due, "{degrees}");
    }
}

/// Sturm's count and the resultant on what is known.
#[test]
fn the_count_counts() {
    let poly = |c: &[i32]| c.iter().map(|&x| Rational::from(x)).collect::<Poly>();
    // (t² − 2)(t² + 1)(t − 3) and t³ − t + 1.
    assert_eq!(real_roots(&poly(&[6, -2, 3, -1, -3, 1])), 3);
    assert_eq!(real_roots(&poly(&[1, -1, 0, 1])), 1);
    let three = |c: [i32; 3]| c.map(Rational::from);
    // Roots 1, 2 and 2, 5; then 1, 2 and 3, 5.
    assert!(eliminated(&three([1, -3, 2]), &three([1, -7, 10])).is_zero());
    assert_eq!(eliminated(&three([1, -3, 2]), &three([1, -8, 15])), 24);
}
