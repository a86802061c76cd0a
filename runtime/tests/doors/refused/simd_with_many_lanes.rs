// error: error[E0277] | Sealed<f32>
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

impl Simd<f32> for Own {
    type One = f32;
    type Mask = ();
    type Chunk = [f32; 1 << 20];
    const LANES: usize = 1 << 20;
    fn mask(_: impl Fn(usize) -> bool) {}
    fn choose(self, _: Own, _: ()) -> Own {
        self
    }
    fn larger_size(self, _: Own) -> Own {
        self
    }
    fn splat(value: f32) -> Own {
        Own(value.into())
    }
    fn rotate_lanes(self, _: usize) -> Own {
        self
    }
    fn tile_lanes(self, _: usize) -> Own {
        self
    }
}
fn main() {
    println!("{:?}", Simd::<f32>::to_chunk(Own(1.0)));
}
