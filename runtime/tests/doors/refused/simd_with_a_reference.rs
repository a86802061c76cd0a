// error: error[E0277] | Sealed<f64>
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

impl Simd<f64> for Own {
    type One = f64;
    type Mask = bool;
    type Chunk = &'static str;
    const LANES: usize = 1;
    fn mask(meant: impl Fn(usize) -> bool) -> bool {
        meant(0)
    }
    fn choose(self, other: Own, mask: bool) -> Own {
        if mask { self } else { other }
    }
    fn larger_size(self, _: Own) -> Own
    where
        f64: Real,
    {
        self
    }
    fn splat(value: f64) -> Own {
        Own(value)
    }
    fn rotate_lanes(self, _: usize) -> Own {
        self
    }
    fn tile_lanes(self, _: usize) -> Own {
        self
    }
}
fn main() {
    let text = <Own as Simd<f64>>::last_chunk(&[8.0]).copied();
    println!("{text:?}");
}
