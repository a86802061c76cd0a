//! Constants of the equations: the moments of each link about its pivot. Child links that have no
//! children themselves are included as point masses at their pivots.

use branched_pendulum::scalar::{Double, Scalar};
use branched_pendulum::system::LinkProperties;
use branched_pendulum_codegen::scene::PassiveTorques;

use crate::carried::{Carried, carried};
#[cfg(feature = "strips")]
use crate::equations::PrescribedRow;
use crate::equations::{ByRuleRow, Form, GeneralRow, NonViscousRow, PlainRow};
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
        let moments = moments(links, carries).into_iter();
        let rows = moments.zip(links);
        match self {
            Self::Plain => {
                let rows = rows.zip(attachments(links));
                let rows = rows.flat_map(|((row, _), place)| row.plain(place).into_array());
                rows.collect()
            }
            Self::General => rows
                .flat_map(|(row, link)| row.general(link).into_array())
                .collect(),
            Self::NonViscous => rows
                .flat_map(|(row, link)| row.non_viscous(link).into_array())
                .collect(),
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

/// Moments of a link, from the derived equations of one link (`docs/pipeline.md`): M = m (d² + e²) + I
/// + σ (ℓ² + w²), h = m d + σ ℓ, h⊥ = m e + σ w, S = m + σ.
#[derive(Clone, Copy, Debug)]
struct Moments<S> {
    inertia: S,
    moment: [S; 2],
    mass: S,
    /// h/M and h⊥/M of a link without children; zero for others.
    gain: [S; 2],
    inverse_inertia: S,
}

impl<S: Scalar> Moments<S> {
    /// Returns the constants of [`Form::Plain`]; `place` is the distance along the link from its
    /// pivot to that of its children.
    fn plain(self, place: S) -> PlainRow<S> {
        let Self {
            inertia,
            moment: [moment, _],
            mass,
            gain: [gain_along, _],
            inverse_inertia,
        } = self;
        PlainRow {
            inertia,
            moment,
            mass,
            gain_along,
            inverse_inertia,
            along: place,
        }
    }

    /// Returns the constants of [`Form::General`].
    fn general(self, link: &LinkNumbers<S>) -> GeneralRow<S> {
        let ([along, across], passive) = (link.pivot, &link.passive);
        GeneralRow {
            inertia: self.inertia,
            moment: self.moment[0],
            lateral_moment: self.moment[1],
            mass: self.mass,
            gain_along: self.gain[0],
            gain_across: self.gain[1],
            inverse_inertia: self.inverse_inertia,
            along,
            across,
            friction: passive.friction,
            drag: passive.drag,
            spring: passive.spring,
            rest: passive.rest,
            drive_torque: S::from_f64(0.0),
        }
    }

    /// Returns the constants of [`Form::NonViscous`], which includes all kinds of friction.
    fn non_viscous(self, link: &LinkNumbers<S>) -> NonViscousRow<S> {
        let ([along, across], passive) = (link.pivot, &link.passive);
        let [joint, ground] = &passive.laws;
        NonViscousRow {
            inertia: self.inertia,
            moment: self.moment[0],
            lateral_moment: self.moment[1],
            mass: self.mass,
            gain_along: self.gain[0],
            gain_across: self.gain[1],
            inverse_inertia: self.inverse_inertia,
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
            drive_torque: S::from_f64(0.0),
        }
    }

    /// Returns the constants of the equations of links whose motion may be prescribed.
    #[cfg(feature = "strips")]
    fn prescribed(self, link: &LinkNumbers<S>) -> PrescribedRow<S> {
        let ([along, across], passive) = (link.pivot, &link.passive);
        let [joint, ground] = &passive.laws;
        PrescribedRow {
            inertia: self.inertia,
            moment: self.moment[0],
            lateral_moment: self.moment[1],
            mass: self.mass,
            inverse_inertia: self.inverse_inertia,
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
            drive_torque: S::from_f64(0.0),
        }
    }
}

impl Moments<Double> {
    /// Returns the constants of the equations and energies of a tree by rule; `place` is the
    /// position of the children's pivot on the link.
    fn by_rule(
        self,
        link: &LinkNumbers,
        place: [Double; 2],
        carried: Carried,
        gravity: Double,
    ) -> ByRuleRow<Double> {
        let passive = &link.passive;
        let [joint, ground] = &passive.laws;
        ByRuleRow {
            inertia: self.inertia,
            moment: self.moment[0],
            lateral_moment: self.moment[1],
            mass: self.mass,
            gain_along: self.gain[0],
            gain_across: self.gain[1],
            inverse_inertia: self.inverse_inertia,
            along: place[0],
            across: place[1],
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
            body_mass: link.mass,
            body_inertia: link.inertia,
            com_along: link.com[0],
            com_across: link.com[1],
            place_along: place[0],
            place_across: place[1],
            carried_moment: carried.moment[0],
            lateral_carried_moment: carried.moment[1],
            gravity,
            stiffness: passive.spring,
            pivot_friction: passive.friction,
            ground_drag: passive.drag,
            pivot_coulomb: joint.coulomb,
            pivot_excess: joint.excess,
            pivot_quadratic: joint.quadratic,
            ground_quadratic: ground.quadratic,
            drive_torque: Double::from_f64(0.0),
        }
    }
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

fn moments<S: Scalar>(links: &[LinkNumbers<S>], carries: &[bool]) -> Vec<Moments<S>> {
    let zero = S::from_f64(0.0);
    let mut rows: Vec<Moments<S>> = Vec::with_capacity(links.len());
    for (link, carries) in links.iter().zip(carries) {
        let [along, across] = link.com;
        let moment = link.com.map(|place| link.mass * place);
        let inertia = link.inertia + moment[0] * along + moment[1] * across;
        let (mass, gain, inverse_inertia) = match carries {
            true => (link.mass, [zero; 2], zero),
            false => (
                zero,
                moment.map(|moment| moment / inertia),
                S::from_f64(1.0) / inertia,
            ),
        };
        if let (false, Some(parent)) = (carries, link.parent.and_then(|at| rows.get_mut(at))) {
            let [along, across] = link.pivot;
            let first = [link.mass * along, link.mass * across];
            parent.inertia = parent.inertia + first[0] * along + first[1] * across;
            parent.moment = [parent.moment[0] + first[0], parent.moment[1] + first[1]];
            parent.mass = parent.mass + link.mass;
        }
        rows.push(Moments {
            inertia,
            moment,
            mass,
            gain,
            inverse_inertia,
        });
    }
    rows
}

/// Returns the constants of the equations of links whose motion may be prescribed, in one row for
/// each link.
#[cfg(feature = "strips")]
pub(crate) fn prescribed(links: &[LinkNumbers], carries: &[bool]) -> Vec<Double> {
    let rows = moments(links, carries).into_iter().zip(links);
    rows.flat_map(|(row, link)| row.prescribed(link).into_array())
        .collect()
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
    let (moments, carried) = (moments(links, carries), carried(links));
    let rows = generations.iter().filter_map(|generation| {
        let &Generation { link, place } = generation;
        let (own, carried) = (links.get(link)?, *carried.get(link)?);
        Some(moments.get(link)?.by_rule(own, place, carried, gravity))
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
