//! How does a grid of figures become a picture of them, as SVG within a page?

use std::fmt::Write as _;

use super::plot::{escape, put};

/// Figures over two axes.
pub struct HeatMap<'m> {
    /// What goes from left to right, with its unit.
    pub x: &'m str,
    /// What goes upwards.
    pub y: &'m str,
    /// The middle of each column, and what stands under it; nothing for most.
    pub columns: Vec<(f64, String)>,
    /// The middle of each row, upwards, and what stands beside it.
    pub rows: Vec<(f64, String)>,
    /// Row by row, upwards.
    pub cells: Vec<Vec<Cell>>,
}

/// One figure.
#[derive(Clone, PartialEq, Debug)]
pub enum Cell {
    /// None.
    Nothing,
    /// So far up the scale, from 0 to 1, and what the pointer is told.
    Level(f64, String),
    /// Off the scale, and what the pointer is told.
    Bad(String),
}

/// Steps of the scale: classes `heat-0` up of the page's style.
pub const STEPS: usize = 9;

const WIDTH: f64 = 380.0;
const HEIGHT: f64 = 300.0;
const LEFT: f64 = 46.0;
const TOP: f64 = 8.0;
const BOTTOM: f64 = HEIGHT - 44.0;

impl HeatMap<'_> {
    /// The picture.
    pub fn svg(&self) -> String {
        let (columns, rows) = (self.columns.len(), self.rows.len());
        let width = (WIDTH - LEFT) / columns as f64;
        let height = (BOTTOM - TOP) / rows as f64;
        let mut svg = format!("<svg viewBox=\"0 0 {WIDTH} {HEIGHT}\">\n");
        for (j, row) in self.cells.iter().enumerate() {
            let y = BOTTOM - (j + 1) as f64 * height;
            for (i, cell) in row.iter().enumerate() {
                let x = LEFT + i as f64 * width;
                put_cell(&mut svg, (x, y), (width, height), cell);
            }
        }
        for (i, (_, name)) in self.columns.iter().enumerate() {
            let x = LEFT + (i as f64 + 0.5) * width;
            put_text(&mut svg, (x, BOTTOM + 15.0), "tick mid", name);
        }
        for (j, (_, name)) in self.rows.iter().enumerate() {
            let y = BOTTOM - (j as f64 + 0.5) * height + 4.0;
            put_text(&mut svg, (LEFT - 6.0, y), "tick end", name);
        }
        let middle = LEFT + (WIDTH - LEFT) / 2.0;
        put_text(&mut svg, (middle, HEIGHT - 10.0), "name mid", self.x);
        let y = TOP + (BOTTOM - TOP) / 2.0;
        put!(
            svg,
            "<text class=\"name mid\" transform=\"translate(12 {y:.1}) rotate(-90)\">{}</text>\n</svg>\n",
            escape(self.y)
        );
        svg
    }
}

/// The class of a level from 0 to 1.
fn class(level: f64) -> usize {
    ((level * STEPS as f64) as usize).min(STEPS - 1)
}

fn put_cell(svg: &mut String, (x, y): (f64, f64), (width, height): (f64, f64), cell: &Cell) {
    let (class, told) = match cell {
        Cell::Nothing => return,
        Cell::Level(level, told) => (format!("heat-{}", class(*level)), told),
        Cell::Bad(told) => ("heat-bad".to_owned(), told),
    };
    // A hair wider, so that no paper shows between two.
    let (width, height) = (width + 0.3, height + 0.3);
    put!(
        svg,
        "<rect class=\"{class}\" x=\"{x:.1}\" y=\"{y:.1}\" width=\"{width:.1}\" height=\"{height:.1}\"><title>{}</title></rect>\n",
        escape(told)
    );
}

fn put_text(svg: &mut String, (x, y): (f64, f64), class: &str, text: &str) {
    if !text.is_empty() {
        put!(
            svg,
            "<text class=\"{class}\" x=\"{x:.1}\" y=\"{y:.1}\">{}</text>\n",
            escape(text)
        );
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cell_is_a_rectangle_of_its_step() {
        let level = |level| Cell::Level(level, "told & escaped".to_owned());
        let map = HeatMap {
            x: "x",
            y: "y",
            columns: vec![(1.0, "1".to_owned()), (2.0, String::new())],
            rows: vec![(0.0, "low".to_owned()), (1.0, "high".to_owned())],
            cells: vec![
                vec![level(0.0), level(1.0)],
                vec![Cell::Nothing, Cell::Bad("none".to_owned())],
            ],
        };
        let svg = map.svg();
        let parsed = roxmltree::Document::parse(&svg).expect("well-formed");
        let rects: Vec<_> = parsed
            .descendants()
            .filter(|n| n.has_tag_name("rect"))
            .collect();
        let classes: Vec<_> = rects.iter().filter_map(|n| n.attribute("class")).collect();
        assert_eq!(classes, ["heat-0", "heat-8", "heat-bad"]);
        // The first row is the lower one.
        let y = |i: usize| rects[i].attribute("y").and_then(|y| y.parse::<f64>().ok());
        assert!(y(0) > y(2), "{svg}");
        assert_eq!(
            rects[0]
                .text()
                .or(rects[0].first_element_child().and_then(|t| t.text())),
            Some("told & escaped")
        );
    }
}
