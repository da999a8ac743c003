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

registry![>>>>>>> spline, class_iii, class_iii_assembly_modes, cubic_spline_clamped, cubic_spline_not_a_knot, cubic_spline_periodic, cubic_spline_second_derivatives, cubic_spline_uniform, cyclic_tridiagonal, four_bar, slider_crank, tridiagonal
=======
mod cubic_spline_common;
mod cubic_spline_conditions;

registry![
    tridiagonal];

/// The method of that name.
pub fn find(name: &str) -> Option<Box<dyn Method>> {
    registry().into_iter().find(|m| m.name() == name)
}
