//! How far are two pictures apart: as rows, and in words?

use super::provenance::Program;

/// `umber.diff/1`.
#[derive(Clone, PartialEq, Debug, serde::Serialize)]
pub struct DiffReport {
    /// Names this layout.
    pub schema: &'static str,
    /// The first picture's file.
    pub a: String,
    /// The second's.
    pub b: String,
    /// Pixels a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// How linear values became codes; null where both files hold codes.
    pub display: Option<DisplayRow>,
    /// How far they are apart.
    #[serde(flatten)]
    pub difference: DifferenceRow,
    /// What made this report.
    pub program: Program,
}

/// How linear values became codes.
#[derive(Clone, PartialEq, Debug, serde::Serialize)]
pub struct DisplayRow {
    /// EV at ISO 100.
    pub exposure_ev100: f64,
    /// Whether the first picture's brightness chose it, and not the user.
    pub chosen: bool,
    /// `none` or `neutral`.
    pub tone_mapping: String,
}

/// How far two pictures are apart. Places are columns and rows, from 0 at the top left; the first of equals.
#[derive(Clone, PartialEq, Debug, serde::Serialize)]
pub struct DifferenceRow {
    /// As a person sees it, on a screen.
    pub flip: FlipRow,
    /// 10 log10(255^2 / mean square) of the codes, all three channels alike; null where no code differs.
    pub psnr_db: Option<f64>,
    /// In sRGB codes, 0 to 255.
    pub codes: CodesRow,
    /// In the files' own linear numbers; null where one of them holds codes.
    pub linear: Option<GapRow>,
}

/// FLIP over all pixels.
#[derive(Clone, PartialEq, Debug, serde::Serialize)]
pub struct FlipRow {
    /// 0 to 1.
    pub mean: f64,
    /// The least that 95 % of the pixels do not exceed.
    pub p95: f64,
    /// The largest.
    pub largest: f64,
    /// Where it is.
    pub at: [u32; 2],
    /// How near the screen is.
    pub pixels_per_degree: f64,
}

/// The absolute difference of numbers, all of red, green and blue.
#[derive(Clone, PartialEq, Debug, serde::Serialize)]
pub struct GapRow {
    /// The largest.
    pub largest: f64,
    /// Where it is.
    pub at: [u32; 2],
    /// The mean.
    pub mean: f64,
}

/// The difference of codes.
#[derive(Clone, PartialEq, Debug, serde::Serialize)]
pub struct CodesRow {
    /// Their differences.
    #[serde(flatten)]
    pub gap: GapRow,
    /// The share of codes that differ by more than 1.
    pub over_one: f64,
}

impl DiffReport {
    /// The layout that `schema` names.
    pub const SCHEMA: &'static str = "umber.diff/1";

    /// A few lines.
    pub fn text(&self) -> String {
        let Self { a, b, .. } = self;
        let size = format!("{} x {}", self.width, self.height);
        let mut lines = vec![format!("pictures    {a}, {b} ({size})")];
        lines.extend(self.display.as_ref().map(DisplayRow::text));
        let DifferenceRow {
            flip,
            psnr_db,
            codes,
            linear,
        } = &self.difference;
        lines.push(format!(
            "FLIP        mean {:.5}, 95 % of pixels up to {:.5}, largest {:.5} at {}",
            flip.mean,
            flip.p95,
            flip.largest,
            place(flip.at)
        ));
        lines.push(match psnr_db {
            Some(db) => format!("PSNR        {db:.2} dB"),
            None => "PSNR        none: no code differs".to_owned(),
        });
        lines.push(format!(
            "sRGB codes  largest difference {} at {}, mean {:.4}; {:.2} % differ by over 1",
            shortest(codes.gap.largest),
            place(codes.gap.at),
            codes.gap.mean,
            100.0 * codes.over_one
        ));
        lines.extend(linear.as_ref().map(|gap| {
            format!(
                "linear      largest difference {:.3e} at {}, mean {:.3e}",
                gap.largest,
                place(gap.at),
                gap.mean
            )
        }));
        lines.join("\n") + "\n"
    }
}

impl DisplayRow {
    fn text(&self) -> String {
        let by = match self.chosen {
            true => "the first's mean luminance (logarithmic) at 18 %",
            false => "as asked",
        };
        format!(
            "shown       at EV100 {:.2} ({by}), tone mapping {}",
            self.exposure_ev100, self.tone_mapping
        )
    }
}

fn place([x, y]: [u32; 2]) -> String {
    format!("column {x}, row {y}")
}

/// A code's difference: whole where both files have 8 bits.
fn shortest(code: f64) -> String {
    match code.fract() == 0.0 {
        true => format!("{code}"),
        false => format!("{code:.3}"),
    }
}
