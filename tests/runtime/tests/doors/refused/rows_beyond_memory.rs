// error: a tree has more links than memory or numbers for them
equations!(Long: &[1, 1 << 20], 1 << (usize::BITS - 24));
fn main() {
    let _ = Tree::<Long, f64>::new(vec![0.0; 2], [0.0, 1.0]);
}
