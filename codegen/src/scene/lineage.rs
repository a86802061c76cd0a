//! Lineages: trees in which one branching of each generation is open.

/// Order of the links of a full binary tree in which one branching of each generation is open and
/// all other copies move in phase.
///
/// The *open path* leads from the root through one link of each generation. Of the two links of
/// generation s on the open path's link of generation s − 1, one continues the path; from the other,
/// the *closed* one, hangs a chain of links. The link of generation g in this chain represents
/// 2^(g − s) copies. There are N (N + 1)/2 links in N generations.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Lineage {
    /// Number of generations, at least two.
    pub generations: usize,
}

impl Lineage {
    /// Returns the index of the link of this generation on the open path; the root is generation 0.
    pub fn open(self, generation: usize) -> usize {
        generation
    }

    /// Returns the index of the link of this generation in the chain that is closed at the branching into
    /// generation `branching`, which is at least 1 and at most `generation`.
    pub fn closed(self, branching: usize, generation: usize) -> usize {
        // The chains follow the path, the youngest first; one has `later` + 1 links.
        let later = self.generations - 1 - branching;
        self.generations + later * (later + 1) / 2 + (generation - branching)
    }

    /// Returns the number of copies in the full tree that the link of this generation in that chain
    /// represents.
    pub fn copies(self, branching: usize, generation: usize) -> usize {
        1 << (generation - branching)
    }
}
