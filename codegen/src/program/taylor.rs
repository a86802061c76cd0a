//! The program behind the Taylor coefficients of the motion.

use super::entries::EntryList;
use super::{Purpose, Shape};

impl EntryList<'_, '_> {
    /// The accelerations, and the partner of each sine and cosine that they
    /// have alone: the recurrence of either needs both.
    pub(super) fn taylor(&mut self) {
        let motion = self
            .entries
            .iter()
            .find(|entry| entry.purpose == Purpose::Accelerations);
        let Some(motion) = motion else {
            unreachable!("accelerations are always there");
        };
        let (arguments, accelerations) = (motion.arguments.clone(), motion.outputs.clone());
        let needed = self.lowering.builder.needed(&accelerations);
        let mut outputs = accelerations;
        for &id in &needed {
            if let Some(partner) = self.lowering.builder.partner(id)
                && !needed.contains(&partner)
            {
                outputs.push(partner);
            }
        }
        self.push(
            "taylor_coefficients",
            Purpose::TaylorCoefficients,
            &arguments,
            outputs,
            Shape::Vector,
        );
    }
}
