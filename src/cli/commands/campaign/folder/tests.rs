use super::*;
use mechaudit::campaign::PartContent;
use mechaudit::machine::Source;
use tempfile::TempDir;

/// Nine cases of one region.
fn plan(name: &str) -> Plan {
    let text = format!(
        "name = \"{name}\"\n[[part]]\nmethods = [\"erf\"]\nregions = [\"small\"]\ncases = 9"
    );
    Plan::read(&Source::toml(text)).unwrap()
}

fn made(shards: u64) -> (TempDir, Folder) {
    let place = tempfile::tempdir().unwrap();
    let folder = Folder::make(&place.path().join("x"), plan("x"), shards);
    let folder = folder.unwrap_or_else(|e| panic!("{e}"));
    (place, folder)
}

fn why(found: Result<Folder, Failure>) -> String {
    found
        .map(|_| panic!("a folder"))
        .unwrap_or_else(|e: Failure| e.to_string())
}

fn content(folder: &Folder, k: u64) -> Content {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .unwrap();
    let stop = std::sync::atomic::AtomicBool::new(false);
    let (plan, deal) = (&folder.plan, &folder.deal);
    let none: &mechaudit::campaign::Answering = &|_, _, _, _| Ok(None);
    let found = mechaudit::campaign::run((plan, deal, k), &pool, none, &|_| (), &stop);
    found.unwrap().unwrap()
}

fn is_done(folder: &Folder, k: u64) -> bool {
    matches!(folder.state(k).unwrap(), State::Done(_))
}

/// A shard has a unit, the same plan is the same folder, and nothing else is written over.
#[test]
fn a_folder_is_of_one_campaign() {
    let place = tempfile::tempdir().unwrap();
    let path = place.path().join("deep/x");
    let many = why(Folder::make(&path, plan("x"), 10));
    assert_eq!(
        many,
        "--shards: 10 are more than the 9 cases and hunts of the plan"
    );
    assert!(!path.exists());
    assert!(Folder::make(&path, plan("x"), 9).is_ok());
    let again = Folder::make(&path, plan("x"), 9).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(
        (again.deal.shards(), again.digest.clone()),
        (9, plan("x").digest())
    );
    for (name, shards) in [("x", 8), ("y", 9)] {
        let other = why(Folder::make(&path, plan(name), shards));
        let due = format!(
            "{}: there is another campaign, \"x\" in 9 shards",
            path.display()
        );
        assert_eq!(other, due);
    }
    let full = place.path();
    let due = format!("{}: the folder is not empty", full.display());
    assert_eq!(why(Folder::make(full, plan("x"), 2)), due);
}

#[test]
fn a_folder_is_opened_as_it_was_made() {
    let (place, folder) = made(4);
    let path = place.path().join("x");
    let opened = Folder::open(&path).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(
        (opened.plan, opened.identity),
        (plan("x"), folder.identity.clone())
    );
    assert_eq!((opened.deal.shards(), opened.deal.units()), (4, 9));
    assert!(folder.same_program().is_ok());
    assert_eq!(folder.file(12), path.join("shards/000012.json"));
    let none = why(Folder::open(place.path()));
    let due = format!(
        "{}: no campaign's folder, it has no plan.json",
        place.path().display()
    );
    assert_eq!(none, due);
}

/// A plan that was changed, or is of another program or form, is not worked on.
#[test]
fn a_plan_that_was_changed_is_refused() {
    let (place, folder) = made(4);
    let path = place.path().join("x");
    let file = path.join(PLAN);
    let text = fs::read_to_string(&file).unwrap();
    let changed = |from: &str, to: &str| {
        assert!(text.contains(from), "{from}");
        fs::write(&file, text.replace(from, to)).unwrap();
        why(Folder::open(&path))
    };
    let of = |what: &str| format!("{}: {what}", file.display());
    let digest = of("the plan is not what its digest says");
    assert_eq!(changed("\"cases\": 9", "\"cases\": 8"), digest);
    assert_eq!(changed("\"shards\": 4", "\"shards\": 0"), digest);
    assert_eq!(
        changed("\"campaign\": 1", "\"campaign\": 2"),
        of("its form has version 2, not 1")
    );
    assert!(changed("\"shards\": 4", "\"shard\": 4").starts_with(&of("unknown field `shard`")));
    assert!(changed("\"campaign\": 1", "\"campaign\": x").starts_with(&of("expected value")));
    assert!(changed("\"erf\"", "\"erff\"").starts_with(&of("part 1: there is no method \"erff\"")));
    fs::write(
        &file,
        text.replace(&folder.identity.solvers, &"0".repeat(64)),
    )
    .unwrap();
    let other = Folder::open(&path).unwrap_or_else(|e| panic!("{e}"));
    let said = other.same_program().unwrap_err().to_string();
    assert!(
        said.starts_with(&of("the plan is of another program: its solvers or draws ")),
        "{said}"
    );
}

#[test]
fn shards_are_written_read_and_set_aside() {
    let (_place, folder) = made(4);
    assert!(matches!(folder.state(1).unwrap(), State::Missing));
    assert!(folder.content(1).unwrap().is_none() && folder.bytes(1).unwrap().is_none());
    let due = content(&folder, 1);
    let write = |k: u64| {
        let claim = folder.claim(k).unwrap().unwrap();
        folder
            .write(claim, k, &content(&folder, k), (1.5, 2))
            .unwrap();
    };
    write(1);
    let State::Done(header) = folder.state(1).unwrap() else {
        panic!("it is done");
    };
    assert_eq!(
        (header.shard, header.shards, header.seconds, header.threads),
        (1, 4, 1.5, 2)
    );
    assert_eq!(folder.content(1).unwrap(), Some(due.clone()));
    assert!(matches!(&due.parts[..], [PartContent::Audit(_)]));
    // Neither a lock nor a temporary file is left.
    let names = || {
        let all = fs::read_dir(folder.file(0).parent().unwrap()).unwrap();
        let mut all: Vec<String> = all
            .map(|e| e.unwrap().file_name().into_string().unwrap())
            .collect();
        all.sort();
        all
    };
    assert_eq!(names(), ["000001.json"]);
    fs::write(folder.file(1), "half").unwrap();
    let State::Bad(said) = folder.state(1).unwrap() else {
        panic!("it is damaged");
    };
    assert_eq!(said, "damaged, its first line has no end");
    assert!(folder.content(1).unwrap().is_none());
    write(1);
    assert!(is_done(&folder, 1));
    assert_eq!(names(), ["000001.json", "000001.json.aside"]);
    assert_eq!(
        fs::read_to_string(folder.file(1).with_extension("json.aside")).unwrap(),
        "half"
    );
    // Another's number.
    fs::copy(folder.file(1), folder.file(2)).unwrap();
    let State::Bad(said) = folder.state(2).unwrap() else {
        panic!("it is another's");
    };
    assert_eq!(said, "foreign, it is shard 1 of 4");
    assert!(folder.content(2).unwrap().is_none());
    let states = folder.states().unwrap();
    let done: Vec<bool> = states.iter().map(|s| matches!(s, State::Done(_))).collect();
    assert_eq!(done, [false, true, false, false]);
    let whole = fs::read_to_string(folder.file(1)).unwrap();
    fs::write(
        folder.file(1),
        whole.replacen("_shard\":1", "_shard\":9", 1),
    )
    .unwrap();
    let said = folder.content(1).unwrap_err().to_string();
    let due = format!(
        "{}: its form has version 9, not 1",
        folder.file(1).display()
    );
    assert_eq!(said, due);
    // A folder in its place cannot be read.
    fs::create_dir(folder.file(3)).unwrap();
    let said = folder.bytes(3).unwrap_err().to_string();
    assert!(
        said.starts_with(&format!("cannot read {}: ", folder.file(3).display())),
        "{said}"
    );
}

/// One has it at a time; what a killed program left is taken away.
#[test]
fn a_claim_is_one_persons() {
    let (_place, folder) = made(4);
    let lock = folder.lock(2);
    let claim = folder.claim(2).unwrap().unwrap();
    assert!(lock.exists() && folder.claim(2).unwrap().is_none());
    assert!(folder.claim(3).unwrap().is_some(), "another shard");
    folder.sweep(2);
    assert!(lock.exists(), "somebody has it");
    folder.leave(claim);
    assert!(!lock.exists() && folder.claim(2).unwrap().is_some());
    assert!(lock.exists(), "nobody has released it");
    folder.sweep(2);
    assert!(!lock.exists());
    folder.sweep(1);
    assert!(!folder.lock(1).exists());
}
