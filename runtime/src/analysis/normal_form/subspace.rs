//! Subspaces of in-phase motions, with one difference between copies.

use crate::analysis::variational::Copies;

/// Coordinates of motions in which copies are in phase, and of small differences between two of
/// them: directions in the angles of all links.
#[derive(Clone, Debug, PartialEq)]
pub struct MotionSubspace {
    pub(super) links: usize,
    /// Number of coordinates of the in-phase motion, which come first.
    pub(super) in_phase: usize,
    /// For each direction, the links that move in it and their angles for one unit of the
    /// coordinate.
    pub(super) directions: Vec<Vec<(usize, f64)>>,
}

impl MotionSubspace {
    /// Returns the subspace that contains all motions: one coordinate per link, and no differences.
    pub fn whole(links: usize) -> Self {
        Self {
            links,
            in_phase: links,
            directions: (0..links).map(|link| vec![(link, 1.0)]).collect(),
        }
    }

    /// Returns the subspace of a tree of `links` links in which all copies of both lists are in
    /// phase, plus the differences between the first two copies of `differing`: half the difference
    /// between their angles, and between the angles of the links below them. Groups of [`Copies`]
    /// list angles first, then angular velocities.
    pub fn of_copies(links: usize, in_phase: &Copies, differing: &Copies) -> Self {
        let mut class: Vec<usize> = (0..links).collect();
        let groups = in_phase.groups().iter().chain(differing.groups());
        for group in groups.filter(|group| group.iter().all(|link| *link < links)) {
            let joined: Vec<usize> = group.iter().map(|link| class[*link]).collect();
            let least = joined.iter().copied().min().unwrap_or(0);
            for own in class.iter_mut().filter(|own| joined.contains(own)) {
                *own = least;
            }
        }
        let classes: Vec<usize> = (0..links).filter(|link| class[*link] == *link).collect();
        let members = |own: &usize| -> Vec<(usize, f64)> {
            let members = (0..links).filter(|link| class[*link] == *own);
            members.map(|link| (link, 1.0)).collect()
        };
        let mut directions: Vec<Vec<(usize, f64)>> = classes.iter().map(members).collect();
        let own_groups = || {
            let groups = differing.groups().iter();
            groups.filter(|group| group.iter().all(|link| *link < links))
        };
        let difference = |own: &usize| {
            let mut direction = Vec::new();
            for group in own_groups() {
                if let [one, other, ..] = **group
                    && class[one] == *own
                {
                    direction.extend([(one, 1.0), (other, -1.0)]);
                }
            }
            direction
        };
        let count = directions.len();
        let differences = classes.iter().map(difference);
        directions.extend(differences.filter(|direction| !direction.is_empty()));
        Self {
            links,
            in_phase: count,
            directions,
        }
    }

    /// Returns the number of coordinates of the in-phase motion.
    pub fn in_phase(&self) -> usize {
        self.in_phase
    }

    /// Returns the number of differences.
    pub fn differences(&self) -> usize {
        self.directions.len() - self.in_phase
    }

    /// Returns the in-phase coordinates for angles or angular velocities of all links: the values
    /// of the first link of each group of copies. NaN for missing links.
    pub fn coordinates(&self, angles: &[f64]) -> Vec<f64> {
        let own = self.directions.iter().take(self.in_phase);
        let first = own.map(|direction| direction.first().and_then(|(link, _)| angles.get(*link)));
        first
            .map(|angle| angle.copied().unwrap_or(f64::NAN))
            .collect()
    }
}
