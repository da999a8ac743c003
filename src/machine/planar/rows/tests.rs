//! Tests of `rows`.

use super::*;
use crate::machine::Source;
use crate::machine::planar::{Branch, choose};

const QUICK_RETURN: &str = include_str!("../../../../examples/quick-return.toml");
const RACK: &str = include_str!("../../../../examples/rack-and-wheel.toml");
const BOOM: &str = include_str!("../../../../examples/cylinder-boom.toml");
const WATT: &str = include_str!("../../../../examples/watt-1.toml");
const SCREEN: &str = include_str!("../../../../examples/sand-screen-bodies.toml");

fn read(text: &str) -> Machine {
    Machine::read(&Source::toml(text)).unwrap()
}

/// The branch that the file means, from its own start or half a radian.
fn branch(machine: &Machine) -> Branch {
    let at = machine.start.at.unwrap_or(30.0);
    let at = if machine.rotary() {
        at.to_radians()
    } else {
        at
    };
    choose(machine, at, None).unwrap()
}

fn words(text: &str) -> Vec<String> {
    text.split_whitespace().map(String::from).collect()
}

/// The patterns with each of the names in place of their stars.
fn around(names: &str, patterns: &str) -> String {
    let of = |name: &str| patterns.replace('*', name);
    let all: Vec<String> = names.split(' ').map(of).collect();
    all.join(" ")
}

#[test]
fn columns_have_names_with_units() {
    let all = Columns {
        paths: true,
        reactions: true,
    };
    let paths = Columns {
        paths: true,
        reactions: false,
    };
    let rates = "*_deg omega_*_rad_per_s epsilon_*_rad_per_s2";
    let by_angle = "*_deg d*_dphi d2*_dphi_2_per_rad";
    let path = "x_*_m y_*_m dx_*_dphi_m_per_rad d2x_*_dphi_2_m_per_rad2 \
                dy_*_dphi_m_per_rad d2y_*_dphi_2_m_per_rad2";
    let moving =
        "x_*_m y_*_m v_x_*_m_per_s a_x_*_m_per_s2 v_y_*_m_per_s a_y_*_m_per_s2 curvature_*_per_m";
    let reduced = "I_n_kg_m2 dI_n_dphi_kg_m2_per_rad M_o_N_m dM_o_dphi_N_m_per_rad";
    for (text, columns, due) in [
        (
            QUICK_RETURN.to_string(),
            all,
            [
                "phi_deg branch",
                &around("crank lever link ram", rates),
                &around("slot guide", "s_*_m v_s_*_m_per_s a_s_*_m_per_s2"),
                reduced,
                "drive_N_m",
                &around("A B C", moving),
                &around("O_crank Q_lever B_link C_ram slot_crank guide_ram", "Fx_*_N Fy_*_N"),
                "M_guide_ram_N_m",
            ]
            .join(" "),
        ),
        (
            QUICK_RETURN.replace("speed = \"60 rpm\"", ""),
            Columns::default(),
            [
                "phi_deg branch",
                &around("crank lever link ram", by_angle),
                &around("slot guide", "s_*_m ds_*_dphi_m_per_rad d2s_*_dphi_2_m_per_rad2"),
                reduced,
            ]
            .join(" "),
        ),
        (
            RACK.to_string(),
            all,
            [
                "phi_deg branch",
                &around("crank coupler rocker wheel rack", by_angle),
                "s_guide_m ds_guide_dphi_m_per_rad d2s_guide_dphi_2_m_per_rad2",
                &around("A B S0", &format!("{path} curvature_*_per_m")),
                &around("O_crank A_coupler B_rocker C_rocker N_wheel guide_rack", "Fx_*_N Fy_*_N"),
                "M_guide_rack_N_m",
            ]
            .join(" "),
        ),
        (
            BOOM.to_string(),
            all,
            [
                "s_m branch",
                &around("boom barrel rod", rates),
                "s_cylinder_m v_s_cylinder_m_per_s a_s_cylinder_m_per_s2",
                "m_n_kg dm_n_ds_kg_per_m F_o_N dF_o_ds_N_per_m drive_N",
                &around("R T", moving),
                &around("O_boom P_barrel R_rod cylinder_rod", "Fx_*_N Fy_*_N"),
                "M_cylinder_rod_N_m",
            ]
            .join(" "),
        ),
        (
            BOOM.replace("speed = \"0.05 m/s\"", ""),
            paths,
            [
                "s_m branch",
                &around("boom barrel rod", "*_deg d*_ds_rad_per_m d2*_ds_2_rad_per_m2"),
                "s_cylinder_m ds_cylinder_ds d2s_cylinder_ds_2_per_m",
                "m_n_kg dm_n_ds_kg_per_m F_o_N dF_o_ds_N_per_m",
                &around(
                    "R T",
                    "x_*_m y_*_m dx_*_ds d2x_*_ds_2_per_m dy_*_ds d2y_*_ds_2_per_m curvature_*_per_m",
                ),
            ]
            .join(" "),
        ),
        // Both dyads have three pins; a group of four bodies is none.
        (
            WATT.to_string(),
            Columns::default(),
            [
                "phi_deg branch",
                &around("crank coupler rocker EG FG", by_angle),
                "transmission_coupler_rocker_deg transmission_EG_FG_deg",
            ]
            .join(" "),
        ),
        (
            SCREEN.to_string(),
            Columns::default(),
            [
                "phi_deg branch",
                &around("1 2 3 4 5", rates),
                reduced,
                "drive_N_m",
            ]
            .join(" "),
        ),
    ] {
        let machine = read(&text);
        let due = words(&due);
        assert_eq!(names(&machine, columns), due);
    }
    let watt = read(WATT);
    let angles = format!(
        "phi_deg branch {}",
        around("crank coupler rocker EG FG", by_angle)
    );
    assert_eq!(certified_names(&watt, false), words(&angles));
    let points: Vec<&str> = watt.points.iter().map(|p| &*p.0).collect();
    let with_paths = format!("{angles} {}", around(&points.join(" "), path));
    assert_eq!(certified_names(&watt, true), words(&with_paths));
}

/// A value by its column.
fn value(machine: &Machine, columns: Columns, state: &State, name: &str) -> f64 {
    let loads = machine.loads_on(state);
    let all = values(machine, loads.as_ref(), state, columns);
    let names = names(machine, columns);
    assert_eq!(names.len(), all.len() + 2);
    all[names.iter().position(|n| n == name).expect(name) - 2]
}

/// First derivatives are slopes of the values, second ones slopes of the first, of all values that
/// have both.
#[test]
fn derivatives_are_slopes() {
    let columns = Columns {
        paths: true,
        reactions: false,
    };
    let slow = QUICK_RETURN.replace("speed = \"60 rpm\"", "");
    let boom = BOOM.replace("speed = \"0.05 m/s\"", "");
    let (h, mut checked) = (1e-4, 0);
    for text in [&slow, RACK, &boom, WATT] {
        let machine = read(text);
        let branch = branch(&machine);
        let middle = machine.solver.drive_of(&branch.start) + 0.05;
        let at = |drive: f64| machine.solver.follow(&branch.start, drive).unwrap();
        let row = |state: &State| {
            let loads = machine.loads_on(state);
            values(&machine, loads.as_ref(), state, columns)
        };
        let [before, here, after] = [-h, 0.0, h].map(|d| row(&at(middle + d)));
        let names = names(&machine, columns);
        assert_eq!(names.len(), here.len() + 2);
        let names = &names[2..];
        let find = |name: &str| names.iter().position(|n| n.starts_with(name));
        let by = if machine.rotary() { "dphi" } else { "ds" };
        for (k, name) in names.iter().enumerate() {
            let stem = ["_deg", "_kg_m2", "_N_m", "_kg", "_N", "_m"]
                .iter()
                .find_map(|unit| name.strip_suffix(unit))
                .unwrap_or(name);
            let Some(first) = find(&format!("d{stem}_{by}")) else {
                continue;
            };
            let degrees = if name.ends_with("_deg") {
                1f64.to_radians()
            } else {
                1.0
            };
            let slope = |k: usize| (after[k] - before[k]) / (2.0 * h);
            let near = |x: f64, due: f64| (x - due).abs() < 2e-6 * (1.0 + due.abs());
            assert!(near(slope(k) * degrees, here[first]), "{name}");
            if let Some(second) = find(&format!("d2{stem}_{by}")) {
                assert!(near(slope(first), here[second]), "{name}");
            }
            checked += 1;
        }
    }
    assert!(checked > 50, "{checked}");
}

/// At a speed w and an acceleration e of the drive: x′ w and x″ w² + x′ e; the drive's power is
/// that of inertia less loads.
#[test]
fn rates_are_derivatives_at_the_drives_speed() {
    let columns = Columns {
        paths: true,
        reactions: false,
    };
    for (text, speed, motion, [w, e]) in [
        (
            QUICK_RETURN,
            "speed = \"60 rpm\"",
            "speed = \"3 rad/s\"\nacceleration = \"5 rad/s^2\"",
            [3.0, 5.0],
        ),
        (
            BOOM,
            "speed = \"0.05 m/s\"",
            "speed = \"0.25 m/s\"\nacceleration = \"-2 m/s^2\"",
            [0.25, -2.0],
        ),
    ] {
        let still = read(&text.replace(speed, ""));
        let moved = read(&text.replace(speed, motion));
        assert_eq!((still.speed, moved.speed), (None, Some([w, e])));
        let state = branch(&still).start;
        let [x, y] = [&still, &moved].map(|machine| {
            let loads = machine.loads_on(&state);
            values(machine, loads.as_ref(), &state, columns)
        });
        let names = names(&still, columns);
        let mut k = 0;
        for (j, name) in names[2..].iter().enumerate() {
            if name.starts_with("d2") {
                let due = x[j] * w * w + x[j - 1] * e;
                assert!((y[k] - due).abs() < 1e-12 * (1.0 + due.abs()), "{name}");
            } else if name.starts_with('d')
                && !name.starts_with("dI")
                && !name.starts_with("dM")
                && !name.starts_with("dm_n")
                && !name.starts_with("dF")
            {
                assert!((y[k] - x[j] * w).abs() < 1e-12, "{name}");
            } else {
                assert_eq!(y[k], x[j], "{name}");
            }
            k += 1;
            // The drive stands behind the four reduced values.
            if name.starts_with("dM_o") || name.starts_with("dF_o") {
                let [inertia, slope, moment] = [x[j - 3], x[j - 2], x[j - 1]];
                let due = inertia * e + 0.5 * slope * w * w - moment;
                assert!((y[k] - due).abs() < 1e-12 * (1.0 + due.abs()), "drive");
                k += 1;
            }
        }
        assert_eq!(k, y.len());
    }
}

/// Lines are shown within half a turn of zero, wherever the branch has been followed to.
#[test]
fn angles_are_shown_within_half_a_turn() {
    let machine = read(QUICK_RETURN);
    let branch = branch(&machine);
    let turn = std::f64::consts::TAU;
    let start = machine.solver.drive_of(&branch.start);
    for degrees in [-900.0, -179.0, 179.0, 540.5, 720.0] {
        let state = machine
            .solver
            .follow(&branch.start, start + f64::to_radians(degrees));
        let shown = value(&machine, Columns::default(), &state.unwrap(), "crank_deg");
        let due = f64::to_radians(degrees) - turn * (f64::to_radians(degrees) / turn).round();
        let apart = (shown - due.to_degrees()).abs();
        assert!(shown.abs() <= 180.0 + 1e-9, "{degrees} {shown}");
        assert!(
            apart < 1e-9 || (apart - 360.0).abs() < 1e-9,
            "{degrees} {shown}"
        );
    }
}

/// The force of a pin on its first body is that on the next with the other sign: the link without
/// mass is pulled along its axis, and the ram's guide bears its weight.
#[test]
fn forces_hold_the_bodies_in_balance() {
    let columns = Columns {
        paths: true,
        reactions: true,
    };
    let machine = read(QUICK_RETURN);
    let state = branch(&machine).start;
    let of = |name: &str| value(&machine, columns, &state, name);
    let [bx, by, cx, cy] = ["Fx_B_link_N", "Fy_B_link_N", "Fx_C_ram_N", "Fy_C_ram_N"].map(of);
    assert!((bx - cx).abs() < 1e-9 && (by - cy).abs() < 1e-9);
    let (sin, cos) = of("link_deg").to_radians().sin_cos();
    assert!((bx * sin - by * cos).abs() < 1e-9 && bx.hypot(by) > 1.0);
    let [gx, gy, moment] = ["Fx_guide_ram_N", "Fy_guide_ram_N", "M_guide_ram_N_m"].map(of);
    // Nothing cuts at the start.
    assert!((cx + gx - 5.0 * of("a_x_C_m_per_s2")).abs() < 1e-9);
    assert!((cy + gy - 5.0 * 9.80665).abs() < 1e-9);
    assert!(gx.abs() < 1e-9 && moment.abs() < 1e-9);
}

/// Without the place where teeth meet no force is determined.
#[test]
fn forces_of_gears_are_not_numbers() {
    let text = RACK.replacen(
        "length = \"30 cm\"\n",
        "length = \"30 cm\"\nmass = \"1 kg\"\ncentre = [\"0 m\", \"0 m\"]\n",
        1,
    );
    let columns = Columns {
        paths: false,
        reactions: true,
    };
    let machine = read(&text);
    let state = branch(&machine).start;
    for name in names(&machine, columns) {
        if name.starts_with('F') || name.starts_with("M_guide") {
            assert!(value(&machine, columns, &state, &name).is_nan(), "{name}");
        }
    }
}
