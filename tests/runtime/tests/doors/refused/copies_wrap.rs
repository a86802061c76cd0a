// error: the generations of a tree have more links than a number holds
equations!(Wrap: &[1, 2, (1 << (usize::BITS - 1)) + 1]);
fn main() {
    evaluate::<Wrap>();
}
