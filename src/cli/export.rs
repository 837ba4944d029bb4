//! How does `umber export` write the lighting functions for use elsewhere?

use std::path::PathBuf;

use clap::ValueEnum;

use crate::cli::exit::{Exit, Failure};
use crate::cli::output::{Output, print_bytes};
use crate::render::export::{ExportError, Language, export, list};

/// Options of `umber export`.
#[derive(clap::Args)]
pub struct Arguments {
    /// The functions, such as F_Schlick, or files of functions, such as schlick; what they need comes along [default: all
    /// lighting functions, and in GLSL those that keep the digits which rounding loses]
    function: Vec<String>,
    /// The language
    #[arg(long, required_unless_present = "list")]
    language: Option<LanguageArgument>,
    /// Write the text here
    #[arg(short, long, value_name = "FILE", default_value = "-")]
    output: PathBuf,
    /// Tell the files, the questions that they answer, and their functions
    #[arg(long, conflicts_with_all = ["function", "language"])]
    list: bool,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum LanguageArgument {
    /// WebGPU
    Wgsl,
    /// Direct3D
    Hlsl,
    /// Metal
    Msl,
    /// OpenGL and Vulkan: the text that frames are shaded with
    Glsl,
}

/// Translates, writes.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let Some(language) = arguments.language else {
        return print_bytes(list().as_bytes());
    };
    let output = Output::open(&arguments.output)?;
    let language = match language {
        LanguageArgument::Wgsl => Language::Wgsl,
        LanguageArgument::Hlsl => Language::Hlsl,
        LanguageArgument::Msl => Language::Msl,
        LanguageArgument::Glsl => Language::Glsl,
    };
    let text = export(language, &arguments.function).map_err(|error| {
        let exit = match error {
            ExportError::Unknown(_) | ExportError::Precise { .. } => Exit::Usage,
            // A mistake of the program's own, which no command line makes good.
            ExportError::Naga(_) => Exit::File,
        };
        Failure::new(exit, error)
    })?;
    output.write(text.as_bytes())
}
