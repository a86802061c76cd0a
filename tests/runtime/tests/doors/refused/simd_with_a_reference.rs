// error: error[E0277] | Sealed<f64>
own_scalar!();
own_simd!(f64, 1, &'static str);
fn main() {
    let text = <Own as Simd<f64>>::last_chunk(&[8.0]).copied();
    println!("{text:?}");
}
