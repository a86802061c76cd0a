//! The program `accuracy-cost`: accuracy against cost of compiled models in all their forms.
//!
//! [`branched_pendulum_advice`] measures; these modules add scenes in forms that a tree at run time
//! does not have. `branched-pendulum advise` answers a single question about a tree.
//!
//! - [`scenes`]: the trees, in all their forms,
//! - [`requests`]: a scene for the advisor,
//! - [`chart`]: accuracy against cost,
//! - [`audit`]: the choices of twelve questions compared with all other candidates.

pub mod audit;
pub mod chart;
pub mod requests;
pub mod scenes;

use branched_pendulum_frame::{Failure, Job};
use clap::Parser;

/// Which model, method, tolerance or step and number type is the cheapest that is accurate enough?
/// Draws accuracy against cost of all models of three scenes with all methods, and the advisor's
/// choices. For your own tree, use `branched-pendulum advise`.
#[derive(Clone, Debug, Parser, PartialEq)]
#[command(name = "accuracy-cost", version, verbatim_doc_comment)]
pub struct Arguments {
    /// answers twelve questions instead, and measures cheaper alternatives
    #[arg(long)]
    audit: bool,
}

impl branched_pendulum_frame::Arguments for Arguments {
    const FOLDER: Option<&'static str> = Some("accuracy-cost-output");
}

/// Draws the chart, or audits the advisor.
///
/// # Errors
/// [`Failure`].
pub fn run(arguments: &Arguments, job: &Job) -> Result<(), Failure> {
    match arguments.audit {
        true => audit::run(job),
        false => chart::draw(job),
    }
}
