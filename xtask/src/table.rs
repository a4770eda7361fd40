//! Tables for people; they are Markdown as well.

use comfy_table::{presets::ASCII_MARKDOWN, CellAlignment, Table};

/// Prints a table and an empty line.
pub(crate) fn print(head: &[&str], rows: Vec<Vec<String>>) {
    println!("{}\n", text(head, rows));
}

/// A table as text. The first column is aligned left, the others right.
pub(crate) fn text(head: &[&str], rows: Vec<Vec<String>>) -> String {
    let mut table = Table::new();
    table.load_preset(ASCII_MARKDOWN).set_header(head.iter().copied()).add_rows(rows);
    for column in table.column_iter_mut().skip(1) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    table.to_string()
}

/// A number with its thousands apart.
pub(crate) fn number(number: u64) -> String {
    let digits = number.to_string();
    let groups: Vec<_> = digits.as_bytes().rchunks(3).rev().map(String::from_utf8_lossy).collect();
    groups.join(" ")
}

/// A number, or a dash where it does not apply.
pub(crate) fn optional(value: Option<u64>) -> String {
    value.map_or("–".to_owned(), number)
}
