//! How is a module read instruction by instruction, and how does it ask the driver to keep NaN, infinity and signed zero?
//!
//! It asks by SignedZeroInfNanPreserve (SPIR-V specification, 3.6 Execution Mode), which is core since
//! SPIR-V 1.4. naga rejects it in the source, and declaring it where the device does not report it is
//! a validation error, so it is added to the words here.

use std::borrow::Cow;

const MAGIC: u32 = 0x0723_0203;
const HEADER_WORDS: usize = 5;
const OP_CAPABILITY: u32 = 17;
const OP_ENTRY_POINT: u32 = 15;
const OP_EXECUTION_MODE: u32 = 16;
const CAPABILITY: u32 = 4466;
const EXECUTION_MODE: u32 = 4461;
const FLOAT_BITS: u32 = 32;

/// The module that a device is given: with NaN preserved, if it can.
pub(super) fn module_words(words: &[u32], preserves_nan: bool) -> Cow<'_, [u32]> {
    if preserves_nan {
        preserve_nan(words).into()
    } else {
        words.into()
    }
}

/// The same module with 32-bit NaN, infinity and signed zero preserved in every entry point.
/// Words that are not a SPIR-V module come back as they are: the driver will say so.
fn preserve_nan(words: &[u32]) -> Vec<u32> {
    let Some((header, body)) = parts(words) else {
        return words.to_vec();
    };
    let mut result = header.to_vec();
    result.extend([instruction(OP_CAPABILITY, 2), CAPABILITY]);
    let mut entry_points = Vec::new();
    let mut added = false;
    for one in instructions(body) {
        let opcode = code(one);
        // Execution modes stand right after the last entry point.
        if opcode == OP_ENTRY_POINT {
            entry_points.extend(one.get(2));
        } else if !entry_points.is_empty() && !added {
            for &entry in &entry_points {
                let op = instruction(OP_EXECUTION_MODE, 4);
                result.extend([op, entry, EXECUTION_MODE, FLOAT_BITS]);
            }
            added = true;
        }
        result.extend_from_slice(one);
    }
    result
}

/// The header of a module and the words of its instructions; nothing where the words are no module.
pub(super) fn parts(words: &[u32]) -> Option<(&[u32], &[u32])> {
    let parts = words.split_at_checked(HEADER_WORDS)?;
    (words[0] == MAGIC).then_some(parts)
}

/// Each instruction's words, of which the first has its code and their number (2.3).
pub(super) fn instructions(mut words: &[u32]) -> impl Iterator<Item = &[u32]> {
    std::iter::from_fn(move || {
        let length = (*words.first()? >> 16) as usize;
        let (one, rest) = words.split_at(length.clamp(1, words.len()));
        words = rest;
        Some(one)
    })
}

/// The operation's code, of an instruction's words.
pub(super) fn code(one: &[u32]) -> u32 {
    one[0] & 0xffff
}

/// The first word of an instruction.
pub(super) fn instruction(opcode: u32, words: u32) -> u32 {
    words << 16 | opcode
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_capability_comes_first_and_the_mode_after_the_last_entry_point() {
        let capability = [instruction(OP_CAPABILITY, 2), 1];
        let entry = [instruction(OP_ENTRY_POINT, 3), 4, 77];
        let mode = [instruction(OP_EXECUTION_MODE, 3), 77, 7];
        let header = [MAGIC, 0x0001_0600, 0, 100, 0];
        let module = [&header[..], &capability, &entry, &mode].concat();
        let added = [
            instruction(OP_EXECUTION_MODE, 4),
            77,
            EXECUTION_MODE,
            FLOAT_BITS,
        ];
        let expected = [
            &header[..],
            &[instruction(OP_CAPABILITY, 2), CAPABILITY],
            &capability,
            &entry,
            &added,
            &mode,
        ]
        .concat();
        assert_eq!(preserve_nan(&module), expected);
    }

    #[test]
    fn only_a_device_that_can_is_asked_to() {
        let module = [MAGIC, 0x0001_0600, 0, 100, 0];
        assert_eq!(*module_words(&module, false), module);
        assert_eq!(*module_words(&module, true), preserve_nan(&module));
        assert!(module_words(&module, true).len() > module.len());
    }

    #[test]
    fn words_that_are_no_module_stay_as_they_are() {
        assert_eq!(preserve_nan(&[1, 2, 3]), [1, 2, 3]);
        assert!(preserve_nan(&[]).is_empty());
        assert_eq!(preserve_nan(&[MAGIC]), [MAGIC]);
    }
}
