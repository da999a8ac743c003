//! Programs side by side, boxes and neighbourhoods, user-supplied budgets, binary frames.

use crate::common::{cells, refused, run};
use serde_json::Value;
use std::path::Path;

const PROGRAM: &str = env!("CARGO_BIN_EXE_mechaudit");

fn json(args: &[&str]) -> (i32, Value) {
    let d = run(&[args, &["--format", "json"]].concat());
    let v = serde_json::from_str(&d.out).unwrap_or_else(|e| panic!("{e}: {}{}", d.out, d.err));
    (d.code, v)
}

fn right() -> String {
    format!("{PROGRAM} eval erf")
}

/// The right program behind a filter.
fn filtered(filter: &str) -> String {
    format!("sh -c '{PROGRAM} eval erf | {filter}'")
}

#[test]
fn programs_side_by_side() {
    let named = format!(
        "sh -c 'echo \"# name: good\"; echo \"# version: 1.5\"; exec {}'",
        right()
    );
    let wrong = filtered("sed s/^-.*/nan,nan/");
    let args = [
        "compare", "erf", "--region", "mid", "--cases", "40", "--with", "ours",
    ];
    let exec = ["--exec", &named, "--exec", &wrong];
    let (code, v) = json(&[&args[..], &exec].concat());
    assert_eq!((code, &v["passed"]), (1, &Value::from(false)));
    let candidates = v["candidates"].as_array().unwrap();
    let names: Vec<&str> = candidates
        .iter()
        .map(|c| c["name"].as_str().unwrap())
        .collect();
    assert_eq!(names, ["good", &wrong, "ours"]);
    assert_eq!(candidates[0]["report"]["candidate"]["version"], "1.5");
    for (c, passed) in candidates.iter().zip([true, false, true]) {
        assert_eq!(c["report"]["passed_all"], passed, "{}", c["name"]);
        assert_eq!(c["report"]["cases"], 40);
        assert!(
            c["speed"]["ns_per_answer"].as_f64().unwrap() > 0.0,
            "{}",
            c["speed"]
        );
    }
    assert!(candidates[0]["speed"]["start_up_ms"].as_f64().unwrap() > 0.0);
    assert!(candidates[2]["speed"]["start_up_ms"].is_null());
    let all = v["regions"].as_array().unwrap().last().unwrap();
    assert_eq!(all["region"], "all");
    let s = &all["standings"];
    assert_eq!(
        (&s[0]["best"], &s[1]["best"]),
        (&true.into(), &false.into())
    );
    assert!(s[1]["wrong"].as_u64().unwrap() > 5 && s[0]["wrong"] == 0);
    // A wrong case is judged again by its command.
    let again = candidates[1]["report"]["wrong"][0]["reproduce"]
        .as_str()
        .unwrap();
    assert!(
        again.contains("--exec") && again.contains("--case"),
        "{again}"
    );
    // A line for each region and candidate.
    let d = run(&[&args[..], &exec, &["--no-speed", "--format", "csv"]].concat());
    assert_eq!((d.code, d.out.lines().count()), (1, 1 + 2 * 3), "{}", d.out);
    let d = run(&[&args[..], &exec, &["--no-speed"]].concat());
    for part in ["times the best", "good 1.5", "NaN", "budget", "A*"] {
        assert!(d.out.contains(part), "{part} is missing in {}", d.out);
    }
}

#[test]
fn a_comparison_without_failures_passes() {
    let program = right();
    let args = [
        "compare",
        "erf",
        "--region",
        "mid",
        "--cases",
        "5",
        "--no-speed",
        "--exec",
    ];
    assert_eq!(run(&[&args[..], &[&program]].concat()).code, 0);
    // Bad programs cost their own verdict only.
    for bad in [
        "true",
        "yes 1,2",
        "sh -c 'kill -9 $$'",
        "head -c 100 /dev/urandom",
        "sleep 100",
    ] {
        let more = ["--exec", bad, "--timeout", "0.5"];
        let (code, v) = json(&[&args[..], &[&program], &more].concat());
        let passed = |k: usize| {
            v["candidates"][k]["report"]["passed_all"]
                .as_bool()
                .unwrap()
        };
        assert_eq!((code, passed(0), passed(1)), (1, true, false), "{bad}");
        let cases = |k: usize| v["candidates"][k]["report"]["cases"].as_u64().unwrap();
        assert_eq!((cases(0), cases(1)), (5, 5), "{bad}");
        assert!(
            v["candidates"][1]["report"]["candidate"]["trouble"].is_string(),
            "{bad}"
        );
    }
}

/// Each candidate beside itself, whichever comes first.
#[test]
fn nothing_has_changed_in_a_comparison_of_the_same() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("old.json");
    let path = path.to_str().unwrap();
    let rounded = filtered("sed s/[0-9][0-9]*p/0p/g");
    let (right, other) = (right(), rounded.as_str());
    let compare = |candidates: [&str; 2], more: &[&str]| {
        let [a, b] = candidates;
        let args = [
            "compare",
            "erf",
            "--region",
            "mid",
            "--cases",
            "10",
            "--no-speed",
        ];
        run(&[&args[..], &["--exec", a, "--exec", b], more].concat())
    };
    let d = compare([&right, other], &["--format", "json", "--output", path]);
    assert_eq!(d.code, 1, "{}", d.err);
    for candidates in [[&*right, other], [other, &right]] {
        let d = compare(candidates, &["--baseline", path, "--format", "json"]);
        let v: Value = serde_json::from_str(&d.out).unwrap();
        let changes = &v["baseline"]["changes"];
        assert_eq!(changes.as_array().map(Vec::len), Some(0), "{}", d.out);
    }
}

#[test]
fn where_to_look() {
    let program = right();
    let audit = |more: &[&str]| {
        json(&[&["audit", "erf", "--cases", "10", "--exec", &program], more].concat())
    };
    let regions = |v: &Value| -> Vec<(String, u64)> {
        let all = v["methods"][0]["regions"].as_array().unwrap();
        let one = |r: &Value| {
            (
                r["name"].as_str().unwrap().into(),
                r["cases"].as_u64().unwrap(),
            )
        };
        all.iter().map(one).collect()
    };
    let (code, v) = audit(&["--region", "mid", "--region", "small"]);
    let due = [("small".to_string(), 10), ("mid".to_string(), 10)];
    assert_eq!((code, regions(&v)), (0, due.to_vec()));
    let sides = "Re z=0.5..8, Im z=+-log 1e-9..1";
    let (code, v) = audit(&["--box", sides]);
    assert_eq!((code, regions(&v)), (0, vec![("box".to_string(), 10)]));
    let worst = &v["methods"][0]["worst"][0];
    let re = worst["case"]["input"][0].as_f64().unwrap();
    assert!((0.5..=8.0).contains(&re), "{worst}");
    // Its command gives the same case.
    let words = shell_words::split(worst["reproduce"].as_str().unwrap()).unwrap();
    let words: Vec<&str> = words[1..].iter().map(String::as_str).collect();
    let (_, again) = json(&words);
    let again = &again["methods"][0];
    assert_eq!(
        (&again["worst"][0]["case"], &again["cases"]),
        (&worst["case"], &1.into())
    );
    let (code, v) = audit(&["--near", "1.5,-0.25", "--radius", "1e-6"]);
    assert_eq!((code, regions(&v)), (0, vec![("near".to_string(), 10)]));
    let (_, all) = audit(&[]);
    let (code, v) = audit(&["--ordinary"]);
    assert_eq!(code, 0);
    assert!(regions(&v).len() < regions(&all).len());
    for region in v["methods"][0]["regions"].as_array().unwrap() {
        assert!(region["kinds"]["infinity"] == 0, "{region}");
    }
    let bad = r#"
        --box Re=1..2                   | erf has no input "Re" (did you mean "Re z"?); it has: Re z, Im z
        --box 'Re z=1..2,Im z=log 0..1' | both ends of one sign
        --near zero                     | --radius
        --near 1 --radius 0.1           | 1 numbers where 2 are due
        --radius 0.1                    | --near
        --case 3                        | of which region?
        --ulps 3 --relative 1e-3        | --relative
        --relative 0                    | must be a positive number
    "#;
    for [args, part] in cells(bad) {
        let words = shell_words::split(&format!("audit erf {args}")).unwrap();
        let words: Vec<&str> = words.iter().map(String::as_str).collect();
        refused(&run(&words), &part);
    }
}

#[test]
fn budgets_of_ones_own() {
    // Six digits.
    let coarse = format!("{PROGRAM} eval erf --digits 6");
    let audit = |more: &[&str]| {
        let args = [
            "audit", "erf", "--region", "mid", "--cases", "20", "--exec", &coarse,
        ];
        run(&[&args[..], more].concat())
    };
    assert_eq!(audit(&[]).code, 1);
    for (more, code, said) in [
        (&["--relative", "1e-5"][..], 0, "relative error 1e-5"),
        (&["--relative", "1e-9"], 1, "relative error 1e-9"),
        (&["--absolute", "1e-30"], 1, "absolute error 1e-30"),
        (
            &["--relative", "1e-30", "--absolute", "1e30"],
            0,
            "or absolute error 1e30",
        ),
        (
            &["--normwise", "1e-4"],
            0,
            "all together: 1.000e-4 of the norm",
        ),
        (
            &["--normwise", "1e-8"],
            1,
            "all together: 1.000e-8 of the norm",
        ),
        (&["--ulps", "1e12"], 0, "1000000000000 ulp"),
        (&["--single", "--ulps", "100"], 0, "in single precision"),
        (&["--single", "--ulps", "0.6"], 1, "in single precision"),
    ] {
        let d = audit(more);
        assert_eq!(d.code, code, "{more:?}: {}", d.out);
        let words: Vec<&str> = d.out.split_whitespace().collect();
        assert!(
            words.join(" ").contains(said),
            "{said} is missing in {}",
            d.out
        );
    }
}

/// A program for binary frames, if there is Python.
fn binary(folder: &Path, body: &str) -> Option<String> {
    let there = std::process::Command::new("python3")
        .arg("--version")
        .output();
    there.ok().filter(|o| o.status.success())?;
    let path = folder.join("binary.py");
    let text = format!(
        "import os, struct, sys\n\
         assert os.environ['MECHAUDIT_PROTOCOL'] == 'binary'\n\
         r, w = sys.stdin.buffer, sys.stdout.buffer\n\
         def numbers():\n    \
             while head := r.read(8):\n        \
                 n, = struct.unpack('<Q', head)\n        \
                 yield struct.unpack(f'<{{n}}d', r.read(8 * n))\n\
         def answer(*v):\n    w.write(struct.pack(f'<Q{{len(v)}}d', len(v), *v))\n{body}"
    );
    std::fs::write(&path, text).unwrap();
    Some(format!("python3 {}", path.to_str().unwrap()))
}

#[test]
fn binary_frames() {
    let folder = tempfile::tempdir().unwrap();
    let header = "t = b'name: framed\\nversion: 0.1'\n\
                  w.write(struct.pack('<QQ', 2**64 - 2, len(t)) + t + bytes(-len(t) % 8))\n";
    // The rotation by a quarter turn is no error function: every case is over.
    let turned = "for x, y in numbers():\n    answer(-y, x)\n";
    for (body, answered, kind, said) in [
        (format!("{header}{turned}"), 20, None, ""),
        (
            "for x, y in numbers():\n    w.write(struct.pack('<Q', 2**64 - 1))\n".into(),
            20,
            Some("refusal"),
            "",
        ),
        (
            "answer(1.0, 2.0)\nw.write(b'abc')\n".into(),
            2,
            Some("unanswered"),
            "18 of 20",
        ),
        (
            "w.write(b'garbage!' * 100)\n".into(),
            0,
            Some("unanswered"),
            "claims",
        ),
        (
            "answer(1.0, 2.0)\nw.write(struct.pack('<Q', 2**40))\n".into(),
            1,
            Some("unanswered"),
            "claims",
        ),
        (
            "while True: answer(1.0, 2.0)\n".into(),
            20,
            None,
            "one more line",
        ),
        (
            "import time\nw.flush()\ntime.sleep(100)\n".into(),
            0,
            Some("unanswered"),
            "1 s",
        ),
    ] {
        let Some(program) = binary(folder.path(), &body) else {
            return;
        };
        let args = [
            "audit", "erf", "--region", "mid", "--cases", "20", "--binary",
        ];
        let (code, v) = json(&[&args[..], &["--timeout", "1", "--exec", &program]].concat());
        let m = &v["methods"][0];
        let c = &m["candidate"];
        assert_eq!(
            (code, &m["cases"], &c["answered"]),
            (1, &20.into(), &answered.into()),
            "{body}"
        );
        let trouble = c["trouble"].as_str().unwrap_or("");
        assert!(
            trouble.contains(said) && trouble.is_empty() == said.is_empty(),
            "{trouble}"
        );
        if let Some(kind) = kind {
            assert!(
                m["total"]["kinds"][kind].as_u64().unwrap() > 0,
                "{body}: {}",
                m["total"]
            );
        }
        if body.contains("framed") {
            assert_eq!(
                (&c["name"], &c["version"]),
                (&"framed".into(), &"0.1".into())
            );
        }
    }
}

#[test]
fn a_method_described() {
    for method in mechaudit::methods::registry() {
        let (code, v) = json(&["describe", method.name()]);
        assert_eq!(code, 0);
        let layout = mechaudit::audit::Layout::new(&*method);
        assert_eq!(v["inputs"].as_array().unwrap().len(), layout.parts());
        assert_eq!(v["answer"], layout.answer().as_str());
        assert_eq!(
            v["outputs"].as_array().unwrap().len(),
            method.outputs().len()
        );
        assert!(v["rust"].as_str().unwrap().starts_with("Fn("));
        let line = v["example"]["input"].as_str().unwrap();
        let d = run(&["audit", method.name(), "--at", line]);
        assert_eq!(d.code, 0, "{}{}", d.out, d.err);
    }
    let d = run(&["describe", "cubic-spline-clamped"]);
    for part in ["in Rust", "a line in", "a line out", "regions", "budget"] {
        assert!(d.out.contains(part), "{part} is missing in {}", d.out);
    }
    refused(&run(&["describe", "nothing"]), "nothing");
}
