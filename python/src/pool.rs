//! Threads that survive a fork of the process.

use crate::errors::value_error;
use pyo3::PyResult;
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::sync::{Arc, Mutex, PoisonError};

/// The pool of this process. After a fork the child has none of its parent's threads, and work
/// given to them would wait for ever: it gets a pool of its own.
pub fn pool() -> PyResult<Arc<ThreadPool>> {
    static POOL: Mutex<Option<(u32, Arc<ThreadPool>)>> = Mutex::new(None);
    let mut known = POOL.lock().unwrap_or_else(PoisonError::into_inner);
    let process = std::process::id();
    if let Some((owner, pool)) = &*known
        && *owner == process
    {
        return Ok(pool.clone());
    }
    let fresh = Arc::new(ThreadPoolBuilder::new().build().map_err(value_error)?);
    if let Some(parents) = known.replace((process, fresh.clone())) {
        // Its threads are not here to be joined.
        std::mem::forget(parents);
    }
    Ok(fresh)
}
