//! The entry points of the energy transfer into one difference.

use super::entries::EntryList;
use super::lower::Environment;
use super::{Argument, Cause, Purpose, Shape, ValueId};
use crate::mechanics::{Counting, Frame, MeanTree, TransferFormulas, TransferParts};
use crate::scene::{CoordinateKind, LinkId, Scene};

impl EntryList<'_, '_> {
    pub(super) fn transfer(
        &mut self,
        scene: &Scene,
        frame: &Frame,
        number: usize,
        transfer: &TransferFormulas,
    ) {
        use Argument::{Coordinates, Momenta, Rates};
        let mechanics = self.lowering.mechanics;
        let several = mechanics
            .coordinates
            .iter()
            .filter(|c| matches!(c.kind, CoordinateKind::Difference { .. }))
            .count()
            > 1;
        let place = if several {
            format!("_{}", mechanics.coordinates[transfer.coordinate].name)
        } else {
            String::new()
        };
        let mut phase = Environment::new(frame, Coordinates, None, Some(Momenta));
        let mut motion = Environment::new(frame, Coordinates, Some(Rates), None);
        let canonical = [Coordinates, Momenta];

        let energy = self.parts(&mut phase, &transfer.energy);
        let total = self.lowering.builder.add(energy[0], energy[1]);
        self.push(
            &format!("antiphase_energy{place}"),
            Purpose::SubHamiltonian(number),
            &canonical,
            vec![total],
            Shape::Scalar,
        );
        if let Some(parts) = &transfer.angle {
            let outputs = self.parts(&mut phase, parts);
            self.push(
                &format!("transfer_angle_1{place}"),
                Purpose::AngleTransfer(number),
                &canonical,
                outputs,
                Shape::Transfer,
            );
        }
        if let Some(parts) = &transfer.amplitude {
            let outputs = self.parts(&mut phase, parts);
            self.push(
                &format!("transfer_amplitude_2{place}"),
                Purpose::AmplitudeTransfer(number),
                &canonical,
                outputs,
                Shape::Transfer,
            );
        }
        for (index, truncated) in transfer.higher.iter().enumerate() {
            let counting = match truncated.counting {
                Counting::Angle => "angle",
                Counting::Amplitude => "amplitude",
            };
            let outputs = self.parts(&mut phase, &truncated.parts);
            self.push(
                &format!("transfer_{counting}_{}{place}", truncated.order),
                Purpose::HigherTransfer(number, index),
                &canonical,
                outputs,
                Shape::Transfer,
            );
        }
        if let Some(form) = &transfer.quadratic_form {
            let outputs = self.exprs(&mut phase, form);
            self.push(
                &format!("transfer_quadratic_form{place}"),
                Purpose::QuadraticForm(number),
                &canonical,
                outputs,
                Shape::Vector,
            );
        }
        if let Some(parts) = &transfer.exact {
            let outputs = self.parts(&mut phase, parts);
            self.push(
                &format!("transfer_exact{place}"),
                Purpose::ExactTransfer(number),
                &canonical,
                outputs,
                Shape::Transfer,
            );
            let outputs = self.parts(&mut motion, parts);
            self.push(
                &format!("transfer_exact_from_rates{place}"),
                Purpose::ExactTransferFromRates(number),
                &[Coordinates, Rates],
                outputs,
                Shape::Transfer,
            );
        }
        if let (Some(split), Some(mean_tree)) = (&transfer.split, &mechanics.mean_tree) {
            let split = (split, mean_tree);
            self.split(number, &place, &canonical, split, &mut phase);
            self.split(number, &place, &[Coordinates, Rates], split, &mut motion);
        }
        if !transfer.friction.is_zero() {
            let power = self.lowering.expr(&mut motion, &transfer.friction);
            self.push(
                &format!("antiphase_friction_power{place}"),
                Purpose::FrictionPower(number),
                &[Coordinates, Rates],
                vec![power],
                Shape::Scalar,
            );
        }
        if !transfer.drive.is_zero() {
            let power = self.lowering.expr(&mut motion, &transfer.drive);
            self.push(
                &format!("antiphase_drive_power{place}"),
                Purpose::AntiphaseDrivePower(number),
                &[Argument::Time, Coordinates, Rates],
                vec![power],
                Shape::Scalar,
            );
        }
        if scene.requests.forces {
            let velocity = self.lowering.expr(&mut motion, &transfer.velocity);
            let builder = &mut self.lowering.builder;
            let mut torque = builder.integer(0);
            for &(LinkId(link), weight) in &mechanics.coordinates[transfer.coordinate].weights {
                let (weight, own) = (
                    builder.integer(weight),
                    builder.input(Argument::Torques, link),
                );
                let part = builder.mul(weight, own);
                torque = builder.add(torque, part);
            }
            let power = builder.mul(velocity, torque);
            self.push(
                &format!("antiphase_outside_power{place}"),
                Purpose::AntiphaseOutsidePower(number),
                &[Coordinates, Rates, Argument::Torques],
                vec![power],
                Shape::Scalar,
            );
        }
    }

    /// W by what the mean tree does and what the mismatch of the copies adds.
    fn split(
        &mut self,
        number: usize,
        place: &str,
        arguments: &[Argument; 2],
        ([growth, forcing], mean_tree): (&[TransferParts; 2], &MeanTree),
        environment: &mut Environment<'_>,
    ) {
        let forcing = self.parts(environment, forcing);
        // At the same momenta the mean tree has other velocities.
        let mut mean = Environment::new(&mean_tree.frame, arguments[0], None, environment.momenta);
        if environment.momenta.is_none() {
            let added = self.lowering.added(environment, mean_tree);
            for (&symbol, added) in environment.frame.velocities.iter().zip(added) {
                let whole = self.lowering.symbol(environment, symbol);
                let own = self.lowering.builder.sub(whole, added);
                mean.supply(symbol, own);
            }
        }
        let growth = self.parts(&mut mean, growth);
        let source = match environment.momenta {
            Some(_) => "",
            None => "_from_rates",
        };
        for (cause, outputs) in [(Cause::MeanTree, growth), (Cause::Mismatch, forcing)] {
            self.push(
                &format!("transfer_{}{source}{place}", cause.name()),
                Purpose::SplitTransfer(number, cause),
                arguments,
                outputs,
                Shape::Transfer,
            );
        }
    }

    fn parts(&mut self, environment: &mut Environment<'_>, parts: &TransferParts) -> Vec<ValueId> {
        let kinetic = self.lowering.expr(environment, &parts.kinetic);
        let potential = self.lowering.expr(environment, &parts.potential);
        vec![kinetic, potential]
    }
}
