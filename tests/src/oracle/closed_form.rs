//! The closed form of the literature (physics §1) with complex lever arms:
//! M_ij = Re(A_ij e^{i(θ_i − θ_j)}), and
//! Σ_j M_ij ω̇_j + Im(A_ij e^{i(θ_i − θ_j)}) ω_j² + g Im(h_i e^{iθ_i}) = Q_i.

use nalgebra::{Complex, DMatrix, DVector};

use super::Tree;

type Arm = Complex<f64>;

fn arm([along, across]: [f64; 2]) -> Arm {
    Arm::new(along, across)
}

/// Mass S and first moment h of the subtree of each link, and the moment of
/// inertia A_ii.
fn moments(tree: &Tree) -> (Vec<Arm>, Vec<f64>) {
    let n = tree.links.len();
    let mut mass = vec![0.0; n];
    let mut first = vec![Arm::new(0.0, 0.0); n];
    let mut second = vec![0.0; n];
    for (i, link) in tree.links.iter().enumerate().rev() {
        mass[i] += link.mass;
        first[i] += arm(link.com) * link.mass;
        second[i] += link.inertia + link.mass * arm(link.com).norm_sqr();
        if let Some(parent) = link.parent {
            let subtree = mass[i];
            mass[parent] += subtree;
            first[parent] += arm(link.pivot) * subtree;
            second[parent] += subtree * arm(link.pivot).norm_sqr();
        }
    }
    (first, second)
}

/// The mass matrix at `theta` and the bias torques.
pub fn equations(tree: &Tree, theta: &[f64], omega: &[f64]) -> (DMatrix<f64>, DVector<f64>) {
    let n = tree.links.len();
    let (first, second) = moments(tree);
    let mut mass = DMatrix::from_diagonal(&DVector::from_column_slice(&second));
    let mut bias = DVector::zeros(n);
    for j in 0..n {
        bias[j] += tree.gravity * (first[j] * Arm::from_polar(1.0, theta[j])).im;
        // c is the child of i on the path to j.
        let mut c = j;
        while let Some(i) = tree.links[c].parent {
            let coupling = arm(tree.links[c].pivot) * first[j].conj();
            let turned = coupling * Arm::from_polar(1.0, theta[i] - theta[j]);
            mass[(i, j)] = turned.re;
            mass[(j, i)] = turned.re;
            bias[i] += turned.im * omega[j] * omega[j];
            bias[j] -= turned.im * omega[i] * omega[i];
            c = i;
        }
        let link = &tree.links[j];
        let (torque, _) = link.pivot_torque(j, theta, omega);
        bias[j] -= link.ground_torque(omega[j]).0 + torque;
        if let Some(parent) = link.parent {
            bias[parent] += torque;
        }
    }
    (mass, bias)
}
