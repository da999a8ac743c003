use super::*;
use mechaudit::machine::Source;

/// Ten shards of 100 judgements, some done on two threads in 4 s each, one damaged, one of another version.
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
