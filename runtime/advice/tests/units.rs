//! Modules of the advisor whose unit tests need private items, compiled here with the part of the
//! advisor that they use: in the library, every test would wait for all methods to be compiled
//! once more.

#![allow(dead_code, unreachable_pub)]

#[path = "../src/candidate.rs"]
mod candidate;
#[path = "../src/choice.rs"]
mod choice;
#[path = "../src/extrapolation.rs"]
mod extrapolation;
#[path = "../src/frames.rs"]
mod frames;
#[path = "../src/search.rs"]
mod search;
#[path = "../src/work_precision.rs"]
mod work_precision;

use branched_pendulum_advice::{Criterion, Worst};
use candidate::SettingRange;

mod comparison {
    pub(crate) use branched_pendulum_advice::Worst;
}

mod error {
    pub(crate) use branched_pendulum_advice::AdviceError;
}

#[cfg(feature = "trees")]
mod outputs {
    use branched_pendulum_advice::TreeOutput;

    #[test]
    fn names_of_outputs_are_read_back() {
        for &output in TreeOutput::ALL {
            assert_eq!(output.to_string().parse(), Ok(output));
        }
        let refused = "angle".parse::<TreeOutput>().unwrap_err().to_string();
        assert_eq!(
            refused,
            "there is no output `angle` (outputs: angles, energy, pixels, transfer)"
        );
    }
}
