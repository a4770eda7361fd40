//! The tables in README and docs.

use crate::project::{self, progress};
use crate::{accuracy, adaptive, bus, compare, costs, cycles, gallery, goals, growth, ways};
use anyhow::{Context, Result};

/// Write the tables of README and docs/performance.md anew, from what is measured now.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// Those of docs/shading.md and of growth too, and the pictures; takes long.
    #[arg(long)]
    all: bool,
}

/// `cargo xtask readme`.
pub(crate) fn run(arguments: &Arguments) -> Result<()> {
    let peers = compare::summary()?;
    let tables =
        [("accuracy", accuracy::summary()?), ("cycles", cycles::summary()?), ("bus", bus::text()?), ("peers", peers.clone())];
    write("README.md", &tables)?;
    write("README.md", &[("transparent", cycles::transparent()?)])?;
    write("docs/performance.md", &[("peers", peers), ("goals", goals::text()?)])?;
    if arguments.all {
        gallery::run()?;
        // One by one, as each takes long.
        write("docs/beam.md", &[("ways", ways::text()?)])?;
        write("docs/performance.md", &[("growth", growth::text()?)])?;
        write("docs/shading.md", &[("accuracy", accuracy::every_case()?)])?;
        write("docs/shading.md", &[("adaptive", adaptive::text()?)])?;
        write("docs/shading.md", &[("costs", costs::text(&[])?)])?;
    }
    Ok(())
}

/// Puts tables into a file, each between the marks of its name.
fn write(file: &str, tables: &[(&str, String)]) -> Result<()> {
    let path = project::root().join(file);
    let mut text = std::fs::read_to_string(&path).with_context(|| file.to_owned())?;
    for (mark, table) in tables {
        text = replaced(&text, mark, table.trim_end()).with_context(|| format!("{file} has no place for the table {mark:?}"))?;
    }
    std::fs::write(&path, text)?;
    progress(format!("{file} is written"));
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
