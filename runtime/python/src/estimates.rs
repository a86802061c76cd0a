//! Estimated motions, without Python.

use branched_pendulum_measure::{
    KinematicSmoother, LocalPolynomials, SmoothedCoordinates, SmoothedMotion as Smoothed,
    SmoothingError,
};

/// Function that draws a random motion, given a source of normal random numbers: states, one after
/// the other.
pub(crate) type Draw = dyn Fn(&mut dyn FnMut() -> f64) -> Vec<f64> + Send + Sync;

/// Mean and standard deviation of an estimated motion, one row per time, as Rust data.
pub(crate) struct Estimate {
    pub(crate) states: [Vec<f64>; 2],
    /// Accelerations and their standard deviations; `None` if the method does not estimate them.
    pub(crate) accelerations: Option<[Vec<f64>; 2]>,
    /// Standard deviation of the data, for each coordinate that was smoothed.
    pub(crate) noise: Vec<f64>,
    pub(crate) whiteness: f64,
    /// Friction in the pivot of each link that the equations of motion lack, in N m s.
    pub(crate) frictions: Vec<f64>,
    pub(crate) draw: Box<Draw>,
}

/// Linear maps between the angles of the links and the coordinates that are smoothed, one row per
/// result.
#[derive(Clone, Debug)]
pub(crate) struct Coordinates {
    pub(crate) of_links: Vec<Vec<f64>>,
    pub(crate) links: Vec<Vec<f64>>,
}

impl Coordinates {
    /// The angles themselves.
    pub(crate) fn links(count: usize) -> Self {
        let row = |own: usize| {
            (0..count)
                .map(|at| f64::from(u8::from(at == own)))
                .collect()
        };
        let unit: Vec<Vec<f64>> = (0..count).map(row).collect();
        Self {
            of_links: unit.clone(),
            links: unit,
        }
    }

    /// Returns the data of a coordinate; a value is missing if the angle of a link that contributes
    /// to it is missing.
    fn data(&self, coordinate: usize, angles: &[Vec<Option<f64>>]) -> Vec<Option<f64>> {
        let weights = &self.of_links[coordinate];
        let sum = |row: &Vec<Option<f64>>| {
            let terms = weights
                .iter()
                .zip(row)
                .filter(|(weight, _)| **weight != 0.0);
            terms.map(|(weight, angle)| Some(weight * (*angle)?)).sum()
        };
        angles.iter().map(sum).collect()
    }

    /// Returns the angles of the links, given the values of the coordinates.
    fn angles(&self, coordinates: &[f64]) -> impl Iterator<Item = f64> {
        let sum = move |weights: &Vec<f64>| -> f64 {
            weights
                .iter()
                .zip(coordinates)
                .map(|(weight, value)| weight * value)
                .sum()
        };
        self.links.iter().map(sum)
    }

    /// Returns the standard deviations of the links' angles, given those of the coordinates, whose
    /// errors are independent.
    fn deviations(&self, coordinates: &[f64]) -> impl Iterator<Item = f64> {
        let sum = move |weights: &Vec<f64>| -> f64 {
            let terms = weights.iter().zip(coordinates);
            terms.map(|(weight, value)| (weight * value).powi(2)).sum()
        };
        self.links.iter().map(move |weights| sum(weights).sqrt())
    }

    fn state(&self, state: &[f64]) -> Vec<f64> {
        let (values, rates) = state.split_at(self.links.len());
        self.angles(values).chain(self.angles(rates)).collect()
    }
}

/// A smoother that uses no equations of motion, selected by name.
#[derive(Clone, Copy)]
pub(crate) enum Smoother {
    Kinematic(KinematicSmoother),
    Polynomials(LocalPolynomials),
}

impl Smoother {
    pub(crate) fn of(method: &str, noise: Option<f64>) -> Option<Self> {
        match method {
            "kinematic" => Some(Self::Kinematic(KinematicSmoother { noise, jerk: None })),
            "polynomials" => {
                let usual = LocalPolynomials::default();
                Some(Self::Polynomials(LocalPolynomials { noise, ..usual }))
            }
            _ => None,
        }
    }

    fn smooth(self, times: &[f64], data: &[Option<f64>]) -> Result<Smoothed, SmoothingError> {
        match self {
            Self::Kinematic(smoother) => smoother.smooth(times, data),
            Self::Polynomials(smoother) => smoother.smooth(times, data),
        }
    }

    /// Smooths each of the coordinates separately.
    pub(crate) fn estimate(
        self,
        times: &[f64],
        angles: &[Vec<Option<f64>>],
        coordinates: Coordinates,
    ) -> Result<Estimate, SmoothingError> {
        let data = (0..coordinates.of_links.len()).map(|own| coordinates.data(own, angles));
        let smoothed = SmoothedCoordinates::new(data, |data| self.smooth(times, data))?;
        let all = smoothed.coordinates();
        // Of the coordinates' values, rates and accelerations, at a time.
        let rows = |of: &dyn Fn(&Smoothed) -> [f64; 3]| -> [Vec<f64>; 3] {
            let each: Vec<[f64; 3]> = all.iter().map(of).collect();
            [0, 1, 2].map(|order| each.iter().map(|own| own[order]).collect())
        };
        let mut states = [Vec::new(), Vec::new()];
        let mut accelerations = [Vec::new(), Vec::new()];
        for time in 0..times.len() {
            let [values, rates, second] = rows(&|own| own.mean(time));
            states[0].extend(
                coordinates
                    .angles(&values)
                    .chain(coordinates.angles(&rates)),
            );
            accelerations[0].extend(coordinates.angles(&second));
            let [values, rates, second] = rows(&|own| own.deviation(time));
            let [values, rates] = [&values, &rates].map(|own| coordinates.deviations(own));
            states[1].extend(values.chain(rates));
            accelerations[1].extend(coordinates.deviations(&second));
        }
        Ok(Estimate {
            states,
            accelerations: Some(accelerations),
            noise: all.iter().map(Smoothed::noise).collect(),
            whiteness: smoothed.whiteness(),
            frictions: Vec::new(),
            draw: Box::new(move |normal| {
                let drawn = smoothed.draw(normal);
                drawn
                    .iter()
                    .flat_map(|state| coordinates.state(state))
                    .collect()
            }),
        })
    }
}
