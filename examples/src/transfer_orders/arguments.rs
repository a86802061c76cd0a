//! The command line.

use clap::Parser;

use crate::program::Results;

/// How wrong is each form of the energy transfer W into each sector of a tree, at
/// which amplitude of its differences, and what does it cost? For the paper's
/// branched double pendulum and for two jointed arms on a body; another tree is one
/// more description in examples/src/transfer_orders/scenes.rs.
#[derive(Clone, Debug, Parser, PartialEq)]
#[command(name = "transfer-orders", version, verbatim_doc_comment)]
pub struct Arguments {
    /// random states for each amplitude, 10 to 1000000
    #[arg(long, value_name = "N", default_value = "20000", value_parser = read_states)]
    pub states: usize,
    /// seed of the random states
    #[arg(long, value_name = "SEED", default_value = "0")]
    pub seed: u64,
    /// Folder of results.
    #[command(flatten)]
    pub results: Results,
}

impl crate::program::Arguments for Arguments {
    const FOLDER: Option<&'static str> = Some("transfer-orders-output");

    fn results(&self) -> &Results {
        &self.results
    }
}

fn read_states(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(number @ 10..=1_000_000) => Ok(number),
        _ => Err("must be a whole number from 10 to 1000000".to_owned()),
    }
}
