//! Is what `umber export` writes whole, valid in its language, and still the same function?

use std::collections::BTreeSet;
use std::path::Path;

use glam::Vec3;
use glslang::{
    Compiler, CompilerOptions, ShaderInput, ShaderMessage, ShaderSource, ShaderStage,
    SourceLanguage, SpirvVersion, Target, VulkanVersion,
};
use naga::valid::{Capabilities, ValidationFlags, Validator};
use umber::interface::ProbeInput;
use umber::render::export::{ExportError, Language, export, list, names};
use umber::render::library::{Function, Tier};
use umber::studies::stability::Truth;

use crate::samples::pairs;

#[path = "export/evaluate.rs"]
mod evaluate;
#[path = "export/metal.rs"]
mod metal;

use evaluate::{Value, call};

fn whole(language: Language) -> String {
    export(language, &[]).expect("an export")
}

fn some(language: Language, functions: &[&str]) -> Result<String, ExportError> {
    let functions: Vec<_> = functions.iter().map(|name| (*name).to_owned()).collect();
    export(language, &functions)
}

/// The functions that the files of a folder define, read by other means than the export: as naga lists them.
fn functions_of(folder: &str) -> BTreeSet<String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("shaders-glsl");
    let mut found = BTreeSet::new();
    for item in std::fs::read_dir(root.join(folder)).expect("a folder") {
        let path = item.expect("a file").path();
        let text = std::fs::read_to_string(&path).expect("a text");
        for line in text.lines() {
            let start = line.split('(').next().unwrap_or_default();
            let mut words = start.split(' ');
            let starts = line.contains('(') && line.starts_with(char::is_alphabetic);
            if let (true, Some(_), Some(name), None) =
                (starts, words.next(), words.next(), words.next())
            {
                found.insert(name.to_owned());
            }
        }
    }
    assert!(!found.is_empty());
    found
}

/// The functions that begin at the left margin of a text.
fn defined(text: &str) -> BTreeSet<String> {
    let at_margin = |line: &&str| line.contains('(') && line.starts_with(char::is_alphabetic);
    let name = |line: &str| {
        let before = line.split('(').next().unwrap_or_default();
        before.split(' ').next_back().unwrap_or_default().to_owned()
    };
    text.lines().filter(at_margin).map(name).collect()
}

#[test]
fn every_function_of_brdf_is_in_every_language() {
    let brdf = functions_of("brdf");
    for language in Language::ALL {
        let text = whole(language);
        let missing: Vec<_> = brdf.difference(&defined(&text)).cloned().collect();
        assert!(missing.is_empty(), "{}: {missing:?}", language.name());
        for constant in ["INV_PI", "COS_MIN", "M_MIN"] {
            assert!(text.contains(constant), "{}: {constant}", language.name());
        }
    }
    for name in functions_of("compensated") {
        assert!(defined(&whole(Language::Glsl)).contains(&name), "{name}");
        assert!(!defined(&whole(Language::Wgsl)).contains(&name), "{name}");
    }
    let names: BTreeSet<_> = names().collect();
    let list = list();
    for name in &brdf {
        assert!(
            names.contains(name.as_str()) && list.contains(name.as_str()),
            "{name}"
        );
    }
}

/// The line above each function is the end of its comment, and each file's question stands once.
#[test]
fn comments_stand_over_what_they_are_about() {
    for language in Language::ALL {
        let text = whole(language);
        let lines: Vec<_> = text.lines().collect();
        for function in functions_of("brdf") {
            let place = lines.iter().position(|line| {
                line.starts_with(char::is_alphabetic) && line.contains(&format!(" {function}("))
            });
            let place = place.expect("the function");
            let commented = lines[place - 1].starts_with("// ");
            assert!(commented, "{}: {function}", language.name());
        }
        // A function of the library stands with the file whose name it has, and not with one that begins alike.
        let after = |one: &str, other: &str| text.find(one) > text.find(other);
        assert!(after(
            "`umber eval beckmann-smith`",
            "==== brdf/beckmann_smith.glsl"
        ));
        for (function, above) in [
            (
                "G_VCavity",
                "// Errs by at most 2e-6 of itself, and by what the cosines bring: 2e-7 / min(NoL, NoE) in 32 bits.",
            ),
            (
                "f90_of",
                "// that a saturated colour keeps its grazing reflection.",
            ),
        ] {
            let lines: Vec<_> = text.lines().collect();
            let at = lines.iter().position(|line| {
                line.starts_with(char::is_alphabetic) && line.contains(&format!(" {function}("))
            });
            let at = at.expect("the function");
            assert_eq!(lines[at - 1], above, "{}", language.name());
        }
        for once in [
            "// How much does an interface reflect? Schlick 1994, with a colour at normal incidence.",
            "// `umber eval beckmann-d`",
            "==== brdf/cook_torrance.glsl ====",
            "MIT or Apache-2.0",
            "// How many facets face a half vector?",
        ] {
            assert_eq!(text.matches(once).count(), 1, "{}: {once}", language.name());
        }
    }
}

#[test]
fn names_are_the_shaders_own() {
    for language in [Language::Wgsl, Language::Hlsl, Language::Msl] {
        let text = some(language, &["schlick", "beckmann_m2"]).expect("an export");
        // naga would call them f0_1, f90_1 and beckmann_m2_.
        let signature = text
            .lines()
            .find(|line| line.contains("beckmann_m2("))
            .expect("a line");
        assert!(!text.contains("beckmann_m2_"), "{text}");
        assert!(
            language == Language::Msl || signature.contains("r2") && !signature.contains("r2_"),
            "{signature}"
        );
        let start = text.find(" F_SchlickRough(").expect("the function");
        let signature = &text[start..start + text[start..].find('{').expect("its body")];
        let parameters = signature.replace([',', '(', ')', ':'], " ");
        let parameters: Vec<_> = parameters.split_whitespace().collect();
        for name in ["f0", "f90", "m", "NoE"] {
            assert!(parameters.contains(&name), "{name}: {signature}");
        }
    }
}

#[test]
fn what_is_asked_for_comes_with_what_it_needs_and_no_more() {
    for language in Language::ALL {
        let text = some(language, &["G_VCavity"]).expect("an export");
        assert_eq!(
            defined(&text),
            BTreeSet::from(["G_VCavity", "G_EoH2_VCavity"].map(str::to_owned))
        );
        assert!(!text.contains("INV_PI"), "{text}");
        // A dash is an underscore, and a file stands for its functions.
        let lobe = some(language, &["cook-torrance"]).expect("an export");
        let defined = defined(&lobe);
        for need in [
            "cook_torrance",
            "D_Beckmann_over_hh",
            "F_Schlick",
            "half_vector",
        ] {
            assert!(defined.contains(need), "{need}");
        }
        assert!(!defined.contains("f90_of") && !defined.contains("oren_nayar"));
    }
    let both = some(Language::Glsl, &["v_cavity", "G_VCavity"]).expect("an export");
    assert_eq!(both.matches("float G_VCavity").count(), 1);
}

#[test]
fn what_cannot_be_exported_is_refused() {
    let unknown = some(Language::Wgsl, &["G_VCavity", "F_Shlick"]);
    assert!(
        matches!(&unknown, Err(ExportError::Unknown(why)) if why.contains("'F_Schlick'")),
        "{unknown:?}"
    );
    for name in ["two_sum", "oren_nayar_compensated"] {
        for language in [Language::Wgsl, Language::Hlsl, Language::Msl] {
            let refused = some(language, &[name]).unwrap_err();
            assert!(matches!(refused, ExportError::Precise { .. }), "{refused}");
            assert!(refused.to_string().contains("only glsl"), "{refused}");
        }
        let text = some(Language::Glsl, &[name]).expect("an export");
        assert!(
            text.contains("precise float") && !text.contains("PRECISE float"),
            "{text}"
        );
    }
}

#[test]
fn wgsl_is_read_back_by_naga() {
    let text = whole(Language::Wgsl);
    let module = naga::front::wgsl::parse_str(&text)
        .unwrap_or_else(|e| panic!("{}", e.emit_to_string(&text)));
    Validator::new(ValidationFlags::all(), Capabilities::empty())
        .validate(&module)
        .expect("a valid module");
}

#[test]
fn glsl_is_read_back_by_naga_and_by_glslang() {
    let text = whole(Language::Glsl);
    let with_main = format!("#version 460\n{text}\nvoid main() {{}}\n");
    let mut options = naga::front::glsl::Options::from(naga::ShaderStage::Compute);
    // naga does not know the word.
    options.defines.insert("precise".into(), String::new());
    let module = naga::front::glsl::Frontend::default().parse(&options, &with_main);
    let module = module.unwrap_or_else(|errors| panic!("{}", errors.emit_to_string(&with_main)));
    Validator::new(ValidationFlags::all(), Capabilities::empty())
        .validate(&module)
        .expect("a valid module");
    compiled(SourceLanguage::GLSL, &with_main).unwrap_or_else(|log| panic!("{log}"));
    let broken = with_main
        .replace("INV_PI", "INV_TAU_")
        .replacen("INV_TAU_", "INV_PI", 1);
    let log = compiled(SourceLanguage::GLSL, &broken).expect_err("an undeclared name");
    assert!(log.contains("INV_TAU_"), "{log}");
}

#[test]
fn hlsl_is_compiled_by_glslang() {
    let text = whole(Language::Hlsl);
    let with_main = format!("{text}\n[numthreads(1, 1, 1)] void main() {{}}\n");
    compiled(SourceLanguage::HLSL, &with_main).unwrap_or_else(|log| panic!("{log}"));
    let broken = with_main.replace("return ", "retrun ");
    assert!(compiled(SourceLanguage::HLSL, &broken).is_err());
}

#[test]
fn msl_is_compiled_as_the_cpp_that_it_is() {
    let text = whole(Language::Msl);
    metal::compiled(&text).unwrap_or_else(|log| panic!("{log}"));
    let broken =
        text.replace("half_vector(", "half_vektor(")
            .replacen("half_vektor(", "half_vector(", 1);
    assert!(metal::compiled(&broken).is_err());
}

/// Compiles a compute shader; the log where it fails.
fn compiled(source_language: SourceLanguage, text: &str) -> Result<(), String> {
    let compiler = Compiler::acquire().expect("glslang");
    let options = CompilerOptions {
        source_language,
        target: Target::Vulkan {
            version: VulkanVersion::Vulkan1_3,
            spirv_version: SpirvVersion::SPIRV1_6,
        },
        version_profile: None,
        messages: ShaderMessage::DEFAULT,
    };
    let source = ShaderSource::from(text);
    let input = ShaderInput::new(&source, ShaderStage::Compute, &options, None, None)
        .map_err(|error| error.to_string())?;
    let shader = compiler
        .create_shader(input)
        .map_err(|error| format!("{error:?}"))?;
    shader
        .compile()
        .map(|_| ())
        .map_err(|error| format!("{error:?}"))
}

/// The WGSL is evaluated in 32 bits, statement by statement, and held against the truth in f64 within the library's promise.
#[test]
fn exported_functions_compute_what_the_library_promises() {
    let text = whole(Language::Wgsl);
    let module = naga::front::wgsl::parse_str(&text).expect("WGSL");
    let run = |name: &str, arguments: &[Value]| call(&module, name, arguments);
    let number = |x: f32| Value::Numbers(vec![x]);
    let vector = |v: Vec3| Value::Numbers(v.to_array().to_vec());
    let mut judged = 0;
    for (l, e) in pairs() {
        for (roughness, f0) in [(0.05, 0.04), (0.3, 0.9), (1.0, 0.0)] {
            let [n, l, e] = [Vec3::Z, l.as_vec3().normalize(), e.as_vec3().normalize()];
            let input = ProbeInput::new([n, l, e].map(|v| v.to_array()), roughness, f0);
            let (nol, noe, loe) = (n.dot(l), n.dot(e), l.dot(e));
            let f0 = vector(Vec3::splat(f0));
            let f90 = run("f90_of", std::slice::from_ref(&f0));
            let weights = run("oren_nayar_weights", &[number(roughness)]);
            let directions = [n, l, e].map(vector);
            let [n, l, e] = directions;
            let cosines = [number(nol), number(noe)];
            let [of_l, of_e] = cosines;
            let m2 = number(roughness * roughness);
            let values = [
                (
                    "oren-nayar",
                    run(
                        "oren_nayar",
                        &[weights, of_l.clone(), of_e.clone(), number(loe)],
                    ),
                ),
                (
                    "cook-torrance",
                    run("cook_torrance", &[n, l, e, of_l, of_e, m2, f0, f90]),
                ),
            ];
            for (name, value) in values {
                let truth = Truth::of(Function::of_name(name).expect("a function"));
                let Some(bound) = truth.bound(Tier::F32, &input) else {
                    continue;
                };
                let (got, want) = (f64::from(value.first()), truth.at(&input));
                assert!(
                    (got - want).abs() <= bound * want,
                    "{name} at {input:?}: {got} for {want}"
                );
                judged += 1;
            }
        }
    }
    assert!(judged > 1000, "{judged}");
}

/// Where the exponential is below the least normal number, what Vulkan allows it to be off by is multiplied by up to 2^134.
#[test]
fn far_from_its_peak_a_lobe_is_0_on_whatever_device() {
    let module = naga::front::wgsl::parse_str(&whole(Language::Wgsl)).expect("WGSL");
    let d = |sine2: f32, noh2: f32, hh: f32, m: f32| {
        let arguments = [sine2, noh2, hh, m * m].map(|x| Value::Numbers(vec![x]));
        call(&module, "D_Beckmann", &arguments).first()
    };
    // Light and eye opposite and next to the surface, smooth and less so; ten roughnesses from the normal.
    let small = 2.0_f32.powi(-20);
    let far = [
        [1.0, small * small / 4.0, 1.0, 1e-4],
        [small, small * small / 4.0, small, 1e-3],
        [2.0, 2.0, 4.0, 0.1],
    ];
    for [sine2, noh2, hh, m] in far {
        assert_eq!(d(sine2, noh2, hh, m), 0.0);
    }
    // Just within reach it is more than that, and finite.
    let near = d(0.86, 1.0, 1.86, 0.1);
    assert!(near > 0.0 && near < 1e-30, "{near}");
}
