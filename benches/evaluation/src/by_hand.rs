//! The paper's pendulum as one would write it by hand: both children are eliminated, and sine and
//! cosine are those of the standard library.

use super::table::GRAVITY;

/// The paper's pendulum with its constants computed beforehand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ByHand {
    m1: f64,
    m2: f64,
    mu: f64,
    g1: f64,
    g2: f64,
}

impl Default for ByHand {
    fn default() -> Self {
        let (m, d, i, l) = (0.12880, 0.084, 1.88e-3, 0.27);
        let (m_child, d_child, i_child) = (0.10531, 0.043, 0.516e-3);
        Self {
            m1: i + m * d * d + 2.0 * m_child * l * l,
            m2: i_child + m_child * d_child * d_child,
            mu: m_child * d_child * l,
            g1: GRAVITY * (m * d + 2.0 * m_child * l),
            g2: GRAVITY * m_child * d_child,
        }
    }
}

impl ByHand {
    /// Angular accelerations.
    #[inline]
    pub fn accelerations(&self, theta: &[f64; 3], omega: &[f64; 3]) -> [f64; 3] {
        let Self { m1, m2, mu, g1, g2 } = *self;
        let (s1, c1) = theta[0].sin_cos();
        let child = |theta: f64| {
            let (s, c) = theta.sin_cos();
            (s * c1 - c * s1, c * c1 + s * s1, s)
        };
        let (sin_2, cos_2, s2) = child(theta[1]);
        let (sin_3, cos_3, s3) = child(theta[2]);
        let w = omega.map(|omega| omega * omega);
        let b1 = g1 * s1 - mu * (sin_2 * w[1] + sin_3 * w[2]);
        let b2 = mu * sin_2 * w[0] + g2 * s2;
        let b3 = mu * sin_3 * w[0] + g2 * s3;
        let ratio = mu / m2;
        let pivot = m1 - mu * ratio * (cos_2 * cos_2 + cos_3 * cos_3);
        let a1 = (ratio * (cos_2 * b2 + cos_3 * b3) - b1) / pivot;
        [
            a1,
            -(b2 / m2 + ratio * cos_2 * a1),
            -(b3 / m2 + ratio * cos_3 * a1),
        ]
    }
}
