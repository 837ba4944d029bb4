//! Does `umber export` write what is asked for, where it is asked for?

use super::{Place, Tested};

#[test]
fn the_library_goes_to_stdout_or_to_a_file() -> Tested {
    let place = Place::empty()?;
    let words = ["fn F_Schlick(", "Apache-2.0", "Cook and Torrance 1982"];
    let run = place
        .umber(&["export", "--language", "wgsl"])?
        .ends(0, &words);
    let file = ["export", "--language", "wgsl", "-o", "library.wgsl"];
    place.umber(&file)?.ends(0, &[]);
    assert_eq!(std::fs::read(place.path("library.wgsl"))?, run.stdout);
    // No source tree is here: the program has it all.
    assert_eq!(place.names()?, ["library.wgsl"]);
    for (language, words) in [
        ("hlsl", ["float3 F_Schlick(float3 f0, ", "-Gis"]),
        ("msl", ["metal::float3 F_Schlick(", "fast math"]),
        ("glsl", ["vec3 F_Schlick(vec3 f0, ", "precise float"]),
    ] {
        place
            .umber(&["export", "--language", language])?
            .ends(0, &words);
    }
    let one = place.umber(&["export", "--language", "glsl", "schlick-f", "f90_of"]);
    one?.ends(2, &["unknown function 'schlick-f'"]);
    place
        .umber(&["export", "--list"])?
        .ends(0, &["schlick: How much", "  f90_of, F_Schlick"]);
    Ok(())
}

#[test]
fn what_makes_no_sense_is_refused() -> Tested {
    let place = Place::empty()?;
    let export = |rest: &[&str]| place.umber(&[&["export"], rest].concat());
    export(&[])?.ends(2, &["--language"]);
    export(&["--language", "spirv"])?.ends(2, &["wgsl"]);
    export(&["--language", "wgsl", "F_Shlick"])?.ends(2, &["'F_Schlick'"]);
    export(&["--language", "msl", "dot_compensated"])?.ends(2, &["dot_compensated", "only glsl"]);
    export(&["--list", "--language", "wgsl"])?.ends(2, &["--list"]);
    export(&["--language", "wgsl", "-o", "none/a.wgsl"])?.ends(6, &["none/a.wgsl"]);
    assert!(place.names()?.is_empty());
    Ok(())
}
