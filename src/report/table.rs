//! How does a table look on a terminal?

use std::fmt::Write as _;

/// Where a column's cells stand.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Align {
    /// Words.
    Left,
    /// Numbers, so that their digits stand under each other.
    Right,
}

/// Writes a table: a line for each title, and under it its rows. Columns are as wide as their widest cell.
pub fn write_table<const N: usize>(
    text: &mut String,
    head: [&str; N],
    align: [Align; N],
    rows: impl Iterator<Item = (String, [String; N])>,
) {
    let rows: Vec<_> = rows.collect();
    let head = head.map(str::to_owned);
    let cells = rows.iter().map(|(_, cells)| cells).chain([&head]);
    let width = |column: usize| cells.clone().map(|row| row[column].chars().count()).max();
    let widths: [usize; N] = std::array::from_fn(|column| width(column).unwrap_or(0));
    text.push('\n');
    text.push_str(&line(&head, widths, align));
    let mut last = "";
    for (title, cells) in &rows {
        if title != last {
            text.push_str(title);
            text.push_str(":\n");
            last = title;
        }
        text.push_str(&line(cells, widths, align));
    }
}

/// A column without width is not there at all.
fn line<const N: usize>(cells: &[String; N], widths: [usize; N], align: [Align; N]) -> String {
    let mut line = String::new();
    for ((cell, width), align) in cells.iter().zip(widths).zip(align) {
        // Writing to a String cannot fail.
        let _ = match align {
            _ if width == 0 => Ok(()),
            Align::Left => write!(line, "{cell:<width$}  "),
            Align::Right => write!(line, "{cell:>width$}  "),
        };
    }
    format!("{}\n", line.trim_end())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table<const N: usize>(
        head: [&str; N],
        align: [Align; N],
        rows: &[(&str, [&str; N])],
    ) -> String {
        let mut text = String::new();
        let rows = rows
            .iter()
            .map(|(title, cells)| ((*title).to_owned(), cells.map(str::to_owned)));
        write_table(&mut text, head, align, rows);
        text
    }

    #[test]
    fn a_table_has_a_line_for_each_scene_and_even_columns() {
        let rows = [
            ("one.toml", ["x", "1"]),
            ("one.toml", ["longer", "2"]),
            ("two.toml", ["y", "3"]),
        ];
        let text = table(["name", "n"], [Align::Left; 2], &rows);
        let want = "\nname    n\none.toml:\nx       1\nlonger  2\ntwo.toml:\ny       3\n";
        assert_eq!(text, want);
    }

    #[test]
    fn numbers_stand_under_each_other_and_an_empty_column_is_left_out() {
        let align = [Align::Left, Align::Right, Align::Left];
        let rows = [("t", ["x", "1.5", ""]), ("t", ["y", "10.5", ""])];
        let text = table(["", "ms", ""], align, &rows);
        assert_eq!(text, "\n     ms\nt:\nx   1.5\ny  10.5\n");
    }
}
