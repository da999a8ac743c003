//! Hunts and hard cases.

use crate::common::{cells, run};
use mechaudit::audit::{
    Case, Cases, Domain, HardCase, Hunt, HuntSettings, Input, Method, Origin, Output,
    ReferenceAnswer, Settings, SolverAnswer, Variant, Verdict, audit_case, audit_method, hex_float,
    hunt as search,
};
use mechaudit::methods;
use std::collections::HashSet;
use std::path::Path;
use std::process::Command;

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../reference/hard");

#[test]
fn every_file_of_hard_cases_is_a_methods() {
    let mut files = HashSet::new();
    for entry in std::fs::read_dir(FOLDER).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_stem().unwrap().to_str().unwrap().to_string();
        let method = methods::find(&name).unwrap_or_else(|| panic!("whose is {name}.csv?"));
        let text = std::fs::read_to_string(&path).unwrap();
        let cases = HardCase::read_of(&*method, &text).unwrap();
        assert_eq!(method.hard(), cases, "{name}");
        assert!(!cases.is_empty(), "{name}");
        files.insert(name);
    }
    let registry = methods::registry();
    let names: HashSet<String> = registry.iter().map(|m| m.name().to_string()).collect();
    assert_eq!(files, names, "every method has its file");
}

/// Choices and counts are whole numbers, and a harmonic that there is not is refused by both sides.
#[test]
fn a_hunt_leaves_what_is_no_input_alone() {
    let method = methods::find("cam-fourier-series").unwrap();
    let first = 5;
    let mut x = method.domain().check_points[0].input.clone();
    assert!(method.admits(&x));
    x[first] = 0.5;
    assert!(!method.admits(&x));
    for order in [0.0, 1.0, 1e7] {
        x[first] = order;
        let case = Case {
            method: method.name(),
            region: "given",
            input: x.clone(),
            origin: Origin::Given,
        };
        let report = audit_case(&*method, case, &Settings::default());
        assert_eq!(report.judgement.verdict, Verdict::Pass, "{order}");
    }
    let law = methods::find("cam-law").unwrap();
    assert!(law.admits(&[0.5, 0.0, 0.5, 2.0, 0.25, 0.25]));
    assert!(!law.admits(&[0.5, 0.0, 0.5, 2.5, 0.25, 0.25]));
}

/// The share recorded is not exceeded.
#[test]
fn a_file_without_rows_keeps_its_header() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("slider-crank.csv");
    let header = "share,output,reason,input\n";
    std::fs::write(&path, format!("# By hand.\n{header}")).unwrap();
    let into = folder.path().to_str().unwrap();
    let d = run(&["hunt", "slider-crank", "--evals", "60", "--hard", into]);
    assert_eq!(d.code, 0, "{}", d.err);
    let text = std::fs::read_to_string(&path).unwrap();
    assert!(text.starts_with("# By hand.\n") && text.lines().count() > 2);
    assert_eq!(text.matches(header).count(), 1, "{text}");
}

#[test]
fn hard_cases_are_as_recorded() {
    let settings = Settings::default();
    for method in methods::registry() {
        let cases = Cases::new(&*method, &settings);
        for (i, hard) in method.hard().iter().enumerate() {
            let case = cases.hard_case(i + 1).unwrap();
            let (number, folder) = (i + 1, None);
            assert_eq!(case.origin, Origin::Hard { number, folder });
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
        assert_eq!(
            report.cases,
            (points + hard.len()) as u64,
            "{}",
            method.name()
        );
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
        assert!(report.recorded >= over.len() as u64, "{}", method.name());
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
            SolverAnswer::Values(mut v) => {
                v[0] *= 1.0 + 1e-13;
                SolverAnswer::Values(v)
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
            folder: None,
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
        assert_eq!(found, (1, u64::from(passed), passed), "{recorded}");
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
    let sampled = random.outputs()[0].max_of_budget;
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
    // The next one climbs on from them.
    let (code, text) = hunt(folder.path(), &["--seed", "3"]);
    let second = std::fs::read_to_string(&path).unwrap();
    assert!(code == 0 && second.starts_with(&first), "{text}");
    assert!(text.contains("hard case"), "{text}");
    let cases = HardCase::read(&second).unwrap();
    for (k, new) in cases.iter().enumerate().skip(7) {
        let mut before = cases[..k].iter().filter(|c| c.output == new.output);
        assert!(before.all(|c| c.share < new.share), "{text}");
    }

    let (code, text) = hunt(&folder.path().join("none"), &[]);
    assert!(code == 2 && !folder.path().join("none").exists(), "{text}");
    assert!(text.contains("none: there is no such folder"), "{text}");
}

/// A hunt writes where it is told to, and nowhere else: not into the repository that it is run in.
#[test]
fn nothing_is_written_without_a_folder() {
    let here = tempfile::tempdir().unwrap();
    let own = here.path().join("reference/hard");
    std::fs::create_dir_all(&own).unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_mechaudit"))
        .args(["hunt", "slider-crank", "--evals", "400", "--seed", "3"])
        .current_dir(here.path())
        .output()
        .unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    assert_eq!(output.status.code(), Some(0), "{text}");
    assert_eq!(std::fs::read_dir(&own).unwrap().count(), 0, "{text}");
}

/// A hunt that could not record what it found does not begin.
#[test]
fn what_is_no_file_of_hard_cases_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("slider-crank.csv");
    let name = folder.path().to_str().unwrap();
    let endless = [
        "hunt",
        "slider-crank",
        "--evals",
        "1000000000",
        "--hard",
        name,
    ];
    let header = "share,output,reason,input";
    let outside = "0x1p+0 ".repeat(6);
    for (text, part) in [
        (
            format!("{header}\nx,x,z,0x1p0\n"),
            "on line 2: \"x\" is no share",
        ),
        (
            format!("{header}\n1,y,z,0x1p0\n"),
            "no output \"y\"; it has: ",
        ),
        (
            "# ours\ngarbage\n1,x,z,0x1p0\n".to_string(),
            "on line 2: the names are \"garbage\"",
        ),
        (
            format!("1,x,z,{outside}\n"),
            "\"share,output,reason,input\" is due",
        ),
    ] {
        std::fs::write(&path, &text).unwrap();
        let (code, said) = mechaudit(&endless);
        assert!(code == 2 && said.contains(part), "{said}");
        assert!(said.lines().count() == 1, "{said}");
        let (code, said) = mechaudit(&["audit", "--hard", name]);
        assert!(code == 2 && said.contains(part), "{said}");
        assert_eq!(std::fs::read_to_string(&path).unwrap(), text);
    }
    // A file that cannot be read is not taken for missing.
    let other = tempfile::tempdir().unwrap();
    std::fs::create_dir(other.path().join("slider-crank.csv")).unwrap();
    let (code, said) = mechaudit(&["audit", "--hard", other.path().to_str().unwrap()]);
    assert!(code == 2 && said.contains("cannot read"), "{said}");
    std::fs::write(&path, format!("{header}\n")).unwrap();
    let mut mode = path.metadata().unwrap().permissions();
    mode.set_readonly(true);
    std::fs::set_permissions(&path, mode).unwrap();
    let (code, said) = mechaudit(&endless);
    assert!(code == 2 && said.contains("it is read-only"), "{said}");
}

#[test]
fn hunts_at_the_same_time_lose_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("slider-crank.csv");
    std::fs::write(&path, "# ours\n").unwrap();
    let said = std::thread::scope(|s| {
        let start = |seed: u32| {
            let folder = folder.path();
            s.spawn(move || hunt(folder, &["--seed", &seed.to_string()]).1)
        };
        let hunts: Vec<_> = (1..=8).map(start).collect();
        let said = hunts.into_iter().map(|h| h.join().unwrap());
        said.collect::<Vec<String>>()
    });
    let added = |text: &String| -> usize {
        let line = text.lines().find(|l| l.contains(" added to "));
        line.map_or(0, |l| l.split(' ').next().unwrap().parse().unwrap())
    };
    let added: usize = said.iter().map(added).sum();
    let text = std::fs::read_to_string(&path).unwrap();
    assert!(text.starts_with("# ours\nshare,output,reason,input\n"));
    assert_eq!(HardCase::read(&text).unwrap().len(), added, "{said:?}");
    assert!(added >= 7);
    // Each was worse than those before it.
    for output in ["x", "dx/dphi"] {
        let cases = HardCase::read(&text).unwrap();
        let shares: Vec<f64> = cases
            .iter()
            .filter(|c| c.output == output)
            .map(|c| c.share)
            .collect();
        assert!(shares.is_sorted(), "{output}: {shares:?}");
    }
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
}

fn mechaudit(args: &[&str]) -> (i32, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_mechaudit"))
        .args(args)
        .output()
        .unwrap();
    let text = String::from_utf8(output.stdout).unwrap() + &String::from_utf8_lossy(&output.stderr);
    (output.status.code().unwrap(), text)
}

/// The commands that a hunt prints.
fn commands(said: &str) -> Vec<Vec<String>> {
    let again = said
        .lines()
        .filter_map(|l| l.trim_start().strip_prefix("again    mechaudit "));
    again.map(|l| shell_words::split(l).unwrap()).collect()
}

#[test]
fn what_a_hunt_found_can_be_judged_again() {
    let folder = tempfile::tempdir().unwrap();
    let ours = folder.path().join("our cases");
    let d = run(&["hunt", "slider-crank", "--evals", "400"]);
    assert_eq!(d.code, 0, "{}{}", d.out, d.err);
    let unrecorded = commands(&d.out);
    std::fs::create_dir(&ours).unwrap();
    let (_, said) = hunt(&ours, &[]);
    let recorded = commands(&said);
    let path = ours.join("slider-crank.csv");
    let cases = HardCase::read(&std::fs::read_to_string(&path).unwrap()).unwrap();
    for (all, option) in [(&unrecorded, "--at"), (&recorded, "--hard-case")] {
        assert!(!all.is_empty(), "{said}");
        for command in all {
            assert!(command.iter().any(|w| w == option), "{command:?}");
            let args: Vec<&str> = command.iter().map(String::as_str).collect();
            let (code, said) = mechaudit(&args);
            assert_eq!(code, 0, "{said}");
            let shown = |c: &HardCase| c.input.iter().all(|x| said.contains(&hex_float(*x)));
            assert!(option == "--at" || cases.iter().any(shown), "{said}");
        }
    }
    // Without a rebuild, in place of those that are built in.
    let folder = ours.to_str().unwrap();
    let audit = [
        "audit",
        "slider-crank",
        "--cases",
        "1",
        "--format",
        "json",
        "--hard",
        folder,
    ];
    let count = |args: &[&str]| -> u64 {
        let (_, text) = mechaudit(args);
        let v: serde_json::Value = serde_json::from_str(&text).unwrap();
        v["methods"][0]["cases"].as_u64().unwrap()
    };
    let method = methods::find("slider-crank").unwrap();
    let own = method.hard().len() as u64;
    assert_eq!(count(&audit) + own, count(&audit[..6]) + cases.len() as u64);
    let (_, text) = mechaudit(&["points", "slider-crank", "--count", "0", "--hard", folder]);
    assert!(cases.iter().all(|c| text.contains(&hex_float(c.input[0]))));
    // Whose there are none.
    let options = "
        erfc --hard FOLDER                           | it holds no erfc.csv
        --hard /no/such                              | there is no such folder
        erfc --hard 3                                | --hard-case 3 chooses one case
        slider-crank --hard FOLDER --hard-case 99    | no hard case \"99\"
        slider-crank --at 1,2                        | 2 numbers cannot be an input
        slider-crank --at 1,b                        | \"b\"
    ";
    for [args, part] in cells(options) {
        let word = |w| if w == "FOLDER" { folder } else { w };
        let args: Vec<&str> = args.split_whitespace().map(word).collect();
        let args = [&["audit"], &args[..]].concat();
        let (code, said) = mechaudit(&args);
        assert!(code == 2 && said.contains(&part), "{args:?}: {said}");
        assert_eq!(said.lines().count(), 1, "{said}");
    }
}
