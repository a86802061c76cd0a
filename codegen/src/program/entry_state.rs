//! States in means and differences, as entry points receive them.

use super::lower::{Environment, Lowering};
use super::symmetric::{
    ConstantValues, CouplingValues, Fields, LawValues, OrbitLinks, OrbitValues, Pose,
    SeriesArithmetic, SymmetricMotion, SymmetricTree, TruncatedSeries,
};
use super::{Argument, ValueId};
use crate::mechanics::expression::Expr;
use crate::mechanics::{Counting, LawConstants, Mechanics, OrbitMechanics};
use crate::scene::{LinkId, Scene};

/// Form of the state that an entry point receives.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum EntryState {
    /// Absolute angles and angular velocities.
    Absolute,
    /// Symmetric coordinates and their velocities.
    Rates,
    /// Symmetric coordinates and their momenta; where differences are small,
    /// the momenta are or are not.
    Momenta(Counting),
}

/// Without a truncation nothing is counted.
pub(super) const CANONICAL: EntryState = EntryState::Momenta(Counting::Amplitude);

pub(super) fn symmetric_tree<'b>(
    lowering: &'b mut Lowering<'_>,
    orbits: &'b [OrbitLinks],
    truncation: Option<usize>,
) -> SymmetricTree<'b> {
    let builder = &mut lowering.builder;
    SymmetricTree {
        series: SeriesArithmetic {
            builder,
            truncation,
        },
        orbits,
    }
}

/// The constants of a law of friction as values of the program.
pub(super) fn law_values(lowering: &mut Lowering<'_>, law: &LawConstants) -> LawValues {
    let frame = &lowering.mechanics.absolute;
    let mut environment = Environment::new(frame, Argument::Theta, Some(Argument::Omega), None);
    let law = lowering.law(&mut environment, law);
    let [coulomb, quadratic, width] =
        [law.coulomb, law.quadratic, law.width].map(|value| match lowering.builder.is(value, 0) {
            true => TruncatedSeries::default(),
            false => TruncatedSeries::of_order(0, value),
        });
    LawValues {
        coulomb,
        quadratic,
        width,
    }
}

/// The constants as values of the program.
pub(super) fn values(lowering: &mut Lowering<'_>, sectors: &OrbitMechanics) -> ConstantValues {
    let mut environment = Environment::new(
        &lowering.mechanics.absolute,
        Argument::Theta,
        Some(Argument::Omega),
        None,
    );
    let mut series = |expr: &Expr| {
        let value = lowering.expr(&mut environment, expr);
        if lowering.builder.is(value, 0) {
            TruncatedSeries::default()
        } else {
            TruncatedSeries::of_order(0, value)
        }
    };
    let mut orbits: Vec<OrbitValues> = sectors
        .orbits
        .iter()
        .map(|orbit| OrbitValues {
            mass: series(&orbit.mass),
            inertia: series(&orbit.inertia),
            com: [series(&orbit.com[0]), series(&orbit.com[1])],
            pivot: [series(&orbit.pivot[0]), series(&orbit.pivot[1])],
            moment: series(&orbit.moment),
            gravity: series(&orbit.gravity),
            lateral_gravity: series(&orbit.lateral_gravity),
            spring: series(&orbit.spring),
            rest: series(&orbit.rest),
            friction: series(&orbit.friction),
            drag: series(&orbit.drag),
            drive: [0, 1, 2].map(|part| series(&orbit.drive[part])),
            laws: [LawValues::default(), LawValues::default()],
        })
        .collect();
    let couplings = sectors
        .couplings
        .iter()
        .map(|coupling| CouplingValues {
            row: coupling.row,
            column: coupling.column,
            cosine: series(&coupling.cosine),
            sine: series(&coupling.sine),
        })
        .collect();
    for (values, orbit) in orbits.iter_mut().zip(&sectors.orbits) {
        values.laws = orbit.laws.each_ref().map(|law| law_values(lowering, law));
    }
    ConstantValues { orbits, couplings }
}

/// Torques from outside on the links.
pub(super) fn outside_torques(tree: &mut SymmetricTree<'_>, scene: &Scene) -> Fields {
    let orbits = scene.orbits.iter().enumerate();
    let fields = orbits.map(|(orbit, links)| {
        let input = |&LinkId(link): &LinkId| tree.series.builder.input(Argument::Torques, link);
        let links: Vec<ValueId> = links.links.iter().map(input).collect();
        tree.analysed(orbit, &links, "outside")
    });
    fields.collect()
}

/// The state that an entry point receives, with momenta, velocities and forces.
pub(super) fn motion(
    tree: &mut SymmetricTree<'_>,
    scene: &Scene,
    mechanics: &Mechanics,
    values: &ConstantValues,
    state: EntryState,
) -> SymmetricMotion {
    let received = |tree: &mut SymmetricTree<'_>, argument| -> Fields {
        let whole = argument == Argument::Momenta && state == EntryState::Momenta(Counting::Angle);
        let budget = scene.requests.budget.as_ref();
        let chosen = budget.map_or(&[][..], |budget| budget.small.as_slice());
        let is_small = |id: &(usize, usize)| !whole && (chosen.is_empty() || chosen.contains(id));
        match state {
            EntryState::Absolute => scene
                .orbits
                .iter()
                .enumerate()
                .map(|(orbit, links)| {
                    let links: Vec<ValueId> = links
                        .links
                        .iter()
                        .map(|&LinkId(link)| tree.series.builder.input(argument, link))
                        .collect();
                    tree.analysed(orbit, &links, argument.letter())
                })
                .collect(),
            EntryState::Rates | EntryState::Momenta(_) => {
                let mut fields = tree.zeros();
                for (index, coordinate) in mechanics.coordinates.iter().enumerate() {
                    let value = tree.series.builder.input(argument, index);
                    let (orbit, sector) = coordinate.kind.orbit_and_difference();
                    let field = &mut fields[orbit];
                    let value = match sector {
                        Some(id) if is_small(&id) => tree.series.small(value),
                        _ => tree.series.value(value),
                    };
                    field.set(sector, value);
                }
                fields
            }
        }
    };
    let [positions, motions] = match state {
        EntryState::Absolute => [Argument::Theta, Argument::Omega],
        EntryState::Rates => [Argument::Coordinates, Argument::Rates],
        EntryState::Momenta(_) => [Argument::Coordinates, Argument::Momenta],
    };
    let angles = received(tree, positions);
    let pose: Pose = tree.pose(values, angles);
    let received = received(tree, motions);
    let (rates, momenta) = if let EntryState::Momenta(_) = state {
        let momenta = tree.per_link(&received);
        let factors = tree.factors(values, &pose);
        (tree.solve(&factors, &momenta), momenta)
    } else {
        let momenta = tree.momenta(values, &pose, &received);
        (received, momenta)
    };
    for (rate, momentum) in rates.iter().zip(&momenta) {
        tree.named(rate, "omega");
        tree.named(momentum, "momentum");
    }
    let forces = tree.other_forces(values, &pose, &rates);
    SymmetricMotion {
        pose,
        rates,
        momenta,
        forces,
    }
}
