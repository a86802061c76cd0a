// error: error[E0603] | private
use branched_pendulum::simd::{F64x8, Fused};
fn main() {
    println!("{:?}", <F64x8 as Scalar>::from_f64(1.0));
}
