//! Campaigns: the same bytes however they are cut, killed and taken up again; nothing lost, nothing
//! counted twice.

use crate::common::{self, Done, done, refused, run, said, text};
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Child;
use std::thread;
use std::time::Duration;
use tempfile::TempDir;

/// Every kind of part, in a second or two.
const PLAN: &str = r#"
    name = "small"
    [[part]]
    methods = ["faddeeva", "erf"]
    seeds = [1, 2]
    cases = 10
    [[part]]
    methods = ["faddeeva"]
    box = "Re z=0..8,Im z=log 1e-9..1"
    cases = 100
    [[part]]
    kind = "hunt"
    methods = ["four-bar"]
    hunts = 12
    evaluations = 60
    [[part]]
    kind = "candidate"
    methods = ["tridiagonal"]
    exec = "sh -c 'while read line; do echo refuse; done'"
    cases = 5
    [[part]]
    kind = "proof"
    methods = ["faddeeva"]
    within = 0.01
"#;

fn campaign(args: &[&str]) -> Done {
    run(&[&["campaign"], args].concat())
}

/// Makes the folder of a plan.
fn planned(folder: &TempDir, name: &str, plan: &str, shards: u64) -> PathBuf {
    let file = folder.path().join("plan.toml");
    fs::write(&file, plan).unwrap();
    let output = folder.path().join(name);
    let shards = shards.to_string();
    let made = campaign(&[
        "plan",
        text(&file),
        "--shards",
        &shards,
        "--output",
        text(&output),
    ]);
    assert_eq!(made.code, 0, "{}", made.err);
    output
}

fn shards(folder: &Path) -> PathBuf {
    folder.join("shards")
}

fn shard(folder: &Path, k: u64) -> PathBuf {
    shards(folder).join(format!("{k:06}.json"))
}

/// The sum, of a plan with findings.
fn merged(folder: &Path) -> String {
    let d = campaign(&["merge", text(folder)]);
    assert_eq!(d.code, 1, "{}", d.err);
    d.out
}

fn status(folder: &Path) -> Value {
    let d = campaign(&["status", text(folder), "--format", "json"]);
    serde_json::from_str(&d.out).unwrap()
}

fn finished(folder: &Path) {
    let d = campaign(&["run", text(folder)]);
    assert_eq!(d.code, 0, "{}", d.err);
}

/// Begins a run on a number of threads.
fn begun(folder: &Path, jobs: &str, more: &[&str]) -> Child {
    common::start(&[&["campaign", "run", text(folder), "--jobs", jobs], more].concat())
}

#[test]
fn the_sum_is_the_same_however_it_is_cut_and_killed() {
    let folder = tempfile::tempdir().unwrap();
    let whole = planned(&folder, "one", PLAN, 1);
    finished(&whole);
    let due = merged(&whole);
    // The sum of an audit is the audit.
    let v: Value = serde_json::from_str(&due).unwrap();
    let audit = run(&[
        "audit", "erf", "--seed", "2", "--cases", "10", "--format", "json",
    ]);
    let audit: Value = serde_json::from_str(&audit.out).unwrap();
    let (sum, alone) = (&v["parts"][3]["found"], &audit["methods"][0]);
    for member in ["method", "cases", "passed", "laws"] {
        assert_eq!(sum[member], alone[member], "{member}");
    }
    for member in ["max", "count"] {
        let of = |v: &Value| v["total"]["outputs"][0]["ulps"][member].clone();
        assert_eq!(of(sum), of(alone), "{member}");
    }
    for time in ["seconds", "/tmp", "elapsed"] {
        assert!(!due.contains(time), "{time}");
    }

    // Some backwards, one by one, on several threads.
    let seven = planned(&folder, "seven", PLAN, 7);
    for k in [5, 2, 6, 0, 3] {
        let k = k.to_string();
        let d = campaign(&["run", text(&seven), "--shard", &k, "--jobs", "3"]);
        assert_eq!(d.code, 0, "{}", d.err);
        assert!(d.out.starts_with("1 shard done"), "{}", d.out);
    }
    assert_eq!(status(&seven)["missing"], serde_json::json!([1, 4]));
    finished(&seven);
    assert_eq!(merged(&seven), due);

    // Killed again and again, and two at a time.
    let many = planned(&folder, "many", PLAN, 24);
    let mut pause = 20;
    for _ in 0..4 {
        let mut both = [
            begun(&many, "1", &[]),
            begun(&many, "2", &["--shard", "12-23"]),
        ];
        thread::sleep(Duration::from_millis(pause));
        for child in &mut both {
            child.kill().unwrap();
            child.wait().unwrap();
        }
        pause = pause * 3 / 2;
    }
    let both = [begun(&many, "1", &[]), begun(&many, "1", &[])];
    let both = both.map(|child| done(child.wait_with_output().unwrap()));
    for d in &both {
        assert_eq!(d.code, 0, "{}", d.err);
    }
    assert_eq!(merged(&many), due);
    // Neither locks nor halves are left.
    assert_eq!(common::names(&shards(&many)).len(), 24);
    // Nothing is done twice.
    finished(&many);
    let again = campaign(&["run", text(&many)]);
    assert_eq!(again.out, "0 shards done, 24 done before.\n");
    // Somebody was killed when all but the claim was gone.
    fs::write(shards(&many).join("000012.lock"), "").unwrap();
    finished(&many);
    assert_eq!(common::names(&shards(&many)).len(), 24);
}

/// A plan without findings, done at once.
const CALM: &str = r#"
    name = "calm"
    [[part]]
    methods = ["erf"]
    regions = ["small"]
    cases = 400
"#;

#[test]
fn what_cannot_be_a_campaign_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("plan.toml");
    let output = folder.path().join("out");
    let asked = |plan: &str, shards: &str| {
        fs::write(&file, plan).unwrap();
        campaign(&[
            "plan",
            text(&file),
            "--shards",
            shards,
            "--output",
            text(&output),
        ])
    };
    refused(
        &asked(&CALM.replace("\"erf\"", "\"erff\""), "2"),
        "part 1: there is no method \"erff\" (did you mean \"erf\"?)",
    );
    refused(
        &asked(CALM, "401"),
        "401 are more than the 400 cases and hunts",
    );
    assert!(!output.exists());
    assert_eq!(asked(CALM, "2").code, 0);
    // The same again is no harm, something else is.
    assert_eq!(asked(CALM, "2").code, 0);
    refused(&asked(CALM, "3"), "another campaign, \"calm\" in 2 shards");
    refused(
        &campaign(&["run", text(&output), "--shard", "2"]),
        "the shards are numbered 0 to 1",
    );
    refused(
        &campaign(&["run", text(folder.path())]),
        "it has no plan.json",
    );
    refused(
        &campaign(&["plan", text(&file), "--output", text(folder.path())]),
        "the folder is not empty",
    );
}

/// Nothing can be written: a message, no half of a file, and all of it later.
#[test]
fn a_full_disk_loses_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let own = planned(&folder, "own", CALM, 3);
    let d = campaign(&["run", text(&own), "--shard", "0"]);
    assert_eq!(d.code, 0, "{}", d.err);
    // Files of more than 512 bytes cannot be written.
    let program = env!("CARGO_BIN_EXE_mechaudit");
    let limited = format!(
        "ulimit -f 1; trap '' XFSZ; exec {program} campaign run {}",
        text(&own)
    );
    let d = done(
        std::process::Command::new("sh")
            .args(["-c", &limited])
            .output()
            .unwrap(),
    );
    assert_eq!(d.code, 2, "{}{}", d.out, d.err);
    said(&d, "cannot write");
    let left = common::names(&shards(&own));
    assert!(
        left.iter()
            .all(|n| n == "000000.json" || n.ends_with(".lock")),
        "{left:?}"
    );
    finished(&own);
    assert_eq!(campaign(&["merge", text(&own)]).code, 0);
}

#[test]
fn a_read_only_folder_is_refused_at_once() {
    use std::os::unix::fs::PermissionsExt;
    let folder = tempfile::tempdir().unwrap();
    let own = planned(&folder, "own", CALM, 3);
    let mode = |m| fs::set_permissions(shards(&own), fs::Permissions::from_mode(m)).unwrap();
    mode(0o555);
    let probe = shards(&own).join("probe");
    if fs::write(&probe, "").is_ok() {
        // A superuser writes everywhere.
        fs::remove_file(probe).unwrap();
        common::skipped("a user who is refused");
    } else {
        refused(&campaign(&["run", text(&own)]), "cannot write");
    }
    mode(0o755);
    finished(&own);
}

#[test]
fn the_first_ctrl_c_drops_the_shard_under_way() {
    let folder = tempfile::tempdir().unwrap();
    let plan = CALM.replace("cases = 400", "cases = 400_000");
    let own = planned(&folder, "own", &plan, 40);
    let child = begun(&own, "1", &[]);
    while common::names(&shards(&own))
        .iter()
        .all(|n| n.ends_with(".lock"))
    {
        thread::sleep(Duration::from_millis(5));
    }
    let kill = std::process::Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status();
    assert!(kill.unwrap().success());
    let d = done(child.wait_with_output().unwrap());
    assert_eq!(d.code, 130, "{}{}", d.out, d.err);
    assert!(d.out.starts_with("Interrupted: "), "{}", d.out);
    let v = status(&own);
    let there = common::names(&shards(&own));
    assert_eq!(v["done"].as_u64().unwrap(), there.len() as u64, "{there:?}");
    assert_eq!(v["bad"], serde_json::json!([]));
    // A page of what is done until now.
    let d = campaign(&["report", text(&own)]);
    assert_eq!(d.code, 0, "{}", d.err);
    assert!(d.out.contains("Under way"));
    common::needs_nothing_else(&d.out);
}

#[test]
fn a_page_shows_audits_hunts_and_proofs() {
    let folder = tempfile::tempdir().unwrap();
    let own = planned(&folder, "own", PLAN, 3);
    let d = campaign(&["report", text(&own)]);
    assert!(d.err.contains("3 of 3 shards not done"), "{}", d.err);
    finished(&own);
    let d = campaign(&["status", text(&own)]);
    assert!(d.out.contains("a second and thread.\n"), "{}", d.out);
    let d = campaign(&["report", text(&own)]);
    assert!(!d.err.contains("not done"), "{}", d.err);
    assert_eq!(d.code, 1, "{}", d.err);
    for part in [
        "<title>Campaign small: NOT as expected</title>",
        "3 of 3 shards done",
        "id=\"hunts\"",
        "href=\"#hunts\"",
        "id=\"proofs\"",
        "href=\"#proofs\"",
        "erf, seed 2",
        "four-bar",
    ] {
        assert!(d.out.contains(part), "{part}");
    }
    common::needs_nothing_else(&d.out);
}

/// A shard that another run does is waited for, and done where that run leaves it.
#[test]
fn a_shard_of_another_run_is_not_given_up() {
    let folder = tempfile::tempdir().unwrap();
    let own = planned(&folder, "own", &CALM.replace("400", "4"), 2);
    let lock = fs::File::create(shards(&own).join("000000.lock")).unwrap();
    lock.lock().unwrap();
    let child = begun(&own, "1", &[]);
    while !shard(&own, 1).exists() {
        thread::sleep(Duration::from_millis(5));
    }
    assert!(!shard(&own, 0).exists());
    drop(lock);
    let d = done(child.wait_with_output().unwrap());
    assert_eq!(d.code, 0, "{}", d.err);
    assert!(d.out.starts_with("2 shards done"), "{}", d.out);
}

/// Its shard is not done, and nothing is counted in its place; others are.
#[test]
fn a_program_that_ends_leaves_its_shard() {
    let folder = tempfile::tempdir().unwrap();
    let plan = r#"
        name = "dies"
        [[part]]
        kind = "candidate"
        methods = ["erf"]
        regions = ["small"]
        cases = 40
        exec = "sh -c 'test -e FLAG || { read x; echo 0,0; exit 3; }; while read x; do echo 0,0; done'"
    "#;
    let flag = folder.path().join("flag");
    let own = planned(&folder, "own", &plan.replace("FLAG", text(&flag)), 2);
    let d = campaign(&["run", text(&own)]);
    assert_eq!(d.code, 2);
    said(
        &d,
        "2 shards cannot be done, the first: 0, part 1: The program answered 1 times",
    );
    assert_eq!(status(&own)["done"], 0);
    fs::write(&flag, "").unwrap();
    finished(&own);
    let v: Value = serde_json::from_str(&merged(&own)).unwrap();
    let found = &v["parts"][0]["found"];
    assert_eq!(
        (found["cases"].as_u64(), found["passed"].as_u64()),
        (Some(40), Some(0))
    );
}

#[test]
fn new_worst_cases_are_recorded() {
    let folder = tempfile::tempdir().unwrap();
    let hard = folder.path().join("hard");
    fs::create_dir(&hard).unwrap();
    let own = planned(&folder, "own", PLAN, 3);
    finished(&own);
    let record = || campaign(&["merge", text(&own), "--hard", text(&hard), "--output", "-"]);
    let d = record();
    said(&d, "faddeeva: hard case 1 added, Re W at ");
    // Not of a candidate.
    let files = ["erf.csv", "faddeeva.csv", "four-bar.csv"];
    assert_eq!(common::names(&hard), files);
    let judged = run(&[
        "audit",
        "faddeeva",
        "--hard",
        text(&hard),
        "--hard-case",
        "1",
    ]);
    assert_eq!(judged.code, 0, "{}{}", judged.out, judged.err);
    // Nothing is worse than itself, and the sum is the same.
    let again = record();
    assert_eq!((again.err.as_str(), &again.out), ("", &d.out));
    assert_eq!(d.out, merged(&own));
    let nowhere = folder.path().join("none");
    refused(
        &campaign(&["merge", text(&own), "--hard", text(&nowhere)]),
        "no such folder",
    );
}

/// The recipes that run here; `mechaudit` is on the path.
#[test]
fn recipes() {
    let folder = tempfile::tempdir().unwrap();
    let whole = planned(&folder, "one", CALM, 1);
    finished(&whole);
    let due = campaign(&["merge", text(&whole)]).out;
    let program = Path::new(env!("CARGO_BIN_EXE_mechaudit"));
    let mut places = vec![program.parent().unwrap().to_path_buf()];
    places.extend(std::env::split_paths(&std::env::var_os("PATH").unwrap()));
    let path = std::env::join_paths(places).unwrap();
    let recipe = |name: &str| {
        let script =
            Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).join("examples/campaigns");
        let mut recipe = std::process::Command::new("sh");
        recipe.arg(script.join(name)).env("PATH", &path);
        recipe
    };
    let by = |name: &str| {
        // Whatever the folder's name, no recipe takes a part of it for its own.
        let own = planned(&folder, &format!("K {{}} $0 ' {name}"), CALM, 9);
        let d = done(recipe(name).arg(&own).arg("3").output().unwrap());
        assert_eq!(d.code, 0, "{name}: {}{}", d.out, d.err);
        assert_eq!(campaign(&["merge", text(&own)]).out, due, "{name}");
    };
    by("xargs.sh");
    let gnu = std::process::Command::new("parallel")
        .arg("--version")
        .output();
    match gnu {
        Ok(said) if said.stdout.starts_with(b"GNU") => by("parallel.sh"),
        _ => common::skipped("GNU parallel"),
    }
    // As Slurm runs its tasks, in any order; one was lost and is run again.
    let own = planned(&folder, "slurm-array.sh", CALM, 4);
    for task in ["2", "0", "3", "2", "1"] {
        let mut array = recipe("slurm-array.sh");
        let d = done(
            array
                .arg(&own)
                .env("SLURM_ARRAY_TASK_ID", task)
                .output()
                .unwrap(),
        );
        assert_eq!(d.code, 0, "{}", d.err);
    }
    assert_eq!(campaign(&["merge", text(&own)]).out, due);
    assert_eq!(campaign(&["status", text(&own), "--missing"]).out, "");
}

/// The plans that are committed are plans.
#[test]
fn committed_plans() {
    let root = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."));
    let folder = tempfile::tempdir().unwrap();
    let mut all = vec![root.join("examples/campaign.toml")];
    let plans = fs::read_dir(root.join("reference/campaigns")).unwrap();
    let plans = plans.map(|e| e.unwrap().path());
    all.extend(plans.filter(|p| p.extension().is_some_and(|e| e == "toml")));
    assert!(all.len() > 3, "{all:?}");
    for plan in all {
        let name = plan.file_stem().unwrap().to_str().unwrap();
        let output = folder.path().join(name);
        let d = campaign(&["plan", text(&plan), "--output", text(&output)]);
        assert_eq!(d.code, 0, "{}", d.err);
        assert!(
            d.out.starts_with(&format!("{name}: ")) || name == "campaign",
            "{}",
            d.out
        );
    }
}
