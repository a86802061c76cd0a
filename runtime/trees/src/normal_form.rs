//! Normal forms of trees.

use branched_pendulum::analysis::normal_form::{
    DegreeEstimate, MotionSubspace, NormalForm, NormalFormOptions, Prediction, Refusal,
};
use branched_pendulum::analysis::variational::Copies;
use branched_pendulum::system::{Model, State};

use crate::error::TreeError;
use crate::tree::PendulumTree;

/// Normal form of the in-phase motion of a tree, with a small difference between two copies.
#[derive(Clone, Debug)]
pub struct TreeNormalForm {
    tree: PendulumTree,
    form: NormalForm,
}

impl PendulumTree<f64> {
    /// Derives the normal form of the motion in which all copies are in phase, with a small
    /// difference between the first two of `copies`, about the equilibrium nearest to zero angles.
    /// Friction and drive are neglected.
    ///
    /// # Errors
    /// [`TreeError::NotInPhase`] if the copies do not stay in phase, and
    /// [`TreeError::NormalForm`].
    ///
    /// # Examples
    ///
    /// ```
    /// use branched_pendulum::analysis::normal_form::NormalFormOptions;
    /// use branched_pendulum::analysis::variational::Copies;
    /// use branched_pendulum::prelude::*;
    /// use branched_pendulum_trees::PendulumTree;
    ///
    /// let tree = PendulumTree::parse(
    ///     "gravity = 9.80665,
    ///      parent(mass = 0.12880, com = 0.084, inertia = 1.88e-3, joint = 0.27) [
    ///          child(mass = 0.10531, com = 0.043, inertia = 0.516e-3) * 2
    ///      ]",
    /// )?;
    /// let children = Copies::of_links(&[None, Some(0), Some(0)], &[&[1, 2]]).unwrap();
    /// let form = tree.normal_form(&children, NormalFormOptions::default())?;
    /// // Differences grow from 30° of the parent and 19° of both children, by simulation at
    /// // 0.0713 1/s.
    /// let [parent, child] = [30.0_f64, 19.0].map(f64::to_radians);
    /// let prediction = form.predict(&State::at_rest(0.0, &[parent, child, child]))?;
    /// assert!((prediction.growth_rate.value - 0.0713).abs() < 0.03 * 0.0713);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn normal_form(
        &self,
        copies: &Copies,
        options: NormalFormOptions,
    ) -> Result<TreeNormalForm, TreeError> {
        self.in_phase(copies)?.with_differences(copies)?;
        let rest = self.equilibrium(&vec![0.0; self.links()])?;
        let subspace = MotionSubspace::of_copies(self.links(), &self.all_copies(), copies);
        Ok(TreeNormalForm {
            form: NormalForm::new(self, &rest, &subspace, options)?,
            tree: self.clone(),
        })
    }
}

impl TreeNormalForm {
    /// Returns the normal form, in angles and momenta of all links.
    pub fn form(&self) -> &NormalForm {
        &self.form
    }

    /// Predicts the frequencies of the in-phase motion from a state of all links, and the growth of
    /// the difference.
    ///
    /// # Errors
    /// [`Refusal`].
    pub fn predict(&self, state: &State<f64>) -> Result<Prediction, Refusal> {
        let (theta, omega) = state.values.split_at(state.values.len() / 2);
        self.form.predict(theta, &self.momenta(theta, omega))
    }

    /// Returns the actions of the modes in phase through a state of all links, in J s.
    pub fn actions(&self, state: &State<f64>) -> Vec<DegreeEstimate> {
        let (theta, omega) = state.values.split_at(state.values.len() / 2);
        self.form.actions(theta, &self.momenta(theta, omega))
    }

    fn momenta(&self, theta: &[f64], omega: &[f64]) -> Vec<f64> {
        match omega.iter().all(|own| *own == 0.0) {
            true => vec![0.0; omega.len()],
            false => self.tree.momenta(theta, omega),
        }
    }
}
