//! Does the SPIR-V that ships lay its structs out as naga says?
//!
//! naga and glslang each compute offsets from the same text. The host asserts against naga's numbers;
//! here they are held against the decorations that the driver reads.

use std::collections::HashMap;

use super::reflect::{Reflection, Struct};

// Opcodes and decorations of the SPIR-V specification, sections 3.52 and 3.20.
const OP_NAME: u32 = 5;
const OP_MEMBER_NAME: u32 = 6;
const OP_TYPE_ARRAY: u32 = 28;
const OP_TYPE_RUNTIME_ARRAY: u32 = 29;
const OP_TYPE_POINTER: u32 = 32;
const OP_VARIABLE: u32 = 59;
const OP_DECORATE: u32 = 71;
const OP_MEMBER_DECORATE: u32 = 72;
const ARRAY_STRIDE: u32 = 6;
const BINDING: u32 = 33;
const OFFSET: u32 = 35;
/// Words before the first instruction.
const HEADER: usize = 5;

/// What a module says of its layouts, by result id.
#[derive(Default)]
struct Layouts {
    names: HashMap<u32, String>,
    member_names: HashMap<(u32, u32), String>,
    offsets: HashMap<(u32, u32), u32>,
    strides: HashMap<u32, u32>,
    bindings: HashMap<u32, u32>,
    /// Arrays and pointers: what they hold or point at.
    targets: HashMap<u32, u32>,
}

/// Compares each struct, array stride and binding that both know.
///
/// # Errors
///
/// The first difference, naming the struct and the field.
pub fn check(reflection: &Reflection, words: &[u32]) -> Result<(), String> {
    let layouts = read(words).ok_or("glslang made a module that does not parse")?;
    let mut ids: Vec<_> = layouts.names.keys().copied().collect();
    ids.sort_unstable();
    for id in ids {
        let Some(layout) = reflection.structs.get(&layouts.names[&id]) else {
            continue;
        };
        if layouts.offsets.contains_key(&(id, 0)) {
            offsets(&layouts, id, layout)?;
        }
    }
    strides(&layouts, reflection)?;
    bindings(&layouts, reflection)
}

fn offsets(layouts: &Layouts, id: u32, layout: &Struct) -> Result<(), String> {
    let name = &layouts.names[&id];
    for (index, member) in (0..).zip(&layout.members) {
        let offset = layouts.offsets.get(&(id, index)).copied();
        if offset != Some(member.offset) {
            let offset = offset.map_or("nowhere".to_owned(), |offset| format!("at {offset}"));
            return Err(format!(
                "{name}.{}: naga puts it at {}, glslang {offset}; pad the struct so that both agree",
                member.name, member.offset
            ));
        }
        if layouts.member_names.get(&(id, index)) != Some(&member.name) {
            return Err(format!("{name}.{}: glslang has another name", member.name));
        }
    }
    Ok(())
}

fn strides(layouts: &Layouts, reflection: &Reflection) -> Result<(), String> {
    for (array, stride) in &layouts.strides {
        let element = layouts.targets.get(array);
        let Some(name) = element.and_then(|element| layouts.names.get(element)) else {
            continue;
        };
        match reflection.structs.get(name) {
            Some(layout) if layout.size != *stride => {
                return Err(format!(
                    "{name}: naga counts {} bytes, glslang's arrays step {stride}; pad the struct",
                    layout.size
                ));
            }
            _ => {}
        }
    }
    Ok(())
}

fn bindings(layouts: &Layouts, reflection: &Reflection) -> Result<(), String> {
    for (variable, binding) in &layouts.bindings {
        let block = layouts
            .targets
            .get(variable)
            .and_then(|pointer| layouts.targets.get(pointer))
            .and_then(|block| layouts.names.get(block));
        let own = layouts.names.get(variable);
        let known = [block, own]
            .into_iter()
            .flatten()
            .find_map(|name| Some((name, reflection.bindings.get(name)?)));
        if let Some((name, known)) = known
            && known != binding
        {
            return Err(format!(
                "{name}: naga has binding {known}, glslang {binding}"
            ));
        }
    }
    Ok(())
}

/// Walks the instructions; `None` where the words are no module.
fn read(words: &[u32]) -> Option<Layouts> {
    let mut layouts = Layouts::default();
    let mut rest = words.get(HEADER..)?;
    while let Some(first) = rest.first() {
        let length = (first >> 16) as usize;
        let operands = rest.get(1..length)?;
        match (first & 0xffff, operands) {
            (OP_NAME, [id, name @ ..]) => {
                layouts.names.insert(*id, text(name));
            }
            (OP_MEMBER_NAME, [id, member, name @ ..]) => {
                layouts.member_names.insert((*id, *member), text(name));
            }
            (OP_DECORATE, [id, ARRAY_STRIDE, stride]) => {
                layouts.strides.insert(*id, *stride);
            }
            (OP_DECORATE, [id, BINDING, binding]) => {
                layouts.bindings.insert(*id, *binding);
            }
            (OP_MEMBER_DECORATE, [id, member, OFFSET, offset]) => {
                layouts.offsets.insert((*id, *member), *offset);
            }
            (OP_TYPE_ARRAY | OP_TYPE_RUNTIME_ARRAY, [id, target, ..])
            | (OP_TYPE_POINTER, [id, _, target])
            | (OP_VARIABLE, [target, id, ..]) => {
                layouts.targets.insert(*id, *target);
            }
            _ => {}
        }
        rest = rest.get(length..)?;
    }
    Some(layouts)
}

/// A literal string: UTF-8, little end first, ended by a zero byte.
fn text(words: &[u32]) -> String {
    let bytes: Vec<u8> = words
        .iter()
        .flat_map(|word| word.to_le_bytes())
        .take_while(|byte| *byte != 0)
        .collect();
    String::from_utf8_lossy(&bytes).into_owned()
}
