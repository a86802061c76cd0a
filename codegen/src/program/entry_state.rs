//! Arguments of entry points as means and differences of copies.

use super::ValueId;
use super::lower::{Environment, Lowering};
use super::symmetric::{
    ConstantValues, Fields, LawValues, OrbitValues, Pose, SeriesArithmetic, SpringDamperValues,
    SymmetricMotion, SymmetricTree, TruncatedSeries,
};
use crate::functions::{Argument, Counting, EntryState};
use crate::mechanics::expression::Expr;
use crate::mechanics::{Mechanics, OrbitChord, OrbitCoupling, OrbitMechanics, PairElement};
use crate::scene::{FrictionLaw, LinkId, Scene};

/// Creates the arithmetic on means and differences, on series up to an order or on exact values.
pub(super) fn symmetric_tree<'b>(
    lowering: &'b mut Lowering<'_>,
    truncation: Option<usize>,
) -> SymmetricTree<'b> {
    SymmetricTree {
        orbits: lowering.orbits,
        series: SeriesArithmetic {
            builder: &mut lowering.builder,
            truncation,
        },
    }
}

/// Returns a constant as a series; zero is an empty series.
fn constant(lowering: &Lowering<'_>, value: ValueId) -> TruncatedSeries {
    match lowering.builder.is(value, 0) {
        true => TruncatedSeries::default(),
        false => TruncatedSeries::of_order(0, value),
    }
}

/// Returns the constants of a friction law as values of the program.
pub(super) fn law_values(lowering: &mut Lowering<'_>, law: &FrictionLaw<Expr>) -> LawValues {
    let frame = &lowering.mechanics.absolute;
    let mut environment = Environment::new(frame, Argument::Theta, Some(Argument::Omega), None);
    let law = lowering.law(&mut environment, law);
    law.map(|&value| constant(lowering, value))
}

/// Returns the constants of the sectors (sets of symmetric coordinates: all means, or one
/// difference between copies) as values of the program.
pub(super) fn values(lowering: &mut Lowering<'_>, sectors: &OrbitMechanics) -> ConstantValues {
    let mechanics = lowering.mechanics;
    let frame = &mechanics.absolute;
    let mut environment = Environment::new(frame, Argument::Theta, Some(Argument::Omega), None);
    let mut series = |expr: &Expr| {
        let value = lowering.expr(&mut environment, expr);
        constant(lowering, value)
    };
    let joints = &mechanics.articulation.joints;
    let orbits: Vec<OrbitValues> = sectors
        .orbits
        .iter()
        .zip(joints)
        .map(|(orbit, joint)| OrbitValues {
            mass: series(&orbit.mass),
            inertia: series(&orbit.inertia),
            com: orbit.com.each_ref().map(&mut series),
            pivot: joint.pivot.each_ref().map(&mut series),
            moment: series(&joint.inertia),
            gravity: series(&orbit.gravity),
            lateral_gravity: series(&orbit.lateral_gravity),
            drive: orbit.drive.each_ref().map(&mut series),
            passive: joint.passive.map(&mut series),
        })
        .collect();
    let couplings = sectors
        .couplings
        .iter()
        .map(|coupling| OrbitCoupling {
            row: coupling.row,
            column: coupling.column,
            cosine: series(&coupling.cosine),
            sine: series(&coupling.sine),
        })
        .collect();
    let chords = sectors.chords.iter().map(|chord| OrbitChord {
        group: chord.group,
        orbit: chord.orbit,
        weight: series(&chord.weight),
    });
    let chords = chords.collect();
    let pairs = &mechanics.articulation.pairs;
    let passive = |own: &PairElement| own.passive.map(&mut series);
    let spring_dampers = SpringDamperValues::of(
        pairs,
        &mechanics.coordinates,
        sectors.springs_couple,
        passive,
    );
    ConstantValues {
        orbits,
        couplings,
        chords,
        spring_dampers,
    }
}

/// Returns the external torques on the links.
pub(super) fn outside_torques(tree: &mut SymmetricTree<'_>, scene: &Scene) -> Fields {
    let orbits = scene.orbits.iter().enumerate();
    let fields = orbits.map(|(orbit, links)| {
        let input = |&LinkId(link): &LinkId| tree.series.builder.input(Argument::Torques, link);
        let links: Vec<ValueId> = links.links.iter().map(input).collect();
        tree.analysed(orbit, &links, "outside")
    });
    fields.collect()
}

/// Returns the state that an entry point receives, with momenta, velocities and forces.
pub(super) fn motion(
    tree: &mut SymmetricTree<'_>,
    scene: &Scene,
    mechanics: &Mechanics,
    values: &ConstantValues,
    state: EntryState,
) -> SymmetricMotion {
    let [positions, motions] = state.arguments();
    let angles = received(tree, scene, mechanics, state, positions);
    let pose: Pose = tree.pose(values, angles);
    let received = received(tree, scene, mechanics, state, motions);
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

/// Returns an argument of an entry point as means and differences.
fn received(
    tree: &mut SymmetricTree<'_>,
    scene: &Scene,
    mechanics: &Mechanics,
    state: EntryState,
    argument: Argument,
) -> Fields {
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
                tree.analysed(orbit, &links, argument.name())
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
}
