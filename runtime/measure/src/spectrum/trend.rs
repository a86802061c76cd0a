//! Slow drift of a record, described by a polynomial of low degree.

/// Writes the values of the Legendre polynomials up to the degree `values.len() − 1` at a position
/// between −1 and 1.
pub(super) fn legendre(place: f64, values: &mut [f64]) {
    for degree in 0..values.len() {
        values[degree] = match degree {
            0 => 1.0,
            1 => place,
            _ => {
                let k = (degree - 1) as f64;
                ((2.0 * k + 1.0) * place * values[degree - 1] - k * values[degree - 2]) / (k + 1.0)
            }
        };
    }
}

/// Converts a sum of Legendre polynomials in s/`half` to coefficients of powers of the time s.
pub(super) fn powers(sum: &[f64], half: f64) -> Vec<f64> {
    let count = sum.len();
    let mut powers = vec![0.0; count];
    let (mut before, mut own) = (vec![0.0; count + 1], vec![0.0; count + 1]);
    own[0] = 1.0;
    for (degree, coefficient) in sum.iter().enumerate() {
        for (power, own) in powers.iter_mut().zip(&own) {
            *power += coefficient * own;
        }
        let k = degree as f64;
        let mut next = vec![0.0; count + 1];
        for (power, next) in next.iter_mut().enumerate() {
            let raised = if power == 0 { 0.0 } else { own[power - 1] };
            *next = ((2.0 * k + 1.0) * raised - k * before[power]) / (k + 1.0);
        }
        (before, own) = (own, next);
    }
    let mut scale = 1.0;
    for power in &mut powers {
        *power /= scale;
        scale *= half;
    }
    powers
}

#[cfg(test)]
mod tests {
    use super::{legendre, powers};

    /// Checks that the recurrence for values and the one for coefficients give the same polynomial.
    #[test]
    fn powers_are_those_of_the_sum() {
        for sum in [
            &[2.0, -0.5][..],
            &[0.0, 0.0, 1.0],
            &[0.3, 1.0, -2.0, 0.7, 0.1],
        ] {
            let powers = powers(sum, 20.0);
            for place in [-1.0, -0.3, 0.0, 0.8] {
                let mut values = vec![0.0; sum.len()];
                legendre(place, &mut values);
                let expected: f64 = values.iter().zip(sum).map(|(p, c)| p * c).sum();
                let s: f64 = 20.0 * place;
                let found: f64 = (0..).zip(&powers).map(|(k, c)| c * s.powi(k)).sum();
                assert!((found - expected).abs() < 1e-12, "{sum:?} {place}");
            }
        }
        // (5 p³ − 3 p)/2.
        assert_eq!(powers(&[0.0, 0.0, 0.0, 1.0], 1.0), [0.0, -1.5, 0.0, 2.5]);
    }
}
