//! Symmetric coordinates (physics §3): the mean angle of sibling copies, and orthogonal differences
//! between them, built from the leaves upwards. Copies with different values get the same
//! coordinates as equal ones.

use super::{Group, LinkId, OrbitId, Scene};
use std::collections::{BTreeMap, BTreeSet};

/// Kind of a symmetric coordinate, and the links to which it belongs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum CoordinateKind {
    /// Mean angle of all copies of a node; the link's own angle if it has no copies.
    Mean {
        /// Orbit (set of equal copies of one node) of the first of these links.
        orbit: OrbitId,
    },
    /// Difference between the copies of a group: between the angles of corresponding links (of one
    /// orbit) in each copy.
    Difference {
        /// Index of the group in the scene.
        group: usize,
        /// Number of the difference, from 1 to the number of copies − 1.
        index: usize,
        /// Orbit of the first of these links.
        orbit: OrbitId,
        /// Sum of the squared weights. The mass matrix of the difference is that of one copy
        /// divided by it (2 for a pair).
        norm: i64,
    },
}

impl CoordinateKind {
    /// Returns the index of the orbit, and the difference as its group and number; `None` for a
    /// mean.
    pub fn orbit_and_difference(&self) -> (usize, Option<(usize, usize)>) {
        match *self {
            Self::Mean { orbit } => (orbit.0, None),
            Self::Difference {
                group,
                index,
                orbit,
                ..
            } => (orbit.0, Some((group, index))),
        }
    }
}

/// One symmetric coordinate. The angle of a link is the sum over coordinates: θ_link = Σ weight ·
/// coordinate.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Coordinate {
    /// Short name; emitted names put `theta_` or `p_` before it.
    pub name: String,
    /// Kind of the coordinate: a mean or a difference.
    pub kind: CoordinateKind,
    /// Weight of this coordinate in the angle of each link; links of weight 0 are left out. The
    /// weight vectors of different coordinates are orthogonal.
    pub weights: Vec<(LinkId, i64)>,
}

impl Coordinate {
    /// Returns the sum of the squared weights, the divisor of the inverse transform.
    pub fn norm(&self) -> i64 {
        self.weights.iter().map(|(_, w)| w * w).sum()
    }
}

/// Links of one orbit below a node, in the order of the copies.
struct Strand {
    orbit: OrbitId,
    links: Vec<LinkId>,
}

/// Returns the symmetric coordinates of a scene: first the means, in the order of the orbits, then
/// the differences, those of outer groups first.
pub fn symmetric_coordinates(scene: &Scene) -> Vec<Coordinate> {
    let mut differences = Vec::new();
    let below = Below::new(scene);
    let strands = match scene.links.iter().position(|link| link.parent.is_none()) {
        Some(root) => descend(scene, &below, LinkId(root), &mut differences),
        None => Vec::new(),
    };
    let mut means: Vec<Coordinate> = strands
        .into_iter()
        .map(|strand| Coordinate {
            name: String::new(),
            kind: CoordinateKind::Mean {
                orbit: strand.orbit,
            },
            weights: strand.links.into_iter().map(|link| (link, 1)).collect(),
        })
        .collect();
    means.sort_by_key(|c| c.weights[0].0);
    differences.sort_by_key(|c: &Coordinate| match c.kind {
        CoordinateKind::Difference { group, index, .. } => (group, index, c.weights[0].0),
        CoordinateKind::Mean { .. } => (0, 0, c.weights[0].0),
    });
    let mut all = means;
    all.append(&mut differences);
    name_coordinates(scene, &mut all);
    all
}

/// Children, and groups of copies, below each link.
struct Below<'a> {
    children: Vec<Vec<LinkId>>,
    groups: Vec<Vec<(usize, &'a Group)>>,
}

impl<'a> Below<'a> {
    fn new(scene: &'a Scene) -> Self {
        let mut children = vec![Vec::new(); scene.links.len()];
        for (index, link) in scene.links.iter().enumerate() {
            if let Some(LinkId(parent)) = link.parent {
                children[parent].push(LinkId(index));
            }
        }
        let mut groups = vec![Vec::new(); scene.links.len()];
        for (number, group) in scene.groups.iter().enumerate() {
            if let Some(LinkId(parent)) = group.parent {
                groups[parent].push((number, group));
            }
        }
        Self { children, groups }
    }
}

/// Returns the strands (links of one orbit, in order) of the subtree at `link`, and adds the
/// differences of the groups in it to `differences`.
fn descend(
    scene: &Scene,
    below: &Below<'_>,
    link: LinkId,
    differences: &mut Vec<Coordinate>,
) -> Vec<Strand> {
    let mut strands = vec![Strand {
        orbit: scene.links[link.0].orbit,
        links: vec![link],
    }];
    let groups = &below.groups[link.0];
    for &child in &below.children[link.0] {
        match groups.iter().find(|(_, g)| g.copies.contains(&child)) {
            None => strands.extend(descend(scene, below, child, differences)),
            Some((number, group)) if group.copies[0] == child => {
                let copies: Vec<Vec<Strand>> = group
                    .copies
                    .iter()
                    .map(|&copy| descend(scene, below, copy, differences))
                    .collect();
                strands.extend(combine(*number, copies, differences));
            }
            Some(_) => {}
        }
    }
    strands
}

/// Joins the strands of a group's copies into one strand per orbit, whose mean is a coordinate, and
/// adds Helmert differences: difference r has the weight 1 for the first r copies and −r for the
/// next one.
fn combine(
    group: usize,
    copies: Vec<Vec<Strand>>,
    differences: &mut Vec<Coordinate>,
) -> Vec<Strand> {
    let count = copies.len();
    let mut joined: Vec<Strand> = Vec::new();
    let mut by_orbit: BTreeMap<usize, Vec<Vec<LinkId>>> = BTreeMap::new();
    for strands in copies {
        for (position, strand) in strands.into_iter().enumerate() {
            by_orbit
                .entry(position)
                .or_default()
                .push(strand.links.clone());
            match joined.get_mut(position) {
                Some(whole) => whole.links.extend(strand.links),
                None => joined.push(strand),
            }
        }
    }
    for (position, parts) in by_orbit {
        for index in 1..count {
            let mut weights = Vec::new();
            for (copy, links) in parts.iter().enumerate().take(index + 1) {
                let weight = if copy < index { 1 } else { -(index as i64) };
                weights.extend(links.iter().map(|&link| (link, weight)));
            }
            differences.push(Coordinate {
                name: String::new(),
                kind: CoordinateKind::Difference {
                    group,
                    index,
                    orbit: joined[position].orbit,
                    norm: (index * (index + 1)) as i64,
                },
                weights,
            });
        }
    }
    joined
}

/// Names the coordinates: `m` and `d` for a single pair of leaves, the paper's case. Otherwise the
/// name is that of the node with the position of the branching: `child_m`, `hand_d` between arms,
/// `hand_1_d` between the hands of arm 1, `child_d2` for a second difference.
fn name_coordinates(scene: &Scene, coordinates: &mut [Coordinate]) {
    let groups = scene.groups.len();
    let one_strand = groups == 1
        && scene.groups[0]
            .copies
            .iter()
            .all(|&copy| scene.links.iter().all(|link| link.parent != Some(copy)));
    let link_names: BTreeSet<&String> = scene.links.iter().map(|l| &l.name).collect();
    for coordinate in coordinates.iter_mut() {
        coordinate.name = match &coordinate.kind {
            CoordinateKind::Mean { orbit } => match (coordinate.weights.as_slice(), one_strand) {
                ([(link, _)], _) => scene.links[link.0].name.clone(),
                (_, true) => "m".into(),
                _ => format!("{}_m", scene.orbits[orbit.0].node),
            },
            CoordinateKind::Difference {
                group,
                index,
                orbit,
                ..
            } => {
                let group = &scene.groups[*group];
                let number = if group.copies.len() > 2 {
                    index.to_string()
                } else {
                    String::new()
                };
                if one_strand {
                    format!("d{number}")
                } else {
                    let root = &scene.orbits[scene.links[group.copies[0].0].orbit.0].node;
                    let place = group.name.strip_prefix(root.as_str()).unwrap_or("");
                    format!("{}{place}_d{number}", scene.orbits[orbit.0].node)
                }
            }
        };
        // If a link is called `m`, its angle keeps that name.
        while coordinate.weights.len() > 1 && link_names.contains(&coordinate.name) {
            coordinate.name.push('_');
        }
    }
}
