//! What a description says: its links, parameters and copies, and a picture of them.

use std::fmt::Write;

use branched_pendulum::Positions;
use branched_pendulum::sectors::Sectors;
use branched_pendulum::system::Model;
use branched_pendulum::translational::LinePotential;
use branched_pendulum_charts::{Film, verbatim};
use branched_pendulum_trees::{PendulumTree, strength_unit};
use clap::Parser;

use crate::Failure;
use crate::frame::Job;
use crate::frame::film;
use crate::subject::{Subject, TreeArguments};

/// What does a description say? Lists links with their masses and places, parameters with
/// their values, and where the tree rests; draws it at rest where a folder is given.
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
    subject.record(job);
    let tree = &subject.tree;
    let rest = tree.equilibrium(&vec![0.0; tree.links()]);
    let mut text = links(&subject);
    text.push_str(&between(tree));
    text.push_str(&parameters(tree));
    // Writing to a string cannot fail.
    let _ = match &rest {
        Ok(angles) if angles.iter().any(|angle| angle.abs() > 1e-12) => {
            let places = tree.names().iter().zip(angles);
            let places = places.map(|(name, angle)| format!("{name} {:.2}°", angle.to_degrees()));
            writeln!(text, "\nrests at {}", places.collect::<Vec<_>>().join(", "))
        }
        Ok(_) => writeln!(text, "\nrests with all angles zero"),
        Err(error) => writeln!(text, "\nno place of rest was found: {error}"),
    };
    job.print(&text)?;
    let mut rest = rest.unwrap_or_else(|_| vec![0.0; tree.links()]);
    fan(&subject.parents(), &mut rest);
    let angles = film::angles(tree, &rest);
    let picture =
        Film::new(verbatim(&subject.name), 1.0).tree("", &film::links(tree), &[angles])?;
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
    let mut text = format!("{name}: {count} links; the tree {side}\n\n");
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

/// Springs and friction between links and between points, a line each.
fn between(tree: &PendulumTree) -> String {
    let mut text = String::new();
    let name = |link: usize| tree.names().get(link).map_or("", String::as_str);
    for (place, own) in tree.spring_dampers().iter().enumerate() {
        if place == 0 {
            text.push_str("\nbetween links\n");
        }
        let [a, b] = own.links.map(name);
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
        if let Some([coulomb, quadratic, width]) = own.law {
            parts.push(format!(
                "Coulomb friction {coulomb} N m, quadratic friction {quadratic} N m s², width \
                 {width} rad/s"
            ));
        }
        if parts.is_empty() {
            parts.push("nothing at these values".to_owned());
        }
        // Writing to a string cannot fail.
        let _ = writeln!(text, "  {a}, {b}: {}", parts.join("; "));
    }
    text.push_str(&straight(tree));
    text
}

/// Straight springs and dampers, a line each.
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

/// A law of the energy that a line stores; none for a strength of zero.
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

/// Parameters with their values, and sectors where there are copies.
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

/// Angle between siblings that the picture draws apart, rad.
const APART: f64 = 0.35;

/// Turns siblings that would hide each other apart, with all that hangs from them.
fn fan(parents: &[Option<usize>], angles: &mut [f64]) {
    let turned = angles.to_vec();
    let mut turns = vec![0.0; angles.len()];
    for link in 0..angles.len() {
        let Some(parent) = parents[link] else {
            continue;
        };
        let hidden = |&other: &usize| {
            parents[other] == Some(parent) && (turned[other] - turned[link]).abs() < 0.5 * APART
        };
        let alike: Vec<usize> = (0..angles.len()).filter(hidden).collect();
        let place = alike.iter().position(|other| *other == link).unwrap_or(0);
        let middle = 0.5 * (alike.len() - 1) as f64;
        turns[link] = turns[parent] + APART * (place as f64 - middle);
        angles[link] += turns[link];
    }
}
