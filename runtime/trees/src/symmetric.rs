//! Symmetric coordinates of trees with identical branches, and the energy transfers between their
//! sectors.

use branched_pendulum::emitted::no_answer;
use branched_pendulum::scalar::{Double, Scalar};
use branched_pendulum::sectors::{Normalisation, Sector, SectorCoordinate, Sectors};
use branched_pendulum::system::functions::SymmetricAccelerations;
use branched_pendulum::system::{At, Computes, Model, Pendulum, Workspace};
use branched_pendulum::transfer::{ChordSpring, RigidLink, SymmetricTree};
use branched_pendulum_codegen::scene::coordinates::symmetric_coordinates;
use branched_pendulum_codegen::scene::{self, Group, Layout, Link, LinkId, Orbit, OrbitId, Scene};

use crate::between::Between;
use crate::description::TreeDescription;
use crate::error::TreeError;
use crate::numbers::{self, LinkCopy, LinkNumbers};
use crate::tree::PendulumTree;

/// Symmetry of a tree with identical branches; it does not depend on the values of the constants.
#[derive(Debug)]
pub(crate) struct Symmetry {
    pub(crate) sectors: Vec<Sector>,
    /// For each node whose copies differ, all its links.
    unequal: Vec<Vec<usize>>,
    /// The copies under each link.
    groups: Vec<Group>,
}

impl Symmetry {
    pub(crate) fn of(scene: &Scene) -> Self {
        let whole = written_out(scene);
        let scene = whole.as_ref().unwrap_or(scene);
        let coordinates = symmetric_coordinates(scene);
        let listed = |index: &usize| {
            let coordinate = coordinates.get(*index)?;
            let weights = coordinate.weights.iter();
            let weights = weights.map(|&(LinkId(link), weight)| (link, weight as f64));
            let name = format!("theta_{}", coordinate.name);
            Some(SectorCoordinate::new(name, weights.collect()))
        };
        let sectors = scene::sectors(&coordinates).into_iter().map(|sector| {
            let own = sector.coordinates.iter().filter_map(listed);
            Sector::new(sector.name, own.collect())
        });
        let unequal = scene.unequal_nodes(&coordinates).into_iter();
        let unequal = unequal.map(|node| node.links.iter().map(|link| link.0).collect());
        Self {
            sectors: sectors.collect(),
            unequal: unequal.collect(),
            groups: scene.groups.clone(),
        }
    }
}

/// Returns a scene with all links, if the given scene has only one link of each generation; `None`
/// for other scenes. The links are in the order of [`numbers::links`], and the names are those of a
/// scene that is written out.
fn written_out(scene: &Scene) -> Option<Scene> {
    let Layout::Generations { .. } = scene.layout else {
        return None;
    };
    let (places, names) = (numbers::link_copies(scene), numbers::names(scene));
    let mut whole = scene.clone();
    whole.links.clear();
    whole.groups.clear();
    let orbits = scene.links.iter().enumerate().map(|(depth, link)| Orbit {
        name: link.name.clone(),
        node: link.name.clone(),
        depth,
        links: Vec::new(),
    });
    whole.orbits = orbits.collect();
    // Of each link the group of its children.
    let mut groups: Vec<Option<usize>> = vec![None; places.len()];
    for (index, (place, name)) in places.iter().zip(names).enumerate() {
        let LinkCopy { link, parent, copy } = *place;
        let own = scene.links.get(link)?;
        whole.orbits.get_mut(link)?.links.push(LinkId(index));
        if let (Some(_), Some(parent)) = (copy, parent) {
            let above = whole.links.get(parent)?.name.clone();
            let stem = &scene.links.get(link.checked_sub(1)?)?.name;
            let group = *groups.get_mut(parent)?.get_or_insert_with(|| {
                whole.groups.push(Group {
                    // The names of copies without their own number.
                    name: format!("{}{}", own.name, above.strip_prefix(stem).unwrap_or("")),
                    parent: Some(LinkId(parent)),
                    copies: Vec::new(),
                });
                whole.groups.len() - 1
            });
            whole.groups.get_mut(group)?.copies.push(LinkId(index));
        }
        whole.links.push(Link {
            name,
            parent: parent.map(LinkId),
            orbit: OrbitId(link),
            ..own.clone()
        });
    }
    Some(whole)
}

impl TreeDescription {
    /// Returns the tree in its symmetric coordinates with values for its parameters, for any type
    /// of numbers. It computes energies of sectors and the transfers W between them.
    ///
    /// # Errors
    /// As [`tree`](Self::tree), [`TreeError::NoCopies`], [`TreeError::CoupledSectors`] and
    /// [`TreeError::StraightSpring`].
    pub fn symmetric<T: Scalar>(
        &self,
        values: &[(&str, f64)],
    ) -> Result<SymmetricTree<T>, TreeError> {
        symmetric(self, &self.values(values)?, &Symmetry::of(&self.scene))
    }
}

fn symmetric<T: Scalar>(
    description: &TreeDescription,
    values: &[f64],
    symmetry: &Symmetry,
) -> Result<SymmetricTree<T>, TreeError> {
    if symmetry.groups.is_empty() {
        return Err(TreeError::NoCopies);
    }
    let scene = &description.scene;
    let tree = unchecked(description, values, symmetry)?;
    let parameters: Vec<Double> = values.iter().copied().map(Double::from_f64).collect();
    let springs = scene.chord_springs(&symmetry.groups).map_err(|other| {
        let mut other = other.keys();
        let first = other
            .next()
            .and_then(|&index| scene.translational.get(index));
        TreeError::StraightSpring {
            line: first.map_or_else(String::new, |own| own.in_words()),
        }
    })?;
    let springs = springs.iter().filter_map(|own| {
        let copies = symmetry.groups.get(own.group)?.copies.iter();
        Some(ChordSpring {
            copies: copies.map(|&LinkId(copy)| copy).collect(),
            strength: numbers::value(&own.strength, &parameters),
        })
    });
    let springs: Vec<ChordSpring<Double>> = springs.collect();
    tree.with_straight_springs(&springs)
        .ok_or(TreeError::NoCopies)
}

/// Returns the tree with all its sectors, even if these are only the means. Does not check straight
/// springs.
pub(crate) fn unchecked<T: Scalar>(
    description: &TreeDescription,
    values: &[f64],
    symmetry: &Symmetry,
) -> Result<SymmetricTree<T>, TreeError> {
    let scene = &description.scene;
    let parameters: Vec<Double> = values.iter().copied().map(Double::from_f64).collect();
    numbers::check(scene, &parameters)?;
    let links: Vec<RigidLink<Double>> = numbers::links(scene, &parameters)?
        .iter()
        .map(rigid)
        .collect();
    let gravity = numbers::value(&scene.gravity, &parameters);
    let Symmetry {
        sectors, unequal, ..
    } = symmetry;
    let tree = SymmetricTree::with_unequal_copies(&links, gravity, sectors, unequal);
    let tree = tree.ok_or(TreeError::NoCopies)?;
    let between = Between::of(scene, links.len(), &parameters);
    let tree = tree
        .with_spring_dampers(between.torsional)
        .ok_or(TreeError::CoupledSectors)?;
    Ok(tree.standing(scene.stands()))
}

fn rigid(link: &LinkNumbers) -> RigidLink<Double> {
    RigidLink {
        parent: link.parent,
        mass: link.mass,
        inertia: link.inertia,
        com: link.com,
        pivot: link.pivot,
        spring: link.passive.spring,
        rest: link.passive.rest,
        friction: link.passive.friction,
        drag: link.passive.drag,
        laws: link.passive.laws.map(numbers::law),
    }
}

impl PendulumTree<f64> {
    /// Returns the tree in its symmetric coordinates. It computes energies of sectors and the
    /// transfers W between them: exactly, by orders in the amplitude, and in the published form.
    ///
    /// # Errors
    /// [`TreeError::NoCopies`] if the tree has no identical branches, [`TreeError::CoupledSectors`]
    /// and [`TreeError::StraightSpring`] if springs couple sectors so that these have no separate
    /// energies.
    ///
    /// # Examples
    ///
    /// The transfer W into the antiphase mode during a motion of the paper's tree is the rate of
    /// change of its energy H_d.
    ///
    /// ```
    /// use branched_pendulum::prelude::*;
    /// use branched_pendulum::transfer::StateInput;
    /// use branched_pendulum::{Transfer, system::Workspace};
    /// use branched_pendulum_trees::{PendulumTree, TreeError};
    ///
    /// let tree = PendulumTree::parse(
    ///     "gravity = 9.80665,
    ///      parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
    ///          child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2
    ///      ]",
    /// )?;
    /// let symmetric = tree.symmetric()?;
    /// let d = symmetric.sector("d").unwrap();
    ///
    /// // H_d, and the integral of W by the trapezoidal rule.
    /// let mut workspace = Workspace::new();
    /// let (mut energies, mut w) = ([[0.0; 2]; 2], [Transfer::default(); 2]);
    /// let (mut sum, mut first, mut last, mut before) = (0.0, None, 0.0, 0.0);
    /// let start = State::at_rest(0.0, &[0.9, 0.11, -0.1]);
    /// let times: Vec<f64> = (0..=2000).map(|step| 1e-3 * f64::from(step)).collect();
    /// let method = Dop853::new(Options::with_tolerance(1e-12));
    /// method.sample(&AbsoluteAngles(&tree), &start, &times, |_, state| {
    ///     let (theta, omega) = state.split_at(3);
    ///     let given = StateInput::Absolute { theta, omega };
    ///     symmetric.energies(&mut workspace, given, &mut energies);
    ///     symmetric.exact_transfers(&mut workspace, given, &mut w);
    ///     let [kinetic, potential] = energies[d];
    ///     (first, last) = (first.or(Some(kinetic + potential)), kinetic + potential);
    ///     sum += 5e-4 * (before + w[d].total());
    ///     before = w[d].total();
    /// })?;
    /// let gained = last - first.unwrap();
    /// assert!(gained.abs() > 1e-5 && (sum - gained).abs() < 1e-2 * gained.abs(), "{sum} {gained}");
    ///
    /// // A tree without copies is refused.
    /// let rod = PendulumTree::parse("gravity = 9.81, rod: rod(mass = 0.2, length = 0.3)")?;
    /// assert_eq!(rod.symmetric().unwrap_err(), TreeError::NoCopies);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn symmetric(&self) -> Result<SymmetricTree<f64>, TreeError> {
        let described = &self.described;
        symmetric(self.description(), described.values(), described.symmetry())
    }
}

/// Sectors of the tree's copies; without copies, only the sector of the means.
impl<T: Scalar> Sectors for PendulumTree<T> {
    fn sectors(&self) -> &[Sector] {
        &self.described.symmetry().sectors
    }
}

/// Accelerations of the links, converted to symmetric coordinates: the system
/// [`SymmetricCoordinates`](branched_pendulum::system::SymmetricCoordinates()).
impl<T: Scalar> Computes<SymmetricAccelerations, T> for PendulumTree<T> {
    type On<S: Scalar> = PendulumTree<S>;

    fn on<S: Scalar>(&self, convert: impl Fn(T) -> S) -> PendulumTree<S> {
        self.on_scalar(&convert)
    }

    #[inline(always)]
    fn compute(&self, at: At<T>, given: &[&[T]], results: &mut [&mut [T]]) {
        let mut numbers = vec![T::from_f64(0.0); 3 * self.links()];
        self.accelerate_symmetric(&mut numbers, given, results, |[theta, omega], alpha| {
            let (theta, omega) = (|link: usize| theta[link], |link: usize| omega[link]);
            self.evaluate(at.time, theta, omega, |link, value| alpha[link] = value);
        });
    }

    fn compute_with(
        &self,
        workspace: &mut Workspace<T>,
        at: At<T>,
        given: &[&[T]],
        results: &mut [&mut [T]],
    ) {
        let (numbers, workspace) = workspace.with_inner(3 * self.links());
        self.accelerate_symmetric(numbers, given, results, |[theta, omega], alpha| {
            self.accelerations_with(workspace, at.time, theta, omega, alpha);
        });
    }
}

impl<T: Scalar> PendulumTree<T> {
    /// Converts coordinates to angles, calls `accelerate`, and converts the accelerations that it
    /// writes to coordinates.
    #[inline(always)]
    fn accelerate_symmetric(
        &self,
        numbers: &mut [T],
        given: &[&[T]],
        results: &mut [&mut [T]],
        accelerate: impl FnOnce([&[T]; 2], &mut [T]),
    ) {
        let (&[coordinates, rates], [accelerations]) = (given, &mut *results) else {
            return no_answer(results);
        };
        let (links, plain) = (self.links(), Normalisation::Plain);
        if [coordinates.len(), rates.len(), accelerations.len()] != [links; 3] {
            return no_answer(results);
        }
        let (theta, numbers) = numbers.split_at_mut(links);
        let (omega, alpha) = numbers.split_at_mut(links);
        self.absolute_from_symmetric(plain, coordinates, theta);
        self.absolute_from_symmetric(plain, rates, omega);
        accelerate([theta, omega], alpha);
        self.symmetric_from_absolute(plain, alpha, accelerations);
    }
}
