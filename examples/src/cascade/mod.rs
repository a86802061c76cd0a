//! A tree of rods on a driven root, friction in the youngest: does the energy go down the
//! generations, and what is there of it at each scale?
//!
//! - [`arguments`]: the command line, [`scene`]: the trees, [`motor`]: the torque,
//! - [`motion`]: all starts, in lanes, window by window, with checkpoints,
//! - [`density`]: how often a flux has which value,
//! - [`findings`]: averages with errors, [`report`]: tables, [`charts`]: charts
//!   and a film,
//! - [`onset`]: a small tree, sector by sector, from a release almost in phase.

pub mod arguments;
pub mod charts;
pub mod density;
pub mod findings;
pub mod motion;
pub mod motor;
pub mod onset;
pub mod report;
pub mod scene;

pub use arguments::Arguments;
pub use findings::{Balance, Findings};

use branched_pendulum_program::Failure;
use branched_pendulum_program::frame::{Checkpoint, Job, sweep};
use motion::{film, follow};
use scene::of_shape;

/// Pictures of the film, and the time between two, s.
const FRAMES: usize = 160;
const INTERVAL: f64 = 0.05;

/// Follows all starts, or those of a shard, or reads those of all shards; then says what
/// they say together.
///
/// # Errors
/// [`Failure`].
pub fn run(arguments: &Arguments, job: &Job) -> Result<(), Failure> {
    if let Some(duration) = arguments.onset {
        let release = onset::Release {
            duration,
            torque: arguments.torque,
            frequency: arguments.frequency,
            ..onset::Release::default()
        };
        return onset::run(&release, job);
    }
    let shape = arguments.shape();
    let starts = sweep::results(
        job,
        arguments.sharding,
        arguments.starts as usize,
        |items| of_shape!(shape, follow(arguments, job, items)),
    )?;
    if let Some(starts) = starts {
        let findings = Findings::new(&shape, &starts);
        report::write_windows(job, arguments, &starts)?;
        report::write_scales(job, arguments, &findings)?;
        let text = report::report(arguments, &starts, &findings);
        job.print(&text)?;
        job.write("report.md", text.as_bytes())?;
        // A tree that hangs still has nothing to show.
        if findings.course.iter().flatten().any(|energy| *energy > 0.0) {
            job.chart("course", &charts::course(arguments, &findings))?;
            if let Some(chart) = charts::scales(arguments, &findings) {
                job.chart("scales", &chart)?;
            }
            job.chart("densities", &charts::densities(&findings))?;
        }
        if let Some(first) = starts.first() {
            let (states, interval) = of_shape!(shape, film(arguments, first, FRAMES, INTERVAL))?;
            let film = charts::film(&shape, &states, interval)?;
            job.write("tree.svg", film.to_svg()?.as_bytes())?;
        }
        job.report("steady", findings.is_steady());
        job.report("balanced", findings.balance() == Balance::Closed);
    }
    Checkpoint::new(job, 0.0).discard();
    Ok(())
}
