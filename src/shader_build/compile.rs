//! Which SPIR-V does glslang make of an entry point, or which lines does it refuse?

use glslang::error::GlslangError;
use glslang::{
    Compiler, CompilerOptions, ShaderInput, ShaderMessage, ShaderSource, ShaderStage,
    SourceLanguage, SpirvVersion, Target, VulkanVersion,
};

use super::include::Expanded;
use super::{Error, Stage};

/// All that the output depends on beside the source; part of the key under which it is kept.
pub const OPTIONS: &str = "glslang for Vulkan 1.3, SPIR-V 1.6, PRECISE=precise";

/// naga does not know `precise`, so the sources write `PRECISE`. See `reflect` for the other half.
const DEFINES: [(&str, Option<&str>); 1] = [("PRECISE", Some("precise"))];

/// Compiles an entry point.
///
/// # Errors
///
/// glslang's errors and warnings, each at its own file and line: a warning fails too, for nobody reads
/// what a build script says when it succeeds.
pub fn compile(expanded: &Expanded, stage: Stage) -> Result<Vec<u32>, Vec<Error>> {
    let whole = |message: &str| vec![expanded.error(1, message)];
    let compiler = Compiler::acquire().ok_or_else(|| whole("glslang did not start"))?;
    let source = ShaderSource::from(expanded.text.as_str());
    let options = CompilerOptions {
        source_language: SourceLanguage::GLSL,
        target: Target::Vulkan {
            version: VulkanVersion::Vulkan1_3,
            spirv_version: SpirvVersion::SPIRV1_6,
        },
        version_profile: None,
        messages: ShaderMessage::DEFAULT,
    };
    let kind = match stage {
        Stage::Vertex => ShaderStage::Vertex,
        Stage::Fragment => ShaderStage::Fragment,
        Stage::Compute => ShaderStage::Compute,
    };
    let translate = |error: GlslangError| errors(expanded, &log_of(error));
    let input =
        ShaderInput::new(&source, kind, &options, Some(&DEFINES), None).map_err(translate)?;
    let shader = compiler.create_shader(input).map_err(translate)?;
    if shader.get_log().contains("WARNING:") {
        return Err(errors(expanded, &shader.get_log()));
    }
    let words = shader.compile().map_err(translate)?;
    if words.is_empty() {
        return Err(whole("glslang made an empty module"));
    }
    Ok(words)
}

fn log_of(error: GlslangError) -> String {
    match error {
        GlslangError::PreprocessError(log)
        | GlslangError::ParseError(log)
        | GlslangError::MapIoError(log)
        | GlslangError::LinkError(log) => log.log,
        other => other.to_string(),
    }
}

/// Translates glslang's log. Its lines read `ERROR: 0:12: 'x' : undeclared identifier`; that it then gave
/// up, and how many errors it counted, is left out.
fn errors(expanded: &Expanded, log: &str) -> Vec<Error> {
    let placed: Vec<Error> = log
        .lines()
        .filter_map(|line| {
            let rest = line
                .strip_prefix("ERROR: ")
                .or_else(|| line.strip_prefix("WARNING: "))?;
            let (_, rest) = rest.split_once(':')?;
            let (number, message) = rest.trim_end().split_once(": ")?;
            if message.ends_with("compilation terminated") {
                return None;
            }
            let number = number.parse().ok()?;
            Some(expanded.error(number, format!("glslang: {message}")))
        })
        .collect();
    if placed.is_empty() {
        let log: Vec<&str> = log
            .lines()
            .map(str::trim)
            .filter(|l| !l.is_empty())
            .collect();
        return vec![expanded.error(1, format!("glslang: {}", log.join(" ")))];
    }
    placed
}
