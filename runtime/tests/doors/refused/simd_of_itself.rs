// error: error[E0119] | conflicting implementations
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
}

impl Simd<Own> for Own {}
fn main() {}
