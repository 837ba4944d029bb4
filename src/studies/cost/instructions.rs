//! How many instructions of SPIR-V does a form leave in the surface's shader?

use std::io::Write;
use std::process::{Command, Stdio};

use rayon::prelude::*;

use crate::interface::reflected::constants;
use crate::interface::spirv;
use crate::render::Variant;
use crate::render::effects::ALL;

/// The optimiser of SPIRV-Tools.
const OPTIMISER: &str = "spirv-opt";

/// Instructions of each form beyond those of a surface without light, once constants are frozen and the module is optimised.
/// None where `spirv-opt` is not installed.
pub fn instructions(variants: &[Variant]) -> Vec<Option<u64>> {
    let Some(unlit) = variants.first().and_then(|variant| count(variant, false)) else {
        return vec![None; variants.len()];
    };
    let net = |variant: &Variant| Some(count(variant, true)?.saturating_sub(unlit));
    variants.par_iter().map(net).collect()
}

/// With the lobes that the terms say, or without any.
fn count(variant: &Variant, lit: bool) -> Option<u64> {
    let lobes = variant.lobes();
    let effect = |id: u32| {
        let on = lobes.iter().any(|(lobe, on)| *lobe == id && *on);
        (id, i32::from(on && lit))
    };
    let effects = ALL.iter().map(|known| effect(known.constant));
    let variants = variant.constants().map(|constant| {
        let term =
            constant.id == constants::TERM_DIFFUSE || constant.id == constants::TERM_SPECULAR;
        (constant.id, if term && !lit { 0 } else { constant.value })
    });
    let values: Vec<String> = variants
        .into_iter()
        .chain(effects)
        .map(|(id, value)| format!("{id}:{value}"))
        .collect();
    body(&optimised(spirv::SURFACE_FRAG, &values.join(" "))?)
}

fn optimised(module: &[u32], values: &str) -> Option<Vec<u32>> {
    let output = tempfile::NamedTempFile::new().ok()?;
    let mut tool = Command::new(OPTIMISER)
        .args(["--target-env=vulkan1.3", "--set-spec-const-default-value"])
        .arg(values)
        .args(["--freeze-spec-const", "--fold-spec-const-op-composite"])
        .args(["-O", "-", "-o"])
        .arg(output.path())
        .stdin(Stdio::piped())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .ok()?;
    let written = tool.stdin.take()?.write_all(bytemuck::cast_slice(module));
    if !tool.wait().ok()?.success() || written.is_err() {
        return None;
    }
    let bytes = std::fs::read(output.path()).ok()?;
    Some(
        bytes
            .chunks_exact(4)
            .map(bytemuck::pod_read_unaligned)
            .collect(),
    )
}

/// Instructions from `OpFunction` to `OpFunctionEnd` (SPIR-V 1.6, section 3.49); lines told for debugging not counted.
fn body(words: &[u32]) -> Option<u64> {
    const HEADER: usize = 5;
    const FUNCTION: u32 = 54;
    const FUNCTION_END: u32 = 56;
    const LINE: [u32; 2] = [8, 317];
    let (mut at, mut inside, mut count) = (HEADER, false, 0);
    while at < words.len() {
        let (operation, length) = (words[at] & 0xffff, words[at] >> 16);
        inside |= operation == FUNCTION;
        if inside && !LINE.contains(&operation) {
            count += 1;
        }
        inside &= operation != FUNCTION_END;
        // A length of 0 never ends.
        at += usize::try_from(length).ok().filter(|length| *length > 0)?;
    }
    Some(count)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn instructions_of_bodies_are_counted() {
        let header = [0x0723_0203, 0x0001_0600, 0, 9, 0];
        let module = |rest: &[u32]| [&header[..], rest].concat();
        let words = |operation: u32, length: u32| length << 16 | operation;
        // OpTypeVoid; OpFunction, OpLabel, OpNoLine, OpReturn, OpFunctionEnd.
        let rest = [
            [words(19, 2), 1].as_slice(),
            &[words(54, 5), 1, 2, 0, 3],
            &[words(248, 2), 4, words(317, 1), words(253, 1), words(56, 1)],
        ]
        .concat();
        assert_eq!(body(&module(&rest)), Some(4));
        assert_eq!(body(&module(&[0])), None);
    }
}
