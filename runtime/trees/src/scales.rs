//! Energy budgets by scale (by generation), for trees by rule.

use std::sync::Arc;

use branched_pendulum::ScaleBudget;
use branched_pendulum::scalar::{Double, Scalar};
use branched_pendulum::sectors::degrees_of_freedom;
use branched_pendulum::system::{Model, Workspace};
use branched_pendulum::tree::ScaleTree;
use branched_pendulum_codegen::scene::{DescribedSpringDamper, Lineage, Scene, SpringDamperEnds};

use crate::equations::ByRuleEquations;
use crate::lineage::LineageScales;
use crate::numbers::LinkNumbers;
use crate::rows::{self, Generation};
use crate::tree::{PendulumTree, in_numbers};

/// A tree whose energies are known by scale.
#[derive(Clone, Debug)]
pub(crate) enum TreeScales<T> {
    /// A full tree.
    Rule(ByRule<T>),
    /// A tree with one open branching of each generation.
    Lineage(LineageScales<T>),
}

impl<T: Scalar> TreeScales<T> {
    /// Returns the scales of a tree; `None` if it has none.
    pub(crate) fn of(
        scene: &Scene,
        links: &[LinkNumbers],
        carries: &[bool],
        gravity: Double,
    ) -> Option<Self> {
        match scene.lineage {
            Some(_) => LineageScales::of(scene, links, gravity).map(Self::Lineage),
            None => ByRule::of(scene, links, carries, gravity).map(Self::Rule),
        }
    }

    pub(crate) fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> TreeScales<S> {
        match self {
            Self::Rule(rule) => TreeScales::Rule(rule.cast(convert)),
            Self::Lineage(lineage) => TreeScales::Lineage(lineage.cast(convert)),
        }
    }

    /// Returns the scale of springs between a link and its sibling.
    fn scale_of(&self, link: usize) -> Option<usize> {
        match self {
            Self::Rule(rule) => rule.depths.get(link).copied(),
            Self::Lineage(lineage) => lineage.branching_of(link),
        }
    }
}

/// A tree in which all links of one generation are identical and have the same number of children.
/// Scale s contains the differences between the branches that begin in generation s; scale 0
/// contains the means.
#[derive(Clone, Debug)]
pub(crate) struct ByRule<T> {
    tree: ScaleTree<ByRuleEquations, T>,
    /// Indices of the links, generation by generation: first the first children of all parents,
    /// then all second children, and so on.
    order: Arc<[usize]>,
    /// Generation of each link.
    depths: Arc<[usize]>,
}

/// Returns the clauses, in words, of springs that couple scales: springs between links that are not
/// siblings, and straight springs, whose length depends on several scales.
pub(crate) fn springs_across_scales(scene: &Scene) -> impl Iterator<Item = &str> {
    let is_of_siblings = |own: &&DescribedSpringDamper| {
        matches!(own.ends, SpringDamperEnds::Siblings(_)) || own.torques.spring.is_zero()
    };
    let torsional = scene.spring_dampers.iter();
    let torsional = torsional.filter(move |own| !is_of_siblings(own));
    let straight = scene.translational.iter().map(|own| own.what.as_str());
    torsional.map(|own| own.what.as_str()).chain(straight)
}

impl<T: Scalar> ByRule<T> {
    /// Returns the tree by rule; `None` if links of one generation differ, or if springs act
    /// between links that are not siblings.
    pub(crate) fn of(
        scene: &Scene,
        links: &[LinkNumbers],
        carries: &[bool],
        gravity: Double,
    ) -> Option<Self> {
        if springs_across_scales(scene).next().is_some() {
            return None;
        }
        let mut children = vec![Vec::new(); links.len()];
        for (number, link) in links.iter().enumerate() {
            if let Some(own) = link.parent.and_then(|parent| children.get_mut(parent)) {
                own.push(number);
            }
        }
        let (mut copies, mut order) = (vec![1], vec![0]);
        let mut generation = vec![0];
        // The first link of each generation, and its first child.
        let mut first = Vec::new();
        loop {
            let own = generation.iter().map(|&link: &usize| children.get(link));
            let own: Vec<&Vec<usize>> = own.collect::<Option<_>>()?;
            let (&link, count) = (generation.first()?, own.first()?.len());
            first.push((link, own.first()?.first().copied()));
            if own.iter().any(|children| children.len() != count) {
                return None;
            }
            if count == 0 {
                break;
            }
            let places = 0..count;
            let next = places.flat_map(|place| own.iter().map(move |children| children.get(place)));
            generation = next.map(Option::<&usize>::copied).collect::<Option<_>>()?;
            if !are_identical(links, &generation) {
                return None;
            }
            order.extend(&generation);
            copies.push(count);
        }
        let generations = first.iter().map(|&(link, child)| {
            let child = child.and_then(|child| links.get(child));
            let place = child.map_or([Double::from_f64(0.0); 2], |child| child.pivot);
            Generation { link, place }
        });
        let rows: Vec<Generation> = generations.collect();
        let rows = rows::by_rule(links, carries, gravity, &rows);
        Some(Self {
            tree: ScaleTree::new(copies, in_numbers(&rows)),
            order: order.into(),
            depths: depths(links).into(),
        })
    }

    pub(crate) fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> ByRule<S> {
        ByRule {
            tree: self.tree.cast(convert),
            order: Arc::clone(&self.order),
            depths: Arc::clone(&self.depths),
        }
    }

    /// Copies the values of the links to `room` in the order of the rule, and returns them. Returns
    /// an empty slice if the number of values is wrong.
    fn ordered<'a>(&self, numbers: &[T], buffer: &'a mut [T]) -> &'a [T] {
        if numbers.len() != self.order.len() {
            return &[];
        }
        for (own, &link) in buffer.iter_mut().zip(&*self.order) {
            if let Some(&number) = numbers.get(link) {
                *own = number;
            }
        }
        buffer
    }
}

/// Returns the generation of each link, 0 for the root.
fn depths(links: &[LinkNumbers]) -> Vec<usize> {
    let mut depths: Vec<usize> = Vec::with_capacity(links.len());
    for link in links {
        let above = link.parent.and_then(|parent| depths.get(parent));
        depths.push(above.map_or(0, |above| above + 1));
    }
    depths
}

/// Returns true if the links `some` are identical except for their parents.
fn are_identical(links: &[LinkNumbers], some: &[usize]) -> bool {
    let own = |link: &usize| {
        links.get(*link).map(|link| LinkNumbers {
            parent: None,
            ..*link
        })
    };
    let mut all = some.iter().map(own);
    let first = all.next();
    all.all(|other| Some(other) == first)
}

impl<T: Scalar> PendulumTree<T> {
    /// Returns, for each generation, the number of copies under each link of the previous
    /// generation (1 for the root). `None` if links of one generation differ or have different
    /// numbers of children: such a tree has no scales.
    #[must_use]
    pub fn copies(&self) -> Option<&[usize]> {
        match self.scales.as_ref()? {
            TreeScales::Rule(rule) => Some(rule.tree.copies()),
            TreeScales::Lineage(_) => None,
        }
    }

    /// Returns the order of the links of a tree with one open branching of each generation
    /// (`open = 1`); `None` for another tree.
    #[must_use]
    pub fn lineage(&self) -> Option<Lineage> {
        self.description().scene.lineage
    }

    /// Returns the number of degrees of freedom of each scale; `None` if the tree has no scales. In
    /// N generations scale 0 has N. Each difference at a branching into generation s has N − s; a
    /// tree with one open branching of each generation has one such difference for each s.
    #[must_use]
    pub fn degrees_of_freedom_by_scale(&self) -> Option<Vec<usize>> {
        let freedoms = match self.scales.as_ref()? {
            TreeScales::Rule(rule) => {
                let copies = rule.tree.copies();
                let scales = 0..copies.len();
                scales
                    .map(|scale| degrees_of_freedom(copies, scale))
                    .collect()
            }
            TreeScales::Lineage(own) => (1..=own.lineage.generations).rev().collect(),
        };
        Some(freedoms)
    }

    /// Returns energies (in Parseval's form), transfers and powers by scale
    /// ([`Scales`](branched_pendulum::Scales)); `None` if the tree has no scales. `time` is the
    /// time of the drive. `given` are the angles, the angular velocities and the external torques
    /// (N m), which may be empty.
    ///
    /// Scale 0 is the motion that all copies have in common; scale s is the motion of the copies of
    /// generation s relative to each other. The values are NaN if a slice does not have one value
    /// per link, or if the tree has more than
    /// [`MOST_GENERATIONS`](branched_pendulum::tree::MOST_GENERATIONS) generations.
    ///
    /// # Examples
    ///
    /// The paper's tree: scale 1 is its antiphase mode.
    ///
    /// ```
    /// use branched_pendulum::Energy;
    /// use branched_pendulum_trees::PendulumTree;
    ///
    /// let tree = PendulumTree::parse(
    ///     "gravity = 9.80665,
    ///      parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
    ///          child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2
    ///      ]",
    /// )?;
    /// assert_eq!(tree.copies(), Some(&[1, 2][..]));
    /// let (theta, omega) = ([0.8, 0.1, -0.1], [-3.0, 1.0, 2.0]);
    /// let budget = tree.budget_by_scale(0.0, [&theta, &omega, &[]]).unwrap();
    /// let sum = budget.energy(0) + budget.energy(1);
    /// assert!((sum - tree.energy_of(&theta, &omega)).abs() < 1e-15);
    /// assert_eq!(budget.transfer(0, 1), -budget.transfer(1, 0));
    /// # Ok::<(), branched_pendulum_trees::TreeError>(())
    /// ```
    #[must_use]
    pub fn budget_by_scale(&self, time: T, given: [&[T]; 3]) -> Option<ScaleBudget<T>> {
        self.scales.as_ref()?;
        let mut budget = ScaleBudget::new();
        self.budget_by_scale_into(&mut Workspace::new(), time, given, &mut budget);
        Some(budget)
    }

    /// Writes only the energies of the budget by scale, using memory that the caller keeps. Writes
    /// a budget without scales if the tree has none.
    pub fn energies_by_scale_into(
        &self,
        workspace: &mut Workspace<T>,
        theta: &[T],
        omega: &[T],
        budget: &mut ScaleBudget<T>,
    ) {
        let Some(scales) = &self.scales else {
            *budget = ScaleBudget::new();
            return;
        };
        match scales {
            TreeScales::Rule(rule) => {
                let (numbers, workspace) = workspace.with_inner(2 * self.links());
                let (own, rates) = numbers.split_at_mut(self.links());
                let (own, rates) = (rule.ordered(theta, own), rule.ordered(omega, rates));
                rule.tree.energies_by_scale(workspace, own, rates, budget);
            }
            TreeScales::Lineage(lineage) => lineage.energies(theta, omega, budget),
        }
        self.add_spring_energies(scales, theta, budget);
    }

    /// Adds the energies of springs between siblings.
    fn add_spring_energies(
        &self,
        scales: &TreeScales<T>,
        theta: &[T],
        budget: &mut ScaleBudget<T>,
    ) {
        self.spring_dampers()
            .add_energies_by_scale(theta, |link| scales.scale_of(link), budget);
    }

    /// Writes the result of [`budget_by_scale`](Self::budget_by_scale), using memory that the
    /// caller keeps. Writes a budget without scales if the tree has none.
    pub fn budget_by_scale_into(
        &self,
        workspace: &mut Workspace<T>,
        time: T,
        [theta, omega, torques]: [&[T]; 3],
        budget: &mut ScaleBudget<T>,
    ) {
        let Some(scales) = &self.scales else {
            *budget = ScaleBudget::new();
            return;
        };
        let (links, spring_dampers) = (self.links(), self.spring_dampers());
        let (numbers, workspace) = workspace.with_inner(7 * links);
        let mut numbers = numbers.chunks_exact_mut(links);
        let mut column = || numbers.next().unwrap_or_default();
        let (mut slopes, mut friction) = ([].as_slice(), [].as_slice());
        if !spring_dampers.is_empty() {
            let between = [column(), column()];
            let [own, braking] = between;
            spring_dampers.write_for_scales([theta, omega], [&mut *own, &mut *braking]);
            (slopes, friction) = (own, braking);
        }
        let drive = self.drive.as_ref().map(|drive| drive.inner(time));
        match scales {
            TreeScales::Rule(rule) => {
                let own = rule.ordered(theta, column());
                let rates = rule.ordered(omega, column());
                let on_links = rule.ordered(torques, column());
                let mut acting = [[].as_slice(); 2];
                if !spring_dampers.is_empty() {
                    acting = [
                        rule.ordered(slopes, column()),
                        rule.ordered(friction, column()),
                    ];
                }
                // For another number of torques than links, passes no angles, so that the results
                // are NaN.
                let fits = on_links.len() == torques.len();
                let own = if fits { own } else { &[] };
                let given = [own, rates, on_links];
                rule.tree
                    .budget_by_scale(workspace, drive, given, acting, budget);
            }
            TreeScales::Lineage(lineage) => {
                let given = [theta, omega, torques];
                lineage.budget(drive, given, [slopes, friction], budget);
            }
        }
        self.add_spring_energies(scales, theta, budget);
    }
}
