use super::*;
use mechaudit::machine::Source;

/// Ten shards of 100 judgements, some done on two threads in 4 s each, one damaged, one of another
/// version.
fn status(done: u64, seconds: f64) -> Status {
    Status {
        name: "x".into(),
        shards: 10,
        done,
        missing: vec![7, 8],
        bad: vec![(8, "damaged".into())],
        refused: vec![(9, "other".into())],
        total: 1000,
        judged: 100 * done,
        seconds,
    }
}

#[test]
fn a_status_says_what_is_left() {
    let text = |status: Status| status.text(&|k| PathBuf::from(format!("shards/{k}")));
    let due = "x: 7 of 10 shards done, 70.0 % of 1000 judgements.\n\
               12 a second and thread; 24 s on one thread for the others.\n\
               shards/8: damaged\n";
    assert_eq!(text(status(7, 56.0)), due);
    let due = "x: 0 of 10 shards done, 0.0 % of 1000 judgements.\nshards/8: damaged\n";
    assert_eq!(text(status(0, 0.0)), due);
    let whole = Status {
        bad: Vec::new(),
        ..status(10, 8.0)
    };
    let due = "x: 10 of 10 shards done, 100.0 % of 1000 judgements.\n125 a second and thread.\n";
    assert_eq!(text(whole), due);
    // Too quick for a clock.
    let quick = Status {
        bad: Vec::new(),
        ..status(10, 0.0)
    };
    assert!(text(quick).ends_with("\n0 a second and thread.\n"));
    let none = Status {
        shards: 1,
        ..Status::default()
    };
    assert_eq!(text(none), ": 0 of 1 shard done, 0.0 % of 0 judgements.\n");
}

#[test]
fn a_status_for_programs_has_all_numbers() {
    let due = json!({
        "schema_version": 1,
        "name": "x",
        "shards": 10,
        "done": 7,
        "missing": [7, 8],
        "bad": [{ "shard": 8, "why": "damaged" }],
        "refused": [{ "shard": 9, "why": "other" }],
        "judgements": 1000,
        "judged": 700,
        "thread_seconds": 56.0,
    });
    assert_eq!(status(7, 56.0).document(), due);
}

/// Shards that are done, missing, damaged and of another version, in one folder.
#[test]
fn each_shard_is_counted_by_its_state() {
    let text = "name = \"x\"\n[[part]]\nmethods = [\"erf\"]\nregions = [\"small\"]\ncases = 9";
    let plan = Plan::read(&Source::toml(text)).unwrap();
    let place = tempfile::tempdir().unwrap();
    let Ok(folder) = Folder::make(&place.path().join("x"), plan, 4) else {
        panic!("a new folder");
    };
    let content = || {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(1)
            .build()
            .unwrap();
        let stop = std::sync::atomic::AtomicBool::new(false);
        let (plan, deal) = (&folder.plan, &folder.deal);
        let none: &mechaudit::campaign::Answering = &|_, _, _, _| Ok(None);
        let found = mechaudit::campaign::run((plan, deal, 0), &pool, none, &|_| (), &stop);
        found.unwrap().unwrap()
    };
    for (k, took) in [(0, (1.5, 2)), (2, (0.5, 1))] {
        let claim = folder.claim(k).unwrap().unwrap();
        folder.write(claim, k, &content(), took).unwrap();
    }
    std::fs::write(folder.file(1), "half").unwrap();
    let found = Status::of(&folder).unwrap();
    // Nine cases in four shards: three, two, two, two.
    assert_eq!(
        (found.shards, found.done, found.total, found.judged),
        (4, 2, 9, 5)
    );
    assert_eq!((found.missing, found.seconds), (vec![1, 3], 3.5));
    assert_eq!(found.bad.len(), 1);
    assert!(found.bad[0].0 == 1 && found.bad[0].1.starts_with("damaged, "));
    assert!(found.refused.is_empty() && found.name == "x");
    let whole = std::fs::read_to_string(folder.file(0)).unwrap();
    let other = whole.replacen("\"campaign_shard\":1", "\"campaign_shard\":2", 1);
    std::fs::write(folder.file(0), other).unwrap();
    let found = Status::of(&folder).unwrap();
    assert_eq!(
        (found.done, found.judged, found.missing),
        (1, 2, vec![1, 3])
    );
    let due = [(0, "its form has version 2, not 1".to_string())];
    assert_eq!(found.refused, due);
}

#[test]
fn times_in_words() {
    for (seconds, due) in [
        (0.4, "0 s"),
        (119.0, "119 s"),
        (120.0, "2 min"),
        (7199.0, "120 min"),
        (7200.0, "2.0 h"),
        (90_000.0, "25.0 h"),
    ] {
        assert_eq!(time(seconds), due);
    }
}

/// A folder of ten cases in three shards, of which these are done.
fn begun(more: &str, done: &[u64]) -> (tempfile::TempDir, PathBuf) {
    let text = format!(
        "name = \"x\"\n[[part]]\nmethods = [\"erf\"]\nregions = [\"small\"]\ncases = 10\n{more}"
    );
    let plan = Plan::read(&Source::toml(text)).unwrap();
    let place = tempfile::tempdir().unwrap();
    let path = place.path().join("x");
    let folder = Folder::make(&path, plan, 3).unwrap_or_else(|e| panic!("{e}"));
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .unwrap();
    let stop = std::sync::atomic::AtomicBool::new(false);
    for k in done {
        let (plan, deal) = (&folder.plan, &folder.deal);
        let none: &mechaudit::campaign::Answering = &|_, _, _, _| Ok(None);
        let found = mechaudit::campaign::run((plan, deal, *k), &pool, none, &|_| (), &stop);
        let claim = folder.claim(*k).unwrap().unwrap();
        folder
            .write(claim, *k, &found.unwrap().unwrap(), (1.0, 1))
            .unwrap();
    }
    (place, path)
}

/// A step that writes a file: what it came to, and the file.
fn step(words: &[&str], folder: &std::path::Path) -> (Result<Outcome, String>, String) {
    let file = folder.with_extension("out");
    let [folder, output] = [folder, &file].map(|p| p.to_str().unwrap());
    let all = [
        &["campaign"],
        &words[..1],
        &[folder, "--output", output],
        &words[1..],
    ]
    .concat();
    let outcome = crate::cli::ran(&all).map_err(|e| e.to_string());
    (outcome, std::fs::read_to_string(&file).unwrap_or_default())
}

/// Of shards of another version the first is named.
#[test]
fn a_shard_of_another_version_ends_a_look_at_all() {
    let (_place, path) = begun("", &[0, 1, 2]);
    let folder = Folder::open(&path).unwrap();
    for k in [2, 1] {
        let text = std::fs::read_to_string(folder.file(k)).unwrap();
        let other = text.replacen("\"campaign_shard\":1", "\"campaign_shard\":2", 1);
        std::fs::write(folder.file(k), other).unwrap();
    }
    let text = path.to_str().unwrap();
    let why = crate::cli::ran(&["campaign", "status", text])
        .unwrap_err()
        .to_string();
    let due = format!(
        "{}: its form has version 2, not 1",
        folder.file(1).display()
    );
    assert_eq!(why, due);
}

#[test]
fn a_sum_is_of_all_shards() {
    let (_place, path) = begun("", &[0, 2]);
    let (outcome, text) = step(&["merge"], &path);
    let due = format!("{}: 1 shard of 3 not done, the first: 1", path.display());
    assert_eq!((outcome, text.as_str()), (Err(due), ""));
    let (_none, path) = begun("", &[]);
    let due = format!("{}: 3 shards of 3 not done, the first: 0", path.display());
    assert_eq!(step(&["merge"], &path).0, Err(due));
    let (_whole, path) = begun("", &[0, 1, 2]);
    let (outcome, text) = step(&["merge"], &path);
    assert_eq!(outcome, Ok(Outcome::AsExpected));
    let v: Value = serde_json::from_str(&text).unwrap();
    let found = &v["parts"][0]["found"];
    assert_eq!(
        (&found["cases"], &found["passed"], &v["passed"]),
        (&json!(10), &json!(10), &json!(true))
    );
    assert_eq!(found["interrupted"], false);
    // No solver is as close as that.
    let (_strict, path) = begun("ulps = 1e-6", &[0, 1, 2]);
    assert_eq!(step(&["merge"], &path).0, Ok(Outcome::Finding));
    assert_eq!(step(&["report"], &path).0, Ok(Outcome::Finding));
}

#[test]
fn hard_cases_go_to_a_folder_that_is_there() {
    let (place, path) = begun("", &[0, 1, 2]);
    let hard = place.path().join("hard");
    let words = ["merge", "--hard", hard.to_str().unwrap()];
    let due = format!("--hard {}: there is no such folder", hard.display());
    assert_eq!(step(&words, &path), (Err(due), String::new()));
    std::fs::create_dir(&hard).unwrap();
    let plain = step(&["merge"], &path).1;
    assert_eq!(step(&words, &path), (Ok(Outcome::AsExpected), plain));
    assert!(hard.join("erf.csv").exists());
}

/// A page of what is done until now is no failure.
#[test]
fn a_page_says_how_many_shards_are_done() {
    for (done, share) in [
        (&[0, 2][..], "2 of 3 shards done"),
        (&[0, 1, 2], "3 of 3 shards done"),
    ] {
        let (_place, path) = begun("", done);
        let (outcome, page) = step(&["report"], &path);
        assert_eq!(outcome, Ok(Outcome::AsExpected), "{share}");
        assert!(
            page.starts_with("<!doctype html>") && page.contains(share),
            "{share}"
        );
        assert_eq!(page.contains("Under way"), done.len() < 3);
    }
}
