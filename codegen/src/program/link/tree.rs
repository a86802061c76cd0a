//! Articulated recursion through a tree that is written out, link by link.

use super::equations::{Attached, Elimination, ReducedLink, Response};
use super::numbered;
use super::prescribed::PrescribedLink;
use super::reduced_units::Units;
use crate::mechanics::Trigonometric;
use crate::program::ValueId;
use crate::program::builder::Builder;
use crate::program::choice::{PrescribedAccelerations, PrescribedSolution};
use crate::program::lower::{Environment, Lowering};
use crate::program::pair::Pair;
use crate::scene::Scene;

/// State of the recursion.
struct LinkRecursion<'s> {
    scene: &'s Scene,
    units: Units,
    children: Vec<Vec<usize>>,
    links: Vec<ReducedLink>,
    /// Responses of the subtrees that are eliminated but not yet attached to their parent.
    responses: Vec<Option<Response>>,
    /// Prescribed accelerations.
    prescribed: &'s PrescribedAccelerations,
}

/// A link, prepared for the downward pass.
struct SolvedLink {
    way: Descent,
    /// Pivots on the link, each with the links that hang from it.
    groups: Vec<(Pair, Vec<usize>)>,
}

/// A link's acceleration in the downward pass.
enum Descent {
    /// Computed from these factors.
    Free(Elimination),
    /// Prescribed.
    Prescribed(PrescribedLink),
}

impl Lowering<'_> {
    /// Computes the accelerations θ̈ in absolute angles.
    pub(in crate::program) fn recursion(
        &mut self,
        scene: &Scene,
        environment: &mut Environment<'_>,
    ) -> Vec<ValueId> {
        self.recursion_around(scene, environment, &PrescribedAccelerations::new())
            .accelerations
    }

    /// Computes the accelerations if the accelerations of some links are prescribed.
    pub(in crate::program) fn recursion_around(
        &mut self,
        scene: &Scene,
        environment: &mut Environment<'_>,
        prescribed: &PrescribedAccelerations,
    ) -> PrescribedSolution {
        let frame = environment.frame;
        let units = self.units(scene, environment);
        let mut directions = Vec::new();
        for &angle in &frame.coordinates {
            let symbols = [Trigonometric::Cos(angle), Trigonometric::Sin(angle)]
                .map(|wanted| self.trigonometric_symbol(wanted));
            directions.push(symbols.map(|symbol| self.symbol(environment, symbol)));
        }
        let omega = frame.velocities.iter();
        let omega: Vec<ValueId> = omega
            .map(|&symbol| self.symbol(environment, symbol))
            .collect();
        let torques = self.joint_torques(scene, &units, environment, &omega);
        let root = self.root_gravity(&units, environment);
        let names = self.coordinate_names(frame);
        let zero = self.builder.integer(0);
        let links = scene.links.iter().enumerate().map(|(index, link)| {
            let unit = &units.links[link.orbit.0];
            ReducedLink {
                moment: unit.moment,
                inertia: unit.inertia,
                // The parents' constants include all mass.
                mass: zero,
                length: unit.length,
                inverse_length: unit.inverse_length,
                direction: directions[index],
                omega: omega[index],
                torque: torques[index],
                suffix: format!("_{}", names[index]),
            }
        });
        let links = links.collect();
        let mut sweep = LinkRecursion {
            scene,
            units,
            children: super::children(scene),
            links,
            responses: vec![None; scene.links.len()],
            prescribed,
        };
        let builder = &mut self.builder;
        let mut solved: Vec<SolvedLink> = Vec::with_capacity(scene.links.len());
        for link in (0..scene.links.len()).rev() {
            solved.push(sweep.eliminate(builder, link, root));
        }
        solved.reverse();
        sweep.descend(builder, &solved, root)
    }

    /// Returns the apparent gravity at the root's pivot, −a, in units of length.
    fn root_gravity(&mut self, units: &Units, environment: &mut Environment<'_>) -> Pair {
        let mechanics = self.mechanics;
        let mut pivot = self.builder.zero_pair();
        for motion in mechanics.drive.iter().flat_map(|drive| &drive.pivot) {
            let acceleration = self.expr(environment, &motion.inner_acceleration);
            pivot[usize::from(motion.name == "y")] =
                self.builder.mul(units.per_length, acceleration);
        }
        pivot[1] = self.builder.add(pivot[1], units.gravity);
        pivot.map(|component| self.builder.neg(component))
    }
}

impl LinkRecursion<'_> {
    /// Groups the subtrees below a link by pivot: position, members, and sum of their responses.
    fn groups(&mut self, builder: &mut Builder, link: usize) -> Vec<(Pair, Vec<usize>, Response)> {
        let mut groups: Vec<(Pair, Vec<usize>, Response)> = Vec::new();
        for &child in &self.children[link] {
            let place = self.units.links[self.scene.links[child].orbit.0].place;
            let Some(response) = self.responses[child].take() else {
                unreachable!("children are eliminated before their parents");
            };
            match groups.iter_mut().find(|(known, ..)| *known == place) {
                Some((_, members, sum)) => {
                    members.push(child);
                    *sum = sum.add(builder, &response);
                }
                None => groups.push((place, vec![child], response)),
            }
        }
        for (number, (_, members, response)) in groups.iter().enumerate() {
            if members.len() > 1 {
                let suffix = numbered(&self.links[link].suffix, number);
                response.name(builder, &format!("_below{suffix}"));
            }
        }
        groups
    }

    /// Upward pass at one link.
    fn eliminate(&mut self, builder: &mut Builder, index: usize, root: Pair) -> SolvedLink {
        let groups = self.groups(builder, index);
        let link = &self.links[index];
        let is_root = self.scene.links[index].parent.is_none();
        let mut whole: Option<Attached> = None;
        for (number, (place, _, response)) in groups.iter().enumerate() {
            let mut at = link.clone();
            at.suffix = numbered(&link.suffix, number);
            let body = whole.is_none().then(|| link.body());
            let attached = at.attach(builder, *place, response, body, !is_root);
            whole = Some(match whole {
                Some(whole) => whole.add(builder, &attached),
                None => attached,
            });
        }
        let (response, way) = match (self.prescribed.get(&index), &whole) {
            (Some(&alpha), _) => {
                let whole = whole.unwrap_or_else(|| link.alone(builder));
                let (response, prescribed) = link.prescribe(builder, &whole, alpha);
                (Some(response), Descent::Prescribed(prescribed))
            }
            (None, None) => self.leaf(builder, index),
            (None, Some(whole)) if is_root => {
                (None, Descent::Free(solve_root(builder, link, whole, root)))
            }
            (None, Some(whole)) => {
                let (response, elimination) = link.eliminate(builder, whole);
                (Some(response), Descent::Free(elimination))
            }
        };
        self.responses[index] = response;
        let groups = groups.into_iter();
        SolvedLink {
            way,
            groups: groups.map(|(place, members, _)| (place, members)).collect(),
        }
    }

    fn leaf(&self, builder: &mut Builder, index: usize) -> (Option<Response>, Descent) {
        let link = &self.links[index];
        let gain = link
            .moment
            .map(|component| builder.div(component, link.inertia));
        let one = builder.integer(1);
        let inverse = builder.div(one, link.inertia);
        let (mut response, elimination) = link.leaf(builder, gain, inverse);
        let trace = builder.dot(link.moment, gain);
        response.deficit.rest = super::deficit::Rest::Trace(trace);
        (Some(response), Descent::Free(elimination))
    }

    /// Downward pass from the root to the leaves, (10.8): ω̇ of each link and the apparent gravity
    /// at the pivots on it.
    fn descend(
        &self,
        builder: &mut Builder,
        solved: &[SolvedLink],
        root: Pair,
    ) -> PrescribedSolution {
        let mut gravity = vec![root; solved.len()];
        let mut accelerations = Vec::with_capacity(solved.len());
        let mut reactions = Vec::new();
        for (index, solved) in solved.iter().enumerate() {
            let link = &self.links[index];
            let [tangential, alpha] = match &solved.way {
                Descent::Free(elimination) => link.accelerate(builder, elimination, gravity[index]),
                Descent::Prescribed(prescribed) => {
                    let reduced = prescribed.reaction(builder, gravity[index]);
                    let unit = &self.units.links[self.scene.links[index].orbit.0];
                    let one = builder.integer(1);
                    let torque = builder.div(one, unit.per_torque);
                    let reaction = builder.mul(torque, reduced);
                    reactions.push(builder.name(reaction, &format!("reaction{}", link.suffix)));
                    prescribed.acceleration
                }
            };
            accelerations.push(alpha);
            for (number, (place, members)) in solved.groups.iter().enumerate() {
                let at = link.gravity_at(builder, *place, gravity[index], tangential);
                let suffix = numbered(&link.suffix, number);
                builder.name_pair(at, &format!("apparent_gravity@{suffix}"));
                for &member in members {
                    gravity[member] = at;
                }
            }
        }
        PrescribedSolution {
            accelerations,
            reactions,
        }
    }
}

/// Solves for the root. Its pivot has a given acceleration, so that nothing needs to be passed on.
fn solve_root(
    builder: &mut Builder,
    link: &ReducedLink,
    whole: &Attached,
    gravity: Pair,
) -> Elimination {
    let torque = link.net_torque(builder, whole);
    let driving = builder.dot(whole.first_moment, gravity);
    let rest = builder.add(driving, torque);
    let tangential = builder.div(rest, whole.inertia);
    Elimination {
        gain: builder.zero_pair(),
        offset: builder.neg(tangential),
    }
}
