//! Papers and their ledgers.

use crate::common::{markup, needs_nothing_else, refused, run, said, text};

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
        needs_nothing_else(&html);
        readable(&html);
        let formulas = v["findings"].as_array().unwrap().iter();
        let formulas = formulas.flat_map(|f| f["figures"].as_array().unwrap());
        let formulas = formulas.filter(|g| g["latex"].is_string()).count();
        assert_eq!(html.matches("<math display=\"block\"").count(), formulas);
        assert_eq!(key == "gembara-senyk", formulas > 20, "{key}: {formulas}");
        let words = form("text").out;
        assert!(!words.contains('\u{1b}') && !words.contains("kg m^2"));
    }
}

#[test]
fn ledgers_in_every_form() {
    for key in mechaudit::papers::keys() {
        let form = |f: &str| run(&["paper", key, "--ledger", "--format", f]);
        let d = form("json");
        assert_eq!(d.code, 0, "{}", d.err);
        let v: serde_json::Value = serde_json::from_str(&d.out).unwrap();
        // The specification of the N four-bar mechanism prints few formulas, a drawing none.
        let least = match key {
            "n-four-bar" => 25,
            "pmksweb" => 8,
            _ => 50,
        };
        assert!(v["entries"].as_array().unwrap().len() > least);
        let html = form("html").out;
        assert!(html.starts_with("<!doctype html>") && html.trim_end().ends_with("</html>"));
        needs_nothing_else(&html);
        assert!(html.contains("<math"));
        readable(&html);
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
    said(&d, "is not up to date");
    assert_eq!(std::fs::read_to_string(&file).unwrap(), "{}");
    refused(&run(&["paper", "zinchenko", "--check"]), "--ledger");
}

/// A page for people: contents that lead to every part, no markup left as it was typed. `tests/browser` opens it.
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
    assert!(links.len() >= text.matches("<article").count() && links.len() > 7);
    for link in &links {
        assert_eq!(ids.iter().filter(|id| *id == link).count(), 1, "{link}");
    }
}
