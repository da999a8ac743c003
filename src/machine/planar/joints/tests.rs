//! Tests of `joints`.

use super::*;

const BODIES: &str = "[ground.points]\nO = [\"0 m\", \"0 m\"]\nS = [\"1 m\", \"2 m\"]\n\
    [[body]]\nname = \"a\"\n\
    points = { O = [\"0 m\", \"0 m\"], A = [\"1 m\", \"0 m\"], P = [\"4 m\", \"4 m\"] }\n\
    [[body]]\nname = \"b\"\npoints = { A = [\"0 m\", \"0 m\"], Q = [\"0 m\", \"3 m\"] }\n\
    [[body]]\nname = \"c\"\npoints = { R = [\"0 m\", \"0 m\"] }\n";

const PINS: &str =
    "[[joint]]\nkind = \"pin\"\npoint = \"O\"\n[[joint]]\nkind = \"pin\"\npoint = \"A\"\n";

/// The parts that a slide needs and those it may have.
const SLIDE: [&str; 7] = [
    "body = \"c\"",
    "point = \"R\"",
    "through = \"S\"",
    "direction = \"30 deg\"",
    "turn = \"10 deg\"",
    "name = \"rail\"",
    "kind = \"slide\"",
];

fn joint(lines: &[&str]) -> String {
    format!("[[joint]]\n{}\n", lines.join("\n"))
}

fn with_drive(
    joints: &str,
    drive: &str,
) -> Result<(Description, Vec<String>, DriveMotion), Refusal> {
    let source = Source::toml(format!("{BODIES}{joints}[drive]\n{drive}\n"));
    let file: File = source.parse()?;
    let bodies = Bodies::new(&source, &file)?;
    let (description, names) = read(&source, &file, &bodies)?;
    let rotary = matches!(description.drive, Drive::Angle { .. });
    let section = file.drive.as_ref().expect("a drive");
    let motion = super::drive(&source, section, rotary)?;
    Ok((description, names, motion))
}

fn joints(text: &str) -> Result<(Vec<Joint>, Vec<String>), Refusal> {
    let (description, names, _) = with_drive(text, "body = \"a\"")?;
    let of = |j: Named<Joint>| j.part;
    Ok((description.joints.into_iter().map(of).collect(), names))
}

fn refusal(joints: &str, drive: &str) -> Refusal {
    with_drive(joints, drive).err().expect(joints)
}

#[test]
fn each_kind_of_joint_is_read() {
    let text = [
        PINS,
        &joint(&[
            "kind = \"slide\"",
            SLIDE[0],
            SLIDE[1],
            SLIDE[2],
            SLIDE[3],
            SLIDE[4],
        ]),
        &joint(&[
            "kind = \"slot\"",
            "name = \"groove\"",
            "body = \"b\"",
            "point = \"Q\"",
            "on = \"a\"",
            "through = \"A\"",
            "toward = \"P\"",
        ]),
        &joint(&[
            "kind = \"gears\"",
            "wheels = [\"a\", \"b\"]",
            "teeth = [10, 20]",
            "phase = \"5 deg\"",
        ]),
        &joint(&[
            "kind = \"gears\"",
            "wheels = [\"b\", \"c\"]",
            "teeth = [30, 20]",
            "carrier = \"a\"",
            "internal = true",
        ]),
        &joint(&[
            "kind = \"gears\"",
            "wheels = [\"a\", \"c\"]",
            "teeth = [1, 4]",
            "internal = false",
        ]),
        &joint(&[
            "kind = \"rack\"",
            "wheel = \"b\"",
            "slide = \"slide-3\"",
            "radius = \"-2 m\"",
            "offset = \"50 cm\"",
        ]),
        &joint(&[
            "kind = \"rack\"",
            "wheel = \"a\"",
            "slide = \"slide-3\"",
            "radius = \"1 m\"",
        ]),
    ]
    .concat();
    let (found, names) = joints(&text).unwrap();
    let due = "O A slide-3 groove gears-5 gears-6 gears-7 rack-8 rack-9";
    assert_eq!(names.join(" "), due);
    let point = Point::from_m;
    let (m, deg) = (Length::from_m, Angle::from_deg);
    let due = [
        Joint::Pin {
            points: vec![point(0, [0.0, 0.0]), point(1, [0.0, 0.0])],
        },
        Joint::Pin {
            points: vec![point(1, [1.0, 0.0]), point(2, [0.0, 0.0])],
        },
        Joint::Slide {
            slider: point(3, [0.0, 0.0]),
            guide: Guide {
                origin: point(0, [1.0, 2.0]),
                direction: deg(30.0),
            },
            turn: deg(10.0),
        },
        // Along (3, 4) on its body.
        Joint::Slot {
            pin: point(2, [0.0, 3.0]),
            slot: Guide {
                origin: point(1, [1.0, 0.0]),
                direction: Angle::from_rad(4f64.atan2(3.0)),
            },
        },
        Joint::Gears {
            wheels: [1, 2],
            carrier: 0,
            ratio: -0.5,
            phase: deg(5.0),
        },
        Joint::Gears {
            wheels: [2, 3],
            carrier: 1,
            ratio: 1.5,
            phase: deg(0.0),
        },
        Joint::Gears {
            wheels: [1, 3],
            carrier: 0,
            ratio: -0.25,
            phase: deg(0.0),
        },
        Joint::Rack {
            wheel: 2,
            slide: 2,
            radius: m(-2.0),
            phase: m(0.5),
        },
        Joint::Rack {
            wheel: 1,
            slide: 2,
            radius: m(1.0),
            phase: m(0.0),
        },
    ];
    assert_eq!(found, due);
    let without_turn = [PINS, &joint(&[&SLIDE[..4], &SLIDE[6..]].concat())].concat();
    let (found, names) = joints(&without_turn).unwrap();
    assert_eq!(names[2], "slide-3");
    assert!(matches!(&found[2], Joint::Slide { turn, .. } if turn.rad() == 0.0));
}

/// Each kind takes its own keys and no others, and needs all but those that have a default.
#[test]
fn kinds_have_their_keys() {
    let keys = [
        ("point", "\"R\""),
        ("body", "\"c\""),
        ("on", "\"ground\""),
        ("through", "\"S\""),
        ("toward", "\"O\""),
        ("direction", "\"30 deg\""),
        ("turn", "\"10 deg\""),
        ("wheels", "[\"a\", \"b\"]"),
        ("carrier", "\"ground\""),
        ("teeth", "[1, 2]"),
        ("internal", "true"),
        ("phase", "\"1 deg\""),
        ("wheel", "\"a\""),
        ("slide", "\"rail\""),
        ("radius", "\"1 m\""),
        ("offset", "\"1 m\""),
    ];
    let before = [PINS, &joint(&SLIDE)].concat();
    let on_a_guide = "body point through direction";
    for (kind, needed, allowed) in [
        ("slide", on_a_guide, "on turn"),
        ("slot", on_a_guide, "on"),
        ("gears", "wheels teeth", "carrier internal phase"),
        ("rack", "wheel slide radius", "offset"),
    ] {
        let given = |names: &[&str]| {
            let of = |name: &&str| {
                let (_, value) = keys.iter().find(|k| k.0 == *name).unwrap();
                format!("{name} = {value}")
            };
            let lines: Vec<String> = names.iter().map(of).collect();
            format!(
                "{before}[[joint]]\nkind = \"{kind}\"\n{}\n",
                lines.join("\n")
            )
        };
        let needed: Vec<&str> = needed.split(' ').collect();
        assert!(joints(&given(&needed)).is_ok(), "{kind}");
        for k in 0..needed.len() {
            let rest = [&needed[..k], &needed[k + 1..]].concat();
            let refused = refusal(&given(&rest), "body = \"a\"");
            let due = match needed[k] {
                "direction" => "joint[3]: either direction or toward".to_string(),
                key => format!("joint[3]: a {kind} needs {key}"),
            };
            assert!(refused.to_string().ends_with(&due), "{refused}");
            assert_eq!(refused.place(), "joint[3]");
        }
        for (key, _) in keys.iter().filter(|k| !needed.contains(&k.0)) {
            let with = [&needed[..], &[*key]].concat();
            let found = joints(&given(&with));
            let refused = match found {
                Ok(_) => {
                    assert!(allowed.split(' ').any(|k| k == *key), "{kind} {key}");
                    continue;
                }
                Err(refused) => refused,
            };
            let (place, due) = match (kind, *key) {
                ("slide" | "slot", "toward") => (
                    "joint[3]".to_string(),
                    "joint[3]: either direction or toward".to_string(),
                ),
                _ => (
                    format!("joint[3].{key}"),
                    format!("joint[3]: a {kind} has no {key}"),
                ),
            };
            assert_eq!(refused.place(), place, "{refused}");
            assert!(refused.to_string().ends_with(&due), "{refused}");
        }
    }
    // A pin has a point alone.
    let needs = refusal("[[joint]]\nkind = \"pin\"\n", "body = \"a\"");
    assert!(needs.to_string().ends_with("joint[0]: a pin needs point"));
    for (key, value) in &keys[1..] {
        let text = format!("[[joint]]\nkind = \"pin\"\npoint = \"O\"\n{key} = {value}\n");
        let refused = refusal(&text, "body = \"a\"");
        assert_eq!(refused.place(), format!("joint[0].{key}"));
        let due = format!("joint[0]: a pin has no {key}");
        assert!(refused.to_string().ends_with(&due), "{refused}");
    }
}

#[test]
fn joints_that_hold_nothing_are_refused() {
    let slide = |from: &str, to: &str| {
        let text = joint(&SLIDE).replacen(from, to, 1);
        assert_ne!(text, joint(&SLIDE));
        [PINS, &text].concat()
    };
    let gears = |teeth: &str| {
        let lines = ["kind = \"gears\"", "wheels = [\"a\", \"b\"]", teeth];
        [PINS, &joint(&lines)].concat()
    };
    for (text, place, rule) in [
        (
            "[[joint]]\nkind = \"pin\"\npoint = \"X\"\n".to_string(),
            "joint[0]",
            "point = \"X\" is on 0 body; a pin joins all bodies that have the point",
        ),
        (
            "[[joint]]\nkind = \"pin\"\npoint = \"P\"\n".to_string(),
            "joint[0]",
            "point = \"P\" is on 1 body; a pin joins all bodies that have the point",
        ),
        (
            [PINS, "[[joint]]\nkind = \"pin\"\npoint = \"O\"\n"].concat(),
            "joint[2]",
            "joint[2]: a joint with the name \"O\" stands before it",
        ),
        (
            slide("name = \"rail\"", "name = \"A\""),
            "joint[2]",
            "joint[2]: a joint with the name \"A\" stands before it",
        ),
        (
            slide("\"R\"", "\"S\""),
            "joint[2].point",
            "joint[2].point = \"S\" is no point of c",
        ),
        (
            slide("through = \"S\"", "through = \"R\""),
            "joint[2].through",
            "joint[2].through = \"R\" is no point of ground",
        ),
        (
            slide("direction = \"30 deg\"", "toward = \"R\""),
            "joint[2].toward",
            "joint[2].toward = \"R\" is no point of ground",
        ),
        (
            slide("direction = \"30 deg\"", "toward = \"S\""),
            "joint[2]",
            "joint[2]: through and toward are one point",
        ),
        (
            slide("body = \"c\"", "body = \"d\""),
            "joint[2].body",
            "joint[2].body = \"d\" is no body",
        ),
        (
            slide("name = \"rail\"", "on = \"d\""),
            "joint[2].on",
            "joint[2].on = \"d\" is no body",
        ),
        (
            gears("teeth = [1, 2]\ncarrier = \"d\""),
            "joint[2].carrier",
            "joint[2].carrier = \"d\" is no body",
        ),
        (
            gears("teeth = [0, 2]"),
            "joint[2]",
            "joint[2]: teeth must be positive",
        ),
        (
            gears("teeth = [2, 0]"),
            "joint[2]",
            "joint[2]: teeth must be positive",
        ),
        (
            gears("teeth = [1, 2]").replace("\"b\"", "\"d\""),
            "joint[2].wheels",
            "joint[2].wheels = \"d\" is no body",
        ),
        (
            [
                PINS,
                &joint(&[
                    "kind = \"rack\"",
                    "wheel = \"a\"",
                    "slide = \"rail\"",
                    "radius = \"1 m\"",
                ]),
                &joint(&SLIDE),
            ]
            .concat(),
            "joint[2]",
            "joint[2]: slide = \"rail\" is no joint before it",
        ),
    ] {
        let refused = refusal(&text, "body = \"a\"");
        assert!(refused.to_string().contains(rule), "{refused}");
        assert_eq!(refused.place(), place, "{refused}");
    }
    // Upright and level guides have a direction.
    for (toward, due) in [("U", 90.0), ("V", 0.0)] {
        let slide = joint(&["kind = \"slide\"", SLIDE[0], SLIDE[1], SLIDE[2]]);
        let text = [PINS, &slide, &format!("toward = \"{toward}\"\n")].concat();
        let source = Source::toml(format!("{BODIES}{text}[drive]\nbody = \"a\"\n").replacen(
            "[ground.points]\n",
            "[ground.points]\nU = [\"1 m\", \"5 m\"]\nV = [\"3 m\", \"2 m\"]\n",
            1,
        ));
        let file: File = source.parse().unwrap();
        let bodies = Bodies::new(&source, &file).unwrap();
        let (description, _) = read(&source, &file, &bodies).unwrap();
        let Joint::Slide { guide, .. } = &description.joints[2].part else {
            panic!("a slide");
        };
        assert!((guide.direction.deg() - due).abs() < 1e-12);
    }
}

/// A name on several bodies is a point that a joint holds on each of them, or it is meant to be
/// another.
#[test]
fn points_of_one_name_are_held() {
    let slot = |body: &str, point: &str, on: &str, through: &str| {
        joint(&[
            "kind = \"slot\"",
            &format!("body = \"{body}\""),
            &format!("point = \"{point}\""),
            &format!("on = \"{on}\""),
            &format!("through = \"{through}\""),
            "direction = \"0 deg\"",
        ])
    };
    let pin = |point: &str| format!("[[joint]]\nkind = \"pin\"\npoint = \"{point}\"\n");
    for text in [
        PINS.to_string(),
        pin("O") + &slot("b", "A", "a", "A"),
        pin("A") + &slot("a", "O", "ground", "O"),
    ] {
        assert!(joints(&text).is_ok(), "{text}");
    }
    for (text, due) in [
        (
            pin("A"),
            "ground and a have a point \"O\", and no joint holds that of ground",
        ),
        (
            pin("O"),
            "a and b have a point \"A\", and no joint holds that of a",
        ),
        (
            pin("O") + &slot("b", "A", "a", "P"),
            "a and b have a point \"A\", and no joint holds that of a",
        ),
        (
            pin("O") + &slot("b", "Q", "a", "A"),
            "a and b have a point \"A\", and no joint holds that of b",
        ),
        (
            pin("O")
                + &joint(&[
                    "kind = \"gears\"",
                    "wheels = [\"a\", \"b\"]",
                    "teeth = [1, 1]",
                ]),
            "a and b have a point \"A\", and no joint holds that of a",
        ),
    ] {
        let refused = refusal(&text, "body = \"a\"");
        assert!(refused.to_string().ends_with(due), "{refused}");
        assert_eq!(refused.place(), "joint");
    }
}

#[test]
fn drives_are_angles_or_displacements() {
    let text = [PINS, &joint(&SLIDE)].concat();
    let range = "range = [\"1 m\", \"3 m\"]\nstep = \"50 cm\"";
    let along = |more: &str| format!("joint = \"rail\"\n{more}");
    let angle = |body, from| Drive::Angle { body, from };
    let window = Some([1.0, 3.0, 0.5]);
    for (drive, due, speed, window) in [
        ("body = \"b\"".to_string(), angle(2, 0), None, None),
        (
            "body = \"b\"\nfrom = \"a\"".to_string(),
            angle(2, 1),
            None,
            None,
        ),
        (
            "body = \"b\"\nspeed = \"3 rad/s\"".to_string(),
            angle(2, 0),
            Some([3.0, 0.0]),
            None,
        ),
        (
            "body = \"b\"\nspeed = \"3 rad/s\"\nacceleration = \"-4 rad/s^2\"".to_string(),
            angle(2, 0),
            Some([3.0, -4.0]),
            None,
        ),
        (along(range), Drive::Displacement { joint: 2 }, None, window),
        (
            along(&format!(
                "{range}\nspeed = \"20 cm/s\"\nacceleration = \"5 m/s^2\""
            )),
            Drive::Displacement { joint: 2 },
            Some([0.2, 5.0]),
            window,
        ),
        (
            along("range = [\"0 m\", \"1000 km\"]\nstep = \"1 m\"").replace("1000 km", "1000000 m"),
            Drive::Displacement { joint: 2 },
            None,
            Some([0.0, 1e6, 1.0]),
        ),
        (
            along("range = [\"2 m\", \"2 m\"]\nstep = \"1 m\""),
            Drive::Displacement { joint: 2 },
            None,
            Some([2.0, 2.0, 1.0]),
        ),
    ] {
        let (description, _, motion) = with_drive(&text, &drive).unwrap();
        assert_eq!(description.drive, due, "{drive}");
        assert_eq!((motion.speed, motion.window), (speed, window), "{drive}");
    }
    let ascends =
        "drive.range must ascend, and drive.step be positive and give at most a million rows";
    let bounds = |from: &str, to: &str, step: &str| {
        along(&format!(
            "range = [\"{from}\", \"{to}\"]\nstep = \"{step}\""
        ))
    };
    for (drive, place, rule) in [
        (String::new(), "drive", "drive needs either body"),
        (along("body = \"a\""), "drive", "drive needs either body"),
        (
            "joint = \"O2\"".to_string(),
            "drive.joint",
            "drive.joint = \"O2\" is no joint",
        ),
        (
            "body = \"d\"".to_string(),
            "drive.body",
            "drive.body = \"d\" is no body",
        ),
        (
            "body = \"a\"\nfrom = \"d\"".to_string(),
            "drive.from",
            "drive.from = \"d\" is no body",
        ),
        (
            "body = \"a\"\nrange = [\"1 m\", \"3 m\"]".to_string(),
            "drive",
            "are for a displacement",
        ),
        (
            "body = \"a\"\nstep = \"1 m\"".to_string(),
            "drive",
            "are for a displacement",
        ),
        (along(""), "drive", "needs range and step"),
        (along("step = \"1 m\""), "drive", "needs range and step"),
        (
            along("range = [\"1 m\", \"3 m\"]"),
            "drive",
            "needs range and step",
        ),
        (bounds("3 m", "1 m", "1 m"), "drive.range", ascends),
        (bounds("1 m", "3 m", "0 m"), "drive.range", ascends),
        (bounds("1 m", "3 m", "-1 m"), "drive.range", ascends),
        (bounds("3 m", "1 m", "-1 m"), "drive.range", ascends),
        (bounds("0 m", "1000001 m", "1 m"), "drive.range", ascends),
        (bounds("0 m", "1e310 m", "1e309 m"), "drive.range", ascends),
        (bounds("-1e310 m", "0 m", "1 m"), "drive.range", ascends),
        (
            "body = \"a\"\nacceleration = \"1 rad/s^2\"".to_string(),
            "drive.acceleration",
            "drive.acceleration needs drive.speed",
        ),
        (
            "body = \"a\"\nspeed = \"1 m/s\"".to_string(),
            "drive.speed",
            "drive.speed = \"1 m/s\" is not an angular velocity",
        ),
        (
            along(&format!("{range}\nspeed = \"1 rad/s\"")),
            "drive.speed",
            "drive.speed = \"1 rad/s\" is not a velocity",
        ),
        (
            "body = \"a\"\nspeed = \"1 rad/s\"\nacceleration = \"1 m/s^2\"".to_string(),
            "drive.acceleration",
            "drive.acceleration = \"1 m/s^2\" is not an angular acceleration",
        ),
        (
            along(&format!(
                "{range}\nspeed = \"1 m/s\"\nacceleration = \"1 rad/s^2\""
            )),
            "drive.acceleration",
            "drive.acceleration = \"1 rad/s^2\" is not an acceleration",
        ),
    ] {
        let refused = refusal(&text, &drive);
        assert!(refused.to_string().contains(rule), "{drive}: {refused}");
        assert_eq!(refused.place(), place, "{drive}: {refused}");
    }
}

#[test]
fn values_of_the_drive_are_degrees_or_metres() {
    let source = Source::toml("");
    let value = |text: &str, rotary: bool| drive_value(&source, "start.at", text, rotary);
    for (text, rotary, due) in [
        ("30 deg", true, 30.0),
        ("-2 rev", true, -720.0),
        ("0.5 rad", true, 0.5f64.to_degrees()),
        ("12 mm", false, 0.012),
    ] {
        assert_eq!(value(text, rotary).unwrap(), due, "{text}");
    }
    for (text, rotary, part) in [
        ("1 m", true, "start.at = \"1 m\" is not an angle"),
        ("1 deg", false, "start.at = \"1 deg\" is not a length"),
    ] {
        let refused = value(text, rotary).unwrap_err();
        assert!(refused.to_string().contains(part), "{refused}");
    }
}
