//! The tree that is driven, and its scales.

use branched_pendulum::sectors::{Sector, Sectors, degrees_of_freedom};
use branched_pendulum::system::{Model, Positions};
use branched_pendulum::tree::MOST_GENERATIONS;

use crate::Failure;
use crate::subject::Subject;

/// Returns the description of a tree by rule: each rod carries `branching` lighter and shorter
/// ones. The parameter `friction` is that of the youngest pivots, `sibling_friction` that between
/// each two of the youngest rods on one.
pub fn by_rule(generations: u32, branching: u32) -> String {
    let above = vec!["friction_ratio"; generations.saturating_sub(1) as usize].join(" * ");
    let friction = match above.as_str() {
        "" => "friction".to_owned(),
        "friction_ratio" => "friction / friction_ratio".to_owned(),
        above => format!("friction / ({above})"),
    };
    format!(
        "// Rods by rule, each with {branching} lighter and shorter ones; the friction is that of \
         the youngest.\n\
         gravity = gravity,\n\
         arm: generations(count = {generations}, branching = {branching}, shape = rod, mass = 0.12, \
         length = 0.3,\n    \
         mass_ratio = mass_ratio, length_ratio = length_ratio,\n    \
         friction = {friction},\n    \
         friction_ratio = friction_ratio),\n\
         siblings(arm_{generations}, friction = sibling_friction)\n"
    )
}

/// A tree whose energies are known by scale.
#[derive(Clone, Debug)]
pub struct DrivenTree {
    /// The tree with its name.
    pub subject: Subject,
    /// Copies of each generation under each link of the one before, 1 for the root.
    pub copies: Vec<usize>,
    /// Length of a link of each generation, m.
    pub lengths: Vec<f64>,
    /// Mass of all links of each generation together, kg.
    pub masses: Vec<f64>,
}

impl DrivenTree {
    /// Returns the tree with its scales.
    ///
    /// # Errors
    /// [`Failure::Lacking`] of a tree that has no scales, with what to write.
    pub fn new(subject: Subject) -> Result<Self, Failure> {
        let (tree, name) = (&subject.tree, &subject.name);
        let lacking = |why: &str| Failure::Lacking {
            what: format!(
                "`{name}` has no scales, {why}: write equal subtrees once, as in `stem(...) \
                 [arm(...) * 2]`, or by `generations(count = 4, branching = 2, ...)`"
            ),
        };
        if let Some(what) = tree.description().springs_across_scales().next() {
            return Err(Failure::Lacking {
                what: format!(
                    "`{name}` has no scales: the spring `{what}` belongs to none; leave it out, or \
                     write `siblings(NODE, spring = ...)`"
                ),
            });
        }
        let copies = tree.copies().ok_or_else(|| {
            lacking("since links of one generation differ, or have not as many children")
        })?;
        if copies.iter().all(|&copies| copies == 1) {
            return Err(lacking("since there are no copies"));
        }
        if copies.len() > MOST_GENERATIONS {
            return Err(Failure::Lacking {
                what: format!(
                    "`{name}` has {} generations, and energies are known by scale of up to \
                     {MOST_GENERATIONS}",
                    copies.len()
                ),
            });
        }
        let depths = depths(&subject);
        let length = |generation: usize| {
            let link = depths.iter().position(|&depth| depth == generation)?;
            Some(tree.properties_of(link)?.length())
        };
        let lengths = (0..copies.len()).map_while(length).collect();
        let mut masses = vec![0.0; copies.len()];
        for (link, &depth) in depths.iter().enumerate() {
            if let (Some(sum), Some(own)) = (masses.get_mut(depth), tree.properties_of(link)) {
                *sum += own.mass;
            }
        }
        Ok(Self {
            copies: copies.to_vec(),
            lengths,
            masses,
            subject,
        })
    }

    /// Number of generations, and of scales.
    pub fn generations(&self) -> usize {
        self.copies.len()
    }

    /// Number of links.
    pub fn links(&self) -> usize {
        self.subject.tree.links()
    }

    /// Degrees of freedom of a scale: 0 the means, s the differences between links of
    /// generation s under one parent, with all that hangs from them.
    pub fn degrees_of_freedom(&self, scale: usize) -> usize {
        degrees_of_freedom(&self.copies, scale)
    }
}

/// Returns the generation of each link, 0 for the root.
pub fn depths(subject: &Subject) -> Vec<usize> {
    let mut depths: Vec<usize> = Vec::new();
    for parent in subject.parents() {
        let above = parent.and_then(|parent| depths.get(parent));
        depths.push(above.map_or(0, |depth| depth + 1));
    }
    depths
}

/// Returns the scale of each sector: 0 of the means, else the generation of the links that differ.
pub fn scales_of_sectors(subject: &Subject) -> Vec<usize> {
    let depths = depths(subject);
    let sectors = subject.tree.sectors().iter().enumerate();
    let scale = |(number, sector): (usize, &Sector)| {
        let first = sector.coordinates().first().filter(|_| number > 0)?;
        let (link, _) = first.weights().first()?;
        depths.get(*link).copied()
    };
    sectors.map(|sector| scale(sector).unwrap_or(0)).collect()
}

#[cfg(test)]
mod tests {
    use super::{DrivenTree, by_rule, scales_of_sectors};
    use crate::commands::cascade::Arguments;
    use crate::frame::command_line::parse_line;

    fn tree(line: &str) -> DrivenTree {
        let arguments: Arguments = parse_line(line).unwrap();
        DrivenTree::new(arguments.read().unwrap()).unwrap()
    }

    #[test]
    fn the_shipped_tree_is_that_by_rule() {
        assert_eq!(by_rule(5, 2), include_str!("../../../trees/cascade.txt"));
        assert_eq!(tree("").copies, [1, 2, 2, 2, 2]);
        let few = tree("--generations 2 --branching 3");
        assert_eq!((few.copies.as_slice(), few.links()), (&[1, 3][..], 4));
        assert!((few.lengths[1] / few.lengths[0] - 0.7).abs() < 1e-15);
    }

    #[test]
    fn sectors_have_the_scale_at_which_they_branch() {
        let tree = tree("--generations 4");
        assert_eq!(scales_of_sectors(&tree.subject), [0, 1, 2, 3, 3, 2, 3, 3]);
        let freedoms: Vec<usize> = (0..4).map(|scale| tree.degrees_of_freedom(scale)).collect();
        assert_eq!(freedoms, [4, 3, 4, 4]);
    }
}
