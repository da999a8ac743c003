//! Makes ufuncs from loops.

use numpy::npyffi::{NPY_TYPES, PY_UFUNC_API, npy_intp};
use pyo3::prelude::*;
use std::ffi::{CStr, CString, c_char, c_int, c_void};
use std::ptr;

/// The C type of a loop: arguments, number of elements, strides in bytes, data.
pub type LoopFunction =
    unsafe extern "C" fn(*mut *mut c_char, *mut npy_intp, *mut npy_intp, *mut c_void);

/// A loop with the types of its inputs and its output.
pub struct Loop {
    function: LoopFunction,
    types: Vec<c_char>,
}

impl Loop {
    pub fn new(function: LoopFunction, types: &[NPY_TYPES]) -> Loop {
        Loop {
            function,
            types: types.iter().map(|t| *t as c_char).collect(),
        }
    }
}

/// A ufunc with one output.
pub fn ufunc(
    py: Python<'_>,
    name: &'static CStr,
    doc: &str,
    loops: Vec<Loop>,
) -> PyResult<Py<PyAny>> {
    let inputs = loops[0].types.len() - 1;
    let count = loops.len() as c_int;
    // NumPy keeps pointers to all of these for as long as the ufunc lives: until the process ends.
    let doc = CString::new(doc.trim_end())?.into_raw();
    let types: Vec<c_char> = loops.iter().flat_map(|l| l.types.clone()).collect();
    let types = Box::leak(types.into_boxed_slice());
    let functions: Vec<_> = loops.iter().map(|l| Some(l.function)).collect();
    let functions = Box::leak(functions.into_boxed_slice());
    let data = Box::leak(vec![ptr::null_mut::<c_void>(); loops.len()].into_boxed_slice());
    // SAFETY: the interpreter is attached; the arrays are as long as the counts say and are never
    // freed; each loop takes arguments of the types named beside it.
    unsafe {
        let made = PY_UFUNC_API.PyUFunc_FromFuncAndData(
            py,
            functions.as_mut_ptr().cast(),
            data.as_mut_ptr(),
            types.as_mut_ptr(),
            count,
            inputs as c_int,
            1,
            // PyUFunc_None: it has no identity.
            -1,
            name.as_ptr(),
            doc,
            0,
        );
        Bound::from_owned_ptr_or_err(py, made).map(Bound::unbind)
    }
}
