//! Integrals over one step of an integrator, by Gauss's quadrature.

/// Nodes and weights of Gauss's quadrature with five points on 0 to 1, exact
/// for polynomials of degree 9.
///
/// Source: M. Abramowitz and I. A. Stegun, *Handbook of Mathematical Functions*, table 25.4,
/// converted from −1…1.
pub const GAUSS: [(f64, f64); 5] = [
    (0.046_910_077_030_668, 0.118_463_442_528_094_54),
    (0.230_765_344_947_158_45, 0.239_314_335_249_683_23),
    (0.5, 0.284_444_444_444_444_44),
    (0.769_234_655_052_841_5, 0.239_314_335_249_683_23),
    (0.953_089_922_969_332, 0.118_463_442_528_094_54),
];

#[cfg(test)]
mod tests {
    use super::GAUSS;

    #[test]
    fn the_quadrature_is_exact_to_degree_nine() {
        for degree in 0..10 {
            let sum: f64 = GAUSS.iter().map(|(x, w)| w * x.powi(degree)).sum();
            assert!((sum - 1.0 / f64::from(degree + 1)).abs() < 1e-15);
        }
        let sum: f64 = GAUSS.iter().map(|(x, w)| w * x.powi(10)).sum();
        assert!((sum - 1.0 / 11.0).abs() > 1e-7);
    }
}
