//! The driven tree, and its scales.

use branched_pendulum::sectors::{Sector, Sectors};
use branched_pendulum::system::{Model, Positions};
use branched_pendulum::tree::MOST_GENERATIONS;

use crate::Failure;
use crate::subject::Subject;

/// Returns the description of a rule-based tree, in which each rod carries `branching` lighter and
/// shorter rods. Its parameter `friction` is the friction in the youngest pivots,
/// `sibling_friction` the friction between each two of the youngest rods on the same rod. With
/// `open`, one branching of each generation is open.
pub fn by_rule(generations: u32, branching: u32, open: bool) -> String {
    let above = vec!["friction_ratio"; generations.saturating_sub(1) as usize].join(" * ");
    let friction = match above.as_str() {
        "" => "friction".to_owned(),
        "friction_ratio" => "friction / friction_ratio".to_owned(),
        above => format!("friction / ({above})"),
    };
    let open = if open { "open = 1, " } else { "" };
    format!(
        "// Rods by rule, each with {branching} lighter and shorter ones; the friction is that of \
         the youngest.\n\
         gravity = gravity,\n\
         arm: generations(count = {generations}, branching = {branching}, {open}shape = rod, mass = 0.12, \
         length = 0.3,\n    \
         mass_ratio = mass_ratio, length_ratio = length_ratio,\n    \
         friction = {friction},\n    \
         friction_ratio = friction_ratio),\n\
         siblings(arm_{generations}, friction = sibling_friction)\n"
    )
}

/// A tree whose energies can be computed by scale.
#[derive(Clone, Debug)]
pub struct DrivenTree {
    /// The tree with its name.
    pub subject: Subject,
    /// Degrees of freedom of each scale: 0 the means, s the differences between links of
    /// generation s under one parent, with all that hangs from them.
    pub freedoms: Vec<usize>,
    /// Length of a link of each generation, m.
    pub lengths: Vec<f64>,
    /// Mass of the links whose differences a scale holds, of the oldest generation alone, kg: all
    /// links of generation s, or those at the one open branching.
    pub masses: Vec<f64>,
    /// Mass of these links with everything that hangs from them, kg.
    pub subtrees: Vec<f64>,
}

impl DrivenTree {
    /// Creates the driven tree with its scales.
    ///
    /// # Errors
    /// [`Failure::Lacking`] if the tree has no scales, with a remedy.
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
                    "`{name}` has no scales, because the spring `{what}` couples them: leave it \
                     out, or write `siblings(NODE, spring = ...)`"
                ),
            });
        }
        let freedoms = tree.degrees_of_freedom_by_scale().ok_or_else(|| {
            lacking("because links of one generation differ, or have different numbers of children")
        })?;
        if freedoms.iter().skip(1).all(|&freedoms| freedoms == 0) {
            return Err(lacking("since there are no copies"));
        }
        if tree.lineage().is_none() && freedoms.len() > MOST_GENERATIONS {
            return Err(Failure::Lacking {
                what: format!(
                    "`{name}` has {} generations, but energies by scale are computed for at most \
                     {MOST_GENERATIONS}",
                    freedoms.len()
                ),
            });
        }
        let depths = depths(&subject);
        let length = |generation: usize| {
            let link = depths.iter().position(|&depth| depth == generation)?;
            Some(tree.properties_of(link)?.length())
        };
        let lengths = (0..freedoms.len()).map_while(length).collect();
        let of_generations: Vec<f64> = (0..freedoms.len())
            .map(|generation| {
                let links = (0..depths.len()).filter(|&link| depths[link] == generation);
                let own = links.filter_map(|link| tree.properties_of(link));
                own.map(|own| own.mass).sum()
            })
            .collect();
        // Of the open branching into generation s: a part 1/2^(s − 1) of each generation.
        let part = |scale: usize| match tree.lineage() {
            Some(_) => 0.5_f64.powi(scale.saturating_sub(1) as i32),
            None => 1.0,
        };
        let scales = || 0..freedoms.len();
        let masses = scales().map(|scale| part(scale) * of_generations[scale]);
        let subtrees =
            scales().map(|scale| part(scale) * of_generations[scale..].iter().sum::<f64>());
        Ok(Self {
            masses: masses.collect(),
            subtrees: subtrees.collect(),
            freedoms,
            lengths,
            subject,
        })
    }

    /// Returns the number of generations, which is also the number of scales.
    pub fn generations(&self) -> usize {
        self.freedoms.len()
    }

    /// Number of links.
    pub fn links(&self) -> usize {
        self.subject.tree.links()
    }

    /// Returns the number of degrees of freedom of a scale. Scale 0 is the means; scale s is the
    /// differences between links of generation s under one parent, including the links below them.
    pub fn degrees_of_freedom(&self, scale: usize) -> usize {
        self.freedoms.get(scale).copied().unwrap_or(0)
    }
}

/// Returns the generation of each link; the root's is 0.
pub fn depths(subject: &Subject) -> Vec<usize> {
    let mut depths: Vec<usize> = Vec::new();
    for parent in subject.parents() {
        let above = parent.and_then(|parent| depths.get(parent));
        depths.push(above.map_or(0, |depth| depth + 1));
    }
    depths
}

/// Returns the scale of each sector: 0 for the means, else the generation of the links that differ.
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
        assert_eq!(
            by_rule(5, 2, false),
            include_str!("../../../trees/cascade.txt")
        );
        assert_eq!(tree("").freedoms, [5, 4, 6, 8, 8]);
        let few = tree("--generations 2 --branching 3");
        assert_eq!((few.freedoms.as_slice(), few.links()), (&[2, 2][..], 4));
        assert!((few.lengths[1] / few.lengths[0] - 0.7).abs() < 1e-15);
    }

    #[test]
    fn a_lineage_has_one_branching_of_each_generation() {
        let own = tree("--generations 20 --open 1");
        let wanted: Vec<usize> = (1..=20).rev().collect();
        assert_eq!((own.links(), own.freedoms), (210, wanted));
        // The two youngest rods, and the subtrees of the two children of the root.
        let rod = 0.12 * 0.5_f64.powi(19);
        assert!((own.masses[19] / (2.0 * rod) - 1.0).abs() < 1e-14);
        assert!((own.subtrees[1] / (19.0 * 0.12) - 1.0).abs() < 1e-14);
    }

    #[test]
    fn sectors_have_the_scale_at_which_they_branch() {
        let tree = tree("--generations 4");
        assert_eq!(scales_of_sectors(&tree.subject), [0, 1, 2, 3, 3, 2, 3, 3]);
        let freedoms: Vec<usize> = (0..4).map(|scale| tree.degrees_of_freedom(scale)).collect();
        assert_eq!(freedoms, [4, 3, 4, 4]);
    }
}
