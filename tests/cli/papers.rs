//! Papers and their ledgers.

use crate::common::{refused, run, text};

#[test]
fn papers_in_every_form() {
    for key in mechaudit::papers::keys() {
        let form = |f: &str| run(&["paper", key, "--format", f]);
        let d = form("json");
        assert_eq!(d.code, 0, "{}", d.err);
        let v: serde_json::Value = serde_json::from_str(&d.out).unwrap();
        let entries = v["entries"].as_array().unwrap();
        let lines: usize = entries
            .iter()
            .map(|e| e["variants"].as_object().unwrap().len())
            .sum();
        assert_eq!(form("csv").out.lines().count(), 1 + lines);
        let html = form("html").out;
        assert!(html.starts_with("<!doctype html>") && html.trim_end().ends_with("</html>"));
        assert!(!html.contains("http") && !html.contains("<script"));
        assert!(!form("text").out.contains('\u{1b}'));
    }
}

#[test]
fn ledgers_in_every_form() {
    for key in mechaudit::papers::keys() {
        let form = |f: &str| run(&["paper", key, "--ledger", "--format", f]);
        let d = form("json");
        assert_eq!(d.code, 0, "{}", d.err);
        let v: serde_json::Value = serde_json::from_str(&d.out).unwrap();
        assert!(v["entries"].as_array().unwrap().len() > 50);
        let html = form("html").out;
        assert!(html.starts_with("<!doctype html>") && html.trim_end().ends_with("</html>"));
        assert!(!html.contains("http") && !html.contains("<script"));
        assert!(html.contains("<math"));
        assert!(form("latex").out.contains(r"\begin{document}"));
        let words = form("text").out;
        let words = words.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(words.contains("all as recorded"), "{words}");
        refused(&form("csv"), "a ledger has no CSV form");
        refused(&run(&["paper", key, "--format", "latex"]), "add --ledger");
    }
    refused(
        &run(&["paper", "none", "--ledger"]),
        "there is no paper \"none\"",
    );
}

#[test]
fn errata_are_written_whole_and_checked() {
    let dir = tempfile::tempdir().unwrap();
    let file = dir.path().join("errata.json");
    let errata = |check: bool| {
        let mut args = vec!["paper", "zinchenko", "--ledger", "--format", "errata"];
        args.extend(["--output", text(&file)]);
        args.extend(check.then_some("--check"));
        run(&args)
    };
    refused(&errata(true), "cannot read");
    assert_eq!(errata(false).code, 0);
    assert_eq!(errata(true).code, 0);
    std::fs::write(&file, "{}").unwrap();
    let d = errata(true);
    assert_eq!(d.code, 1);
    assert!(d.err.contains("is not up to date"), "{}", d.err);
    assert_eq!(std::fs::read_to_string(&file).unwrap(), "{}");
    refused(&run(&["paper", "zinchenko", "--check"]), "--ledger");
}
