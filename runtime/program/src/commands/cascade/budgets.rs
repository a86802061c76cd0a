//! Budgets of states by scale, and sums of them over windows.

use branched_pendulum::ScaleBudget;
use branched_pendulum::sectors::PowerKind;
use branched_pendulum::system::{Model, Workspace};
use branched_pendulum_trees::PendulumTree;

use super::arguments::Arguments;
use super::density::Density;
use super::motor::Motor;
use super::structure::AmplitudeSums;
use super::tree::DrivenTree;

/// Quantities of each scale whose means over a window are kept.
pub const QUANTITIES: usize = 4;

/// Budgets of states of a tree, in memory that is kept.
pub(super) struct StateBudgets<'a> {
    tree: &'a PendulumTree,
    noise: Option<f64>,
    workspace: Workspace<f64>,
    torques: Vec<f64>,
    budget: ScaleBudget<f64>,
    /// Energies of the velocities that a unit of the root's momentum gives.
    response: ScaleBudget<f64>,
    rates: Vec<f64>,
}

impl<'a> StateBudgets<'a> {
    pub(super) fn new(arguments: &Arguments, driven: &'a DrivenTree) -> Self {
        Self {
            tree: &driven.subject.tree,
            noise: arguments.noise,
            workspace: Workspace::new(),
            torques: vec![0.0; driven.links()],
            budget: ScaleBudget::new(),
            response: ScaleBudget::new(),
            rates: vec![0.0; driven.links()],
        }
    }

    /// The budget of a state under its motor, or under noise, whose mean power on scale s is
    /// ½ D wᵀ K_s w with w = M⁻¹ e, e a unit of the root's momentum; the sum is ½ D (M⁻¹)₁₁.
    pub(super) fn at(&mut self, time: f64, state: &[f64], motor: &Motor) -> &ScaleBudget<f64> {
        let (theta, omega) = state.split_at(self.tree.links());
        self.torques[0] = motor.torque(time);
        let given = [theta, omega, &self.torques];
        self.tree
            .budget_by_scale_into(&mut self.workspace, time, given, &mut self.budget);
        if let Some(noise) = self.noise {
            self.respond(theta);
            self.add_response(theta, noise);
            // Potential energies, which are no input.
            self.rates.fill(0.0);
            self.add_response(theta, -noise);
        }
        &self.budget
    }

    /// Adds `factor` times the energies of the velocities in `rates` as powers from outside.
    fn add_response(&mut self, theta: &[f64], factor: f64) {
        let Self {
            tree,
            workspace,
            budget,
            response,
            rates,
            ..
        } = self;
        tree.energies_by_scale_into(workspace, theta, rates, response);
        for scale in 0..budget.scales() {
            let power = factor * response.energy(scale);
            budget.add_power(PowerKind::Outside, scale, power);
        }
    }

    /// Computes the velocities that a unit of the root's momentum gives.
    fn respond(&mut self, theta: &[f64]) {
        self.torques.fill(0.0);
        self.torques[0] = 1.0;
        self.tree
            .solve_mass(&mut self.workspace, theta, &self.torques, &mut self.rates);
        self.torques[0] = 0.0;
    }

    /// Gives the root this momentum, kg m²/s.
    pub(super) fn kick(&mut self, state: &mut [f64], momentum: f64) {
        let (theta, omega) = state.split_at_mut(self.tree.links());
        self.respond(theta);
        for (rate, own) in omega.iter_mut().zip(&self.rates) {
            *rate += momentum * own;
        }
    }
}

/// Sums over one window of one start.
#[derive(Clone)]
pub(super) struct WindowSums {
    sums: Vec<[f64; QUANTITIES]>,
    samples: f64,
    pub(super) densities: Vec<Density>,
    pub(super) amplitudes: Vec<AmplitudeSums>,
}

impl WindowSums {
    pub(super) fn new(scales: usize) -> Self {
        Self {
            sums: vec![[0.0; QUANTITIES]; scales],
            samples: 0.0,
            densities: vec![Density::default(); scales - 1],
            amplitudes: vec![AmplitudeSums::default(); scales],
        }
    }

    pub(super) fn add(&mut self, budget: &ScaleBudget<f64>, counts: bool) {
        self.samples += 1.0;
        for (scale, sums) in self.sums.iter_mut().enumerate() {
            let values = [
                budget.energy(scale),
                budget.received(scale),
                budget.friction_power(scale) + budget.drag_power(scale),
                budget.drive_power(scale) + budget.outside_power(scale),
            ];
            for (sum, value) in sums.iter_mut().zip(values) {
                *sum += value;
            }
        }
        if counts {
            for (scale, density) in (1..).zip(&mut self.densities) {
                density.count(budget.flux(scale));
            }
            for (scale, sums) in self.amplitudes.iter_mut().enumerate() {
                sums.count(budget, scale);
            }
        }
    }

    pub(super) fn means(&self) -> impl Iterator<Item = f64> {
        self.sums.iter().flatten().map(|sum| sum / self.samples)
    }
}

#[cfg(test)]
mod tests {
    use branched_pendulum::ScaleBudget;
    use branched_pendulum::system::Workspace;

    use super::StateBudgets;
    use crate::commands::cascade::Arguments;
    use crate::commands::cascade::motor::{Motor, Random};
    use crate::commands::cascade::tree::DrivenTree;
    use crate::frame::command_line::parse_line;

    /// Kicks of both signs give each scale on average the power that its budget states, and all
    /// scales together half the intensity times the first entry of the inverse mass matrix.
    #[test]
    fn kicks_have_the_mean_input_that_the_budget_states() {
        for line in ["--generations 4", "--generations 6 --open 1"] {
            let arguments: Arguments = parse_line(&format!("{line} --noise 0.3")).unwrap();
            let driven = DrivenTree::new(arguments.read().unwrap()).unwrap();
            let (tree, links) = (&driven.subject.tree, driven.links());
            let state: Vec<f64> = (0..2 * links).map(|own| (1.7 * own as f64).sin()).collect();
            let motor = Motor::new(&arguments, 0.0, &mut Random::of_start(1, 0));
            let mut budgets = StateBudgets::new(&arguments, &driven);
            let stated = budgets.at(0.0, &state, &motor).clone();
            let kick = 1e-3_f64;
            let mut kicked = |kick: f64| {
                let mut moved = state.clone();
                budgets.kick(&mut moved, kick);
                let mut energies = ScaleBudget::new();
                let (theta, omega) = moved.split_at(links);
                tree.energies_by_scale_into(&mut Workspace::new(), theta, omega, &mut energies);
                energies
            };
            let energies = [kick, -kick, 0.0].map(&mut kicked);
            let mut sum = 0.0;
            for scale in 0..driven.generations() {
                let [up, down, still] = energies.each_ref().map(|own| own.energy(scale));
                let gain = 0.5 * (up + down) - still;
                let wanted = stated.outside_power(scale) * kick * kick / 0.3;
                assert!(
                    (gain - wanted).abs() < 1e-13,
                    "{line}, {scale}: {gain} {wanted}"
                );
                sum += stated.outside_power(scale);
            }
            // The first entry of the inverse, by elimination from the youngest link up.
            let mut mass = tree.mass_matrix(&state[..links]);
            for pivot in (1..links).rev() {
                let own = mass[pivot].clone();
                for row in mass.iter_mut().take(pivot) {
                    let factor = row[pivot] / own[pivot];
                    row.iter_mut().zip(&own).for_each(|(a, b)| *a -= factor * b);
                }
            }
            let wanted = 0.5 * 0.3 / mass[0][0];
            assert!(
                (sum - wanted).abs() < 1e-10 * wanted,
                "{line}: {sum} {wanted}"
            );
        }
    }
}
