//! Several papers in one summary: how each was found, their claims about algorithms, and what
//! their surveys of the same functions find for all solvers together.

use super::file::{FINDING_VERDICTS, Survey};
use super::{
    Citation, Figure, Finding, FindingVerdict, PaperFile, PaperReport, Progress, Subject, figure,
};
use crate::reference::Undecided;
use crate::study::intern;
use std::collections::BTreeMap;

/// Audits papers, and sums up what was found.
///
/// # Errors
/// [`Undecided`] if a certified value is undecided.
pub fn summary(papers: Vec<PaperFile>, progress: Progress) -> Result<PaperReport, Undecided> {
    let count = papers.len() as u64;
    let mut findings = Vec::new();
    let mut claims = Vec::new();
    let mut surveys: Vec<Survey> = Vec::new();
    for (mut file, done) in papers.into_iter().zip(0..) {
        progress(file.citation.key, done, count + 1);
        let of_paper = std::mem::take(&mut file.surveys);
        let report = file.report(&|_, _, _| {})?;
        let is_claim = |f: &&Finding| file.accuracies.iter().any(|a| a.statement.id == f.id);
        let of_file = report.findings.iter().filter(is_claim);
        claims.extend(of_file.map(|f| (report.paper.key, f.clone())));
        findings.push(sum(&report, !of_paper.is_empty()));
        for survey in of_paper {
            let join = |all: &mut Survey| all.join(&survey);
            if !surveys.iter_mut().any(join) {
                surveys.push(survey);
            }
        }
    }
    progress("surveys", count, count + 1);
    if !claims.is_empty() {
        findings.push(claims_in_all(&claims));
    }
    findings.extend(surveys.iter().flat_map(Survey::findings));
    progress("done", count + 1, count + 1);
    let paper = Citation {
        key: "summary",
        title: intern(&format!("Summary of {count} papers")),
        ..Citation::default()
    };
    Ok(PaperReport::new(paper, findings, Vec::new(), Vec::new()))
}

/// A paper as one finding: how many findings of each kind it has, and which have changed.
fn sum(report: &PaperReport, has_surveys: bool) -> Finding {
    let paper = &report.paper;
    let changed = report.findings.iter().filter(|f| !f.as_recorded);
    let changed: Vec<&str> = changed.map(|f| f.id).collect();
    let number = |verdict| {
        let of = report.findings.iter();
        of.filter(|f| f.verdict == verdict).count()
    };
    let kinds = FINDING_VERDICTS.map(|(word, verdict)| (word.replace('-', " "), number(verdict)));
    let kinds = kinds.into_iter().filter(|kind| kind.1 > 0);
    let mut figures: Vec<Figure> = kinds.map(|(word, n)| figure(word, n, "1")).collect();
    let columns = report.tallies.len();
    if columns > 0 {
        let right = report.tallies.iter().filter(|t| t.within_half == t.entries);
        let name = "columns of printed numbers that are right throughout";
        figures.push(figure(name, format!("{} of {columns}", right.count()), "1"));
    }
    let is_empty = report.findings.is_empty() && !has_surveys;
    let text = match changed.is_empty() {
        true => format!("{} findings, all as recorded.", report.findings.len()),
        false => format!("Not as recorded: {}.", changed.join(", ")),
    };
    Finding {
        id: intern(&format!("paper-{}", paper.key)),
        subject: Subject::Data,
        place: paper.key,
        title: paper.title.into(),
        verdict: match changed.is_empty() {
            true => FindingVerdict::Confirmed,
            false => FindingVerdict::Unexplained,
        },
        text,
        figures,
        as_recorded: changed.is_empty() && !is_empty,
    }
}

/// All claims about algorithms, each with its verdict, the error found and the bound.
fn claims_in_all(claims: &[(&'static str, Finding)]) -> Finding {
    let word = |f: &Finding| -> String {
        let words = f.text.split(['.', ':']).next();
        words.unwrap_or_default().to_string()
    };
    let mut counts: BTreeMap<String, usize> = BTreeMap::new();
    for (_, f) in claims {
        *counts.entry(word(f).to_lowercase()).or_default() += 1;
    }
    let counts: Vec<String> = counts
        .iter()
        .map(|(word, n)| format!("{n} {word}"))
        .collect();
    let figures = claims.iter().map(|(key, f)| {
        let value = |name: &str| f.figures.iter().find(|g| g.name == name);
        let value = match (value("found"), value("claimed bound")) {
            (Some(found), Some(bound)) => {
                format!(
                    "{}; {} found, {} claimed",
                    word(f),
                    found.value,
                    bound.value
                )
            }
            _ => word(f),
        };
        figure(format!("{key}: {}", f.id), value, "1")
    });
    let refuted = claims
        .iter()
        .any(|(_, f)| f.verdict == FindingVerdict::Refuted);
    Finding {
        id: "claims",
        subject: Subject::Claim,
        place: "claims about algorithms",
        title: format!("{} claims about algorithms", claims.len()),
        verdict: match refuted {
            true => FindingVerdict::Refuted,
            false => FindingVerdict::Confirmed,
        },
        text: format!("By verdict: {}.", counts.join(", ")),
        figures: figures.collect(),
        as_recorded: claims.iter().all(|(_, f)| f.as_recorded),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const STUDY: &str = "[inputs]\nx = { from = '1e-6', to = 1, spacing = 'log' }\n[outputs]\n\
                         y = { is = '1 - cos(x)', budget = '8 ulp', why = 'a test' }\n";

    fn paper(key: &'static str, solver: &str, bound: &str, recorded: &str) -> PaperFile {
        let text = format!(
            "title = '{key}'\n[solver.{key}]\nstudy = 's.toml'\ny = '{solver}'\n\
             [[accuracy]]\nid = 'a'\nplace = 'p'\nclaims = 'c'\nsolver = '{key}'\n{bound}\n\
             [[survey]]\nid = 'heights'\nstudy = 's.toml'\nalong = 'x'\ntargets = '1e-12'\n{recorded}"
        );
        let texts = vec![("paper.toml", intern(&text)), ("s.toml", STUDY)];
        PaperFile::parse(key, texts.leak()).unwrap()
    }

    #[test]
    fn papers_are_summed_up_with_one_survey() {
        let naive = "bound = '1e-9'\nverdict = 'refuted'";
        let pair = |recorded: [&str; 2]| {
            vec![
                paper("half", "2*sin(x/2)^2", "bound = '1e-15'", recorded[0]),
                paper("plain", "1 - cos(x)", naive, recorded[1]),
            ]
        };
        let found = summary(pair([""; 2]), &|_, _, _| {}).unwrap();
        let ids: Vec<&str> = found.findings.iter().map(|f| f.id).collect();
        let due = [
            "paper-half",
            "paper-plain",
            "claims",
            "heights",
            "heights-seams",
            "heights-advice",
        ];
        assert_eq!(ids, due);
        assert!(found.as_recorded());
        let claims = &found.findings[2];
        assert!(
            claims
                .text
                .contains("1 holds as far as searched, 1 refuted"),
            "{}",
            claims.text
        );
        assert!(claims.figures[1].value.ends_with("found, 1e-9 claimed"));
        let heights = &found.findings[3].figures;
        let value = |k: usize| (heights[k].name.as_str(), heights[k].value.as_str());
        assert_eq!(value(0), ("half", "1e-12: everywhere, everywhere"));
        assert_eq!(value(1).0, "plain");
        assert_eq!(found.findings[5].figures[0].value, "half");
        // Heights on record are compared, those of all solvers together.
        let [half, plain] =
            [0, 1].map(|k| format!("recorded = {{ {} = '{}' }}", value(k).0, value(k).1));
        assert!(
            summary(pair([&half, &plain]), &|_, _, _| {})
                .unwrap()
                .as_recorded()
        );
        let wrong = plain.replace("1e-12: ", "1e-12: 1e-9, ");
        assert!(
            !summary(pair([&half, &wrong]), &|_, _, _| {})
                .unwrap()
                .as_recorded()
        );
        // A claim that changed is told of its paper and of the claims.
        let changed = vec![paper("plain", "1 - cos(x)", "bound = '1e-9'", "")];
        let found = summary(changed, &|_, _, _| {}).unwrap();
        let lost = found.findings.iter().filter(|f| !f.as_recorded);
        assert_eq!(
            lost.map(|f| f.id).collect::<Vec<_>>(),
            ["paper-plain", "claims"]
        );
    }
}
