//! The pendulum on the page.

use branched_pendulum::analysis::variational::Copies;
use branched_pendulum::integrate::{AnyIntegrator, Integrator, Stepper};
use branched_pendulum::system::{Energy, LinkPoint, Model, Positions, RatesOnly, State};
use branched_pendulum::transfer::{EnergyDefinition, NonConservative};
use branched_pendulum_trees::{PendulumTree, TreeError};
use wasm_bindgen::prelude::wasm_bindgen;

use crate::budget::Budget;
use crate::description;
use crate::differences::{Differences, in_phase_part, set_apart};
use crate::hand::Hand;
use crate::methods::integrator;
use crate::outline;
use crate::release_map::{ReleaseMap, copies, in_phase};
use crate::swing::{Swing, parts};

/// A tree in motion.
#[wasm_bindgen]
#[derive(Debug)]
pub struct Pendulum {
    method: AnyIntegrator<f64>,
    motion: Stepper<AnyIntegrator<f64>, RatesOnly<Swing>>,
    /// Coordinates in which the first two equal branches differ.
    copies: Option<Copies>,
    /// Differences between copies, or the reason why they have no energies.
    differences: Result<Differences, TreeError>,
    /// Energy at the beginning of the energy account, in J.
    begun: f64,
    largest: f64,
    /// Evaluations before the present account.
    evaluations: u64,
}

/// Method and tolerance that are used until the user chooses others.
const FIRST_METHOD: (&str, f64) = ("dop853", 1e-6);

fn flat(points: Vec<[f64; 2]>) -> Vec<f64> {
    points.into_flattened()
}

#[wasm_bindgen]
impl Pendulum {
    /// Creates the tree of a description with values for its parameters (SI units). It is at rest,
    /// with all angles zero.
    ///
    /// # Errors
    /// Lists all mistakes in the text, and values that are physically impossible.
    #[wasm_bindgen(constructor)]
    pub fn new(text: &str, names: Vec<String>, values: Vec<f64>) -> Result<Self, String> {
        let tree = description::tree(text, &names, &values)?;
        let (name, setting) = FIRST_METHOD;
        let method = integrator(name, setting)?;
        let state = vec![0.0; 2 * tree.links() + 1];
        let (copies, differences) = (copies(&tree), Differences::of(&tree));
        let ode = RatesOnly(Swing { tree, hand: None });
        let motion = start(&method, ode, &State::new(0.0, state))?;
        let mut pendulum = Self {
            method,
            motion,
            copies,
            differences,
            begun: 0.0,
            largest: 0.0,
            evaluations: 0,
        };
        pendulum.begin_account();
        Ok(pendulum)
    }

    /// Returns the names of the links, in the order of the angles.
    pub fn names(&self) -> Vec<String> {
        self.tree().names().to_vec()
    }

    /// Returns the index of each link's parent; -1 for the root.
    pub fn parents(&self) -> Vec<i32> {
        let links = (0..self.tree().links()).map(|link| self.tree().properties_of(link));
        let parents = links.map(|link| link.and_then(|link| i32::try_from(link.parent?).ok()));
        parents.map(|parent| parent.unwrap_or(-1)).collect()
    }

    /// Returns the width of each link and the radius of the disc at its centre of mass, in m, for
    /// drawing. All links are plates of the same thickness; each has either a width or a radius,
    /// and zero for the other.
    pub fn widths_and_radii(&self) -> Vec<f64> {
        flat(outline::widths_and_radii(self.tree()))
    }

    /// Returns the largest distance (m) from the root's pivot that the end of a link can have.
    pub fn reach(&self) -> f64 {
        outline::reach(self.tree())
    }

    /// Time, s.
    pub fn time(&self) -> f64 {
        self.motion.time()
    }

    /// Angles of the links, rad.
    pub fn angles(&self) -> Vec<f64> {
        self.theta_omega().0.to_vec()
    }

    /// Returns the angular velocities of the links, in rad/s.
    pub fn rates(&self) -> Vec<f64> {
        self.theta_omega().1.to_vec()
    }

    /// Returns the pivots of the links, as x and y of one link after the other, in m, y upwards.
    pub fn pivots(&self) -> Vec<f64> {
        flat(self.tree().points(LinkPoint::Pivot, self.theta_omega().0))
    }

    /// Returns the centres of mass of the links, in the same form as the pivots.
    pub fn centres(&self) -> Vec<f64> {
        flat(self.tree().points(LinkPoint::Centre, self.theta_omega().0))
    }

    /// Also ends of the links.
    pub fn ends(&self) -> Vec<f64> {
        flat(self.tree().points(LinkPoint::End, self.theta_omega().0))
    }

    /// Returns pivot and end of each link (x, y, x, y, in m) in the in-phase motion, that is, if
    /// all copies had the mean of their angles, where full turns are ignored. Empty if the tree has
    /// no copies.
    pub fn ghost(&self) -> Vec<f64> {
        if self.differences.is_err() {
            return Vec::new();
        }
        let angles = in_phase_part(self.tree(), self.theta_omega().0);
        let of = |point| self.tree().points(point, &angles).into_iter();
        let both = of(LinkPoint::Pivot).zip(of(LinkPoint::End));
        both.flat_map(|(pivot, end)| [pivot, end])
            .flatten()
            .collect()
    }

    /// Advances the motion by `duration` seconds.
    ///
    /// # Errors
    /// Fails if the method cannot integrate the motion; the state is then unchanged.
    pub fn advance(&mut self, duration: f64) -> Result<(), String> {
        let moved = self.motion.advance(duration);
        self.largest = self.largest.max(self.energy().abs());
        moved.map_err(|error| error.to_string())
    }

    /// Chooses a method by its name, with its tolerance or its step length (s). The energy account
    /// starts again, so that its error is the error of this method.
    ///
    /// # Errors
    /// Fails if no method has this name, or if the tolerance or step length is not positive.
    pub fn set_method(&mut self, name: &str, setting: f64) -> Result<(), String> {
        let before = std::mem::replace(&mut self.method, integrator(name, setting)?);
        let set = self.restart(self.swing().clone(), self.time(), self.theta_omega_values());
        if set.is_err() {
            self.method = before;
        }
        set
    }

    /// Changes the value of a parameter (SI units) while the tree moves.
    ///
    /// # Errors
    /// Fails if the value is physically impossible.
    pub fn set_parameter(&mut self, name: &str, value: f64) -> Result<(), String> {
        let tree = self.tree().with(name, value);
        let mut swing = self.swing().clone();
        swing.tree = tree.map_err(|error| error.to_string())?;
        self.copies = copies(&swing.tree);
        self.differences = Differences::of(&swing.tree);
        self.restart(swing, self.time(), self.theta_omega_values())
    }

    /// Continues the motion of another tree. Links take the angle and rate of the link with the
    /// same name there (if necessary, ignoring the numbers of copies); all others take those of
    /// their parent.
    ///
    /// # Errors
    /// Fails only if the state of the other tree is not finite.
    pub fn take_up(&mut self, other: &Pendulum) -> Result<(), String> {
        let known = other.names();
        let (theta, omega) = other.theta_omega();
        let of = |name: &String| {
            let exact = known.iter().position(|own| own == name);
            let alike = || known.iter().position(|own| stem(own) == stem(name));
            let link = exact.or_else(alike)?;
            Some((*theta.get(link)?, *omega.get(link)?))
        };
        let mut both: Vec<(f64, f64)> = Vec::new();
        for (link, name) in self.tree().names().iter().enumerate() {
            let parent = self.tree().properties_of(link).and_then(|own| own.parent);
            let above = || both.get(parent?).copied();
            let own = of(name).or_else(above).unwrap_or_default();
            both.push(own);
        }
        let (theta, omega): (Vec<f64>, Vec<f64>) = both.into_iter().unzip();
        self.restart(self.swing().clone(), other.time(), [theta, omega].concat())
    }

    /// Releases the tree from rest. The root has the angle `root` and all other links `rest`; at
    /// every branching, copies are displaced by `difference` in opposite directions (θ_d of the
    /// paper). All angles are in rad. If nothing is written as a copy, the first two equal branches
    /// are displaced.
    ///
    /// # Errors
    /// Fails if an angle is not finite.
    pub fn release(&mut self, root: f64, rest: f64, difference: f64) -> Result<(), String> {
        let links = self.tree().links();
        let mut state = in_phase(links, root, rest).values;
        if self.differences.is_ok() {
            set_apart(self.tree(), difference, &mut state);
        } else if let Some(copies) = &self.copies {
            let apart = copies.opposite(state.len());
            for (value, apart) in state.iter_mut().zip(apart) {
                *value += difference * apart;
            }
        }
        let mut swing = self.swing().clone();
        swing.hand = None;
        self.restart(swing, 0.0, state)
    }

    /// Lets the user's hand hold a link at its point nearest to x, y (m).
    pub fn grab(&mut self, link: usize, x: f64, y: f64) {
        let hand = Hand::on(self.tree(), self.theta_omega().0, link, [x, y]);
        self.motion.ode_mut().0.hand = hand;
    }

    /// Moves the hand to x, y (m).
    pub fn pull(&mut self, x: f64, y: f64) {
        if let Some(hand) = &mut self.motion.ode_mut().0.hand {
            hand.move_to([x, y]);
        }
    }

    /// Lets go of the link; all links keep their motion.
    pub fn let_go(&mut self) {
        self.motion.ode_mut().0.hand = None;
    }

    /// Returns the held point and the position of the hand (x, y, x, y, in m); empty without a
    /// hand.
    pub fn hand(&self) -> Vec<f64> {
        let Swing { tree, hand } = self.swing();
        let ends = hand
            .as_ref()
            .and_then(|hand| hand.ends(tree, self.theta_omega().0));
        ends.map_or_else(Vec::new, |ends| flat(ends.to_vec()))
    }

    /// Energy, J.
    pub fn energy(&self) -> f64 {
        let (theta, omega) = self.theta_omega();
        self.tree().energy_of(theta, omega)
    }

    /// Kinetic energy, J.
    pub fn kinetic_energy(&self) -> f64 {
        let (theta, omega) = self.theta_omega();
        self.tree().kinetic_energy_of(theta, omega)
    }

    /// Returns the error of the energy since the beginning of the account, that is, the change not
    /// explained by work, divided by the largest energy since then; zero at rest.
    pub fn energy_error(&self) -> f64 {
        let work = parts(self.motion.state()).map_or(f64::NAN, |(_, _, work)| work);
        match self.energy() - self.begun - work {
            0.0 => 0.0,
            error => error / self.largest,
        }
    }

    /// Returns the number of evaluations of the accelerations so far.
    pub fn evaluations(&self) -> f64 {
        (self.evaluations + self.motion.report().evaluations) as f64
    }

    /// Returns the energies by scale, in Parseval's form or computed from momenta like the paper's
    /// H_d. `None` if the tree has no copies or the energies are [refused](Self::refused_energies).
    /// If copies differ, the energies in Parseval's form are NaN.
    pub fn budget(&mut self, by_parseval: bool) -> Option<Budget> {
        let differences = self.differences.as_mut().ok()?;
        let Swing { tree, hand } = &self.motion.ode().0;
        let (theta, omega, _) = parts(self.motion.state())?;
        let torques = hand.as_ref().map(|hand| hand.torques(tree, theta, omega));
        let mut acting = vec![NonConservative::Friction];
        acting.extend(tree.drive(self.motion.time()).map(NonConservative::Drive));
        acting.extend(torques.as_deref().map(NonConservative::Torques));
        let definition = match by_parseval {
            true => EnergyDefinition::Parseval,
            false => EnergyDefinition::Canonical,
        };
        Some(differences.budget(definition, &acting, [theta, omega]))
    }

    /// Returns true if copies have different properties.
    pub fn has_unequal_copies(&self) -> bool {
        let differences = self.differences.as_ref();
        differences.is_ok_and(Differences::are_of_unequal_copies)
    }

    /// Returns the reason why the differences between copies have no energies; `None` if they have,
    /// or if the tree has no copies.
    pub fn refused_energies(&self) -> Option<String> {
        match &self.differences {
            Ok(_) | Err(TreeError::NoCopies) => None,
            Err(error) => Some(error.to_string()),
        }
    }

    /// Returns true if the tree has two equal branches; without them it has no map of releases.
    pub fn has_copies(&self) -> bool {
        self.copies.is_some()
    }

    /// Creates the map of releases of this tree, each integrated for `span` seconds with this
    /// tolerance.
    ///
    /// # Errors
    /// Fails if the tree does not have two equal branches.
    pub fn release_map(&self, span: f64, tolerance: f64) -> Result<ReleaseMap, String> {
        ReleaseMap::of(self.tree(), span, tolerance)
    }
}

impl Pendulum {
    fn swing(&self) -> &Swing {
        &self.motion.ode().0
    }

    fn tree(&self) -> &PendulumTree {
        &self.swing().tree
    }

    fn theta_omega(&self) -> (&[f64], &[f64]) {
        let parts = parts(self.motion.state());
        parts.map_or((&[], &[]), |(theta, omega, _)| (theta, omega))
    }

    fn theta_omega_values(&self) -> Vec<f64> {
        let (theta, omega) = self.theta_omega();
        [theta, omega].concat()
    }

    /// Continues with other equations or from another state (angles and rates). After an error
    /// nothing has changed.
    fn restart(&mut self, swing: Swing, time: f64, mut state: Vec<f64>) -> Result<(), String> {
        state.push(0.0);
        let motion = start(&self.method, RatesOnly(swing), &State::new(time, state))?;
        self.evaluations += self.motion.report().evaluations;
        self.motion = motion;
        self.begin_account();
        Ok(())
    }

    fn begin_account(&mut self) {
        self.begun = self.energy();
        self.largest = self.begun.abs();
    }
}

fn start(
    method: &AnyIntegrator<f64>,
    ode: RatesOnly<Swing>,
    state: &State<f64>,
) -> Result<Stepper<AnyIntegrator<f64>, RatesOnly<Swing>>, String> {
    method.start(ode, state).map_err(|error| error.to_string())
}

/// Returns a name without the numbers of copies.
fn stem(name: &str) -> &str {
    name.trim_end_matches(|letter: char| letter.is_ascii_digit() || letter == '_')
}
