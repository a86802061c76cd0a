//! Constants of the equations: the moments of each link about its pivot, with the links
//! without children that hang from it counted as points at their pivots.

use branched_pendulum::scalar::{Double, Scalar};

use crate::numbers::LinkNumbers;

/// Columns of the general equations, in their order. Moments are those of the derived
/// balance of one link (`docs/pipeline.md`): M = m (d² + e²) + I + σ (ℓ² + w²),
/// h = m d + σ ℓ, h⊥ = m e + σ w, S = m + σ.
#[derive(Clone, Copy, Debug)]
struct Row {
    inertia: Double,
    moment: [Double; 2],
    mass: Double,
    /// h/M and h⊥/M of a link without children.
    gain: [Double; 2],
    inverse_inertia: Double,
}

/// The links' parents, and which of the links have children.
pub(crate) fn parents(links: &[LinkNumbers]) -> (Vec<u32>, Vec<bool>) {
    let mut carries = vec![false; links.len()];
    let parents = links.iter().map(|link| {
        let parent = link.parent.unwrap_or(0);
        if let (Some(carries), Some(_)) = (carries.get_mut(parent), link.parent) {
            *carries = true;
        }
        // They are fewer than 2¹⁶.
        parent as u32
    });
    (parents.collect(), carries)
}

fn moments(links: &[LinkNumbers], carries: &[bool]) -> Vec<Row> {
    let zero = Double::from_f64(0.0);
    let mut rows: Vec<Row> = Vec::with_capacity(links.len());
    for (link, carries) in links.iter().zip(carries) {
        let [along, across] = link.com;
        let moment = link.com.map(|place| link.mass * place);
        let inertia = link.inertia + moment[0] * along + moment[1] * across;
        let (mass, gain, inverse_inertia) = match carries {
            true => (link.mass, [zero; 2], zero),
            false => (
                zero,
                moment.map(|moment| moment / inertia),
                Double::from_f64(1.0) / inertia,
            ),
        };
        if let (false, Some(parent)) = (carries, link.parent.and_then(|at| rows.get_mut(at))) {
            let [along, across] = link.pivot;
            let first = [link.mass * along, link.mass * across];
            parent.inertia = parent.inertia + first[0] * along + first[1] * across;
            parent.moment = [parent.moment[0] + first[0], parent.moment[1] + first[1]];
            parent.mass += link.mass;
        }
        rows.push(Row {
            inertia,
            moment,
            mass,
            gain,
            inverse_inertia,
        });
    }
    rows
}

/// Rows of the general equations.
pub(crate) fn general(links: &[LinkNumbers], carries: &[bool]) -> Vec<[Double; 14]> {
    let rows = moments(links, carries).into_iter().zip(links);
    rows.map(|(row, link)| {
        let no_torque = Double::from_f64(0.0);
        [
            row.inertia,
            row.moment[0],
            row.moment[1],
            row.mass,
            row.gain[0],
            row.gain[1],
            row.inverse_inertia,
            link.pivot[0],
            link.pivot[1],
            link.friction,
            link.drag,
            link.spring,
            link.rest,
            no_torque,
        ]
    })
    .collect()
}

/// Returns true if some friction is not viscous.
pub(crate) fn are_rough(links: &[LinkNumbers]) -> bool {
    let zero = Double::from_f64(0.0);
    links.iter().any(|link| {
        let [coulomb, quadratic, _, drag, _] = link.laws;
        [coulomb, quadratic, drag].iter().any(|law| *law != zero)
    })
}

/// Rows of the rough equations, if some friction is not viscous.
pub(crate) fn rough(links: &[LinkNumbers], carries: &[bool]) -> Option<Vec<[Double; 19]>> {
    let zero = Double::from_f64(0.0);
    if !are_rough(links) {
        return None;
    }
    let rows = general(links, carries).into_iter().zip(links);
    let rows = rows.map(|(general, link)| {
        let mut row = [zero; 19];
        for (place, value) in row
            .iter_mut()
            .zip(general.iter().take(13).chain(&link.laws))
        {
            *place = *value;
        }
        row
    });
    Some(rows.collect())
}

/// Rows of laws of friction of [`Bodies`](branched_pendulum::tree::Bodies).
pub(crate) fn laws(links: &[LinkNumbers]) -> Vec<[Double; 5]> {
    links.iter().map(|link| link.laws).collect()
}

/// Rows of the straight equations, if all links have what these know.
pub(crate) fn straight(links: &[LinkNumbers], carries: &[bool]) -> Option<Vec<[Double; 6]>> {
    let zero = Double::from_f64(0.0);
    if are_rough(links) {
        return None;
    }
    let mut places: Vec<Option<Double>> = vec![None; links.len()];
    for link in links {
        let (com, pivot) = (link.com, link.pivot);
        let none = [com[1], pivot[1], link.friction, link.drag, link.spring];
        if none.iter().any(|number| *number != zero) {
            return None;
        }
        if let Some(place) = link.parent.and_then(|parent| places.get_mut(parent)) {
            if place.is_some_and(|place| place != pivot[0]) {
                return None;
            }
            *place = Some(pivot[0]);
        }
    }
    let rows = moments(links, carries).into_iter().zip(places);
    let rows = rows.map(|(row, place)| {
        [
            row.inertia,
            row.moment[0],
            row.mass,
            row.gain[0],
            row.inverse_inertia,
            place.unwrap_or(zero),
        ]
    });
    Some(rows.collect())
}

/// Rows of [`Bodies`](branched_pendulum::tree::Bodies).
pub(crate) fn bodies(links: &[LinkNumbers], gravity: Double) -> Vec<[Double; 12]> {
    let half = Double::from_f64(0.5);
    let rows = links.iter().map(|link| {
        let [along, across] = link.com;
        let [first, lateral] = link.com.map(|place| link.mass * place);
        let about = link.inertia + first * along + lateral * across;
        [
            half * link.mass,
            first,
            lateral,
            half * about,
            link.pivot[0],
            link.pivot[1],
            gravity * link.mass,
            gravity * first,
            gravity * lateral,
            half * link.spring,
            link.friction,
            link.drag,
        ]
    });
    rows.collect()
}

/// Rows of a [`PropertyTable`](branched_pendulum::tree::PropertyTable).
pub(crate) fn properties(links: &[LinkNumbers]) -> Vec<[Double; 8]> {
    let rows = links.iter().map(|link| {
        let ([d, e], [along, across], [x, y]) = (link.com, link.pivot, link.end);
        [link.mass, link.inertia, d, e, along, across, x, y]
    });
    rows.collect()
}
