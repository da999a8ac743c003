//! `mechaudit linkage` for mechanisms of bodies and joints, as its user meets it.

use crate::common::{cells, changed, column, command, csv, refused, run_on, said, texts, words};

const JANSEN: &str = include_str!("../../examples/jansen-leg.toml");
const QUICK: &str = include_str!("../../examples/quick-return.toml");

fn close(x: f64, y: f64, by: f64) {
    assert!((x - y).abs() <= by * (1.0 + y.abs()), "{x} {y}");
}

/// The columns of a point.
fn point(table: &str, name: &str) -> Vec<[f64; 2]> {
    let [x, y] = ["x", "y"].map(|c| column(table, &format!("{c}_{name}_m")));
    x.into_iter().zip(y).map(|(x, y)| [x, y]).collect()
}

#[test]
fn every_example_says_what_it_is() {
    let examples = r#"
        andrews            | K2, K3 (dyad, order 2)                            | 4 | turns fully
        double-butterfly   | CE, EFG, BFJ, DHI, GH, IJ (Assur group of class 5, order 3) | 8 | turns fully
        n-four-bar         | crank2, rod1 (dyad, order 2)                      | 3 | 0 deg (change point) to 180 deg (change point)
        jansen-leg         | f, ghi (dyad, order 2)                            | 8 | turns fully
        pmksweb-91         | coupler, rocker (dyad, order 2)                   | 2 | -292.329374714 deg (fold) to -4.319239059 deg (fold)
        pmksweb-92         | DE, EF (dyad, order 2)                            | 4 | 67.283635271 deg (fold) to 78.254148753 deg (fold)
        quick-return       | lever (one body, order 2)                         | 2 | turns fully
        rack-and-wheel     | wheel (one body, order 2); rack (one body, order 2) | 4 | turns fully
        sand-screen-bodies | 2, 3, 4, 5 (Assur group of class 3, order 3)      | 4 | turns fully
        stephenson-1       | EG, FG (dyad, order 2)                            | 4 | turns fully
        stephenson-2       | BD, CE, plate, rocker (Assur group of class 3, order 3) | 4 | from -62.644699709 deg (fold)
        stephenson-3       | BC, plate, FD, GE (Assur group of class 3, order 3) | 6 | from 56.065563439 deg (fold)
        watt-1             | EG, FG (dyad, order 2)                            | 4 | 143.611070242 deg (fold)
        watt-2             | EF, GF (dyad, order 2)                            | 4 | turns fully
    "#;
    for [name, groups, modes, range] in cells(examples) {
        let d = command(&format!("linkage examples/{name}.toml --step-deg 90"));
        assert_eq!(d.code, 0, "{name}: {}", d.err);
        said(&d, &groups);
        said(&d, &format!("{modes} assembly modes "));
        // A change point next to the start, and a rack that turns may move without end.
        let all = match &*name {
            "n-four-bar" | "rack-and-wheel" => "; there may be more",
            _ => ", all that there are",
        };
        said(&d, all);
        said(&d, &range);
    }
}

/// Zinchenko's linkage by its own solver and as bodies and joints.
#[test]
fn the_sand_screen_is_the_same_both_ways() {
    let due = command("linkage examples/sand-screen.toml --step-deg 7.5");
    let d = command("linkage examples/sand-screen-bodies.toml --step-deg 7.5");
    assert_eq!((d.code, due.code), (0, 0), "{}", d.err);
    for (ours, theirs, by) in [
        ("4_deg", "phi4_deg", 1e-13),
        ("omega_4_rad_per_s", "omega4_rad_per_s", 1e-12),
        ("epsilon_5_rad_per_s2", "epsilon5_rad_per_s2", 1e-11),
        ("I_n_kg_m2", "I_n_kg_m2", 1e-12),
        ("dI_n_dphi_kg_m2_per_rad", "dI_n_dphi_kg_m2_per_rad", 1e-11),
        ("M_o_N_m", "M_o_N_m", 1e-12),
        ("dM_o_dphi_N_m_per_rad", "dM_o_dphi_N_m_per_rad", 1e-11),
    ] {
        let (a, b) = (column(&d.out, ours), column(&due.out, theirs));
        assert_eq!((a.len(), b.len()), (48, 48));
        let size = b.iter().fold(0.0f64, |m, x| m.max(x.abs()));
        for (x, y) in a.iter().zip(&b) {
            assert!((x - y).abs() <= by * size, "{ours}: {x} {y}");
        }
    }
}

/// The accelerations at the start that the test set prints.
#[test]
fn andrews_starts_as_published() {
    let d = command("linkage examples/andrews.toml --step-deg 360");
    let [inertia, moment, second] =
        ["I_n_kg_m2", "M_o_N_m", "dK2_dphi"].map(|n| column(&d.out, n)[0]);
    let beta = (moment + 0.033) / inertia;
    close(beta, 14_222.443_919_954_114, 1e-12);
    close((second - 1.0) * beta, -10_666.832_939_965_585, 1e-12);
    for (column_, due) in [
        ("K3_deg", 0.455_279_819_163_070_37),
        ("K5_deg", 0.487_364_979_543_842_56),
        ("K7_deg", 1.230_547_444_549_821_2),
    ] {
        close(column(&d.out, column_)[0].to_radians(), due, 1e-14);
    }
}

/// Driven by its motor for 0.03 s: the certified angle and speed of
/// `reference/values/andrews-motion.csv`, from which the values that the test set prints differ by
/// 7e-11 and 1e-10 of themselves.
#[test]
fn andrews_ends_as_certified() {
    let d = command("runup examples/andrews.toml");
    assert_eq!(d.code, 0, "{}", d.err);
    let (phi, omega) = (
        column(&d.out, "phi1_deg"),
        column(&d.out, "omega_rad_per_s"),
    );
    let [phi, omega] = [phi[phi.len() - 1].to_radians(), omega[omega.len() - 1]];
    close(phi, 15.810_771_195_153_707, 1e-12);
    close(omega, 1_139.920_302_259_106, 1e-12);
    close(phi, 15.810_771_196_299_04, 1e-9);
    close(omega, 1_139.920_302_151_208, 1e-9);
}

#[test]
fn a_drawing_is_a_position() {
    for (name, points) in [
        (
            "pmksweb-91",
            &[
                ("B", [1.244, 0.196]),
                ("C", [-2.32, -2.293]),
                ("E", [-2.591, 1.657]),
            ][..],
        ),
        (
            "pmksweb-92",
            &[
                ("D", [-0.24, 4.01]),
                ("E", [5.08, 5.31]),
                ("F", [8.14, 3.35]),
            ],
        ),
        (
            "double-butterfly",
            &[("J", [4.13, 2.05]), ("I", [4.67, -1.09])],
        ),
    ] {
        let d = command(&format!(
            "linkage examples/{name}.toml --step-deg 400 --paths"
        ));
        for (p, due) in points {
            let at = point(&d.out, p)[0];
            (0..2).for_each(|i| close(100.0 * at[i], due[i], 1e-13));
        }
    }
    // Counter-clockwise at 10 rpm: |v_B| = ω |AB|.
    let d = command("linkage examples/pmksweb-91.toml --step-deg 400 --paths");
    let [x, y] = ["x", "y"].map(|c| column(&d.out, &format!("v_{c}_B_m_per_s"))[0]);
    let arm = [0.01 * (1.244 - 4.1), 0.01 * (0.196 - 3.75)];
    let omega = std::f64::consts::PI / 3.0;
    close(x, -omega * arm[1], 1e-13);
    close(y, omega * arm[0], 1e-13);
}

#[test]
fn a_drive_by_displacement() {
    let d = command("linkage examples/cylinder-boom.toml");
    assert_eq!(d.code, 0, "{}", d.err);
    assert_eq!(texts(&d.out, "s_m").len(), 11);
    // The cylinder is the third side of a triangle.
    let (a, b) = ((0.4f64).hypot(0.6), (1.2f64).hypot(0.1));
    let beta = (-0.6f64).atan2(0.4);
    let delta = (-0.1f64).atan2(1.2);
    for (s, boom) in column(&d.out, "s_m").iter().zip(column(&d.out, "boom_deg")) {
        let angle = ((a * a + b * b - s * s) / (2.0 * a * b)).acos();
        close(boom.to_radians(), beta + angle - delta, 1e-13);
    }
    refused(
        &command("linkage examples/cylinder-boom.toml --from-deg 3"),
        "the drive is a displacement",
    );
    let boom = include_str!("../../examples/cylinder-boom.toml");
    for (from, to) in [
        ("\"1.4 m\"", "\"0.8 m\""),
        ("\"0.05 m\"", "\"0 m\""),
        ("\"0.05 m\"", "\"-0.05 m\""),
        ("\"0.05 m\"", "\"4e-7 m\""),
    ] {
        let d = run_on(changed(boom, from, to), &words("linkage -"));
        refused(&d, "drive.range must ascend");
    }
}

#[test]
fn gears_and_racks_turn_as_their_teeth_say() {
    let d = command("linkage examples/rack-and-wheel.toml --step-deg 20");
    let [rocker, rate, rack] =
        ["drocker_dphi", "dwheel_dphi", "ds_guide_dphi_m_per_rad"].map(|n| column(&d.out, n));
    for k in 0..18 {
        close(rate[k], -1.5 * rocker[k], 1e-13);
        close(rack[k], 0.04 * rate[k], 1e-13);
    }
    let geared = include_str!("../../examples/rack-and-wheel.toml");
    let with = |teeth: &str| {
        let text = changed(geared, "teeth = [30, 20]", &format!("teeth = {teeth}"));
        run_on(text, &words("linkage - --step-deg 90"))
    };
    for teeth in ["[0, 20]", "[30, 0]"] {
        refused(&with(teeth), "teeth must be positive");
    }
    for teeth in ["[1, 20]", "[30, 1]"] {
        let d = with(teeth);
        assert!(!d.err.contains("teeth must be positive"), "{}", d.err);
    }
    let e = command("linkage examples/rack-and-wheel.toml --reactions");
    refused(&e, "--reactions needs masses or loads");
}

#[test]
fn bad_files_are_refused_by_name() {
    let changes = r#"
        length = "50 cm"    | length = "0 cm"     | body[1].length must be positive
        length = "50 cm"    | length = "50"       | body[1].length
        length = "50 cm"    | length = "50 kg"    | is not a length
        ends = ["M", "X"]   | ends = ["M"]        | two ends with length, or three ends with sides
        "55.8 cm"           | "155.8 cm"          | no triangle has these sides
        name = "j"          | name = "crank"      | is taken
        name = "j"          | name = "a b"        | must be a name
        name = "j"          | name = ""           | must be a name
        name = "j"          | name = "abcdefghijklmnopqrstuvwxyzabcdefghijklmno" | must be a name
        point = "W"         | point = "W"\nteeth = [1, 2] | a pin has no teeth
        point = "W"         | point = "V"         | point = "V" is on 0 body
        point = "W"         | point = "F"         | point = "F" is on 1 body
        kind = "pin"        | kind = "pinn"       | must be one of
        body = "crank"      | body = "crnk"       | is no body (did you mean "crank"?)
        body = "crank"      | bdy = "crank"       | unknown field `bdy`
        [drive]             | [[joint]]\nkind = "slide"\nbody = "j"\npoint = "X"\nthrough = "O"\n[drive] | either direction or toward
        [drive]             | [[spring]]\nends = ["X", "Q"]\nstiffness = "1 N/m"\nlength = "1 m"\n[drive] | "Q" is no point of a body
        [drive]             | [[spring]]\nends = ["X", "F"]\nstiffness = "1 N"\nlength = "1 m"\n[drive] | is not a stiffness
        c = "-74 deg"       | c = "-74 deg", q = "1 deg" | start.near.q
        bde = "70 deg"      | bde = "170 deg"     | within 15 deg of start.near; there are 0: crank
    "#;
    for [from, to, part] in cells(changes) {
        let d = run_on(
            changed(JANSEN, &from, &to),
            &words("linkage - --step-deg 90"),
        );
        refused(&d, &part);
    }
    // A pin that is forgotten is not a point that moves by itself.
    let text = changed(JANSEN, "[[joint]]\nkind = \"pin\"\npoint = \"W\"\n", "");
    refused(
        &run_on(text, &words("linkage -")),
        "f and ghi have a point \"W\", and no joint holds that of f",
    );
    let longest = format!("name = \"{}\"", "j".repeat(40));
    let d = run_on(
        changed(JANSEN, "name = \"j\"", &longest),
        &words("linkage - --step-deg 90"),
    );
    assert_eq!(d.code, 0, "{}", d.err);
    let text = changed(QUICK, "toward = \"B\"", "toward = \"B\"\nturn = \"1 deg\"");
    refused(&run_on(text, &words("linkage -")), "a slot has no turn");
    // Beside joints that hold other points.
    let text = changed(
        QUICK,
        "\"260 mm\"]",
        "\"260 mm\"], X = [\"1 mm\", \"0 mm\"]",
    );
    let text = changed(&text, "{ C = ", "{ X = [\"0 mm\", \"9 mm\"], C = ");
    refused(
        &run_on(text, &words("linkage -")),
        "have a point \"X\", and no joint holds that of",
    );
    for option in ["--reactions", "--branch 9"] {
        let d = run_on(JANSEN, &words(&format!("linkage - {option}")));
        refused(
            &d,
            option
                .split(' ')
                .next()
                .unwrap()
                .trim_start_matches("--branch"),
        );
    }
    refused(
        &run_on(JANSEN, &words("runup -")),
        "the section [motor] is missing",
    );
}

#[test]
fn what_cannot_move_or_moves_too_much_is_told() {
    let more = |text: &str| run_on(format!("{JANSEN}\n{text}"), &words("linkage -"));
    let bar = "[[body]]\nname = \"bar\"\nends = [\"M\", \"F\"]\nlength = \"90 cm\"\n";
    let d = more(&format!(
        "{bar}[[joint]]\nkind = \"pin\"\nname = \"m2\"\npoint = \"F\"\n"
    ));
    assert_eq!(d.code, 2);
    // The pin M takes the new bar as well: one bar too many.
    assert!(
        d.err.contains("over-constrained") || d.err.contains("locked"),
        "{}",
        d.err
    );
    let loose = "[[body]]\nname = \"bar\"\nends = [\"F\", \"T\"]\nlength = \"90 cm\"\n[[joint]]\nkind = \"pin\"\npoint = \"F\"\n";
    let d = more(loose);
    refused(
        &d,
        "with the drive held, bar can still move, in 1 degree of freedom",
    );
    said(&d, "line ");
}

#[test]
fn linkages_of_class_iii_have_no_paths() {
    for asked in ["--paths", "--reactions"] {
        refused(
            &command(&format!("linkage examples/sand-screen.toml {asked}")),
            &format!("{asked} is not for files with type = \"class-iii\""),
        );
    }
    let d = command("linkage examples/four-bar.toml --paths --from-deg 0 --to-deg 0");
    assert_eq!(d.code, 0, "{}", d.err);
    assert!((column(&d.out, "x_A_m")[0] - 0.1).abs() < 1e-15);
    refused(
        &command("linkage examples/four-bar.toml --reactions"),
        "--reactions needs masses, in [bodies.…], and crank_speed in the file",
    );
    refused(
        &command("linkage examples/four-bar.toml --paths --digits 9"),
        "--paths has no certified digits with type = \"four-bar\"",
    );
}

#[test]
fn columns_in_other_units() {
    let d = run_on(QUICK, &words("linkage - --units mm --step-deg 90"));
    assert_eq!(d.code, 0, "{}", d.err);
    assert_eq!(texts(&d.out, "s_guide_mm").len(), 4);
}

/// A four-bar with a crank of 1 m that turns fully, or a parallelogram.
fn four_bar(coupler: &str, rocker: &str, frame: &str, drive: &str) -> String {
    let body = |name: &str, ends: &str, length: &str| {
        format!("[[body]]\nname = \"{name}\"\nends = [{ends}]\nlength = \"{length}\"\n")
    };
    let pin = |name: &str| format!("[[joint]]\nkind = \"pin\"\npoint = \"{name}\"\n");
    [
        "type = \"planar\"\n".into(),
        format!("[ground]\npoints = {{ A = [\"0 m\", \"0 m\"], D = [\"{frame}\", \"0 m\"] }}\n"),
        body("crank", "\"A\", \"B\"", "1 m"),
        body("coupler", "\"B\", \"C\"", coupler),
        body("rocker", "\"D\", \"C\"", rocker),
        ["A", "B", "C", "D"].map(pin).concat(),
        format!("[drive]\n{drive}\n"),
    ]
    .concat()
}

/// A crank beyond half a turn, and a coupler driven against the crank that it is pinned to.
#[test]
fn drives_have_certified_digits_over_a_turn_and_against_a_moving_body() {
    for (drive, from, to) in [
        ("body = \"crank\"", 340, 350),
        ("body = \"crank\"", 710, 720),
        ("body = \"coupler\"\nfrom = \"crank\"", 40, 50),
    ] {
        let text = four_bar("3 m", "2.5 m", "3 m", drive);
        let rows = |more: &str| {
            let window = format!("--from-deg {from} --to-deg {to} --step-deg 10 --branch 0");
            let d = run_on(&text, &words(&format!("linkage - {window} {more}")));
            assert_eq!(d.code, 0, "{}", d.err);
            d.out
        };
        let (floats, certified) = (rows(""), rows("--digits 20"));
        let (names, lines) = csv(&certified);
        assert!(lines.len() == 2 && names.len() > 10, "{certified}");
        for name in names {
            for (x, y) in column(&certified, &name).iter().zip(column(&floats, &name)) {
                close(*x, y, 1e-9);
            }
        }
    }
}

/// Where the window has no position, that is said; where it has some, it is not.
#[test]
fn a_window_beyond_the_range_has_no_rows() {
    for (from, some) in [(170, false), (0, true)] {
        let to = from + 1;
        let window = format!("--from-deg {from} --to-deg {to} --step-deg 1");
        let d = command(&format!("linkage examples/peaucellier-cell.toml {window}"));
        assert_eq!(d.code, 0, "{}", d.err);
        assert_eq!(csv(&d.out).1.len(), if some { 2 } else { 0 }, "{}", d.out);
        let none = "no value of the drive asked for lies in that range";
        assert_eq!(d.err.contains(none), !some, "{}", d.err);
    }
}

/// Weight pulls where the file says: M = m g r sin(30° − φ) of a crank alone.
#[test]
fn gravity_has_a_direction() {
    let text = four_bar("3 m", "2.5 m", "3 m", "body = \"crank\"");
    let heavy = "mass = \"2 kg\"\ncentre = [\"0.5 m\", \"0 m\"]\ninertia = \"1 kg m^2\"\nlength";
    let text = changed(&text, "length", heavy);
    let gravity = "gravity = \"10 m/s^2\"\ngravity_direction = \"30 deg\"\n[ground]";
    let text = changed(&text, "[ground]", gravity);
    let d = run_on(text, &words("linkage - --step-deg 45 --branch 0"));
    assert_eq!(d.code, 0, "{}", d.err);
    let moments = column(&d.out, "M_o_N_m");
    for (phi, moment) in column(&d.out, "phi_deg").iter().zip(&moments) {
        close(*moment, 10.0 * (30.0 - phi).to_radians().sin(), 1e-13);
    }
    assert_eq!(moments.len(), 8);
}

/// A singular position has no row in floating point on any branch, and a line says so.
#[test]
fn values_where_branches_meet_are_named_beside_all_branches() {
    let text = four_bar("2 m", "1 m", "2 m", "body = \"crank\"");
    let line = "linkage - --step-deg 90 --all-branches";
    let d = run_on(&text, &words(line));
    assert_eq!(d.code, 0, "{}", d.err);
    assert_eq!(column(&d.out, "phi_deg"), [90.0, 90.0, 270.0, 270.0]);
    said(&d, "at 0 deg (change point), 180 deg (change point)");
    said(&d, "change point at 0 deg: branches 0 and 1 begin there");
    said(&d, "change point at 180 deg: branches 0 and 1 end there");
    let d = run_on(&text, &words(&format!("{line} --format json")));
    let json: serde_json::Value = serde_json::from_str(&d.out).expect("JSON");
    let left_out = json["rows_left_out"].as_array().expect("a list");
    let drives: Vec<_> = left_out.iter().map(|r| r["drive_deg"].as_f64()).collect();
    assert_eq!(drives, [Some(0.0), Some(180.0)]);
}

/// Where branches meet, their number stays open, and that is told.
#[test]
fn a_count_of_modes_that_is_open_is_no_proof() {
    let text = four_bar("2 m", "1 m", "2 m", "body = \"crank\"");
    let line = "linkage - --from-deg 0 --to-deg 90 --step-deg 90 --all-branches --digits 15";
    let d = run_on(text, &words(line));
    assert_eq!(d.code, 1, "{}", d.err);
    said(
        &d,
        "undecided at 0 deg whether these are all assembly modes",
    );
    said(&d, "proved for 1 of 2 values of the drive");
    // Cells that stay open are counted, too.
    let cells = d.out.matches("undecided").count();
    let open = format!("undecided: {} values could not be certified", cells + 1);
    assert!(cells > 1 && d.err.contains(&open), "{}{}", d.out, d.err);
}

/// The counts of modes of the six-bars and of the disputed drawings, proved; what floating point
/// found are these.
#[test]
fn all_modes_are_proved() {
    let counts = r#"
        watt-1       | 4
        watt-2       | 4
        stephenson-1 | 4
        stephenson-2 | 4
        stephenson-3 | 6
        pmksweb-91   | 2
        pmksweb-92   | 4
    "#;
    for [name, count] in cells(counts) {
        let d = command(&format!(
            "linkage examples/{name}.toml --step-deg 360 --all-branches --digits 15"
        ));
        assert_eq!(d.code, 0, "{name}: {}", d.err);
        said(
            &d,
            "proved for 1 of 1 values of the drive: these are all assembly modes",
        );
        assert_eq!(texts(&d.out, "branch").len().to_string(), count, "{name}");
    }
}

/// The four-bar of issue 91, whose coupler turns by 65 degrees for one of the crank: continuation
/// by steps that are proved stays on the branch with rows 10 degrees apart, where taking the
/// nearest position does not.
#[test]
fn rows_far_apart_stay_on_the_branch() {
    let at = |step: u32| {
        command(&format!(
            "linkage examples/pmksweb-91.toml --from-deg -288.785 --to-deg -8.785 --step-deg {step} --paths"
        ))
    };
    let (fine, coarse) = (at(1), at(10));
    assert_eq!((fine.code, coarse.code), (0, 0), "{}", coarse.err);
    let [due, found] = [&fine, &coarse].map(|d| point(&d.out, "C"));
    assert!(found.len() >= 28 && due.len() > 10 * (found.len() - 1));
    for (k, c) in found.iter().enumerate() {
        (0..2).for_each(|i| close(c[i], due[10 * k][i], 1e-11));
    }
}

/// A crank and dyads one after the other: rods of these lengths from pin to pin, arms from the
/// ground.
fn chain(crank: &str, dyads: &[[&str; 3]]) -> String {
    let pins = |names: &[String]| -> String {
        let each = names.iter();
        each.map(|n| format!("[[joint]]\nkind = \"pin\"\npoint = \"{n}\"\n"))
            .collect()
    };
    let body = |name: &str, a: &str, b: &str, length: &str| {
        format!("[[body]]\nname = \"{name}\"\nends = [\"{a}\", \"{b}\"]\nlength = \"{length}\"\n")
    };
    let (mut ground, mut names) = (vec!["O = [\"0 m\", \"0 m\"]".to_string()], vec![]);
    let mut bodies = body("crank", "O", "A0", crank);
    names.extend(["O".to_string(), "A0".to_string()]);
    for (k, [rod, arm, at]) in dyads.iter().enumerate() {
        let (from, to, p) = (format!("A{k}"), format!("A{}", k + 1), format!("P{k}"));
        bodies += &body(&format!("rod{k}"), &from, &to, rod);
        bodies += &body(&format!("arm{k}"), &p, &to, arm);
        ground.push(format!("{p} = [\"{at}\", \"0 m\"]"));
        names.extend([to, p]);
    }
    let ground = ground.join(", ");
    format!(
        "type = \"planar\"\n[ground]\npoints = {{ {ground} }}\n{bodies}{}[drive]\nbody = \"crank\"\n",
        pins(&names)
    )
}

#[test]
fn of_many_modes_some_are_listed() {
    let dyads = ["3 m", "6 m", "9 m", "12 m", "15 m"].map(|at| ["4 m", "4 m", at]);
    let d = run_on(chain("1 m", &dyads), &["linkage", "-", "--from-deg", "20"]);
    refused(&d, "19: ");
    said(&d, "; 12 more");
    assert!(!d.err.contains("20: "), "{}", d.err);
}

/// At 0 degrees the pins are 5 m apart, and the dyad takes 6 to 10: from 39.57 degrees on.
#[test]
fn where_else_it_can_be_assembled_is_told() {
    let d = run_on(
        chain("3 m", &[["8 m", "2 m", "8 m"]]),
        &["linkage", "-", "--from-deg", "180"],
    );
    refused(&d, "but can be at 40 deg");
    let d = run_on(
        chain("3 m", &[["1 m", "1 m", "8 m"]]),
        &["linkage", "-", "--from-deg", "180"],
    );
    refused(&d, "nor at any of 360 values of the drive");
}

const CHANGE_POINT: &str = "type = \"planar\"\n[ground.points]\nO = [\"0 m\", \"0 m\"]\nD = [\"5 m\", \"0 m\"]\n\
    [[body]]\nname = \"crank\"\nends = [\"O\", \"A\"]\nlength = \"1 m\"\n\
    [[body]]\nname = \"coupler\"\nends = [\"A\", \"B\"]\nlength = \"2 m\"\n\
    [[body]]\nname = \"rocker\"\nends = [\"D\", \"B\"]\nlength = \"4 m\"\n\
    [[joint]]\nkind = \"pin\"\npoint = \"O\"\n[[joint]]\nkind = \"pin\"\npoint = \"A\"\n\
    [[joint]]\nkind = \"pin\"\npoint = \"B\"\n[[joint]]\nkind = \"pin\"\npoint = \"D\"\n\
    [drive]\nbody = \"crank\"\n[start]\nat = \"0 deg\"\nmode = 0\n";

/// Branches cross at half a turn, and which one goes on is not defined: there is no row, and a line
/// says so.
#[test]
fn a_change_point_without_a_row_is_named() {
    let line = "no row where the position is singular and branches meet: at 180 deg (change point)";
    for window in [["0", "360"], ["180", "180"]] {
        let args = [
            "linkage",
            "-",
            "--from-deg",
            window[0],
            "--to-deg",
            window[1],
            "--step-deg",
            "1",
        ];
        let d = run_on(CHANGE_POINT, &args);
        assert_eq!(d.code, 0, "{}", d.err);
        said(&d, line);
        said(&d, "(change point) to 180 deg (change point)");
        assert!(!d.err.contains("no value of the drive"), "{}", d.err);
        let d = run_on(CHANGE_POINT, &[&args[..], &["--format", "json"]].concat());
        let json: serde_json::Value = serde_json::from_str(&d.out).unwrap();
        assert_eq!(json["rows_left_out"][0]["drive_deg"], 180.0);
    }
}

/// A wheel with twice the teeth of the rocker that turns it has two positions, which the slider's
/// two double.
#[test]
fn modes_behind_gears_are_counted() {
    let mut text = "type = \"planar\"\n[ground.points]\nA = [\"0 m\", \"0 m\"]\nD = [\"0.1 m\", \"0 m\"]\nN = [\"1.5 m\", \"0 m\"]\n\
        [[body]]\nname = \"crank\"\nends = [\"A\", \"B\"]\nlength = \"0.5 m\"\n\
        [[body]]\nname = \"coupler\"\nends = [\"B\", \"C\"]\nlength = \"0.4 m\"\n\
        [[body]]\nname = \"rocker\"\nends = [\"D\", \"C\"]\nlength = \"0.5 m\"\n\
        [[body]]\nname = \"wheel\"\npoints = { N = [\"0 m\", \"0 m\"], M = [\"0.1 m\", \"0 m\"] }\n\
        [[body]]\nname = \"link\"\nends = [\"M\", \"F\"]\nlength = \"0.7 m\"\n\
        [[body]]\nname = \"out\"\npoints = { F = [\"0 m\", \"0 m\"] }\n"
        .to_owned();
    for point in ["A", "B", "C", "D", "N", "M", "F"] {
        text += &format!("[[joint]]\nkind = \"pin\"\npoint = \"{point}\"\n");
    }
    text += "[[joint]]\nkind = \"gears\"\nwheels = [\"rocker\", \"wheel\"]\nteeth = [20, 40]\n\
        [[joint]]\nkind = \"slide\"\nbody = \"out\"\npoint = \"F\"\nthrough = \"N\"\ndirection = \"0 deg\"\n\
        [drive]\nbody = \"crank\"\n[start]\nat = \"0 deg\"\nmode = 0\n";
    let turns = [
        "linkage",
        "-",
        "--from-deg",
        "0",
        "--to-deg",
        "720",
        "--step-deg",
        "360",
    ];
    let d = run_on(&text, &turns);
    said(
        &d,
        "8 assembly modes at 0 deg, all that there are; this is number 0",
    );
    said(&d, "back in its position after 2 turns");
    let wheel = column(&d.out, "wheel_deg");
    assert!((wheel[0] - wheel[2]).abs() < 1e-9);
    assert!(((wheel[0] - wheel[1]).abs() - 180.0).abs() < 1e-9);
    // After a turn as well its position is one of the modes there.
    let there = |mode: &str| {
        let there = run_on(
            &text,
            &[
                "linkage",
                "-",
                "--from-deg",
                "360",
                "--to-deg",
                "360",
                "--branch",
                mode,
            ],
        );
        column(&there.out, "wheel_deg")[0]
    };
    let modes = ["0", "1", "2", "3", "4", "5", "6", "7"].map(there);
    assert!(
        modes.iter().any(|x| (x - wheel[1]).abs() < 1e-9),
        "{modes:?}"
    );
}
