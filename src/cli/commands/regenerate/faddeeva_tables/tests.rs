use super::*;
use std::f64::consts::{FRAC_2_SQRT_PI, PI};
use std::path::Path;

/// A generated file as it is committed.
fn held(file: &str) -> String {
    let solvers = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).join("src/solvers");
    std::fs::read_to_string(solvers.join(file)).unwrap()
}

const TABLES: &str = "special/faddeeva/tables.rs";

/// Returns the text of a part and its recipe.
fn written(part: impl FnOnce(&mut Tables) -> Outcome<()>) -> (String, String) {
    let mut tables = Tables::default();
    part(&mut tables).unwrap();
    (tables.text, tables.recipe)
}

fn third(bits: u32) -> Ball {
    Ball::rational(bits, &Rational::from((1, 3)))
}

/// Both ends of a ball have to round to one number.
#[test]
fn a_number_is_the_nearest_to_every_point_of_a_ball() {
    assert_eq!(nearest(&Ball::exact(64, 1.5)), Some(1.5));
    assert_eq!(nearest(&third(256)), Some(1.0 / 3.0));
    assert_eq!(nearest(&third(20)), None);
    let zero = nearest(&Ball::integer(64, 0)).unwrap();
    assert_eq!(zero.to_bits(), 0);
    let about_zero = Ball::exact(64, -1e-300).union(&Ball::exact(64, 1e-300));
    assert_eq!(nearest(&about_zero), None);
    let endless = Ball::exact(64, f64::INFINITY);
    assert_eq!(nearest(&endless), None);
    assert_eq!(nearest(&(&Ball::integer(64, 1) / &about_zero)), None);
}

/// Each part is the nearest to what the parts before it leave.
#[test]
fn parts_are_nearest_to_what_is_left() {
    assert_eq!(parts::<1>(&Ball::pi(256)), Some([PI]));
    // 2 (pi/2 - its nearest f64), to 16 digits: 1.2246467991473532e-16.
    assert_eq!(
        parts::<2>(&Ball::pi(256)),
        Some([PI, 1.224_646_799_147_353_2e-16])
    );
    let [a, b, c] = parts::<3>(&third(400)).unwrap();
    // Of 1/3 every part leaves a third of its own last place.
    assert_eq!([b, c], [a * 2f64.powi(-54), a * 2f64.powi(-108)]);
    assert_eq!(parts::<3>(&third(120)), None);
    assert_eq!(parts::<2>(&Ball::exact(64, 0.75)), Some([0.75, 0.0]));
}

#[test]
fn precision_doubles_until_a_rounding_is_decided() {
    let seen = std::cell::RefCell::new(Vec::new());
    let until = |enough: u32| {
        seen.take();
        let found = decided("it", |bits| {
            seen.borrow_mut().push(bits);
            Ok((bits >= enough).then_some(bits))
        });
        (found.map_err(|e| e.to_string()), seen.take())
    };
    assert_eq!(until(0), (Ok(256), vec![256]));
    assert_eq!(until(1000), (Ok(1024), vec![256, 512, 1024]));
    let all = vec![256, 512, 1024, 2048, 4096, 8192];
    assert_eq!(until(8192), (Ok(8192), all.clone()));
    let why = "it: a rounding is undecided at 8192 bits".to_string();
    assert_eq!(until(8193), (Err(why), all));
    let open = Undecided {
        bits: 7,
        reason: "open".into(),
    };
    let due = open.to_string();
    let found: Outcome<()> = decided("it", |_| {
        Err(Undecided {
            bits: 7,
            reason: "open".into(),
        })
    });
    assert_eq!(found.unwrap_err().to_string(), due);
}

/// Coefficient n is `10 + n + (30 + n) i`.
fn coefficients(n: i64) -> Vec<ComplexBall> {
    let one = |n| ComplexBall::new(Ball::integer(256, 10 + n), Ball::integer(256, 30 + n));
    (0..n).map(one).collect()
}

#[test]
fn rows_hold_two_coefficients_in_two_parts_and_the_others_in_blocks() {
    let row = complex_row(&coefficients(10)).unwrap();
    let due = [
        10, 0, 30, 0, 11, 0, 31, 0, // c_0 and c_1
        12, 13, 14, 15, 32, 33, 34, 35, // c_2 to c_5
        16, 17, 18, 19, 36, 37, 38, 39,
    ];
    assert_eq!(row, due.map(f64::from));
    // i^n (a + b i) is a, -b, -a, b, and so on.
    let row = erfcx_row(&coefficients(6)).unwrap();
    assert_eq!(row, [10, 0, -31, 0, -12, 33, 14, -35].map(f64::from));
}

/// A row is undecided as soon as one of its numbers is.
#[test]
fn no_row_has_an_undecided_number() {
    for k in [0, 1, 2, 5] {
        let mut c = coefficients(6);
        c[k] = ComplexBall::new(third(20), third(256));
        assert_eq!(complex_row(&c), None, "{k}");
        c[k] = ComplexBall::new(third(256), third(20));
        assert_eq!(complex_row(&c), None, "{k}");
        c[k] = ComplexBall::new(third(20), third(20));
        assert_eq!(erfcx_row(&c), None, "{k}");
    }
}

/// About a zero `w = c_1 (t + g_0 t² + g_1 t³ + …)`, and `w″ + 2zw′ + 2w = 0`.
#[test]
fn a_row_of_a_zero_is_the_series_about_it() {
    let row = zero_row(1, 256).unwrap().unwrap();
    assert_eq!(row.len(), 6 + 2 * ZERO_TERMS);
    // The first zero of w: 1.991466843 - 1.354810128 i (DLMF 7.13(ii), of erfc).
    assert!((row[0] - 1.991466843).abs() < 1e-9 && (row[3] + 1.354810128).abs() < 1e-9);
    assert!(row[1].abs() < 2f64.powi(-53) && row[2].abs() < 2f64.powi(-106));
    // (n + 2)(n + 1) c_{n+2} = -2 (n + 1) (c_n + z c_{n+1}) in plain complex numbers.
    let z = (row[0], row[3]);
    let mut c = vec![(0.0, 0.0), (1.0, 0.0)];
    for n in 0..ZERO_TERMS {
        let (a, b) = (c[n], c[n + 1]);
        let times = (z.0 * b.0 - z.1 * b.1, z.0 * b.1 + z.1 * b.0);
        let by = -2.0 / (n as f64 + 2.0);
        c.push((by * (a.0 + times.0), by * (a.1 + times.1)));
    }
    let size = |x: (f64, f64)| x.0.hypot(x.1);
    for n in 0..ZERO_TERMS {
        let (block, k) = (6 + 8 * (n / 4), n % 4);
        let (found, due) = ((row[block + k], row[block + 4 + k]), c[n + 2]);
        let off = size((found.0 - due.0, found.1 - due.1));
        assert!(off < 1e-9 * size(due), "{n}: {found:?} for {due:?}");
    }
    // Too few bits for the third parts.
    assert!(zero_row(1, 64).is_err() || zero_row(1, 64).unwrap().is_none());
}

#[test]
fn a_table_has_its_text_its_name_and_its_rows() {
    let (text, recipe) = written(|t| {
        t.open("One line,\n\nand another.", "NAME", "[u8; 2]");
        t.close();
        Ok(())
    });
    let due = "/// One line,\n///\n/// and another.\npub(super) static NAME: [u8; 2] = [\n];\n\n";
    assert_eq!((text.as_str(), recipe.as_str()), (due, "NAME: [u8; 2]\n"));
    // w = 1 + 2iz/√π − z² … about zero.
    let of = |make: fn(&[ComplexBall]) -> Option<Vec<f64>>, centre| {
        let table = Taylor {
            doc: "Rows.".into(),
            name: "NAME",
            kind: "Row",
            centres: vec![centre, (1, -1, 2)],
            make,
        };
        written(|t| t.taylor(&table))
    };
    let head = "/// Rows.\npub(super) static NAME: [Row; 2] = [\n    Row([1.0, 0.0, ";
    let (text, recipe) = of(complex_row, (0, 0, 4));
    assert!(text.starts_with(head), "{text}");
    let slope = format!("0.0, 0.0, 0.0, 0.0, {FRAC_2_SQRT_PI:?}, ");
    assert!(text[head.len()..].starts_with(&slope), "{text}");
    assert!(text.ends_with("]),\n];\n\n") && text.matches("    Row([").count() == 2);
    assert_eq!(
        recipe,
        "NAME: [Row; 2]\nNAME at 0 + 0 i\nNAME at 1/2 + -1/2 i\n"
    );
    let (text, _) = of(erfcx_row, (0, 0, 1));
    let slope = format!("-{FRAC_2_SQRT_PI:?}, ");
    assert!(text[head.len()..].starts_with(&slope), "{text}");
}

/// The centre of a cell is that of its place, and no two cells share one.
#[test]
fn cells_are_where_the_index_says() {
    let cells = cells();
    let places: std::collections::BTreeSet<usize> = cells.iter().map(|c| c.0).collect();
    assert_eq!(places.len(), cells.len());
    for (at, centre) in cells {
        let (from, per) = if at < 512 { (0, 4) } else { (512, 2) };
        let (q, p) = ((at - from) / 32, (at - from) % 32);
        assert_eq!(centre, (p as i64, q as i64, per), "{at}");
    }
}

/// Of the longest tables a few rows are made: where they begin and end, and between.
#[test]
fn tables_are_those_that_are_held() {
    let held = held(TABLES);
    let (index, recipe) = written(cell_index);
    assert!(held.contains(&index), "{index}");
    assert_eq!(recipe, "CELL: [u16; 1024]\n");
    for table in taylor_tables() {
        let (name, n) = (table.name, table.centres.len());
        let doc: String = table.doc.lines().map(|l| format!("/// {l}\n")).collect();
        let kind = table.kind;
        let head = format!("{doc}pub(super) static {name}: [{kind}; {n}] = [\n");
        let at = held.find(&head).unwrap_or_else(|| panic!("{head}"));
        let rows: Vec<&str> = held[at + head.len()..].lines().take(n + 1).collect();
        assert_eq!(rows[n], "];", "{name}");
        for k in [0, 1, n / 3, n - 1] {
            let one = Taylor {
                doc: String::new(),
                centres: vec![table.centres[k]],
                ..table
            };
            let (text, _) = written(|t| t.taylor(&one));
            assert_eq!(text.lines().nth(1), Some(rows[k]), "{name} {k}");
        }
    }
    let names = taylor_tables().map(|t| (t.name, t.centres.len()));
    let due = [
        ("CELLS", 370),
        ("DISC", 25),
        ("REAL_AXIS", 127),
        ("IMAGINARY_AXIS", 29),
    ];
    assert_eq!(names, due);
}

#[test]
fn zeros_nodes_weights_and_polynomials_are_those_that_are_held() {
    let held = held(TABLES);
    let (zeros, recipe) = written(zero_table);
    assert!(held.contains(&zeros), "{zeros}");
    assert!(recipe.starts_with("ZEROS: [ZeroRow; 12]\nzero 1\nzero 2\n"));
    assert_eq!(recipe.lines().count(), 13);
    let (rule, recipe) = written(trapezoidal);
    assert!(held.contains(&rule), "{rule}");
    let names =
        "h = 23/64\nTRAPEZOIDAL_NODES: [[f64; 24]; 2]\nTRAPEZOIDAL_WEIGHTS: [[[f64; 24]; 2]; 2]\n";
    assert_eq!(recipe, names);
    let (line, recipe) = written(real_line::polynomials);
    assert!(held.contains(&line), "{line}");
    assert_eq!(
        recipe,
        "v <= 1/79, 10 of 24 terms\nREAL_LINE: [[f64; 10]; 2]\n"
    );
    let (values, recipe) = written(real_line::values);
    let end = format!("{}\n", values.trim_end());
    assert!(held.ends_with(&end), "{values}");
    assert_eq!(recipe, "ON_THE_AXIS: [[f64; 6]; 170]\n");
}

/// Multiples of h, or halves between them, squared.
#[test]
fn nodes_are_squares_of_steps() {
    let h = Rational::from((23, 64));
    for (rule, k, factor) in [
        (0, 0, (0, 1)),
        (0, 3, (3, 1)),
        (1, 0, (1, 2)),
        (1, 3, (7, 2)),
    ] {
        let due = (Rational::from(factor) * &h).square();
        assert_eq!(node_square(rule, k), due, "{rule} {k}");
    }
}

/// Files that are made in a moment, as they are committed: headers with the digest of their recipe
/// as well.
#[test]
fn constants_and_tables_of_arithmetic_are_those_that_are_held() {
    use crate::cli::files::artefact::{Form, document};
    for (name, file, make) in [
        (
            "arithmetic-tables",
            "arithmetic/tables.rs",
            arithmetic_tables as fn() -> Outcome<Made>,
        ),
        (
            "faddeeva-constants",
            "special/faddeeva/constants.rs",
            constants,
        ),
    ] {
        let text = document(name, Form::Rust, &make().unwrap()).unwrap();
        assert_eq!(text, held(file), "{name}");
    }
}

#[test]
fn relatives_are_those_that_are_held() {
    use crate::cli::files::artefact::{Form, document};
    let name = "faddeeva-relatives-tables";
    let text = document(name, Form::Rust, &relatives_tables().unwrap()).unwrap();
    assert_eq!(text, held("special/faddeeva/relatives_tables.rs"));
}
