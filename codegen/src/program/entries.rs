//! Entry points for the requested outputs.

use super::entry_list::EntryList;
use super::lower::{Environment, Lowering};
use super::{Entry, LoopTree, Operations, SolveChoice, ValueId};
use crate::functions::{Argument, Purpose};
use crate::mechanics::{Frame, MatrixEntry, Mechanics};
use crate::scene::{LinkId, Scene, Solve};

/// Entry points, the chosen method of solving for the accelerations, and the constants of a tree in
/// loops.
type Lowered = (Vec<Entry>, SolveChoice, Option<LoopTree>);

/// Creates the entry points of a tree in loops, which contain the articulated recursion for one
/// link.
pub(super) fn link_entries(scene: &Scene, lowering: &mut Lowering<'_>) -> Lowered {
    let mechanics = lowering.mechanics;
    let mut list = EntryList::new(scene, lowering);
    let strips = list.link_functions(scene, mechanics);
    let choice = SolveChoice {
        solve: Solve::Recursion,
        factorization: None,
        recursion: Operations::default(),
    };
    (list.entries, choice, Some(strips))
}

pub(super) fn entries(scene: &Scene, lowering: &mut Lowering<'_>) -> Lowered {
    let mechanics = lowering.mechanics;
    let mut list = EntryList::new(scene, lowering);
    let choice = list.absolute(scene, mechanics);
    if let Some(symmetric) = &mechanics.symmetric {
        list.transforms(scene, mechanics);
        match &mechanics.sectors {
            // In this case only the names of the frame are derived.
            Some(sectors) if symmetric.mass.is_empty() => {
                list.symmetric_of_nested(scene, sectors);
            }
            _ => list.symmetric(symmetric),
        }
        for (number, transfer) in mechanics.transfers.iter().enumerate() {
            list.transfer(scene, symmetric, number, transfer);
        }
    }
    if let (Some(sectors), Some(request)) = (&mechanics.sectors, &scene.requests.budget) {
        list.budgets(scene, sectors, request);
    }
    list.observables(scene, mechanics);
    if let Some(transverse) = &mechanics.transverse {
        list.transverse(mechanics, transverse);
        if let Some(small) = &transverse.small {
            list.small(scene, mechanics, transverse, small);
        }
    }
    if let Some(normal_form) = &mechanics.normal_form {
        list.normal_form(mechanics, normal_form);
    }
    if let Some(positions) = &mechanics.positions {
        list.positions(scene, mechanics, positions);
    }
    if scene.requests.taylor {
        list.taylor(scene, mechanics);
    }
    list.pullbacks(scene);
    (list.entries, choice, None)
}

impl EntryList<'_, '_> {
    fn absolute(&mut self, scene: &Scene, mechanics: &Mechanics) -> SolveChoice {
        use Argument::{AbsoluteMomenta, Alpha, Omega, Theta};
        let frame = &mechanics.absolute;
        let mut motion = Environment::new(frame, Theta, Some(Omega), None);
        let (alpha, choice) = self.lowering.accelerations(scene, &mut motion);
        self.push(Purpose::Accelerations, alpha);
        if scene.requests.forces {
            let mut pushed = motion.clone();
            let lowering = &mut self.lowering;
            let alpha = lowering.accelerations_under(scene, &mut pushed, choice.solve);
            self.push(Purpose::AccelerationsUnder, alpha);
            for number in 0..scene.prescribed.len() {
                let mut prescribed = motion.clone();
                let moved = (self.lowering).accelerations_prescribed(
                    scene,
                    &mut prescribed,
                    choice.solve,
                    number,
                );
                let mut outputs = moved.accelerations;
                outputs.extend(moved.reactions);
                self.push(Purpose::Prescribed(number), outputs);
            }
        }
        if scene.requests.inverse_dynamics {
            let links = 0..scene.links.len();
            let given = links.map(|link| (link, self.lowering.builder.input(Alpha, link)));
            let (given, mut moved) = (given.collect(), motion.clone());
            let moved = (self.lowering).around(scene, &mut moved, choice.solve, &given);
            self.push(Purpose::InverseDynamics, moved.reactions);
        }
        if let Some(energies) = &frame.energies {
            let kinetic = self.lowering.expr(&mut motion, &energies.kinetic);
            let potential = self.lowering.expr(&mut motion, &energies.potential);
            self.push(Purpose::KineticEnergy, vec![kinetic]);
            self.push(Purpose::PotentialEnergy, vec![potential]);
        }
        self.powers(scene, mechanics, &mut motion);
        if let Some(momentum) = &frame.momentum {
            let momenta = self.exprs(&mut motion, momentum);
            self.push(Purpose::AbsoluteMomenta, momenta);
            let mut phase = Environment::new(frame, Theta, None, Some(AbsoluteMomenta));
            let velocities: Vec<ValueId> = frame
                .velocities
                .iter()
                .map(|&v| self.lowering.symbol(&mut phase, v))
                .collect();
            self.push(Purpose::AbsoluteVelocities, velocities.clone());
            if let Some(rates) = &frame.momentum_rates {
                let mut outputs = velocities;
                outputs.extend(self.exprs(&mut phase, rates));
                self.push(Purpose::CanonicalRates, outputs);
            }
        }
        if let Some(stiffness) = &frame.stiffness {
            let size = frame.coordinates.len();
            for (purpose, entries) in [
                (Purpose::MassMatrix, &frame.mass),
                (Purpose::StiffnessMatrix, stiffness),
            ] {
                let dense = self.dense(&mut motion, entries, size);
                self.push(purpose, dense);
            }
        }
        choice
    }

    fn dense(
        &mut self,
        environment: &mut Environment<'_>,
        entries: &[MatrixEntry],
        size: usize,
    ) -> Vec<ValueId> {
        let sparse = self.lowering.matrix(environment, entries);
        let zero = self.lowering.builder.integer(0);
        let mut dense = Vec::with_capacity(size * size);
        for row in 0..size {
            for column in 0..size {
                let key = (row.max(column), row.min(column));
                dense.push(sparse.get(&key).copied().unwrap_or(zero));
            }
        }
        dense
    }

    /// Adds the transforms θ = J q and q = (JᵀJ)⁻¹ Jᵀ θ, where JᵀJ is diagonal.
    fn transforms(&mut self, scene: &Scene, mechanics: &Mechanics) {
        let builder = &mut self.lowering.builder;
        let mut forward = Vec::new();
        for coordinate in &mechanics.coordinates {
            let mut sum = builder.integer(0);
            for &(LinkId(link), weight) in &coordinate.weights {
                let angle = builder.input(Argument::Absolute, link);
                let weight = builder.integer(weight);
                let term = builder.mul(weight, angle);
                sum = builder.add(sum, term);
            }
            let norm = builder.integer(coordinate.norm());
            let one = builder.integer(1);
            let inverse = builder.div(one, norm);
            forward.push(builder.mul(inverse, sum));
        }
        let mut backward = vec![builder.integer(0); scene.links.len()];
        for (index, coordinate) in mechanics.coordinates.iter().enumerate() {
            let value = builder.input(Argument::Symmetric, index);
            for &(LinkId(link), weight) in &coordinate.weights {
                let weight = builder.integer(weight);
                let term = builder.mul(weight, value);
                backward[link] = builder.add(backward[link], term);
            }
        }
        self.push(Purpose::ToSymmetric, forward);
        self.push(Purpose::FromSymmetric, backward);
    }

    fn symmetric(&mut self, frame: &Frame) {
        use Argument::{Coordinates, Momenta, Rates};
        let mut motion = Environment::new(frame, Coordinates, Some(Rates), None);
        let accelerations = self.lowering.factorization(&mut motion);
        self.push(Purpose::SymmetricAccelerations, accelerations);
        if let Some(momentum) = &frame.momentum {
            let momenta = self.exprs(&mut motion, momentum);
            self.push(Purpose::SymmetricMomenta, momenta);
            let mut phase = Environment::new(frame, Coordinates, None, Some(Momenta));
            let velocities: Vec<ValueId> = frame
                .velocities
                .iter()
                .map(|&v| self.lowering.symbol(&mut phase, v))
                .collect();
            if let Some(energies) = &frame.energies {
                // H = ½ pᵀ q̇ + U
                let builder = &mut self.lowering.builder;
                let mut twice_kinetic = builder.integer(0);
                for (index, &velocity) in velocities.iter().enumerate() {
                    let momentum = builder.input(Momenta, index);
                    let product = builder.mul(momentum, velocity);
                    twice_kinetic = builder.add(twice_kinetic, product);
                }
                let two = builder.integer(2);
                let kinetic = builder.div(twice_kinetic, two);
                let potential = self.lowering.expr(&mut phase, &energies.potential);
                let total = self.lowering.builder.add(kinetic, potential);
                self.push(Purpose::Hamiltonian, vec![total]);
            }
            self.push(Purpose::SymmetricVelocities, velocities);
        }
    }
}
