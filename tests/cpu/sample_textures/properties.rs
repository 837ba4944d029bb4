//! Do the sample textures repeat without a seam, hold unit vectors, and have the means they state?

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use super::Content::{Color, Normal, Occlusion, Radiance};
use super::{MAX_BYTES, SAMPLES, Sample, codes};
use crate::tolerances;

/// What a file holds, as `Sample::mean` counts it.
fn values(sample: &Sample) -> Vec<[f64; 3]> {
    let kept = codes::read(sample).unwrap_or_else(|message| panic!("{message}"));
    let value = |x: f64| match sample.content {
        Color(_) => codes::decode_srgb(x),
        Normal(_) => 2.0 * x - 1.0,
        _ => x,
    };
    let texels = kept.chunks_exact(sample.channels());
    texels
        .map(|texel| [0, 1, 2].map(|k| value(texel[k.min(texel.len() - 1)])))
        .collect()
}

fn length(v: [f64; 3]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// The mean step from each column (or row) to the next, the last to the first.
fn steps(sample: &Sample, texels: &[[f64; 3]], along_u: bool) -> Vec<f64> {
    let [width, height] = sample.size.map(|side| side as usize);
    let (count, across) = if along_u {
        (width, height)
    } else {
        (height, width)
    };
    let at = |line: usize, n: usize| {
        let (x, y) = if along_u { (line, n) } else { (n, line) };
        texels[y * width + x]
    };
    let step = |line: usize| {
        let next = (line + 1) % count;
        let apart = (0..across).map(|n| {
            let (a, b) = (at(line, n), at(next, n));
            length([0, 1, 2].map(|k| a[k] - b[k]))
        });
        apart.sum::<f64>() / across as f64
    };
    (0..count).map(step).collect()
}

#[test]
fn textures_repeat_without_a_seam() {
    for sample in SAMPLES {
        let texels = values(sample);
        for along_u in [true, false] {
            let mut inside = steps(sample, &texels, along_u);
            let seam = inside.pop().unwrap_or_default();
            let largest = inside.iter().copied().fold(0.0, f64::max);
            assert!(
                seam <= tolerances::SEAM * largest,
                "{}: the seam is a step of {seam}, inside they reach {largest}",
                sample.file
            );
        }
    }
}

#[test]
fn normal_maps_hold_unit_vectors_that_point_outward() {
    for sample in SAMPLES.iter().filter(|s| matches!(s.content, Normal(_))) {
        for normal in values(sample) {
            let off = (length(normal) - 1.0).abs();
            assert!(
                off <= tolerances::UNIT_OF_CODES && normal[2] > 0.0,
                "{}: {normal:?}",
                sample.file
            );
        }
    }
}

#[test]
fn means_are_as_stated() {
    let mut wrong = Vec::new();
    for sample in SAMPLES {
        let texels = values(sample);
        let mean = [0, 1, 2]
            .map(|k| texels.iter().map(|texel| texel[k]).sum::<f64>() / texels.len() as f64);
        let near = |k: usize| (mean[k] - sample.mean[k]).abs() <= tolerances::TWO_DECIMALS;
        if ![0, 1, 2].into_iter().all(near) {
            wrong.push(format!(
                "{}: {mean:.2?}, not {:?}",
                sample.file, sample.mean
            ));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Light that no 8-bit file can hold is what a float format is for.
#[test]
fn radiance_exceeds_one() {
    for sample in SAMPLES.iter().filter(|s| matches!(s.content, Radiance(_))) {
        let brightest = values(sample).into_iter().flatten().fold(0.0, f64::max);
        assert!(brightest > 4.0, "{}: {brightest}", sample.file);
    }
}

/// In the gaps of a relief there is less sky than on its tops.
#[test]
fn occlusion_belongs_to_a_normal_map() {
    for sample in SAMPLES {
        let Occlusion(height) = sample.content else {
            continue;
        };
        let same = SAMPLES
            .iter()
            .any(|other| matches!(other.content, Normal(own) if std::ptr::fn_addr_eq(own, height)));
        assert!(same, "{}: its relief has no normal map", sample.file);
        let open = values(sample);
        let heights = super::sample(sample.size, height);
        let highest = heights.iter().copied().fold(f64::MIN, f64::max);
        for (open, height) in open.iter().zip(&heights) {
            assert!(
                *height < 0.99 * highest || open[0] > 0.97,
                "{open:?} on top"
            );
        }
        assert!(
            open.iter().any(|open| open[0] < 0.6),
            "{}: no gap is dark",
            sample.file
        );
    }
}

fn files(folder: &Path) -> BTreeSet<String> {
    let entries = fs::read_dir(folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display()));
    let names = entries.map(|entry| entry.map(|e| e.file_name().to_string_lossy().into_owned()));
    names.collect::<Result<_, _>>().expect("a readable folder")
}

#[test]
fn every_texture_has_its_function_and_all_are_small() {
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    let (mut found, mut bytes) = (BTreeSet::new(), 0);
    for folder in ["textures", "effects/textures"] {
        for file in files(&scenes.join(folder)) {
            let path = format!("{folder}/{file}");
            bytes += fs::metadata(scenes.join(&path)).map_or(0, |data| data.len());
            found.insert(path);
        }
    }
    let made: BTreeSet<_> = SAMPLES
        .iter()
        .map(|sample| sample.file.to_owned())
        .collect();
    assert_eq!(found, made);
    assert!(
        bytes <= MAX_BYTES,
        "{bytes} bytes, {MAX_BYTES} are the most"
    );
    for ending in ["png", "jpg", "hdr"] {
        let held = found.iter().any(|file| file.ends_with(ending));
        assert!(held, "no {ending}: a decoder goes unused");
    }
}
