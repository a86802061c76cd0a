//! Advice for trees that a program reads: their outputs and their models.

use std::cell::RefCell;
use std::error::Error;
use std::fmt;
use std::str::FromStr;

use branched_pendulum::Transfer;
use branched_pendulum::approximate::{Approximation, Linear};
use branched_pendulum::sectors::Sectors;
use branched_pendulum::system::{AbsoluteAngles, Model, State, Workspace};
use branched_pendulum::transfer::{StateInput, SymmetricTree};
use branched_pendulum_trees::PendulumTree;

use crate::advisor::Advisor;
use crate::candidates::Candidates;
use crate::choice::TimeLimit;
use crate::error::AdviceError;
use crate::form::ModelForm;
use crate::frames::frame;
use crate::report::Advice;
use crate::wanted::Wanted;

/// An output of a tree that must be right.
///
/// Written and parsed as `angles`, `energy`, `pixels` and `transfer`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum TreeOutput {
    /// All angles, in rad.
    Angles,
    /// The energy, in J.
    Energy,
    /// The ends of all links on a screen of 1000 pixels a metre, in pixels.
    Pixels,
    /// Energy transfer into the first difference between identical branches, in W.
    Transfer,
}

impl TreeOutput {
    /// All outputs.
    pub const ALL: &[Self] = &[Self::Angles, Self::Energy, Self::Pixels, Self::Transfer];

    fn word(self) -> &'static str {
        match self {
            Self::Angles => "angles",
            Self::Energy => "energy",
            Self::Pixels => "pixels",
            Self::Transfer => "transfer",
        }
    }
}

impl fmt::Display for TreeOutput {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.pad(self.word())
    }
}

impl FromStr for TreeOutput {
    type Err = UnknownOutput;

    fn from_str(name: &str) -> Result<Self, UnknownOutput> {
        let found = Self::ALL.iter().find(|output| output.word() == name);
        found.copied().ok_or_else(|| UnknownOutput {
            name: name.to_owned(),
        })
    }
}

/// Error: no output has this name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnknownOutput {
    /// The unknown name.
    pub name: String,
}

impl fmt::Display for UnknownOutput {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let words: Vec<&str> = TreeOutput::ALL.iter().map(|output| output.word()).collect();
        let words = words.join(", ");
        write!(f, "there is no output `{}` (outputs: {words})", self.name)
    }
}

impl Error for UnknownOutput {}

/// Motions of a tree that is read at run time, and the outputs that must be right.
///
/// The candidates are the equations of motion by every method, with several starts at once in
/// vector registers if there are several, and the linear model about the rest position nearest to
/// the first start, if there is one and the times are ends of equal frames.
///
/// # Examples
///
/// ```
/// use branched_pendulum::system::State;
/// use branched_pendulum_advice::{TreeOutput, TreeScene};
/// use branched_pendulum_trees::PendulumTree;
///
/// let tree = PendulumTree::parse("gravity = 9.81, rod: rod(mass = 0.2, length = 0.3)")?;
/// let scene = TreeScene {
///     starts: vec![State::at_rest(0.0, &[1e-4])],
///     times: (1..=10).map(|frame| f64::from(frame) / 60.0).collect(),
///     right: vec![(TreeOutput::Angles, 1e-8)],
///     limit: None,
/// };
/// let advice = scene.advise(&tree)?;
/// let names = advice.ranked().map(|run| advice.names[run.candidate].model.as_str());
/// assert!(names.collect::<Vec<_>>().contains(&"linear"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct TreeScene {
    /// Initial states, all at the same time.
    pub starts: Vec<State<f64>>,
    /// Times of the samples, in s.
    pub times: Vec<f64>,
    /// Required outputs, each with its largest allowed error in its unit.
    pub right: Vec<(TreeOutput, f64)>,
    /// Limit on the computing time of the chosen candidate.
    pub limit: Option<TimeLimit>,
}

/// Pixels per metre of the screen.
const PIXELS: f64 = 1000.0;

/// Largest drift of the energy after the motion has become unpredictable, in J.
const DRIFT: f64 = 1e-6;

impl TreeScene {
    /// Measures all candidates and chooses among them like [`Advisor::advise`].
    ///
    /// # Errors
    ///
    /// [`AdviceError`]; [`AdviceError::Tree`] for the output `transfer` of a tree without identical
    /// branches.
    pub fn advise(&self, tree: &PendulumTree) -> Result<Advice, AdviceError> {
        let wants = |wanted| self.right.iter().any(|(output, _)| *output == wanted);
        let symmetric = match wants(TreeOutput::Transfer) {
            true => Some(tree.symmetric()?),
            false => None,
        };
        let system = AbsoluteAngles(tree);
        let mut advisor = Advisor::new(&system).at(self.times.clone());
        for start in &self.starts {
            advisor = advisor.start(start.clone());
        }
        if is_conservative(tree) {
            advisor = advisor.conserved(Wanted::energy(tree, DRIFT));
        }
        for &(output, tolerance) in &self.right {
            advisor = advisor.wanted(match (output, &symmetric) {
                (TreeOutput::Energy, _) => Wanted::energy(tree, tolerance),
                (TreeOutput::Pixels, _) => Wanted::pixels(tree, PIXELS, tolerance),
                (TreeOutput::Transfer, Some(symmetric)) => transfer(symmetric, tolerance),
                (TreeOutput::Angles | TreeOutput::Transfer, _) => Wanted::angles(tolerance),
            });
        }
        if let Some(limit) = self.limit {
            advisor = advisor.within(limit);
        }
        advisor.advise(&self.candidates(tree))
    }

    /// Returns the complete model, and the linear model about the rest position if there is one.
    fn candidates<'a>(&self, tree: &'a PendulumTree) -> Candidates<'a> {
        let full = ModelForm::new("full").read_at_run_time();
        let mut candidates = Candidates::new();
        if let Some(frame) = frame(&self.starts, &self.times)
            && let Some(first) = self.starts.first()
        {
            let theta = first.values.get(..tree.links()).unwrap_or_default();
            let rest = tree.stable_equilibrium(theta);
            // What has no linear model is not asked for one.
            if let Some(linear) = rest
                .ok()
                .and_then(|rest| Linear::about(tree, &rest.theta).ok())
                && let (Ok(mut double), Ok(mut single)) =
                    (linear.frames::<f64>(frame), linear.frames::<f32>(frame))
            {
                let form = ModelForm::new("linear").read_at_run_time();
                candidates = candidates
                    .frames(&form, "f64", frame, move |state: &mut [f64]| {
                        double.step(state)
                    })
                    .frames(&form, "f32", frame, move |state: &mut [f32]| {
                        single.step(state)
                    });
            }
        }
        candidates = candidates.series(&full, AbsoluteAngles(tree));
        match self.starts.len() {
            1 => candidates,
            _ => candidates.lanes(&full, AbsoluteAngles(tree)),
        }
    }
}

/// Returns true if the tree has no drive and no friction.
fn is_conservative(tree: &PendulumTree) -> bool {
    // No two rates are equal, so that friction in any pivot dissipates power.
    let rates: Vec<f64> = (1..=tree.links()).map(|link| link as f64).collect();
    // A straight damper may connect points whose distance is constant at these rates, so it is
    // checked separately.
    let mut straight = tree.translational_spring_dampers().iter();
    let is_damped = straight.any(|own| own.friction.is_some_and(|friction| friction != 0.0));
    let angles = vec![0.0; rates.len()];
    tree.drive(0.0).is_none() && !is_damped && tree.friction_power(&angles, &rates) == 0.0
}

fn transfer(symmetric: &SymmetricTree<f64>, tolerance: f64) -> Wanted<'_> {
    let memory = RefCell::new((
        Workspace::new(),
        vec![Transfer::default(); symmetric.sectors().len()],
    ));
    Wanted::new("transfer", "W", tolerance, move |_, state, out| {
        let (workspace, transfers) = &mut *memory.borrow_mut();
        let (theta, omega) = state.split_at(state.len() / 2);
        let given = StateInput::Absolute { theta, omega };
        symmetric.exact_transfers(workspace, given, transfers);
        out.extend(transfers.get(1).map(|transfer| transfer.total()));
    })
}
