// error: the generations of a tree have more links than a number holds
equations!(Both: &[1, 2, usize::MAX]);
fn main() {
    let _ = Tree::<Both, f64>::with_parents(&[0, 0], &[0.0; 2], [0.0, 1.0]);
}
