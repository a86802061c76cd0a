//! Large trees that are no rule: their code is a loop over a table of links.

use proc_macro2::Span;

use super::body_rows::bodies_fit;
use super::forces::{Forces, value};
use super::generations::{Asked, per_lever, unlooped};
use super::link_constants::{Turning, half, inner, leaf, product};
use super::offsets::{add_offsets, unit};
use super::places::{HANGING, columns, has_places, placed};
use super::rule::Code;
use super::template::Template;
use super::values::message_for;
use super::{Link, Quantity, Scene};
use crate::exact::ExactError;
use crate::report::{Message, Report};

/// Trees of more links than this get a loop: straight code for more is no faster,
/// and takes long to derive and compile (`docs/performance.md`).
const MOST_UNROLLED: usize = 100;

/// The constants of each link of a scene whose code is a loop over them, exact
/// where no parameter is involved. SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    /// What the equations of each link read, in the order of
    /// [`Forces::columns`] or, where there is `hanging`, of
    /// [`placed_columns`](super::placed_columns). `square`, `ratio` and `reach` are those of the link
    /// on its parent; zero for the root.
    pub motion: Vec<Vec<Quantity>>,
    /// What its energies read, in the order of [`Table::ENERGY`].
    pub energy: Vec<[Quantity; 7]>,
    /// What each link is to its parent, where links carry children at several
    /// places: factors `square`, `ratio` and `reach` as above, the isotropic part of
    /// Φ, the place along and across the parent. Lengths are in metres then, and
    /// energies those of bodies.
    pub hanging: Option<Vec<[Quantity; 6]>>,
    /// −g over the root's lever: what the root's equations take from above.
    pub root: Quantity,
    /// One over the root's lever, where there is a drive.
    pub per_lever: Option<Quantity>,
}

/// Whether the code is to be a loop over a table. Where it cannot be and must,
/// `report` says why.
pub(super) fn wanted(
    code: Option<(Code, Span)>,
    links: usize,
    templates: &[Template],
    asked: &Asked<'_>,
    report: &mut Report,
) -> bool {
    let span = match code {
        Some((Code::Unrolled, _)) => return false,
        Some((Code::Loops, span)) => Some(span),
        None if links > MOST_UNROLLED => None,
        None => return false,
    };
    let obstacle = unlooped(templates, asked);
    // What is unreadable may look like an obstacle.
    if let (Some(what), Some(span), true) = (obstacle, span, report.is_empty()) {
        let what = what.to_owned();
        report.error(span, Message::NoLoops { what });
    }
    obstacle.is_none()
}

/// The constants of a scene; `None` after reporting what is wrong.
pub(super) fn table(scene: &Scene, report: &mut Report) -> Option<Table> {
    let table = match Table::of(scene) {
        Ok(table) => table,
        Err(error) => {
            report.error(Span::call_site(), message_for(error));
            return None;
        }
    };
    let energies = (!bodies_fit(scene)).then_some("energy");
    let forces = Forces::of(scene);
    let columns = match table.hanging {
        Some(_) => columns(forces),
        None => forces.columns(),
    };
    if let Some(name) = table.unrepresentable(&columns).or(energies) {
        let name = name.to_owned();
        report.error(Span::call_site(), Message::ConstantRange { name });
        return None;
    }
    Some(table)
}

impl Table {
    /// Half of the mass; first moment and half of the moment of inertia about the
    /// pivot; distance from the parent's pivot; weight; gravity's first moment;
    /// half of the spring's stiffness.
    pub const ENERGY: [&'static str; 7] = [
        "half_mass",
        "moment",
        "half_inertia",
        "pivot",
        "weight",
        "gravity",
        "half_spring",
    ];

    /// Of a scene.
    ///
    /// # Errors
    /// [`ExactError`] where a number gets too long, or a leaf has no inertia about
    /// its pivot.
    fn of(scene: &Scene) -> Result<Self, ExactError> {
        if has_places(scene) {
            return placed(scene);
        }
        let (forces, links) = (Forces::of(scene), &scene.links);
        let one = Quantity::integer(1);
        // Distance of a link's children; none for a leaf.
        let mut levers = vec![None; links.len()];
        for link in links {
            if let Some(lever) = link.parent.and_then(|parent| levers.get_mut(parent.0)) {
                *lever = Some(&link.pivot);
            }
        }
        let bodies = links.iter().map(Turning::of);
        let bodies: Vec<Turning> = bodies.collect::<Result<_, _>>()?;
        let mut motion = Vec::with_capacity(links.len());
        for (body, lever) in bodies.iter().zip(&levers) {
            motion.push(match lever {
                None => leaf(body)?,
                Some(lever) => {
                    let mut row = vec![Quantity::zero(); 6];
                    row[1] = body.inertia.clone();
                    row[2] = product([&body.moment, unit(lever)]);
                    row
                }
            });
        }
        // What children are to their parents: the share of `rest`, and the
        // factors of their answers.
        let mut rests: Vec<Vec<Quantity>> = vec![Vec::new(); links.len()];
        for (index, (link, body)) in links.iter().zip(&bodies).enumerate() {
            let Some(parent) = link.parent else {
                continue;
            };
            let on = inner(
                &bodies[parent.0],
                unit(&link.pivot),
                &one,
                body,
                levers[index].map(unit),
            )?;
            let [rest, _, _, factors @ ..] = on.as_slice() else {
                continue;
            };
            rests[parent.0].push(rest.clone());
            motion[index][3..].clone_from_slice(factors);
        }
        for (index, (row, rest)) in motion.iter_mut().zip(rests).enumerate() {
            let link = &links[index];
            row[0] = Quantity::sum(rest);
            if forces.lateral {
                add_offsets(row, link, levers[index])?;
            }
            row.extend(forces.values(link));
        }
        let energy = links.iter().zip(&bodies);
        let energy = energy.map(|(link, body)| energy_row(scene, link, body));
        let lever = levers
            .first()
            .copied()
            .flatten()
            .map(|lever| unit(lever).clone());
        let lever = lever.unwrap_or_else(Quantity::zero);
        Ok(Self {
            per_lever: per_lever(scene, &lever)?,
            motion,
            energy: energy.collect(),
            hanging: None,
            root: scene.gravity.clone().divided_by(lever)?.negative(),
        })
    }

    /// The first value that no `f64` can hold, by its column.
    fn unrepresentable(&self, columns: &[&'static str]) -> Option<&'static str> {
        let fits = Quantity::is_finite;
        let motion = self.motion.iter().flat_map(|row| columns.iter().zip(row));
        let energy = self
            .energy
            .iter()
            .flat_map(|row| Self::ENERGY.iter().zip(row));
        let hanging = self.hanging.iter().flatten();
        let hanging = hanging.flat_map(|row| HANGING.iter().zip(row));
        let wrong = motion
            .chain(energy)
            .chain(hanging)
            .find(|(_, value)| !fits(value));
        wrong
            .map(|(name, _)| *name)
            .or((!fits(&self.root)).then_some("gravity"))
            .or((!self.per_lever.iter().all(fits)).then_some("lever"))
    }
}

fn energy_row(scene: &Scene, link: &Link, body: &Turning) -> [Quantity; 7] {
    [
        half(&body.mass),
        body.moment.clone(),
        half(&body.inertia),
        link.pivot.along.clone(),
        product([&scene.gravity, &body.mass]),
        product([&scene.gravity, &body.moment]),
        half(&value(&link.spring)),
    ]
}
