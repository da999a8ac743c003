//! Units of the columns.

use clap::Args as ClapArgs;

/// Units instead of those of the columns.
#[derive(ClapArgs, Debug)]
pub struct UnitsArgs {
    /// Units of the columns instead of SI units and degrees, for instance mm,deg or ms,rpm; the
    /// names of the columns carry them
    #[arg(long, value_name = "UNITS", value_delimiter = ',')]
    pub units: Vec<String>,
}
