//! Positions, series, reactions and motion against closed forms and against each other.

use super::*;
use crate::class_iii::tests::q;
use crate::Ball;
use rug::{Float, Rational};

fn at(x: &str, y: &str) -> Point {
    [q(x), q(y)]
}

fn pin(a: Attachment, b: Attachment) -> Joint {
    Joint::Pin { a, b }
}

fn none() -> Forces {
    Forces {
        drive: Rational::new(),
        springs: Vec::new(),
        gravity: at("0", "0"),
    }
}

/// Andrews' squeezing mechanism (Hairer and Wanner, *Solving Ordinary Differential Equations II*, 2nd ed. 1996,
/// sec. VII.7), in metres and kilogrammes.
pub(super) fn andrews() -> (Mechanism, Forces, Vec<Float>) {
    let body = |name: &str, mass: &str, inertia: &str, centre: Point| Body {
        name: name.into(),
        mass: q(mass),
        inertia: q(inertia),
        centre,
    };
    let bodies = vec![
        body("K1", ".04325", "2.194e-6", at(".00092", "0")),
        body("K2", ".00365", "4.410e-7", at("-.0115", "0")),
        body("K3", ".02373", "5.255e-6", at(".01874", ".01043")),
        body("K4", ".00706", "5.667e-7", at("0", "-.00579")),
        body("K5", ".07050", "1.169e-5", at(".02308", ".00916")),
        body("K6", ".00706", "5.667e-7", at(".00579", "0")),
        body("K7", ".05498", "1.912e-5", at(".01228", "-.00449")),
    ];
    let b = Attachment::body;
    let origin = || at("0", "0");
    let (pa, pb) = (at("-.06934", "-.00227"), at("-.03635", ".03273"));
    let joints = vec![
        pin(Attachment::ground(origin()), b(0, origin())),
        pin(b(0, at(".007", "0")), b(1, origin())),
        pin(Attachment::ground(pb), b(2, origin())),
        pin(Attachment::ground(pa.clone()), b(4, origin())),
        pin(b(4, at(".04", "0")), b(3, origin())),
        pin(Attachment::ground(pa), b(6, origin())),
        pin(b(6, at("0", "-.04")), b(5, origin())),
        pin(b(1, at("-.028", "0")), b(2, at("0", "-.035"))),
        pin(b(1, at("-.028", "0")), b(3, at("0", "-.02"))),
        pin(b(1, at("-.028", "0")), b(5, at(".02", "0"))),
    ];
    let forces = Forces {
        drive: q(".033"),
        springs: vec![Spring {
            a: b(2, at(".02", "-.018")),
            b: Attachment::ground(at(".014", ".072")),
            stiffness: q("4530"),
            length: q(".07785"),
        }],
        gravity: at("0", "0"),
    };
    let guess = [-0.0617, -0.0617, 0.4553, 0.71, 0.4874, 1.0079, 1.2305];
    let guess = guess.map(|x| Float::with_val(64, x)).to_vec();
    (Mechanism::new(bodies, joints).unwrap(), forces, guess)
}

#[test]
fn andrews_moves() {
    let (mechanism, forces, guess) = andrews();
    let bits = 160;
    let aligned = Linkage::new(&mechanism, &Drive::relative(0, 1), bits).unwrap();
    let start = aligned.position(&Ball::integer(bits, 0), &guess).unwrap();
    println!("{:?}", start.x[0].to_decimal(35));
    let linkage = Linkage::new(&mechanism, &Drive::coordinate(0), bits).unwrap();
    let t0 = std::time::Instant::now();
    let course = linkage
        .from_rest(
            &start.x[0],
            &start.midpoints(),
            &forces,
            &[q("0.01"), q("0.02"), q("0.03")],
        )
        .unwrap();
    println!("{:?} {} {}", t0.elapsed(), course.panels, course.least_force);
    for m in &course.moments {
        println!("t {}", m.time);
        let show = |v: &[Ball]| {
            for x in v {
                println!("  {:?} {:.2e}", x.to_decimal(36), x.rad().to_f64());
            }
        };
        show(&m.position.x);
        show(&m.rates.first);
        show(&m.rates.second);
        show(&m.multipliers);
    }
}
