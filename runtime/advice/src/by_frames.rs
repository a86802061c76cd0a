//! Candidates that advance states by frames of constant length.

use std::cell::RefCell;
use std::error::Error;

use crate::candidate::{Candidate, CandidateName, SettingRange, Visit};
use crate::candidates::Candidates;
use crate::form::ModelForm;
use branched_pendulum::interruption;
use branched_pendulum::scalar::Real;
use branched_pendulum::system::State;

impl<'a> Candidates<'a> {
    /// Adds a model that advances by frames of constant length, such as a linear model or a game
    /// loop. `step` advances the state by one frame of `frame` seconds, in place. Sample times must
    /// be ends of frames.
    ///
    /// # Examples
    ///
    /// ```
    /// use branched_pendulum_advice::{Candidates, ModelForm};
    ///
    /// // Small oscillations of frequency 1 rad/s, in f32.
    /// let (sin, cos) = (1.0_f32 / 60.0).sin_cos();
    /// let turn = move |state: &mut [f32]| {
    ///     let [angle, rate] = [state[0], state[1]];
    ///     state[0] = cos * angle + sin * rate;
    ///     state[1] = cos * rate - sin * angle;
    /// };
    /// let form = ModelForm::new("linear").system("linear.frames(1.0 / 60.0)?");
    /// let candidates = Candidates::new().frames(&form, "f32", 1.0 / 60.0, turn);
    /// assert_eq!(candidates.len(), 1);
    /// ```
    #[must_use]
    pub fn frames<T: Real>(
        self,
        form: &ModelForm<'a>,
        scalar: &'static str,
        frame: f64,
        step: impl FnMut(&mut [T]) + 'a,
    ) -> Self {
        self.with(ByFrames {
            form: form.clone(),
            scalar,
            frame,
            step: RefCell::new(step),
            state: std::marker::PhantomData::<T>,
        })
    }
}

struct ByFrames<'a, T, F> {
    form: ModelForm<'a>,
    scalar: &'static str,
    frame: f64,
    step: RefCell<F>,
    state: std::marker::PhantomData<T>,
}

/// Largest distance of a sample from the end of a frame, as a fraction of the frame.
const AWAY: f64 = 1e-6;

impl<T: Real, F: FnMut(&mut [T])> Candidate for ByFrames<'_, T, F> {
    fn name(&self) -> CandidateName {
        CandidateName::new(&self.form.name, "by frames", self.scalar)
    }

    fn settings(&self) -> SettingRange {
        SettingRange::Fixed
    }

    fn run(
        &self,
        _: f64,
        starts: &[State<f64>],
        times: &[f64],
        visit: &mut Visit<'_>,
    ) -> Result<u64, Box<dyn Error + Send + Sync>> {
        let step = &mut *self.step.borrow_mut();
        let mut frames = 0;
        for (index, start) in starts.iter().enumerate() {
            let mut state = self.form.entered::<T>(start).values;
            let (mut done, mut values) = (0.0, Vec::new());
            for (number, time) in times.iter().enumerate() {
                let due = (time - start.time) / self.frame;
                if (due - due.round()).abs() > AWAY || due.round() < done {
                    return Err(format!("no frame ends at t = {time} s").into());
                }
                interruption::look();
                while done < due.round() {
                    step(&mut state);
                    done += 1.0;
                    frames += 1;
                }
                values.clear();
                values.extend(state.iter().map(|value| value.to_f64()));
                self.form
                    .left(&values, &mut |state| visit(index, number, state));
            }
        }
        Ok(frames)
    }

    fn to_write(&self, _: f64) -> Vec<String> {
        vec![self.form.attribute(), Some(self.form.system.clone())]
            .into_iter()
            .flatten()
            .collect()
    }
}
