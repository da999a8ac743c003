//! Arguments of `mechaudit describe` and `mechaudit list`.

use super::TextOrJson;
use clap::Args as ClapArgs;

pub const AFTER_DESCRIBE: &str = "\
Examples:
  mechaudit describe faddeeva
  mechaudit describe cubic-spline-clamped --format json";

pub const AFTER_LIST: &str = "\
Examples:
  mechaudit list
  mechaudit list cubic-spline-clamped
  mechaudit list --format json                 the descriptions of all methods";

/// Arguments of `describe`.
#[derive(ClapArgs, Debug)]
pub struct DescribeArgs {
    /// The method
    pub method: String,
    /// Form of the description
    #[arg(long, value_enum, default_value = "text")]
    pub format: TextOrJson,
}

/// Arguments of `list`.
#[derive(ClapArgs, Debug)]
pub struct ListArgs {
    /// The method; all methods and papers if left out
    pub method: Option<String>,
    /// Form of the list
    #[arg(long, value_enum, default_value = "text")]
    pub format: TextOrJson,
}
