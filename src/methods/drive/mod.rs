//! Linkages under a motor.

crate::methods::definition::methods! {
    pub(super) run_up: RunUp;
}
