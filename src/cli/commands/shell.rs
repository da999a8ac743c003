//! Shell completions and manual pages.

use crate::cli::args::{Args, CompletionsArgs, ManArgs, explained};
use crate::cli::failure::{Failure, Outcome};
use crate::cli::files::output::Output;
use clap::CommandFactory;

const NAME: &str = "mechaudit";

/// Writes the completions of a shell.
pub fn completions(args: &CompletionsArgs) -> Result<Outcome, Failure> {
    let mut text = Vec::new();
    clap_complete::generate(args.shell, &mut Args::command(), NAME, &mut text);
    Output::open(None)?.text(text)?;
    Ok(Outcome::AsExpected)
}

/// Writes the manual page of the program, or one for each command into a folder.
pub fn man(args: &ManArgs) -> Result<Outcome, Failure> {
    let mut command = explained(Args::command());
    command.build();
    let Some(folder) = &args.output else {
        Output::open(None)?.text(render(command)?)?;
        return Ok(Outcome::AsExpected);
    };
    std::fs::create_dir_all(folder).map_err(|e| Failure::cannot("make", folder, e))?;
    let parts: Vec<clap::Command> = command.get_subcommands().cloned().collect();
    for part in parts {
        let name = format!("{NAME}-{}", part.get_name());
        // clap keeps names for the lifetime of the program.
        let page = render(part.name(name.clone().leak() as &'static str))?;
        Output::within(folder, &format!("{name}.1"))?.text(page)?;
    }
    Output::within(folder, &format!("{NAME}.1"))?.text(render(command)?)?;
    Ok(Outcome::AsExpected)
}

fn render(command: clap::Command) -> Result<Vec<u8>, Failure> {
    let mut text = Vec::new();
    clap_mangen::Man::new(command).render(&mut text)?;
    Ok(text)
}
