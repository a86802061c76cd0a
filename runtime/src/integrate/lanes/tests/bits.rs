//! A trajectory has bits of its own, whatever runs beside it.

use core::num::NonZeroUsize;
use core::slice::from_ref;

use super::{Cases, END, Each, LaneMethod, LopsidedOde, assert_same, lopsided, outcomes};
use super::{starts, times, with_each, with_each_kind};
use crate::ensemble::Ensemble;
use crate::integrate::{Dop853, Options, Taylor};
use crate::scalar::{InstructionSet, Lane};

struct NeitherPlaceNorNeighbours;

impl<T: Lane> Each<T> for NeitherPlaceNorNeighbours {
    fn each<M: LaneMethod<LopsidedOde<T>, T>>(&mut self, method: &M) {
        let (mut starts, times, end) = (starts::<T>(), times(), T::from_f64(END));
        // Bad neighbours: no number, far beyond the common range of sine and cosine,
        // beyond the wall, soon beyond the wall, behind the times.
        starts[3].values[0] = T::NAN;
        starts[11].values[0] = T::from_f64(1e9);
        starts[12].values[1] = T::from_f64(8.0);
        starts[13].values[3] = T::from_f64(60.0);
        starts[14].time = end;
        let model = lopsided();
        let from =
            |set, starts: &[_]| outcomes(set, method, Cases::Starts(&model, starts), &times, end);
        for set in InstructionSet::ALL {
            let together = from(set, &starts);
            let alone: Vec<_> = starts
                .iter()
                .flat_map(|start| from(set, from_ref(start)))
                .collect();
            assert_same(&together, &alone);
            let reversed: Vec<_> = starts.iter().rev().cloned().collect();
            let mut reversed = from(set, &reversed);
            reversed.reverse();
            assert_same(&together, &reversed);
            for (index, outcome) in together.iter().enumerate() {
                let bad = [3, 12, 13, 14].contains(&index);
                // At 1e9 rad a number may have too few digits for a step.
                assert!(outcome.end.is_ok() != bad || index == 11, "{index}");
            }
        }
        let [_, avx2, avx512] = InstructionSet::ALL.map(|set| from(set, &starts));
        assert_same(&avx2, &avx512);
    }
}

#[test]
fn bits_depend_on_the_start_alone() {
    let double = Options::with_tolerance(1e-8);
    with_each(&double, &mut NeitherPlaceNorNeighbours);
    NeitherPlaceNorNeighbours.each(&Taylor::new(double).with_order(9));
    let single = Options::with_tolerance(1e-4_f32);
    with_each_kind(&single, &mut NeitherPlaceNorNeighbours);
}

#[test]
fn bits_do_not_depend_on_threads_and_progress_counts_all() {
    let (starts, model) = (starts::<f64>(), lopsided());
    let method = Dop853::new(Options::with_tolerance(1e-9));
    let cases = Cases::Starts(&model, &starts);
    let one = outcomes(InstructionSet::widest(), &method, cases, &[], END);
    for count in [1, 2, 5, 100] {
        let done = std::sync::atomic::AtomicUsize::new(0);
        let count_done = |_: usize| {
            done.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
        };
        let many = Ensemble::new()
            .threads(NonZeroUsize::new(count).unwrap())
            .progress(&count_done)
            .integrate_in_lanes(&method, &model, &starts, END);
        let one: Vec<_> = one.iter().map(|outcome| outcome.end.clone()).collect();
        assert_eq!(many, one);
        assert_eq!(done.into_inner(), starts.len());
    }
}
