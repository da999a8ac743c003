//! The files of a paper, read in their order.

use super::program::Asked;
use super::source::Source;
use super::symbols::{self, Symbols};
use super::{PaperFile, accuracy, claim, entry, finding, survey, table};
use crate::audit::{Method, SolverAnswer};
use crate::papers::Citation;
use crate::study::document::{self, Item as Node, Value};
pub(super) use crate::study::document::{count, ends, only, required, text, texts, truth, word};
use crate::study::{Study, StudyError, intern, is_name};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// Keys of the first file.
const KEYS: &str = "title authors year venue source analysis parts units symbols definitions \
                    entry table claim solver accuracy survey finding";
/// Keys of the files that it names.
const KEYS_OF_PARTS: &str = "definitions entry table claim solver accuracy survey finding";

/// The largest number of entries, tables and claims of a paper.
const MOST: usize = 10_000;

/// The parts that have been read, with the names that later parts need.
pub(super) struct Reading<'a> {
    pub source: &'a Source,
    pub symbols: Symbols,
    /// Groups of definitions by their names.
    pub groups: BTreeMap<String, Vec<String>>,
    /// Studies by the names of their files.
    studies: BTreeMap<String, Study>,
    /// The solvers that the paper states, in their order.
    pub solvers: Vec<Solver>,
    /// Names of entries and claims.
    ids: BTreeSet<String>,
    /// The name of the file that is being read, kept for good.
    pub file: &'static str,
    /// True if the program analyses the paper.
    pub is_analysed: bool,
}

/// A solver that the paper states.
#[derive(Clone, Debug)]
pub(super) struct Solver {
    pub name: &'static str,
    /// The name of its study's file.
    pub file: &'static str,
    /// The study, with the solver where it is stated in formulas.
    pub study: Study,
    /// The program that it is otherwise.
    pub program: Option<Arc<Asked>>,
}

impl Solver {
    /// The answer to an input.
    pub fn solve(&self, input: &[f64]) -> SolverAnswer {
        match &self.program {
            Some(program) => program.solve(&self.study, input),
            None => self.study.solve(input),
        }
    }
}

impl Reading<'_> {
    /// The name of an entry or claim, which has to be new.
    pub fn id(&mut self, node: &Node) -> Result<&'static str, StudyError> {
        let id = required(node, "id")?;
        let text = id.text()?;
        let is_word = !text.is_empty() && text.chars().all(|c| c.is_ascii_graphic());
        if !is_word {
            return Err(id.fault(format!("the name {text:?} is not one word")));
        }
        if !self.ids.insert(text.into()) {
            return Err(id.fault(format!("the name {text:?} is taken")));
        }
        match self.ids.len() > MOST {
            true => Err(id.fault(format!("more than {MOST} entries and claims"))),
            false => Ok(intern(text)),
        }
    }

    /// The study in a file of the folder.
    pub fn study(&mut self, file: &Node) -> Result<Study, StudyError> {
        let name = file.text()?;
        if let Some(study) = self.studies.get(name) {
            return Ok(study.clone());
        }
        let study = super::study::open(self, file)?;
        self.studies.insert(name.into(), study.clone());
        Ok(study)
    }

    /// The solver of that name that the paper states.
    pub fn solver(&self, name: &str) -> Option<&Solver> {
        self.solvers.iter().find(|s| s.name == name)
    }

    /// Reads the solvers of a file: each names its study.
    fn read_solvers(&mut self, stated: &[(String, Node)]) -> Result<(), StudyError> {
        for (name, node) in stated {
            if self.solver(name).is_some() {
                return Err(node.fault(format!("the solver {name} is stated twice")));
            }
            let file = required(node, "study")?;
            let mut study = self.study(file)?;
            let program = match node.get("exec") {
                None => {
                    study = study.and_solver(name, &self.with_definitions(node)?)?;
                    None
                }
                Some(exec) => {
                    node.only(&["study", "exec", "title", "source", "read"])?;
                    let words = exec
                        .list()?
                        .iter()
                        .map(|word| word.text().map(String::from));
                    let words = words.collect::<Result<_, _>>()?;
                    let program = Asked::new(words, self.source).map_err(|e| e.at(exec.place))?;
                    Some(Arc::new(program))
                }
            };
            self.solvers.push(Solver {
                name: intern(name),
                file: intern(file.text()?),
                study,
                program,
            });
        }
        Ok(())
    }

    /// A solver with the definitions of the files that it names in `with` before its own, as a
    /// study takes it.
    fn with_definitions(&self, node: &Node) -> Result<Node, StudyError> {
        let mut lets = Vec::new();
        for file in texts(node.get("with")) {
            let name = file.text()?;
            let text = self.source.read(name).map_err(|e| e.at(file.place))?;
            let read = document::read(&text).map_err(|e| e.in_file(name))?;
            read.only(&["let"]).map_err(|e| e.in_file(name))?;
            lets.extend(read.get("let").map_or(Ok(&[][..]), Node::table)?.to_vec());
        }
        let own = node.get("let").map_or(Ok(&[][..]), Node::table)?;
        lets.retain(|shared| own.iter().all(|o| o.0 != shared.0));
        lets.extend(own.to_vec());
        let mut entries = node.table()?.to_vec();
        entries.retain(|e| !["study", "with", "let"].contains(&e.0.as_str()));
        let table = |entries| Node {
            place: node.place,
            value: Value::Table(entries),
        };
        entries.push(("let".into(), table(lets)));
        Ok(table(entries))
    }

    /// The definitions that a list names: groups, and definitions of its own.
    pub fn definitions(&self, node: Option<&Node>) -> Result<Vec<&'static str>, StudyError> {
        let mut all: Vec<&'static str> = Vec::new();
        let mut own = BTreeSet::new();
        for item in texts(node) {
            let text = item.text()?;
            if text.contains('=') {
                if let Some(name) = defined(text)
                    && !own.insert(name.to_string())
                {
                    return Err(item.fault(format!("{name} is defined twice")));
                }
                all.push(intern(text));
                continue;
            }
            let Some(group) = self.groups.get(text) else {
                let known: Vec<&str> = self.groups.keys().map(String::as_str).collect();
                let hint = crate::audit::did_you_mean(text, &known);
                let reason = format!(
                    "{text:?} is neither a definition, \"name = expression\", nor a group of [definitions]{hint}"
                );
                return Err(item.fault(reason));
            };
            all.extend(group.iter().map(|text| intern(text)));
        }
        Ok(all)
    }
}

/// The name that a definition gives; none of a derivative.
pub(super) fn defined(text: &str) -> Option<&str> {
    let (left, _) = text.split_once('=')?;
    (!left.contains(':')).then(|| left.trim())
}

/// Reads a paper.
pub(super) fn paper(key: &str, source: &Source, first: &str) -> Result<PaperFile, StudyError> {
    let read = |name: &str| {
        let text = source.read(name)?;
        document::read(&text).map_err(|e| e.in_file(name))
    };
    let file = read(first)?;
    let in_first = |e: StudyError| e.in_file(first);
    only(&file, KEYS).map_err(in_first)?;
    let analysis = file.get("analysis").map(|key| key.text().map(intern));
    let mut paper = PaperFile {
        citation: citation(key, &file).map_err(in_first)?,
        analysis: analysis.transpose().map_err(in_first)?,
        ..PaperFile::default()
    };
    paper.symbols = symbols::read(&file).map_err(in_first)?;
    let dimensions = symbols::dimensions(&file, &paper.symbols).map_err(in_first)?;
    let mut reading = Reading {
        source,
        symbols: Symbols::new(&paper.symbols, file.get("symbols").is_some(), dimensions),
        groups: BTreeMap::new(),
        studies: BTreeMap::new(),
        solvers: Vec::new(),
        ids: BTreeSet::new(),
        file: intern(first),
        is_analysed: paper.analysis.is_some(),
    };
    part(&mut reading, &file, &mut paper).map_err(in_first)?;
    for name in texts(file.get("parts")) {
        let text = name.text().map_err(in_first)?;
        let more = read(text).map_err(|e| e.at(name.place).in_file(first))?;
        let here = |e: StudyError| e.in_file(text);
        only(&more, KEYS_OF_PARTS).map_err(here)?;
        reading.file = intern(text);
        part(&mut reading, &more, &mut paper).map_err(here)?;
    }
    paper.groups = reading.groups;
    let programs = reading.solvers.into_iter().filter_map(|s| s.program);
    paper.programs = programs.collect();
    for stated in &paper.stated {
        stated.check(&paper.items)?;
    }
    let is_empty = paper.items.is_empty() && paper.tables.is_empty() && paper.claims.is_empty();
    if is_empty && paper.accuracies.is_empty() && paper.surveys.is_empty() {
        let reason =
            "a paper has at least one [[entry]], [[table]], [[claim]], [[accuracy]] or [[survey]]";
        return Err(in_first(StudyError::new(reason)));
    }
    Ok(paper)
}

fn citation(key: &str, file: &Node) -> Result<Citation, StudyError> {
    let year = file.get("year").map(|year| count(year, 9999)).transpose()?;
    required(file, "title")?;
    Ok(Citation {
        key: intern(key),
        authors: text(file, "authors")?,
        title: text(file, "title")?,
        year: year.map(|year| year as u16),
        venue: text(file, "venue")?,
        source: text(file, "source")?,
    })
}

/// The definitions, entries, tables and claims of one file.
fn part(reading: &mut Reading, file: &Node, paper: &mut PaperFile) -> Result<(), StudyError> {
    for (name, group) in file.get("definitions").map_or(Ok(&[][..]), Node::table)? {
        is_name(name, group)?;
        let mut lines = Vec::new();
        for item in texts(Some(group)) {
            let line = item.text()?;
            let Some((left, _)) = line.split_once('=') else {
                let reason = format!("{line:?} is no definition: \"name = expression\"");
                return Err(item.fault(reason));
            };
            let left = left.rsplit(':').next().unwrap_or(left).trim();
            is_name(left, item)?;
            lines.push(line.to_string());
        }
        if reading.groups.insert(name.clone(), lines).is_some() {
            return Err(group.fault(format!("the group {name} is defined twice")));
        }
    }
    let list = |key: &str| file.get(key).map_or(Ok(&[][..]), Node::list);
    for node in list("entry")? {
        paper.items.push(entry::read(reading, node)?);
    }
    for node in list("table")? {
        paper.tables.push(table::read(reading, node)?);
    }
    for node in list("claim")? {
        paper.claims.push(claim::read(reading, node)?);
    }
    reading.read_solvers(file.get("solver").map_or(Ok(&[][..]), Node::table)?)?;
    for node in list("accuracy")? {
        paper.accuracies.push(accuracy::read(reading, node)?);
    }
    for node in list("survey")? {
        paper.surveys.push(survey::read(reading, node)?);
    }
    for node in list("finding")? {
        paper.stated.push(finding::read(reading, node)?);
    }
    Ok(())
}
