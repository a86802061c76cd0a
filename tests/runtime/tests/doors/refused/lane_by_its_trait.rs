// error: error[E0603] | private
use branched_pendulum::scalar::lanes::Registers;
fn main() {
    println!(
        "{:?}",
        <<f64 as Registers>::Avx512 as Scalar>::from_f64(1.0)
    );
}
