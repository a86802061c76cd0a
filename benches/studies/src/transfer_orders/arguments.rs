//! The command line.

use clap::Parser;

/// How wrong is each form of the energy transfer W into each sector of a tree, at
/// which amplitude of its differences, and what does it cost? For the paper's
/// branched double pendulum and for two jointed arms on a body; another tree is one
/// more description in benches/studies/src/transfer_orders/scenes.rs.
#[derive(Clone, Debug, Parser, PartialEq)]
#[command(name = "transfer-orders", version, verbatim_doc_comment)]
pub struct Arguments {
    /// random states for each amplitude, 10 to 1000000
    #[arg(long, value_name = "N", default_value = "20000", value_parser = clap::value_parser!(u32).range(10..=1_000_000))]
    pub states: u32,
    /// seed of the random states
    #[arg(long, value_name = "SEED", default_value = "0")]
    pub seed: u64,
}

impl branched_pendulum_frame::Arguments for Arguments {
    const FOLDER: Option<&'static str> = Some("transfer-orders-output");
}
