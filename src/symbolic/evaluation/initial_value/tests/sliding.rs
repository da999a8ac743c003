//! Motions that slide along a switch, and quantities of motions.

use super::{check_derivatives, decimals, limited, problem, trajectory, with_inputs};
use mechaudit_reference::Ball;
use rug::Rational;

/// Motions that slide along a switch, in closed form.
#[test]
fn sliding() {
    let at = |text: &str, t: (i64, i64)| decimals(&mut trajectory(text), t, 25);
    // A mass on a belt of speed 1/2: it slips up to π/6, is carried to x = 1 at π/6 + √3, and slips
    // again.
    let belt = "x = 0 -> v; v = 0 -> -x + if(v < 1/2, 1, -1)";
    assert_eq!(at(belt, (2, 1))[0], "0.8721752084164119166977232");
    assert_eq!(
        at(belt, (3, 1)),
        ["1.338747083361802856853530", "0.3677640731690247446766366"].map(String::from)
    );
    // A shaft that a brake holds, frees, holds and frees: it turns from asin(3/4) to 3.0587…, and
    // back from π + asin(3/4) on.
    let brake =
        "phi = 0 -> omega; omega = 0 -> 2*sin(t) - if(omega > 0, 3/2, if(omega < 0, -3/2, 0))";
    assert_eq!(at(brake, (1, 2)), ["0", "0"].map(String::from));
    assert_eq!(
        at(brake, (3, 2)),
        [
            "0.04867554177916467445847864",
            "0.2034943706691109871538447"
        ]
        .map(String::from)
    );
    assert_eq!(at(brake, (3, 1))[1], "0.07495376720540772187336997");
    assert_eq!(at(brake, (7, 2))[0], "0.5936135612396032973184968");
    assert_eq!(
        at(brake, (9, 2)),
        [
            "0.5688896853623904819204025",
            "-0.1357661555276472530632258"
        ]
        .map(String::from)
    );
    // Motions that touch the switch from one side or reach a second one are undecided.
    let touches = at(belt, (9, 1)).concat();
    assert!(
        touches.contains("8.538") && touches.contains("touch"),
        "{touches}"
    );
    let both = "x = 1 -> if(x > 0, -1, 1); y = 2 -> if(y > 0, -1, 1)";
    assert_eq!(
        at(both, (3, 2)),
        ["0", "0.5000000000000000000000000"].map(String::from)
    );
    let two = at(both, (3, 1)).concat();
    assert!(two.contains("two switches"), "{two}");
    // Other states have rates of their own where y is zero.
    let own = "x = 0 -> if(y == 0, 7, 1); y = 1 -> if(y > 0, -1, 1)";
    assert_eq!(at(own, (1, 2))[0], "0.5000000000000000000000000");
    let own = at(own, (3, 1)).concat();
    assert!(own.contains("rates of its own"), "{own}");
    // The past of a motion at rest is not determined.
    let held = at("w = 0 -> 1 - if(w > 0, 2, -2)", (-1, 2)).concat();
    assert!(held.contains("the side of a switch"), "{held}");
    // The same resistance by its size and the sign of the rate.
    let signed = "phi = 0 -> omega; omega = 0 -> 2*sin(t) - copysign(3/2, omega)";
    assert_eq!(at(signed, (9, 2)), at(brake, (9, 2)));
    let signed = "phi = 0 -> omega; omega = 0 -> 2*sin(t) - 3/2*omega/abs(omega)";
    assert!(at(signed, (9, 2)).concat().contains("no value"));
    // Leaves at t = 1 with ω = (t − 1)² (t − 2) (t − 3)/10, which comes to rest at 2; a polynomial,
    // whose steps end far beyond that.
    let turns =
        "w = 0 -> 1 + (t - 1)*((2*t - 5)*(t - 1) + 2*(t - 2)*(t - 3))/10 - if(w > 0, 1, -1)";
    assert_eq!(at(turns, (3, 2)), ["0.01875000000000000000000000"]);
    assert_eq!(at(turns, (9, 4)), ["0"]);
    // Jumps of the torque while the brake holds.
    let steps = "w = 0 -> if(t < 1, 1, if(t < 2, -1, 3)) - if(w > 0, 2, -2)";
    assert_eq!(at(steps, (3, 2)), ["0"]);
    let jump = at(steps, (3, 1)).concat();
    assert!(
        jump.contains("undecided") && jump.contains("leaves"),
        "{jump}"
    );
}

#[test]
fn derivatives_of_sliding_motions() {
    let root = 3f64.sqrt() / 2.0;
    let belt = with_inputs(
        &[("u", (1, 2))],
        "x = 0 -> v; v = 0 -> -x + if(v < u, 1, -1)",
    );
    check_derivatives(belt, (2, 1), &[root, 0.5, 1.476401224401701, 0.0, 0.0, 1.0]);
    let brake = || {
        let rate = "2*sin(t) - if(omega > 0, c, if(omega < 0, -c, 0))";
        with_inputs(
            &[("c", (3, 2))],
            &format!("phi = 0 -> omega; omega = 0 -> {rate}"),
        )
    };
    let open = f64::NAN;
    check_derivatives(
        brake(),
        (7, 2),
        &[1.0, open, -2.44354535027441, 0.0, open, 0.0],
    );
    let due = [1.0, open, -2.313319204280961, 0.0, open, 0.5103452674287258];
    check_derivatives(brake(), (9, 2), &due);
}

fn exact(x: f64) -> Rational {
    Rational::from_f64(x).unwrap()
}

/// The enclosures of a quantity at some times.
fn quantity(text: &str, quantity: &str, times: &[(i64, i64)]) -> Vec<Option<Ball>> {
    let problem = problem(&format!("{text}; q = 0 -> {quantity}")).unwrap();
    let quantity = *problem.rates.last().unwrap();
    let problem = problem.with_quantities(vec![quantity]);
    let mut motion = problem.trajectory(&[], limited()).unwrap();
    let value = |time: &(i64, i64)| {
        let time = Rational::from(*time);
        // All states are zero at the start, exactly.
        let states = match time.is_zero() {
            true => vec![Ball::integer(64, 0); 2],
            false => motion.enclosed(&time, 64).unwrap(),
        };
        motion.quantities(&time, &states, 64).unwrap().remove(0)
    };
    times.iter().map(value).collect()
}

/// The force of a resistance of 2 is that which balances 8t while it holds, and 2 from 1/4 on.
#[test]
fn quantities_along_switches() {
    let wheel = "w = 0 -> 8*t - copysign(2, w)";
    let resistance = "copysign(2, w)";
    let near = |found: &Option<Ball>, due: f64| {
        let found = found.as_ref().unwrap();
        let off = (found - &Ball::exact(64, due)).magnitude().to_f64();
        assert!(
            found.contains(&exact(due)) && off < 1e-15,
            "{found:?} {due}"
        );
    };
    let found = quantity(wheel, resistance, &[(0, 1), (1, 8), (1, 4), (1, 2)]);
    for (found, due) in found.iter().zip([0.0, 1.0, 2.0, 2.0]) {
        near(found, due);
    }
    // A start that leaves the switch at once, on either side.
    near(
        &quantity("w = 0 -> 3 - copysign(2, w)", resistance, &[(0, 1)])[0],
        2.0,
    );
    near(
        &quantity("w = 0 -> -3 - copysign(2, w)", resistance, &[(0, 1)])[0],
        -2.0,
    );
    // The force jumps where the motion comes to rest: it is any between both.
    let stops = quantity(
        "w = 1 -> -1 - copysign(2, w)",
        resistance,
        &[(1, 3), (1, 1)],
    );
    near(&stops[1], -1.0);
    let due = [-1.0, 2.0].map(|due| {
        stops[0]
            .as_ref()
            .is_none_or(|ball| ball.contains(&exact(due)))
    });
    assert_eq!(due, [true, true], "{stops:?}");
}

/// A quantity at a start at a switch is that on the side to which the motion goes first.
#[test]
fn quantities_at_a_start_at_a_switch() {
    let jump = "copysign(2, t*(t - 1/10^50))";
    let found = quantity(&format!("x = 0 -> {jump}"), jump, &[(0, 1)]);
    let holds = |ball: &Ball, due: f64| ball.contains(&exact(due));
    assert!(
        found[0].as_ref().is_none_or(|ball| holds(ball, -2.0)),
        "{found:?}"
    );
    // A value of its own at the moment of the switch.
    let own = quantity(
        "x = 0 -> 1 + if(t == 1, 5, 0)",
        "if(t == 1, 7, 0)",
        &[(1, 1)],
    );
    assert!(
        own[0].as_ref().is_none_or(|ball| holds(ball, 7.0)),
        "{own:?}"
    );
}
