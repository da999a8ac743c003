//! Values at cases that come as binary frames, for whoever started this program with
//! `MECHAUDIT_PROTOCOL=binary`: [`audit --exec`](crate::cli::commands::audit) `--binary` among
//! them.

use super::{BUFFER, EvalError, Evaluation, LINES};
use crate::cli::failure::{Failure, Outcome};
use crate::cli::process::frames::{Frame, Frames, REFUSAL, encode};
use mechaudit::audit::{SolverAnswer, answer_of};
use std::io::{BufReader, Write};

/// Returns true if frames are asked for.
pub fn is_asked_for() -> bool {
    std::env::var_os("MECHAUDIT_PROTOCOL").is_some_and(|protocol| protocol == "binary")
}

/// Answers frames in their order, by one thread; those before one that cannot be read are answered.
pub fn stream(evaluation: &Evaluation) -> Result<Outcome, Failure> {
    // Not by way of what takes escape sequences out of a text.
    let mut out = std::io::stdout().lock();
    let unread = |e: std::io::Error| Failure::caused(e).about("cannot read standard input");
    let mut frames = Frames::new(BufReader::with_capacity(BUFFER, std::io::stdin().lock()));
    let mut answers = Vec::new();
    let mut number = 0u64;
    while let Some(frame) = frames.read().map_err(unread)? {
        number += 1;
        let answered = answer(evaluation, frame, &mut answers);
        // Lines that have arrived are answered before more are waited for.
        if answered.is_err() || frames.is_drained() || answers.len() > 64 * LINES {
            out.write_all(&answers)?;
            out.flush()?;
            answers.clear();
        }
        answered.map_err(|e| Failure::caused(e).about(format!("frame {number}")))?;
    }
    Ok(Outcome::AsExpected)
}

/// The answer to a frame, after those before it; a header has none.
fn answer(evaluation: &Evaluation, frame: Frame, answers: &mut Vec<u8>) -> Result<(), EvalError> {
    let method = evaluation.method;
    let x = match frame {
        Frame::Answer(SolverAnswer::Values(x)) => x,
        Frame::Answer(SolverAnswer::Declines(_)) => return Err(EvalError::NotAnInput("a refusal")),
        Frame::Answer(_) => return Err(EvalError::NotAnInput("cut off")),
        Frame::Text(_) => return Ok(()),
    };
    evaluation.layout.lengths(&x)?;
    if method.refusal(&x).is_some() {
        answers.extend(REFUSAL.to_le_bytes());
        return Ok(());
    }
    match answer_of(method, &x) {
        SolverAnswer::Values(values) => encode(&evaluation.selected(values), answers),
        SolverAnswer::Refuses(_) | SolverAnswer::Declines(_) => {
            answers.extend(REFUSAL.to_le_bytes());
        }
        other => return Err(EvalError::NoAnswer(other)),
    }
    Ok(())
}
