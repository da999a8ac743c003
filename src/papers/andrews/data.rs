//! The mechanism as the test set prints it.

use crate::papers::file_of;
use crate::reference::planar::{
    Attachment, Body, Drive, Forces, Joint, Mechanism, MechanismError, Point, Spring,
};
use rug::{Float, Rational};

/// Working precision in bits.
pub const BITS: u32 = 160;

/// A parameter by its printed name.
pub fn parameter(name: &str) -> Rational {
    let file = file_of("andrews").expect("a paper that is compiled in");
    file.given("parameters", name)
}

/// Bodies K1 to K7 by index. The angles of their axes are β, β + Θ, γ, Φ + δ, δ, Ω + ε, ε; K2 joins
/// K1 and the pin P of K3, K4 and K6.
///
/// The loops close at P in the order of the printed g: K2 less K3, K2 less K4, K2 less K6.
///
/// # Errors
/// None for these data.
pub fn mechanism() -> Result<Mechanism, MechanismError> {
    let p = parameter;
    let zero = Rational::new;
    let body = |k: u32, centre: Point| Body {
        name: format!("K{k}"),
        mass: p(&format!("m{k}")),
        inertia: p(&format!("i{k}")),
        centre,
    };
    let bodies = vec![
        body(1, [p("ra"), zero()]),
        body(2, [-p("da"), zero()]),
        body(3, [p("sa"), p("sb")]),
        body(4, [zero(), p("ea") - p("e")]),
        body(5, [p("ta"), p("tb")]),
        body(6, [p("zf") - p("fa"), zero()]),
        body(7, [p("ua"), -p("ub")]),
    ];
    let origin = |k: usize| Attachment::body(k - 1, [zero(), zero()]);
    let at = |k: usize, x: Rational, y: Rational| Attachment::body(k - 1, [x, y]);
    let ground = |x: Rational, y: Rational| Attachment::ground([x, y]);
    let pin = |a: Attachment, b: Attachment| Joint::Pin { a, b };
    let joint = || at(2, -p("d"), zero());
    let joints = vec![
        pin(ground(zero(), zero()), origin(1)),
        pin(at(1, p("rr"), zero()), origin(2)),
        pin(ground(p("xb"), p("yb")), origin(3)),
        pin(ground(p("xa"), p("ya")), origin(5)),
        pin(at(5, p("zt"), zero()), origin(4)),
        pin(ground(p("xa"), p("ya")), origin(7)),
        pin(at(7, zero(), -p("u")), origin(6)),
        pin(joint(), at(3, zero(), -p("ss"))),
        pin(joint(), at(4, zero(), -p("e"))),
        pin(joint(), at(6, p("zf"), zero())),
    ];
    Mechanism::new(bodies, joints)
}

/// The torque at K1 and the spring between K3 and the ground.
pub fn forces() -> Forces {
    let p = parameter;
    Forces {
        drive: p("mom"),
        springs: vec![Spring {
            a: Attachment::body(2, [p("sd"), -p("sc")]),
            b: Attachment::ground([p("xc"), p("yc")]),
            stiffness: p("c0"),
            length: p("l0"),
        }],
        gravity: [Rational::new(), Rational::new()],
    }
}

/// The drive of the motion, β.
pub fn crank() -> Drive {
    Drive::coordinate(0)
}

/// The drive that the start is given by, Θ.
pub fn fold() -> Drive {
    Drive::relative(0, 1)
}

/// Coordinates near the start, from the printed ones: which of the modes is meant.
pub(super) fn near_the_start() -> Vec<Float> {
    [-0.06, -0.06, 0.46, 0.71, 0.49, 1.01, 1.23]
        .map(|x| Float::with_val(BITS, x))
        .to_vec()
}
