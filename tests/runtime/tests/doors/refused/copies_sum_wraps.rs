// error: the generations of a tree have more links than a number holds
equations!(Sum: &[2, 1, usize::MAX / 2]);
fn main() {
    evaluate::<Sum>();
}
