// error: a wide number has at least one lane
fn main() {
    println!("{:?}", Simd::<f64>::first(Lanes::<f64, 0>([])));
}
