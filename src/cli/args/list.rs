//! Arguments of `mechaudit list`.

use super::TextOrJson;
use clap::Args as ClapArgs;

pub const AFTER_HELP: &str = "\
Examples:
  mechaudit list
  mechaudit list --format json";

/// Arguments of `list`.
#[derive(ClapArgs, Debug)]
pub struct ListArgs {
    /// Form of the list
    #[arg(long, value_enum, default_value = "text")]
    pub format: TextOrJson,
}
