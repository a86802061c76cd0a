//! Wide numbers, parts of functions and batches in the hands of other crates.

use std::cell::Cell;

use branched_pendulum::batch::Batch;
use branched_pendulum::emitted::{Part, Simd, outlined};
use branched_pendulum::prelude::*;
use branched_pendulum::scalar::{Double, Dual, InstructionSet, Lanes};
use branched_pendulum::system::LinkName;

struct Squares;

impl<S: Scalar> Part<0, [S; 3]> for Squares {
    type Output = [S; 3];

    fn part(&self, numbers: [S; 3]) -> [S; 3] {
        numbers.map(|x| x * x)
    }
}

/// A part whose arguments are not of the number for whose instructions it is compiled.
impl Part<1, Vec<String>> for Squares {
    type Output = String;

    fn part(&self, texts: Vec<String>) -> String {
        texts.concat()
    }
}

#[test]
fn parts_are_computed_for_any_number() {
    fn squares<S: Scalar + PartialEq>() {
        let [x, y] = [3.0, 9.0].map(S::from_f64);
        assert!(outlined::<0, S, _, _>(&Squares, [x; 3]) == [y; 3]);
        let texts = vec!["no".to_owned(), "number".to_owned()];
        assert_eq!(outlined::<1, S, _, _>(&Squares, texts), "nonumber");
    }
    squares::<f64>();
    squares::<f32>();
    squares::<Double>();
    squares::<Dual<f64, 2>>();
    squares::<Lanes<f64, 1>>();
    squares::<Lanes<f32, 33>>();
    squares::<Lanes<Dual<f64, 1>, 2>>();
}

/// What the functions of wide numbers do at the ends of slices.
fn ends_of_slices<const N: usize>() {
    let numbers: Vec<f64> = (0..40).map(f64::from).collect();
    let nan = f64::NAN;
    for length in 0..=N + 2 {
        let some = &numbers[..length];
        let front = <Lanes<f64, N> as Simd<f64>>::load(some);
        let last = <Lanes<f64, N> as Simd<f64>>::last_chunk(some);
        assert_eq!(front.is_some(), length >= N);
        assert_eq!(last.is_some(), length >= N);
        let Some(front) = front else {
            let mut buffer = vec![nan; length];
            Simd::<f64>::store(Lanes([1.0; N]), &mut buffer);
            Simd::<f64>::store_last(Lanes([1.0; N]), &mut buffer);
            assert!(buffer.iter().all(|number| number.is_nan()));
            continue;
        };
        assert_eq!(front.0[..], some[..N]);
        assert_eq!(last.unwrap()[..], some[length - N..]);
        assert_eq!(Simd::<f64>::first(front), 0.0);
        let mut buffer = vec![nan; length];
        Simd::<f64>::store(front, &mut buffer[length - N..]);
        Simd::<f64>::store_last(front, &mut buffer);
        assert_eq!(buffer[length - N..], some[..N]);
        for count in [0, 1, N, N + 1, usize::MAX] {
            let either = Simd::<f64>::in_first_lanes(front, count, Lanes([nan; N]));
            let kept = either.0.iter().filter(|number| !number.is_nan()).count();
            assert_eq!(kept, count.min(N));
            // Any lanes, and none beyond.
            let moved = Simd::<f64>::rotate_lanes(front, count).0;
            let tiled = Simd::<f64>::tile_lanes(front, count).0;
            assert!(
                moved
                    .iter()
                    .chain(&tiled)
                    .all(|lane| front.0.contains(lane))
            );
        }
    }
}

#[test]
fn wide_numbers_stay_within_slices() {
    ends_of_slices::<1>();
    ends_of_slices::<2>();
    ends_of_slices::<5>();
    ends_of_slices::<8>();
    ends_of_slices::<16>();
    ends_of_slices::<33>();
}

/// A slice that is never as long as it was.
struct Trembling {
    numbers: Vec<f64>,
    asked: Cell<usize>,
}

impl Trembling {
    fn new(length: usize) -> Self {
        Self {
            numbers: vec![0.3; length],
            asked: Cell::new(0),
        }
    }

    /// As long as said when asked the first times, then of other lengths.
    fn length(&self) -> usize {
        let asked = self.asked.replace(self.asked.get() + 1);
        match asked {
            0..3 => self.numbers.len(),
            _ => asked * 7 % (self.numbers.len() + 1),
        }
    }
}

impl AsRef<[f64]> for Trembling {
    fn as_ref(&self) -> &[f64] {
        &self.numbers[..self.length()]
    }
}

impl AsMut<[f64]> for Trembling {
    fn as_mut(&mut self) -> &mut [f64] {
        let length = self.length();
        &mut self.numbers[..length]
    }
}

/// A model that is wrong about itself: links, which it counts otherwise than its type does,
/// room, and which numbers it gives.
struct Liar<T, const LINKS: usize> {
    number: T,
    counted: usize,
}

impl<T: Scalar, const LINKS: usize> Model<T> for Liar<T, LINKS> {
    type Of<S: Scalar> = Liar<S, 7>;
    const KNOWN_LINKS: Option<usize> = Some(LINKS);

    fn links(&self) -> usize {
        self.counted
    }

    fn link_name(&self, _: usize) -> Option<LinkName<'_>> {
        None
    }

    fn cast<S: Scalar>(&self, convert: impl Fn(T) -> S) -> Liar<S, 7> {
        Liar {
            number: convert(self.number),
            counted: self.counted + 2,
        }
    }
}

impl<T: Scalar, const LINKS: usize> Pendulum<T> for Liar<T, LINKS> {
    fn evaluate(
        &self,
        _time: T,
        theta: impl Fn(usize) -> T,
        omega: impl Fn(usize) -> T,
        mut alpha: impl FnMut(usize, T),
    ) {
        for link in [0, 1, 2, 3, 100, usize::MAX / 16, usize::MAX] {
            let far = link.wrapping_mul(3);
            alpha(link, theta(far).sin_cos().0 * omega(link) + self.number);
        }
    }

    fn workspace_len(&self) -> usize {
        1
    }
}

fn lies<const LINKS: usize>(counted: usize) {
    let model = Liar::<_, LINKS> {
        number: 0.5,
        counted,
    };
    for set in InstructionSet::ALL {
        for states in [0, 1, 3, 8, 40] {
            let slices =
                || -> Vec<Trembling> { (0..counted).map(|_| Trembling::new(states)).collect() };
            let mut alpha = slices();
            let mut batch = Batch::new(&model).no_wider_than(set);
            // Which numbers come out is as open as which came in.
            let _ = batch.accelerations(0.0, &slices(), &slices(), &mut alpha);
        }
    }
    for length in [0, 1, LINKS, LINKS + 1, counted, counted + 1] {
        let (theta, mut alpha) = (vec![0.5; length], vec![0.0; length]);
        model.accelerations_into(0.0, &theta, &theta, &mut alpha);
        assert!(length == counted || alpha.iter().all(|number| number.is_nan()));
    }
}

#[test]
fn models_and_slices_that_are_wrong_about_themselves() {
    for counted in [0, 1, 2, 3, 7, 64, 65] {
        lies::<0>(counted);
        lies::<1>(counted);
        lies::<2>(counted);
        lies::<3>(counted);
        lies::<7>(counted);
        lies::<64>(counted);
    }
}
