//! Arguments of `mechaudit list`.

use super::TextOrJson;
use clap::Args as ClapArgs;

pub const AFTER_HELP: &str = "\
Examples:
  mechaudit list
  mechaudit list cubic-spline-clamped          one method: layout, budgets, domain
  mechaudit list --format json";

/// Arguments of `list`.
#[derive(ClapArgs, Debug)]
pub struct ListArgs {
    /// The method; all methods and papers if left out
    pub method: Option<String>,
    /// Form of the list
    #[arg(long, value_enum, default_value = "text")]
    pub format: TextOrJson,
}
