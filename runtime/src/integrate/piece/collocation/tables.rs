//! Coefficients of the Gauss–Legendre methods of 1 to 4 stages.
//!
//! Source: Hairer, Lubich, Wanner, *Geometric Numerical Integration*, 2nd edition, Springer 2006,
//! section II.1.3: collocation at the zeros of the shifted Legendre polynomials. Computed from that
//! definition in 50 digits. Each coefficient is stored as a multiple of 1/1024, whose products with
//! rates have no systematic rounding error, plus a small remainder. A rounded coefficient would
//! violate symplecticity in the same direction in every step (Hairer, McLachlan, Razakarivony,
//! *Achieving Brouwer's law with implicit Runge–Kutta methods*, BIT 48 (2008) 231–243).

/// Coefficient, stored as a multiple of 1/1024 and a small remainder.
pub(in crate::integrate) type Split = (f64, f64);

/// Coefficients of one Gauss–Legendre method.
#[derive(Debug)]
pub(in crate::integrate) struct GaussTable {
    /// Nodes c.
    pub(in crate::integrate) nodes: &'static [f64],
    /// Rows of the matrix a of coefficients, one after the other.
    pub(in crate::integrate) matrix: &'static [Split],
    /// Weights b.
    pub(in crate::integrate) weights: &'static [Split],
    /// Integrals from 0 to x of the Lagrange polynomials of the nodes: the coefficients of x, x²,
    /// …, with one row per node.
    pub(in crate::integrate) integrals: &'static [f64],
}

/// Coefficients of the methods of 1 to 4 stages.
pub(super) const TABLES: [GaussTable; 4] = [
    GaussTable {
        nodes: &[0.5],
        matrix: &[(0.5, 0.0)],
        weights: &[(1.0, 0.0)],
        integrals: &[1.0],
    },
    GaussTable {
        nodes: &[0.2113248654051871, 0.7886751345948129],
        matrix: &[
            (0.25, 0.0),
            (-0.0390625, 0.0003873654051871177),
            (0.5390625, -0.0003873654051871177),
            (0.25, -6.681911775230489e-52),
        ],
        weights: &[(0.5, 0.0), (0.5, 1.3363823550460978e-51)],
        integrals: &[
            1.3660254037844386,
            -0.8660254037844386,
            -0.36602540378443865,
            0.8660254037844386,
        ],
    },
    GaussTable {
        nodes: &[0.11270166537925831, 0.5, 0.8872983346207417],
        matrix: &[
            (0.138671875, 0.00021701388888888888),
            (-0.0361328125, 0.00015614497506109655),
            (0.009765625, 2.381901530832605e-05),
            (0.2998046875, 0.00045850748086459243),
            (0.22265625, -0.00043402777777777775),
            (-0.0224609375, -2.447970308681466e-05),
            (0.267578125, 0.00041020876246945174),
            (0.48046875, -4.76380306166521e-05),
            (0.138671875, 0.00021701388888888888),
        ],
        weights: &[
            (0.27734375, 0.00043402777777777775),
            (0.4443359375, 0.00010850694444444444),
            (0.27734375, 0.00043402777777777775),
        ],
        integrals: &[
            1.4788305577012362,
            -2.3121638910345697,
            1.1111111111111112,
            -0.6666666666666666,
            3.3333333333333335,
            -2.2222222222222223,
            0.18783610896543051,
            -1.0211694422987638,
            1.1111111111111112,
        ],
    },
    GaussTable {
        nodes: &[
            0.06943184420297371,
            0.33000947820757187,
            0.6699905217924281,
            0.9305681557970263,
        ],
        matrix: &[
            (0.0869140625, 4.9648784363464346e-05),
            (-0.0263671875, -0.0002369925849987933),
            (0.0126953125, -6.784981059527548e-05),
            (-0.00390625, 0.00035110031420431683),
            (0.1884765625, -0.00035844500013192836),
            (0.1630859375, -4.9648784363464346e-05),
            (-0.0283203125, 0.00043988389752910477),
            (0.0068359375, -0.00010043690546184449),
            (0.1669921875, 0.00019973447418877318),
            (0.353515625, 0.00043738103374396653),
            (0.1630859375, -4.9648784363464346e-05),
            (-0.0146484375, 0.000457742568858857),
            (0.177734375, -0.0002518027454773882),
            (0.3134765625, -3.14477581316532e-05),
            (0.3525390625, 0.00013769501627186462),
            (0.0869140625, 4.9648784363464346e-05),
        ],
        weights: &[
            (0.173828125, 9.929756872692869e-05),
            (0.326171875, -9.929756872692869e-05),
            (0.326171875, -9.929756872692869e-05),
            (0.173828125, 9.929756872692869e-05),
        ],
        integrals: &[
            1.5267881254572668,
            -4.273011803936099,
            4.775286118057296,
            -1.8551350170097365,
            -0.8136324494869273,
            6.9035834628447885,
            -10.462740787815353,
            4.698862351888765,
            0.4007615203116504,
            -3.7085352107313194,
            8.332708619739707,
            -4.698862351888765,
            -0.11391719628198993,
            1.0779635518226305,
            -2.64525394998165,
            1.8551350170097365,
        ],
    },
];

#[cfg(test)]
mod tests {
    use super::TABLES;

    fn whole(split: (f64, f64)) -> f64 {
        split.0 + split.1
    }

    #[test]
    fn weights_integrate_polynomials_of_degree_2s_minus_1() {
        for table in &TABLES {
            let s = table.nodes.len();
            for power in 0..2 * s {
                let both = table.weights.iter().zip(table.nodes);
                let sum: f64 = both.map(|(&b, c)| whole(b) * c.powi(power as i32)).sum();
                assert!(
                    (sum - 1.0 / (power + 1) as f64).abs() < 1e-15,
                    "{s} {power}"
                );
            }
        }
    }

    #[test]
    fn stages_integrate_polynomials_of_degree_s_minus_1() {
        for table in &TABLES {
            let s = table.nodes.len();
            for (row, node) in table.matrix.chunks(s).zip(table.nodes) {
                for power in 0..s as i32 {
                    let both = row.iter().zip(table.nodes);
                    let sum: f64 = both.map(|(&a, c)| whole(a) * c.powi(power)).sum();
                    let expected = node.powi(power + 1) / f64::from(power + 1);
                    assert!((sum - expected).abs() < 1e-15);
                }
            }
        }
    }

    #[test]
    fn integrals_at_the_nodes_are_the_matrix() {
        for table in &TABLES {
            let s = table.nodes.len();
            for (i, node) in table.nodes.iter().enumerate() {
                for (j, row) in table.integrals.chunks(s).enumerate() {
                    let value = row.iter().rev().fold(0.0, |sum, c| (sum + c) * node);
                    assert!((value - whole(table.matrix[i * s + j])).abs() < 2e-15);
                }
            }
        }
    }

    /// Checks b_i a_ij + b_j a_ji = b_i b_j, the condition of symplecticity (Geometric Numerical
    /// Integration, theorem VI.4.3), to the last bit that the split coefficients hold.
    #[test]
    fn the_condition_of_symplecticity() {
        for table in &TABLES {
            let s = table.nodes.len();
            for i in 0..s {
                for j in 0..s {
                    let (b_i, b_j) = (whole(table.weights[i]), whole(table.weights[j]));
                    let a_ij = whole(table.matrix[i * s + j]);
                    let a_ji = whole(table.matrix[j * s + i]);
                    assert!((b_i * a_ij + b_j * a_ji - b_i * b_j).abs() < 1e-16);
                }
            }
        }
    }
}
