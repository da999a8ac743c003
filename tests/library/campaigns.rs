//! The findings of campaigns, `reference/campaigns/*.csv`: the worst cases are judged again, and
//! the tables of the page beside them are these figures.

use mechaudit::audit::{Case, Method, Origin, Settings, Verdict, answer_of, judge_case};
use mechaudit::methods::find;
use std::path::Path;

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/reference/campaigns");

/// A line of a file of findings.
struct Row {
    region: String,
    /// The norm, an output or a law.
    of: String,
    budget: f64,
    cases: u64,
    over: Option<u64>,
    worst: f64,
    input: Vec<f64>,
}

fn rows(name: &str) -> Vec<Row> {
    let file = Path::new(FOLDER).join(name);
    let mut rows = csv::ReaderBuilder::new()
        .comment(Some(b'#'))
        .from_path(&file)
        .expect(name);
    let number = |text: &str| text.parse::<f64>().expect("a number");
    let row = |r: csv::StringRecord| Row {
        region: r[0].into(),
        of: r[1].into(),
        budget: number(&r[2]),
        cases: r[3].parse().expect("a count"),
        over: r[4].parse().ok(),
        worst: number(&r[6]),
        input: r[10].split_whitespace().map(number).collect(),
    };
    let columns = "region,of,budget,cases,over,undecided,worst,p99,median,case,input";
    assert!(rows.headers().expect(name).iter().eq(columns.split(',')));
    rows.records().map(|r| row(r.expect(name))).collect()
}

/// Returns the error or residual that today's solver has at the worst case of a row.
fn again(method: &dyn Method, row: &Row) -> f64 {
    if let Some(name) = row.of.strip_prefix("law ") {
        let laws = method.laws();
        let law = laws.iter().find(|l| l.name == name).expect(name);
        return (law.residual)(&row.input).expect("it applies");
    }
    let case = Case {
        method: method.name(),
        region: "given",
        input: row.input.clone(),
        origin: Origin::Given,
    };
    let answer = answer_of(method, &case.input);
    let judged = judge_case(method, case, answer, &Settings::default()).judgement;
    assert_eq!(judged.verdict, Verdict::Pass, "{} {}", row.region, row.of);
    let component = judged.components.iter().find(|c| c.output == row.of);
    component.expect(&row.of).ulps
}

/// Every worst case passes. Where W(z) has the bits that it had then, its error is the recorded
/// one.
#[test]
fn worst_cases_are_judged_again() {
    let method = find("faddeeva").unwrap();
    let again_since: Vec<String> = rows("faddeeva-lower.csv")
        .into_iter()
        .map(|row| row.region)
        // Rays into the lower half-plane.
        .chain(["diagonal-rays".into()])
        .collect();
    for (name, met) in [("faddeeva.csv", 10), ("faddeeva-lower.csv", 18)] {
        let mut same = 0;
        for row in rows(name) {
            assert!(row.worst <= row.budget && row.over.unwrap_or(0) == 0);
            if row.input.is_empty() {
                continue;
            }
            let found = again(&*method, &row);
            let (region, of, worst) = (&row.region, &row.of, row.worst);
            assert!(found <= row.budget, "{name}, {region}, {of}: {found}");
            if name != "faddeeva.csv" || !again_since.contains(region) {
                let close = (found - worst).abs() <= 1e-5 * worst;
                assert!(close, "{name}, {region}, {of}: {found}, not {worst}");
                same += 1;
            }
        }
        assert_eq!(same, met, "{name}");
    }
}

/// The page's tables of these campaigns: cases, the worst of the norm and of each part.
#[test]
fn tables_of_the_page() {
    let page = std::fs::read_to_string(Path::new(FOLDER).join("README.md")).unwrap();
    let head = "| region | cases | over budget | norm, u | Re W, ulp | Im W, ulp |\n|---|---|---|---|---|---|\n";
    let tables: Vec<&str> = page.split(head).skip(1).collect();
    assert_eq!(tables.len(), 2);
    for (name, table) in ["faddeeva.csv", "faddeeva-lower.csv"].iter().zip(tables) {
        let all = rows(name);
        let all: Vec<&Row> = all.iter().filter(|r| !r.of.starts_with("law")).collect();
        let due = all.chunks(3).map(|of| {
            let [norm, re, im] = of else {
                panic!("{name} has not three lines of each region");
            };
            let over = norm.over.expect("a count");
            format!(
                "| `{}` | {:e} | {over} | {:.2} | {:.2} | {:.2} |",
                norm.region, norm.cases as f64, norm.worst, re.worst, im.worst
            )
        });
        let lines = table.lines().take_while(|l| l.starts_with('|'));
        assert!(lines.eq(due), "{name}");
    }
}
