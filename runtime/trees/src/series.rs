//! Taylor coefficients of the motion.

use branched_pendulum::scalar::{Double, Scalar};
use branched_pendulum::spring_dampers::SpringDamper;
use branched_pendulum::system::TaylorPendulum;
use branched_pendulum::taylor::{Quad, RoughFriction, SeriesForm, SeriesLink, SeriesTree};

use crate::between::Between;
use crate::carried::carried;
use crate::numbers::LinkNumbers;
use crate::rows::are_rough;
use crate::tree::{PendulumTree, constant};

/// Returns the constants of links as the recurrences take them: in units of the last link's
/// moment of inertia and of the distance from which it hangs, so that one of each is exact.
/// Weights are at gravity, or where there is a drive at a gravity of one.
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
        law: own
            .law
            .map(|[coulomb, quadratic, width]| [coulomb * unit, quadratic * unit, width]),
    };
    let spring_dampers = between.torsional.iter();
    let spring_dampers = spring_dampers.map(|own| units(own).map(constant));
    let lines = between.translational.iter();
    let lines = lines.map(|own| own.times(unit).map(constant));
    SeriesTree::new(&constants, laws, constant(unit), form_of(links))
        .with_spring_dampers(spring_dampers.collect())
        .with_lines(lines.collect())
}

/// What the tree has beside links that hang and swing.
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

/// The laws of friction that are not linear, with torques in this unit.
fn laws_of<T: Scalar>(links: &[LinkNumbers], unit: Double) -> Vec<RoughFriction<T>> {
    let zero = Double::from_f64(0.0);
    let laws = links.iter().enumerate().filter(|_| are_rough(links));
    let laws = laws.flat_map(|(link, own)| {
        let [joint, ground] = own.passive.laws;
        let law = |other, [coulomb, quadratic, width]: [Double; 3]| RoughFriction {
            link,
            other,
            coulomb: constant(coulomb * unit),
            quadratic: constant(quadratic * unit),
            width: constant(width),
        };
        let in_joint = [joint.coulomb, joint.quadratic] != [zero; 2];
        let on_link = ground.quadratic != zero;
        let in_joint =
            in_joint.then(|| law(own.parent, [joint.coulomb, joint.quadratic, joint.width]));
        let on_link = on_link.then(|| law(None, [zero, ground.quadratic, ground.width]));
        in_joint.into_iter().chain(on_link)
    });
    laws.collect()
}

impl<T: Scalar> TaylorPendulum<T> for PendulumTree<T> {
    fn taylor_workspace(&self, order: usize) -> usize {
        let drive = self.drive.as_ref().map_or(0, |drive| drive.room(order));
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
            let Some((room, work)) = rest.split_at_mut_checked(drive.room(order)) else {
                return coefficients.fill(T::from_f64(f64::NAN));
            };
            (orders, rest) = (Some(drive.series(time, order, room)), work);
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
