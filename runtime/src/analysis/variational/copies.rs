//! Groups of copies that move in phase, and the two kinds of deviations from such motions.

use crate::sectors::{Sector, SectorCoordinate};
use crate::system::{Ode, State};

/// Largest relative difference between rates of copies that counts as rounding.
const RATE_ROUNDING: f64 = 1e-12;

/// Largest change of a component between the start and the second state at which copies are
/// compared.
const LARGEST_CHANGE: f64 = 0.3;

/// Copies, described as groups of components of a state: the components of a group are equal while
/// the copies move in phase.
///
/// States in phase are an invariant subspace: a motion that starts in it stays in it. Small
/// deviations from such a motion are of two kinds, of which neither drives the other: those that
/// are equal in all copies, *within* the subspace, and differences between copies, *transverse* to
/// it.
///
/// # Examples
///
/// ```
/// use branched_pendulum::analysis::variational::Copies;
///
/// // A root that carries two arms, each of which carries two hands.
/// let parents = [None, Some(0), Some(1), Some(1), Some(0), Some(4), Some(4)];
/// let arms = Copies::of_links(&parents, &[&[1, 4]]).unwrap();
/// // Angles, then angular velocities.
/// assert_eq!(arms.groups()[..3], [[1, 4], [2, 5], [3, 6]]);
/// let all = Copies::of_links(&parents, &[&[1, 4], &[2, 3]]).unwrap();
/// assert_eq!(all.groups()[..2], [vec![1, 4], vec![2, 3, 5, 6]]);
/// // An arm is not a copy of a hand.
/// assert_eq!(Copies::of_links(&parents, &[&[1, 2]]), None);
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Copies {
    groups: Vec<Vec<usize>>,
}

impl Copies {
    /// Creates copies from groups of indices of components. Components of a group are equal in
    /// phase; no component may be in two groups.
    pub fn new(groups: Vec<Vec<usize>>) -> Self {
        Self { groups }
    }

    /// Returns the groups of components for links that are copies of each other, each with its
    /// whole subtree. The state is the angles followed by the angular velocities. Each entry of
    /// `alike` lists the indices of links that are copies of each other. `parents` has the index of
    /// each link's parent, which is smaller than the link's.
    ///
    /// Returns `None` if one link of a list is in the subtree of another, or if their subtrees
    /// differ in their number of links.
    pub fn of_links(parents: &[Option<usize>], alike: &[&[usize]]) -> Option<Self> {
        let links = parents.len();
        // For each link, the first link that it is a copy of.
        let mut first: Vec<usize> = (0..links).collect();
        for set in alike {
            let carried: Vec<Vec<usize>> = set.iter().map(|&link| carried(parents, link)).collect();
            let mut all = carried.concat();
            let count = all.len();
            all.sort_unstable();
            all.dedup();
            let length = carried.first()?.len();
            let are_apart = all.len() == count && all.last().is_some_and(|last| *last < links);
            if !are_apart || carried.iter().any(|own| own.len() != length) {
                return None;
            }
            for place in 0..length {
                let joined: Vec<usize> = carried.iter().map(|own| first[own[place]]).collect();
                let least = joined.iter().copied().min()?;
                for own in first.iter_mut().filter(|own| joined.contains(own)) {
                    *own = least;
                }
            }
        }
        let of = |own: usize| (0..links).filter(|&link| first[link] == own).collect();
        let angles: Vec<Vec<usize>> = (0..links)
            .map(of)
            .filter(|g: &Vec<_>| g.len() > 1)
            .collect();
        let rates = angles
            .iter()
            .map(|group| group.iter().map(|link| links + link).collect());
        Some(Self::new(angles.iter().cloned().chain(rates).collect()))
    }

    /// Returns the groups. For links, the groups of angles come first, from the root on, then those
    /// of angular velocities.
    pub fn groups(&self) -> &[Vec<usize>] {
        &self.groups
    }

    /// Returns the number of independent differences between the copies.
    pub fn differences(&self) -> usize {
        let beside = self
            .groups
            .iter()
            .map(|group| group.len().saturating_sub(1));
        beside.sum()
    }

    /// Returns a deviation with `dimension` components in which the first two copies deviate in
    /// opposite directions: 1 and −1 in the first group, which for links consists of the angles of
    /// the topmost copies.
    pub fn opposite(&self, dimension: usize) -> Vec<f64> {
        let mut deviation = vec![0.0; dimension];
        let components = self.groups.first().into_iter().flatten();
        for (&component, value) in components.zip([1.0, -1.0]) {
            write(&mut deviation, component, value);
        }
        deviation
    }

    /// Returns the differences between the first two copies as a sector. For links these are the
    /// differences of their angles, and of all angles in their subtrees.
    pub fn first_difference(&self) -> Sector {
        let angles = self.groups.iter().take(self.groups.len() / 2);
        let coordinates = angles.filter_map(|group| {
            let (&one, &other) = group.first().zip(group.get(1))?;
            let weights = vec![(one, 1.0), (other, -1.0)];
            Some(SectorCoordinate::new(format!("theta_{one}_d"), weights))
        });
        Sector::new("d".to_owned(), coordinates.collect())
    }

    /// Returns true if the copies have equal states at the start and equal rates in `system`, to
    /// rounding. Rates are compared at the start and at a second state with nonzero velocities,
    /// because friction has no effect at rest. States with NaN count as equal.
    pub fn are_in_phase<O: Ode<f64> + ?Sized>(&self, system: &O, start: &State<f64>) -> bool {
        let mut moving = start.clone();
        // Changes all copies by the same amount, and other components by different ones.
        let mut ways: Vec<usize> = (0..moving.values.len()).collect();
        for group in &self.groups {
            for &component in group {
                if let (Some(own), Some(&first)) = (ways.get_mut(component), group.first()) {
                    *own = first;
                }
            }
        }
        for (value, way) in moving.values.iter_mut().zip(ways) {
            *value += LARGEST_CHANGE * (1.0 + way as f64).sin();
        }
        let mut states = [start, &moving].into_iter();
        states.all(|state| self.move_identically(system, state))
    }

    fn move_identically<O: Ode<f64> + ?Sized>(&self, system: &O, start: &State<f64>) -> bool {
        let state = &start.values;
        let mut rates = vec![0.0; state.len()];
        system.rates(start.time, state, &mut rates);
        let size = rates
            .iter()
            .fold(0.0_f64, |size, rate| size.max(rate.abs()));
        let difference = |values: &[f64], one: usize, other: usize| -> Option<f64> {
            Some((values.get(one)? - values.get(other)?).abs())
        };
        let differ = |(&one, &other): (&usize, &usize)| {
            let own = difference(state, one, other);
            let both = own.zip(difference(&rates, one, other));
            both.is_none_or(|(own, rate)| own > 0.0 || rate > RATE_ROUNDING * size)
        };
        let pairs = |group: &Vec<usize>| group.iter().zip(group.iter().skip(1)).any(differ);
        !self.groups.iter().any(pairs)
    }

    /// Replaces the values of copies by their mean; other components stay unchanged. Values that
    /// are equal keep all of their bits.
    pub(in crate::analysis) fn keep_common(&self, values: &mut [f64]) {
        for group in &self.groups {
            let mean = group.first().map(|&one| {
                let apart = apart(values, group, one);
                values.get(one).map_or(f64::NAN, |own| own - apart)
            });
            for &one in group {
                write(values, one, mean.unwrap_or(f64::NAN));
            }
        }
    }

    /// Writes the differences of copies from their mean, and zero for other components. The
    /// differences of two copies are exactly opposite.
    pub(in crate::analysis) fn write_differences(&self, of: &[f64], differences: &mut [f64]) {
        differences.fill(0.0);
        for group in &self.groups {
            for &one in group {
                write(differences, one, apart(of, group, one));
            }
        }
    }
}

/// Returns the difference between a component and the mean of its group. It is computed from
/// differences of values, so that their common part causes no rounding. NaN if there is no such
/// component.
fn apart(values: &[f64], group: &[usize], one: usize) -> f64 {
    let at = |component: usize| values.get(component).copied().unwrap_or(f64::NAN);
    let all = group.iter().map(|&other| at(one) - at(other));
    all.sum::<f64>() / group.len() as f64
}

fn write(values: &mut [f64], component: usize, value: f64) {
    if let Some(place) = values.get_mut(component) {
        *place = value;
    }
}

/// Returns the indices of a link and of all links below it.
fn carried(parents: &[Option<usize>], link: usize) -> Vec<usize> {
    let mut own = vec![link];
    for (link, parent) in parents.iter().enumerate() {
        if parent.is_some_and(|parent| own.contains(&parent)) {
            own.push(link);
        }
    }
    own
}
