//! Machines as their files describe them.

use crate::errors::{DomainError, Undecided, value_error};
use mechaudit::message::readable;
use mechaudit::reference::nearest_f64;
use mechaudit::solvers::dyad::Assembly;
use mechaudit::solvers::run_up::{Equation, run};
use mechaudit::solvers::units::Angle;
use mechaudit_cli::machine::class_iii::{self, Branch, Certifier, Reach};
use mechaudit_cli::machine::dyad::{self, Dyad, Proved};
use mechaudit_cli::machine::planar::{self, Columns};
use mechaudit_cli::machine::run_up::{Machine, Overrides};
use mechaudit_cli::machine::{self, CamOscillator, Source};
use mechaudit_cli::report::svg::linkage as drawn;
use numpy::ndarray::Array2;
use numpy::{PyArray2, PyArrayMethods, PyReadonlyArray1, ToPyArray};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rug::Rational;

use crate::certified::rational;
use crate::interrupt::interruptible;

/// Rows between two looks at pending signals.
const ROWS: usize = 1024;

type Table<'py> = (Vec<String>, Bound<'py, PyArray2<f64>>);

fn source(text: String, is_json: bool) -> Source {
    match is_json {
        true => Source::json(text),
        false => Source::toml(text),
    }
}

fn table<'py>(py: Python<'py>, names: Vec<String>, rows: Vec<Vec<f64>>) -> Table<'py> {
    let width = names.len();
    let flat: Vec<f64> = rows.iter().flatten().copied().collect();
    let all = Array2::from_shape_vec((rows.len(), width), flat).expect("rows are as wide as names");
    (names, all.to_pyarray(py))
}

/// A linkage.
#[pyclass(frozen, module = "mechaudit._mechaudit")]
pub struct Linkage {
    linkage: machine::Linkage,
    text: String,
    is_json: bool,
}

fn assembly(dyad: &Dyad, branch: Option<usize>) -> PyResult<Assembly> {
    match branch {
        None => Ok(dyad.assembly),
        Some(k) if k < 2 => Ok(dyad::ASSEMBLIES[k]),
        Some(k) => Err(PyValueError::new_err(format!(
            "branch: a linkage with one dyad has branches 0 and 1, not {k}"
        ))),
    }
}

/// All columns but the forces in the joints, which only loads and a speed give.
const ALL: Columns = Columns {
    paths: true,
    reactions: false,
};

/// A value of the drive in radians or metres.
fn drive(linkage: &planar::Machine, given: f64) -> f64 {
    match linkage.rotary() {
        true => given.to_radians(),
        false => given,
    }
}

/// The number of a branch in the bits of a whole number, as which Python sees that column.
fn branch_bits(number: usize) -> f64 {
    f64::from_bits(number as u64)
}

/// A row begins with the drive and the branch.
fn row(given: f64, number: usize, values: impl IntoIterator<Item = f64>) -> Vec<f64> {
    [given, branch_bits(number)]
        .into_iter()
        .chain(values)
        .collect()
}

fn degrees(x: f64) -> PyResult<Rational> {
    Rational::from_f64(x)
        .ok_or_else(|| PyValueError::new_err(format!("phi: a crank angle must be finite, got {x}")))
}

/// The rows of a dyad in the memory of the array.
fn dyad_table<'py>(
    py: Python<'py>,
    linkage: &Dyad,
    angles: &[f64],
    assembly: Assembly,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    const WIDTH: usize = size_of::<dyad::Row>() / size_of::<f64>();
    if let Some(bad) = angles.iter().find(|phi| !phi.is_finite()) {
        degrees(*bad)?;
    }
    let all = PyArray2::zeros(py, [angles.len(), WIDTH], false);
    let mut borrowed = all.readwrite();
    let (rows, _) = borrowed.as_slice_mut()?.as_chunks_mut::<WIDTH>();
    let branch = branch_bits(dyad::number(assembly));
    for (angles, rows) in angles.chunks(ROWS).zip(rows.chunks_mut(ROWS)) {
        py.check_signals()?;
        dyad::table(linkage, angles, assembly, rows).map_err(value_error)?;
        for row in rows {
            row[1] = branch;
        }
    }
    drop(borrowed);
    Ok(all)
}

impl Linkage {
    fn branch(
        &self,
        linkage: &class_iii::Linkage,
        first: Rational,
        branch: Option<usize>,
    ) -> PyResult<(Branch, Rational)> {
        let start = linkage.start_degrees().unwrap_or(first);
        let chosen = class_iii::choose(&linkage.solver, &start, branch, &linkage.start);
        Ok((chosen.map_err(value_error)?, start))
    }
}

#[pymethods]
impl Linkage {
    #[new]
    fn new(text: String, is_json: bool) -> PyResult<Linkage> {
        let linkage =
            machine::Linkage::read(&source(text.clone(), is_json)).map_err(value_error)?;
        Ok(Linkage {
            linkage,
            text,
            is_json,
        })
    }

    fn __getnewargs__(&self) -> (String, bool) {
        (self.text.clone(), self.is_json)
    }

    /// Its name, if it has one.
    #[getter]
    fn name(&self) -> Option<String> {
        match &self.linkage {
            machine::Linkage::ClassIii(l) => l.name.clone(),
            machine::Linkage::Dyad(l) => l.name.clone(),
            machine::Linkage::Planar(l) => l.name.clone(),
        }
    }

    /// The type as the file names it.
    #[getter]
    fn kind(&self) -> &str {
        match &self.linkage {
            machine::Linkage::ClassIii(_) => "class-iii",
            machine::Linkage::Dyad(l) => l.shape.type_name(),
            machine::Linkage::Planar(_) => "planar",
        }
    }

    /// The names of a row's columns.
    #[getter]
    fn columns(&self) -> Vec<String> {
        match &self.linkage {
            machine::Linkage::ClassIii(l) => class_iii::names(l, false),
            machine::Linkage::Dyad(l) => dyad::names(l),
            machine::Linkage::Planar(l) => planar::names(l, ALL),
        }
    }

    /// The rows of all assembly modes at a value of the drive: degrees, or metres.
    fn modes<'py>(&self, py: Python<'py>, phi_deg: f64) -> PyResult<Table<'py>> {
        let at = degrees(phi_deg)?;
        let mut rows = Vec::new();
        match &self.linkage {
            machine::Linkage::ClassIii(l) => {
                let angle = Angle::from_deg(phi_deg);
                let modes = l.solver.assembly_modes(angle).modes;
                for (k, mode) in modes.into_iter().enumerate() {
                    let state = l.solver.state_near(angle, mode).map_err(value_error)?;
                    rows.push(row(phi_deg, k, class_iii::values(l, &state)));
                }
            }
            machine::Linkage::Dyad(l) => {
                for (k, assembly) in dyad::ASSEMBLIES.into_iter().enumerate() {
                    let values = dyad::floating(l, &at, assembly).map_err(value_error)?;
                    rows.extend(values.map(|values| row(phi_deg, k, values)));
                }
            }
            machine::Linkage::Planar(l) => {
                let modes = l.solver.assembly_modes(l.inner(drive(l, phi_deg)));
                for (k, state) in modes.states.iter().enumerate() {
                    let values = planar::values(l, l.loads_on(state).as_ref(), state, ALL);
                    rows.push(row(phi_deg, k, values));
                }
            }
        }
        Ok(table(py, self.columns(), rows))
    }

    /// The drawing of a branch.
    fn svg(&self, py: Python<'_>, branch: Option<usize>) -> PyResult<String> {
        py.detach(|| match &self.linkage {
            machine::Linkage::ClassIii(l) => {
                let (chosen, _) = self.branch(l, Rational::new(), branch)?;
                let path = class_iii::path(l, &chosen, drawn::SAMPLES).map_err(value_error)?;
                Ok(drawn::class_iii(l, &chosen, &path))
            }
            machine::Linkage::Dyad(l) => Ok(drawn::dyad(l, assembly(l, branch)?)),
            machine::Linkage::Planar(l) => {
                let start = l.start.at.filter(|_| branch.is_none());
                let first = start.or(l.window.map(|w| w[0])).unwrap_or(0.0);
                let chosen = planar::choose(l, drive(l, first), branch).map_err(value_error)?;
                Ok(drawn::planar(l, &chosen))
            }
        })
    }

    /// A row for each value of the drive (degrees, or metres), in their order; NaN where the branch
    /// does not reach.
    fn sweep<'py>(
        &self,
        py: Python<'py>,
        phi_deg: PyReadonlyArray1<'py, f64>,
        branch: Option<usize>,
    ) -> PyResult<Table<'py>> {
        let angles = phi_deg.as_slice()?;
        let names = self.columns();
        let missing = vec![f64::NAN; names.len() - 2];
        let along = |number: usize, values: &mut dyn FnMut(f64) -> PyResult<Option<Vec<f64>>>| {
            let one = |(k, &phi): (usize, &f64)| {
                if k % ROWS == 0 {
                    py.check_signals()?;
                }
                degrees(phi)?;
                let values = values(phi)?.unwrap_or_else(|| missing.clone());
                Ok(row(phi, number, values))
            };
            angles.iter().enumerate().map(one).collect::<PyResult<_>>()
        };
        let rows = match &self.linkage {
            machine::Linkage::ClassIii(l) => {
                let first = degrees(angles.first().copied().unwrap_or(0.0))?;
                let (chosen, _) = self.branch(l, first, branch)?;
                let mut here = chosen.start;
                along(chosen.mode, &mut |phi| {
                    let to = phi.to_radians();
                    if let Reach::Part { low, high } = chosen.reach
                        && !(low.reached <= to && to <= high.reached)
                    {
                        return Ok(None);
                    }
                    let to = Angle::from_rad(to);
                    here = l.solver.follow(&here, to).map_err(value_error)?;
                    Ok(Some(class_iii::values(l, &here)))
                })?
            }
            machine::Linkage::Dyad(l) => {
                let assembly = assembly(l, branch)?;
                return Ok((names, dyad_table(py, l, angles, assembly)?));
            }
            machine::Linkage::Planar(l) => {
                let first = angles.first().copied().unwrap_or(0.0);
                let start = match (branch, l.start.at) {
                    (None, Some(at)) => at,
                    _ => first,
                };
                degrees(start)?;
                let chosen = planar::choose(l, drive(l, start), branch).map_err(value_error)?;
                let mut here = chosen.start.clone();
                along(chosen.mode, &mut |phi| {
                    let Some(at) = chosen.turned_to(l, drive(l, phi)) else {
                        return Ok(None);
                    };
                    here = l.solver.follow(&here, l.inner(at)).map_err(value_error)?;
                    Ok(Some(planar::values(l, chosen.loads.as_ref(), &here, ALL)))
                })?
            }
        };
        Ok(table(py, names, rows))
    }

    /// Certified digits of the row at an exact crank angle in degrees: names and decimals, `None`
    /// where they could not be proved, or where both assemblies meet and a derivative has no value.
    fn certified(
        &self,
        py: Python<'_>,
        phi_deg: (String, String),
        digits: u32,
        branch: Option<usize>,
    ) -> PyResult<Vec<(String, Option<String>)>> {
        let at = rational(&phi_deg)?;
        let near = nearest_f64(&at);
        degrees(near)?;
        let (names, values) = match &self.linkage {
            machine::Linkage::ClassIii(l) => {
                let (chosen, _) = self.branch(l, at.clone(), branch)?;
                let state = l
                    .solver
                    .follow(&chosen.start, Angle::from_deg(near))
                    .map_err(|e| DomainError::new_err(readable(&e.to_string()).into_owned()))?;
                let values = py.detach(|| {
                    let mut certifier = Certifier::new(l, digits);
                    let q = certifier.advance(&at, &state)?;
                    Some(certifier.values(&at, &q))
                });
                let values = values.ok_or_else(|| {
                    Undecided::new_err(format!(
                        "no position near phi1 = {near} deg could be proved"
                    ))
                })?;
                (class_iii::names(l, true), values)
            }
            machine::Linkage::Dyad(l) => {
                let assembly = assembly(l, branch)?;
                match py.detach(|| dyad::certified(l, &at, assembly, digits)) {
                    Proved::Values(values) | Proved::Singular(values) => {
                        (dyad::names(l), values.to_vec())
                    }
                    Proved::Unreachable => {
                        return Err(DomainError::new_err(format!(
                            "the crank does not reach phi1 = {near} deg: the links cannot be joined there"
                        )));
                    }
                }
            }
            machine::Linkage::Planar(l) => {
                let start = match (branch, l.start.at) {
                    (None, Some(at)) => at,
                    _ => near,
                };
                degrees(start)?;
                let chosen = planar::choose(l, drive(l, start), branch).map_err(value_error)?;
                let at_drive = chosen.turned_to(l, drive(l, near)).ok_or_else(|| {
                    let text = l.drive_text(drive(l, near));
                    DomainError::new_err(format!("the branch has no row at {text}"))
                })?;
                let state = l
                    .solver
                    .follow(&chosen.start, l.inner(at_drive))
                    .map_err(value_error)?;
                let certifier = planar::Certifier::new(l, digits).map_err(value_error)?;
                let values = py.detach(|| certifier.values(&at, &state, true));
                (planar::certified_names(l, true), values)
            }
        };
        Ok(names.into_iter().skip(2).zip(values).collect())
    }
}

/// Runs the machine of a description; its rows and how the run ended.
#[pyfunction]
pub fn run_up<'py>(
    py: Python<'py>,
    text: String,
    is_json: bool,
    tolerance: Option<f64>,
) -> PyResult<(Table<'py>, String)> {
    let overrides = Overrides {
        tolerance,
        ..Overrides::default()
    };
    let done: Result<_, String> = interruptible(py, move || {
        let word = |e: &dyn std::fmt::Display| e.to_string();
        let machine = Machine::read(&source(text, is_json), overrides).map_err(|e| word(&e))?;
        let model = machine.reduced().map_err(|e| word(&e))?;
        let equation = Equation::new(&*model, &machine.drive);
        run(&equation, &machine.plan).map_err(|e| word(&e))
    })?;
    let motion = done.map_err(value_error)?;
    let rows = motion
        .samples
        .iter()
        .map(|s| machine::run_up::row(s).to_vec())
        .collect();
    let names = machine::run_up::COLUMNS.map(String::from).to_vec();
    Ok((table(py, names, rows), format!("{:?}", motion.outcome)))
}

/// A cam-driven oscillator.
#[pyclass(frozen, module = "mechaudit._mechaudit")]
pub struct Cam {
    machine: CamOscillator,
    response: mechaudit::solvers::chirp_chart::CamResponse,
    text: String,
    is_json: bool,
    harmonics: Option<u32>,
}

#[pymethods]
impl Cam {
    #[new]
    fn new(text: String, is_json: bool, harmonics: Option<u32>) -> PyResult<Cam> {
        let machine =
            CamOscillator::read(&source(text.clone(), is_json), harmonics).map_err(value_error)?;
        let response = machine.response(&machine.drive).map_err(value_error)?;
        Ok(Cam {
            machine,
            response,
            text,
            is_json,
            harmonics,
        })
    }

    fn __getnewargs__(&self) -> (String, bool, Option<u32>) {
        (self.text.clone(), self.is_json, self.harmonics)
    }

    #[getter]
    fn name(&self) -> &str {
        &self.machine.name
    }

    #[getter]
    fn law(&self) -> &str {
        &self.machine.law
    }

    #[getter]
    fn harmonics(&self) -> u32 {
        self.machine.harmonics
    }

    /// The motion at each time in seconds.
    fn response<'py>(
        &self,
        py: Python<'py>,
        t: PyReadonlyArray1<'py, f64>,
    ) -> PyResult<Table<'py>> {
        let unit = self.machine.unit;
        let mut names = ["t_s", "shaft_deg", "speed_rad_per_s"]
            .map(String::from)
            .to_vec();
        names.extend([
            format!("f_{unit}"),
            format!("y_{unit}"),
            format!("v_{unit}_per_s"),
            format!("a_{unit}_per_s2"),
        ]);
        let mut rows = Vec::new();
        for (k, &t) in t.as_slice()?.iter().enumerate() {
            if k % ROWS == 0 {
                py.check_signals()?;
            }
            let s = self.response.state(t).map_err(value_error)?;
            rows.push(vec![
                s.t,
                360.0 * s.turns,
                s.speed,
                s.cam,
                s.displacement,
                s.velocity,
                s.acceleration,
            ]);
        }
        Ok(table(py, names, rows))
    }

    /// Facts for a drawing's title.
    fn facts<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let all = PyDict::new(py);
        let drive = &self.machine.drive;
        all.set_item("w_rad_per_s", drive.oscillator.w())?;
        all.set_item("n_rad_per_s", drive.oscillator.n())?;
        all.set_item("omega0_rad_per_s", drive.chirp.omega0)?;
        all.set_item("epsilon_rad_per_s2", drive.chirp.eps)?;
        Ok(all)
    }
}
