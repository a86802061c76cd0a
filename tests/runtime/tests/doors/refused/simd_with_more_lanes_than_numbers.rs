// error: error[E0277] | Sealed<f64>
own_scalar!();
own_simd!(f64, 1000, [f64; 1]);
fn main() {
    println!("{:?}", <Own as Simd<f64>>::load(&[1.0]));
}
