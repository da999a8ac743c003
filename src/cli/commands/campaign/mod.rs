//! Campaigns: plan, run, status, merge, report.

mod folder;
mod hard;
mod run;

use self::folder::{Folder, State};
use crate::cli::args::{
    CampaignArgs, CampaignReportArgs, CampaignStep, MergeArgs, PlanArgs, StatusArgs,
};
use crate::cli::complain;
use crate::cli::failure::{Failure, Outcome};
use crate::cli::files::output::{Output, print, print_as, write_json, write_to};
use crate::cli::files::source;
use mechaudit::audit::Method;
use mechaudit::campaign::{PartSum, Plan, Sum};
use mechaudit::report::words::numbers::count;
use mechaudit::report::{html, json};
use serde_json::{Value, json};
use std::path::PathBuf;
use std::sync::atomic::{AtomicU64, Ordering};

/// Does a step.
pub fn campaign(args: &CampaignArgs) -> Result<Outcome, Failure> {
    match &args.step {
        CampaignStep::Plan(a) => plan(a),
        CampaignStep::Run(a) => run::run(a),
        CampaignStep::Status(a) => status(a),
        CampaignStep::Merge(a) => merge(a),
        CampaignStep::Report(a) => report(a),
    }
}

fn plan(args: &PlanArgs) -> Result<Outcome, Failure> {
    let source = source::open(&args.file)?;
    let plan = Plan::read(&source).map_err(|e| Failure::in_file(&args.file, e))?;
    let folder = Folder::make(&args.output, plan, args.shards)?;
    let (name, shards) = (&folder.plan.name, folder.deal.shards());
    let parts = count(folder.plan.parts.len(), "part");
    let work = folder.deal.work();
    let shards = count(shards as usize, "shard");
    print(&format!(
        "{name}: {parts}, {work} judgements in {shards}.\n"
    ))?;
    Ok(Outcome::AsExpected)
}

fn status(args: &StatusArgs) -> Result<Outcome, Failure> {
    let folder = Folder::open(&args.folder)?;
    let status = Status::of(&folder)?;
    if args.missing {
        write_to(|out| {
            let mut missing = status.missing.iter();
            Ok(missing.try_for_each(|k| writeln!(out, "{k}"))?)
        })?;
    } else {
        let text = || status.text(&|k| folder.file(k));
        print_as(args.format, text, || status.document())?;
    }
    if let Some((k, why)) = status.refused.first() {
        let file = folder.file(*k);
        return Err(Failure::new(format!("{}: {why}", file.display())));
    }
    Ok(Outcome::of(status.done == status.shards))
}

/// The progress of a campaign.
#[derive(Default)]
struct Status {
    name: String,
    shards: u64,
    done: u64,
    /// Those that are not done, numbers alone.
    missing: Vec<u64>,
    /// Those of them in whose place is something else, and what.
    bad: Vec<(u64, String)>,
    refused: Vec<(u64, String)>,
    /// Cases and evaluations of all shards, and of those done.
    total: u64,
    judged: u64,
    /// Of all threads together.
    seconds: f64,
}

impl Status {
    fn of(folder: &Folder) -> Result<Status, Failure> {
        let mut status = Status {
            name: folder.plan.name.clone(),
            shards: folder.deal.shards(),
            total: folder.deal.work(),
            ..Status::default()
        };
        for (k, state) in (0..).zip(folder.states()?) {
            match state {
                State::Done(header) => {
                    status.done += 1;
                    status.judged += folder.deal.work_of(k);
                    status.seconds += header.seconds * header.threads as f64;
                }
                State::Missing => status.missing.push(k),
                State::Bad(why) => {
                    status.missing.push(k);
                    status.bad.push((k, why));
                }
                State::Refused(why) => status.refused.push((k, why)),
            }
        }
        Ok(status)
    }

    fn document(&self) -> Value {
        let files = |all: &[(u64, String)]| -> Vec<Value> {
            let all = all.iter();
            all.map(|(k, why)| json!({ "shard": k, "why": why }))
                .collect()
        };
        json!({
            "schema_version": 1,
            "name": self.name,
            "shards": self.shards,
            "done": self.done,
            "missing": self.missing,
            "bad": files(&self.bad),
            "refused": files(&self.refused),
            "judgements": self.total,
            "judged": self.judged,
            "thread_seconds": self.seconds,
        })
    }

    fn text(&self, file: &dyn Fn(u64) -> PathBuf) -> String {
        let (name, total) = (&self.name, self.total);
        let share = 100.0 * self.judged as f64 / total.max(1) as f64;
        let shards = count(self.shards as usize, "shard");
        let done = self.done;
        let mut text =
            format!("{name}: {done} of {shards} done, {share:.1} % of {total} judgements.\n");
        if done > 0 {
            // Of threads that had a core each.
            let rate = match self.seconds > 0.0 {
                true => self.judged as f64 / self.seconds,
                false => 0.0,
            };
            let left = match total - self.judged {
                0 => ".".into(),
                n => format!("; {} on one thread for the others.", time(n as f64 / rate)),
            };
            text += &format!("{rate:.0} a second and thread{left}\n");
        }
        for (k, why) in &self.bad {
            text += &format!("{}: {why}\n", file(*k).display());
        }
        text
    }
}

fn time(seconds: f64) -> String {
    match seconds {
        s if s < 120.0 => format!("{s:.0} s"),
        s if s < 7200.0 => format!("{:.0} min", s / 60.0),
        s => format!("{:.1} h", s / 3600.0),
    }
}

/// The sum of the shards that are done, and how many are not.
fn sum<'a>(folder: &'a Folder, methods: &'a [Box<dyn Method>]) -> Result<(Sum<'a>, u64), Failure> {
    let shards = folder.deal.shards();
    let next = AtomicU64::new(0);
    let added = rayon::broadcast(|_| {
        let mut sum = Sum::new(&folder.plan, methods);
        loop {
            let k = next.fetch_add(1, Ordering::Relaxed);
            if k >= shards {
                return Ok::<Sum, Failure>(sum);
            }
            if let Some(content) = folder.content(k)? {
                let bad = |e| Failure::in_file(&folder.file(k), e);
                sum.add(content).map_err(bad)?;
            }
        }
    });
    let mut all = Sum::new(&folder.plan, methods);
    for sum in added {
        all.merge(sum?).map_err(Failure::caused)?;
    }
    let missing = shards - all.shards();
    Ok((all, missing))
}

fn merge(args: &MergeArgs) -> Result<Outcome, Failure> {
    let folder = Folder::open(&args.folder)?;
    folder.same_program()?;
    let output = Output::open(args.output.as_deref())?;
    if let Some(hard) = args.hard.as_deref().filter(|f| !f.is_dir()) {
        let hard = hard.display();
        return Err(Failure::new(format!(
            "--hard {hard}: there is no such folder"
        )));
    }
    let methods = folder.plan.methods();
    let (sum, missing) = sum(&folder, &methods)?;
    if missing > 0 {
        let states = folder.states()?;
        let first = states.iter().position(|s| !matches!(s, State::Done(_)));
        let n = count(missing as usize, "shard");
        let first = first.map_or(String::new(), |k| format!(", the first: {k}"));
        return Err(Failure::new(format!(
            "{}: {n} of {} not done{first}",
            args.folder.display(),
            folder.deal.shards()
        )));
    }
    let parts = sum.finish(true);
    if let Some(hard) = &args.hard {
        hard::record(hard, &folder.plan, &parts)?;
    }
    write_json(
        output,
        &json::campaign(&folder.plan, &folder.identity, &parts),
    )?;
    Ok(Outcome::of(parts.iter().all(PartSum::passed)))
}

fn report(args: &CampaignReportArgs) -> Result<Outcome, Failure> {
    let folder = Folder::open(&args.folder)?;
    folder.same_program()?;
    let output = Output::open(args.output.as_deref())?;
    let methods = folder.plan.methods();
    let (sum, missing) = sum(&folder, &methods)?;
    let parts = sum.finish(missing == 0);
    let shards = folder.deal.shards();
    let done = (shards - missing, shards);
    output.text(html::audit::campaign(&folder.plan, done, &parts))?;
    if missing > 0 {
        complain(&format!(
            "{} of {} not done",
            missing,
            count(shards as usize, "shard")
        ));
    }
    Ok(Outcome::of(parts.iter().all(|p| match p {
        PartSum::Report(report) => report.failed() == 0,
        hunts => hunts.passed(),
    })))
}

#[cfg(test)]
mod tests;
