//! Report about a description: its links, parameters and copies, and a picture of the tree.

use std::fmt::Write;

use branched_pendulum::Positions;
use branched_pendulum::sectors::Sectors;
use branched_pendulum::spring_dampers::SpringDamper;
use branched_pendulum::system::Model;
use branched_pendulum::translational::LinePotential;
use branched_pendulum_charts::{Film, verbatim};
use branched_pendulum_trees::{PendulumTree, strength_unit};
use clap::Parser;

use crate::Failure;
use crate::frame::Job;
use crate::frame::film;
use crate::picture::springs;
use crate::subject::{Subject, TreeArguments};

/// Lists the links with their masses and positions, the parameters with their values, and the
/// equilibria of the tree; draws the tree at rest if a folder is given.
#[derive(Clone, Debug, Parser, PartialEq)]
#[command(name = "branched-pendulum describe", version, verbatim_doc_comment)]
pub struct Arguments {
    #[command(flatten)]
    tree: TreeArguments,
}

impl crate::frame::Arguments for Arguments {
    const FOLDER: Option<&'static str> = None;
}

/// Prints the links and parameters, and draws the tree.
///
/// # Errors
/// [`Failure`].
pub fn run(arguments: &Arguments, job: &Job) -> Result<(), Failure> {
    let subject = arguments.tree.read()?;
    subject.record(job)?;
    let tree = &subject.tree;
    let (rests, rest) = subject.rests_in_words();
    let mut text = links(&subject);
    text.push_str(&between(tree));
    text.push_str(&parameters(tree));
    text.push('\n');
    text.push_str(&rests);
    job.print(&text)?;
    let mut rest = rest.unwrap_or_else(|_| vec![0.0; tree.links()]);
    fan(&subject.parents(), &mut rest);
    let angles = film::angles(tree, &rest);
    let picture =
        Film::new(verbatim(&subject.name), 1.0).tree("", &film::links(tree), &[angles])?;
    let named = tree.names().iter().map(|name| verbatim(name));
    let named = named.take(if tree.links() <= MOST_NAMES {
        tree.links()
    } else {
        0
    });
    let springs = springs(tree).into_iter();
    let picture = springs.fold(picture.names(named), Film::tie);
    job.film("tree", &picture)
}

/// The links, a line each.
fn links(subject: &Subject) -> String {
    let tree = &subject.tree;
    let side = match tree.stands() {
        true => "stands: angles are from the upward vertical",
        false => "hangs: angles are from the downward vertical",
    };
    let (name, count) = (&subject.name, tree.links());
    let links = if count == 1 { "link" } else { "links" };
    let mut text = format!("{name}: {count} {links}; the tree {side}\n\n");
    if let Some(lineage) = tree.lineage() {
        let generations = lineage.generations;
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "one branching of each of {generations} generations is open: all other copies move in \
             phase, so that these links stand for {}; masses and inertias are those of all copies\n",
            (1_u64 << generations) - 1
        );
    }
    let names = tree.names();
    let longest = names.iter().map(|name| name.chars().count()).max();
    let width = longest.unwrap_or(0).max(4);
    // Writing to a string cannot fail.
    let _ = writeln!(
        text,
        "{:width$}  {:width$}  mass (kg)  centre (m)         inertia (kg m²)  pivot on parent (m)",
        "link", "on"
    );
    let pair = |[along, across]: [f64; 2]| match across == 0.0 {
        true => format!("{along:.5}"),
        false => format!("{along:.5}, {across:.5}"),
    };
    for (link, name) in names.iter().enumerate() {
        let Some(own) = tree.properties_of(link) else {
            continue;
        };
        let parent = own.parent.and_then(|parent| names.get(parent));
        let _ = writeln!(
            text,
            "{name:width$}  {:width$}  {:<9.5}  {:17}  {:<15.4e}  {}",
            parent.map_or("", String::as_str),
            own.mass,
            pair(own.centre),
            own.inertia,
            pair(own.pivot),
        );
    }
    text
}

/// Lists the springs and friction between links and between points, one line each; consecutive
/// equal ones share a line.
fn between(tree: &PendulumTree) -> String {
    let mut text = String::new();
    let name = |link: usize| tree.names().get(link).map_or("", String::as_str);
    let pair = |own: &SpringDamper<f64>| own.links.map(name).join(", ");
    // The first and the last of those that are equal, and their number.
    let mut runs: Vec<[SpringDamper<f64>; 2]> = Vec::new();
    let mut counts: Vec<usize> = Vec::new();
    for own in tree.spring_dampers().iter() {
        let is_equal = |[first, _]: &&mut [SpringDamper<f64>; 2]| {
            let SpringDamper { links, .. } = *first;
            SpringDamper { links, ..own } == *first
        };
        match (runs.last_mut().filter(is_equal), counts.last_mut()) {
            (Some([_, last]), Some(count)) => (*last, *count) = (own, *count + 1),
            _ => {
                runs.push([own; 2]);
                counts.push(1);
            }
        }
    }
    let mut listed = tree.spring_dampers().iter();
    for (place, ([first, last], count)) in runs.iter().zip(counts).enumerate() {
        if place == 0 {
            text.push_str("\nbetween links\n");
        }
        let what = acting(first);
        let own = listed.by_ref().take(count);
        // Writing to a string cannot fail.
        match count > MOST_PAIRS {
            true => {
                let _ = writeln!(
                    text,
                    "  {} … {} ({count} pairs): {what}",
                    pair(first),
                    pair(last)
                );
                own.for_each(drop);
            }
            false => own.for_each(|own| {
                let _ = writeln!(text, "  {}: {what}", pair(&own));
            }),
        }
    }
    text.push_str(&straight(tree));
    text
}

/// Largest number of equal springs that are listed one by one.
const MOST_PAIRS: usize = 32;

/// Describes the spring and the friction between two links.
fn acting(own: &SpringDamper<f64>) -> String {
    let mut parts = Vec::new();
    if own.spring != 0.0 {
        parts.push(format!(
            "spring {} N m, at rest at {} rad",
            own.spring, own.rest
        ));
    }
    if own.friction != 0.0 {
        parts.push(format!("friction {} N m s", own.friction));
    }
    if let Some(law) = own.law {
        parts.push(law.to_string());
    }
    match parts.is_empty() {
        true => "nothing at these values".to_owned(),
        false => parts.join("; "),
    }
}

/// Lists the straight springs and dampers, one line each.
fn straight(tree: &PendulumTree) -> String {
    let mut text = String::new();
    let clauses = tree.description().straight_springs();
    for (place, (own, what)) in tree
        .translational_spring_dampers()
        .iter()
        .zip(clauses)
        .enumerate()
    {
        if place == 0 {
            text.push_str("\nbetween points\n");
        }
        let mut parts: Vec<String> = own.potentials.iter().filter_map(stored).collect();
        if let Some(friction) = own.friction.filter(|friction| *friction != 0.0) {
            parts.push(format!("friction {friction} N s/m"));
        }
        if parts.is_empty() {
            parts.push("nothing at these values".to_owned());
        }
        // Writing to a string cannot fail.
        let _ = writeln!(text, "  {what}: {}", parts.join("; "));
    }
    text
}

/// Describes a term of the potential energy of a straight spring; `None` if its strength is zero.
fn stored(potential: &LinePotential<f64>) -> Option<String> {
    match *potential {
        LinePotential::Spring { stiffness, rest } => (stiffness != 0.0).then(|| {
            let rest = rest.unwrap_or(0.0);
            format!("spring {stiffness} N/m, at rest at {rest} m")
        }),
        LinePotential::InversePower { strength, exponent } => {
            (strength != 0.0).then(|| format!("repulsion {strength} {}", strength_unit(exponent)))
        }
    }
}

/// Lists the parameters with their values, and the sectors if the tree has copies.
fn parameters(tree: &PendulumTree) -> String {
    let mut text = String::new();
    let description = tree.description();
    for (place, name) in description.parameters().enumerate() {
        if place == 0 {
            text.push_str("\nparameters\n");
        }
        let value = tree.value(name).unwrap_or(f64::NAN);
        let own = description.parameter_use(name).unwrap_or_default();
        // Writing to a string cannot fail.
        let _ = writeln!(text, "  {name} = {value}: {own}");
    }
    let sectors: Vec<&str> = tree.sectors().iter().map(|sector| sector.name()).collect();
    if sectors.len() > 1 {
        let _ = writeln!(text, "\nsectors: {}", sectors.join(", "));
    }
    text
}

/// Largest number of links for which the picture shows names.
const MOST_NAMES: usize = 40;

/// Angle (rad) by which the picture separates siblings.
const APART: f64 = 0.35;

/// Separates siblings that would hide each other in the picture, together with the links below
/// them.
fn fan(parents: &[Option<usize>], angles: &mut [f64]) {
    let turned = angles.to_vec();
    // Siblings next to each other, by their angles.
    let mut order: Vec<usize> = (0..turned.len()).collect();
    let by_angle = |a: &usize, b: &usize| turned[*a].total_cmp(&turned[*b]);
    order.sort_by(|a, b| parents[*a].cmp(&parents[*b]).then(by_angle(a, b)));
    let mut own_turns = vec![0.0; turned.len()];
    for siblings in order.chunk_by(|a, b| parents[*a].is_some() && parents[*a] == parents[*b]) {
        let (mut first, mut end) = (0, 0);
        for (place, &link) in siblings.iter().enumerate() {
            let is_hidden = |other: usize| (turned[other] - turned[link]).abs() < 0.5 * APART;
            while first < place && !is_hidden(siblings[first]) {
                first += 1;
            }
            end = end.max(place + 1);
            while end < siblings.len() && is_hidden(siblings[end]) {
                end += 1;
            }
            let middle = 0.5 * (end - first - 1) as f64;
            own_turns[link] = APART * ((place - first) as f64 - middle);
        }
    }
    let mut turns = vec![0.0; turned.len()];
    for (link, parent) in parents.iter().enumerate() {
        if let Some(parent) = parent {
            turns[link] = turns[*parent] + own_turns[link];
            angles[link] += turns[link];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{APART, fan};

    #[test]
    fn siblings_that_hide_each_other_are_turned_apart() {
        // Three at one angle with a child on the middle one, and one that is far away.
        let parents = [None, Some(0), Some(0), Some(0), Some(2), Some(0)];
        let mut angles = [0.1, 0.0, 0.0, 0.0, 0.3, 1.0];
        fan(&parents, &mut angles);
        assert_eq!(angles, [0.1, -APART, 0.0, APART, 0.3, 1.0]);
        // The order of their angles stays.
        let mut angles = [0.0, 0.1, 0.0];
        fan(&[None, Some(0), Some(0)], &mut angles);
        assert_eq!(angles, [0.0, 0.1 + 0.5 * APART, -0.5 * APART]);
        // Of many each has its own angle.
        let parents: Vec<Option<usize>> =
            (0..=60_000).map(|link| (link > 0).then_some(0)).collect();
        let mut angles = vec![0.0; parents.len()];
        fan(&parents, &mut angles);
        assert!(angles[1..].windows(2).all(|pair| pair[0] < pair[1]));
    }
}
