//! How is a good text damaged, so that a loader can be shown to survive it?

use proptest::prelude::*;
use proptest::test_runner::RngSeed;

/// Fixed seeds and no files: a failure prints its input, and the next run repeats it.
pub fn cases(cases: u32) -> ProptestConfig {
    ProptestConfig {
        cases,
        rng_seed: RngSeed::Fixed(1),
        failure_persistence: None,
        ..ProptestConfig::default()
    }
}

/// The bytes of `good` after up to seven edits: a byte replaced, one of `marks` inserted, a byte
/// removed, the text cut short, or its halves exchanged.
pub fn mutated(good: impl Into<Vec<u8>>, marks: &'static [u8]) -> impl Strategy<Value = Vec<u8>> {
    let good: Vec<u8> = good.into();
    let edit = (0..good.len(), any::<u8>(), 0..9_u8);
    prop::collection::vec(edit, 1..8).prop_map(move |edits| {
        let mut bytes = good.clone();
        for (at, byte, kind) in edits {
            if bytes.is_empty() {
                break;
            }
            let at = at.min(bytes.len() - 1);
            match kind {
                0..=2 => bytes[at] = byte,
                3..=4 => bytes.insert(at, marks[usize::from(byte) % marks.len()]),
                5..=6 => drop(bytes.remove(at)),
                7 => bytes.truncate(at),
                _ => bytes.rotate_left(at),
            }
        }
        bytes
    })
}
