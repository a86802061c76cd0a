//! The pairs of links that spring-dampers act between.

use super::layout::Layout;
use super::{Coordinate, LinkId, OrbitId, Scene};

/// The links of a spring-damper.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum SpringDamperEnds {
    /// Two links; where the code is loops over generations, by their index in the whole tree.
    Links([LinkId; 2]),
    /// All copies of the node of that name under one link, two by two.
    Siblings(String),
}

/// Two links that a spring-damper acts between.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LinkPair {
    /// Index of the spring-damper in [`Scene::spring_dampers`].
    pub spring_damper: usize,
    /// The links.
    pub links: [LinkId; 2],
}

impl LinkPair {
    /// Weights of symmetric coordinates in the difference of the links' angles, by their index.
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

/// Pairs of links that stand side by side: so many, each of the links behind those of the one
/// before.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PairRun {
    /// The first pair, by the links' indices in the whole tree.
    pub first: [usize; 2],
    /// Number of pairs.
    pub count: usize,
}

impl PairRun {
    /// All pairs.
    pub(super) fn pairs(self) -> impl Iterator<Item = [usize; 2]> {
        (0..self.count).map(move |place| self.first.map(|link| link + place))
    }
}

impl Scene {
    /// The links that spring-dampers act between, two by two, where the code is not loops over
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

    /// Returns true if something acts between links that are not parent and child, or along a line.
    pub fn is_coupled(&self) -> bool {
        let mut spring_dampers = self.spring_dampers.iter();
        let between = spring_dampers.any(|own| !self.pair_runs(&own.ends).is_empty());
        between || !self.translational.is_empty()
    }

    /// The pairs of links that one acts between; none of copies that one link stands for.
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

    /// Pairs of siblings of a generation. Copy c under link i of the n above is number c n + i
    /// of it.
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

    /// The copies of a node under each link.
    fn copies_of<'a>(&'a self, node: &'a str) -> impl Iterator<Item = &'a [LinkId]> {
        let node_of = |link: LinkId| {
            let OrbitId(orbit) = self.links.get(link.0)?.orbit;
            Some(self.orbits.get(orbit)?.node.as_str())
        };
        let groups = self.groups.iter().map(|group| group.copies.as_slice());
        groups.filter(move |copies| copies.first().and_then(|&first| node_of(first)) == Some(node))
    }
}

/// Every two of so many copies.
fn two_by_two(copies: usize) -> impl Iterator<Item = [usize; 2]> {
    (0..copies).flat_map(move |first| (first + 1..copies).map(move |other| [first, other]))
}
