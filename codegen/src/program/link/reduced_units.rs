//! Units in which the recursion multiplies with as few constants as possible. The angular
//! acceleration of a link is replaced by the resulting acceleration of the pivot of its children;
//! mass and length are in units of the most frequent kind of leaf.

use crate::mechanics::Joint;
use crate::program::ValueId;
use crate::program::builder::Builder;
use crate::program::lower::{Environment, Lowering};
use crate::program::pair::Pair;
use crate::scene::{LinkId, PassiveTorques, Scene};

/// Constants of the links of one orbit (equal copies). L is the link's own unit of length; m, l are
/// the tree's units of mass and length.
pub(super) struct Unit {
    /// First moment (h + i e)/(L m).
    pub(super) moment: Pair,
    /// Moment of inertia M/(L² m).
    pub(super) inertia: ValueId,
    /// Length ratio L/l.
    pub(super) length: ValueId,
    /// Length ratio l/L.
    pub(super) inverse_length: ValueId,
    /// Factor 1/(L m l) for torques.
    pub(super) per_torque: ValueId,
    /// Position (ℓ + i w)/L of the pivot, with the unit L of the parent.
    pub(super) place: Pair,
    /// Friction and spring in SI units.
    pub(super) passive: PassiveTorques<ValueId>,
}

/// All constants of the recursion.
pub(super) struct Units {
    /// Constants of the links, by orbit.
    pub(super) links: Vec<Unit>,
    /// Units m and l of the tree.
    pub(super) tree: [ValueId; 2],
    /// Reciprocal 1/l of the unit of length.
    pub(super) per_length: ValueId,
    /// Gravity g/l.
    pub(super) gravity: ValueId,
}

impl Lowering<'_> {
    /// Returns the constants of a tree that is written out.
    pub(super) fn units(&mut self, scene: &Scene, environment: &mut Environment<'_>) -> Units {
        let mechanics = self.mechanics;
        let joints = mechanics.articulation.joints.iter();
        let given: Vec<Joint<ValueId>> = joints
            .map(|joint| joint.map(|expr| self.expr(environment, expr)))
            .collect();
        let gravity = self.expr(environment, &mechanics.articulation.gravity);
        Units::of(&mut self.builder, scene, &given, gravity, true)
    }
}

impl Units {
    /// Converts constants by orbit from SI units. `own` is true if a link with children has its own
    /// unit of length, and false if it has that of the tree.
    pub(super) fn of(
        builder: &mut Builder,
        scene: &Scene,
        given: &[Joint<ValueId>],
        gravity: ValueId,
        own: bool,
    ) -> Self {
        let children = super::children(scene);
        let one = builder.integer(1);
        let leaf = commonest_leaf(builder, scene, &children, given);
        let (mass, tree_length) = leaf.unwrap_or((one, one));
        let lengths: Vec<ValueId> = (0..given.len())
            .map(|orbit| {
                let below = &children[scene.orbits[orbit].links[0].0];
                let length = match below.is_empty() {
                    true => oscillation(builder, scene, &given[orbit]),
                    false if own => commonest_pivot(builder, scene, given, below),
                    false => None,
                };
                length.unwrap_or(tree_length)
            })
            .collect();
        let orbits = scene.orbits.iter().zip(given).enumerate();
        let links = orbits.map(|(number, (orbit, given))| {
            let own = lengths[number];
            let parent = scene.links[orbit.links[0].0].parent;
            let carrier = parent.map_or(one, |LinkId(link)| lengths[scene.links[link].orbit.0]);
            let first = builder.mul(own, mass);
            let second = builder.mul(own, first);
            let torque = builder.mul(first, tree_length);
            let mut called = |value: ValueId, by: ValueId, what: &str| {
                let value = builder.div(value, by);
                builder.called(value, &format!("{what}_{}", orbit.name))
            };
            Unit {
                moment: [
                    called(given.moment[0], first, "reduced_moment"),
                    called(given.moment[1], first, "reduced_lateral_moment"),
                ],
                inertia: called(given.inertia, second, "reduced_inertia"),
                length: called(own, tree_length, "reduced_length"),
                inverse_length: called(tree_length, own, "inverse_reduced_length"),
                per_torque: builder.div(one, torque),
                place: given.pivot.map(|component| builder.div(component, carrier)),
                passive: given.passive,
            }
        });
        let links = links.collect();
        let gravity = builder.div(gravity, tree_length);
        Self {
            links,
            tree: [mass, tree_length],
            per_length: builder.div(one, tree_length),
            gravity: builder.called(gravity, "reduced_gravity"),
        }
    }
}

/// Returns the pivot from which most of a link's children hang, if it lies on the link's axis.
fn commonest_pivot(
    builder: &mut Builder,
    scene: &Scene,
    given: &[Joint<ValueId>],
    children: &[usize],
) -> Option<ValueId> {
    let mut pivots: Vec<(Pair, usize)> = Vec::new();
    for &child in children {
        let pivot = given[scene.links[child].orbit.0].pivot;
        match pivots.iter_mut().find(|(known, _)| *known == pivot) {
            Some((_, count)) => *count += 1,
            None => pivots.push((pivot, 1)),
        }
    }
    let usable = pivots
        .into_iter()
        .filter(|(pivot, _)| builder.is(pivot[1], 0) && builder.is_never_zero(pivot[0], scene));
    let commonest = usable.max_by_key(|(_, count)| *count);
    commonest.map(|(pivot, _)| pivot[0])
}

/// Returns the centre of oscillation, M/h.
fn oscillation(builder: &mut Builder, scene: &Scene, given: &Joint<ValueId>) -> Option<ValueId> {
    let divides = builder.is_never_zero(given.moment[0], scene);
    divides.then(|| builder.div(given.inertia, given.moment[0]))
}

/// Returns h²/M and M/h of the most frequent kind of leaf; these become the units of mass and
/// length.
fn commonest_leaf(
    builder: &mut Builder,
    scene: &Scene,
    children: &[Vec<usize>],
    given: &[Joint<ValueId>],
) -> Option<(ValueId, ValueId)> {
    let leaves = scene.orbits.iter().enumerate().filter(|(number, orbit)| {
        children[orbit.links[0].0].is_empty()
            && builder.is_never_zero(given[*number].moment[0], scene)
    });
    let (number, _) = leaves.max_by_key(|(_, orbit)| orbit.links.len())?;
    let [moment, _] = given[number].moment;
    let length = oscillation(builder, scene, &given[number])?;
    Some((builder.div(moment, length), length))
}
