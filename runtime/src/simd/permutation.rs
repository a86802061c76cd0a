//! Words of a register: where each goes, and which are meant.

/// Where each word of a register comes from for
/// [`rotate_lanes`](super::Simd::rotate_lanes), for each lane that may be the first;
/// a lane has `WORDS / N` words.
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

/// Where they come from for [`tile_lanes`](super::Simd::tile_lanes), for each count less one.
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

/// All bits of the words in the first lanes, for each count of these, and none of the
/// others.
// As for kernels on one state.
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
