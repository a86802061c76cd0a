//! The pendulums that can be analysed.

use branched_pendulum::analysis::variational::linearised;
use branched_pendulum::prelude::AbsoluteAngles;
use branched_pendulum::scalar::Dual;
use branched_pendulum::{Model, Parametric};
use branched_pendulum_measure::{ModelSmoother, SmoothingError};

use super::scenes::Chain;
use crate::branched_double::apparatus::EXACT;
use crate::branched_double::{Apparatus, Friction};
use branched_pendulum_program::smoothed::{Motion, Record, Smoothed, by_equations};

/// Names of what is told about a pendulum.
#[derive(Clone, Copy, Debug)]
pub struct Names<const N: usize> {
    /// Coordinates, in columns.
    pub coordinates: [&'static str; N],
    /// Coordinates, in charts.
    pub symbols: [&'static str; N],
    /// The coordinate that is drawn.
    pub drawn: usize,
    /// The coordinate of the spectrogram.
    pub heard: usize,
    /// The energy, in words.
    pub energy_words: &'static str,
    /// The energy, as a symbol.
    pub energy: &'static str,
    /// The power that is told.
    pub power: &'static str,
    /// Pivots whose friction the equations may lack.
    pub pivots: &'static [&'static str],
    /// Options that give it.
    pub frictions: &'static [&'static str],
}

/// Power at a state, W.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Powers {
    /// The one that is told.
    pub told: f64,
    /// All that changes the energy.
    pub whole: f64,
}

/// A pendulum of N links that were measured.
pub trait Subject<const N: usize> {
    /// Names of what is told.
    fn names(&self) -> Names<N>;

    /// Coordinates that are smoothed, from angles of links or from rates.
    fn coordinates(&self, links: &[f64; N]) -> [f64; N];

    /// Angles or rates of links from coordinates.
    fn links(&self, coordinates: &[f64; N]) -> [f64; N];

    /// The energy that is told, J.
    fn energy(&self, motion: &Motion<N>) -> f64;

    /// Change of the energy by a change of the motion, to first order about it.
    fn energy_along(&self, motion: &Motion<N>, change: &Motion<N>) -> f64;

    /// Returns the powers, with friction in the pivots that is told beside the pendulum's own: a
    /// coefficient (N m s) for each, or none.
    fn powers(&self, motion: &Motion<N>, friction: &[f64]) -> Powers;

    /// Smooths by the equations of motion, beginning from a motion of the links.
    ///
    /// # Errors
    /// [`SmoothingError`].
    fn by_model(
        &self,
        record: Record<'_, N>,
        guess: &[Motion<N>],
    ) -> Result<Smoothed<N>, SmoothingError>;
}

/// A motion that begins to change.
fn along<const N: usize>(motion: &Motion<N>, change: &Motion<N>) -> [[Dual<f64, 1>; N]; 2] {
    let part = |part: usize| {
        std::array::from_fn(|of| Dual {
            value: motion[part][of],
            tangents: [change[part][of]],
        })
    };
    [part(0), part(1)]
}

impl Subject<3> for Apparatus {
    fn names(&self) -> Names<3> {
        Names {
            coordinates: ["theta_1", "theta_m", "theta_d"],
            symbols: ["θ_1", "θ_m", "θ_d"],
            drawn: 2,
            heard: 1,
            energy_words: "Energy of the antiphase mode",
            energy: "H_d",
            power: "W",
            pivots: &["the root's pivot", "the children's pivots"],
            frictions: &["--friction-root", "--friction-children"],
        }
    }

    fn coordinates(&self, links: &[f64; 3]) -> [f64; 3] {
        self.ideal().to_symmetric(links)
    }

    fn links(&self, coordinates: &[f64; 3]) -> [f64; 3] {
        self.ideal().from_symmetric(coordinates)
    }

    fn energy(&self, [coordinates, rates]: &Motion<3>) -> f64 {
        self.antiphase_energy(coordinates, rates)
    }

    fn energy_along(&self, motion: &Motion<3>, change: &Motion<3>) -> f64 {
        let model = self.ideal().cast(Dual::constant);
        let [coordinates, rates] = along(motion, change);
        let momenta = model.symmetric_momenta(&coordinates, &rates);
        let [slope] = model.antiphase_energy(&coordinates, &momenta).tangents;
        slope
    }

    fn powers(&self, [coordinates, rates]: &Motion<3>, friction: &[f64]) -> Powers {
        let flow = self.flow(coordinates, rates);
        let lost = match *friction {
            [root, children] => {
                let friction = Friction { root, children };
                friction.antiphase_power(coordinates, rates)
            }
            _ => 0.0,
        };
        Powers {
            told: flow.transfer[EXACT].total(),
            whole: flow.antiphase_rate(EXACT) + lost,
        }
    }

    /// Forces that the model lacks act on the parent, on the children together and against each
    /// other.
    fn by_model(
        &self,
        record: Record<'_, 3>,
        guess: &[Motion<3>],
    ) -> Result<Smoothed<3>, SmoothingError> {
        let smoother = ModelSmoother {
            disturbances: vec![[1.0, 0.0, 0.0], [0.0, 1.0, 1.0], [0.0, 1.0, -1.0]],
            frictions: vec![
                vec![[1.0, 0.0, 0.0]],
                vec![[-1.0, 1.0, 0.0], [-1.0, 0.0, 1.0]],
            ],
            ..ModelSmoother::default()
        };
        let mass = |theta: &[f64; 3]| self.ideal().mass_matrix(theta);
        match self.damped() {
            Some(model) => {
                let system = linearised(AbsoluteAngles(model));
                by_equations::<3, 6, _>(&smoother, &system, mass, record, guess)
            }
            None => {
                let system = linearised(AbsoluteAngles(self.ideal()));
                by_equations::<3, 6, _>(&smoother, &system, mass, record, guess)
            }
        }
    }
}

/// A chain of two links with viscous and Coulomb's friction and quadratic drag.
#[derive(Clone, Copy, Debug)]
pub struct TwoLinks {
    model: Chain,
    /// The model in numbers with a derivative.
    dual: Chain<Dual<f64, 1>>,
}

impl TwoLinks {
    /// The chain with these values of its parameters, in the order of the [`Chain`], taken as
    /// they are: a fit may have found some that no pendulum has.
    pub fn new(values: &[f64]) -> Self {
        let model = Chain::<f64>::with_parameters(|index| values[index]);
        let dual = model.cast(Dual::constant);
        Self { model, dual }
    }
}

impl Subject<2> for TwoLinks {
    fn names(&self) -> Names<2> {
        Names {
            coordinates: ["theta_1", "theta_2"],
            symbols: ["θ_1", "θ_2"],
            drawn: 1,
            heard: 1,
            energy_words: "Energy of the chain",
            energy: "H",
            power: "P",
            pivots: &["the upper pivot", "the lower pivot"],
            frictions: &["viscous_1 of --parameters", "viscous_2 of --parameters"],
        }
    }

    fn coordinates(&self, links: &[f64; 2]) -> [f64; 2] {
        *links
    }

    fn links(&self, coordinates: &[f64; 2]) -> [f64; 2] {
        *coordinates
    }

    fn energy(&self, [angles, rates]: &Motion<2>) -> f64 {
        self.model.kinetic_energy(angles, rates) + self.model.potential_energy(angles)
    }

    fn energy_along(&self, motion: &Motion<2>, change: &Motion<2>) -> f64 {
        let [theta, omega] = along(motion, change);
        let energy = self.dual.kinetic_energy(&theta, &omega) + self.dual.potential_energy(&theta);
        let [slope] = energy.tangents;
        slope
    }

    /// Friction is all that changes the energy: its power is the derivative of the energy
    /// along the motion, whatever the law.
    fn powers(&self, [angles, rates]: &Motion<2>, friction: &[f64]) -> Powers {
        let accelerations = self.model.accelerations(angles, rates);
        let own = self.energy_along(&[*angles, *rates], &[*rates, accelerations]);
        let relative = [rates[0], rates[1] - rates[0]];
        let lost = friction
            .iter()
            .zip(relative)
            .map(|(c, rate)| c * rate * rate);
        let whole = own - lost.sum::<f64>();
        Powers { told: whole, whole }
    }

    fn by_model(
        &self,
        record: Record<'_, 2>,
        guess: &[Motion<2>],
    ) -> Result<Smoothed<2>, SmoothingError> {
        let system = linearised(AbsoluteAngles(&self.model));
        let smoother = ModelSmoother {
            disturbances: vec![[1.0, 0.0], [0.0, 1.0]],
            frictions: vec![vec![[1.0, 0.0]], vec![[-1.0, 1.0]]],
            ..ModelSmoother::default()
        };
        let mass = |theta: &[f64; 2]| self.model.mass_matrix(theta);
        by_equations::<2, 4, _>(&smoother, &system, mass, record, guess)
    }
}
