//! The extension module `mechaudit._mechaudit`; the Python side of the package is in `package/`.
#![warn(missing_docs)]

mod special;

use pyo3::prelude::*;

/// The compiled part of the package.
#[pymodule]
mod _mechaudit {
    use super::*;

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        module.add("__version__", env!("CARGO_PKG_VERSION"))?;
        module.add("HAS_ORACLE", cfg!(feature = "oracle"))?;
        special::add_to(module)
    }
}
