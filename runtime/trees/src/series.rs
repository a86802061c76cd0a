//! Taylor coefficients of the motion.

use branched_pendulum::scalar::{Double, Scalar};
use branched_pendulum::spring_dampers::SpringDamper;
use branched_pendulum::system::TaylorPendulum;
use branched_pendulum::taylor::{NonViscousFriction, Quad, SeriesForm, SeriesLink, SeriesTree};

use crate::between::Between;
use crate::carried::carried;
use crate::numbers::{self, LinkNumbers};
use crate::rows::have_non_viscous_friction;
use crate::tree::{PendulumTree, constant};

/// Returns the constants of the links for the Taylor recurrences. They are in units of the last
/// link's moment of inertia and of the distance from its parent's pivot to its own, so that one
/// constant of each kind is exact. Weights are for the given gravity or, if the tree has a drive,
/// for a gravity of 1.
pub(crate) fn series_of<T: Scalar>(
    links: &[LinkNumbers],
    between: &Between<Double>,
    gravity: Double,
    is_driven: bool,
) -> SeriesTree<T> {
    let (zero, one) = (Double::from_f64(0.0), Double::from_f64(1.0));
    let carried = carried(links);
    let unit = carried.last().map_or(one, |last| one / last.inertia);
    let mut hung = links.last().into_iter().flat_map(|last| last.pivot);
    let length = hung.find(|place| place.high() != 0.0);
    let length = length.filter(|_| links.len() > 1).unwrap_or(one);
    let above = if is_driven { one } else { gravity };
    let constants = links.iter().zip(&carried).enumerate();
    let constants: Vec<SeriesLink<T>> = constants
        .map(|(link, (own, carried))| {
            let moment = carried.moment.map(|moment| moment * unit);
            let below_root = |value: Double| if link > 0 { value } else { zero };
            SeriesLink {
                parent: own.parent.unwrap_or(0),
                inertia: constant(carried.inertia * unit),
                moment: moment.map(|moment| constant(below_root(moment * length))),
                attachment: own.pivot.map(|place| constant(below_root(place / length))),
                weight: moment.map(|moment| constant(moment * above)),
                friction: constant(own.passive.friction * unit),
                drag: constant(own.passive.drag * unit),
                spring: constant(own.passive.spring * unit),
                rest: constant(own.passive.rest),
            }
        })
        .collect();
    let laws = laws_of(links, unit);
    let units = |own: SpringDamper<Double>| SpringDamper {
        links: own.links,
        spring: own.spring * unit,
        rest: own.rest,
        friction: own.friction * unit,
        law: own.law.map(|law| law.times(unit)),
    };
    let spring_dampers = between.torsional.iter();
    let spring_dampers = spring_dampers.map(|own| units(own).map(constant));
    let lines = between.translational.iter();
    let lines = lines.map(|own| own.times(unit).map(constant));
    SeriesTree::new(&constants, laws, constant(unit), form_of(links))
        .with_spring_dampers(spring_dampers.collect())
        .with_lines(lines.collect())
}

/// Returns the properties of the tree that need additional terms in the recurrences.
fn form_of(links: &[LinkNumbers]) -> SeriesForm {
    let zero = Double::from_f64(0.0);
    SeriesForm {
        lateral: links
            .iter()
            .any(|own| [own.com[1], own.pivot[1]] != [zero; 2]),
        passive: links.iter().any(|own| {
            let passive = &own.passive;
            [passive.friction, passive.drag, passive.spring] != [zero; 3]
        }),
    }
}

/// Returns the nonlinear friction laws, with torques in this unit.
fn laws_of<T: Scalar>(links: &[LinkNumbers], unit: Double) -> Vec<NonViscousFriction<T>> {
    if !have_non_viscous_friction(links) {
        return Vec::new();
    }
    let laws = links.iter().enumerate().flat_map(|(link, own)| {
        let others = [own.parent, None];
        let laws = own.passive.laws.map(numbers::law).into_iter().zip(others);
        let laws = laws.filter(|(law, _)| !law.is_none());
        laws.map(move |(law, other)| NonViscousFriction {
            link,
            other,
            law: law.times(unit).map(constant),
        })
    });
    laws.collect()
}

impl<T: Scalar> TaylorPendulum<T> for PendulumTree<T> {
    fn taylor_workspace(&self, order: usize) -> usize {
        let drive = self
            .drive
            .as_ref()
            .map_or(0, |drive| drive.workspace_len(order));
        self.series.workspace(order) + drive
    }

    #[inline(always)]
    fn taylor_coefficients_into(
        &self,
        time: T,
        theta: &[T],
        omega: &[T],
        coefficients: &mut [T],
        work: &mut [Quad<T>],
    ) {
        let order = (coefficients.len() / (2 * self.names().len()).max(1)).saturating_sub(1);
        let (mut orders, mut rest) = (None, work);
        if let Some(drive) = &self.drive {
            let Some((buffer, work)) = rest.split_at_mut_checked(drive.workspace_len(order)) else {
                return coefficients.fill(T::from_f64(f64::NAN));
            };
            (orders, rest) = (Some(drive.series(time, order, buffer)), work);
        }
        // Once: it is long where it is inlined.
        self.series
            .expand([theta, omega], orders, coefficients, rest);
    }

    #[inline(always)]
    fn taylor_coefficients_of<S: Scalar>(
        pendulum: &PendulumTree<S>,
        time: S,
        theta: &[S],
        omega: &[S],
        coefficients: &mut [S],
        work: &mut [Quad<S>],
    ) {
        pendulum.taylor_coefficients_into(time, theta, omega, coefficients, work);
    }
}
