//! The README's tables and picture.

use crate::project::{self, progress};
use crate::{accuracy, cycles};
use anyhow::{Context, Result};

/// Write the README's tables anew, from what is measured now.
#[derive(clap::Args)]
pub(crate) struct Arguments {}

/// `cargo xtask readme`.
pub(crate) fn run(_: &Arguments) -> Result<()> {
    let path = project::root().join("README.md");
    let mut text = std::fs::read_to_string(&path)?;
    for (mark, table) in [("accuracy", accuracy::summary()?), ("cycles", cycles::summary()?)] {
        text = replaced(&text, mark, &table).with_context(|| format!("README.md has no place for the table {mark:?}"))?;
    }
    std::fs::write(&path, text)?;
    progress("README.md is written");
    Ok(())
}

/// The text with another table between the marks of that name.
fn replaced(text: &str, mark: &str, table: &str) -> Option<String> {
    let (before, rest) = text.split_once(&format!("<!-- {mark} -->\n"))?;
    let (_, after) = rest.split_once("<!-- end -->")?;
    Some(format!("{before}<!-- {mark} -->\n{table}\n<!-- end -->{after}"))
}

#[cfg(test)]
mod tests {
    use super::replaced;

    #[test]
    fn only_what_stands_between_the_marks_changes() {
        let text = "a\n<!-- x -->\nold\n<!-- end -->\nb <!-- y -->\n<!-- end -->";
        assert_eq!(replaced(text, "x", "new").unwrap(), "a\n<!-- x -->\nnew\n<!-- end -->\nb <!-- y -->\n<!-- end -->");
        assert_eq!(replaced(text, "z", "new"), None);
    }
}
