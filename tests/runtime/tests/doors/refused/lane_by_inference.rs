// error: `Avx2` is private
fn wide<T: Lane<Avx2 = W>, W: Scalar>() -> W {
    W::from_f64(1.0)
}
fn main() {
    println!("{:?}", wide::<f64, _>());
}
