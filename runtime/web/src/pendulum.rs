//! The pendulum on the page.

use branched_pendulum::analysis::variational::Copies;
use branched_pendulum::integrate::{AnyIntegrator, Integrator, Stepper};
use branched_pendulum::system::{Energy, LinkPoint, Model, Positions, RatesOnly, State};
use branched_pendulum_trees::PendulumTree;
use wasm_bindgen::prelude::wasm_bindgen;

use crate::description;
use crate::hand::Hand;
use crate::methods::integrator;
use crate::release_map::{ReleaseMap, copies, in_phase};
use crate::swing::{Swing, parts};

/// A tree in motion.
#[wasm_bindgen]
#[derive(Debug)]
pub struct Pendulum {
    method: AnyIntegrator<f64>,
    motion: Stepper<AnyIntegrator<f64>, RatesOnly<Swing>>,
    /// Components in which the first two equal branches differ.
    copies: Option<Copies>,
    /// Energy at which the account of the work began, and the largest since, J.
    begun: f64,
    largest: f64,
    /// Evaluations before the present account.
    evaluations: u64,
}

/// Energies by scale and what changes them: scale 0 is what all copies do together, scale s what
/// those of generation s do against each other.
#[wasm_bindgen(getter_with_clone)]
#[derive(Clone, Debug, PartialEq)]
pub struct Budget {
    /// Energies by Parseval, J; their sum is the energy of the tree.
    #[wasm_bindgen(readonly)]
    pub energies: Vec<f64>,
    /// Power that each scale receives from the others, W.
    #[wasm_bindgen(readonly)]
    pub received: Vec<f64>,
    /// Power of friction, drag, drive and the hand on each scale, W.
    #[wasm_bindgen(readonly)]
    pub powers: Vec<f64>,
}

/// The method before one is chosen.
const FIRST_METHOD: (&str, f64) = ("dop853", 1e-6);

fn flat(points: Vec<[f64; 2]>) -> Vec<f64> {
    points.into_flattened()
}

#[wasm_bindgen]
impl Pendulum {
    /// The tree of a description with values for its parameters (SI units), at rest with all
    /// angles zero.
    ///
    /// # Errors
    /// All mistakes in the text, and values that no pendulum can have.
    #[wasm_bindgen(constructor)]
    pub fn new(text: &str, names: Vec<String>, values: Vec<f64>) -> Result<Self, String> {
        let tree = description::tree(text, &names, &values)?;
        let (name, setting) = FIRST_METHOD;
        let method = integrator(name, setting)?;
        let state = vec![0.0; 2 * tree.links() + 1];
        let copies = copies(&tree);
        let ode = RatesOnly(Swing { tree, hand: None });
        let motion = start(&method, ode, &State::new(0.0, state))?;
        let mut pendulum = Self {
            method,
            motion,
            copies,
            begun: 0.0,
            largest: 0.0,
            evaluations: 0,
        };
        pendulum.begin_account();
        Ok(pendulum)
    }

    /// Names of the links, in the order of the angles.
    pub fn names(&self) -> Vec<String> {
        self.tree().names().to_vec()
    }

    /// Masses of the links, kg.
    pub fn masses(&self) -> Vec<f64> {
        let tree = self.tree();
        let links = (0..tree.links()).filter_map(|link| tree.properties_of(link));
        links.map(|link| link.mass).collect()
    }

    /// Numbers of links between each link and the root.
    pub fn generations(&self) -> Vec<u32> {
        self.down_the_tree(0, |above, _| above + 1)
    }

    /// Largest distance (m) from the root's pivot that the end of a link can have.
    pub fn reach(&self) -> f64 {
        let length = |[x, y]: [f64; 2]| x.hypot(y);
        let pivots = self.down_the_tree(0.0, |above, pivot| above + length(pivot));
        let ends = pivots.iter().enumerate().filter_map(|(link, pivot)| {
            Some(pivot + length(self.tree().properties_of(link)?.end))
        });
        ends.fold(0.0, f64::max)
    }

    /// Time, s.
    pub fn time(&self) -> f64 {
        self.motion.time()
    }

    /// Angles of the links, rad.
    pub fn angles(&self) -> Vec<f64> {
        self.theta_omega().0.to_vec()
    }

    /// Pivots of the links, x and y of one after the other (m), y upwards.
    pub fn pivots(&self) -> Vec<f64> {
        flat(self.tree().points(LinkPoint::Pivot, self.theta_omega().0))
    }

    /// Ends of the links, likewise.
    pub fn ends(&self) -> Vec<f64> {
        flat(self.tree().points(LinkPoint::End, self.theta_omega().0))
    }

    /// Moves on by a time (s).
    ///
    /// # Errors
    /// A motion that the method cannot follow; it stands still then.
    pub fn advance(&mut self, duration: f64) -> Result<(), String> {
        let moved = self.motion.advance(duration);
        self.largest = self.largest.max(self.energy().abs());
        moved.map_err(|error| error.to_string())
    }

    /// Takes a method by its name, with its tolerance or its step (s). The account of the energy
    /// begins anew, so that its error is this method's.
    ///
    /// # Errors
    /// A name that there is not, a tolerance or a step that is not positive.
    pub fn set_method(&mut self, name: &str, setting: f64) -> Result<(), String> {
        let before = std::mem::replace(&mut self.method, integrator(name, setting)?);
        let set = self.restart(self.swing().clone(), self.time(), self.theta_omega_values());
        if set.is_err() {
            self.method = before;
        }
        set
    }

    /// Gives a parameter another value (SI units) while the tree moves.
    ///
    /// # Errors
    /// A value that no pendulum can have.
    pub fn set_parameter(&mut self, name: &str, value: f64) -> Result<(), String> {
        let tree = self.tree().with(name, value);
        let mut swing = self.swing().clone();
        swing.tree = tree.map_err(|error| error.to_string())?;
        self.copies = copies(&swing.tree);
        self.restart(swing, self.time(), self.theta_omega_values())
    }

    /// Goes on as another tree moves: links of the same name, or of the same without the number
    /// of a copy, have its angles and rates, all others those of the link that they hang from.
    ///
    /// # Errors
    /// None, unless the other's state is not finite.
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

    /// Releases the tree from rest, with the root and all other links at these angles, the first
    /// two equal branches by `difference` to either side of theirs (rad): θ_d of the paper.
    ///
    /// # Errors
    /// Angles that are not finite.
    pub fn release(&mut self, root: f64, rest: f64, difference: f64) -> Result<(), String> {
        let mut state = in_phase(self.tree().links(), root, rest).values;
        if let Some(copies) = &self.copies {
            let apart = copies.opposite(state.len());
            for (value, apart) in state.iter_mut().zip(apart) {
                *value += difference * apart;
            }
        }
        let mut swing = self.swing().clone();
        swing.hand = None;
        self.restart(swing, 0.0, state)
    }

    /// Takes hold of a link, by its point nearest to x, y (m).
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

    /// Lets go: links keep their motion.
    pub fn let_go(&mut self) {
        self.motion.ode_mut().0.hand = None;
    }

    /// Point that is held and place of the hand, x, y, x, y (m); empty without a hand.
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

    /// Error of the energy since the account began, which work does not explain, over the
    /// largest energy since, both by their sizes; zero at rest.
    pub fn energy_error(&self) -> f64 {
        let work = parts(self.motion.state()).map_or(f64::NAN, |(_, _, work)| work);
        match self.energy() - self.begun - work {
            0.0 => 0.0,
            error => error / self.largest,
        }
    }

    /// Evaluations of the accelerations so far.
    pub fn evaluations(&self) -> f64 {
        (self.evaluations + self.motion.report().evaluations) as f64
    }

    /// Energies by scale; none where links of one generation differ.
    pub fn budget(&self) -> Option<Budget> {
        let (theta, omega) = self.theta_omega();
        let torques = self.swing().torques(theta, omega).unwrap_or_default();
        let given = [theta, omega, &torques];
        let budget = self.tree().budget_by_scale(self.time(), given)?;
        let each = |of: &dyn Fn(usize) -> f64| (0..budget.scales()).map(of).collect();
        Some(Budget {
            energies: each(&|scale| budget.energy(scale)),
            received: each(&|scale| budget.received(scale)),
            powers: each(&|scale| budget.power(scale)),
        })
    }

    /// Returns true if the tree has two equal branches: without them it has no map.
    pub fn has_copies(&self) -> bool {
        self.copies.is_some()
    }

    /// The plane of releases of this tree, followed for so long (s) at a tolerance.
    ///
    /// # Errors
    /// A tree without two equal branches.
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

    /// Goes on with other equations or from another state, angles and rates; nothing has changed
    /// after an error.
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

    /// A number for each link, from that of the link that it hangs from and its pivot on it.
    fn down_the_tree<T: Copy>(&self, root: T, next: impl Fn(T, [f64; 2]) -> T) -> Vec<T> {
        let mut numbers: Vec<T> = Vec::new();
        for link in 0..self.tree().links() {
            let own = self.tree().properties_of(link);
            let above = own.and_then(|own| Some((*numbers.get(own.parent?)?, own.pivot)));
            numbers.push(above.map_or(root, |(above, pivot)| next(above, pivot)));
        }
        numbers
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
