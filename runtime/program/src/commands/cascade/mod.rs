//! A tree with a driven root and friction: does the energy go down the generations, and what
//! is there of it at each scale?
//!
//! - [`arguments`]: the command line, [`tree`]: the tree and its scales, [`motor`]: the torque,
//! - [`motion`]: all starts, in lanes, window by window, with checkpoints,
//! - [`density`]: how often a flux has which value,
//! - [`equilibrium`]: the same energy without motor and friction,
//! - [`findings`]: averages with errors, [`report`]: tables, [`charts`]: charts
//!   and a film,
//! - [`compare`]: several runs beside each other,
//! - [`onset`]: a tree, sector by sector, from a release almost in phase.

pub mod arguments;
pub mod charts;
pub mod compare;
pub mod density;
pub mod equilibrium;
pub mod findings;
pub mod motion;
pub mod motor;
pub mod onset;
pub mod report;
pub mod tree;

pub use arguments::Arguments;
pub use findings::{Balance, Findings};

use crate::Failure;
use crate::frame::{Checkpoint, Job, sweep};
use equilibrium::Equilibrium;
use motion::{Followed, film, follow};
use tree::DrivenTree;

/// Pictures of the film, and the time between two, s.
const FRAMES: usize = 160;
const INTERVAL: f64 = 0.05;

/// Follows all starts, or those of a shard, or reads those of all shards; then says what
/// they say together.
///
/// # Errors
/// [`Failure`].
pub fn run(arguments: &Arguments, job: &Job) -> Result<(), Failure> {
    if !arguments.compare.is_empty() {
        job.has_no_time_charts("--compare")?;
        return compare::run(&arguments.compare, job);
    }
    let subject = arguments.read()?;
    subject.record(job);
    if let Some(duration) = arguments.onset {
        let release = onset::Release {
            duration,
            torque: arguments.torque(&subject),
            frequency: arguments.frequency,
            ..onset::Release::new(arguments.start(&subject)?)
        };
        return onset::run(&release, &subject, job);
    }
    let driven = DrivenTree::new(subject)?;
    let count = arguments.starts as usize;
    let starts = sweep::results(job, arguments.sharding, count, |items| {
        follow(arguments, &driven, job, items)
    })?;
    if let Some(starts) = starts {
        write(arguments, &driven, &starts, job)?;
    }
    Checkpoint::new(job, 0.0).discard();
    Ok(())
}

/// Writes what all starts say together.
fn write(
    arguments: &Arguments,
    driven: &DrivenTree,
    starts: &[Followed],
    job: &Job,
) -> Result<(), Failure> {
    let findings = Findings::new(driven, starts);
    let equilibrium = match arguments.equilibrium {
        true => Some(Equilibrium::at(arguments, driven, findings.energy(), job)?),
        false => None,
    };
    let equilibrium = equilibrium.as_ref();
    report::write_windows(job, arguments, driven.generations(), starts)?;
    report::write_scales(job, driven, &findings, equilibrium)?;
    let mut text = report::report(arguments, driven, starts, &findings);
    if let Some(equilibrium) = equilibrium {
        text.push_str(&report::equilibrium(driven, &findings, equilibrium));
    }
    job.print(&text)?;
    job.write("report.md", text.as_bytes())?;
    // A tree that hangs still has nothing to show.
    if findings.course.iter().flatten().any(|energy| *energy > 0.0) {
        job.chart_over_time("course", &charts::course(arguments, &findings))?;
        if let Some(chart) = charts::scales(driven, &findings, equilibrium) {
            job.chart("scales", &chart)?;
        }
        job.chart("densities", &charts::densities(&findings))?;
    }
    if let Some(first) = starts.first() {
        let (states, interval) = film(arguments, driven, first, FRAMES, INTERVAL)?;
        let film = charts::film(driven, &states, interval)?;
        job.write("tree.svg", film.to_svg()?.as_bytes())?;
    }
    job.report("steady", findings.is_steady());
    job.report("balanced", findings.balance() == Balance::Closed);
    Ok(())
}
