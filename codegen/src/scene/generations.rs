//! Trees that are one rule and large: their code is loops over generations.

use proc_macro2::Span;

use super::bodies::Body;
use super::body_rows::bodies_fit;
use super::forces::{Forces, value};
use super::link_constants::{Turning, half, inner, leaf, product};
use super::offsets::{add_offsets, unit};
use super::requests::Resolved;
use super::rule::Code;
use super::template::{MAX_LINKS, Template, WholeRule};
use super::values::message_for;
use super::{Quantity, Requests, Scene, Solve};
use crate::exact::ExactError;
use crate::report::{Message, Report};

/// Trees of at least so many links get loops: straight code for one state is slower,
/// and takes several times as long to compile (`docs/performance.md`).
const FEWEST: usize = 63;

/// Most links of such a tree: what an index of 32 bits counts.
const MOST: usize = 1 << 32;

/// Most generations of such a tree whose bodies have parameters.
const MOST_WITH_PARAMETERS: usize = 64;

/// What the links of a scene in generations stand for.
#[derive(Debug, Clone, PartialEq)]
pub struct Generations {
    /// Children of each link but those of the last generation.
    pub branching: usize,
    /// Links of all generations.
    pub links: usize,
    /// What the equations are made of.
    pub constants: Constants,
}

/// The numbers of a tree whose code is loops.
#[derive(Clone, Copy)]
pub(super) struct Loops {
    branching: usize,
    links: usize,
    span: Span,
}

/// What is asked for about a tree.
pub(super) struct Asked<'a> {
    pub(super) resolved: &'a Resolved,
    pub(super) observables: bool,
}

/// Decides how the code of a rule is written. Where it is loops, leaves one
/// template for a link of each generation.
///
/// # Errors
/// Where the tree can neither be written out nor have loops, or has loops that
/// it cannot have; `report` says why.
pub(super) fn decide(
    rule: WholeRule,
    templates: &mut [Template],
    asked: &Asked<'_>,
    report: &mut Report,
) -> Result<Option<Loops>, ()> {
    let mut links: usize = 0;
    let mut count: usize = 1;
    for _ in &*templates {
        links = links.saturating_add(count);
        count = count.saturating_mul(rule.branching);
    }
    let wanted = match rule.code {
        Some(Code::Unrolled) => return Ok(None),
        Some(Code::Loops) => true,
        None => links >= FEWEST,
    };
    if !wanted {
        return Ok(None);
    }
    match obstacle(templates, asked) {
        Some(what) if rule.code.is_some() => {
            report.error(rule.span, Message::NoLoops { what });
            Err(())
        }
        Some(what) if links > MAX_LINKS => {
            let limit = MAX_LINKS;
            report.error(rule.span, Message::TooManyForUnrolled { what, limit });
            Err(())
        }
        Some(_) => Ok(None),
        None if links > MOST => {
            report.error(rule.span, Message::TooManyLinks { limit: MOST });
            Err(())
        }
        None => {
            for template in templates {
                template.copies = 1;
            }
            Ok(Some(Loops {
                branching: rule.branching,
                links,
                span: rule.span,
            }))
        }
    }
}

/// The constants of a scene whose code is loops; `None` after reporting what is
/// wrong.
pub(super) fn generations(loops: Loops, scene: &Scene, report: &mut Report) -> Option<Generations> {
    let Loops {
        branching,
        links,
        span,
    } = loops;
    let constants = match Constants::of(scene, branching) {
        Ok(constants) => constants,
        Err(error) => {
            report.error(span, message_for(error));
            return None;
        }
    };
    let energies = (!bodies_fit(scene)).then_some("energy");
    let columns = Forces::of(scene).columns();
    if let Some(name) = constants.unrepresentable(&columns).or(energies) {
        let name = name.to_owned();
        report.error(span, Message::ConstantRange { name });
        return None;
    }
    Some(Generations {
        branching,
        links,
        constants,
    })
}

/// What loops over generations do not do, in words.
fn obstacle(templates: &[Template], asked: &Asked<'_>) -> Option<String> {
    if let Some(what) = unlooped(templates, asked) {
        return Some(what.to_owned());
    }
    // Their constants are formed of those of all generations below, in code.
    let parameters = templates.len() > MOST_WITH_PARAMETERS
        && templates.iter().any(|template| {
            let Body {
                mass, inertia, com, ..
            } = &template.body;
            let pivot = &template.pivot;
            let parts = [
                mass,
                inertia,
                &com.along,
                &com.lateral,
                &pivot.along,
                &pivot.lateral,
            ];
            parts.into_iter().any(|value| value.exact().is_none())
        });
    parameters.then(|| format!("parameters in more than {MOST_WITH_PARAMETERS} generations"))
}

/// What no loops do, in words.
pub(super) fn unlooped(templates: &[Template], asked: &Asked<'_>) -> Option<&'static str> {
    let Requests {
        energies: _,
        momenta,
        modes,
        symmetric,
        transfer,
        budget,
        taylor,
        drive: _,
        solve,
    } = &asked.resolved.requests;
    // Loops are the recursion.
    let factorization = *solve == Some(Solve::Factorization);
    let requests = [
        (*momenta, "`emit(momenta)`"),
        (*modes, "`emit(modes)`"),
        (*symmetric, "`emit(symmetric)`"),
        (transfer.is_some(), "`emit(transfer)`"),
        (budget.is_some(), "`emit(budget)`"),
        (*taylor, "`emit(taylor)`"),
        (asked.observables, "`observe(…)`"),
        (factorization, "`solve = factorization`"),
        (templates.len() < 2, "a single generation"),
    ];
    // What brings others along comes last.
    let request = requests.into_iter().rev().find(|(wanted, _)| *wanted);
    request.map(|(_, what)| what)
}

/// Whether links hang in their parent's own pivot. Then its distance is no unit of
/// length, as loops over generations need one.
pub(super) fn in_own_pivot(templates: &[Template]) -> bool {
    let mut children = templates.iter().skip(1);
    children.any(|template| unit(&template.pivot).is_zero())
}

/// The constants of a scene in generations, exact where no parameter is
/// involved. SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct Constants {
    /// What the equations of each generation read, in the order of
    /// [`Forces::columns`].
    pub motion: Vec<Vec<Quantity>>,
    /// What its energies read: half of the mass, first moment, half of the moment
    /// of inertia about the pivot, lever, gravity's moment, half of the spring.
    pub energy: Vec<[Quantity; 6]>,
    /// −g over the first lever: what the root's equations take from above.
    pub root: Quantity,
    /// One over the first lever, where there is a drive.
    pub per_lever: Option<Quantity>,
}

impl Constants {
    /// Of a scene whose `links` are one of each generation, below each other.
    ///
    /// # Errors
    /// [`ExactError`] where a number gets too long, or a leaf has no inertia about
    /// its pivot.
    fn of(scene: &Scene, branching: usize) -> Result<Self, ExactError> {
        let forces = Forces::of(scene);
        let copies = Quantity::integer(i64::try_from(branching).unwrap_or(i64::MAX));
        let links = &scene.links;
        let (mut motion, mut energy) = (Vec::new(), Vec::new());
        // Mass of one subtree of the generation below; none below the leaves.
        let mut below = Quantity::zero();
        for (generation, link) in links.iter().enumerate().rev() {
            let child = links.get(generation + 1);
            let lever = child.map_or_else(Quantity::zero, |child| unit(&child.pivot).clone());
            let about = Turning::of(link)?;
            let hanging = product([&copies, &below]);
            let first_moment = Quantity::sum([about.moment.clone(), product([&lever, &hanging])]);
            energy.push([
                half(&about.mass),
                about.moment.clone(),
                half(&about.inertia),
                lever.clone(),
                product([&scene.gravity, &first_moment]),
                half(&value(&link.spring)),
            ]);
            let mut row = match child {
                None => leaf(&about)?,
                Some(child) => {
                    let next = links.get(generation + 2).map(|next| unit(&next.pivot));
                    inner(&about, &lever, &copies, &Turning::of(child)?, next)?
                }
            };
            if forces.lateral {
                add_offsets(&mut row, link, child.map(|child| &child.pivot))?;
            }
            row.extend(forces.values(link));
            motion.push(row);
            below = Quantity::sum([about.mass, hanging]);
        }
        motion.reverse();
        energy.reverse();
        let lever = links
            .get(1)
            .map_or_else(Quantity::zero, |link| unit(&link.pivot).clone());
        Ok(Self {
            motion,
            energy,
            per_lever: per_lever(scene, &lever)?,
            root: scene.gravity.clone().divided_by(lever)?.negative(),
        })
    }

    /// The first value that no `f64` can hold, by its column.
    fn unrepresentable(&self, columns: &[&'static str]) -> Option<&'static str> {
        let fits = Quantity::is_finite;
        let motion = self.motion.iter().flat_map(|row| columns.iter().zip(row));
        let wrong = motion.into_iter().find(|(_, value)| !fits(value));
        let energy = self.energy.iter().flatten().all(fits)
            && fits(&self.root)
            && self.per_lever.iter().all(fits);
        wrong
            .map(|(name, _)| *name)
            .or((!energy).then_some("energy"))
    }
}

/// One over the root's unit of length, where there is a drive.
pub(super) fn per_lever(scene: &Scene, lever: &Quantity) -> Result<Option<Quantity>, ExactError> {
    let reciprocal = || Quantity::integer(1).divided_by(lever.clone());
    scene.drive.as_ref().map(|_| reciprocal()).transpose()
}
