//! Random trees, twice: as the text of a description, and as bodies in
//! numbers.

use std::fmt::Write;

use super::{Between, Law, Link, Tree};
use branched_pendulum_compiler_tests::random::Random;

/// Properties of a random tree.
#[derive(Clone, Copy, Debug)]
pub struct Recipe {
    /// Number of links at which the tree stops growing.
    pub links: usize,
    /// Numbers of identical siblings to choose from.
    pub copies: &'static [usize],
    /// True if links with copies may have children, so that groups nest.
    pub nested: bool,
    /// Text in `emit(...)`.
    pub requests: &'static str,
}

/// A random tree.
#[derive(Clone, Debug)]
pub struct Sample {
    /// The arguments of the attribute.
    pub text: String,
    /// The tree in numbers, copies written out.
    pub tree: Tree,
}

/// A link for all its copies.
struct Node {
    parent: Option<usize>,
    copies: usize,
    /// Number of links that the node stands for.
    instances: usize,
    /// Shape and properties.
    text: String,
    link: Link,
    /// Attachment of the children, unless they name their own.
    joint: [f64; 2],
}

/// A tree of at most `recipe.links` links; the same seed gives the same tree.
pub fn sample(recipe: &Recipe, seed: u64) -> Sample {
    grown(recipe, seed, Additions::default())
}

/// Such a tree with Coulomb and quadratic friction and drag.
pub fn braked_sample(recipe: &Recipe, seed: u64) -> Sample {
    let braked = Additions {
        laws: true,
        ..Additions::default()
    };
    grown(recipe, seed, braked)
}

/// What acts between links of a random tree.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Coupling {
    /// Nothing.
    #[default]
    None,
    /// Springs and friction between any links, and between all copies of nodes.
    Any,
    /// Springs between all copies of nodes, and friction between any links.
    Symmetric,
}

/// Such a tree with springs and friction between links that are not parent and child.
pub fn coupled_sample(recipe: &Recipe, seed: u64, coupling: Coupling) -> Sample {
    let laws = true;
    grown(recipe, seed, Additions { laws, coupling })
}

/// Parts of a tree beside those that all have.
#[derive(Clone, Copy, Default)]
struct Additions {
    /// Coulomb and quadratic friction and drag.
    laws: bool,
    coupling: Coupling,
}

fn grown(recipe: &Recipe, seed: u64, additions: Additions) -> Sample {
    let braked = additions.laws;
    let mut random = Random::new(seed);
    let gravity = decimal(&mut random, 1.0, 20.0);
    let mut nodes = vec![node(&mut random, None, 1, braked)];
    let mut links = 1;
    let mut attempts = 0;
    while links < recipe.links && attempts < 1000 {
        attempts += 1;
        // Every other link hangs from the last one, so that trees get deep.
        let parent = match random.below(2) {
            0 => nodes.len() - 1,
            _ => random.below(nodes.len()),
        };
        let copies = recipe.copies[random.below(recipe.copies.len())];
        let instances = nodes[parent].instances * copies;
        if links + instances > recipe.links || (nodes[parent].instances > 1 && !recipe.nested) {
            continue;
        }
        links += instances;
        let above = Some((parent, &nodes[parent]));
        let mut child = node(&mut random, above, copies, braked);
        child.instances = instances;
        nodes.push(child);
    }
    let mut text = format!("gravity = {}, ", gravity.0);
    write_node(&nodes, 0, &mut text);
    let mut tree = Tree {
        gravity: gravity.1,
        links: Vec::new(),
        between: Vec::new(),
    };
    let mut places = Vec::new();
    write_links(&nodes, 0, None, "", &mut (&mut tree.links, &mut places));
    let clauses = match additions.coupling {
        Coupling::None => 0,
        _ => 1 + random.below(3),
    };
    for _ in 0..clauses {
        let clause = clause(&mut random, &places, additions.coupling, &mut tree.between);
        let _ = write!(text, ", {clause}");
    }
    if !recipe.requests.is_empty() {
        let _ = write!(text, ", emit({})", recipe.requests);
    }
    Sample { text, tree }
}

/// A link's node, name and parent.
struct Place {
    node: usize,
    name: String,
    parent: Option<usize>,
}

/// A clause about links, and what it says in numbers.
fn clause(
    random: &mut Random,
    places: &[Place],
    coupling: Coupling,
    between: &mut Vec<Between>,
) -> String {
    let copied = |&link: &usize| {
        let siblings = places
            .iter()
            .filter(|own| own.node == places[link].node && own.parent == places[link].parent);
        siblings.count() > 1
    };
    let copied: Vec<usize> = (0..places.len()).filter(copied).collect();
    let of_siblings = !copied.is_empty() && random.below(2) == 0;
    let has_spring = (of_siblings || coupling == Coupling::Any) && random.below(4) > 0;
    let mut properties = Properties {
        random,
        text: String::new(),
    };
    let mut own = Between {
        links: [0; 2],
        friction: 0.0,
        spring: 0.0,
        rest: 0.0,
        law: Law::default(),
    };
    if has_spring {
        own.spring = properties.number("spring", 1e-2, 5.0);
        if !of_siblings && properties.random.below(2) == 0 {
            own.rest = properties.number("rest", -2.0, 2.0);
        }
    }
    if !has_spring || properties.random.below(2) == 0 {
        own.friction = properties.number("friction", 1e-4, 0.5);
    }
    if properties.random.below(2) == 0 {
        own.law = properties.law("friction", true);
    }
    let text = properties.text.trim_end_matches(", ").to_owned();
    if of_siblings {
        let node = places[copied[random.below(copied.len())]].node;
        let siblings = |a: usize, b: usize| {
            [a, b].iter().all(|&link| places[link].node == node)
                && places[a].parent == places[b].parent
        };
        for a in 0..places.len() {
            for b in (a + 1..places.len()).filter(|&b| siblings(a, b)) {
                between.push(Between {
                    links: [a, b],
                    ..own
                });
            }
        }
        return format!("siblings(link_{node}, {text})");
    }
    let a = random.below(places.len());
    let b = (a + 1 + random.below(places.len() - 1)) % places.len();
    between.push(Between {
        links: [a, b],
        ..own
    });
    format!("between({}, {}, {text})", places[a].name, places[b].name)
}

/// A decimal number, as text and as the nearest `f64`.
fn decimal(random: &mut Random, low: f64, high: f64) -> (String, f64) {
    let value = random.between(low, high);
    let text = match random.below(3) {
        0 => format!("{value:.2}"),
        1 => format!("{value:.3e}"),
        _ => format!("{value:.7}"),
    };
    match text.parse::<f64>() {
        Ok(value) if value != 0.0 => (text, value),
        _ => decimal(random, low, high),
    }
}

/// Adds `name = value` to a node's text.
struct Properties<'a> {
    random: &'a mut Random,
    text: String,
}

impl Properties<'_> {
    fn number(&mut self, name: &str, low: f64, high: f64) -> f64 {
        let (text, value) = decimal(self.random, low, high);
        let _ = write!(self.text, "{name} = {text}, ");
        value
    }

    /// A law of friction with or without each of its parts.
    fn law(&mut self, force: &str, has_coulomb: bool) -> Law {
        let mut law = Law::default();
        let parts = self.random.below(4);
        let coulomb = has_coulomb && parts % 2 == 1;
        if !coulomb && parts < 2 {
            return law;
        }
        let _ = write!(self.text, "{force}(");
        if coulomb {
            law.coulomb = self.number("coulomb", 1e-3, 0.5);
            // Half of these laws have static friction. The digits of the Coulomb friction decide
            // which: another random number would change all trees that follow.
            let digits = (law.coulomb * 1e6).round();
            if digits % 2.0 == 0.0 {
                let breakaway = law.coulomb + (digits % 97.0 + 1.0) / 200.0;
                law.excess = breakaway - law.coulomb;
                law.stribeck = (digits % 13.0 + 1.0) / 10.0;
                let stribeck = law.stribeck;
                let _ = write!(self.text, "static = {breakaway}, stribeck = {stribeck}, ");
            }
        }
        if parts >= 2 {
            law.quadratic = self.number("quadratic", 1e-4, 0.1);
        }
        law.width = match self.random.below(3) {
            0 => 0.01,
            _ => self.number("width", 1e-3, 1.0),
        };
        let _ = write!(self.text, "), ");
        law
    }

    /// A point along the link, or with a lateral offset.
    fn point(&mut self, name: &str) -> [f64; 2] {
        let (along_text, along) = decimal(self.random, -0.3, 0.8);
        if self.random.below(2) == 0 {
            let _ = write!(self.text, "{name} = {along_text}, ");
            return [along, 0.0];
        }
        let (across_text, across) = decimal(self.random, -0.3, 0.3);
        let _ = write!(self.text, "{name} = ({along_text}, {across_text}), ");
        [along, across]
    }
}

fn node(random: &mut Random, parent: Option<(usize, &Node)>, copies: usize, braked: bool) -> Node {
    let shape = random.below(10);
    let mut properties = Properties {
        random,
        text: String::new(),
    };
    let (name, mut link, mut joint) = body(&mut properties, shape);
    // Links with a shape may still have points and an inertia of their own.
    if shape > 0 && properties.random.below(4) == 0 {
        link.com = properties.point("com");
        link.inertia = properties.number("inertia", 1e-4, 1e-1);
    }
    if shape > 0 && properties.random.below(4) == 0 {
        joint = properties.point("joint");
    }
    if let Some((_, parent)) = parent {
        link.pivot = parent.joint;
        if properties.random.below(2) == 0 {
            link.pivot = properties.point("at");
        }
    }
    if properties.random.below(2) == 0 {
        link.friction = properties.number("friction", 1e-4, 0.5);
    }
    if properties.random.below(4) == 0 {
        link.drag = properties.number("drag", 1e-4, 0.5);
    }
    if braked {
        link.laws = [("friction", true), ("drag", false)]
            .map(|(force, has_coulomb)| properties.law(force, has_coulomb));
    }
    if properties.random.below(4) == 0 {
        link.spring = properties.number("spring", 1e-3, 5.0);
        // Half of the springs have a rest angle, told by the stiffness: another draw
        // would make other trees of all that follow.
        let digits = (link.spring * 1e6).round();
        if digits % 2.0 == 0.0 {
            let rest = (digits % 401.0 - 200.0) / 100.0;
            let _ = write!(properties.text, "rest = {rest}, ");
            link.rest = rest;
        }
    }
    Node {
        parent: parent.map(|(index, _)| index),
        copies,
        instances: 1,
        text: format!("{name}({})", properties.text.trim_end_matches(", ")),
        link,
        joint,
    }
}

/// A body of the given shape: its name in descriptions, mass, inertia and
/// centre of mass, and where children hang.
fn body(properties: &mut Properties<'_>, shape: usize) -> (&'static str, Link, [f64; 2]) {
    let mass = properties.number("mass", 0.05, 2.0);
    let link = |mass: f64, inertia: f64, along: f64| Link {
        parent: None,
        mass,
        inertia,
        com: [along, 0.0],
        pivot: [0.0; 2],
        friction: 0.0,
        drag: 0.0,
        spring: 0.0,
        rest: 0.0,
        laws: Default::default(),
    };
    if shape == 0 {
        let mut plain = link(mass, 0.0, 0.0);
        plain.inertia = properties.number("inertia", 1e-4, 1e-1);
        plain.com = properties.point("com");
        return ("", plain, properties.point("joint"));
    }
    let length = properties.number("length", 0.1, 1.0);
    let end = [length, 0.0];
    let rod = mass * length * length / 12.0;
    let squared_radius = |properties: &mut Properties<'_>| {
        let radius = properties.number("radius", 0.05, 0.3);
        radius * radius
    };
    match shape {
        1 => (": point", link(mass, 0.0, length), end),
        2 => (": rod", link(mass, rod, 0.5 * length), end),
        3 => {
            // Two bodies in one, by the parallel axis theorem.
            let bob = properties.number("bob_mass", 0.05, 1.0);
            let com = (mass * 0.5 * length + bob * length) / (mass + bob);
            let (to_rod, to_bob) = (com - 0.5 * length, length - com);
            let inertia = rod + mass * to_rod * to_rod + bob * to_bob * to_bob;
            (": rod_with_bob", link(mass + bob, inertia, com), end)
        }
        4 => {
            let inertia = rod + 0.25 * mass * squared_radius(properties);
            (": cylinder", link(mass, inertia, 0.5 * length), end)
        }
        5 => {
            let width = properties.number("width", 0.05, 0.2);
            let margin = properties.number("margin", 0.01, 0.04);
            let inertia = rod + mass * width * width / 12.0;
            let body = link(mass, inertia, 0.5 * length - margin);
            (": plate", body, [length - 2.0 * margin, 0.0])
        }
        round => {
            let (name, factor) = [
                (": disc", 0.5),
                (": ring", 1.0),
                (": ball", 0.4),
                (": shell", 2.0 / 3.0),
            ][round - 6];
            let inertia = factor * mass * squared_radius(properties);
            (name, link(mass, inertia, length), end)
        }
    }
}

fn children(nodes: &[Node], parent: usize) -> impl Iterator<Item = usize> {
    (0..nodes.len()).filter(move |&child| nodes[child].parent == Some(parent))
}

fn write_node(nodes: &[Node], index: usize, text: &mut String) {
    let node = &nodes[index];
    let _ = write!(text, "link_{index}{}", node.text);
    if children(nodes, index).next().is_some() {
        text.push_str(" [");
        for child in children(nodes, index) {
            write_node(nodes, child, text);
            text.push_str(", ");
        }
        text.push(']');
    }
    if node.copies > 1 {
        let _ = write!(text, " * {}", node.copies);
    }
}

/// The copies of a node, each followed by all that hangs from it. `within` are the numbers of
/// the copies that they hang in.
fn write_links(
    nodes: &[Node],
    index: usize,
    parent: Option<usize>,
    within: &str,
    (links, places): &mut (&mut Vec<Link>, &mut Vec<Place>),
) {
    for copy in 1..=nodes[index].copies {
        let own = links.len();
        let suffix = match nodes[index].copies {
            1 => within.to_owned(),
            _ => format!("{within}_{copy}"),
        };
        links.push(Link {
            parent,
            ..nodes[index].link.clone()
        });
        places.push(Place {
            node: index,
            name: format!("link_{index}{suffix}"),
            parent,
        });
        for child in children(nodes, index) {
            write_links(nodes, child, Some(own), &suffix, &mut (links, places));
        }
    }
}
