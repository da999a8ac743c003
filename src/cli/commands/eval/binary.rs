//! Values at cases that come as binary frames, for whoever started this program with
//! `MECHAUDIT_PROTOCOL=binary`: [`audit --exec`](crate::cli::commands::audit) `--binary` among them.

use super::{BUFFER, EvalError, LINES};
use crate::cli::failure::{Failure, Outcome};
use crate::cli::process::frames::{Frame, Frames, REFUSAL, encode};
use mechaudit::audit::{Layout, SolverAnswer, answer_of};
use mechaudit::methods::Evaluable;
use std::io::{BufReader, Write};

/// Whether frames are asked for.
pub fn is_asked_for() -> bool {
    std::env::var_os("MECHAUDIT_PROTOCOL").is_some_and(|protocol| protocol == "binary")
}

/// Reads some frames, answers them in order, and so on.
pub fn stream(method: &dyn Evaluable) -> Result<Outcome, Failure> {
    // Not by way of what takes escape sequences out of a text.
    let mut out = std::io::stdout().lock();
    let input = BufReader::with_capacity(BUFFER, std::io::stdin().lock());
    let layout = Layout::new(method);
    let unread = |e: std::io::Error| Failure::caused(e).about("cannot read standard input");
    let mut frames = Frames::new(input);
    let mut answers = Vec::new();
    let mut number = 0u64;
    while let Some(frame) = frames.read().map_err(unread)? {
        number += 1;
        let about = |e: EvalError| Failure::caused(e).about(format!("frame {number}"));
        let x = match frame {
            Frame::Answer(SolverAnswer::Values(x)) => x,
            Frame::Answer(other) => return Err(about(EvalError::NoAnswer(other))),
            Frame::Text(_) => continue,
        };
        layout.lengths(&x).map_err(|e| about(e.into()))?;
        let refused = method.refusal(&x).is_some();
        match if refused {
            SolverAnswer::Declines(None)
        } else {
            answer_of(method, &x)
        } {
            SolverAnswer::Values(values) => encode(&values, &mut answers),
            SolverAnswer::Refuses(_) | SolverAnswer::Declines(_) => {
                answers.extend(REFUSAL.to_le_bytes());
            }
            other => return Err(about(EvalError::NoAnswer(other))),
        }
        // What has arrived is answered before more is waited for.
        if frames.is_drained() || answers.len() > 64 * LINES {
            out.write_all(&answers)?;
            out.flush()?;
            answers.clear();
        }
    }
    out.write_all(&answers)?;
    out.flush()?;
    Ok(Outcome::AsExpected)
}
