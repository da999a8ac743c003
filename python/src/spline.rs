//! Splines, one column of ordinates at a time.

use crate::errors::value_error;
use mechaudit::solvers::cubic_spline::{
    Boundary, CubicSpline, CubicSplineError, End, EvaluationError, Extrapolation, Jet,
    UniformCubicSpline,
};
use mechaudit::solvers::hermite_spline::{HermiteSpline as Hermite, Slopes};
use numpy::{PyArray1, PyReadonlyArray1, ToPyArray};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

enum Kind {
    Arbitrary(CubicSpline),
    Uniform(UniformCubicSpline),
}

/// A cubic spline through one column of ordinates.
#[pyclass(frozen, module = "mechaudit._mechaudit")]
pub struct Spline(Kind);

/// The step if every knot is the `f64` nearest to `first + k step`.
fn uniform_step(x: &[f64]) -> Option<f64> {
    let n = x.len();
    if n < 3 {
        return None;
    }
    let (first, last) = (x[0], x[n - 1]);
    let step = (last - first) / (n - 1) as f64;
    let on_grid = |step: f64| {
        x.iter()
            .enumerate()
            .all(|(k, x)| step.mul_add(k as f64, first) == *x)
    };
    [step, step.next_up(), step.next_down(), x[1] - first]
        .into_iter()
        .find(|s| *s > 0.0 && on_grid(*s))
}

fn end(kind: &str, value: f64) -> PyResult<End> {
    match kind {
        "first" => Ok(End::FirstDerivative(value)),
        "second" => Ok(End::SecondDerivative(value)),
        "not-a-knot" => Ok(End::NotAKnot),
        _ => Err(PyValueError::new_err(format!(
            "bc_type: an end is 'first', 'second' or 'not-a-knot', not {kind:?}"
        ))),
    }
}

impl Kind {
    fn extrapolated(self, how: Extrapolation) -> Kind {
        match self {
            Kind::Arbitrary(s) => Kind::Arbitrary(s.with_extrapolation(how)),
            Kind::Uniform(s) => Kind::Uniform(s.with_extrapolation(how)),
        }
    }

    fn values(&self, x: &[f64], order: u32) -> Result<Vec<f64>, EvaluationError> {
        let mut out = vec![0.0; x.len()];
        if order == 0 {
            match self {
                Kind::Arbitrary(s) => s.values(x, &mut out)?,
                Kind::Uniform(s) => s.values(x, &mut out)?,
            }
            return Ok(out);
        }
        let jets = match self {
            Kind::Arbitrary(s) => s.jets(x)?,
            Kind::Uniform(s) => s.jets(x)?,
        };
        Ok(derivatives(&jets, order))
    }
}

/// The derivatives of an order from 1.
fn derivatives(jets: &[Jet], order: u32) -> Vec<f64> {
    let one = |jet: &Jet| match order {
        1 => jet.first,
        2 => jet.second,
        3 => jet.third,
        _ => 0.0,
    };
    jets.iter().map(one).collect()
}

/// The behaviour outside the knots.
fn extrapolation(wrap: bool) -> Extrapolation {
    match wrap {
        true => Extrapolation::Wrap,
        false => Extrapolation::EndPolynomial,
    }
}

#[pymethods]
impl Spline {
    /// Fits it; `ends` is nothing for a periodic spline.
    #[new]
    fn new(
        py: Python<'_>,
        x: PyReadonlyArray1<'_, f64>,
        y: PyReadonlyArray1<'_, f64>,
        ends: Option<[(String, f64); 2]>,
        wrap: bool,
    ) -> PyResult<Spline> {
        let boundary = match ends {
            None => Boundary::Periodic,
            Some([first, last]) => Boundary::Ends(end(&first.0, first.1)?, end(&last.0, last.1)?),
        };
        let (x, y) = (x.as_slice()?, y.as_slice()?);
        let fitted: Result<Kind, CubicSplineError> = py.detach(|| {
            let uniform = uniform_step(x).filter(|_| x.len() == y.len());
            if let Some(step) = uniform
                && let Ok(s) = UniformCubicSpline::fit(x[0], step, y.to_vec(), boundary)
            {
                return Ok(Kind::Uniform(s));
            }
            CubicSpline::fit(x.to_vec(), y.to_vec(), boundary).map(Kind::Arbitrary)
        });
        let fitted = fitted.map_err(value_error)?;
        Ok(Spline(fitted.extrapolated(extrapolation(wrap))))
    }

    /// Returns true if the knots were found to be equally spaced.
    #[getter]
    fn uniform(&self) -> bool {
        matches!(self.0, Kind::Uniform(_))
    }

    /// A derivative at finite points; outside the knots that of the polynomial of the end.
    fn values<'py>(
        &self,
        py: Python<'py>,
        x: PyReadonlyArray1<'py, f64>,
        order: u32,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let x = x.as_slice()?;
        let values = py.detach(|| self.0.values(x, order)).map_err(value_error)?;
        Ok(values.to_pyarray(py))
    }

    /// The integral from `a` to `b`.
    fn integral(&self, a: f64, b: f64) -> PyResult<f64> {
        match &self.0 {
            Kind::Arbitrary(s) => s.integral(a, b),
            Kind::Uniform(s) => s.integral(a, b),
        }
        .map_err(value_error)
    }

    /// The second derivatives at the knots.
    fn second_derivatives<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        match &self.0 {
            Kind::Arbitrary(s) => s.second_derivatives(),
            Kind::Uniform(s) => s.second_derivatives(),
        }
        .to_pyarray(py)
    }
}

/// A piecewise cubic through one column of ordinates, with slopes from neighbouring points.
#[pyclass(frozen, module = "mechaudit._mechaudit")]
pub struct HermiteSpline(Hermite);

#[pymethods]
impl HermiteSpline {
    /// Fits it; `slopes` is `pchip`, `akima` or `makima`.
    #[new]
    fn new(
        py: Python<'_>,
        x: PyReadonlyArray1<'_, f64>,
        y: PyReadonlyArray1<'_, f64>,
        slopes: &str,
        wrap: bool,
    ) -> PyResult<HermiteSpline> {
        let rule = match slopes {
            "pchip" => Slopes::Pchip,
            "akima" => Slopes::Akima,
            "makima" => Slopes::ModifiedAkima,
            _ => {
                return Err(PyValueError::new_err(format!(
                    "slopes are 'pchip', 'akima' or 'makima', not {slopes:?}"
                )));
            }
        };
        let (x, y) = (x.as_slice()?, y.as_slice()?);
        let fitted = py.detach(|| Hermite::fit(x.to_vec(), y.to_vec(), rule));
        let fitted = fitted.map_err(value_error)?;
        Ok(HermiteSpline(
            fitted.with_extrapolation(extrapolation(wrap)),
        ))
    }

    /// A derivative at finite points; outside the knots that of the polynomial of the end.
    fn values<'py>(
        &self,
        py: Python<'py>,
        x: PyReadonlyArray1<'py, f64>,
        order: u32,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let x = x.as_slice()?;
        let values = py.detach(|| {
            if order > 0 {
                return self.0.jets(x).map(|jets| derivatives(&jets, order));
            }
            let mut out = vec![0.0; x.len()];
            self.0.values(x, &mut out).map(|()| out)
        });
        Ok(values.map_err(value_error)?.to_pyarray(py))
    }

    /// The integral from `a` to `b`.
    fn integral(&self, a: f64, b: f64) -> PyResult<f64> {
        self.0.integral(a, b).map_err(value_error)
    }

    /// The slopes at the knots.
    fn slopes<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.0.slopes().to_pyarray(py)
    }
}
