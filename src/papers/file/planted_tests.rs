//! The papers that are text alone, and slips planted in them: every slip is found, and nearly all
//! are undone by the smallest repair.

use super::PaperFile;
use crate::papers::ledger::{LedgerEntry, Verdict, decide};
use crate::symbolic::{Definitions, Equation, Expr, Identity, Outcome, parse_equation};
use rayon::prelude::*;
use std::path::PathBuf;

const PAPERS: [&str; 5] = [
    "cam-motion-laws",
    "code-aster-vibration",
    "cubic-spline",
    "four-bar",
    "voigt-profile",
];

fn folder() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../reference/papers")
}

fn text_of(paper: &str) -> String {
    std::fs::read_to_string(folder().join(paper).join("paper.toml")).unwrap()
}

/// The paper with another text in place of its `paper.toml`; tables are left out.
fn with_text(text: &str) -> PaperFile {
    let end = text.find("[[table]]").unwrap_or(text.len());
    let text = crate::study::intern(&text[..end]);
    PaperFile::parse("planted", vec![("paper.toml", text)].leak()).unwrap()
}

#[test]
fn papers_of_text_alone_are_as_recorded() {
    let dimensions = PAPERS.map(|paper| {
        let file = PaperFile::open(&folder().join(paper)).unwrap();
        let report = file.report(&|_, _, _| {}).unwrap();
        let changed = report.findings.iter().filter(|f| !f.as_recorded);
        let changed: Vec<(&str, &str)> = changed.map(|f| (f.id, f.title.as_str())).collect();
        assert!(changed.is_empty(), "{paper}: {changed:?}");
        let wrong = report
            .findings
            .iter()
            .filter(|f| f.id.ends_with("-dimension"));
        wrong.map(|f| f.id).collect::<Vec<_>>()
    });
    assert_eq!(
        dimensions.concat(),
        [
            "peak-velocity-dimension",
            "free-period-dimension",
            "initial-conditions-dimension",
            "system-dimension",
            "derivative-dimension"
        ]
    );
}

/// Returns true if two equations say the same: equal sides under one name, or equal differences of
/// the sides.
fn same(a: &str, b: &str) -> bool {
    let [a, b] = [a, b].map(|text| parse_equation(text).unwrap());
    let difference = |e: &Equation| match &e.left {
        Expr::Sym(_) => e.right.clone(),
        left => Expr::Add(vec![left.clone(), Expr::Neg(Box::new(e.right.clone()))]),
    };
    let equation = Equation {
        left: difference(&a),
        right: difference(&b),
    };
    Identity::of(&Definitions::default(), &equation).outcome == Outcome::Proved
}

/// The entry of a paper in which one value is replaced: of its printed form, or the unit of a
/// symbol.
fn planted(row: &csv::StringRecord) -> (LedgerEntry, String) {
    let [paper, id, _, symbol, slip] = [0, 1, 2, 3, 4].map(|k| &row[k]);
    let text = text_of(paper);
    let (start, key) = match symbol {
        "" => (
            text.find(&format!("id       = \"{id}\"\n")).unwrap(),
            "printed  = \"",
        ),
        symbol => {
            let after = text.find("[symbols]").unwrap();
            let line = text[after..]
                .lines()
                .find(|l| l.split(' ').next() == Some(symbol))
                .unwrap();
            (text.find(line).unwrap(), "unit = \"")
        }
    };
    let from = start + text[start..].find(key).unwrap() + key.len();
    let to = from + text[from..].find('"').unwrap();
    assert_ne!(&text[from..to], slip, "{row:?}");
    let changed = format!("{}{slip}{}", &text[..from], &text[to..]);
    let file = with_text(&changed);
    let item = file.items.iter().find(|item| item.id == id).unwrap();
    (decide(item), text[from..to].to_string())
}

#[test]
fn planted_slips_are_found_and_undone() {
    let mut reader = csv::ReaderBuilder::new()
        .comment(Some(b'#'))
        .from_path(folder().join("planted.csv"))
        .unwrap();
    let rows: Vec<csv::StringRecord> = reader.records().map(|r| r.unwrap()).collect();
    assert!(rows.len() >= 40);
    let undone: usize = rows
        .par_iter()
        .map(|row| {
            let (entry, original) = planted(row);
            let refuted = matches!(entry.verdict, Verdict::Refuted | Verdict::Misprint);
            assert!(
                refuted || entry.dimension.is_some(),
                "{row:?}: {:?}",
                entry.verdict
            );
            assert_ne!(entry.verdict, Verdict::Proved, "{row:?}");
            let corrected = entry.corrected.filter(|_| row[3].is_empty());
            usize::from(corrected.is_some_and(|c| same(&c.text, &original)))
        })
        .sum();
    // Of 50 slips in formulas one has another repair: both square roots of z^2 satisfy its
    // requirement.
    assert_eq!(undone, 49);
}

/// (4) of Zinchenko's paper as an equation between numbers: its lengths are in centimetres, its
/// inertias in kg m².
#[test]
fn a_lost_power_of_ten_is_a_wrong_dimension() {
    let text = |units: &str| {
        format!(
            "title = 'T'\nunits = '{units}'\n[symbols]\nm_2 = {{ means = 'mass', unit = 'kg' }}\n\
             I_n = {{ means = 'reduced inertia', unit = 'kg m^2' }}\n\
             v_S2 = {{ means = 'velocity of the centre of mass', unit = 'cm/s' }}\n\
             omega_1 = {{ means = 'speed of the crank', unit = 'rad/s' }}\n\
             [[entry]]\nid = 'z-4'\nplace = '(4)'\nprinted = 'I_n = m_2*v_S2^2/omega_1^2'\n\
             requires = 'I_n*omega_1^2/2 = m_2*v_S2^2/2'\n"
        )
    };
    let decided = |units| decide(&with_text(&text(units)).items[0]);
    assert_eq!(decided("quantities").verdict, Verdict::Proved);
    let numbers = decided("numbers");
    assert_eq!(numbers.verdict, Verdict::Undimensional);
    let fault = numbers.dimension.unwrap();
    assert!(
        fault.contains("as numbers they differ by the factor 10^-4"),
        "{fault}"
    );
}

#[test]
fn units_are_read_or_refused() {
    let fault = |symbols: &str| {
        let text = format!(
            "title = 'T'\n[symbols]\n{symbols}\n[[entry]]\nid = 'e'\nplace = 'p'\nrequires = 'x = x'\n"
        );
        let text = crate::study::intern(&text);
        PaperFile::parse("planted", vec![("paper.toml", text)].leak())
            .err()
            .map(|e| e.to_string())
    };
    let metre = "x = { means = 'a', unit = 'm' }";
    assert_eq!(fault(&format!("{metre}\nk = 'a pure number'")), None);
    let missing = fault(&format!("{metre}\ny = {{ means = 'b' }}")).unwrap();
    assert!(
        missing.contains("y has no unit where others have one"),
        "{missing}"
    );
    let unknown = fault("x = { means = 'a', unit = 'furlong' }").unwrap();
    assert!(
        unknown.contains("\"furlong\" is not a unit known here"),
        "{unknown}"
    );
}
