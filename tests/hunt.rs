//! Hunts and the hard cases they leave.
#![cfg(feature = "cli")]

use mechaudit::audit::{
    Cases, Domain, HardCase, Hunt, HuntSettings, Input, Method, Origin, Output, ReferenceAnswer,
    Settings, SolverAnswer, Variant, Verdict, audit_case, audit_method, hunt as search,
};
use mechaudit::methods;
use std::collections::HashSet;
use std::path::Path;
use std::process::Command;

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/reference/hard");

#[test]
fn every_file_of_hard_cases_is_a_methods() {
    let mut files = HashSet::new();
    for entry in std::fs::read_dir(FOLDER).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_stem().unwrap().to_str().unwrap().to_string();
        let method = methods::find(&name).unwrap_or_else(|| panic!("whose is {name}.csv?"));
        let cases = HardCase::read(&std::fs::read_to_string(&path).unwrap()).unwrap();
        assert_eq!(method.hard(), cases, "{name}");
        let outputs = method.outputs();
        for c in &cases {
            assert!(
                outputs.iter().any(|o| o.name == c.output),
                "{name}: {}",
                c.output
            );
            assert!(method.admits(&c.input), "{name}");
        }
        files.insert(name);
    }
    assert!(!files.is_empty());
}

/// The share recorded is not exceeded.
#[test]
fn hard_cases_are_as_recorded() {
    let settings = Settings::default();
    for method in methods::registry() {
        let cases = Cases::new(&*method, &settings);
        for (i, hard) in method.hard().iter().enumerate() {
            let case = cases.hard_case(i + 1).unwrap();
            assert_eq!(case.origin, Origin::Hard { number: i + 1 });
            let report = audit_case(&*method, case, &settings);
            let own = report
                .judgement
                .components
                .iter()
                .filter(|c| c.output == hard.output);
            let share = own.map(|c| c.of_budget).fold(0.0, f64::max);
            let name = method.name();
            // Not more than recorded; less where the solver was mended since.
            assert!(hard.allows(share), "{name} {}: {share}", i + 1);
            let verdict = report.judgement.verdict;
            let due = [Verdict::Pass, Verdict::Over];
            assert!(due.contains(&verdict), "{name} {}: {verdict:?}", i + 1);
        }
    }
}

#[test]
fn the_audit_judges_hard_cases_and_says_which_are_recorded_findings() {
    let settings = Settings {
        cases_per_region: 0,
        ..Settings::default()
    };
    for method in methods::registry() {
        let hard = method.hard();
        let report = audit_method(&*method, &settings, &|| ());
        let points = method.domain().check_points.len();
        assert_eq!(report.cases, points + hard.len(), "{}", method.name());
        let over: HashSet<Vec<u64>> = hard
            .iter()
            .enumerate()
            .filter(|(i, _)| {
                let case = Cases::new(&*method, &settings).hard_case(i + 1).unwrap();
                audit_case(&*method, case, &settings).judgement.verdict == Verdict::Over
            })
            .map(|(_, h)| h.input.iter().map(|x| x.to_bits()).collect())
            .collect();
        assert!(report.passed(), "{}", method.name());
        assert!(report.recorded >= over.len(), "{}", method.name());
    }
}

/// A method with other hard cases and a solver that is off by 1e-13.
struct Planted(Box<dyn Method>, Vec<HardCase>);

impl Method for Planted {
    fn name(&self) -> &'static str {
        self.0.name()
    }
    fn summary(&self) -> &'static str {
        self.0.summary()
    }
    fn source(&self) -> &'static str {
        self.0.source()
    }
    fn inputs(&self) -> Vec<Input> {
        self.0.inputs()
    }
    fn outputs(&self) -> Vec<Output> {
        self.0.outputs()
    }
    fn domain(&self) -> Domain {
        Domain::default()
    }
    fn hard(&self) -> Vec<HardCase> {
        self.1.clone()
    }
    fn solve(&self, x: &[f64]) -> SolverAnswer {
        match self.0.solve(x) {
            SolverAnswer::Values(v) => {
                SolverAnswer::Values(v.iter().map(|v| v * (1.0 + 1e-13)).collect())
            }
            other => other,
        }
    }
    fn reference(&self, x: &[rug::Rational], bits: u32) -> ReferenceAnswer {
        self.0.reference(x, bits)
    }
}

/// Over budget as recorded is a finding that does not fail; worse than recorded fails.
#[test]
fn a_recorded_finding_may_not_get_worse() {
    let settings = Settings::default();
    let with = |share: f64| {
        let hard = HardCase {
            share,
            output: "Re W".into(),
            reason: "planted".into(),
            input: vec![0.5, 0.25],
        };
        Planted(methods::find("faddeeva").unwrap(), vec![hard])
    };
    let method = with(1.0);
    let case = Cases::new(&method, &settings).hard_case(1).unwrap();
    let components = audit_case(&method, case, &settings).judgement.components;
    let share = components.iter().map(|c| c.of_budget).fold(0.0, f64::max);
    assert!(share > 1.0);
    for (recorded, passed) in [(share, true), (0.9 * share, false), (1.0, false)] {
        let report = audit_method(&with(recorded), &settings, &|| ());
        let found = (report.cases, report.recorded, report.passed());
        assert_eq!(found, (1, usize::from(passed), passed), "{recorded}");
    }
}

/// Off the more the nearer to a line that no sampler draws on.
#[test]
fn a_needle_is_found_by_its_slope() {
    let method = methods::find("faddeeva").unwrap();
    let faulty = Variant::new(&*method).solver(|x| match method.solve(x) {
        SolverAnswer::Values(mut v) => {
            let near = (x[0] - 1.234_567_8).abs();
            v[0] *= 1.0 + 1e-16 / (near + 1e-8);
            SolverAnswer::Values(v)
        }
        other => other,
    });
    let faulty = faulty.region("mid").unwrap();
    let settings = HuntSettings {
        evaluations: 4000,
        seed: 4,
    };
    let of_re = |h: &Hunt| {
        h.worst
            .iter()
            .find(|w| w.output == "Re W")
            .cloned()
            .unwrap()
    };
    let found = search(&faulty, &settings, &|_| ());
    let worst = of_re(&found);
    let sampled = Settings {
        cases_per_region: 4000,
        seed: 4,
        ..Settings::default()
    };
    let random = audit_method(&faulty, &sampled, &|| ());
    let sampled = random.outputs[0].max_of_budget;
    assert!(worst.share > 5.0 * sampled, "{} {sampled}", worst.share);
    assert!(found.evaluations <= 4000);
    // The same again.
    let again = search(&faulty, &settings, &|_| ());
    assert_eq!(of_re(&again).input, worst.input);
}

fn hunt(folder: &Path, args: &[&str]) -> (i32, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_mechaudit"))
        .args(["hunt", "slider-crank", "--evals", "400", "--hard"])
        .arg(folder)
        .args(args)
        .output()
        .unwrap();
    let text = String::from_utf8(output.stdout).unwrap() + &String::from_utf8_lossy(&output.stderr);
    (output.status.code().unwrap(), text)
}

#[test]
fn lines_are_only_added() {
    let folder = tempfile::tempdir().unwrap();
    let (code, text) = hunt(folder.path(), &["--seed", "3"]);
    assert!(code == 0 && text.contains("added to"), "{text}");
    let path = folder.path().join("slider-crank.csv");
    let first = std::fs::read_to_string(&path).unwrap();
    assert_eq!(HardCase::read(&first).unwrap().len(), 7);
    // The same hunt starts from the same places and finds nothing worse.
    let (code, text) = hunt(folder.path(), &["--seed", "3"]);
    assert!(code == 0 && text.contains("Nothing worse"), "{text}");
    assert_eq!(std::fs::read_to_string(&path).unwrap(), first);
    let (_, text) = hunt(folder.path(), &["--seed", "4"]);
    let second = std::fs::read_to_string(&path).unwrap();
    assert!(second.starts_with(&first), "{text}");

    let (code, text) = hunt(&folder.path().join("none"), &[]);
    assert!(code == 0 && !folder.path().join("none").exists(), "{text}");
    std::fs::write(&path, "share,output,reason,input\nx,y,z,0x1p0\n").unwrap();
    let (code, text) = hunt(folder.path(), &[]);
    assert!(code == 2 && text.contains("on line 2"), "{text}");
}
