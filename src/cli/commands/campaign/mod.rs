//! Campaigns: plan, run, status, merge, report.

mod folder;
mod hard;
mod run;

use self::folder::{Folder, State};
use crate::cli::args::{
    CampaignArgs, CampaignReportArgs, CampaignStep, MergeArgs, PlanArgs, StatusArgs, TextOrJson,
};
use crate::cli::complain;
use crate::cli::failure::{Failure, Outcome};
use crate::cli::files::output::{Output, print_json, write_json, write_to};
use crate::cli::files::source;
use mechaudit::audit::Method;
use mechaudit::campaign::{PartSum, Plan, Sum, document};
use mechaudit::report::html;
use mechaudit::report::words::numbers::count;
use serde_json::json;
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
    write_to(None, |out| {
        let shards = count(shards as usize, "shard");
        Ok(writeln!(
            out,
            "{name}: {parts}, {work} judgements in {shards}."
        )?)
    })?;
    Ok(Outcome::AsExpected)
}

fn status(args: &StatusArgs) -> Result<Outcome, Failure> {
    let folder = Folder::open(&args.folder)?;
    let (mut done, mut work, mut seconds) = (0, 0, 0.0);
    let (mut missing, mut bad, mut refused) = (Vec::new(), Vec::new(), Vec::new());
    for (k, state) in folder.states()?.into_iter().enumerate() {
        let k = k as u64;
        match state {
            State::Done(header) => {
                done += 1;
                work += folder.deal.work_of(k);
                seconds += header.seconds * header.threads as f64;
            }
            State::Missing => missing.push(k),
            State::Bad(why) => {
                missing.push(k);
                bad.push((k, why));
            }
            State::Refused(why) => refused.push((k, why)),
        }
    }
    let (shards, total) = (folder.deal.shards(), folder.deal.work());
    // Of threads that had a core each.
    let rate = if seconds > 0.0 {
        work as f64 / seconds
    } else {
        0.0
    };
    let named = |all: &[(u64, String)]| -> Vec<(String, String)> {
        let file = |k: u64| folder.file(k).display().to_string();
        all.iter().map(|(k, why)| (file(*k), why.clone())).collect()
    };
    if args.missing {
        write_to(None, |out| {
            missing.iter().try_for_each(|k| writeln!(out, "{k}"))?;
            Ok(())
        })?;
    } else if args.format == TextOrJson::Json {
        let files = |all: &[(u64, String)]| -> Vec<serde_json::Value> {
            let all = all.iter();
            all.map(|(k, why)| json!({ "shard": k, "why": why }))
                .collect()
        };
        print_json(&json!({
            "schema_version": 1,
            "name": folder.plan.name,
            "shards": shards,
            "done": done,
            "missing": missing,
            "bad": files(&bad),
            "refused": files(&refused),
            "judgements": total,
            "judged": work,
            "thread_seconds": seconds,
        }))?;
    } else {
        write_to(None, |out| {
            let (name, share) = (&folder.plan.name, 100.0 * work as f64 / total.max(1) as f64);
            writeln!(
                out,
                "{name}: {done} of {} done, {share:.1} % of {total} judgements.",
                count(shards as usize, "shard")
            )?;
            if done > 0 {
                let left = match total - work {
                    0 => ".".into(),
                    n => format!("; {} on one thread for the others.", time(n as f64 / rate)),
                };
                writeln!(out, "{rate:.0} a second and thread{left}")?;
            }
            for (file, why) in named(&bad) {
                writeln!(out, "{file}: {why}")?;
            }
            Ok(())
        })?;
    }
    if let Some((file, why)) = named(&refused).first() {
        return Err(Failure::new(format!("{file}: {why}")));
    }
    Ok(Outcome::of(done == shards))
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
    write_json(output, &document(&folder.plan, &folder.identity, &parts))?;
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
    output.text(&html::audit::campaign(&folder.plan, done, &parts))?;
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
mod tests {
    use super::time;

    #[test]
    fn times_in_words() {
        for (seconds, due) in [
            (0.4, "0 s"),
            (119.0, "119 s"),
            (120.0, "2 min"),
            (7199.0, "120 min"),
            (7200.0, "2.0 h"),
            (90_000.0, "25.0 h"),
        ] {
            assert_eq!(time(seconds), due);
        }
    }
}
