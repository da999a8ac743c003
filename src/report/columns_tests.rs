//! Tests of `columns`.

use super::*;

fn of(names: &[&str], units: &str, certified: bool) -> Result<Columns, String> {
    let names = names.iter().map(|n| n.to_string()).collect();
    let units: Vec<String> = units.split(',').map(String::from).collect();
    Columns::of(names, &units, certified).map_err(|e| e.to_string())
}

#[test]
fn names_and_values_change_together() {
    for (name, units, new, x, due) in [
        ("slider_m", "mm", "slider_mm", 0.25, 250.0),
        ("slider_m", "inch", "slider_inch", 0.0254, 1.0),
        ("slider_m", "μm", "slider_um", 0.25, 250_000.0),
        ("phi1_deg", "rad", "phi1_rad", 180.0, std::f64::consts::PI),
        ("phi1_deg", "rev", "phi1_rev", 90.0, 0.25),
        (
            "omega_rad_per_s",
            "°",
            "omega_deg_per_s",
            std::f64::consts::PI,
            180.0,
        ),
        (
            "omega_rad_per_s",
            "rpm",
            "omega_rpm",
            std::f64::consts::TAU,
            60.0,
        ),
        (
            "omega_rad_per_s",
            "min^-1",
            "omega_1_per_min",
            std::f64::consts::TAU,
            60.0,
        ),
        (
            "omega_rad_per_s",
            "Hz,ms",
            "omega_Hz",
            std::f64::consts::TAU,
            1.0,
        ),
        ("I_kg_m2", "g,cm", "I_g_cm2", 2.0, 2e7),
        (
            "dM_o_dphi_N_m_per_rad",
            "kN,mm",
            "dM_o_dphi_kN_mm_per_rad",
            3.0,
            3.0,
        ),
        ("a_m_per_s2", "mm,ms", "a_mm_per_ms2", 1000.0, 1.0),
        ("det_J_m4", "cm", "det_J_cm4", 1e-8, 1.0),
        (
            "d2phi2_dphi1_2_per_rad",
            "deg",
            "d2phi2_dphi1_2_per_deg",
            180.0,
            std::f64::consts::PI,
        ),
    ] {
        let others = ["t_s", "phi_deg", "w_rad_per_s"];
        let columns = of(&[&[name], &others[..]].concat(), units, false).unwrap();
        assert_eq!(columns.names[0], new, "{units}");
        let Cell::Float(y) = columns.cell(0, &Cell::Float(x)) else {
            panic!("{name}");
        };
        assert!((y - due).abs() <= 1e-15 * due, "{name}: {y}");
    }
    let columns = of(&["work_J", "condition", "t_s"], "ms", false).unwrap();
    assert_eq!(columns.names, ["work_J", "condition", "t_ms"]);
}

#[test]
fn certified_digits_stay() {
    let columns = of(&["x_m", "phi_deg"], "mm,deg", true).unwrap();
    let cell = |d: &str| columns.cell(0, &Cell::Decimal(d.into())).text();
    for (d, due) in [
        ("0.10037863300", "100.37863300"),
        ("-0.00012", "-0.12"),
        ("12", "12000"),
        ("1.50e-7", "1.50e-4"),
        ("0", "0"),
    ] {
        assert_eq!(cell(d), due);
    }
    assert_eq!(shifted("12.5", -3), "0.0125");
    let e = of(&["x_m", "phi_deg"], "inch", true).err().unwrap();
    assert!(e.contains("no power of ten"), "{e}");
}

#[test]
fn units_of_no_use_are_refused() {
    for (units, part) in [
        ("kg", "no column can be in kg; the columns are x_m, phi_deg"),
        ("mm,cm", "mm and cm measure the same"),
        ("furlong", "\"furlong\" is not a unit known here"),
        ("m/s", "is a product"),
        ("mm^2", "is a product"),
        ("N·m", "is a product"),
        ("rpm", "no column can be in rpm"),
        ("", "; there are "),
    ] {
        let e = of(&["x_m", "phi_deg"], units, false).err().unwrap();
        assert!(e.contains(part), "{units}: {e}");
    }
}
