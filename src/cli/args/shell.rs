//! Arguments of `mechaudit completions` and `mechaudit man`.

use clap::Args as ClapArgs;
use std::path::PathBuf;

pub const AFTER_COMPLETIONS: &str = "\
Examples:
  mechaudit completions bash > ~/.local/share/bash-completion/completions/mechaudit
  mechaudit completions fish > ~/.config/fish/completions/mechaudit.fish";

pub const AFTER_MAN: &str = "\
Examples:
  mechaudit man | man -l -
  mechaudit man --output ~/.local/share/man/man1";

/// Arguments of `completions`.
#[derive(ClapArgs, Debug)]
pub struct CompletionsArgs {
    /// The shell
    pub shell: clap_complete::Shell,
}

/// Arguments of `man`.
#[derive(ClapArgs, Debug)]
pub struct ManArgs {
    /// Write one page for each command into this folder
    #[arg(long, value_name = "DIR")]
    pub output: Option<PathBuf>,
}
