//! States as entry points are handed them, in means and differences.

use super::copies::{
    Copies, CouplingValues, Fields, Graded, Motion, Orbit, OrbitValues, Pose, Series, Values,
};
use super::lower::{Door, Lowering};
use super::{Argument, ValueId};
use crate::mechanics::expression::Expr;
use crate::mechanics::{Counting, Mechanics, Sectors};
use crate::scene::{LinkId, Scene};

/// How a state is handed over.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum State {
    /// Absolute angles and angular velocities.
    Absolute,
    /// Symmetric coordinates and their velocities.
    Rates,
    /// Symmetric coordinates and their momenta; where differences are small,
    /// the momenta are or are not.
    Momenta(Counting),
}

/// Without a truncation nothing is counted.
pub(super) const CANONICAL: State = State::Momenta(Counting::Amplitude);

pub(super) fn copies<'b>(
    lowering: &'b mut Lowering<'_>,
    orbits: &'b [Orbit],
    truncation: Option<usize>,
) -> Copies<'b> {
    let builder = &mut lowering.builder;
    Copies {
        graded: Graded {
            builder,
            truncation,
        },
        orbits,
    }
}

/// The constants as values of the program.
pub(super) fn values(lowering: &mut Lowering<'_>, sectors: &Sectors) -> Values {
    let mut door = Door::new(
        &lowering.mechanics.absolute,
        Argument::Theta,
        Some(Argument::Omega),
        None,
    );
    let mut series = |expr: &Expr| {
        let value = lowering.expr(&mut door, expr);
        if lowering.builder.is(value, 0) {
            Series::default()
        } else {
            Series::of_order(0, value)
        }
    };
    let orbits = sectors
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
            friction: series(&orbit.friction),
            drag: series(&orbit.drag),
            drive: [0, 1, 2].map(|part| series(&orbit.drive[part])),
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
    Values { orbits, couplings }
}

/// The state that an entry point is handed, and what follows from it.
pub(super) fn motion(
    copies: &mut Copies<'_>,
    scene: &Scene,
    mechanics: &Mechanics,
    values: &Values,
    state: State,
) -> Motion {
    let handed = |copies: &mut Copies<'_>, argument| -> Fields {
        let whole = argument == Argument::Momenta && state == State::Momenta(Counting::Angle);
        let budget = scene.requests.budget.as_ref();
        let chosen = budget.map_or(&[][..], |budget| budget.small.as_slice());
        let is_small =
            |place: &(usize, usize)| !whole && (chosen.is_empty() || chosen.contains(place));
        match state {
            State::Absolute => scene
                .orbits
                .iter()
                .enumerate()
                .map(|(orbit, links)| {
                    let links: Vec<ValueId> = links
                        .links
                        .iter()
                        .map(|&LinkId(link)| copies.graded.builder.input(argument, link))
                        .collect();
                    copies.analysed(orbit, &links, argument.letter())
                })
                .collect(),
            State::Rates | State::Momenta(_) => {
                let mut fields = copies.zeros();
                for (index, coordinate) in mechanics.coordinates.iter().enumerate() {
                    let value = copies.graded.builder.input(argument, index);
                    let (orbit, which) = coordinate.kind.place();
                    let field = &mut fields[orbit];
                    let value = match which {
                        Some(place) if is_small(&place) => copies.graded.small(value),
                        _ => copies.graded.value(value),
                    };
                    field.set(which, value);
                }
                fields
            }
        }
    };
    let [positions, motions] = match state {
        State::Absolute => [Argument::Theta, Argument::Omega],
        State::Rates => [Argument::Coordinates, Argument::Rates],
        State::Momenta(_) => [Argument::Coordinates, Argument::Momenta],
    };
    let angles = handed(copies, positions);
    let pose: Pose = copies.pose(values, angles);
    let handed = handed(copies, motions);
    let (rates, momenta) = if let State::Momenta(_) = state {
        let momenta = copies.per_link(&handed);
        let factors = copies.factors(values, &pose);
        (copies.solve(&factors, &momenta), momenta)
    } else {
        let momenta = copies.momenta(values, &pose, &handed);
        (handed, momenta)
    };
    for (rate, momentum) in rates.iter().zip(&momenta) {
        copies.named(rate, "omega");
        copies.named(momentum, "momentum");
    }
    let forces = copies.other_forces(values, &pose, &rates);
    Motion {
        pose,
        rates,
        momenta,
        forces,
    }
}
