// error: V::LANES <= WIDEST
fn main() {
    println!("{:?}", <Lanes<f64, 17> as Simd<f64>>::load_front(&[1.0; 3]));
}
