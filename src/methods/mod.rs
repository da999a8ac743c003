//! The registry: one file for each audited method, one word in the list below.

use crate::audit::Method;

macro_rules! registry {
    ($($module:ident),* $(,)?) => {
        $(mod $module;)*

        /// Every audited method.
        pub fn registry() -> Vec<Box<dyn Method>> {
            vec![$(Box::new($module::Audit)),*]
        }
    };
}

registry![
    class_iii,
    class_iii_assembly_modes,
    cyclic_tridiagonal,
    four_bar,
    slider_crank,
    tridiagonal
];

/// The method of that name.
pub fn find(name: &str) -> Option<Box<dyn Method>> {
    registry().into_iter().find(|m| m.name() == name)
}
