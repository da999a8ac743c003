//! The extension module `mechaudit._mechaudit`; the Python side of the package is in `package/`.
#![warn(missing_docs)]

#[cfg(feature = "oracle")]
mod audit;
#[cfg(feature = "oracle")]
mod certified;
mod errors;
#[cfg(feature = "oracle")]
mod facts;
mod files;
mod interrupt;
mod linear;
#[cfg(feature = "oracle")]
mod machine;
#[cfg(feature = "oracle")]
mod pool;
mod special;
mod spline;
#[cfg(feature = "oracle")]
mod study;

use pyo3::prelude::*;

/// The compiled part of the package.
#[pymodule]
mod _mechaudit {
    use super::*;

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        let py = module.py();
        module.add("__version__", env!("CARGO_PKG_VERSION"))?;
        module.add("HAS_ORACLE", cfg!(feature = "oracle"))?;
        module.add("Undecided", py.get_type::<errors::Undecided>())?;
        module.add("DomainError", py.get_type::<errors::DomainError>())?;
        special::add_to(module)?;
        module.add_function(wrap_pyfunction!(files::write_file, module)?)?;
        module.add_class::<spline::Spline>()?;
        module.add_class::<spline::HermiteSpline>()?;
        module.add_function(wrap_pyfunction!(linear::solve_tridiagonal, module)?)?;
        module.add_function(wrap_pyfunction!(linear::solve_cyclic, module)?)?;
        module.add_function(wrap_pyfunction!(linear::tridiagonal_stability, module)?)?;
        module.add_function(wrap_pyfunction!(linear::cyclic_stability, module)?)?;
        #[cfg(feature = "oracle")]
        {
            module.add_class::<audit::Run>()?;
            module.add_class::<machine::Linkage>()?;
            module.add_class::<machine::Cam>()?;
            module.add_function(wrap_pyfunction!(machine::run_up, module)?)?;
            module.add_function(wrap_pyfunction!(facts::all_methods, module)?)?;
            module.add_function(wrap_pyfunction!(facts::method, module)?)?;
            module.add_function(wrap_pyfunction!(study::open_study, module)?)?;
            module.add_function(wrap_pyfunction!(study::open_formula, module)?)?;
            module.add_function(wrap_pyfunction!(study::study_facts, module)?)?;
            module.add_function(wrap_pyfunction!(study::study_digits, module)?)?;
            module.add_function(wrap_pyfunction!(study::study_values, module)?)?;
            module.add_function(wrap_pyfunction!(certified::certify, module)?)?;
            module.add_function(wrap_pyfunction!(certified::zero, module)?)?;
            module.add_function(wrap_pyfunction!(certified::spline, module)?)?;
        }
        Ok(())
    }
}
