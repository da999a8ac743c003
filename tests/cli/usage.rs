//! Help, usage, lists and how output ends.

use crate::common::{cells, done, names, program, refused, run, text, words};
use std::process::Stdio;
use tempfile::tempdir;

#[test]
fn help_and_version() {
    let commands = "audit compare describe list paper linkage eval motion runup points judge \
                    hunt converge prove identity regenerate chirp completions man";
    let own = commands.split(' ').map(|command| vec![command, "--help"]);
    for args in own.chain([vec!["--help"]]) {
        let d = run(&args);
        assert_eq!((d.code, d.err.as_str()), (0, ""));
        assert!(d.out.contains("Examples:"), "{}", d.out);
    }
    let d = run(&["--version"]);
    assert_eq!(
        d.out.trim(),
        concat!("mechaudit ", env!("CARGO_PKG_VERSION"))
    );
}

#[test]
fn completions_and_manual_pages() {
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let d = run(&["completions", shell]);
        assert!(d.code == 0 && d.out.contains("check-point"), "{shell}");
    }
    let d = run(&["man"]);
    assert!(
        d.code == 0 && d.out.contains(".TH mechaudit 1"),
        "{}",
        d.out
    );
    let to = tempdir().unwrap();
    let d = run(&["man", "--output", text(to.path())]);
    assert_eq!((d.code, d.out.as_str()), (0, ""));
    let all = names(to.path());
    for name in ["mechaudit.1", "mechaudit-audit.1", "mechaudit-hunt.1"] {
        assert!(all.iter().any(|n| n == name), "{all:?}");
    }
}

#[test]
fn bad_usage() {
    refused(&run(&["frobnicate"]), "frobnicate");
    refused(&run(&["--seed", "x"]), "--seed");
    refused(
        &run(&["audit", "no-such-method"]),
        "there is no method \"no-such-method\"; there are: ",
    );
    refused(
        &run(&["audit", "four-bar", "--region", "nowhere"]),
        "has no region \"nowhere\"; it has: ",
    );
    refused(
        &run(&["audit", "four-bar", "--check-point", "none"]),
        "has no check point",
    );
    refused(
        &run(&["paper", "no-such-paper"]),
        "there is no paper \"no-such-paper\"",
    );
    for bad in ["0", "-1", "nan", "inf", "much", ""] {
        let d = done(
            program()
                .args(["audit", "four-bar"])
                .env("MECHAUDIT_EFFORT", bad)
                .output()
                .unwrap(),
        );
        refused(&d, "MECHAUDIT_EFFORT");
    }
}

#[test]
fn a_slip_of_the_pen_is_guessed_and_the_right_help_named() {
    let slips = r#"
        audit fourbar           | "fourbar" (did you mean "four-bar"?); there are:
        audit erf --region smal | "smal" (did you mean "small"?); it has:
        eval fadeeva            | (did you mean "faddeeva"?)
        eval erfz               | (did you mean "erf"?)
        paper zinchenco         | (did you mean "zinchenko"?)
        converge spline-clampd  | (did you mean "spline-clamped"?)
        regenerate fadeeva      | (did you mean "faddeeva"?)
        adit                    | a similar subcommand exists: 'audit' (see mechaudit --help)
        audit --formt json      | a similar argument exists: '--format' (see mechaudit audit --help)
        runup                   | <FILE> (see mechaudit runup --help)
        --seed x                | (see mechaudit --help)
    "#;
    for [args, part] in cells(slips) {
        refused(&run(&words(&args)), &part);
    }
}

#[test]
fn numbers_that_are_none_are_said_in_words() {
    let numbers = "
        audit erf --seed -1        | must be a whole number, 0 or more
        audit erf --seed 1.5       | must be a whole number, 0 or more
        audit erf --cases 0        | must be a whole number, 1 or more
        --cases 0                  | must be a whole number, 1 or more
        points erf --count -3      | must be a whole number, 0 or more
        points erf --region small --case x | must be a whole number, 0 or more
        judge erf --inputs x --values y --line x | must be a whole number, 0 or more
        linkage examples/four-bar.toml --branch -1 | must be a whole number, 0 or more
        linkage examples/four-bar.toml --digits 0 | a whole number from 1 to 1000
        eval erf --threads x       | a whole number from 1 to 1024
        hunt erf --evals 0         | must be a whole number, 1 or more
        audit erf --ulps x         | must be a positive number
        audit erf --exec true --timeout -1 | must be a positive number of seconds
        runup x --tolerance -0.001 | must be a positive number
    ";
    for [args, part] in cells(numbers) {
        let d = run(&words(&args));
        refused(&d, &part);
        assert!(!d.err.contains(" -- "), "{}", d.err);
    }
    let d = run(&["points", "erf", "--region", "small", "--count", "1e1"]);
    assert_eq!(d.out.lines().filter(|l| !l.starts_with('#')).count(), 10);
}

#[test]
fn the_help_of_rows_is_not_about_linkages() {
    for command in ["chirp", "runup"] {
        let help = run(&[command, "--help"]).out;
        assert!(
            !help.contains("turn\n          \n") && !help.contains("each position"),
            "{help}"
        );
    }
}

#[test]
fn effort_multiplies_the_cases() {
    let cases = |effort: Option<&str>| {
        let mut c = program();
        c.args(["audit", "four-bar", "--cases", "4", "--format", "json"]);
        effort.map(|e| c.env("MECHAUDIT_EFFORT", e));
        let d = done(c.output().unwrap());
        assert_eq!(d.code, 0, "{}", d.out);
        let v: serde_json::Value = serde_json::from_str(&d.out).unwrap();
        v["methods"][0]["settings"]["cases_per_region"]
            .as_u64()
            .unwrap()
    };
    assert_eq!(
        (cases(None), cases(Some("0.5")), cases(Some("2"))),
        (4, 2, 8)
    );
}

#[test]
fn the_list_names_every_method() {
    let d = run(&["list"]);
    assert_eq!((d.code, d.err.as_str()), (0, ""));
    let json: serde_json::Value =
        serde_json::from_str(&run(&["list", "--format", "json"]).out).unwrap();
    let listed = json["methods"].as_array().unwrap();
    let methods = mechaudit::methods::registry();
    assert_eq!(listed.len(), methods.len());
    let flat = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
    let said = flat(&d.out);
    for m in methods {
        assert!(said.contains(&format!("{} {}", m.name(), flat(m.summary()))));
        let one = run(&["list", m.name()]);
        assert_eq!(
            flat(&one.out),
            format!("{} {}", m.name(), flat(m.summary()))
        );
        let described = flat(&run(&["describe", m.name()]).out);
        for output in m.outputs() {
            assert!(
                described.contains(&flat(output.budget.reason)),
                "{}",
                m.name()
            );
        }
        for r in m.domain().regions {
            assert!(described.contains(&format!("{}: {}", r.name, flat(r.description))));
        }
        for law in m.laws() {
            assert!(described.contains(&format!("{}: {}", law.name, flat(law.statement))));
        }
        assert!(described.contains(&flat(m.source())), "{}", m.name());
    }
}

#[test]
fn the_reproduce_command_works() {
    use mechaudit::audit::{Case, Draw, Origin, hex_float};
    for m in mechaudit::methods::registry() {
        let domain = m.domain();
        let Some(region) = domain.regions.first() else {
            continue;
        };
        let input = (region.sample)(&mut Draw::new(9, m.name(), region.name, 3));
        let mut cases = vec![Case {
            method: m.name(),
            region: region.name,
            input,
            origin: Origin::Random { seed: 9, index: 3 },
        }];
        cases.extend(domain.check_points.first().map(|p| Case {
            method: m.name(),
            region: "check-points",
            input: p.input.clone(),
            origin: Origin::CheckPoint { name: p.name },
        }));
        for case in cases {
            let command = case.reproduce();
            let args: Vec<&str> = command.split(' ').skip(1).collect();
            let d = run(&args);
            assert_eq!(d.code, 0, "{command}\n{}{}", d.out, d.err);
            assert!(d.out.contains(&command), "{}", d.out);
            for x in &case.input {
                assert!(d.out.contains(&hex_float(*x)), "{}", d.out);
            }
            let json = run(&[&args[..], &["--format", "json"]].concat());
            let v: serde_json::Value = serde_json::from_str(&json.out).unwrap();
            assert_eq!(v["methods"][0]["worst"][0]["reproduce"], command.as_str());
            assert_eq!(v["passed"], true);
        }
    }
}

#[test]
fn a_region_alone_and_everything() {
    let d = run(&[
        "audit",
        "four-bar",
        "--cases",
        "3",
        "--region",
        first_region("four-bar"),
    ]);
    assert_eq!(d.code, 0);
    assert!(d.out.contains("3 of 3 cases"), "{}", d.out);
    assert!(
        d.out.contains("seed 1, 3 random cases per region"),
        "{}",
        d.out
    );
}

fn first_region(method: &str) -> &'static str {
    mechaudit::methods::find(method).unwrap().domain().regions[0].name
}

#[test]
fn pipes_have_no_colour() {
    for (key, value) in [("NO_COLOR", "1"), ("TERM", "xterm-256color")] {
        let mut c = program();
        c.args(["audit", "four-bar", "--cases", "1"])
            .env(key, value);
        let d = done(c.output().unwrap());
        assert!(!d.out.contains('\u{1b}') && !d.err.contains('\u{1b}'));
        assert!(d.out.lines().all(|l| l.chars().count() <= 100), "{}", d.out);
    }
}

#[test]
fn a_closed_pipe_ends_quietly() {
    let mut child = program()
        .args(["linkage", "examples/sand-screen.toml", "--step-deg", "0.01"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let d = done(child.wait_with_output().unwrap());
    assert_eq!((d.code, d.err.as_str()), (0, ""));
}

/// One in text, the same in JSON, each to its end.
#[test]
fn an_approximation_converges() {
    let d = run(&["converge", "spline-clamped"]);
    assert_eq!((d.code, d.err.as_str()), (0, ""));
    assert!(
        d.out.starts_with("spline-clamped\n") && !d.out.contains("nterrupted"),
        "{}",
        d.out
    );
    let d = run(&["converge", "spline-clamped", "--format", "json"]);
    let json: serde_json::Value = serde_json::from_str(&d.out).unwrap();
    assert_eq!((d.code, &json["interrupted"]), (0, &false.into()));
    let all = json["approximations"].as_array().unwrap();
    assert!(
        all.len() == 1 && all[0]["name"] == "spline-clamped",
        "{}",
        d.out
    );
}
