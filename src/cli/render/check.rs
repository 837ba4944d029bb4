//! What does `umber render --check` say of pixels that no screen can show?

use crate::cli::exit::{Exit, Failure};
use crate::cli::options::count;
use crate::cli::output::talk;
use crate::render::{Defect, Defects};
use crate::studies::stability::{BadPixel, Cause};

/// Pixels that are told one by one.
const TOLD: usize = 8;

/// Tells the first few that differ in what makes them, each with the line that makes it again.
pub fn tell(pixels: &[BadPixel], defects: &Defects) {
    let different = different(pixels);
    different.iter().for_each(|pixel| talk(line(pixel)));
    let all = defects.not_finite() + defects.negative;
    let rest = all.saturating_sub(different.len());
    if rest > 0 {
        talk(format_args!(
            "and {} like them",
            count(rest as u64, "pixel")
        ));
    }
}

fn different(pixels: &[BadPixel]) -> Vec<&BadPixel> {
    let mut different: Vec<&BadPixel> = Vec::new();
    for pixel in pixels {
        let alike = |other: &&BadPixel| {
            other.material == pixel.material && other.defect == pixel.defect && same(other, pixel)
        };
        if different.len() < TOLD && !different.iter().any(alike) {
            different.push(pixel);
        }
    }
    different
}

/// Whether both are made by the same input.
fn same(a: &BadPixel, b: &BadPixel) -> bool {
    let inputs = [a, b].map(|pixel| pixel.cause.as_ref().map(command));
    inputs[0] == inputs[1]
}

/// The failure that such pixels are.
pub fn judge(defects: &Defects) -> Result<(), Failure> {
    if defects.not_finite() + defects.negative == 0 {
        return Ok(());
    }
    let message = format!(
        "{} pixels hold a NaN (magenta), {} an infinity (yellow), {} a negative value (cyan)",
        defects.nan, defects.infinite, defects.negative
    );
    Err(Failure::new(Exit::NotFinite, message))
}

fn line(pixel: &BadPixel) -> String {
    let BadPixel {
        x,
        y,
        defect,
        material,
        cause,
    } = pixel;
    let what = match defect {
        Defect::Nan => "NaN",
        Defect::Infinite => "infinite",
        Defect::Negative => "negative",
    };
    let place = format!("column {x}, row {y}: {what}, material '{material}'");
    match cause {
        None => format!("{place}; no lamp makes it alone"),
        Some(cause) => format!(
            "{place}, light '{}' at {:.2} degrees, eye at {:.2}: {} is {}\n  {}",
            cause.light,
            cause.light_degrees,
            cause.eye_degrees,
            cause.function.name,
            cause.value,
            command(cause)
        ),
    }
}

/// What makes the value again, by itself.
fn command(cause: &Cause) -> String {
    let numbers = cause.function.numbers(&cause.input);
    // The shortest digits that tell a float from its neighbours.
    let numbers: Vec<_> = numbers.iter().map(|x| format!("{x:?}")).collect();
    let name = cause.function.name;
    format!("echo '{}' | umber eval {name}", numbers.join(","))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::library::Function;

    #[test]
    fn a_line_names_all_and_repeats_it() {
        let cause = Cause {
            light: "key".to_owned(),
            light_degrees: 0.0,
            eye_degrees: 90.0,
            function: Function::of_name("slides-oren-nayar").expect("it is there"),
            input: crate::interface::ProbeInput {
                normal: [0.0, 1.0, 0.0],
                roughness: 0.5,
                light: [0.0, 1.0, 0.0],
                f0: 1e-10,
                eye: [1.0, 0.0, -0.0],
                place: 3,
                extra: [0.0; 4],
            },
            value: f32::NAN,
        };
        let pixel = BadPixel {
            x: 7,
            y: 5,
            defect: Defect::Nan,
            material: "gold".to_owned(),
            cause: Some(cause),
        };
        let want = "column 7, row 5: NaN, material 'gold', light 'key' at 0.00 degrees, eye at 90.00: \
                    slides-oren-nayar is NaN\n  echo '0.0,1.0,0.0,0.0,1.0,0.0,1.0,0.0,-0.0,0.5,1e-10' \
                    | umber eval slides-oren-nayar";
        assert_eq!(line(&pixel), want);
        let again = BadPixel {
            x: 8,
            ..pixel.clone()
        };
        let both = [pixel.clone(), again];
        assert_eq!(
            different(&both).iter().map(|p| p.x).collect::<Vec<_>>(),
            [7]
        );
        let alone = BadPixel {
            cause: None,
            ..pixel
        };
        assert!(line(&alone).ends_with("no lamp makes it alone"));
    }
}
