//! Where the rows go and how a run with undecided digits ends.

use super::complain;
use super::failure::{Failure, Outcome};
use super::output::Output;

/// [`Output::write`] with an outcome.
pub fn write_to_result(
    output: Output,
    write: impl FnOnce(&mut dyn std::io::Write) -> Result<Outcome, Failure>,
) -> Result<Outcome, Failure> {
    let mut outcome = Outcome::AsExpected;
    output.write(|out| {
        outcome = write(out)?;
        Ok(())
    })?;
    Ok(outcome)
}

/// Says how many values stayed undecided; any is a finding.
pub fn decided(undecided: usize, digits: u32) -> Outcome {
    if undecided > 0 {
        complain(&format!(
            "undecided: {undecided} {} could not be certified to {digits} digits",
            if undecided == 1 { "value" } else { "values" }
        ));
    }
    Outcome::of(undecided == 0)
}
