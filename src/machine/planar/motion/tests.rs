//! Tests of `motion`.

use super::*;
use crate::machine::Source;
use crate::machine::planar::{choose, path};

const QUICK_RETURN: &str = include_str!("../../../../examples/quick-return.toml");
const RACK: &str = include_str!("../../../../examples/rack-and-wheel.toml");
const BOOM: &str = include_str!("../../../../examples/cylinder-boom.toml");

fn read(text: &str) -> Machine {
    Machine::read(&Source::toml(text)).unwrap()
}

/// The branch that the file means over a turn or a range, in `n` steps.
fn drawn(machine: &Machine, n: u32) -> Motion {
    let at = machine.start.at.unwrap_or(0.0);
    let at = if machine.rotary() {
        at.to_radians()
    } else {
        at
    };
    let branch = choose(machine, at, None).unwrap();
    let all = path(machine, &branch, n);
    assert_eq!(all.len(), n as usize + 1);
    motion(machine, &all, 0, false)
}

fn labels(motion: &Motion, of: &[usize]) -> String {
    let of: Vec<&str> = of.iter().map(|k| &*motion.points[*k].label).collect();
    of.join(" ")
}

fn assert_near(found: [f64; 2], due: [f64; 2], what: &str) {
    let apart = (found[0] - due[0]).hypot(found[1] - due[1]);
    assert!(apart < 1e-12, "{what}: {found:?}, due {due:?}");
}

#[test]
fn the_drive_is_shown_in_degrees_or_metres() {
    let quick = drawn(&read(QUICK_RETURN), 4);
    let Drive {
        symbol,
        unit,
        values,
    } = &quick.drive;
    assert_eq!((*symbol, *unit), ("φ", "°"));
    for (k, value) in values.iter().enumerate() {
        assert!((value - 90.0 * k as f64).abs() < 1e-12);
    }
    assert_eq!(
        (&*quick.name, quick.start, quick.closed),
        ("quick return", 0, false)
    );
    let machine = read(&BOOM.replace("[\"0.9 m\", \"1.4 m\"]", "[\"0.9 m\", \"1.3 m\"]"));
    let boom = drawn(&machine, 2);
    assert_eq!((boom.drive.symbol, boom.drive.unit), ("s", "m"));
    for (value, due) in boom.drive.values.iter().zip([0.9, 1.1, 1.3]) {
        assert!((value - due).abs() < 1e-12);
    }
    let nameless = read(&QUICK_RETURN.replace("name = \"quick return\"\n", ""));
    assert_eq!(drawn(&nameless, 4).name, "mechanism");
    let all = path(&machine, &choose(&machine, 1.0, None).unwrap(), 2);
    let shown = motion(&machine, &all, 2, true);
    assert_eq!((shown.start, shown.closed), (2, true));
}

/// Points of the ground by name, pivots where a pin holds them, and then those that move.
#[test]
fn bodies_are_drawn_between_their_points() {
    let motion = drawn(&read(QUICK_RETURN), 4);
    let pivots: Vec<(&str, bool, usize)> = motion.points[..6]
        .iter()
        .map(|p| (&*p.label, p.pivot, p.path.len()))
        .collect();
    assert_eq!(
        pivots,
        [
            ("O", true, 1),
            ("Q", true, 1),
            ("S", false, 1),
            ("A", false, 5),
            ("B", false, 5),
            ("C", false, 5)
        ]
    );
    let links: Vec<String> = motion.links.iter().map(|l| labels(&motion, l)).collect();
    assert_eq!(links, ["O A", "Q B", "B C"]);
    // A body of one point is nothing to draw but its block.
    assert_eq!(motion.plates.len(), 2);
    assert!(motion.wheels.is_empty());
    for k in 0..5 {
        let (sin, cos) = (90.0 * k as f64).to_radians().sin_cos();
        assert_near(motion.points[3].at(k), [0.05 * cos, 0.12 + 0.05 * sin], "A");
    }
    let watt = read(include_str!("../../../../examples/watt-1.toml"));
    let start = watt.start.at.unwrap().to_radians();
    let branch = choose(&watt, start, None).unwrap();
    let motion = super::motion(&watt, &path(&watt, &branch, 2), 0, false);
    let plates: Vec<String> = motion.plates.iter().map(|p| labels(&motion, p)).collect();
    assert_eq!(plates, ["B C E", "C D F"]);
    let links: Vec<String> = motion.links.iter().map(|l| labels(&motion, l)).collect();
    assert_eq!(links, ["A B", "E G", "G F"]);
}

/// The lever's slot reaches from where the crank's pin is nearest to Q to where it is farthest, 70
/// and 170 mm, and a twentieth of the drawing farther, wherever the lever's frame lies.
#[test]
fn a_slot_turns_with_its_body() {
    let aslant = QUICK_RETURN
        .replace(
            "ends = [\"Q\", \"B\"]\nlength = \"240 mm\"",
            "points = { Q = [\"30 mm\", \"40 mm\"], B = [\"174 mm\", \"232 mm\"] }",
        )
        .replace(
            "centre = [\"120 mm\", \"0 mm\"]",
            "centre = [\"102 mm\", \"136 mm\"]",
        )
        .replace("lever = \"67 deg\"", "lever = \"14 deg\"");
    for text in [QUICK_RETURN, &aslant] {
        let motion = drawn(&read(text), 4);
        let [slot, guide] = motion.guides[..] else {
            panic!("a slot and a guide");
        };
        let named = Motion {
            points: motion.points[..6].to_vec(),
            ..motion.clone()
        };
        let slack = 0.05 * named.size();
        for k in 0..5 {
            let a = motion.points[3].at(k);
            let l = a[0].hypot(a[1]);
            for (end, s) in slot.into_iter().zip([0.07 - slack, 0.17 + slack]) {
                let end = &motion.points[end];
                assert!(end.label.is_empty() && !end.pivot && end.path.len() == 5);
                assert_near(end.at(k), [s * a[0] / l, s * a[1] / l], "slot");
            }
            // The block at A, of 7 by 4 % of the drawing at that time, lies along the lever.
            let corners = motion.plates[0].iter().map(|c| motion.points[*c].at(k));
            let corners: Vec<[f64; 2]> = corners.collect();
            let middle = [0, 1].map(|i| corners.iter().map(|c| c[i]).sum::<f64>() / 4.0);
            assert_near(middle, a, "block");
            let [x, y] = [0, 1].map(|i| corners[1][i] - corners[0][i]);
            assert!((x * a[1] - y * a[0]).abs() < 1e-12 && x * a[0] + y * a[1] > 0.0);
        }
        let c = motion.points[5].path.iter().map(|p| p[0]);
        let (low, high) = (c.clone().fold(0.0, f64::min), c.fold(0.0, f64::max));
        let [from, to] = guide.map(|k| motion.points[k].path[0]);
        assert!(from[0] < low && high < to[0]);
        assert!((from[1] - 0.26).abs() < 1e-12 && (to[1] - 0.26).abs() < 1e-12);
    }
}

/// Wheels that roll on each other share the distance of their centres as their teeth say; that of a
/// rack has its radius.
#[test]
fn pitch_circles_touch() {
    let circles = |motion: &Motion| -> Vec<([f64; 2], f64)> {
        let of = |w: &Wheel| (motion.points[w.centre].at(1), w.radius);
        motion.wheels.iter().map(of).collect()
    };
    let check = |motion: &Motion, due: &[([f64; 2], f64)]| {
        let found = circles(motion);
        assert_eq!(found.len(), due.len(), "{found:?}");
        for ((at, radius), (centre, r)) in found.into_iter().zip(due) {
            assert_near(at, *centre, "centre");
            assert!((radius - r).abs() < 1e-14, "{radius} {r}");
        }
    };
    // On the wheel of 4 cm the rack moves as well: one circle.
    let motion = drawn(&read(RACK), 4);
    check(&motion, &[([0.35, 0.0], 0.06), ([0.45, 0.0], 0.04)]);
    // The wheel alone has no other point that shows how it turns: a spoke.
    assert_eq!(motion.links.len(), 4);
    let [hub, rim] = motion.links[3];
    assert_eq!(hub, motion.wheels[1].centre);
    let [a, b] = [hub, rim].map(|k| motion.points[k].at(1));
    assert!(((a[0] - b[0]).hypot(a[1] - b[1]) - 0.04).abs() < 1e-14);
    // Another radius is another circle; its sign says only which way the rack moves.
    let other = drawn(
        &read(&RACK.replace("radius = \"4 cm\"", "radius = \"-3 cm\"")),
        4,
    );
    check(
        &other,
        &[
            ([0.35, 0.0], 0.06),
            ([0.45, 0.0], 0.04),
            ([0.45, 0.0], 0.03),
        ],
    );
    // Inside a wheel of 60 teeth one of 20: at 10 cm 15 cm and 5 cm.
    for (teeth, radii) in [("[20, 60]", [0.05, 0.15]), ("[60, 20]", [0.15, 0.05])] {
        let inside = format!("teeth = {teeth}\ninternal = true");
        let text = RACK.replace("teeth = [30, 20]", &inside);
        let motion = drawn(&read(&text), 4);
        let [rocker, wheel] = radii;
        check(
            &motion,
            &[
                ([0.35, 0.0], rocker),
                ([0.45, 0.0], wheel),
                ([0.45, 0.0], 0.04),
            ],
        );
    }
    // As large as each other inside each other they have no circle.
    let same = RACK.replace("teeth = [30, 20]", "teeth = [7, 7]\ninternal = true");
    check(&drawn(&read(&same), 4), &[([0.45, 0.0], 0.04)]);
}

/// A planet on an arm: the circles' centres are the pins on the arm, the planet's goes round with
/// it. The sun turns as the arm does, which needs no circles.
#[test]
fn planets_are_drawn_on_their_carrier() {
    let pins = ["O", "P"].map(|p| format!("[[joint]]\nkind = \"pin\"\npoint = \"{p}\"\n"));
    let text = format!(
        "type = \"planar\"\n[ground.points]\nO = [\"0 m\", \"0 m\"]\n\
         [[body]]\nname = \"arm\"\nends = [\"O\", \"P\"]\nlength = \"3 m\"\n\
         [[body]]\nname = \"sun\"\npoints = {{ O = [\"0 m\", \"0 m\"] }}\n\
         [[body]]\nname = \"planet\"\npoints = {{ P = [\"0 m\", \"0 m\"], Q = [\"1 m\", \"0 m\"] }}\n{}\
         [[joint]]\nkind = \"gears\"\nwheels = [\"arm\", \"sun\"]\nteeth = [1, 1]\ninternal = true\n\
         [[joint]]\nkind = \"gears\"\nwheels = [\"sun\", \"planet\"]\ncarrier = \"arm\"\nteeth = [40, 20]\n\
         [drive]\nbody = \"arm\"\n",
        pins.concat()
    );
    let motion = drawn(&read(&text), 4);
    let [sun, planet] = motion.wheels[..] else {
        panic!("two wheels");
    };
    assert!((sun.radius - 2.0).abs() < 1e-14 && (planet.radius - 1.0).abs() < 1e-14);
    // Two points show how the planet turns; the sun has one.
    let [[hub, rim]] = motion.links[2..] else {
        panic!("a spoke");
    };
    assert_eq!(hub, sun.centre);
    for k in 0..5 {
        let (sin, cos) = (90.0 * k as f64).to_radians().sin_cos();
        assert_near(motion.points[hub].at(k), [0.0, 0.0], "sun");
        assert_near(motion.points[rim].at(k), [2.0 * cos, 2.0 * sin], "rim");
        assert_near(
            motion.points[planet.centre].at(k),
            [3.0 * cos, 3.0 * sin],
            "planet",
        );
    }
    // A pin apart from the carrier carries nothing.
    let apart = text.replace("carrier = \"arm\"\n", "");
    assert!(drawn(&read(&apart), 4).wheels.is_empty());
}
