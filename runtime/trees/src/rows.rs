//! Constants of the equations: the moments of each link about its pivot, with child links that have
//! no children themselves as point masses at their pivots, and the torques in its joint.

use branched_pendulum::scalar::{Double, Scalar};
use branched_pendulum::system::LinkProperties;
use branched_pendulum_codegen::scene::PassiveTorques;

use crate::carried::bodies;
#[cfg(feature = "strips")]
use crate::equations::PrescribedRow;
use crate::equations::{ByRuleRow, Form, GeneralRow, NonViscousBodyRow, NonViscousRow, PlainRow};
use crate::numbers::LinkNumbers;

impl Form {
    /// Returns the shortest form that supports all properties of the links.
    pub(crate) fn of(links: &[LinkNumbers], is_driven: bool) -> Self {
        match (
            have_non_viscous_friction(links),
            are_plain(links) && !is_driven,
        ) {
            (true, _) => Self::NonViscous,
            (false, false) => Self::General,
            (false, true) => Self::Plain,
        }
    }

    /// Returns the constants of the equations, one row for each link.
    pub(crate) fn rows<S: Scalar>(self, links: &[LinkNumbers<S>], carries: &[bool]) -> Vec<S> {
        let all = all_constants(links, carries).into_iter();
        match self {
            Self::Plain => all
                .zip(attachments(links))
                .flat_map(|(own, along)| plain(NonViscousRow { along, ..own }).into_array())
                .collect(),
            Self::General => all.flat_map(|own| general(own).into_array()).collect(),
            Self::NonViscous => all.flat_map(NonViscousRow::into_array).collect(),
        }
    }
}

/// Returns true if some friction is not viscous.
pub(crate) fn have_non_viscous_friction(links: &[LinkNumbers]) -> bool {
    let zero = Double::from_f64(0.0);
    let mut laws = links.iter().flat_map(|link| &link.passive.laws);
    laws.any(|law| law.strengths().into_iter().any(|own| *own != zero))
}

fn are_plain(links: &[LinkNumbers]) -> bool {
    let zero = Double::from_f64(0.0);
    let places = attachments(links);
    links.iter().all(|link| {
        let [along, across] = link.pivot;
        let PassiveTorques {
            friction,
            drag,
            spring,
            ..
        } = link.passive;
        let none = [link.com[1], across, friction, drag, spring];
        let place = link.parent.and_then(|parent| places.get(parent));
        none.iter().all(|number| *number == zero) && place.is_none_or(|place| *place == along)
    })
}

/// Returns, for each link, the distance along it from its pivot to that of its last child.
fn attachments<S: Scalar>(links: &[LinkNumbers<S>]) -> Vec<S> {
    let mut places = vec![S::from_f64(0.0); links.len()];
    for link in links {
        if let Some(place) = link.parent.and_then(|parent| places.get_mut(parent)) {
            *place = link.pivot[0];
        }
    }
    places
}

/// Returns all constants of the equations of each link; each form of the equations reads some of
/// them. The moments follow from the derived equations of one link (`docs/pipeline.md`):
/// M = m (d² + e²) + I + σ (ℓ² + w²), h = m d + σ ℓ, h⊥ = m e + σ w, S = m + σ. Here σ is the total mass of the
/// child links without children.
fn all_constants<S: Scalar>(links: &[LinkNumbers<S>], carries: &[bool]) -> Vec<NonViscousRow<S>> {
    let (zero, one) = (S::from_f64(0.0), S::from_f64(1.0));
    let mut rows: Vec<NonViscousRow<S>> = Vec::with_capacity(links.len());
    for (link, carries) in links.iter().zip(carries) {
        let ([along, across], passive) = (link.pivot, &link.passive);
        let [moment, lateral_moment] = link.com.map(|place| link.mass * place);
        let inertia = link.inertia + moment * link.com[0] + lateral_moment * link.com[1];
        let (mass, [gain_along, gain_across], inverse_inertia) = match carries {
            true => (link.mass, [zero; 2], zero),
            false => (
                zero,
                [moment / inertia, lateral_moment / inertia],
                one / inertia,
            ),
        };
        if let (false, Some(parent)) = (carries, link.parent.and_then(|at| rows.get_mut(at))) {
            let first = [link.mass * along, link.mass * across];
            parent.inertia = parent.inertia + first[0] * along + first[1] * across;
            parent.moment = parent.moment + first[0];
            parent.lateral_moment = parent.lateral_moment + first[1];
            parent.mass = parent.mass + link.mass;
        }
        let [joint, ground] = &passive.laws;
        rows.push(NonViscousRow {
            inertia,
            moment,
            lateral_moment,
            mass,
            gain_along,
            gain_across,
            inverse_inertia,
            along,
            across,
            friction: passive.friction,
            drag: passive.drag,
            spring: passive.spring,
            rest: passive.rest,
            coulomb: joint.coulomb,
            static_excess: joint.excess,
            stribeck_rate: joint.stribeck,
            quadratic_friction: joint.quadratic,
            friction_width: joint.width,
            quadratic_drag: ground.quadratic,
            drag_width: ground.width,
            drive_torque: zero,
        });
    }
    rows
}

/// Creates a row from the constants of the same names in other rows: `row!(Row { from: a, b; })`.
macro_rules! row {
    ($row:ident { $($from:ident: $($name:ident),+;)+ }) => {
        $row { $($($name: $from.$name,)+)+ }
    };
}

/// Returns the constants of [`Form::Plain`]; `own.along` is the distance along the link from its
/// pivot to that of its children.
fn plain<S>(own: NonViscousRow<S>) -> PlainRow<S> {
    row!(PlainRow { own: inertia, moment, mass, gain_along, inverse_inertia, along; })
}

/// Returns the constants of [`Form::General`].
fn general<S>(own: NonViscousRow<S>) -> GeneralRow<S> {
    row!(GeneralRow {
        own: inertia, moment, lateral_moment, mass, gain_along, gain_across, inverse_inertia, along,
            across, friction, drag, spring, rest, drive_torque;
    })
}

/// Returns the constants of the equations of links whose motion may be prescribed, in one row for
/// each link.
#[cfg(feature = "strips")]
pub(crate) fn prescribed(links: &[LinkNumbers], carries: &[bool]) -> Vec<Double> {
    let rows = all_constants(links, carries).into_iter().map(|own| {
        row!(PrescribedRow {
            own: inertia, moment, lateral_moment, mass, inverse_inertia, along, across, friction,
                drag, spring, rest, coulomb, static_excess, stribeck_rate, quadratic_friction,
                friction_width, quadratic_drag, drag_width, drive_torque;
        })
    });
    rows.flat_map(PrescribedRow::into_array).collect()
}

/// Constants of a generation in addition to those of its links.
struct GenerationConstants {
    /// Position of the children's pivot along the link, m.
    place_along: Double,
    /// Position of the children's pivot across the link, m.
    place_across: Double,
    /// Gravity, m/s².
    gravity: Double,
}

/// Returns the constants of the equations and energies of a generation.
fn of_generation(
    own: NonViscousRow<Double>,
    body: NonViscousBodyRow<Double>,
    more: GenerationConstants,
) -> ByRuleRow<Double> {
    row!(ByRuleRow {
        own: inertia, moment, lateral_moment, mass, gain_along, gain_across, inverse_inertia, along,
            across, friction, drag, spring, rest, coulomb, static_excess, stribeck_rate,
            quadratic_friction, friction_width, quadratic_drag, drag_width, drive_torque;
        body: body_mass, body_inertia, com_along, com_across, carried_moment,
            lateral_carried_moment, stiffness, pivot_friction, ground_drag, pivot_coulomb,
            pivot_excess, pivot_quadratic, ground_quadratic;
        more: place_along, place_across, gravity;
    })
}

/// Returns the links' parents, and for each link whether it has children.
pub(crate) fn parents<S>(links: &[LinkNumbers<S>]) -> (Vec<u32>, Vec<bool>) {
    let mut carries = vec![false; links.len()];
    let parents = links.iter().map(|link| {
        let parent = link.parent.unwrap_or(0);
        if let (Some(carries), Some(_)) = (carries.get_mut(parent), link.parent) {
            *carries = true;
        }
        // Fits: the number of links is below 2¹⁶.
        parent as u32
    });
    (parents.collect(), carries)
}

/// A generation of identical links.
pub(crate) struct Generation {
    /// Index of one of these links.
    pub(crate) link: usize,
    /// Position of its children's pivot, along the link and across it.
    pub(crate) place: [Double; 2],
}

/// Returns the constants of the equations of trees by rule, in one row for each generation,
/// beginning with the root.
pub(crate) fn by_rule(
    links: &[LinkNumbers],
    carries: &[bool],
    gravity: Double,
    generations: &[Generation],
) -> Vec<Double> {
    let (all, bodies) = (all_constants(links, carries), bodies(links, gravity));
    let rows = generations.iter().filter_map(|generation| {
        let &Generation { link, place } = generation;
        let [along, across] = place;
        let own = NonViscousRow {
            along,
            across,
            ..*all.get(link)?
        };
        let more = GenerationConstants {
            place_along: along,
            place_across: across,
            gravity,
        };
        Some(of_generation(own, *bodies.get(link)?, more))
    });
    rows.flat_map(ByRuleRow::into_array).collect()
}

/// Returns the rows of a [`PropertyTable`](branched_pendulum::tree::PropertyTable).
pub(crate) fn properties(links: &[LinkNumbers]) -> Vec<Double> {
    let rows = links.iter().flat_map(|link| {
        let properties = LinkProperties {
            parent: link.parent,
            mass: link.mass,
            inertia: link.inertia,
            centre: link.com,
            pivot: link.pivot,
            end: link.end,
        };
        properties.into_row()
    });
    rows.collect()
}
