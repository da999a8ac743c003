//! Tests of `bodies`.

use super::*;

fn read(sections: &str) -> Result<Bodies, Refusal> {
    let source = Source::toml(format!("drive = {{ body = \"bar\" }}\n{sections}"));
    Bodies::new(&source, &source.parse().unwrap())
}

fn refusal(sections: &str) -> Refusal {
    read(sections).err().expect(sections)
}

/// Names, coordinates and whether there are exact ones.
fn of_body(bodies: &Bodies, body: usize) -> Vec<(&str, [f64; 2], bool)> {
    let points = bodies.outlines().swap_remove(body);
    let exact = bodies.exact().swap_remove(body);
    let names = bodies.points[body].iter().map(|p| &*p.0);
    assert_eq!((points.len(), names.len()), (exact.len(), exact.len()));
    let all = names.zip(points).zip(exact);
    all.map(|((name, (also, point)), (same, exact))| {
        assert_eq!((&*also, point), (name, same));
        assert_eq!(point.body, body);
        let at = point.at.map(|x| x.m());
        if let Some(exact) = &exact {
            // A third corner by sides is computed in floating point; other points are rounded once.
            let off = |(x, at): (&Real, f64)| (x.to_ball(64).to_f64() - at).abs();
            assert!(
                exact.iter().zip(at).all(|x| off(x) < 1e-15 * 15.0),
                "{name}"
            );
            let rounded =
                |(x, at): (&Real, f64)| x.fraction().is_some_and(|x| nearest_f64(x) == at);
            assert!(name == "C" || exact.iter().zip(at).all(rounded), "{name}");
        }
        (name, at, exact.is_some())
    })
    .collect()
}

#[test]
fn names_have_letters_digits_and_few_signs() {
    let long = "x".repeat(40);
    for name in ["A", "B-1_'", "9", "ä", &long] {
        assert!(
            read(&format!(
                "[ground.points]\n\"{name}\" = [\"1 m\", \"2 m\"]\n"
            ))
            .is_ok()
        );
    }
    let longer = "x".repeat(41);
    for name in ["", "A B", "A.B", "A?", "(B)", &longer] {
        for (sections, place) in [
            (
                format!("[ground.points]\n\"{name}\" = [\"1 m\", \"2 m\"]\n"),
                "ground.points",
            ),
            (format!("[ground]\ndrawn = [\"{name}\"]\n"), "ground.drawn"),
            (format!("[[body]]\nname = \"{name}\"\n"), "body[0].name"),
            (
                format!("[[body]]\nname = \"bar\"\ndrawn = [\"{name}\"]\n"),
                "body[0].drawn",
            ),
            (
                format!("[[body]]\nname = \"bar\"\nends = [\"{name}\", \"B\"]\nlength = \"1 m\"\n"),
                "body[0].ends",
            ),
            (
                format!("[[body]]\nname = \"bar\"\nends = [\"B\", \"{name}\"]\nlength = \"1 m\"\n"),
                "body[0].ends",
            ),
            (
                format!(
                    "[[body]]\nname = \"bar\"\nends = [\"A\", \"B\", \"{name}\"]\nsides = [\"1 m\", \"1 m\", \"1 m\"]\n"
                ),
                "body[0].ends",
            ),
            (
                format!(
                    "[[body]]\nname = \"bar\"\npoints = {{ \"{name}\" = [\"1 m\", \"2 m\"] }}\n"
                ),
                "body[0].points",
            ),
        ] {
            let refused = refusal(&sections);
            let rule = refused.to_string();
            assert!(rule.contains("must be a name"), "{rule}");
            assert_eq!(refused.place(), place, "{rule}");
        }
    }
}

/// The law of cosines: from the first end along the first side, the third end on its left unless
/// clockwise.
#[test]
fn three_sides_are_a_triangle() {
    for (sides, clockwise, third) in [
        ([4.0, 13.0, 15.0], false, [9.0, 12.0]),
        ([4.0, 13.0, 15.0], true, [9.0, -12.0]),
        ([0.5, 0.3, 0.4], false, [0.32, 0.24]),
        ([0.625, 1.625, 1.5], false, [0.0, 1.5]),
        // Flat ones, with the third end at either side of the first two or between them.
        ([3.0, 1.0, 2.0], false, [2.0, 0.0]),
        ([2.0, 1.0, 3.0], true, [3.0, 0.0]),
        ([1.0, 3.0, 2.0], false, [-2.0, 0.0]),
    ] {
        let [ab, bc, ca] = sides;
        let text = format!(
            "[[body]]\nname = \"plate\"\nends = [\"A\", \"B\", \"C\"]\nclockwise = {clockwise}\n\
             sides = [\"{ab} m\", \"{bc} m\", \"{ca} m\"]\n"
        );
        let bodies = read(&text).unwrap();
        let points = of_body(&bodies, 1);
        assert_eq!(points[..2], [("A", [0.0; 2], true), ("B", [ab, 0.0], true)]);
        let (name, [x, y], exact) = points[2];
        assert_eq!((name, exact, points.len()), ("C", true, 3));
        let apart = (x - third[0]).hypot(y - third[1]);
        assert!(apart < 1e-15 * 15.0, "{sides:?}: {x} {y}");
        assert_eq!((bodies.lines[1], bodies.drawn[1]), (0.0, false));
    }
    for sides in [
        [4.0, 1.0, 2.0],
        [1.0, 4.0, 2.0],
        [1.0, 2.0, 4.0],
        [0.0, 1.0, 1.0],
        [-1.0, 1.0, 1.0],
    ] {
        let [ab, bc, ca] = sides;
        let refused = refusal(&format!(
            "[[body]]\nname = \"plate\"\nends = [\"A\", \"B\", \"C\"]\nsides = [\"{ab} m\", \"{bc} m\", \"{ca} m\"]\n"
        ));
        assert!(refused.to_string().contains("no triangle"), "{sides:?}");
        assert_eq!(refused.place(), "body[0].sides");
    }
}

#[test]
fn bodies_have_ends_and_points() {
    let text = |length: &str| {
        format!(
            "[[body]]\nname = \"bar\"\nends = [\"A\", \"B\"]\nlength = \"{length}\"\n\
             points = {{ C = [\"3 cm\", \"-2 mm\"] }}\n"
        )
    };
    let bodies = read(&text("50 cm")).unwrap();
    let due = [
        ("A", [0.0, 0.0], true),
        ("B", [0.5, 0.0], true),
        ("C", [0.03, -0.002], true),
    ];
    assert_eq!(of_body(&bodies, 1), due);
    assert_eq!((bodies.lines[1], bodies.drawn[1]), (0.0, false));
    for length in ["0 m", "-1 m"] {
        let refused = refusal(&text(length));
        assert!(refused.to_string().contains("length must be positive"));
        assert_eq!(refused.place(), "body[0].length");
    }
    let alone = read("[[body]]\nname = \"bar\"\npoints = { C = [\"1 m\", \"2 m\"] }\n").unwrap();
    assert_eq!(of_body(&alone, 1), [("C", [1.0, 2.0], true)]);
    let sides = "sides = [\"1 m\", \"1 m\", \"1 m\"]";
    for keys in [
        "ends = [\"A\"]\nlength = \"1 m\"".to_string(),
        "ends = [\"A\", \"B\"]".to_string(),
        format!("ends = [\"A\", \"B\"]\n{sides}"),
        format!("ends = [\"A\", \"B\"]\nlength = \"1 m\"\n{sides}"),
        "ends = [\"A\", \"B\", \"C\"]\nlength = \"1 m\"".to_string(),
        "length = \"1 m\"".to_string(),
        sides.to_string(),
    ] {
        let refused = refusal(&format!("[[body]]\nname = \"bar\"\n{keys}\n")).to_string();
        let due = "body[0]: two ends with length, or three ends with sides";
        assert!(refused.ends_with(due), "{refused}");
    }
    let nothing = refusal("[[body]]\nname = \"bar\"\n").to_string();
    assert!(nothing.ends_with("body[0] has no points, ends or drawn"));
}

/// The first point drawn is the origin of the body's frame, which lies as the ground's.
#[test]
fn bodies_are_drawn() {
    let points =
        "[points]\nP = [\"1 m\", \"2 m\"]\nQ = [\"4 m\", \"6 m\"]\nR = [\"0 m\", \"9 m\"]\n";
    let text = format!(
        "{points}[ground]\ndrawn = [\"P\"]\npoints = {{ O = [\"3 m\", \"5 m\"] }}\n\
         [[body]]\nname = \"bar\"\ndrawn = [\"P\", \"Q\", \"R\"]\n\
         [[body]]\nname = \"back\"\ndrawn = [\"Q\", \"P\"]\n\
         [[body]]\nname = \"one\"\ndrawn = [\"Q\"]\n"
    );
    let bodies = read(&text).unwrap();
    assert_eq!(bodies.names, ["ground", "bar", "back", "one"]);
    for (body, due) in [
        (0, &[("O", [3.0, 5.0], true), ("P", [1.0, 2.0], true)][..]),
        (
            1,
            &[
                ("P", [0.0, 0.0], true),
                ("Q", [3.0, 4.0], true),
                ("R", [-1.0, 7.0], true),
            ],
        ),
        (2, &[("Q", [0.0, 0.0], true), ("P", [-3.0, -4.0], true)]),
        (3, &[("Q", [0.0, 0.0], true)]),
    ] {
        assert_eq!(of_body(&bodies, body), due);
    }
    assert_eq!(bodies.drawn, [true; 4]);
    let lines = [0.0, 4f64.atan2(3.0), (-4f64).atan2(-3.0), 0.0];
    assert_eq!(bodies.lines, lines);
    for keys in [
        "drawn = [\"P\"]\nends = [\"A\", \"B\"]\nlength = \"1 m\"",
        "drawn = [\"P\"]\npoints = { A = [\"1 m\", \"1 m\"] }",
    ] {
        let refused = refusal(&format!("{points}[[body]]\nname = \"bar\"\n{keys}\n")).to_string();
        assert!(refused.contains("drawn stands alone"), "{refused}");
    }
    for (sections, place) in [
        ("[ground]\ndrawn = [\"P\", \"X\"]\n", "ground.drawn"),
        (
            "[[body]]\nname = \"bar\"\ndrawn = [\"P\", \"X\"]\n",
            "body[0].drawn",
        ),
        (
            "[[body]]\nname = \"bar\"\ndrawn = [\"X\", \"P\"]\n",
            "body[0].drawn",
        ),
    ] {
        let refused = refusal(&format!("{points}{sections}"));
        assert_eq!(refused.place(), place);
        assert!(refused.to_string().ends_with("\"X\" is not in [points]"));
    }
}

#[test]
fn no_name_stands_twice() {
    let bar = |name: &str, rest: &str| {
        format!("[[body]]\nname = \"{name}\"\nends = [\"A\", \"B\"]\nlength = \"1 m\"\n{rest}")
    };
    let again = "points = { A = [\"1 m\", \"1 m\"] }\n";
    let other = "points = { C = [\"1 m\", \"1 m\"] }\n";
    for (sections, place, rule) in [
        (
            bar("ground", ""),
            "body[0].name",
            "body[0].name = \"ground\" is taken",
        ),
        (
            bar("a", "") + &bar("b", "") + &bar("a", ""),
            "body[2].name",
            "body[2].name = \"a\" is taken",
        ),
        (
            bar("a", other) + &bar("b", again),
            "body[1]",
            "b has the point \"A\" twice",
        ),
        (bar("a", again), "body[0]", "a has the point \"A\" twice"),
        (
            "[points]\nP = [\"1 m\", \"2 m\"]\n[ground]\ndrawn = [\"P\"]\n\
             points = { O = [\"3 m\", \"5 m\"], P = [\"3 m\", \"5 m\"] }\n"
                .to_string(),
            "ground",
            "ground has the point \"P\" twice",
        ),
    ] {
        let refused = refusal(&sections);
        assert_eq!(refused.place(), place);
        assert!(refused.to_string().ends_with(rule), "{refused}");
    }
    assert!(read(&(bar("a", other) + &bar("b", other))).is_ok());
}

#[test]
fn points_are_found_by_name_or_by_body_and_name() {
    let text = "[ground.points]\nO = [\"0 m\", \"7 m\"]\nS = [\"5 m\", \"0 m\"]\n\
                [[body]]\nname = \"lever\"\npoints = { B = [\"1 m\", \"0 m\"], O = [\"2 m\", \"0 m\"], Z = [\"8 m\", \"0 m\"] }\n\
                [[body]]\nname = \"rod\"\npoints = { A = [\"9 m\", \"0 m\"], B = [\"3 m\", \"0 m\"], S = [\"4 m\", \"0 m\"] }\n";
    let bodies = read(text).unwrap();
    let source = Source::toml(text);
    let point = |body: usize, x: f64, y: f64| Point::from_m(body, [x, y]);
    for (name, due) in [
        ("O", point(0, 0.0, 7.0)),
        ("ground.O", point(0, 0.0, 7.0)),
        ("lever.O", point(1, 2.0, 0.0)),
        ("B", point(1, 1.0, 0.0)),
        ("rod.B", point(2, 3.0, 0.0)),
        ("A", point(2, 9.0, 0.0)),
    ] {
        let found = bodies.point(&source, "force[0].at", name).unwrap();
        assert_eq!(found, due, "{name}");
    }
    for (name, part) in [
        ("X", "force[0].at = \"X\" is no point of a body"),
        ("lever.A", "force[0].at = \"lever.A\" is no point of a body"),
        (
            "levr.A",
            "force[0].at = \"levr\" is no body (did you mean \"lever\"?)",
        ),
    ] {
        let refused = bodies.point(&source, "force[0].at", name).unwrap_err();
        assert!(refused.to_string().contains(part), "{refused}");
    }
    let all = [point(0, 0.0, 7.0), point(1, 2.0, 0.0)];
    assert_eq!(bodies.all("O"), all);
    assert_eq!(bodies.all("X"), []);
    assert_eq!(bodies.on(1, "A"), None);
    assert_eq!(bodies.find(&source, "drive.body", "rod").unwrap(), 2);
    assert_eq!(bodies.find(&source, "drive.body", "ground").unwrap(), 0);
    // By name, each once; O and S have a place on the ground.
    let moving: Vec<(String, Point)> = [
        ("A", point(2, 9.0, 0.0)),
        ("B", point(1, 1.0, 0.0)),
        ("Z", point(1, 8.0, 0.0)),
    ]
    .map(|(name, p)| (name.to_string(), p))
    .into();
    assert_eq!(bodies.moving(), moving);
}
