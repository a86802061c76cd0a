//! Tables of permutations and masks for the 32-bit words of a register.

/// Returns the source index of each word for [`tile_lanes`](super::Simd::tile_lanes); entry n − 1
/// is for n repeated lanes.
pub(super) const fn rotated<const N: usize, const WORDS: usize>() -> [[u32; WORDS]; N] {
    let mut table = [[0; WORDS]; N];
    let mut i = 0;
    while i < N * WORDS {
        let (first, word) = (i / WORDS, i % WORDS);
        table[first][word] = ((word + first * (WORDS / N)) % WORDS) as u32;
        i += 1;
    }
    table
}

/// Returns the source index of each word for [`tile_lanes`](super::Simd::tile_lanes), for each
/// count minus one.
pub(super) const fn tiled<const N: usize, const WORDS: usize>() -> [[u32; WORDS]; N] {
    let mut table = [[0; WORDS]; N];
    let mut i = 0;
    while i < N * WORDS {
        let (count, word) = (i / WORDS + 1, i % WORDS);
        table[count - 1][word] = (word % (count * (WORDS / N))) as u32;
        i += 1;
    }
    table
}

/// Returns, for each number of lanes, a mask with all bits set in the words of that many first
/// lanes.
// Unused on targets with a single instruction set.
#[cfg_attr(not(all(feature = "std", target_arch = "x86_64")), allow(dead_code))]
pub(super) const fn first_lanes<const N: usize, const WORDS: usize>() -> [[u32; WORDS]; N] {
    let mut table = [[0; WORDS]; N];
    let mut i = 0;
    while i < N * WORDS {
        let (count, word) = (i / WORDS, i % WORDS);
        table[count][word] = if word < count * (WORDS / N) { !0 } else { 0 };
        i += 1;
    }
    table
}
