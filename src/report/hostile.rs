//! No text of a report becomes markup, whatever it says.

use super::baseline::{Change, Changes};
use super::svg::{chirp, linkage, reduced, run_up};
use super::{html, junit, text};
use crate::audit::{
    BranchAt, CandidateReport, Case, Comparison, ConvergenceReport, ErrorMap, Input, Layout,
    LevelReport, MapOutput, MethodReport, Origin, Point, Uncertified, Verdict,
};
use crate::motion::{Course, Drive, Motion, Point as Joint};
use crate::papers::ledger::{Formula, Ledger};
use crate::papers::{Citation, PaperReport};

/// Ends an element, an attribute between quotes of either kind, and begins a script.
const HOSTILE: &str = "'\"></style></title><script>alert(1)</script>&\u{1}";

/// Checks that the page shows the hostile text at least `texts` times and never as markup.
fn harmless(page: &str, texts: usize) {
    assert!(!page.contains("<script"), "{page}");
    assert!(!page.contains("\"></style>"), "{page}");
    let escaped = page.matches("&lt;script&gt;alert(1)").count();
    assert!(escaped >= texts, "{escaped} of {texts} texts in {page}");
}

/// The same of a page with scripts: these are the program's own, named in its policy, and its data
/// are JSON whose strings hold `data` of the texts.
fn harmless_page(page: &str, texts: usize, data: usize) {
    let (mut markup, own) = html::page::tests::markup(page);
    assert!(own >= 1);
    const OPEN: &str = "<script type=\"application/json\" id=";
    let mut held = 0;
    while let Some(start) = markup.find(OPEN) {
        let inner = start + markup[start..].find('>').unwrap() + 1;
        let end = inner + markup[inner..].find("</script>").unwrap();
        let value: serde_json::Value = serde_json::from_str(&markup[inner..end]).unwrap();
        held += hostile_strings(&value);
        markup.replace_range(start..end + "</script>".len(), "");
    }
    assert!(held >= data, "{held} of {data} texts in the data");
    harmless(&markup, texts);
}

fn hostile_strings(value: &serde_json::Value) -> usize {
    match value {
        serde_json::Value::String(s) => usize::from(s.contains(HOSTILE)),
        serde_json::Value::Array(all) => all.iter().map(hostile_strings).sum(),
        serde_json::Value::Object(all) => {
            let keys = all.keys().filter(|k| k.contains(HOSTILE)).count();
            keys + all.values().map(hostile_strings).sum::<usize>()
        }
        _ => 0,
    }
}

fn citation() -> Citation {
    Citation {
        key: HOSTILE,
        authors: HOSTILE,
        title: HOSTILE,
        year: None,
        venue: HOSTILE,
        source: "",
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
    for region in report.regions.iter_mut().chain([&mut report.total]) {
        (region.name, region.description) = (HOSTILE, HOSTILE);
        region.worst = Some(case.clone());
        region.outputs[0].name = HOSTILE;
        region.outputs[0].worst = Some(case.clone());
        for octave in &mut region.outputs[0].histogram {
            octave.worst = case.clone();
        }
    }
    report.candidate = Some(CandidateReport {
        name: HOSTILE.into(),
        version: Some(HOSTILE.into()),
        command: Some("./candidate".into()),
        answered: 1,
        trouble: Some(HOSTILE.into()),
    });
    report.inputs = vec![(HOSTILE, 0)];
    report.remarks = vec![HOSTILE.into()];
    let named = vec![Input {
        name: HOSTILE,
        unit: HOSTILE,
    }];
    report.layout = Layout::of(named, vec![(HOSTILE, HOSTILE)], None);
    report.budgets[0].name = HOSTILE;
    report.reproduce.head = HOSTILE.into();
    report.points = vec![Point {
        case: case.clone(),
        verdict: Verdict::Pass,
        ulps: vec![f64::INFINITY],
        of_budget: f64::NAN,
    }];
    let law = &mut report.laws[0];
    (law.name, law.statement, law.worst) = (HOSTILE, HOSTILE, 2.0);
    let failure = &mut report.failures[0];
    failure.case = case;
    failure.judgement.verdict = Verdict::Over;
    failure.judgement.reason = Some(HOSTILE.into());
    failure.judgement.components[0].output = HOSTILE;
    failure.reference = vec![Some(HOSTILE.into())];
    failure.branch = Some(BranchAt {
        branch: Some(HOSTILE.into()),
        seam: HOSTILE.into(),
        distance: 0.0,
    });
    report.worst = vec![failure.clone()];
    report.wrong = vec![failure.clone()];
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
        places: HOSTILE.into(),
        outputs: vec![HOSTILE],
        orders: vec![None],
        fitted: vec![None],
        levels: vec![level],
    };
    let changes = Changes {
        changes: vec![Change {
            of: HOSTILE.into(),
            region: HOSTILE.into(),
            output: Some(HOSTILE.into()),
            figure: HOSTILE,
            before: 0.0,
            now: f64::INFINITY,
            better: false,
        }],
        not_compared: vec![HOSTILE.into()],
    };
    let approximations = [Ok(convergence), Err(Uncertified::Undecided(HOSTILE.into()))];
    let page = html::audit::page(&[method()], Some(&approximations), Some(&changes), false);
    harmless_page(&page, 50, 12);
    let speed = None;
    let found = Comparison::new(HOSTILE, vec![(method(), speed), (method(), speed)]);
    harmless_page(&html::audit::comparison(&found, None), 80, 24);
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
    let motion = Motion {
        name: HOSTILE.into(),
        drive: Drive {
            symbol: "φ",
            unit: "°",
            values: vec![0.0, 180.0],
        },
        closed: true,
        start: 0,
        points: vec![
            Joint::fixed(HOSTILE, [0.0, 0.0]),
            Joint::moving(HOSTILE, vec![[1.0, 0.0], [-1.0, 0.0]]),
        ],
        links: vec![[0, 1]],
        plates: Vec::new(),
        guides: Vec::new(),
        wheels: Vec::new(),
        courses: vec![Course {
            name: HOSTILE.into(),
            unit: HOSTILE.into(),
            variants: vec![(HOSTILE.into(), vec![1.0, f64::NAN])],
            printed: Vec::new(),
        }],
    };
    harmless_page(&html::paper::page(&report, Some(&motion)), 64, 2);
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
    harmless_page(&html::ledger::page(&ledger), 25, 0);
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
        (linkage::tests::drawn(HOSTILE, true), 2),
        (chirp::history(&history), 4),
        (chirp::spectrum(&spectrum), 3),
        (chirp::chart(HOSTILE, HOSTILE, &[(HOSTILE, &chart)]), 4),
        (run_up::work_precision(HOSTILE, &[work]), 2),
        (run_up::draw(HOSTILE, &[], None), 2),
        (reduced::draw(HOSTILE, &[rows(0.0), rows(1.0)], true), 2),
    ] {
        harmless(&drawing, texts);
        // XML cannot hold this one, not even escaped.
        assert!(!drawing.contains('\u{1}'), "{drawing}");
    }
}
