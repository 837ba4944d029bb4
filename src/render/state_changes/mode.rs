//! How can a draw get its material?

use crate::gpu::Output;
use crate::scene::suggest;

/// A way to draw the same picture.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Mode {
    /// What rows and the command line call it.
    pub name: &'static str,
    /// What it does, in a few words.
    pub what: &'static str,
    /// The mode that it is compared with; bases are compared with themselves.
    pub base: &'static str,
    /// Where a draw's material comes from.
    pub source: Source,
    /// What stands between two draws of different materials.
    pub change: Change,
    /// How draws are commanded.
    pub call: Call,
    /// What becomes of fragments.
    pub output: Output,
}

/// Where a draw's material comes from.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Source {
    /// Its number is in the object's record.
    Record,
    /// The same, in a pipeline that has every effect compiled in.
    RecordOfAnyScene,
    /// The same, and its picture is a layer of the one array.
    RecordWithArray,
    /// The same, and its picture is bound as an image of its own.
    RecordWithOwnImage,
    /// Its number is pushed.
    Pushed,
    /// A window on all materials stands on it.
    Window,
    /// It is bound as a set of its own.
    OwnSet,
    /// It is compiled into a pipeline of its own.
    Baked,
    /// Its finish is compiled into a pipeline of its own, its colours are bound as a set of its own.
    BakedWithOwnSet,
}

impl Source {
    /// Whether each material has a pipeline.
    pub fn is_baked(self) -> bool {
        matches!(self, Self::Baked | Self::BakedWithOwnSet)
    }

    /// Whether materials have pictures.
    pub fn has_pictures(self) -> bool {
        matches!(self, Self::RecordWithArray | Self::RecordWithOwnImage)
    }
}

/// What is recorded where the material changes from one draw to the next.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Change {
    /// Nothing.
    Nothing,
    /// Its number is pushed.
    Push,
    /// The second set is bound again with its window elsewhere.
    Window,
    /// Its own set takes the place of the second.
    Set,
    /// Its own pipeline is bound.
    Pipeline,
    /// Both.
    PipelineAndSet,
    /// The pipeline that is bound is bound again.
    SamePipeline,
    /// The first set is bound again.
    SameSet,
}

impl Change {
    /// Pipelines, sets and push constants that it binds.
    pub fn binds(self) -> [u64; 3] {
        match self {
            Self::Nothing => [0, 0, 0],
            Self::Push => [0, 0, 1],
            Self::Window | Self::Set | Self::SameSet => [0, 1, 0],
            Self::Pipeline | Self::SamePipeline => [1, 0, 0],
            Self::PipelineAndSet => [1, 1, 0],
        }
    }
}

/// How draws are commanded.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Call {
    /// A command an object.
    Each,
    /// One command that reads all objects from a buffer.
    Indirect,
    /// A command for all objects that follow each other and share their triangles.
    Instanced,
    /// None.
    Nothing,
}

/// The name of the base.
pub const ONE_PIPELINE: &str = "one-pipeline";
/// The base of the mode with a picture of its own.
pub const TEXTURE_ARRAY: &str = "texture-array";
/// The mode of materials that are compiled in.
pub const PIPELINE_PER_MATERIAL: &str = "pipeline-per-material";
/// The mode of any scene's pipeline.
pub const DYNAMIC: &str = "dynamic";

const BASE: Mode = Mode {
    name: ONE_PIPELINE,
    what: "one pipeline, one set, a draw an object; its record has the material's number",
    base: ONE_PIPELINE,
    source: Source::Record,
    change: Change::Nothing,
    call: Call::Each,
    output: Output::Blended,
};

/// Every mode, bases before what is compared with them.
pub const MODES: [Mode; 15] = [
    BASE,
    Mode {
        name: "indirect",
        what: "the same draws, read from a buffer by one command",
        call: Call::Indirect,
        ..BASE
    },
    Mode {
        name: "instanced",
        what: "objects that share triangles as instances of one draw",
        call: Call::Instanced,
        ..BASE
    },
    Mode {
        name: "push-constant",
        what: "the material's number is pushed where it changes",
        source: Source::Pushed,
        change: Change::Push,
        ..BASE
    },
    Mode {
        name: "dynamic-uniform",
        what: "the material is a uniform block; a dynamic offset moves to it where it changes",
        source: Source::Window,
        change: Change::Window,
        ..BASE
    },
    Mode {
        name: "set-per-material",
        what: "the material is a uniform block in a set of its own, bound where it changes",
        source: Source::OwnSet,
        change: Change::Set,
        ..BASE
    },
    Mode {
        name: TEXTURE_ARRAY,
        what: "the base, and each material has a picture in one array",
        source: Source::RecordWithArray,
        ..BASE
    },
    Mode {
        name: "texture-per-material",
        what: "the base, and each material has a picture in an image and a set of its own",
        base: TEXTURE_ARRAY,
        source: Source::RecordWithOwnImage,
        change: Change::Set,
        ..BASE
    },
    Mode {
        name: PIPELINE_PER_MATERIAL,
        what: "each material is compiled into a pipeline of its own, bound where it changes",
        source: Source::Baked,
        change: Change::Pipeline,
        ..BASE
    },
    Mode {
        name: "pipeline-and-set",
        what: "a pipeline of its own for the finish, a set of its own for the colours",
        source: Source::BakedWithOwnSet,
        change: Change::PipelineAndSet,
        ..BASE
    },
    Mode {
        name: DYNAMIC,
        what: "one pipeline for any scene: every effect compiled in, the record asked",
        source: Source::RecordOfAnyScene,
        ..BASE
    },
    Mode {
        name: "same-pipeline-again",
        what: "control: the one pipeline is bound again where the material changes",
        change: Change::SamePipeline,
        ..BASE
    },
    Mode {
        name: "same-set-again",
        what: "control: the one set is bound again where the material changes",
        change: Change::SameSet,
        ..BASE
    },
    Mode {
        name: "no-blend",
        what: "control: the base without blending; where all is opaque",
        output: Output::Replacing,
        ..BASE
    },
    Mode {
        name: "nothing",
        what: "control: the pass without a draw, the harness alone",
        call: Call::Nothing,
        ..BASE
    },
];

impl Mode {
    /// The mode of that name.
    ///
    /// # Errors
    /// There is none; the text tells the nearest, or all.
    pub fn of_name(name: &str) -> Result<&'static Self, String> {
        let found = MODES.iter().find(|mode| mode.name == name);
        found.ok_or_else(|| suggest::unknown("mode", name, MODES.iter().map(|mode| mode.name)))
    }

    /// The mode whose picture it must leave, if it leaves one.
    pub fn picture_of(&self) -> Option<&'static str> {
        match (self.call, self.source.has_pictures()) {
            (Call::Nothing, _) => None,
            (_, true) => Some(TEXTURE_ARRAY),
            (_, false) => Some(ONE_PIPELINE),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bases_come_before_what_is_compared_with_them() {
        for (place, mode) in MODES.iter().enumerate() {
            let names = [Some(mode.base), mode.picture_of()];
            for base in names.into_iter().flatten() {
                let found = MODES.iter().position(|other| other.name == base);
                assert!(found.is_some_and(|found| found <= place), "{}", mode.name);
            }
            assert_eq!(Mode::of_name(mode.name), Ok(mode));
        }
    }

    #[test]
    fn a_misspelt_mode_hears_the_nearest() {
        let error = Mode::of_name("instance").unwrap_err();
        assert!(error.contains("'instanced'"), "{error}");
    }
}
