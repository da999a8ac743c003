//! No text of a report becomes markup, whatever it says.

use super::svg::{chirp, reduced, run_up, scene};
use super::{html, junit, text};
use crate::audit::{
    CandidateReport, Case, ConvergenceReport, ErrorMap, LevelReport, MapOutput, MethodReport,
    Origin, Uncertified, Verdict,
};
use crate::papers::ledger::{Formula, Ledger};
use crate::papers::{Citation, PaperReport};

/// Ends an element, an attribute between quotes of either kind, and begins a script.
const HOSTILE: &str = "'\"></style></title><script>alert(1)</script>&\u{1}";

/// So many texts, and none of them markup.
fn harmless(page: &str, texts: usize) {
    assert!(!page.contains("<script"), "{page}");
    assert!(!page.contains("\"></style>"), "{page}");
    let escaped = page.matches("&lt;script&gt;alert(1)").count();
    assert!(escaped >= texts, "{escaped} of {texts} texts in {page}");
}

fn citation() -> Citation {
    Citation {
        key: HOSTILE,
        authors: HOSTILE,
        title: HOSTILE,
        year: None,
        venue: HOSTILE,
    }
}

fn method() -> MethodReport {
    let mut report = text::method::tests::fabricated();
    let case = Case {
        method: HOSTILE,
        region: HOSTILE,
        input: vec![1.0],
        origin: Origin::CheckPoint { name: HOSTILE },
    };
    (report.method, report.summary, report.source) = (HOSTILE, HOSTILE, HOSTILE);
    report.total.outputs[0].name = HOSTILE;
    report.total.outputs[0].worst = Some(case.clone());
    report.regions[0].name = HOSTILE;
    report.reproduce.head = format!("mechaudit audit {HOSTILE}");
    report.candidate = Some(CandidateReport {
        name: HOSTILE.into(),
        version: Some(HOSTILE.into()),
        command: Some(HOSTILE.into()),
        answered: 1,
        trouble: Some(HOSTILE.into()),
    });
    let law = &mut report.laws[0];
    (law.name, law.statement, law.worst) = (HOSTILE, HOSTILE, 2.0);
    let failure = &mut report.failures[0];
    failure.case = case;
    failure.judgement.verdict = Verdict::Over;
    failure.judgement.reason = Some(HOSTILE.into());
    failure.judgement.components[0].output = HOSTILE;
    failure.reference = vec![Some(HOSTILE.into())];
    report.worst = report.failures.clone();
    report.map = Some(ErrorMap {
        columns: 1,
        rows: 1,
        corner: [0.0, 0.0],
        side: 1.0,
        outputs: vec![MapOutput {
            name: HOSTILE,
            ulps: vec![0.5],
        }],
        not_passed: 0,
    });
    report
}

#[test]
fn an_audit() {
    let level = LevelReport {
        level: HOSTILE.into(),
        work: 1,
        failed: Some(HOSTILE.into()),
        errors: Vec::new(),
    };
    let convergence = ConvergenceReport {
        name: HOSTILE,
        summary: HOSTILE,
        work_unit: HOSTILE,
        outputs: vec![HOSTILE],
        orders: vec![None],
        fitted: vec![None],
        levels: vec![level],
    };
    let approximations = [Ok(convergence), Err(Uncertified::Undecided(HOSTILE.into()))];
    let page = html::audit::page(&[method()], Some(&approximations), false);
    harmless(&page, 22);
    let xml = junit::document(&[method()]).unwrap();
    harmless(&xml, 7);
    quick_junit::Report::deserialize_from_str(&xml).unwrap();
}

#[test]
fn a_paper() {
    let mut report: PaperReport = text::paper::tests::fabricated();
    report.paper = citation();
    report.mechaudit_version = HOSTILE;
    for f in &mut report.findings {
        (f.id, f.place, f.title, f.text) = (HOSTILE, HOSTILE, HOSTILE.into(), HOSTILE.into());
        for latex in [
            None,
            Some(format!("\\text{{{HOSTILE}}}")),
            Some(HOSTILE.into()),
        ] {
            let mut figure = crate::papers::Figure {
                name: HOSTILE.into(),
                value: HOSTILE.into(),
                unit: HOSTILE,
                latex: None,
            };
            figure.latex = latex;
            f.figures.push(figure);
        }
    }
    for t in &mut report.tallies {
        (t.variant, t.column) = (HOSTILE, HOSTILE);
    }
    for e in &mut report.entries {
        (e.column, e.printed) = (HOSTILE, HOSTILE.into());
        for r in e.variants.values_mut() {
            (r.recomputed, r.note) = (HOSTILE.into(), Some(HOSTILE.into()));
        }
    }
    harmless(&html::paper::page(&report), 40);
}

#[test]
fn a_ledger() {
    let mut ledger: Ledger = text::ledger::tests::fabricated();
    ledger.paper = citation();
    ledger.mechaudit_version = HOSTILE;
    let formula = |latex: &str| Formula {
        text: HOSTILE.into(),
        latex: latex.into(),
    };
    for e in &mut ledger.entries {
        (e.id, e.place, e.claim, e.note) = (HOSTILE, HOSTILE, HOSTILE, HOSTILE);
        e.printed = Some(formula(HOSTILE));
        e.corrected = Some(formula(""));
        for o in &mut e.obligations {
            o.formula = formula(&format!("\\mathrm{{{HOSTILE}}}"));
            o.residual = o.residual.as_ref().map(|_| HOSTILE.into());
        }
        for edit in e.repair.iter_mut().flat_map(|r| &mut r.edits) {
            (edit.before, edit.after) = (HOSTILE.into(), HOSTILE.into());
        }
    }
    harmless(&html::ledger::page(&ledger), 25);
}

#[test]
fn drawings() {
    let column = || chirp::Column {
        times: [0.0, 1.0],
        ranges: [[0.0, 1.0]; 3],
        envelope: 1.0,
        speed: 1.0,
    };
    let history = chirp::History {
        name: HOSTILE,
        note: HOSTILE.into(),
        unit: HOSTILE,
        mean: 0.0,
        columns: vec![column(), column()],
    };
    let spectrum = chirp::Spectrum {
        name: HOSTILE,
        law: HOSTILE,
        harmonics: vec![(1.0, 1.0), (2.0, 0.5)],
        beyond: vec![(1.0, 0.5)],
    };
    let chart = crate::solvers::chirp_chart::Chart {
        period: crate::solvers::chirp_chart::Period::Turn,
        rigid: [1.0; 3],
        points: Vec::new(),
    };
    let work = run_up::Work {
        method: HOSTILE,
        points: vec![(1e-3, 10), (1e-6, 100)],
    };
    let rows = |crank| {
        let reduced = crate::solvers::reduction::Reduced {
            inertia_kg_m2: crank,
            inertia_derivative_kg_m2: 1.0,
            moment_n_m: 1.0,
            moment_derivative_n_m: 0.0,
        };
        (crank, reduced)
    };
    for (drawing, texts) in [
        (scene::tests::drawn(HOSTILE, true), 2),
        (chirp::history(&history).unwrap(), 4),
        (chirp::spectrum(&spectrum).unwrap(), 3),
        (
            chirp::chart(HOSTILE, HOSTILE, &[(HOSTILE, &chart)]).unwrap(),
            4,
        ),
        (run_up::work_precision(HOSTILE, &[work]).unwrap(), 2),
        (run_up::draw(HOSTILE, &[], None).unwrap(), 2),
        (
            reduced::draw(HOSTILE, &[rows(0.0), rows(1.0)], true).unwrap(),
            2,
        ),
    ] {
        harmless(&drawing, texts);
        // XML cannot hold this one, not even escaped.
        assert!(!drawing.contains('\u{1}'), "{drawing}");
    }
}
