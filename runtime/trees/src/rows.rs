//! Constants of the equations: the moments of each link about its pivot, with the links
//! without children that hang from it counted as points at their pivots.

use branched_pendulum::scalar::{Double, Scalar};

use branched_pendulum_codegen::scene::PassiveTorques;

use crate::numbers::LinkNumbers;

/// Forms of the equations, by what the links of a tree have.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Form {
    /// No torques in joints and no lateral offsets, and children share a pivot.
    Straight,
    /// All but friction that is not viscous.
    General,
    /// All.
    Rough,
}

impl Form {
    /// Returns the shortest form that knows all that the links have.
    pub(crate) fn of(links: &[LinkNumbers], is_driven: bool) -> Self {
        match (are_rough(links), are_straight(links) && !is_driven) {
            (true, _) => Self::Rough,
            (false, false) => Self::General,
            (false, true) => Self::Straight,
        }
    }

    /// Returns the constants of the equations, a row for each link.
    pub(crate) fn rows(self, links: &[LinkNumbers], carries: &[bool]) -> Vec<Double> {
        let moments = moments(links, carries).into_iter();
        let no_torque = Double::from_f64(0.0);
        match self {
            Self::Straight => {
                let rows = moments.zip(attachments(links));
                rows.flat_map(|(row, place)| row.straight(place)).collect()
            }
            Self::General => {
                let rows = moments.zip(links);
                let rows = rows.map(|(row, link)| row.jointed(&link.passive, link.pivot));
                rows.flat_map(|row| row.into_iter().chain([no_torque]))
                    .collect()
            }
            Self::Rough => {
                let rows = moments.zip(links).flat_map(|(row, link)| {
                    let laws = link.passive.law_row().into_iter().copied();
                    let friction = laws.chain([no_torque]);
                    let row = row.jointed(&link.passive, link.pivot);
                    row.into_iter().chain(friction)
                });
                rows.collect()
            }
        }
    }
}

/// Returns true if some friction is not viscous.
pub(crate) fn are_rough(links: &[LinkNumbers]) -> bool {
    let zero = Double::from_f64(0.0);
    links.iter().any(|link| {
        let [coulomb, quadratic, _, drag, _] = link.passive.law_row();
        [coulomb, quadratic, drag].iter().any(|law| **law != zero)
    })
}

fn are_straight(links: &[LinkNumbers]) -> bool {
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

/// The place of the pivot of each link's last child, along the link.
fn attachments(links: &[LinkNumbers]) -> Vec<Double> {
    let mut places = vec![Double::from_f64(0.0); links.len()];
    for link in links {
        if let Some(place) = link.parent.and_then(|parent| places.get_mut(parent)) {
            *place = link.pivot[0];
        }
    }
    places
}

/// Moments of a link: those of the derived balance of one link (`docs/pipeline.md`),
/// M = m (d² + e²) + I + σ (ℓ² + w²), h = m d + σ ℓ, h⊥ = m e + σ w, S = m + σ.
#[derive(Clone, Copy, Debug)]
struct Moments {
    inertia: Double,
    moment: [Double; 2],
    mass: Double,
    /// h/M and h⊥/M of a link without children.
    gain: [Double; 2],
    inverse_inertia: Double,
}

impl Moments {
    /// Returns the columns of the straight equations; `place` is that of the children.
    fn straight(self, place: Double) -> [Double; 6] {
        let Self {
            inertia,
            moment,
            mass,
            gain,
            inverse_inertia,
        } = self;
        [inertia, moment[0], mass, gain[0], inverse_inertia, place]
    }

    /// Returns the columns that the general and the rough equations share, and, with the
    /// children's pivot in place of the link's own, those of trees by rule.
    fn jointed(self, passive: &PassiveTorques<Double>, pivot: [Double; 2]) -> [Double; 13] {
        let Self {
            inertia,
            moment,
            mass,
            gain,
            inverse_inertia,
        } = self;
        [
            inertia,
            moment[0],
            moment[1],
            mass,
            gain[0],
            gain[1],
            inverse_inertia,
            pivot[0],
            pivot[1],
            passive.friction,
            passive.drag,
            passive.spring,
            passive.rest,
        ]
    }
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

fn moments(links: &[LinkNumbers], carries: &[bool]) -> Vec<Moments> {
    let zero = Double::from_f64(0.0);
    let mut rows: Vec<Moments> = Vec::with_capacity(links.len());
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

/// Moments of all that a link carries, about its pivot.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Carried {
    /// The diagonal of the mass matrix.
    pub(crate) inertia: Double,
    /// First moment, along the link and across it.
    pub(crate) moment: [Double; 2],
    mass: Double,
}

/// Returns the moments of the links, with all that hangs on them as points at their pivots.
pub(crate) fn carried(links: &[LinkNumbers]) -> Vec<Carried> {
    let own = links.iter().map(|link| {
        let [along, across] = link.com;
        let moment = link.com.map(|place| link.mass * place);
        Carried {
            inertia: link.inertia + moment[0] * along + moment[1] * across,
            moment,
            mass: link.mass,
        }
    });
    let mut all: Vec<Carried> = own.collect();
    for (index, link) in links.iter().enumerate().rev() {
        let mass = all.get(index).map(|own| own.mass);
        let parent = link.parent.and_then(|parent| all.get_mut(parent));
        if let (Some(mass), Some(parent)) = (mass, parent) {
            let [along, across] = link.pivot;
            let first = [mass * along, mass * across];
            parent.inertia = parent.inertia + first[0] * along + first[1] * across;
            parent.moment = [parent.moment[0] + first[0], parent.moment[1] + first[1]];
            parent.mass += mass;
        }
    }
    all
}

/// Numbers of a row of [`Form::Rough`].
#[cfg(feature = "strips")]
const ROUGH: usize = 19;

/// Returns the constants of the equations of links that may be held, a row for each link:
/// those of [`Form::Rough`] without b/J of links without children.
#[cfg(feature = "strips")]
pub(crate) fn held(links: &[LinkNumbers], carries: &[bool]) -> Vec<Double> {
    let rough = Form::Rough.rows(links, carries);
    let (rows, _) = rough.as_chunks::<ROUGH>();
    let rows = rows.iter().flat_map(|row| {
        let [inertia, moment, lateral, mass, _, _, others @ ..] = row;
        [inertia, moment, lateral, mass].into_iter().chain(others)
    });
    rows.copied().collect()
}

/// Links of one generation, all alike.
pub(crate) struct Generation {
    /// One of them.
    pub(crate) link: usize,
    /// Place of its children, along the link and across it.
    pub(crate) place: [Double; 2],
    /// Mass of all that hangs there.
    pub(crate) carried: Double,
}

/// Rows of the equations of trees by rule, for each generation from the root on.
pub(crate) fn by_rule(
    links: &[LinkNumbers],
    carries: &[bool],
    gravity: Double,
    generations: &[Generation],
) -> Vec<Double> {
    let moments = moments(links, carries);
    let rows = generations.iter().flat_map(|generation| {
        let &Generation {
            link,
            place,
            carried,
        } = generation;
        let own = links.get(link).zip(moments.get(link));
        let row = own.map(|(link, moments)| {
            let carried = [0, 1].map(|axis| link.mass * link.com[axis] + carried * place[axis]);
            let row = moments.jointed(&link.passive, place);
            let body = [link.mass, link.inertia, link.com[0], link.com[1]];
            let passive = &link.passive;
            let forces = [gravity, passive.spring, passive.friction, passive.drag];
            let laws = passive.law_row().into_iter().copied();
            let no_torque = Double::from_f64(0.0);
            let row = row.into_iter().chain(laws).chain(body).chain(place);
            row.chain(carried).chain(forces).chain([no_torque])
        });
        row.into_iter().flatten()
    });
    rows.collect()
}

/// Rows of [`Bodies`](branched_pendulum::tree::Bodies).
pub(crate) fn bodies(links: &[LinkNumbers], gravity: Double) -> Vec<Double> {
    let half = Double::from_f64(0.5);
    let rows = links.iter().flat_map(|link| {
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
            half * link.passive.spring,
            link.passive.friction,
            link.passive.drag,
        ]
    });
    rows.collect()
}

/// Rows of laws of friction of [`Bodies`](branched_pendulum::tree::Bodies).
pub(crate) fn laws(links: &[LinkNumbers]) -> Vec<Double> {
    let laws = links.iter().flat_map(|link| link.passive.law_row());
    laws.copied().collect()
}

/// Rows of a [`PropertyTable`](branched_pendulum::tree::PropertyTable).
pub(crate) fn properties(links: &[LinkNumbers]) -> Vec<Double> {
    let rows = links.iter().flat_map(|link| {
        let ([d, e], [along, across], [x, y]) = (link.com, link.pivot, link.end);
        [link.mass, link.inertia, d, e, along, across, x, y]
    });
    rows.collect()
}
