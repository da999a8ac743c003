//! Proofs of error bounds on the command line.

use crate::common::{command, refused, run, text};
use serde_json::Value;
use tempfile::tempdir;

/// The bound is that of the method's audit, and the intervals of the file are those that are
/// counted.
#[test]
fn a_proof_on_the_real_line() {
    let folder = tempdir().unwrap();
    let file = folder.path().join("boxes.csv");
    let d = run(&["prove", "erf", "--format", "json", "--boxes", text(&file)]);
    assert_eq!(d.code, 0, "{}", d.err);
    let found: Value = serde_json::from_str(&d.out).unwrap();
    assert_eq!(found["proved"], true);
    let rows = std::fs::read_to_string(&file).unwrap().lines().count() - 1;
    let counted = found["formulas"].as_array().unwrap().iter();
    let counted: u64 = counted.map(|f| f["intervals"].as_u64().unwrap()).sum();
    assert_eq!(rows as u64, counted);
    let audit = command("audit erf --cases 1 --format json").out;
    let audit: Value = serde_json::from_str(&audit).unwrap();
    let proved = audit["methods"][0]["proved"][0]["ulps"].as_f64().unwrap();
    assert!(
        found["ulps"]["bound"].as_f64().unwrap() <= proved,
        "{found}"
    );
}

/// All four of them, each as it is proved alone.
#[test]
fn the_real_line_is_four_proofs() {
    let folder = tempdir().unwrap();
    let file = folder.path().join("intervals.csv");
    let d = run(&[
        "prove",
        "faddeeva",
        "--part",
        "real",
        // The theorem itself is a test of the proofs.
        "--component",
        "2",
        "--format",
        "json",
        "--boxes",
        text(&file),
    ]);
    assert_eq!(d.code, 0, "{}", d.err);
    let found: Value = serde_json::from_str(&d.out).unwrap();
    assert_eq!(found["proved"], true);
    let all = found["functions"].as_array().unwrap();
    let names: Vec<&str> = all
        .iter()
        .map(|f| f["function"].as_str().unwrap())
        .collect();
    assert_eq!(names, ["erf", "erfc", "erfcx", "dawson"]);
    let lines = std::fs::read_to_string(&file).unwrap();
    for f in all {
        let begins = format!("{},", f["function"].as_str().unwrap());
        let rows = lines.lines().filter(|l| l.starts_with(&begins)).count();
        assert_eq!(f["intervals"].as_u64().unwrap(), rows as u64);
    }
}

/// A bound of a study's solver with its witness, targets proved and refuted, and what is refused.
#[test]
fn a_solver_of_a_study_is_proved() {
    let folder = tempdir().unwrap();
    let file = folder.path().join("kernels.fpcore");
    let cores = "(FPCore verhulst (x) :pre (<= 0.1 x 0.3) (/ (* 4 x) (+ 1 (/ x 1.11))))\n\
                 (FPCore special (x) :pre (<= 1 x 2) (erf x))\n\
                 (FPCore other (x) :pre (<= 1 x 2) :spec (* x x) (+ x 1))\
                 (FPCore square (x) :pre (<= 0 x 100) (* x x))";
    std::fs::write(&file, cores).unwrap();
    let of = |name: &str| format!("{}#{name}", text(&file));
    let boxes = folder.path().join("boxes.csv");
    let verhulst = of("verhulst");
    let line = [
        "prove",
        &verhulst,
        "--format",
        "json",
        "--boxes",
        text(&boxes),
        "--limit",
        "300",
        "--evals",
        "200",
    ];
    let d = run(&line);
    assert_eq!(d.code, 0, "{}", d.err);
    let v: Value = serde_json::from_str(&d.out).unwrap();
    for (key, least, most) in [
        ("absolute_error", 1e-16, 3e-16),
        ("relative_error", 2e-16, 5e-16),
        ("ulps", 0.9, 3.0),
    ] {
        let bound = v[key].as_f64().unwrap();
        assert!((least..most).contains(&bound), "{key}: {bound:e}");
        let measure = key.split('_').next().unwrap();
        assert!(v["witness"][measure]["error"].as_f64().unwrap() <= bound);
    }
    assert_eq!(v["same_function"]["outcome"], "proved");
    let rows = std::fs::read_to_string(&boxes).unwrap();
    assert!(
        rows.starts_with("output,measure,bound,x_from,x_to\nvalue,absolute,0x1."),
        "{rows}"
    );
    for (target, code, said) in [
        ("5ulp", 0, "proved: at most 5e0 ulps"),
        ("0.6ulp", 1, "refuted: more than 6e-1 ulps"),
    ] {
        let d = run(&[
            "prove", &verhulst, "--target", target, "--limit", "300", "--evals", "200",
        ]);
        assert_eq!((d.code, d.out.contains(said)), (code, true), "{}", d.out);
    }
    // No input beyond it refutes.
    let (square, target) = (of("square"), "2e-16 absolute");
    let d = run(&["prove", &square, "--within", "1", "--target", target]);
    assert_eq!(d.code, 0, "{} {}", d.out, d.err);
    let d = run(&["prove", &of("other"), "--evals", "50", "--limit", "50"]);
    assert!(
        d.out.contains("over the reals: different, at ["),
        "{}",
        d.out
    );
    refused(
        &run(&["prove", &of("special")]),
        "nobody states the accuracy of the platform's erf",
    );
    refused(
        &run(&["prove", &verhulst, "--norm", "2"]),
        "--norm is not for studies",
    );
    refused(
        &run(&["prove", &verhulst, "--target", "many"]),
        "is none of",
    );
    refused(
        &run(&["prove", "erf", "--target", "2ulp"]),
        "--target is for studies alone",
    );
}

/// Two outputs as one complex number, and proofs as budgets of an audit.
#[test]
fn parts_are_proved_together_and_proofs_are_budgets() {
    let folder = tempdir().unwrap();
    let file = folder.path().join("square.toml");
    let study = "[inputs]\nx = { from = -1, to = 2 }\ny = { from = 1, to = 3 }\n\
                 [outputs]\nre = { is = \"x^2 - y^2\", budget = \"proved\" }\n\
                 im = { is = \"2*x*y\", budget = \"proved\" }\n\
                 [solver.a]\nre = \"x*x - y*y\"\nim = \"2*x*y\"\n";
    std::fs::write(&file, study).unwrap();
    let prove = |more: &[&str]| {
        let line = ["prove", text(&file), "--limit", "300", "--evals", "200"];
        run(&[&line, more].concat())
    };
    let d = prove(&["--together", "re,im", "--format", "json"]);
    assert_eq!(d.code, 0, "{}", d.err);
    let v: Value = serde_json::from_str(&d.out).unwrap();
    assert_eq!(
        (&v["output"], &v["ulps"]),
        (&"re + i im".into(), &Value::Null)
    );
    for (key, measure, most) in [
        ("absolute_error", "absolute", 3e-15),
        ("relative_error", "relative", 5e-16),
    ] {
        let (bound, found) = (&v[key], &v["witness"][measure]["error"]);
        let (bound, found) = (bound.as_f64().unwrap(), found.as_f64().unwrap());
        assert!(
            0.0 < found && found <= bound && bound < most,
            "{found:e} {bound:e}"
        );
    }
    refused(
        &prove(&["--together", "re"]),
        "two outputs as RE,IM; there are: re, im",
    );
    refused(
        &prove(&["--together", "re,im", "--target", "1ulp"]),
        "has no ulps",
    );
    let d = run(&["audit", text(&file), "--cases", "40"]);
    assert_eq!(d.code, 0, "{}", d.out);
    let words: Vec<&str> = d.out.split_whitespace().collect();
    let said = "re at every input of the domain: mechaudit prove";
    assert!(words.join(" ").contains(said), "{}", d.out);
}

/// A solver by another formula than the definition, whose parts have names that both use.
#[test]
fn a_solver_may_differ_from_the_definition() {
    let folder = tempdir().unwrap();
    let file = folder.path().join("roots.toml");
    let prove = |solver: &str, condition: &str| {
        let study = format!(
            "{condition}[inputs]\nx = {{ from = 1, to = 2 }}\n[let]\nk = \"x + 1\"\n\
             [outputs]\na = \"k\"\ny = \"sqrt(a) - sqrt(x)\"\n[solver.s]\n{solver}\n"
        );
        std::fs::write(&file, study).unwrap();
        run(&["prove", text(&file), "--evals", "0", "--limit", "50"])
    };
    let stable = prove("a = \"x + 1\"\ny = \"1/(sqrt(a) + sqrt(x))\"", "");
    assert_eq!(stable.code, 0, "{}", stable.err);
    assert_eq!(stable.out.matches("relative  error ≤").count(), 2);
    let other = prove("a = \"x + 2\"\ny = \"sqrt(a) - sqrt(x)*1\"", "");
    assert!(other.out.contains("different, at ["), "{}", other.out);
    let clash = "a = \"k\"\ny = \"sqrt(k) - sqrt(x)\"\n[solver.s.let]\nk = \"x + 3\"";
    assert_eq!(prove(clash, "").code, 0);
    let said = "the conditions of the study define k differently";
    refused(&prove(clash, "where = \"k < 4\"\n"), said);
}

/// Solver and definition over the reals: equal for inputs of either sign and as loops, different,
/// and undecided.
#[test]
fn equal_functions_are_told_from_others() {
    let folder = tempdir().unwrap();
    let file = folder.path().join("pairs.fpcore");
    let signs = ":pre (and (<= -2 x 2) (<= -1 y 1))";
    let rounds = "(while (< k 3) ((k 0 (+ k 1)) (z x (- z (/ y 8)))) z)";
    let one = "(- (* x x) (* y y))";
    let due = [
        (one, "(* (+ x y) (- x y))", "the same, by the algebra"),
        (one, "(+ (* x x) (* y y))", "different, at ["),
        (rounds, rounds, "the same formula"),
        (
            "(* (fabs x) (fabs x))",
            "(* x x)",
            "for positive inputs alone",
        ),
        (
            "(fmax x y)",
            "(+ x (fmax 0 (- y x)))",
            "the algebra does not decide it",
        ),
    ];
    let cores = due.map(|(f, is, _)| format!("(FPCore (x y) {signs} :spec {is} {f})\n"));
    std::fs::write(&file, cores.concat()).unwrap();
    for (k, (.., said)) in due.iter().enumerate() {
        let of = format!("{}#{}", text(&file), k + 1);
        let d = run(&["prove", &of, "--evals", "40", "--limit", "20"]);
        assert_eq!(d.code, 0, "{k} {}", d.err);
        let line = d.out.lines().find(|l| l.contains("over the reals"));
        assert!(line.is_some_and(|l| l.contains(said)), "{k} {}", d.out);
    }
}
