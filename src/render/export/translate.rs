//! What does naga make of GLSL functions in another language?

use naga::back::{hlsl, msl, wgsl};
use naga::compact::{KeepUnused, compact};
use naga::front::glsl::{Frontend, Options};
use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};
use naga::{Module, ShaderStage};

use super::{Language, names};

/// The text of functions in WGSL, HLSL or MSL, under their own names; GLSL comes back as it is.
///
/// # Errors
/// naga refuses the functions, or cannot write one.
pub fn translate(language: Language, glsl: &str) -> Result<String, String> {
    let module = parsed(glsl)?;
    let info = Validator::new(ValidationFlags::all(), Capabilities::all())
        .validate(&module)
        .map_err(|error| error.emit_to_string(glsl))?;
    let text = match language {
        Language::Wgsl => wgsl::write_string(&module, &info, wgsl::WriterFlags::empty())
            .map_err(|error| error.to_string())?,
        Language::Hlsl => to_hlsl(&module, &info)?,
        Language::Msl => to_msl(&module, &info)?,
        Language::Glsl => return Ok(glsl.to_owned()),
    };
    Ok(names::restored(&text, &module))
}

/// The functions as a module without an entry point.
fn parsed(glsl: &str) -> Result<Module, String> {
    // The parser asks for a `main`. It is the last function, so no other's number changes when it goes.
    let text = format!("#version 460\n{glsl}void main() {{}}\n");
    let mut module = Frontend::default()
        .parse(&Options::from(ShaderStage::Compute), &text)
        .map_err(|errors| errors.emit_to_string(&text))?;
    module.entry_points.clear();
    let functions: Vec<_> = module.functions.drain().collect();
    for (_, function, span) in functions {
        if function.name.as_deref() != Some("main") {
            module.functions.append(function, span);
        }
    }
    compact(&mut module, KeepUnused::Yes);
    Ok(module)
}

fn to_hlsl(module: &Module, info: &ModuleInfo) -> Result<String, String> {
    let mut text = String::new();
    let (options, pipeline) = (hlsl::Options::default(), hlsl::PipelineOptions::default());
    hlsl::Writer::new(&mut text, &options, &pipeline)
        .write(module, info, None)
        .map_err(|error| error.to_string())?;
    Ok(text)
}

fn to_msl(module: &Module, info: &ModuleInfo) -> Result<String, String> {
    let options = msl::Options {
        lang_version: (2, 0),
        ..msl::Options::default()
    };
    let (text, _) = msl::write_string(module, info, &options, &msl::PipelineOptions::default())
        .map_err(|error| error.to_string())?;
    Ok(text)
}
