//! Which offsets, bindings, locations and constants does an entry point ask of the host?
//!
//! naga parses and validates the same text that glslang compiles.

use std::collections::BTreeMap;
use std::path::Path;

use naga::front::glsl::{Frontend, Options};
use naga::valid::{Capabilities, ValidationFlags, Validator};
use naga::{
    AddressSpace, ArraySize, Binding, Expression, Handle, Literal, Module, Span, Type, TypeInner,
};

use super::include::Expanded;
use super::{Entry, Error, Stage, file_error};

/// One member of a struct.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Member {
    /// Its name in GLSL.
    pub name: String,
    /// Bytes from the start of the struct.
    pub offset: u32,
    /// Bytes it takes, without padding after it.
    pub size: u32,
}

/// A struct that lies in a buffer.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Struct {
    /// Bytes from one to the next in an array.
    pub size: u32,
    /// In order of offset.
    pub members: Vec<Member>,
}

/// An integer constant, of the type that the shader declares.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Integer {
    /// `int`
    Signed(i32),
    /// `uint`
    Unsigned(u32),
}

/// What the host must agree with. Maps are ordered, so what is generated from them is too.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Reflection {
    /// By name. A struct that ends in a runtime array has no size and is left out; its elements are in.
    pub structs: BTreeMap<String, Struct>,
    /// Binding numbers in their sets: a block by the name of the block, a texture or sampler by its own.
    pub bindings: BTreeMap<String, u32>,
    /// Locations of a vertex shader's inputs.
    pub vertex_inputs: BTreeMap<String, u32>,
    /// Ids of the specialization constants.
    pub specialization: BTreeMap<String, u32>,
    /// Values of the global integer constants.
    pub integers: BTreeMap<String, Integer>,
}

/// Parses, validates and reflects an entry point.
///
/// # Errors
///
/// naga's errors, each at its own file and line; a struct laid out in two ways; a binding outside sets 0 and 1.
pub fn reflect(expanded: &Expanded, stage: Stage) -> Result<Reflection, Vec<Error>> {
    let module = parse(expanded, stage)?;
    validate(expanded, &module)?;
    let mut reflection = Reflection::default();
    globals(&module, &mut reflection).map_err(|why| vec![expanded.error(1, why)])?;
    constants(&module, &mut reflection);
    if stage == Stage::Vertex {
        inputs(&module, &mut reflection);
    }
    Ok(reflection)
}

fn parse(expanded: &Expanded, stage: Stage) -> Result<Module, Vec<Error>> {
    let mut options = Options::from(match stage {
        Stage::Vertex => naga::ShaderStage::Vertex,
        Stage::Fragment => naga::ShaderStage::Fragment,
        Stage::Compute => naga::ShaderStage::Compute,
    });
    // The other half of `compile`'s define: here the word means nothing.
    options.defines.insert("PRECISE".into(), String::new());
    Frontend::default()
        .parse(&options, &expanded.text)
        .map_err(|parsed| {
            let told = |e: &naga::front::glsl::Error| at(expanded, e.meta, &e.kind.to_string());
            parsed.errors.iter().map(told).collect()
        })
}

fn validate(expanded: &Expanded, module: &Module) -> Result<(), Vec<Error>> {
    Validator::new(ValidationFlags::all(), Capabilities::all())
        .validate(module)
        .map(|_| ())
        .map_err(|error| {
            let mut message = error.as_inner().to_string();
            let mut cause = std::error::Error::source(error.as_inner());
            while let Some(inner) = cause {
                message = format!("{message}: {inner}");
                cause = inner.source();
            }
            let span = error
                .spans()
                .next()
                .map_or(Span::UNDEFINED, |(span, _)| *span);
            vec![at(expanded, span, &message)]
        })
}

fn at(expanded: &Expanded, span: Span, message: &str) -> Error {
    let start = span.to_range().map_or(0, |range| range.start);
    let before = expanded.text.get(..start).unwrap_or_default();
    let line = before.matches('\n').count() + 1;
    expanded.error(line, format!("naga: {message}"))
}

/// Bindings, and every struct that can be reached from a buffer.
fn globals(module: &Module, into: &mut Reflection) -> Result<(), String> {
    for (_, global) in module.global_variables.iter() {
        let Some(resource) = &global.binding else {
            continue;
        };
        let block = matches!(
            global.space,
            AddressSpace::Uniform | AddressSpace::Storage { .. }
        );
        let name = match block {
            true => module.types[global.ty].name.clone(),
            false => global.name.clone(),
        };
        let name = name.ok_or("a binding without a name")?;
        if resource.group > 1 {
            return Err(format!(
                "`{name}` is in set {}: there are only 0, and 1 for what a draw has of its own",
                resource.group
            ));
        }
        into.bindings.insert(name, resource.binding);
        if block {
            structs(module, global.ty, into)?;
        }
    }
    Ok(())
}

/// Notes the struct `ty`, or the one that `ty` is an array of, and those inside it.
fn structs(module: &Module, ty: Handle<Type>, into: &mut Reflection) -> Result<(), String> {
    let (members, span) = match &module.types[ty].inner {
        TypeInner::Array { base, .. } => return structs(module, *base, into),
        TypeInner::Struct { members, span } => (members, *span),
        _ => return Ok(()),
    };
    let name = module.types[ty].name.clone().unwrap_or_default();
    let mut layout = Struct {
        size: span,
        members: Vec::new(),
    };
    let mut sized = true;
    for member in members {
        structs(module, member.ty, into)?;
        let inner = &module.types[member.ty].inner;
        sized &= !matches!(
            inner,
            TypeInner::Array {
                size: ArraySize::Dynamic,
                ..
            }
        );
        layout.members.push(Member {
            name: member.name.clone().unwrap_or_default(),
            offset: member.offset,
            size: inner.size(module.to_ctx()),
        });
    }
    if !sized {
        return Ok(());
    }
    match into.structs.insert(name.clone(), layout.clone()) {
        Some(other) if other != layout => Err(format!(
            "struct {name} lies in a std140 and in a std430 block, with {}",
            difference(&other, &layout)
        )),
        _ => Ok(()),
    }
}

fn constants(module: &Module, into: &mut Reflection) {
    for (_, constant) in module.overrides.iter() {
        if let (Some(name), Some(id)) = (&constant.name, constant.id) {
            into.specialization.insert(name.clone(), u32::from(id));
        }
    }
    for (_, constant) in module.constants.iter() {
        let value = match module.global_expressions[constant.init] {
            Expression::Literal(Literal::I32(value)) => Integer::Signed(value),
            Expression::Literal(Literal::U32(value)) => Integer::Unsigned(value),
            _ => continue,
        };
        if let Some(name) = &constant.name {
            into.integers.insert(name.clone(), value);
        }
    }
}

fn inputs(module: &Module, into: &mut Reflection) {
    for entry in &module.entry_points {
        for argument in &entry.function.arguments {
            if let (Some(name), Some(Binding::Location { location, .. })) =
                (&argument.name, &argument.binding)
            {
                into.vertex_inputs.insert(name.clone(), *location);
            }
        }
    }
}

impl Reflection {
    /// All that the entry points ask of the host, together.
    ///
    /// # Errors
    ///
    /// A name that means one thing in one entry point and another in the next.
    pub fn merge(folder: &Path, entries: &[Entry]) -> Result<Self, Vec<Error>> {
        let mut all = Self::default();
        let mut errors = Vec::new();
        for entry in entries {
            let mut differs = |what: String| {
                let message = format!("{what}, unlike in an entry point before it");
                errors.push(file_error(&folder.join(&entry.name), message));
            };
            let one = &entry.reflection;
            for (name, new) in &one.structs {
                if let Some(old) = all.structs.insert(name.clone(), new.clone())
                    && old != *new
                {
                    differs(format!("struct {name} has {}", difference(&old, new)));
                }
            }
            join(&mut all.bindings, &one.bindings, "binding of", &mut differs);
            join(
                &mut all.vertex_inputs,
                &one.vertex_inputs,
                "location of",
                &mut differs,
            );
            join(
                &mut all.specialization,
                &one.specialization,
                "id of",
                &mut differs,
            );
            join(&mut all.integers, &one.integers, "value of", &mut differs);
        }
        if errors.is_empty() {
            Ok(all)
        } else {
            Err(errors)
        }
    }
}

fn join<V: Copy + PartialEq + std::fmt::Debug>(
    all: &mut BTreeMap<String, V>,
    one: &BTreeMap<String, V>,
    what: &str,
    differs: &mut dyn FnMut(String),
) {
    for (name, new) in one {
        if let Some(old) = all.insert(name.clone(), *new)
            && old != *new
        {
            differs(format!("the {what} {name} is {new:?} and not {old:?}"));
        }
    }
}

/// The first difference between two layouts, in words.
fn difference(old: &Struct, new: &Struct) -> String {
    let told = |member: Option<&Member>| match member {
        Some(m) => format!("`{}` ({} bytes) at {}", m.name, m.size, m.offset),
        None => "nothing".to_owned(),
    };
    let longest = old.members.len().max(new.members.len());
    let first = (0..longest)
        .map(|i| (old.members.get(i), new.members.get(i)))
        .find(|(old, new)| old != new);
    match first {
        Some((old, new)) => format!("{} and not {}", told(new), told(old)),
        None => format!("{} bytes and not {}", new.size, old.size),
    }
}
