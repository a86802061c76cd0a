// error: error[E0405] | ByKind
impl Scalar for Own {
    fn from_f64(value: f64) -> Own {
        Own(value)
    }
    fn sin_cos(self) -> (Own, Own) {
        (self, self)
    }
    fn sqrt(self) -> Own {
        self
    }
    fn by_kind<Q: ByKind<Self>>(question: Q) -> Q::Output {
        question.of_wide::<f64>()
    }
}
fn main() {
    let _ = outlined::<0, Own, _, _>(&Squares, [1.0; 4]);
}
