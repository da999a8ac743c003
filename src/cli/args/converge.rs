//! Arguments of `mechaudit converge`.

use super::TextOrJson;
use clap::Args as ClapArgs;

pub const AFTER_HELP: &str = "\
Examples:
  mechaudit converge                           every approximation
  mechaudit converge spline-clamped
  mechaudit converge run-up-dop853-rotor --format json

Errors are upper bounds: total is value less truth, method is twin less truth, rounding value \
less twin, where the twin is the same algorithm without rounding. An error is the largest at the \
places that the report names: of a spline they fill the whole range, of a run-up there is one, its \
end. The order observed compares a \
level with the one before, of the method error where there is a twin; where the code under test \
chooses its steps itself, it is log2 of the method error before and after every step is cut in \
two. Richardson's uses the values alone. Work is counted, not timed. A failed run is marked, and no order is observed \
across it.

Exit codes: 0; 2, bad usage; 130, ended by Ctrl-C, with the approximations done until then.";

/// Arguments of `converge`.
#[derive(ClapArgs, Debug)]
pub struct ConvergeArgs {
    /// The approximation; all of them if left out
    pub name: Option<String>,
    /// Form of the report
    #[arg(long, value_enum, default_value = "text")]
    pub format: TextOrJson,
}
