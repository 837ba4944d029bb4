//! Which pictures does a page show of each scene?

use super::gallery::Exhibit;
use super::name;
use crate::reference::ladders::Mix;
use crate::reference::shade::Lighting;
use crate::render::Picture;
use crate::report::SceneCost;
use crate::studies::difference::Display;

/// A picture for people.
pub struct Shown {
    /// The scene's file.
    pub scene: String,
    /// What drew it.
    pub tier: String,
    /// Its mean of FLIP; none for the reference.
    pub flip_mean: Option<f64>,
    /// It.
    pub picture: Picture,
    /// How it is shown.
    pub display: Display,
}

/// Models of each scene's sheet, beside the reference.
const SHEET: usize = 7;

/// Each scene's reference, then models from the worst to the best: those on its front, and the slides'.
pub(super) fn shown(exhibits: &[Exhibit], models: &[Lighting]) -> Vec<Shown> {
    let mut all = Vec::new();
    for exhibit in exhibits {
        let display = exhibit.sight().display();
        all.push(Shown {
            scene: exhibit.name.clone(),
            tier: "reference, f64".to_owned(),
            flip_mean: None,
            picture: exhibit.reference().clone(),
            display,
        });
        let rows = exhibit.rows(models);
        let on_front = |lighting: &Lighting, row: &Option<SceneCost>| {
            let mix = matches!(lighting, Lighting::Mixed(Mix { .. }));
            !mix || row.as_ref().is_some_and(|row| row.pareto)
        };
        let mut front: Vec<Lighting> = models
            .iter()
            .zip(&rows)
            .filter(|(lighting, row)| on_front(lighting, row))
            .map(|(lighting, _)| *lighting)
            .collect();
        let error = |lighting: &Lighting| {
            let look = exhibit.seen(*lighting);
            look.map_or(f64::NAN, |look| look.flip_mean)
        };
        front.sort_by(|a, b| error(b).total_cmp(&error(a)));
        for lighting in spread(&front, SHEET) {
            if let Some(look) = exhibit.seen(lighting) {
                all.push(Shown {
                    scene: exhibit.name.clone(),
                    tier: name(lighting),
                    flip_mean: Some(look.flip_mean),
                    picture: look.picture.clone(),
                    display,
                });
            }
        }
    }
    all
}

/// So many of them, first and last among them, evenly.
fn spread<T: Copy>(all: &[T], count: usize) -> Vec<T> {
    if all.len() <= count {
        return all.to_vec();
    }
    let last = (count - 1).max(1);
    (0..count)
        .map(|i| all[i * (all.len() - 1) / last])
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sheet_holds_the_ends() {
        let all: Vec<usize> = (0..20).collect();
        assert_eq!(spread(&all, 4), [0, 6, 12, 19]);
        assert_eq!(spread(&all[..3], 4), [0, 1, 2]);
    }
}
