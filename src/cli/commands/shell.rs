//! Shell completions and manual pages.

use crate::cli::args::{Args, CompletionsArgs, ManArgs};
use crate::cli::failure::{Failure, Outcome};
use crate::cli::files::output::write_to;
use clap::CommandFactory;

const NAME: &str = "mechaudit";

/// Writes the completions of a shell.
pub fn completions(args: &CompletionsArgs) -> Result<Outcome, Failure> {
    let mut text = Vec::new();
    clap_complete::generate(args.shell, &mut Args::command(), NAME, &mut text);
    write_to(None, |out| Ok(out.write_all(&text)?))?;
    Ok(Outcome::AsExpected)
}

/// Writes the manual page of the program, or one for each command into a folder.
pub fn man(args: &ManArgs) -> Result<Outcome, Failure> {
    let mut command = Args::command();
    command.build();
    let Some(folder) = &args.output else {
        let page = render(command)?;
        write_to(None, |out| Ok(out.write_all(&page)?))?;
        return Ok(Outcome::AsExpected);
    };
    std::fs::create_dir_all(folder).map_err(|e| Failure::cannot("make", folder, e))?;
    let parts: Vec<clap::Command> = command.get_subcommands().cloned().collect();
    for part in parts {
        let name = format!("{NAME}-{}", part.get_name());
        // clap keeps names for the lifetime of the program.
        let page = render(part.name(name.clone().leak() as &'static str))?;
        let path = folder.join(format!("{name}.1"));
        write_to(Some(&path), |out| Ok(out.write_all(&page)?))?;
    }
    let page = render(command)?;
    write_to(Some(&folder.join(format!("{NAME}.1"))), |out| {
        Ok(out.write_all(&page)?)
    })?;
    Ok(Outcome::AsExpected)
}

fn render(command: clap::Command) -> Result<Vec<u8>, Failure> {
    let mut text = Vec::new();
    clap_mangen::Man::new(command).render(&mut text)?;
    Ok(text)
}
