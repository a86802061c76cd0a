// error: `Avx512` is private
fn wide<T: Lane>() {
    println!("{:?}", <T::Avx512 as Scalar>::from_f64(1.0));
}
fn main() {
    wide::<f64>();
}
