//! Papers and their ledgers.

use crate::common::{digest, markup, needs_nothing_else, pin, refused, run, said, text as path};
use mechaudit::papers;
use mechaudit::report::{csv, html, latex, text};
use std::sync::Mutex;

/// In every form, from one audit.
fn in_every_form(key: &str) {
    let told = Mutex::new(Vec::new());
    let tell = |phase: &str, done, whole| told.lock().unwrap().push((phase == "done", done, whole));
    let paper = papers::audit(key, &tell).unwrap().unwrap();
    let changed = paper.findings.iter().filter(|f| !f.as_recorded);
    let changed: Vec<&str> = changed.map(|f| f.id).collect();
    assert!(paper.as_recorded(), "{key}: {changed:?}");
    // From the first phase to the end, each told as it begins.
    let told = told.into_inner().unwrap();
    let last = told.len() as u64 - 1;
    let due: Vec<_> = (0..=last).map(|k| (k == last, k, last)).collect();
    assert_eq!(told, due, "{key}");
    assert!(last > 1, "{key}");
    let lines: usize = paper.entries.iter().map(|e| e.variants.len()).sum();
    let mut rows = Vec::new();
    csv::paper(&paper, &mut rows).unwrap();
    let rows = String::from_utf8(rows).unwrap();
    assert_eq!(rows.lines().count(), 1 + lines);
    let html = html::paper::page(&paper, papers::motion_of(key).as_ref());
    assert!(html.starts_with("<!doctype html>") && html.trim_end().ends_with("</html>"));
    needs_nothing_else(&html);
    readable(&html);
    let figures = paper.findings.iter().flat_map(|f| &f.figures);
    let formulas = figures.filter(|g| g.latex.is_some()).count();
    assert_eq!(html.matches("<math display=\"block\"").count(), formulas);
    assert_eq!(key == "gembara-senyk", formulas > 20, "{key}: {formulas}");
    let words = plain(&text::paper::paper(&paper, WIDTH));
    assert!(!words.contains("kg m^2"));
    let json = serde_json::to_string_pretty(&paper).unwrap() + "\n";
    let all = [
        ("json", json),
        ("csv", rows),
        ("html", html),
        ("text", words),
    ];
    let digests = all
        .each_ref()
        .map(|(form, due)| format!("{form} {}", digest(due)));
    pin(&format!("paper-{key}"), &digests.join("\n"));
    if key == QUICK {
        for (form, due) in all {
            let d = run(&["paper", key, "--format", form]);
            assert_eq!((d.code, d.out), (0, due), "{form}: {}", d.err);
        }
    }
}

#[test]
fn zinchenko() {
    in_every_form("zinchenko");
}

#[test]
fn gembara_senyk() {
    in_every_form("gembara-senyk");
}

#[test]
fn andrews() {
    in_every_form("andrews");
}

#[test]
fn those_of_a_moment() {
    let dear = ["zinchenko", "gembara-senyk", "andrews"];
    for key in papers::keys() {
        if !dear.contains(&key) {
            in_every_form(key);
        }
    }
}

#[test]
fn ledgers_in_every_form() {
    for key in papers::keys() {
        let ledger = papers::ledger_of(key).unwrap();
        assert!(ledger.as_recorded(), "{key}");
        // The specification of the N four-bar mechanism prints few formulas, a drawing none.
        let least = match key {
            "n-four-bar" => 25,
            "pmksweb" => 8,
            _ => 50,
        };
        assert!(ledger.entries.len() > least);
        let html = html::ledger::page(&ledger);
        assert!(html.starts_with("<!doctype html>") && html.trim_end().ends_with("</html>"));
        needs_nothing_else(&html);
        assert!(html.contains("<math"));
        readable(&html);
        let latex = latex::ledger(&ledger);
        assert!(latex.contains(r"\begin{document}"));
        let words = plain(&text::ledger::ledger(&ledger, WIDTH));
        let joined = words.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(joined.contains("all as recorded"), "{joined}");
        let json = serde_json::to_string_pretty(&ledger).unwrap() + "\n";
        if key == QUICK {
            let form = |f: &str| run(&["paper", key, "--ledger", "--format", f]);
            for (name, due) in [("json", json), ("html", html), ("latex", latex)] {
                let d = form(name);
                assert_eq!((d.code, d.out), (0, due), "{name}: {}", d.err);
            }
            // With the time that it took.
            let d = form("text");
            assert_eq!(d.code, 0, "{}", d.err);
            let head = d.out.split("\nDecided in ").next().unwrap();
            assert_eq!(head.trim_end(), words.trim_end());
            refused(&form("csv"), "a ledger has no CSV form");
            refused(&run(&["paper", key, "--format", "latex"]), "add --ledger");
        }
    }
    refused(
        &run(&["paper", "none", "--ledger"]),
        "there is no paper \"none\"",
    );
}

/// The paper that is audited in no time.
const QUICK: &str = "pmksweb";

/// Where the output is no terminal and no file.
const WIDTH: usize = 80;

/// Without the colours of a terminal.
fn plain(text: &str) -> String {
    anstream::adapter::strip_str(text).to_string()
}

#[test]
fn errata_are_written_whole_and_checked() {
    let dir = tempfile::tempdir().unwrap();
    let file = dir.path().join("errata.json");
    let errata = |check: bool| {
        let mut args = vec!["paper", "zinchenko", "--ledger", "--format", "errata"];
        args.extend(["--output", path(&file)]);
        args.extend(check.then_some("--check"));
        run(&args)
    };
    refused(&errata(true), "cannot read");
    assert_eq!(errata(false).code, 0);
    assert_eq!(errata(true).code, 0);
    std::fs::write(&file, "{}").unwrap();
    let d = errata(true);
    assert_eq!(d.code, 1);
    said(&d, "is not up to date");
    assert_eq!(std::fs::read_to_string(&file).unwrap(), "{}");
    let d = run(&["paper", "zinchenko", "--check", "--output", path(&file)]);
    refused(&d, "--ledger");
}

/// A page for people: contents that lead to every part, no markup left as it was typed.
/// `tests/browser` opens it.
fn readable(html: &str) {
    let text = markup(html);
    for raw in ["`", "kg m^2", "rad/s^2", "series(n"] {
        assert!(!text.contains(raw), "{raw}");
    }
    let values = |how: &str| -> Vec<String> {
        let parts = text.split(how).skip(1);
        parts
            .map(|p| p.split('"').next().unwrap().to_string())
            .collect()
    };
    let (links, ids) = (values("href=\"#"), values(" id=\""));
    assert!(links.len() >= text.matches("<article").count() && links.len() > 5);
    for link in &links {
        assert_eq!(ids.iter().filter(|id| *id == link).count(), 1, "{link}");
    }
}

/// The skeleton runs, keeps its verdicts, and tells which of them changed, with file and line.
#[test]
fn a_paper_is_a_folder() {
    let dir = tempfile::tempdir().unwrap();
    let folder = dir.path().join("mine");
    let run = |more: &[&str]| run(&[&["paper", path(&folder)], more].concat());
    assert_eq!(crate::common::run(&["paper", "new", path(&folder)]).code, 0);
    refused(
        &crate::common::run(&["paper", "new", path(&folder)]),
        "is there already",
    );
    let d = run(&["--check"]);
    assert_eq!((d.code, d.out.as_str(), d.err.as_str()), (0, "", ""));
    let d = run(&[]);
    assert_eq!(d.code, 0, "{}{}", d.out, d.err);
    assert!(
        d.out.contains("21 of 22 printed numbers are right"),
        "{}",
        d.out
    );
    for form in ["json", "csv", "html"] {
        assert_eq!(run(&["--format", form]).code, 0, "{form}");
    }
    for form in ["text", "json", "html", "latex", "errata"] {
        assert_eq!(run(&["--ledger", "--format", form]).code, 0, "{form}");
    }
    let file = folder.join("paper.toml");
    let text = std::fs::read_to_string(&file).unwrap();
    let write = |old: &str, new: &str| std::fs::write(&file, text.replace(old, new)).unwrap();
    write("j = 4*pi^2", "j = 8*pi^2");
    let d = run(&["--check"]);
    assert_eq!(d.code, 1);
    said(&d, "paper.toml, line 87");
    said(&d, "jerk is misprint, on record as proved");
    assert_eq!(run(&[]).code, 1);
    write(
        "requires = [\"m = int(x, 0, 1, s)\"]",
        "requires = [\"m = int(x, 0, 1, sh)\"]",
    );
    let d = run(&[]);
    refused(&d, "paper.toml: line 8");
    refused(&d, "the name sh is not declared");
    std::fs::write(
        folder.join("table-1.csv"),
        "x,s,a\n0,zero,0\n1,1,1\n2,2,2\n3,3,3\n4,4,4\n",
    )
    .unwrap();
    std::fs::write(&file, text).unwrap();
    refused(
        &run(&["--check"]),
        "table-1.csv: line 2: column s: \"zero\" is no number",
    );
}

/// A folder of two papers, one of which has a program for its solver: run where `--exec` says so,
/// in the paper's folder, and summed up.
#[test]
#[cfg(unix)]
fn papers_of_a_folder_are_summed_up_and_their_programs_run() {
    let dir = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| {
        let file = dir.path().join(name);
        std::fs::create_dir_all(file.parent().unwrap()).unwrap();
        std::fs::write(file, text).unwrap();
    };
    let study = "[inputs]\nx = { from = 1, to = 3 }\n[outputs]\n\
                 y = { is = 'x', budget = '1 ulp', why = 'a test' }\n";
    let claim = |bound: &str| {
        format!(
            "[[accuracy]]\nid = 'a'\nplace = 'p'\nclaims = 'c'\nsolver = 's'\ncases = 40\n{bound}\n"
        )
    };
    write("one/s.toml", study);
    write("one/same.sh", "exec cat\n");
    let program = "title = 'One'\n[solver.s]\nstudy = 's.toml'\nexec = ['sh', 'same.sh']\n";
    write(
        "one/paper.toml",
        &format!("{program}{}", claim("bound = '1e-15'")),
    );
    let formula = "title = 'Two'\n[solver.s]\nstudy = 's.toml'\ny = 'x*(1 + 1e-6)'\n";
    write("two/s.toml", study);
    let refuted = claim("bound = '1e-9'\nverdict = 'refuted'");
    write("two/paper.toml", &format!("{formula}{refuted}"));
    let [one, two] = ["one", "two"].map(|name| dir.path().join(name));
    let (one, two, both) = (path(&one), path(&two), path(dir.path()));
    for words in [
        &["paper", one][..],
        &["paper", both],
        &["paper", one, two, "--check"],
    ] {
        refused(&run(words), "--exec lets them run");
    }
    let d = run(&["paper", one, "--exec", "--check"]);
    assert_eq!((d.code, d.out.as_str(), d.err.as_str()), (0, "", ""));
    let d = run(&["paper", both, "--exec"]);
    assert_eq!(d.code, 0, "{}{}", d.out, d.err);
    for due in [
        "Summary of 2 papers",
        "2 claims about algorithms",
        "1 refuted",
        "one: a",
    ] {
        assert!(d.out.contains(due), "{due}: {}", d.out);
    }
    assert_eq!(run(&["paper", one, two, "--exec", "--check"]).code, 0);
    let json = run(&["paper", both, "--exec", "--format", "json"]);
    let json: serde_json::Value = serde_json::from_str(&json.out).unwrap();
    let ids = json["findings"]
        .as_array()
        .unwrap()
        .iter()
        .map(|f| &f["id"]);
    assert_eq!(
        ids.collect::<Vec<_>>(),
        ["paper-one", "paper-two", "claims"]
    );
    let html = run(&["paper", both, "--exec", "--format", "html"]).out;
    needs_nothing_else(&html);
    refused(
        &run(&["paper", one, two, "--exec", "--ledger"]),
        "one paper at a time",
    );
    // The program's values are judged.
    write("one/same.sh", "sed s/^.*$/2/\n");
    let d = run(&["paper", one, "--exec", "--check"]);
    assert_eq!(d.code, 1);
    said(&d, "a is not as recorded");
    refused(&run(&["paper", "new"]), "one folder");
    std::fs::create_dir(dir.path().join("none")).unwrap();
    refused(
        &run(&["paper", path(&dir.path().join("none"))]),
        "paper.toml",
    );
}
