//! Pairs of links that are connected by spring-dampers.

use super::layout::Layout;
use super::{Coordinate, Lineage, LinkId, OrbitId, Scene};

/// Links that a spring-damper connects.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum SpringDamperEnds {
    /// Two links. If the code is loops over generations, these are indices in the whole tree.
    Links([LinkId; 2]),
    /// All pairs of copies of the node of this name that hang from the same link.
    Siblings(String),
}

/// Two links connected by a spring-damper.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LinkPair {
    /// Index of the spring-damper in [`Scene::spring_dampers`].
    pub spring_damper: usize,
    /// The two connected links.
    pub links: [LinkId; 2],
}

impl LinkPair {
    /// Returns the weights of symmetric coordinates in the difference of the two angles, by the
    /// index of the coordinate; zero weights are left out.
    pub fn weights(&self, coordinates: &[Coordinate]) -> Vec<(usize, i64)> {
        let weight = |coordinate: &Coordinate, link: LinkId| {
            let mut own = coordinate.weights.iter();
            own.find(|(known, _)| *known == link)
                .map_or(0, |(_, weight)| *weight)
        };
        let [a, b] = self.links;
        let weights = coordinates
            .iter()
            .enumerate()
            .map(|(index, coordinate)| (index, weight(coordinate, a) - weight(coordinate, b)));
        weights.filter(|(_, weight)| *weight != 0).collect()
    }
}

/// Consecutive pairs of links: in each pair both indices are larger by one than in the pair before.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PairRun {
    /// First pair, as indices of links in the whole tree.
    pub first: [usize; 2],
    /// Number of pairs in the run.
    pub count: usize,
}

impl PairRun {
    /// Returns all pairs of the run.
    pub(super) fn pairs(self) -> impl Iterator<Item = [usize; 2]> {
        (0..self.count).map(move |place| self.first.map(|link| link + place))
    }
}

impl Scene {
    /// Returns all pairs of links that spring-dampers connect. Valid unless the code is loops over
    /// generations.
    pub fn link_pairs(&self) -> Vec<LinkPair> {
        let all = self.spring_dampers.iter().enumerate();
        let pairs = all.flat_map(|(spring_damper, own)| {
            let runs = self.pair_runs(&own.ends).into_iter();
            runs.flat_map(PairRun::pairs).map(move |links| LinkPair {
                spring_damper,
                links: links.map(LinkId),
            })
        });
        pairs.collect()
    }

    /// Returns true if a spring or damper connects two points, or two links that are not parent and
    /// child.
    pub fn is_coupled(&self) -> bool {
        let mut spring_dampers = self.spring_dampers.iter();
        let between = spring_dampers.any(|own| !self.pair_runs(&own.ends).is_empty());
        between || !self.translational.is_empty()
    }

    /// Returns the pairs of links that a spring-damper connects. The list is empty if they are
    /// identical copies that move in phase and are therefore a single link of the scene.
    pub fn pair_runs(&self, ends: &SpringDamperEnds) -> Vec<PairRun> {
        match (ends, self.layout) {
            (SpringDamperEnds::Links([LinkId(a), LinkId(b)]), _) => vec![PairRun {
                first: [*a, *b],
                count: 1,
            }],
            (SpringDamperEnds::Siblings(node), Layout::Generations { branching, .. }) => {
                self.pairs_of_generation(node, branching)
            }
            (SpringDamperEnds::Siblings(node), Layout::Unrolled | Layout::Links) => {
                if let Some(lineage) = self.lineage {
                    return self.open_pair(node, lineage).into_iter().collect();
                }
                let families = self.copies_of(node);
                let runs = families.flat_map(|copies| {
                    two_by_two(copies.len()).map(|[a, b]| PairRun {
                        first: [copies[a].0, copies[b].0],
                        count: 1,
                    })
                });
                runs.collect()
            }
        }
    }

    /// Returns the pairs of siblings in the generation of the given node. Of two consecutive
    /// generations the upper one has n links; copy c under its link i has the number c n + i in the
    /// lower one.
    fn pairs_of_generation(&self, node: &str, branching: usize) -> Vec<PairRun> {
        let (mut start, mut above) = (1, 1);
        for link in self.links.iter().skip(1) {
            if self.orbits[link.orbit.0].node == node {
                let runs = two_by_two(branching).map(|copies| PairRun {
                    first: copies.map(|copy| start + copy * above),
                    count: above,
                });
                return runs.collect();
            }
            above *= branching;
            start += above;
        }
        Vec::new()
    }

    /// Returns the two links of a generation that the open path's link above them carries. All other
    /// siblings of that generation move in phase.
    fn open_pair(&self, node: &str, lineage: Lineage) -> Option<PairRun> {
        let orbit = self.orbits.iter().find(|orbit| orbit.node == node)?;
        let own = orbit.depth;
        (own > 0).then(|| PairRun {
            first: [lineage.open(own), lineage.closed(own, own)],
            count: 1,
        })
    }

    /// Returns the copies of a node, one list for each link from which they hang.
    fn copies_of<'a>(&'a self, node: &'a str) -> impl Iterator<Item = &'a [LinkId]> {
        let node_of = |link: LinkId| {
            let OrbitId(orbit) = self.links.get(link.0)?.orbit;
            Some(self.orbits.get(orbit)?.node.as_str())
        };
        let groups = self.groups.iter().map(|group| group.copies.as_slice());
        groups.filter(move |copies| copies.first().and_then(|&first| node_of(first)) == Some(node))
    }
}

/// Returns all pairs of numbers from 0 to `copies` − 1.
fn two_by_two(copies: usize) -> impl Iterator<Item = [usize; 2]> {
    (0..copies).flat_map(move |first| (first + 1..copies).map(move |other| [first, other]))
}
