//! Evaluation of the equations of an in-phase tree at one state.

use branched_pendulum::emitted::{Part, outlined};
use branched_pendulum::scalar::{Dual, Scalar};
use branched_pendulum::tree::LinkEquations;

use super::InPhaseTree;
use super::merged::MergedLinks;
use super::sweep::InPhaseSweep;
use crate::equations::{Form, GeneralEquations, NonViscousEquations, PlainEquations};

impl<T: Scalar> InPhaseTree<T> {
    /// Returns the length of the buffer that an evaluation needs, in numbers.
    pub(super) fn workspace_len(&self) -> usize {
        let of_link = match self.form {
            Form::Plain => InPhaseSweep::<PlainEquations, T>::WORKSPACE_LEN,
            Form::General => InPhaseSweep::<GeneralEquations, T>::WORKSPACE_LEN,
            Form::NonViscous => InPhaseSweep::<NonViscousEquations, T>::WORKSPACE_LEN,
        };
        of_link * self.links()
    }

    /// Writes the rates of a state, in the arithmetic of `T`.
    #[inline(always)]
    pub(super) fn write(&self, buffer: &mut [T], time: T, state: &[T], rates: &mut [T]) {
        let half = self.links() + self.differing();
        if [state.len(), rates.len()] != [2 * half; 2] {
            rates.fill(T::from_f64(f64::NAN));
            return;
        }
        let (angles, velocities) = state.split_at(half);
        let (angle_rates, alpha) = rates.split_at_mut(half);
        angle_rates.copy_from_slice(velocities);
        let evaluation = (buffer, time, [angles, velocities], alpha);
        match self.form {
            Form::Plain => outlined::<PLAIN, T, _, _>(self, evaluation),
            Form::General => outlined::<GENERAL, T, _, _>(self, evaluation),
            Form::NonViscous => outlined::<NON_VISCOUS, T, _, _>(self, evaluation),
        }
    }

    #[inline(always)]
    fn accelerate<E: LinkEquations>(
        &self,
        (buffer, time, [angles, velocities], alpha): FormArguments<'_, T>,
    ) {
        let merged = &self.structure.merged.links;
        let torques = match self.between.is_empty() {
            true => Vec::new(),
            false => self.torques(angles, velocities),
        };
        let drive = self.drive.as_ref().map(|drive| drive.root(time));
        let mut sweep = InPhaseSweep::<E, T>::new(merged, &self.rows, drive, buffer);
        for link in 0..merged.len() {
            let torque = torques.get(link).copied();
            let torque = torque.unwrap_or([T::from_f64(0.0); 2]);
            sweep.set(
                link,
                [self.of(angles, link), self.of(velocities, link), torque],
            );
        }
        sweep.up();
        let [x, y] = match drive {
            Some(drive) => drive.pivot,
            None => [T::from_f64(0.0); 2],
        };
        sweep.down([x, self.above + y], |link, value, change| {
            alpha[link] = value;
            if let Some(number) = merged[link].difference {
                alpha[merged.len() + number] = change;
            }
        });
    }

    /// Returns the angle (or rate) of a link of the whole tree, and its derivative by the
    /// difference. `values` contains the angles (or rates) of the merged links, then the
    /// differences.
    #[inline(always)]
    fn of(&self, values: &[T], link: usize) -> [T; 2] {
        let MergedLinks { links, .. } = &self.structure.merged;
        match links[link].difference {
            Some(number) => [values[link], values[links.len() + number]],
            None => [values[link], T::from_f64(0.0)],
        }
    }

    /// Returns, for each link, the torque of springs and friction between links of the whole tree,
    /// and its change by the differences.
    #[inline(always)]
    fn torques(&self, angles: &[T], velocities: &[T]) -> Vec<[T; 2]> {
        let zero = Dual::constant(T::from_f64(0.0));
        let members = &self.structure.merged.members;
        let mut numbers = vec![zero; 3 * members.len()];
        let (theta, rest) = numbers.split_at_mut(members.len());
        let (omega, on_whole) = rest.split_at_mut(members.len());
        for (values, whole) in [(angles, &mut *theta), (velocities, &mut *omega)] {
            for (member, number) in members.iter().zip(whole) {
                let [value, change] = self.of(values, member.merged);
                let tangents = [T::from_f64(member.sign) * change];
                *number = Dual { value, tangents };
            }
        }
        self.between.write_torques(None, [theta, omega], on_whole);
        let mut torques = vec![[zero.value; 2]; self.links()];
        for (member, Dual { value, tangents }) in members.iter().zip(on_whole) {
            let [sum, change] = &mut torques[member.merged];
            *sum = *sum + *value;
            *change = *change + T::from_f64(member.share) * tangents[0];
        }
        torques
    }
}

/// Arguments of an evaluation: buffer, time, \[angles, velocities\], and the accelerations to
/// write.
type FormArguments<'a, T> = (&'a mut [T], T, [&'a [T]; 2], &'a mut [T]);

/// Defines the evaluation of each form of the equations as a separate function, because each is
/// long and a tree uses only one.
macro_rules! part {
    ($($number:ident = $value:literal: $equations:ident),*) => {$(
        const $number: usize = $value;

        impl<T: Scalar> Part<$number, FormArguments<'_, T>> for InPhaseTree<T> {
            type Output = ();

            #[inline(always)]
            fn part(&self, evaluation: FormArguments<'_, T>) {
                self.accelerate::<$equations>(evaluation);
            }
        }
    )*};
}

part!(PLAIN = 0: PlainEquations, GENERAL = 1: GeneralEquations, NON_VISCOUS = 2: NonViscousEquations);
