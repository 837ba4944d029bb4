//! How does a table of figures become a chart, as SVG within a page?
//!
//! Colours are classes of the page's style, so that a chart follows it into the dark and onto paper. Lines are
//! named at their ends. Sizes are in the units of the view box, of which a page shows about one a pixel.

use std::fmt::Write as _;

/// A chart with its words.
pub struct Figure {
    pub title: String,
    pub svg: String,
    pub caption: String,
}

/// A chart with two logarithmic axes.
pub struct Chart {
    /// What `x` is, with its unit.
    pub x: String,
    /// What `y` is, with its unit.
    pub y: String,
    /// A line across, and its name.
    pub level: Option<(f64, String)>,
    /// Values of `x` to point out.
    pub marks: Vec<Mark>,
    /// The lines.
    pub lines: Vec<Line>,
}

/// A value of `x` with the interval that it may lie in.
pub struct Mark {
    pub x: f64,
    pub low: Option<f64>,
    pub high: Option<f64>,
    pub name: String,
}

/// How a line or a bar is drawn.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Style {
    /// A class of the page's style.
    pub colour: &'static str,
    pub dashed: bool,
    /// Told apart without colour.
    pub shape: Shape,
}

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Shape {
    Disc,
    Square,
    Triangle,
    Diamond,
}

pub struct Line {
    /// At its end; empty for a line that is told by another.
    pub name: String,
    pub style: Style,
    pub points: Vec<Point>,
}

/// A figure with its interval or spread.
#[derive(Clone, Debug)]
pub struct Point {
    pub x: f64,
    pub y: f64,
    pub low: Option<f64>,
    pub high: Option<f64>,
    /// The interval of `x`.
    pub across: Option<(f64, f64)>,
    /// Where a click leads: an anchor of the page.
    pub anchor: String,
    /// What the pointer is told.
    pub told: String,
}

const WIDTH: f64 = 620.0;
const HEIGHT: f64 = 384.0;
const LEFT: f64 = 58.0;
/// Beside the axes, for names of lines: at least, and for each letter.
const NAMES: f64 = 186.0;
const LETTER: f64 = 6.1;
/// From the axes to a name.
const NAME_AT: f64 = 23.0;
const TOP: f64 = 14.0;
const BOTTOM: f64 = HEIGHT - 48.0;
/// The least distance of two names.
const LINE_HEIGHT: f64 = 14.0;

/// Text, as it stands within an element or an attribute. XML has no way to write most control characters.
pub fn escape(text: &str) -> String {
    let mut escaped = String::new();
    for c in super::bench_words::plain(text).chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\'' => escaped.push_str("&#39;"),
            c => escaped.push(c),
        }
    }
    escaped
}

/// Appends to a text, which cannot fail.
macro_rules! put {
    ($text:expr, $($arguments:tt)*) => {{
        let _ = write!($text, $($arguments)*);
    }};
}
pub(super) use put;

/// Whether a logarithmic axis can show it.
fn can_show(x: f64) -> bool {
    (1.0e-12..=1.0e15).contains(&x)
}

/// Values from `low` to `high` on `from` to `to`, logarithmically.
struct Scale {
    low: f64,
    high: f64,
    from: f64,
    to: f64,
}

impl Scale {
    /// Over all `values` that it can show, out to the next of 1, 2, 5, 10, 20, ...
    fn over(values: impl Iterator<Item = f64>, from: f64, to: f64) -> Option<Self> {
        let mut range: Option<(f64, f64)> = None;
        for value in values.filter(|value| can_show(*value)) {
            let (low, high) = range.unwrap_or((value, value));
            range = Some((low.min(value), high.max(value)));
        }
        let (low, high) = range?;
        let steps = steps(low, high);
        let below = steps.iter().rev().find(|step| **step <= low * 1.000_001);
        let above = steps.iter().find(|step| **step >= high * 0.999_999);
        let (low, high) = (*below?, *above?);
        let high = if high > low { high } else { low * 10.0 };
        Some(Self {
            low,
            high,
            from,
            to,
        })
    }

    fn at(&self, value: f64) -> f64 {
        let share = (value / self.low).ln() / (self.high / self.low).ln();
        self.from + share.clamp(0.0, 1.0) * (self.to - self.from)
    }

    /// 1, 2, 5, 10, ... where there is room, or else powers of ten.
    fn ticks(&self) -> Vec<f64> {
        let within = |x: &f64| *x >= self.low * 0.999_999 && *x <= self.high * 1.000_001;
        let fine: Vec<f64> = steps(self.low, self.high)
            .into_iter()
            .filter(within)
            .collect();
        if fine.len() <= 9 {
            return fine;
        }
        let is_ten = |x: &f64| (x.log10() - x.log10().round()).abs() < 1.0e-6;
        let tens: Vec<f64> = fine.into_iter().filter(is_ten).collect();
        let every = tens.len().div_ceil(9);
        tens.into_iter().step_by(every).collect()
    }
}

/// 1, 2, 5 times all powers of ten from below `low` to above `high`.
fn steps(low: f64, high: f64) -> Vec<f64> {
    let first = low.log10().floor() as i32 - 1;
    let last = high.log10().ceil() as i32 + 1;
    let decade = |power: i32| [1.0, 2.0, 5.0].map(|step| step * 10.0_f64.powi(power));
    (first..=last).flat_map(decade).collect()
}

/// `0.5`, `200`, `10k`, `1M`.
fn tick_text(x: f64) -> String {
    let (x, unit) = match x {
        x if x >= 0.999e9 => (x / 1e9, "G"),
        x if x >= 0.999e6 => (x / 1e6, "M"),
        x if x >= 0.999e4 => (x / 1e3, "k"),
        x => (x, ""),
    };
    // Of 0 the logarithm is infinite, and no format takes as many digits.
    let digits = match x.log10() {
        power if power < 0.0 && power.is_finite() => (-power - 1e-6).ceil() as usize,
        _ if (x - x.round()).abs() > 1e-6 => 1,
        _ => 0,
    };
    format!("{x:.digits$}{unit}")
}

/// The chart, or nothing where no line has a point to show.
pub fn chart(chart: &Chart) -> Option<String> {
    let lines = shown(&chart.lines);
    let points = || lines.iter().flat_map(|line| &line.points);
    // A wild interval runs out of the chart, rather than flattening all else.
    let wild = |point: &Point, x: f64| x > point.y * 10.0 || x < point.y / 10.0;
    let bars = points().flat_map(|point| {
        let bars = point.low.into_iter().chain(point.high);
        bars.filter(|x| !wild(point, *x))
    });
    let level = chart.level.iter().map(|(y, _)| *y);
    let y = Scale::over(
        points().map(|point| point.y).chain(bars).chain(level),
        BOTTOM,
        TOP,
    )?;
    let across = points().filter_map(|point| point.across);
    let across = across.flat_map(|(low, high)| [low, high]);
    let right = WIDTH - names_take(chart);
    let x = Scale::over(points().map(|point| point.x).chain(across), LEFT, right)?;
    let mut svg = format!(
        "<svg viewBox=\"0 0 {WIDTH} {HEIGHT}\" role=\"img\" aria-label=\"{} against {}\">\n",
        escape(&chart.y),
        escape(&chart.x)
    );
    axes(&mut svg, chart, &x, &y);
    for (i, mark) in chart.marks.iter().enumerate() {
        draw_mark(&mut svg, mark, &x, i);
    }
    if let Some((level, _)) = &chart.level {
        let at = y.at(*level);
        put!(
            svg,
            "<path class=\"level\" d=\"M{LEFT} {at:.1}H{right}\"/>\n"
        );
    }
    for line in &lines {
        draw_line(&mut svg, line, &x, &y);
    }
    names(&mut svg, chart, &lines, &x, &y);
    svg.push_str("</svg>\n");
    Some(svg)
}

/// How far the axes end from the edge, so that the longest name has room.
fn names_take(chart: &Chart) -> f64 {
    let names = chart.lines.iter().map(|line| &line.name);
    let names = names.chain(chart.level.iter().map(|(_, name)| name));
    let longest = names.map(|name| name.chars().count()).max().unwrap_or(0);
    NAMES.max(NAME_AT + LETTER * longest as f64)
}

/// Lines with the points that can be shown, from left to right.
fn shown(lines: &[Line]) -> Vec<Line> {
    let shown = lines.iter().map(|line| {
        let points = line.points.iter();
        let mut points: Vec<Point> = points
            .filter(|point| can_show(point.x) && can_show(point.y))
            .cloned()
            .collect();
        points.sort_by(|a, b| a.x.total_cmp(&b.x));
        Line {
            name: line.name.clone(),
            style: line.style,
            points,
        }
    });
    shown.filter(|line| !line.points.is_empty()).collect()
}

fn axes(svg: &mut String, chart: &Chart, x: &Scale, y: &Scale) {
    for tick in y.ticks() {
        let at = y.at(tick);
        put!(svg, "<path class=\"grid\" d=\"M{LEFT} {at:.1}H{}\"/>", x.to);
        put!(
            svg,
            "<text class=\"tick end\" x=\"{:.1}\" y=\"{:.1}\">{}</text>\n",
            LEFT - 7.0,
            at + 4.0,
            tick_text(tick)
        );
    }
    for tick in x.ticks() {
        let at = x.at(tick);
        put!(svg, "<path class=\"grid\" d=\"M{at:.1} {TOP}V{BOTTOM}\"/>");
        put!(
            svg,
            "<text class=\"tick mid\" x=\"{at:.1}\" y=\"{:.1}\">{}</text>\n",
            BOTTOM + 17.0,
            tick_text(tick)
        );
    }
    put!(
        svg,
        "<path class=\"axis\" d=\"M{LEFT} {TOP}V{BOTTOM}H{}\"/>\n",
        x.to
    );
    put!(
        svg,
        "<text class=\"name mid\" x=\"{:.1}\" y=\"{:.1}\">{}</text>\n",
        LEFT.midpoint(x.to),
        BOTTOM + 38.0,
        escape(&chart.x)
    );
    let middle = TOP.midpoint(BOTTOM);
    put!(
        svg,
        "<text class=\"name mid\" transform=\"translate(13 {middle:.1}) rotate(-90)\">{}</text>\n",
        escape(&chart.y)
    );
}

/// Its names stand below each other at the top.
fn draw_mark(svg: &mut String, mark: &Mark, x: &Scale, place: usize) {
    if !can_show(mark.x) {
        return;
    }
    let at = x.at(mark.x);
    let (low, high) = (mark.low.unwrap_or(mark.x), mark.high.unwrap_or(mark.x));
    if can_show(low) && can_show(high) {
        let (low, high) = (x.at(low), x.at(high));
        put!(
            svg,
            "<rect class=\"band\" x=\"{low:.1}\" y=\"{TOP}\" width=\"{:.1}\" height=\"{:.1}\"/>",
            (high - low).max(0.0),
            BOTTOM - TOP
        );
    }
    put!(svg, "<path class=\"mark\" d=\"M{at:.1} {TOP}V{BOTTOM}\"/>");
    // On the side where there is more room.
    let (class, beside) = match at < LEFT.midpoint(x.to) {
        true => ("label", at + 5.0),
        false => ("label end", at - 5.0),
    };
    let y = TOP + 12.0 + LINE_HEIGHT * place as f64;
    put!(
        svg,
        "<text class=\"{class}\" x=\"{beside:.1}\" y=\"{y:.1}\">{}</text>\n",
        escape(&mark.name)
    );
}

fn draw_line(svg: &mut String, line: &Line, x: &Scale, y: &Scale) {
    let colour = line.style.colour;
    let dashed = if line.style.dashed { " dashed" } else { "" };
    let mut path = String::new();
    let mut bars = String::new();
    for (i, point) in line.points.iter().enumerate() {
        let (px, py) = (x.at(point.x), y.at(point.y));
        put!(path, "{}{px:.1} {py:.1}", if i == 0 { "M" } else { "L" });
        if let (Some(low), Some(high)) = (point.low, point.high) {
            // What an axis cannot show lies below it.
            let (low, high) = (y.at(low.max(y.low)), y.at(high.clamp(y.low, y.high)));
            put!(
                bars,
                "M{px:.1} {low:.1}V{high:.1}M{:.1} {low:.1}h6M{:.1} {high:.1}h6",
                px - 3.0,
                px - 3.0
            );
        }
        if let Some((low, high)) = point.across {
            let (low, high) = (x.at(low.max(x.low)), x.at(high.clamp(x.low, x.high)));
            put!(
                bars,
                "M{low:.1} {py:.1}H{high:.1}M{low:.1} {:.1}v6M{high:.1} {:.1}v6",
                py - 3.0,
                py - 3.0
            );
        }
    }
    put!(svg, "<path class=\"line {colour}{dashed}\" d=\"{path}\"/>");
    if !bars.is_empty() {
        put!(svg, "<path class=\"bars {colour}\" d=\"{bars}\"/>");
    }
    svg.push('\n');
    for point in &line.points {
        let (px, py) = (x.at(point.x), y.at(point.y));
        marker(svg, line.style, px, py, point);
    }
}

/// A point that leads to its row.
fn marker(svg: &mut String, style: Style, x: f64, y: f64, point: &Point) {
    let outline = match style.shape {
        Shape::Disc => "m-3.2 0a3.2 3.2 0 1 0 6.4 0a3.2 3.2 0 1 0 -6.4 0z",
        Shape::Square => "m-3 -3h6v6h-6z",
        Shape::Triangle => "m0 -4l3.8 6.6h-7.6z",
        Shape::Diamond => "m0 -4.4l4.4 4.4l-4.4 4.4l-4.4 -4.4z",
    };
    let hollow = if style.dashed { " hollow" } else { "" };
    let (anchor, told, colour) = (escape(&point.anchor), escape(&point.told), style.colour);
    put!(
        svg,
        "<a href=\"#{anchor}\"><path class=\"marker {colour}{hollow}\" d=\"M{x:.1} {y:.1}{outline}\"><title>{told}</title></path></a>\n"
    );
}

/// Names at the ends of lines, moved apart where they would meet.
fn names(svg: &mut String, chart: &Chart, lines: &[Line], x: &Scale, y: &Scale) {
    let mut names = Vec::new();
    for line in lines.iter().filter(|line| !line.name.is_empty()) {
        if let Some(last) = line.points.last() {
            names.push((
                y.at(last.y),
                x.at(last.x),
                line.style.colour,
                line.name.as_str(),
            ));
        }
    }
    if let Some((level, name)) = &chart.level {
        names.push((y.at(*level), x.to, "ink", name));
    }
    names.sort_by(|a, b| a.0.total_cmp(&b.0));
    let wanted: Vec<f64> = names.iter().map(|name| name.0).collect();
    for ((from, end, colour, name), to) in names.into_iter().zip(apart(&wanted)) {
        let elbow = x.to + 4.0;
        put!(
            svg,
            "<path class=\"lead {colour}\" d=\"M{:.1} {from:.1}H{elbow}L{:.1} {to:.1}h6\"/>",
            end + 5.0,
            x.to + 14.0
        );
        put!(
            svg,
            "<text class=\"label\" x=\"{:.1}\" y=\"{:.1}\">{}</text>\n",
            x.to + NAME_AT,
            to + 4.0,
            escape(name)
        );
    }
}

/// Heights near the `wanted` ones, which ascend, and `LINE_HEIGHT` from each other: whoever meet share the
/// middle of what they want.
fn apart(wanted: &[f64]) -> Vec<f64> {
    // Blocks of neighbours: how many, and the sum of where their first would have to be for each.
    let mut blocks: Vec<(usize, f64)> = Vec::new();
    let first = |block: &(usize, f64)| block.1 / block.0 as f64;
    for y in wanted {
        let mut block = (1, *y);
        while let Some(above) =
            blocks.pop_if(|above| first(above) + LINE_HEIGHT * above.0 as f64 > first(&block))
        {
            let shift = LINE_HEIGHT * above.0 as f64 * block.0 as f64;
            block = (above.0 + block.0, above.1 + block.1 - shift);
        }
        blocks.push(block);
    }
    let mut places = Vec::new();
    for block in &blocks {
        let start = first(block);
        places.extend((0..block.0).map(|i| start + LINE_HEIGHT * i as f64));
    }
    // Pushed up from the bottom, where the last would leave the picture.
    let mut limit = HEIGHT - 8.0;
    for place in places.iter_mut().rev() {
        *place = place.min(limit);
        limit = *place - LINE_HEIGHT;
    }
    places
}

/// A bar with its whisker, and a diamond beside it.
pub struct Bar {
    pub name: String,
    pub style: Style,
    pub value: Point,
    /// The diamond.
    pub other: Option<Point>,
}

const ROW: f64 = 23.0;
const BAR_LEFT: f64 = 176.0;
const BAR_RIGHT: f64 = WIDTH - 62.0;

/// Bars from 0 to at most `most`, with a line at 1; only `y` of their points counts.
pub fn bars(bars: &[Bar], most: f64, label: &str) -> Option<String> {
    let fine = |x: f64| x.is_finite() && x >= 0.0;
    let bars: Vec<&Bar> = bars.iter().filter(|bar| fine(bar.value.y)).collect();
    if bars.is_empty() || !can_show(most) {
        return None;
    }
    let bottom = 8.0 + ROW * bars.len() as f64;
    let height = bottom + 44.0;
    let at = |x: f64| BAR_LEFT + (x / most).clamp(0.0, 1.0) * (BAR_RIGHT - BAR_LEFT);
    let mut svg = format!(
        "<svg viewBox=\"0 0 {WIDTH} {height}\" role=\"img\" aria-label=\"{}\">\n",
        escape(label)
    );
    for tick in even_ticks(most) {
        let x = at(tick);
        put!(svg, "<path class=\"grid\" d=\"M{x:.1} 4V{bottom}\"/>");
        put!(
            svg,
            "<text class=\"tick mid\" x=\"{x:.1}\" y=\"{:.1}\">{}</text>\n",
            bottom + 17.0,
            tick_text(tick)
        );
    }
    for (i, bar) in bars.iter().enumerate() {
        draw_bar(&mut svg, bar, 8.0 + ROW * i as f64, &at);
    }
    let one = at(1.0);
    put!(svg, "<path class=\"level\" d=\"M{one:.1} 4V{bottom}\"/>");
    put!(svg, "<path class=\"axis\" d=\"M{BAR_LEFT} 4V{bottom}\"/>\n");
    let middle = BAR_LEFT.midpoint(BAR_RIGHT);
    put!(
        svg,
        "<text class=\"name mid\" x=\"{middle:.1}\" y=\"{:.1}\">{}</text>\n</svg>\n",
        bottom + 37.0,
        escape(label)
    );
    Some(svg)
}

fn draw_bar(svg: &mut String, bar: &Bar, top: f64, at: &dyn Fn(f64) -> f64) {
    let (value, colour) = (&bar.value, bar.style.colour);
    let middle = top + ROW / 2.0 - 1.0;
    let end = at(value.y);
    put!(
        svg,
        "<text class=\"label end\" x=\"{:.1}\" y=\"{:.1}\">{}</text>",
        BAR_LEFT - 8.0,
        middle + 4.0,
        escape(&bar.name)
    );
    put!(
        svg,
        "<a href=\"#{}\"><rect class=\"bar {colour}\" x=\"{BAR_LEFT}\" y=\"{:.1}\" width=\"{:.1}\" height=\"{:.1}\"><title>{}</title></rect></a>",
        escape(&value.anchor),
        top + 3.0,
        end - BAR_LEFT,
        ROW - 8.0,
        escape(&value.told)
    );
    let mut right = end;
    if let (Some(low), Some(high)) = (value.low, value.high) {
        let (low, high) = (at(low), at(high));
        right = right.max(high);
        put!(
            svg,
            "<path class=\"whisker\" d=\"M{low:.1} {middle:.1}H{high:.1}M{low:.1} {:.1}v6M{high:.1} {:.1}v6\"/>",
            middle - 3.0,
            middle - 3.0
        );
    }
    if let Some(other) = bar.other.as_ref().filter(|other| other.y.is_finite()) {
        let style = Style {
            dashed: true,
            shape: Shape::Diamond,
            ..bar.style
        };
        let x = at(other.y);
        marker(svg, style, x, middle, other);
        right = right.max(x);
    }
    put!(
        svg,
        "<text class=\"figure\" x=\"{:.1}\" y=\"{:.1}\">{}</text>\n",
        right + 8.0,
        middle + 4.0,
        super::bench_words::figure(value.y)
    );
}

/// At most about eight, on 1, 2 or 5 times a power of ten.
fn even_ticks(most: f64) -> Vec<f64> {
    let step = steps(most / 100.0, most)
        .into_iter()
        .find(|step| most / step <= 8.0);
    let step = step.unwrap_or(most);
    (0..=(most / step + 1e-6) as u32)
        .map(|i| f64::from(i) * step)
        .collect()
}
