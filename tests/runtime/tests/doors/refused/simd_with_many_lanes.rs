// error: error[E0277] | Sealed<f32>
own_scalar!();
own_simd!(f32, 1 << 20, [f32; 1 << 20]);
fn main() {
    println!("{:?}", Simd::<f32>::to_chunk(Own(1.0)));
}
