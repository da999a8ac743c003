//! The mechanism as the test set prints it.

use crate::reference::Decimal;
use crate::reference::planar::{
    Attachment, Body, Drive, Forces, Joint, Mechanism, MechanismError, Point, Spring,
};
use rug::{Float, Rational};

/// Working precision in bits.
pub const BITS: u32 = 160;

/// Parameters in SI units.
const PARAMETERS: [(&str, &str); 42] = [
    ("m1", "0.04325"),
    ("m2", "0.00365"),
    ("m3", "0.02373"),
    ("m4", "0.00706"),
    ("m5", "0.07050"),
    ("m6", "0.00706"),
    ("m7", "0.05498"),
    ("xa", "-0.06934"),
    ("ya", "-0.00227"),
    ("xb", "-0.03635"),
    ("yb", "0.03273"),
    ("xc", "0.014"),
    ("yc", "0.072"),
    ("c0", "4530"),
    ("i1", "2.194e-6"),
    ("i2", "4.410e-7"),
    ("i3", "5.255e-6"),
    ("i4", "5.667e-7"),
    ("i5", "1.169e-5"),
    ("i6", "5.667e-7"),
    ("i7", "1.912e-5"),
    ("d", "28e-3"),
    ("da", "115e-4"),
    ("e", "2e-2"),
    ("ea", "1421e-5"),
    ("rr", "7e-3"),
    ("ra", "92e-5"),
    ("l0", "7785e-5"),
    ("ss", "35e-3"),
    ("sa", "1874e-5"),
    ("sb", "1043e-5"),
    ("sc", "18e-3"),
    ("sd", "2e-2"),
    ("ta", "2308e-5"),
    ("tb", "916e-5"),
    ("u", "4e-2"),
    ("ua", "1228e-5"),
    ("ub", "449e-5"),
    ("zf", "2e-2"),
    ("zt", "4e-2"),
    ("fa", "1421e-5"),
    ("mom", "33e-3"),
];

/// A parameter by its printed name.
pub fn parameter(name: &str) -> Rational {
    let found = PARAMETERS.iter().find(|(n, _)| *n == name);
    let (_, text) = found.expect("a parameter of the mechanism");
    exactly(text)
}

/// A decimal of the print.
pub(super) fn exactly(text: &str) -> Rational {
    Decimal::parse(text).expect("a printed decimal").value
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
