//! Counting what firmware executes, by the plugin in `xtask/counter`.

use crate::elf::Elf;
use crate::firmware::Target;
use crate::process;
use crate::project::{self, progress};
use crate::qemu::{self, Emulator};
use anyhow::{bail, ensure, Context, Result};
use std::collections::BTreeMap;
use std::iter::Sum;
use std::path::PathBuf;
use std::time::Duration;

/// A part of the way from the mesh to a row of pixels.
struct Stage {
    name: &'static str,
    /// It claims what lies in these modules, and in their types' methods,
    modules: &'static [&'static str],
    /// and the library's functions of these names.
    functions: &'static [&'static str],
}

/// The stages. An address belongs to the first that claims a function there, be it inlined or not; what none claims
/// (`math`, the compiler's own library) counts for the stage that it is called from.
const STAGES: [Stage; 5] = [
    Stage { name: "prepare", modules: &["beamshade::frame", "beamshade::scan::bucket::Buckets"], functions: &[] },
    Stage { name: "set-up", modules: &[], functions: &["facet"] },
    Stage { name: "background", modules: &[], functions: &["fill"] },
    Stage { name: "shade", modules: &["beamshade::shade", "beamshade::sink"], functions: &[] },
    Stage { name: "scan", modules: &["beamshade::scan", "beamshade::scanner", "beamshade::walk"], functions: &[] },
];

impl Stage {
    /// Whether a function is of this stage, by its readable name, such as
    /// `<beamshade::scanner::Scanner<96> as core::fmt::Debug>::fmt` or `beamshade::scan::edge::step`.
    fn claims(&self, name: &str) -> bool {
        // Up to generic arguments or a trait, which may well name another stage's types.
        let path = name.trim_start_matches(['<', '&', '[', '(']).split(['<', '>', ' ']).next().unwrap_or_default();
        let within = |module: &str| path.strip_prefix(module).is_some_and(|rest| rest.is_empty() || rest.starts_with("::"));
        // The last part of the path that is a name, without generic arguments, whose paths have parts of their own.
        let bare = name.split("::<").next().unwrap_or_default();
        let function = bare.rsplit("::").find(|part| !part.starts_with(['{', '<'])).unwrap_or_default();
        self.modules.iter().any(|module| within(module)) || within("beamshade") && self.functions.contains(&function)
    }
}

/// Far more than any count takes.
const LIMIT: Duration = Duration::from_secs(3600);

/// Instructions and cycles; the latter are 0 where the core has no model.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(crate) struct Count {
    pub(crate) instructions: u64,
    pub(crate) cycles: u64,
}

impl Sum for Count {
    fn sum<I: Iterator<Item = Count>>(counts: I) -> Count {
        counts.fold(Count::default(), |a, b| Count { instructions: a.instructions + b.instructions, cycles: a.cycles + b.cycles })
    }
}

/// What one run of the measuring firmware came to.
#[derive(Debug, Default)]
pub(crate) struct Counts {
    /// Each frame, its lines included.
    pub(crate) frames: Vec<Count>,
    /// Each line of all frames.
    pub(crate) lines: Vec<Count>,
    /// Each set-up of a facet, start of a span and shading of a span, by kind, in order; where these are marked, and not frames.
    pub(crate) parts: Vec<(String, Count)>,
    /// The sum of all frames, by stage.
    pub(crate) stages: Vec<(&'static str, Count)>,
    /// The sum of all frames, by the address of the instruction.
    pub(crate) sites: Vec<(u64, Count)>,
}

impl Counts {
    /// Reads the plugin's result.
    fn parse(text: &str) -> Result<Counts> {
        let mut counts = Counts::default();
        for line in text.lines() {
            let words: Vec<_> = line.split(' ').collect();
            let [kind, place @ .., instructions, cycles] = &words[..] else { bail!("not a count: {line}") };
            let count = Count { instructions: instructions.parse()?, cycles: cycles.parse()? };
            match (*kind, place) {
                ("frame", []) => counts.frames.push(count),
                ("line", [_frame]) => counts.lines.push(count),
                ("part", [kind]) => counts.parts.push(((*kind).to_owned(), count)),
                ("stage", [stage]) => {
                    let name = STAGES.get(stage.parse::<usize>()?).map_or("other", |stage| stage.name);
                    if count != Count::default() {
                        counts.stages.push((name, count));
                    }
                }
                ("pc", [address]) => counts.sites.push((u64::from_str_radix(address, 16)?, count)),
                _ => bail!("not a count: {line}"),
            }
        }
        ensure!(!counts.frames.is_empty() || !counts.parts.is_empty(), "the firmware marked no frame");
        Ok(counts)
    }

    /// The mean of the frames, rounded.
    pub(crate) fn mean(&self) -> Count {
        let (sum, frames) = (self.frames.iter().copied().sum::<Count>(), self.frames.len() as u64);
        let mean = |sum: u64| (sum + frames / 2) / frames;
        Count { instructions: mean(sum.instructions), cycles: mean(sum.cycles) }
    }

    /// The sum of all frames, by function, the dearest first.
    pub(crate) fn functions(&self, elf: &Elf) -> Vec<(String, Count)> {
        let mut functions = BTreeMap::<&str, Vec<Count>>::new();
        for &(address, count) in &self.sites {
            functions.entry(elf.function(address).map_or("?", |function| &function.name)).or_default().push(count);
        }
        let mut sums: Vec<_> = functions.into_iter().map(|(name, counts)| (name.to_owned(), counts.into_iter().sum())).collect();
        sums.sort_by_key(|(_, count): &(_, Count)| std::cmp::Reverse((count.cycles, count.instructions)));
        sums
    }
}

/// Runs the measuring firmware on its board; gives what it said, and the counts.
///
/// # Errors
/// If it fails, or the plugin does.
pub(crate) fn run(target: &Target, elf: &Elf) -> Result<(String, Counts)> {
    let plugin = plugin()?;
    let folder = project::target()?.join("counts");
    std::fs::create_dir_all(&folder)?;
    let (out, stages) = (folder.join(target.triple).with_extension("txt"), folder.join(target.triple).with_extension("stages"));
    let ranges = elf.ranges(stage)?.iter().map(|(start, end, stage)| format!("{start:x} {end:x} {stage}\n")).collect::<String>();
    std::fs::write(&stages, ranges)?;

    progress(format!("counting in QEMU: {}", target.triple));
    let mut option = format!("{},out={},stages={}", qemu::escaped(&plugin), qemu::escaped(&out), qemu::escaped(&stages));
    if let Some(model) = target.model {
        option += &format!(",model={model}");
    }
    let said = Emulator::start(target.machine, elf, &["-plugin".into(), option], &[], LIMIT)?.finish()?;
    let text = std::fs::read_to_string(&out).with_context(|| format!("the counter left no {}", out.display()))?;
    Ok((said, Counts::parse(&text)?))
}

/// The stage of an address, from the functions there.
fn stage(functions: &[String]) -> Option<usize> {
    STAGES.iter().position(|stage| functions.iter().any(|name| stage.claims(name)))
}

/// Builds the plugin, for the QEMU that is installed.
fn plugin() -> Result<PathBuf> {
    let features = match qemu::version()? {
        (..9, _) => "",
        (9, 0) => bail!("QEMU 9.0 has a plugin interface of its own; any other from 7.2 on will do"),
        _ => "api3",
    };
    let mut command = project::cargo();
    command.args(["build", "--quiet", "--release", "--features", features]);
    command.arg("--manifest-path").arg(project::root().join("xtask/counter/Cargo.toml"));
    command.arg("--target-dir").arg(project::target()?.join("counter"));
    let files = process::build(&mut command)?;
    files
        .into_iter()
        .find(|file| file.extension().is_some_and(|kind| kind == "so" || kind == "dylib"))
        .context("no plugin was built")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn name_of(functions: &[&str]) -> Option<&'static str> {
        stage(&functions.iter().map(|name| name.to_string()).collect::<Vec<_>>()).map(|stage| STAGES[stage].name)
    }

    #[test]
    fn a_function_belongs_to_its_module_and_not_to_its_arguments() {
        assert_eq!(name_of(&["<beamshade::scanner::Scanner<96, beamshade::shade::duff::Duff>>::line"]), Some("scan"));
        assert_eq!(name_of(&["beamshade::scanner::Scanner<_>::line"]), Some("scan"));
        assert_eq!(name_of(&["<beamshade::shade::duff::Duff as beamshade::shade::Shade>::run"]), Some("shade"));
        assert_eq!(name_of(&["beamshade::sink::row::fill::<beamshade::shade::Pixel>"]), Some("background"));
        assert_eq!(name_of(&["beamshade::framebuffer::clear"]), None);
    }

    #[test]
    fn what_is_inlined_belongs_to_where_it_is() {
        let facet = "<beamshade::shade::duff::Duff as beamshade::shade::Shade>::facet";
        let line = "<beamshade::scanner::Scanner<96>>::line";
        assert_eq!(name_of(&["beamshade::math::reciprocal::of", facet, line]), Some("set-up"));
        assert_eq!(name_of(&["<core::iter::Map<_, _> as core::iter::Iterator>::next", line]), Some("scan"));
        assert_eq!(name_of(&["beamshade::frame::Frame<_>::add::{closure#0}"]), Some("prepare"));
        assert_eq!(name_of(&["compiler_builtins::mem::memset"]), None);
    }

    #[test]
    fn the_plugins_result_is_read() -> Result<()> {
        let counts = Counts::parse("frame 10 20\nframe 13 25\nline 0 4 8\nline 1 5 9\nstage 4 23 45\npc 1f0 23 45\n")?;
        assert_eq!(counts.mean(), Count { instructions: 12, cycles: 23 });
        assert_eq!(counts.lines.len(), 2);
        assert_eq!(counts.stages, [("scan", Count { instructions: 23, cycles: 45 })]);
        assert_eq!(counts.sites, [(0x1f0, Count { instructions: 23, cycles: 45 })]);
        assert!(Counts::parse("frame 1\n").is_err());
        assert!(Counts::parse("").is_err());
        Ok(())
    }
}
