//! Budgets by scale of trees by rule.

use std::sync::Arc;

use branched_pendulum::ScaleBudget;
use branched_pendulum::scalar::{Double, Scalar};
use branched_pendulum::system::{Model, Workspace};
use branched_pendulum::tree::ScaleTree;
use branched_pendulum_codegen::scene::{DescribedSpringDamper, Scene, SpringDamperEnds};

use crate::equations::ByRuleEquations;
use crate::numbers::LinkNumbers;
use crate::rows::{self, Generation};
use crate::tree::{PendulumTree, in_numbers};

/// A tree whose links of one generation are alike, with as many children each.
#[derive(Clone, Debug)]
pub(crate) struct ByRule<T> {
    tree: ScaleTree<ByRuleEquations, T>,
    /// Links, generation by generation: first all that are the first child of their parent,
    /// then all second ones.
    order: Arc<[usize]>,
    /// Generation of each link.
    depths: Arc<[usize]>,
}

/// Springs that act between links that are no siblings, and straight ones, whose length depends on
/// several scales: clauses in words.
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
    /// Returns the tree by rule; none where links of one generation differ, and where springs act
    /// between links that are no siblings.
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
        // Of each generation the first link, and its first child.
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
            if !are_alike(links, &generation) {
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

    /// Numbers of the links in the order of the rule, written to `room`; none of another number
    /// of links.
    fn ordered<'a>(&self, numbers: &[T], room: &'a mut [T]) -> &'a [T] {
        if numbers.len() != self.order.len() {
            return &[];
        }
        for (own, &link) in room.iter_mut().zip(&*self.order) {
            if let Some(&number) = numbers.get(link) {
                *own = number;
            }
        }
        room
    }
}

/// Generation of each link, 0 for the root.
fn depths(links: &[LinkNumbers]) -> Vec<usize> {
    let mut depths: Vec<usize> = Vec::with_capacity(links.len());
    for link in links {
        let above = link.parent.and_then(|parent| depths.get(parent));
        depths.push(above.map_or(0, |above| above + 1));
    }
    depths
}

/// Returns true if links are alike but for their parents.
fn are_alike(links: &[LinkNumbers], some: &[usize]) -> bool {
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
    /// Copies of each generation under each link of the one before, 1 for the root; `None`
    /// where links of one generation differ or have more children than others: such a tree
    /// has no scales.
    #[must_use]
    pub fn copies(&self) -> Option<&[usize]> {
        Some(self.rule.as_ref()?.tree.copies())
    }

    /// Returns energies by Parseval, transfers and powers by scale
    /// ([`Scales`](branched_pendulum::Scales)), at a time of the drive, of angles, angular
    /// velocities and, unless the third slice is empty, torques from outside (N m); `None`
    /// where the tree has no scales.
    ///
    /// Scale 0 is what all copies do together, scale s what those of generation s do against
    /// each other. NaN for slices of another length than there are links, and of trees of more
    /// than [`MOST_GENERATIONS`](branched_pendulum::tree::MOST_GENERATIONS).
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
        self.copies()?;
        let mut budget = ScaleBudget::new();
        self.budget_by_scale_into(&mut Workspace::new(), time, given, &mut budget);
        Some(budget)
    }

    /// Writes the energies of a budget alone, in memory that the caller keeps; one of no scales
    /// where the tree has none.
    pub fn energies_by_scale_into(
        &self,
        workspace: &mut Workspace<T>,
        theta: &[T],
        omega: &[T],
        budget: &mut ScaleBudget<T>,
    ) {
        let Some(rule) = &self.rule else {
            *budget = ScaleBudget::new();
            return;
        };
        let (numbers, workspace) = workspace.with_inner(2 * self.links());
        let (own, rates) = numbers.split_at_mut(self.links());
        let (own, rates) = (rule.ordered(theta, own), rule.ordered(omega, rates));
        rule.tree.energies_by_scale(workspace, own, rates, budget);
        self.add_spring_energies(rule, theta, budget);
    }

    /// Adds the energies of springs between siblings.
    fn add_spring_energies(&self, rule: &ByRule<T>, theta: &[T], budget: &mut ScaleBudget<T>) {
        let scale_of = |link: usize| rule.depths.get(link).copied();
        self.spring_dampers()
            .add_energies_by_scale(theta, scale_of, budget);
    }

    /// Writes the same budget, in memory that the caller keeps; one of no scales where the tree
    /// has none.
    pub fn budget_by_scale_into(
        &self,
        workspace: &mut Workspace<T>,
        time: T,
        [theta, omega, torques]: [&[T]; 3],
        budget: &mut ScaleBudget<T>,
    ) {
        let Some(rule) = &self.rule else {
            *budget = ScaleBudget::new();
            return;
        };
        let (links, spring_dampers) = (self.links(), self.spring_dampers());
        let (numbers, workspace) = workspace.with_inner(7 * links);
        let mut numbers = numbers.chunks_exact_mut(links);
        let mut column = || numbers.next().unwrap_or_default();
        let own = rule.ordered(theta, column());
        let rates = rule.ordered(omega, column());
        let on_links = rule.ordered(torques, column());
        let mut acting = [[].as_slice(); 2];
        if !spring_dampers.is_empty() {
            let [slopes, friction] = [column(), column()];
            spring_dampers.write_for_scales([theta, omega], [&mut *slopes, &mut *friction]);
            acting = [
                rule.ordered(slopes, column()),
                rule.ordered(friction, column()),
            ];
        }
        // Nothing has so many links as torques of another number.
        let fits = on_links.len() == torques.len();
        let own = if fits { own } else { &[] };
        let drive = self.drive.as_ref().map(|drive| drive.inner(time));
        let given = [own, rates, on_links];
        rule.tree
            .budget_by_scale(workspace, drive, given, acting, budget);
        self.add_spring_energies(rule, theta, budget);
    }
}
