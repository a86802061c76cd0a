//! Coefficients of Dormand and Prince's method of order 8(5,3).
//!
//! Source: E. Hairer, S. P. Nørsett, G. Wanner, *Solving Ordinary Differential
//! Equations I. Nonstiff Problems*, 2nd edition, Springer 1993, sections II.5,
//! II.6 and II.10; digits as in the authors' program `dop853.f` (version of
//! October 11, 2009), which writes c₁₄…c₁₆ where the extra stages of the dense
//! output begin. Stages count from 1, as there; entries that are not listed
//! are zero. The tests check the row sums, the order conditions and the
//! measured order.

// The source gives 30 digits; keeping them makes the comparison by eye exact.
#![allow(clippy::excessive_precision)]

use crate::integrate::explicit::pair::TableRow;

/// Order of the solution from which the next step starts.
pub(super) const ORDER: u32 = 8;
/// Number of stages of a step without dense output. The first is shared with the step before.
pub(super) const STAGES: usize = 12;
/// Number of all stages: the step, the rates at its end, and three for the dense output.
pub(super) const STAGES_DENSE: usize = 16;

/// Nodes c of the stages, as fractions of the step.
pub(super) const C: [f64; STAGES_DENSE] = [
    0.0,
    0.526001519587677318785587544488e-01,
    0.789002279381515978178381316732e-01,
    0.118350341907227396726757197510e+00,
    0.281649658092772603273242802490e+00,
    0.333333333333333333333333333333e+00,
    0.25,
    0.307692307692307692307692307692e+00,
    0.651282051282051282051282051282e+00,
    0.6,
    0.857142857142857142857142857142e+00,
    1.0,
    1.0,
    0.1,
    0.2,
    0.777777777777777777777777777778e+00,
];

pub(super) const A2: TableRow<1> = [(1, 5.26001519587677318785587544488e-2)];
pub(super) const A3: TableRow<2> = [
    (1, 1.97250569845378994544595329183e-2),
    (2, 5.91751709536136983633785987549e-2),
];
pub(super) const A4: TableRow<2> = [
    (1, 2.95875854768068491816892993775e-2),
    (3, 8.87627564304205475450678981324e-2),
];
pub(super) const A5: TableRow<3> = [
    (1, 2.41365134159266685502369798665e-1),
    (3, -8.84549479328286085344864962717e-1),
    (4, 9.24834003261792003115737966543e-1),
];
pub(super) const A6: TableRow<3> = [
    (1, 3.7037037037037037037037037037e-2),
    (4, 1.70828608729473871279604482173e-1),
    (5, 1.25467687566822425016691814123e-1),
];
pub(super) const A7: TableRow<4> = [
    (1, 3.7109375e-2),
    (4, 1.70252211019544039314978060272e-1),
    (5, 6.02165389804559606850219397283e-2),
    (6, -1.7578125e-2),
];
pub(super) const A8: TableRow<5> = [
    (1, 3.70920001185047927108779319836e-2),
    (4, 1.70383925712239993810214054705e-1),
    (5, 1.07262030446373284651809199168e-1),
    (6, -1.53194377486244017527936158236e-2),
    (7, 8.27378916381402288758473766002e-3),
];
pub(super) const A9: TableRow<6> = [
    (1, 6.24110958716075717114429577812e-1),
    (4, -3.36089262944694129406857109825e0),
    (5, -8.68219346841726006818189891453e-1),
    (6, 2.75920996994467083049415600797e1),
    (7, 2.01540675504778934086186788979e1),
    (8, -4.34898841810699588477366255144e1),
];
pub(super) const A10: TableRow<7> = [
    (1, 4.77662536438264365890433908527e-1),
    (4, -2.48811461997166764192642586468e0),
    (5, -5.90290826836842996371446475743e-1),
    (6, 2.12300514481811942347288949897e1),
    (7, 1.52792336328824235832596922938e1),
    (8, -3.32882109689848629194453265587e1),
    (9, -2.03312017085086261358222928593e-2),
];
pub(super) const A11: TableRow<8> = [
    (1, -9.3714243008598732571704021658e-1),
    (4, 5.18637242884406370830023853209e0),
    (5, 1.09143734899672957818500254654e0),
    (6, -8.14978701074692612513997267357e0),
    (7, -1.85200656599969598641566180701e1),
    (8, 2.27394870993505042818970056734e1),
    (9, 2.49360555267965238987089396762e0),
    (10, -3.0467644718982195003823669022e0),
];
pub(super) const A12: TableRow<9> = [
    (1, 2.27331014751653820792359768449e0),
    (4, -1.05344954667372501984066689879e1),
    (5, -2.00087205822486249909675718444e0),
    (6, -1.79589318631187989172765950534e1),
    (7, 2.79488845294199600508499808837e1),
    (8, -2.85899827713502369474065508674e0),
    (9, -8.87285693353062954433549289258e0),
    (10, 1.23605671757943030647266201528e1),
    (11, 6.43392746015763530355970484046e-1),
];

/// Weights of the solution of order 8.
pub(super) const B: TableRow<8> = [
    (1, 5.42937341165687622380535766363e-2),
    (6, 4.45031289275240888144113950566e0),
    (7, 1.89151789931450038304281599044e0),
    (8, -5.8012039600105847814672114227e0),
    (9, 3.1116436695781989440891606237e-1),
    (10, -1.52160949662516078556178806805e-1),
    (11, 2.01365400804030348374776537501e-1),
    (12, 4.47106157277725905176885569043e-2),
];

/// Weights of the embedded solution of order 3.
pub(super) const B_THIRD: TableRow<3> = [
    (1, 0.244094488188976377952755905512e+00),
    (9, 0.733846688281611857341361741547e+00),
    (12, 0.220588235294117647058823529412e-01),
];

/// Weights of the solution of order 8 minus those of the embedded solution of order 5.
pub(super) const E_FIFTH: TableRow<8> = [
    (1, 0.1312004499419488073250102996e-01),
    (6, -0.1225156446376204440720569753e+01),
    (7, -0.4957589496572501915214079952e+00),
    (8, 0.1664377182454986536961530415e+01),
    (9, -0.3503288487499736816886487290e+00),
    (10, 0.3341791187130174790297318841e+00),
    (11, 0.8192320648511571246570742613e-01),
    (12, -0.2235530786388629525884427845e-01),
];

pub(super) const A14: TableRow<8> = [
    (1, 5.61675022830479523392909219681e-2),
    (7, 2.53500210216624811088794765333e-1),
    (8, -2.46239037470802489917441475441e-1),
    (9, -1.24191423263816360469010140626e-1),
    (10, 1.5329179827876569731206322685e-1),
    (11, 8.20105229563468988491666602057e-3),
    (12, 7.56789766054569976138603589584e-3),
    (13, -8.298e-3),
];
pub(super) const A15: TableRow<8> = [
    (1, 3.18346481635021405060768473261e-2),
    (6, 2.83009096723667755288322961402e-2),
    (7, 5.35419883074385676223797384372e-2),
    (8, -5.49237485713909884646569340306e-2),
    (11, -1.08347328697249322858509316994e-4),
    (12, 3.82571090835658412954920192323e-4),
    (13, -3.40465008687404560802977114492e-4),
    (14, 1.41312443674632500278074618366e-1),
];
pub(super) const A16: TableRow<8> = [
    (1, -4.28896301583791923408573538692e-1),
    (6, -4.69762141536116384314449447206e0),
    (7, 7.68342119606259904184240953878e0),
    (8, 4.06898981839711007970213554331e0),
    (9, 3.56727187455281109270669543021e-1),
    (13, -1.39902416515901462129418009734e-3),
    (14, 2.9475147891527723389556272149e0),
    (15, -9.15095847217987001081870187138e0),
];

/// Weights of the four highest coefficients of the dense output.
pub(super) const D: [TableRow<12>; 4] = [
    [
        (1, -0.84289382761090128651353491142e+01),
        (6, 0.56671495351937776962531783590e+00),
        (7, -0.30689499459498916912797304727e+01),
        (8, 0.23846676565120698287728149680e+01),
        (9, 0.21170345824450282767155149946e+01),
        (10, -0.87139158377797299206789907490e+00),
        (11, 0.22404374302607882758541771650e+01),
        (12, 0.63157877876946881815570249290e+00),
        (13, -0.88990336451333310820698117400e-01),
        (14, 0.18148505520854727256656404962e+02),
        (15, -0.91946323924783554000451984436e+01),
        (16, -0.44360363875948939664310572000e+01),
    ],
    [
        (1, 0.10427508642579134603413151009e+02),
        (6, 0.24228349177525818288430175319e+03),
        (7, 0.16520045171727028198505394887e+03),
        (8, -0.37454675472269020279518312152e+03),
        (9, -0.22113666853125306036270938578e+02),
        (10, 0.77334326684722638389603898808e+01),
        (11, -0.30674084731089398182061213626e+02),
        (12, -0.93321305264302278729567221706e+01),
        (13, 0.15697238121770843886131091075e+02),
        (14, -0.31139403219565177677282850411e+02),
        (15, -0.93529243588444783865713862664e+01),
        (16, 0.35816841486394083752465898540e+02),
    ],
    [
        (1, 0.19985053242002433820987653617e+02),
        (6, -0.38703730874935176555105901742e+03),
        (7, -0.18917813819516756882830838328e+03),
        (8, 0.52780815920542364900561016686e+03),
        (9, -0.11573902539959630126141871134e+02),
        (10, 0.68812326946963000169666922661e+01),
        (11, -0.10006050966910838403183860980e+01),
        (12, 0.77771377980534432092869265740e+00),
        (13, -0.27782057523535084065932004339e+01),
        (14, -0.60196695231264120758267380846e+02),
        (15, 0.84320405506677161018159903784e+02),
        (16, 0.11992291136182789328035130030e+02),
    ],
    [
        (1, -0.25693933462703749003312586129e+02),
        (6, -0.15418974869023643374053993627e+03),
        (7, -0.23152937917604549567536039109e+03),
        (8, 0.35763911791061412378285349910e+03),
        (9, 0.93405324183624310003907691704e+02),
        (10, -0.37458323136451633156875139351e+02),
        (11, 0.10409964950896230045147246184e+03),
        (12, 0.29840293426660503123344363579e+02),
        (13, -0.43533456590011143754432175058e+02),
        (14, 0.96324553959188282948394950600e+02),
        (15, -0.39177261675615439165231486172e+02),
        (16, -0.14972683625798562581422125276e+03),
    ],
];

#[cfg(test)]
mod tests {
    use std::vec::Vec;

    use super::*;
    use crate::integrate::explicit::dop853::DormandPrince8;
    use crate::integrate::explicit::order_conditions::ButcherTable;

    /// Returns all rows of the table of stages, in order. The row of stage 13 is the weights of the
    /// solution.
    fn rows() -> Vec<&'static [(usize, f64)]> {
        ButcherTable::of::<DormandPrince8>().rows
    }

    /// Returns the sum over a row of coefficient times `value(stage)`, and the sum of the
    /// magnitudes, which bounds the rounding error.
    fn dot(row: &[(usize, f64)], value: impl Fn(usize) -> f64) -> (f64, f64) {
        row.iter()
            .fold((0.0, 0.0), |(sum, size), &(stage, coefficient)| {
                let term = coefficient * value(stage);
                (sum + term, size + term.abs())
            })
    }

    fn assert_condition(row: &[(usize, f64)], value: impl Fn(usize) -> f64, expected: f64) {
        let (sum, size) = dot(row, value);
        assert!(
            (sum - expected).abs() <= 16.0 * f64::EPSILON * size.max(1.0),
            "{sum} is not {expected}"
        );
    }

    #[test]
    fn rows_sum_to_their_nodes() {
        for (row, node) in rows().into_iter().zip(C) {
            assert_condition(row, |_| 1.0, node);
        }
    }

    #[test]
    fn stages_integrate_powers_as_the_construction_demands() {
        // Simplifying assumptions of Solving ODEs I, section II.5:
        // sum_j a_ij c_j = c_i^2/2 from stage 3 on, with c_j^2 from stage 4 on,
        // and with c_j^3 from stage 6 on.
        for (power, first) in [(1, 3), (2, 4), (3, 6)] {
            for stage in first..=STAGES {
                let expected = C[stage - 1].powi(power + 1) / f64::from(power + 1);
                assert_condition(rows()[stage - 1], |j| C[j - 1].powi(power), expected);
            }
        }
    }

    #[test]
    fn weights_satisfy_the_quadrature_conditions_of_order_eight() {
        for power in 0..8 {
            assert_condition(&B, |j| C[j - 1].powi(power), 1.0 / f64::from(power + 1));
        }
        // The method is not of order 9; so this condition can fail.
        let (ninth, _) = dot(&B, |j| C[j - 1].powi(8));
        assert!((ninth - 1.0 / 9.0).abs() > 1e-6);
    }

    #[test]
    fn nested_conditions_of_order_eight() {
        // Rooted trees beyond the quadrature conditions: b c^k A c^m and b c^k A A c^m, up to order
        // 8.
        let inner = |m: i32| move |j: usize| dot(rows()[j - 1], |l| C[l - 1].powi(m)).0;
        let twice = |m: i32| move |j: usize| dot(rows()[j - 1], inner(m)).0;
        let thrice = |m: i32| move |j: usize| dot(rows()[j - 1], twice(m)).0;
        for k in 0..8 {
            for m in 0..8 {
                let own = f64::from(m + 1);
                if k + m + 2 <= 8 {
                    let expected = 1.0 / (own * f64::from(m + k + 2));
                    assert_condition(&B, |j| C[j - 1].powi(k) * inner(m)(j), expected);
                }
                if k + m + 3 <= 8 {
                    let expected = 1.0 / (own * f64::from(m + 2) * f64::from(m + k + 3));
                    assert_condition(&B, |j| C[j - 1].powi(k) * twice(m)(j), expected);
                }
                if k + m + 4 <= 8 {
                    let product = own * f64::from(m + 2) * f64::from(m + 3);
                    let expected = 1.0 / (product * f64::from(m + k + 4));
                    assert_condition(&B, |j| C[j - 1].powi(k) * thrice(m)(j), expected);
                }
            }
        }
    }

    #[test]
    fn embedded_weights_have_orders_three_and_five() {
        for power in 0..3 {
            assert_condition(
                &B_THIRD,
                |j| C[j - 1].powi(power),
                1.0 / f64::from(power + 1),
            );
        }
        for power in 0..5 {
            assert_condition(&E_FIFTH, |j| C[j - 1].powi(power), 0.0);
        }
        let (sixth, _) = dot(&E_FIFTH, |j| C[j - 1].powi(5));
        assert!(sixth.abs() > 1e-6);
    }

    #[test]
    fn dense_weights_reproduce_powers_up_to_the_seventh() {
        // For y' = t^(p-1) with a step of one, every stage's rate is c^(p-1),
        // so the interpolant must be t^p/p for every p up to 7.
        for p in 1..=7 {
            let rate = |j: usize| C[j - 1].powi(p - 1);
            let increment = 1.0 / f64::from(p);
            let third = rate(1) - increment;
            let fourth = increment - rate(13) - third;
            let high = D.map(|row| dot(&row, rate).0);
            for s in [0.1_f64, 0.35, 0.5, 0.8, 0.95] {
                let r = 1.0 - s;
                let tail = high[0] + s * (high[1] + r * (high[2] + s * high[3]));
                let value = s * (increment + r * (third + s * (fourth + r * tail)));
                let expected = s.powi(p) / f64::from(p);
                assert!(
                    (value - expected).abs() < 1e-12,
                    "p = {p}, s = {s}: {value}"
                );
            }
        }
    }
}
