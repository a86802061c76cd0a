// error: error[E0603] | private
fn main() {
    let _ = outlined::<0, branched_pendulum::simd::one::Fused<f64>, _, _>(&Squares, [1.0; 4]);
}
