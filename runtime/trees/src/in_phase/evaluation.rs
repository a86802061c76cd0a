//! The equations of a tree in phase, at one state.

use branched_pendulum::emitted::{Part, outlined};
use branched_pendulum::scalar::{Dual, Scalar};
use branched_pendulum::tree::LinkEquations;

use super::InPhaseTree;
use super::merged::MergedLinks;
use super::sweep::InPhaseSweep;
use crate::equations::{Form, GeneralEquations, RoughEquations, StraightEquations};

impl<T: Scalar> InPhaseTree<T> {
    /// Returns how many numbers an evaluation needs room for.
    pub(super) fn room(&self) -> usize {
        let of_link = match self.form {
            Form::Straight => InPhaseSweep::<StraightEquations, T>::ROOM,
            Form::General => InPhaseSweep::<GeneralEquations, T>::ROOM,
            Form::Rough => InPhaseSweep::<RoughEquations, T>::ROOM,
        };
        of_link * self.links()
    }

    /// Writes the rates of a state, in the arithmetic of `T`.
    #[inline(always)]
    pub(super) fn write(&self, room: &mut [T], time: T, state: &[T], rates: &mut [T]) {
        let half = self.links() + self.differing();
        if [state.len(), rates.len()] != [2 * half; 2] {
            rates.fill(T::from_f64(f64::NAN));
            return;
        }
        let (angles, velocities) = state.split_at(half);
        let (angle_rates, alpha) = rates.split_at_mut(half);
        angle_rates.copy_from_slice(velocities);
        let evaluation = (room, time, [angles, velocities], alpha);
        match self.form {
            Form::Straight => outlined::<STRAIGHT, T, _, _>(self, evaluation),
            Form::General => outlined::<GENERAL, T, _, _>(self, evaluation),
            Form::Rough => outlined::<ROUGH, T, _, _>(self, evaluation),
        }
    }

    #[inline(always)]
    fn accelerate<E: LinkEquations>(
        &self,
        (room, time, [angles, velocities], alpha): FormArguments<'_, T>,
    ) {
        let merged = &self.structure.merged.links;
        let torques = match self.between.is_empty() {
            true => Vec::new(),
            false => self.torques(angles, velocities),
        };
        let drive = self.drive.as_ref().map(|drive| drive.root(time));
        let mut sweep = InPhaseSweep::<E, T>::new(merged, &self.rows, drive, room);
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

    /// Returns the value of a link among those of links and differences, and its change.
    #[inline(always)]
    fn of(&self, values: &[T], link: usize) -> [T; 2] {
        let MergedLinks { links, .. } = &self.structure.merged;
        match links[link].difference {
            Some(number) => [values[link], values[links.len() + number]],
            None => [values[link], T::from_f64(0.0)],
        }
    }

    /// Returns the torques on each link by what acts between links of the whole tree, and their
    /// changes.
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

/// Room, time, angles and velocities, and the accelerations of an evaluation.
type FormArguments<'a, T> = (&'a mut [T], T, [&'a [T]; 2], &'a mut [T]);

/// The forms as parts of an evaluation: each is long, and a tree has one of them.
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

part!(STRAIGHT = 0: StraightEquations, GENERAL = 1: GeneralEquations, ROUGH = 2: RoughEquations);
