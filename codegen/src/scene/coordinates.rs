//! Symmetric coordinates (physics §3): for copies side by side, their mean and their
//! orthogonal differences, from the leaves up. Copies that differ have the same ones.

use super::{Group, LinkId, OrbitId, Scene};
use std::collections::{BTreeMap, BTreeSet};

/// Place of a symmetric coordinate in the tree.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum CoordinateKind {
    /// Mean angle of all copies of a node; the link's own angle where there is one.
    Mean {
        /// The orbit of the first of them.
        orbit: OrbitId,
    },
    /// Difference number `index` (from 1) between the copies of a group, in
    /// one orbit below its node.
    Difference {
        /// Index of the group in the scene.
        group: usize,
        /// Number of the difference, 1 to copies − 1.
        index: usize,
        /// The orbit of the first of the links.
        orbit: OrbitId,
        /// Σ of the squared weights: the factor between the mass matrix of one
        /// copy and that of the difference (2 for a pair).
        norm: i64,
    },
}

impl CoordinateKind {
    /// Index of the orbit, and which of its coordinates: `None` for the mean,
    /// group and number for a difference.
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

/// One symmetric coordinate: θ_link = Σ weight · coordinate.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Coordinate {
    /// Short name; `theta_` and `p_` stand before it in code.
    pub name: String,
    /// Mean or difference.
    pub kind: CoordinateKind,
    /// Weight of this coordinate in the angle of each link; links without it
    /// are left out. Columns of different coordinates are orthogonal.
    pub weights: Vec<(LinkId, i64)>,
}

impl Coordinate {
    /// Σ of the squared weights, by which the inverse transform divides.
    pub fn norm(&self) -> i64 {
        self.weights.iter().map(|(_, w)| w * w).sum()
    }
}

/// The links of one orbit below a node, in the order of copies.
struct Strand {
    orbit: OrbitId,
    links: Vec<LinkId>,
}

/// The symmetric coordinates of a scene: means in the order of the orbits,
/// then differences, outer groups first.
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

/// What hangs from each link.
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

/// Strands of the subtree at `link`; differences met on the way are added.
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

/// Joins the strands of the copies of a group into means, and records the
/// Helmert differences: difference r weighs the first r copies with 1 and the
/// next one with −r.
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

/// `m` and `d` in the paper's case of one pair of leaves; otherwise the
/// orbit's name and where the branching is: `child_m`, `hand_d` between arms,
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
        // A link may be called `m`; its angle keeps that name.
        while coordinate.weights.len() > 1 && link_names.contains(&coordinate.name) {
            coordinate.name.push('_');
        }
    }
}
