// error: `Fused` is private
fn sine<T: Lane>() {
    println!("{:?}", <T::Fused as Scalar>::from_f64(1.0).sin_cos());
}
fn main() {
    sine::<f32>();
}
