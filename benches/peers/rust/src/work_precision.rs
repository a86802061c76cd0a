//! Motions of the study `work-precision` that last ten seconds.

/// Motions, with their states at the end.
pub mod reference {
    use std::error::Error;

    use branched_pendulum::prelude::*;
    use branched_pendulum::scalar::Double;
    use branched_pendulum::system::TaylorOde;

    use crate::scenes::{BranchedDouble, Rods};

    /// End time of all motions, in s.
    pub const END: f64 = 10.0;

    /// Initial angles of the regular motion of the paper's pendulum, in rad.
    pub const REGULAR: [f64; 3] = [0.3, 1e-3, -1e-3];

    /// A motion from rest, with its state at the end.
    #[derive(Clone, Debug)]
    pub struct Problem {
        /// Name.
        pub name: &'static str,
        /// Initial angles, in rad.
        pub start: Vec<f64>,
        /// End time, in s.
        pub end: f64,
        /// Angles (rad) and velocities (rad/s) at the end.
        pub expected: Vec<f64>,
    }

    impl Problem {
        fn of<O: TaylorOde<Double>>(
            name: &'static str,
            ode: &O,
            start: &[f64],
        ) -> Result<Self, Box<dyn Error>> {
            let expected = states(ode, start, &[END])?.remove(0);
            Ok(Self {
                name,
                start: start.to_vec(),
                end: END,
                expected,
            })
        }
    }

    /// Returns angles and velocities at some times, computed by Taylor series with 31 digits and
    /// rounded.
    ///
    /// # Errors
    /// Errors of the integration.
    pub fn states<O: TaylorOde<Double>>(
        ode: &O,
        start: &[f64],
        times: &[f64],
    ) -> Result<Vec<Vec<f64>>, Box<dyn Error>> {
        let wide = |values: &[f64]| -> Vec<Double> {
            values.iter().copied().map(Double::from_f64).collect()
        };
        let method = Taylor::new(Options::with_tolerance(Double::from_f64(1e-24)));
        let start = State::at_rest(Double::from_f64(0.0), &wide(start));
        let states = method.sample_to_vec(ode, &start, &wide(times))?;
        let rounded =
            |state: &State<Double>| state.values.iter().map(|value| value.high()).collect();
        Ok(states.iter().map(rounded).collect())
    }

    /// Returns two motions of the paper's pendulum: a regular one, and a chaotic one near the
    /// threshold.
    ///
    /// # Errors
    /// Errors of the integration.
    pub fn papers() -> Result<[Problem; 2], Box<dyn Error>> {
        let tree = BranchedDouble::<Double>::default();
        let threshold = [47.8_f64.to_radians(), 1e-3, -1e-3];
        Ok([
            Problem::of("regular", &AbsoluteAngles(&tree), &REGULAR)?,
            Problem::of("near threshold", &AbsoluteAngles(&tree), &threshold)?,
        ])
    }

    /// Returns a motion of seven rods, ordered as the root, then each child followed by its own
    /// children.
    ///
    /// # Errors
    /// Errors of the integration.
    pub fn rods() -> Result<Problem, Box<dyn Error>> {
        let tree = Rods::<Double>::default();
        let start = [0.08, 0.005, 0.002, -0.001, -0.005, 0.0015, -0.003];
        Problem::of("seven rods", &AbsoluteAngles(&tree), &start)
    }
}
