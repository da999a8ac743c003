//! Jansen's leg in balls beside what others print of it (`reference/published/jansen-leg.csv`) and
//! beside mpmath (`reference/independent/jansen_leg.csv`).
//!
//! The leg is taken as eleven bars: a triangle of a file's `sides` has a root in it, bars have
//! fractions.

use mechaudit::reference::planar::{Attachment, Body, Drive, Joint, Linkage, Mechanism};
use mechaudit::reference::{Ball, ComplexBall, Decimal};
use rug::{Float, Rational};

const BITS: u32 = 192;
const PUBLISHED: &str = include_str!("../../reference/published/jansen-leg.csv");
const WITNESS: &str = include_str!("../../reference/independent/jansen_leg.csv");

type Vector = [Rational; 2];

/// The bars with their ends; the crank first.
const BARS: [(&str, char, char); 11] = [
    ("m", 'O', 'M'),
    ("j", 'M', 'X'),
    ("b", 'P', 'X'),
    ("e", 'X', 'Y'),
    ("d", 'P', 'Y'),
    ("k", 'M', 'Z'),
    ("c", 'P', 'Z'),
    ("f", 'Y', 'W'),
    ("g", 'Z', 'W'),
    ("h", 'W', 'F'),
    ("i", 'Z', 'F'),
];

fn q(text: &str) -> Rational {
    Decimal::parse(text).expect("a number").value
}

/// Jansen's numbers, as vectors along x.
fn holy() -> [Vector; 11] {
    let lengths = [
        "15", "50", "41.5", "55.8", "40.1", "61.9", "39.3", "39.4", "36.7", "65.7", "49",
    ];
    lengths.map(|l| [q(l), Rational::new()])
}

/// Pyslvs's example "Jansen's linkage (Single)", from end to end as drawn.
fn drawn() -> [Vector; 11] {
    let at = |name: char| {
        let text = match name {
            'O' => ["0.0", "0.0"],
            'M' => ["9.61", "11.52"],
            'P' => ["-38.0", "-7.8"],
            'X' => ["-35.24", "33.61"],
            'Y' => ["-77.75", "-2.54"],
            'Z' => ["-20.1", "-42.79"],
            'W' => ["-56.05", "-35.42"],
            _ => ["-22.22", "-91.74"],
        };
        text.map(q)
    };
    BARS.map(|(_, a, b)| {
        let ([ax, ay], [bx, by]) = (at(a), at(b));
        [bx - ax, by - ay]
    })
}

struct Leg {
    linkage: Linkage,
    vectors: [Vector; 11],
}

fn argument(v: &Vector) -> Ball {
    ComplexBall::rational(BITS, &v[0], &v[1]).arg()
}

impl Leg {
    fn new(vectors: [Vector; 11]) -> Leg {
        let mut joints = Vec::new();
        for point in ['O', 'P', 'M', 'X', 'Y', 'Z', 'W', 'F'] {
            let mut on = match point {
                'O' => vec![Attachment::ground(["0", "0"].map(q))],
                'P' => vec![Attachment::ground(["-38", "-7.8"].map(q))],
                _ => Vec::new(),
            };
            on.extend((0..11).filter_map(|k| Leg::end(&vectors, k, point)));
            let [first, rest @ ..] = &on[..] else {
                unreachable!("every point is on a bar");
            };
            joints.extend(rest.iter().map(|b| Joint::Pin {
                a: first.clone(),
                b: b.clone(),
            }));
        }
        let bodies = BARS.iter().map(|b| Body::massless(b.0)).collect();
        let mechanism = Mechanism::new(bodies, joints).expect("one degree of freedom");
        Leg {
            linkage: Linkage::new(&mechanism, &Drive::coordinate(0), BITS).expect("a drive"),
            vectors,
        }
    }

    /// The bar's end at a point.
    fn end(vectors: &[Vector; 11], bar: usize, point: char) -> Option<Attachment> {
        let origin = || ["0", "0"].map(q);
        match BARS[bar] {
            (_, from, _) if from == point => Some(Attachment::body(bar, origin())),
            (_, _, to) if to == point => Some(Attachment::body(bar, vectors[bar].clone())),
            _ => None,
        }
    }

    /// X, Y, Z, W, F at a crank angle, the position next to rough coordinates of them; X above MP,
    /// Z below it, Y, W, F outside, which names one of the 32 positions.
    fn points(&self, degrees: u32, near: &[[f64; 2]; 5]) -> [[Ball; 2]; 5] {
        let phi = Ball::pi(BITS) * Ball::rational(BITS, &Rational::from((degrees, 180)));
        let (s, c) = phi.sin_cos();
        let crank = {
            let [x, y] = self.vectors[0].each_ref().map(Rational::to_f64);
            x.hypot(y)
        };
        let rough = |name: char| match name {
            'O' => [0.0, 0.0],
            'P' => [-38.0, -7.8],
            'M' => [crank * c.to_f64(), crank * s.to_f64()],
            _ => near["XYZWF".find(name).expect("a point")],
        };
        let guess: Vec<Float> = BARS
            .iter()
            .zip(&self.vectors)
            .map(|((_, a, b), v)| {
                let ([ax, ay], [bx, by]) = (rough(*a), rough(*b));
                let angle = (by - ay).atan2(bx - ax) - argument(v).to_f64();
                Float::with_val(64, angle)
            })
            .collect();
        let drive = &phi - &argument(&self.vectors[0]);
        let turns = ((guess[0].to_f64() - drive.to_f64()) / std::f64::consts::TAU).round();
        let whole = Ball::pi(BITS).shift(1) * Ball::integer(BITS, turns as i64);
        let position = self.linkage.position(&(drive + whole), &guess);
        let series = self.linkage.series(&position.expect("proved"), 2);
        let series = series.expect("proved");
        let at = |name: char| {
            let end = (0..11).find_map(|k| Leg::end(&self.vectors, k, name));
            let [point, ..] = self.linkage.point_motion(&series, &end.expect("on a bar"));
            point
        };
        let all = ['X', 'Y', 'Z', 'W', 'F'].map(at);
        let [x, y, z, w, f] = all.each_ref();
        let (m, p) = (
            at('M'),
            ["-38", "-7.8"].map(|t| Ball::rational(BITS, &q(t))),
        );
        for [a, b, c] in [[&p, &m, x], [&p, x, y], [&m, &p, z], [z, y, w], [z, w, f]] {
            assert!(cross(a, b, c).is_positive(), "{degrees}");
        }
        all
    }
}

/// Twice the area of a triangle, positive where c is left of the way from a to b.
fn cross(a: &[Ball; 2], b: &[Ball; 2], c: &[Ball; 2]) -> Ball {
    let way = |p: &[Ball; 2]| [0, 1].map(|i| &p[i] - &a[i]);
    let ([bx, by], [cx, cy]) = (way(b), way(c));
    bx * cy - by * cx
}

fn numbers(cells: &[&str]) -> [[f64; 2]; 5] {
    let all: Vec<f64> = cells.iter().map(|c| q(c).to_f64()).collect();
    std::array::from_fn(|k| [all[2 * k], all[2 * k + 1]])
}

/// Rough points at whole degrees that are multiples of 15.
fn rough(degrees: u32) -> [[f64; 2]; 5] {
    let row = |d: u32| {
        let line = WITNESS.lines().find(|l| l.starts_with(&format!("{d},")));
        numbers(&line.expect("a row").split(',').skip(1).collect::<Vec<_>>())
    };
    let (a, b) = (row(degrees / 30 * 30), row(degrees.div_ceil(30) * 30 % 360));
    std::array::from_fn(|k| [0, 1].map(|i| (a[k][i] + b[k][i]) / 2.0))
}

#[test]
fn mpmath_agrees_to_thirty_digits() {
    let leg = Leg::new(holy());
    let mut rows = 0;
    for line in WITNESS.lines().skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        let degrees: u32 = cells[0].parse().expect("degrees");
        let ours = leg.points(degrees, &rough(degrees));
        for (a, b) in ours.as_flattened().iter().zip(&cells[1..]) {
            let gap = (a - &Ball::rational(BITS, &q(b))).abs().upper();
            assert!(gap < 1e-35, "{line}: {}", a.mid());
            assert!(a.accuracy_bits() > 150, "{line}");
        }
        rows += 1;
    }
    assert_eq!(rows, 12);
}

/// Every printed number by how many units of its last place it is off, rounded: all are right but
/// those named.
#[test]
fn printed_numbers_are_right_but_for_last_places() {
    let mut wrong = Vec::new();
    let mut rows = 0;
    for line in PUBLISHED.lines().filter(|l| !l.starts_with('#')).skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        let [source, crank, degrees, quantity, text] = cells[..] else {
            panic!("{line}");
        };
        let mut vectors = if source == "pmksweb" { holy() } else { drawn() };
        if crank != "drawn" {
            vectors[0] = [q(crank), Rational::new()];
        }
        let ours = match BARS.iter().position(|b| b.0 == quantity) {
            Some(bar) => {
                let [x, y] = &vectors[bar];
                Ball::rational(BITS, &(x.clone().square() + y.clone().square())).sqrt()
            }
            None => {
                let degrees = degrees.parse().expect("degrees");
                let all = Leg::new(vectors).points(degrees, &rough(degrees));
                let (axis, point) = quantity.split_once('_').expect("a coordinate");
                let k = "XYZWF".find(point).expect("a point");
                all[k][usize::from(axis == "y")].clone()
            }
        };
        let units = Decimal::parse(text).expect("printed").units_off(&ours);
        let half = Rational::from((1, 2));
        // A printed number is told right or wrong, never left open.
        assert!(!units.contains(&half), "{line}");
        if units.lower() > 0.5 {
            wrong.push(format!("{source} {quantity} {text}: {:.1}", units.to_f64()));
        }
        rows += 1;
    }
    assert_eq!(rows, 29);
    // Roundings of doubles, in the last of 17 digits.
    let due = [
        "pyslvs c 39.302800154696364: 6.8",
        "pyslvs f 39.395233214184685: 2.4",
        "pyslvs x_F -43.17005515543241: 1.8",
    ];
    assert_eq!(wrong, due);
}

/// Where the circles about p and q with these squares of radii meet, left of the way from p to q or
/// right of it.
fn meet([p, q]: [&ComplexBall; 2], [r, s]: [&Rational; 2], left: bool) -> ComplexBall {
    let way = q - p;
    let [r, s] = [r, s].map(|x| Ball::rational(64, x));
    let square = way.norm_sqr();
    let along = (&r - &s + &square) / square.shift(1);
    let across = (r / &square - along.square()).sqrt();
    let across = if left { across } else { -across };
    p + &(&way * &ComplexBall::new(along, across))
}

/// `|YZ|²` in one of the eight positions of the bars up to there.
fn gap(crank: &Ball, [x_left, y_left, z_left]: [bool; 3]) -> Ball {
    let [b, j, d, e, c, k] = ["41.5", "50", "40.1", "55.8", "39.3", "61.9"].map(|l| q(l).square());
    let m = ComplexBall::unit(crank).scaled(&Ball::integer(64, 15));
    let p = ComplexBall::rational(64, &q("-38"), &q("-7.8"));
    let x = meet([&p, &m], [&b, &j], x_left);
    let y = meet([&p, &x], [&d, &e], y_left);
    let z = meet([&p, &m], [&c, &k], z_left);
    (&y - &z).norm_sqr()
}

/// The statements of PMKSWeb's fixture beside its numbers. The eleven bars can be joined in 32 ways
/// at crank angle zero: right. Twelve of them jam in a turn and nineteen run beside the leg: wrong,
/// 16 jam and 15 run. (A mirror in the line OP keeps the bars, so that those that jam come in
/// eights: by two, times the sides of W and F.) |MZ| − |PZ| is 1.19 short of the least
/// |MP|: right.
///
/// X, Z and F exist at every angle, and Y, whose sides make a triangle; W where `|f − g| < |YZ| < f + g`, which is proved on
/// arcs that cover the circle, or refuted at one angle.
#[test]
fn sixteen_of_thirty_two_positions_run() {
    let (least, most) = (q("2.7").square(), q("76.1").square());
    let within = |g: &Ball| g.lower() > least && g.upper() < most;
    let outside = |g: &Ball| g.upper() < least || g.lower() > most;
    let (mut run, mut jam) = (0, 0);
    for sides in (0..8).map(|k| [k & 1 == 0, k & 2 == 0, k & 4 == 0]) {
        let at = |arc: i64, arcs: i64| {
            let turn = Ball::pi(64).shift(1);
            let [low, high] = [arc, arc + 1].map(|k| {
                let part = Ball::rational(64, &Rational::from((k, arcs)));
                &turn * &part
            });
            (gap(&low.union(&high), sides), gap(&low, sides))
        };
        // At crank angle zero all can be joined.
        assert!(within(&at(0, 1).1), "{sides:?}");
        let arcs = 1024;
        let all: Vec<(Ball, Ball)> = (0..arcs).map(|k| at(k, arcs)).collect();
        match (
            all.iter().all(|(arc, _)| within(arc)),
            all.iter().any(|(_, angle)| outside(angle)),
        ) {
            (true, false) => run += 4,
            (false, true) => jam += 4,
            undecided => panic!("{sides:?} {undecided:?}"),
        }
    }
    assert_eq!((run, jam), (16, 16));
    let square = q("38").square() + q("7.8").square();
    let slack =
        Ball::rational(64, &square).sqrt() - Ball::rational(64, &(q("15") + q("61.9") - q("39.3")));
    assert_eq!(slack.to_decimal(3).as_deref(), Some("1.19"));
}
