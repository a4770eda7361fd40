//! A QEMU TCG plugin that counts what the measuring firmware executes between its marks.
//!
//! Arguments (`-plugin libbeamshade_counter.so,out=FILE,stages=FILE,model=m0plus`):
//! - `out`: where the counts go when QEMU ends (below).
//! - `stages`: lines `START END STAGE`: hexadecimal addresses, half open, and a stage number below [`STAGES`].
//!   An address outside all of them belongs to the stage that ran before it, so that a library call such as `memset`
//!   or `__aeabi_lmul` counts for whoever calls it.
//! - `model=m0plus`, `model=m4`: count cycles of a Cortex-M0+ or Cortex-M4 too (see [`m0plus`], [`m4`]); without it cycles are 0.
//!
//! The firmware's marks are instructions without an effect; they are not counted themselves:
//!
//! | mark | Thumb | RISC-V | from here on |
//! |---|---|---|---|
//! | frame | `mov r9, r9` | `slti x0, x0, 1` | counting, for a new frame |
//! | line | `mov r10, r10` | `slti x0, x0, 2` | counting, for a new line of that frame |
//! | pause | `mov r11, r11` | `slti x0, x0, 3` | not counting |
//! | facet | `mov r12, r12` | `slti x0, x0, 4` | counting, for the set-up of a facet |
//! | start | `mov lr, lr` | `slti x0, x0, 5` | counting, for the start of a span |
//! | run | `mov sp, sp` | `slti x0, x0, 6` | counting, for the shading of a span |
//!
//! (`mov r8, r8` is left alone: compilers for ARMv6-M pad with it.)
//!
//! The result is text, one record a line; numbers are decimal, addresses hexadecimal; a frame includes its lines:
//!
//! ```text
//! frame INSTRUCTIONS CYCLES               in order
//! line FRAME INSTRUCTIONS CYCLES          in order
//! part KIND INSTRUCTIONS CYCLES           in order; KIND is facet, start or run
//! stage STAGE INSTRUCTIONS CYCLES         the sum of all frames; the last stage is what ran before any was known
//! pc ADDRESS INSTRUCTIONS CYCLES          the sum of all frames, by rising address
//! ```

mod m0plus;
mod m4;
mod qemu;

use std::collections::BTreeMap;
use std::fmt::Write;
use std::sync::Mutex;

/// One more than the largest stage number; the last one is for what runs before any stage is known.
const STAGES: usize = 16;

/// What is counted. One core runs, so nobody ever waits for it.
static COUNTER: Mutex<Counter> = Mutex::new(Counter::new());

/// Instructions, and cycles where there is a model.
#[derive(Clone, Copy)]
struct Count {
    instructions: u64,
    cycles: u64,
}

impl Count {
    const ZERO: Count = Count { instructions: 0, cycles: 0 };

    fn add(&mut self, other: Count) {
        self.instructions += other.instructions;
        self.cycles += other.cycles;
    }
}

/// What an instruction takes.
#[derive(Clone, Copy, Default)]
struct Cost {
    cycles: u64,
    /// More, where it is a conditional branch that is taken.
    taken: u64,
}

/// A core's cycles, given an instruction's two half words.
type Model = fn(u16, u16) -> Cost;

#[derive(Clone, Copy, PartialEq)]
enum Mark {
    Frame,
    Line,
    Pause,
    /// A part of the shading method, by name.
    Part(&'static str),
}

/// One instruction of the program.
struct Site {
    address: u64,
    size: u64,
    cost: Cost,
    mark: Option<Mark>,
    stage: Option<usize>,
    count: Count,
}

struct Counter {
    out: String,
    model: Option<Model>,
    riscv: bool,
    /// Start, end and stage, sorted.
    ranges: Vec<(u64, u64, usize)>,

    sites: Vec<Site>,
    /// From the address to the place in `sites`: code is translated more than once.
    known: BTreeMap<u64, usize>,

    counting: bool,
    in_line: bool,
    in_part: bool,
    stage: usize,
    /// The instruction before: whether it branched shows only at the next one.
    last: Option<usize>,

    frames: Vec<Count>,
    /// With the number of the frame.
    lines: Vec<(usize, Count)>,
    parts: Vec<(&'static str, Count)>,
    stages: [Count; STAGES],
}

impl Counter {
    const fn new() -> Self {
        Counter {
            out: String::new(),
            model: None,
            riscv: false,
            ranges: Vec::new(),
            sites: Vec::new(),
            known: BTreeMap::new(),
            counting: false,
            in_line: false,
            in_part: false,
            stage: STAGES - 1,
            last: None,
            frames: Vec::new(),
            lines: Vec::new(),
            parts: Vec::new(),
            stages: [Count::ZERO; STAGES],
        }
    }

    /// Takes the plugin's arguments in.
    ///
    /// # Errors
    /// What is wrong with them, for people.
    fn configure(&mut self, target: &str, arguments: &[String]) -> Result<(), String> {
        self.riscv = target.starts_with("riscv");
        for argument in arguments {
            match argument.split_once('=') {
                Some(("out", path)) => self.out = path.to_owned(),
                Some(("stages", path)) => {
                    let text = std::fs::read_to_string(path).map_err(|error| format!("{path}: {error}"))?;
                    self.ranges = text.lines().map(range).collect::<Option<_>>().ok_or(format!("{path}: not ranges"))?;
                    self.ranges.sort_unstable();
                }
                Some(("model", "m0plus")) => self.model = Some(|first, _| m0plus::cost(first)),
                Some(("model", "m4")) => self.model = Some(m4::cost),
                _ => return Err(format!("unknown argument {argument}")),
            }
        }
        if self.out.is_empty() {
            return Err("out=FILE is missing".into());
        }
        Ok(())
    }

    /// The number of the site of an instruction that is being translated.
    fn site(&mut self, address: u64, size: usize, code: [u8; 4]) -> usize {
        if let Some(&site) = self.known.get(&address) {
            return site;
        }
        let [half, second] = [[code[0], code[1]], [code[2], code[3]]].map(u16::from_le_bytes);
        let mark = match (self.riscv, half, u32::from_le_bytes(code)) {
            (false, 0x46c9, _) | (true, _, 0x0010_2013) => Some(Mark::Frame),
            (false, 0x46d2, _) | (true, _, 0x0020_2013) => Some(Mark::Line),
            (false, 0x46db, _) | (true, _, 0x0030_2013) => Some(Mark::Pause),
            (false, 0x46e4, _) | (true, _, 0x0040_2013) => Some(Mark::Part("facet")),
            (false, 0x46f6, _) | (true, _, 0x0050_2013) => Some(Mark::Part("start")),
            (false, 0x46ed, _) | (true, _, 0x0060_2013) => Some(Mark::Part("run")),
            _ => None,
        };
        let cost = self.model.map_or(Cost::default(), |model| model(half, second));
        let after = self.ranges.partition_point(|&(start, ..)| start <= address);
        let range = after.checked_sub(1).map(|at| self.ranges[at]).filter(|&(_, end, _)| address < end);
        let stage = range.map(|(.., stage)| stage);
        self.sites.push(Site { address, size: size as u64, cost, mark, stage, count: Count::ZERO });
        self.known.insert(address, self.sites.len() - 1);
        self.sites.len() - 1
    }

    /// An instruction is about to run.
    fn execute(&mut self, index: usize) {
        let Site { address, cost, mark, stage, .. } = self.sites[index];
        if let Some(last) = self.last.replace(index) {
            let before = &self.sites[last];
            // A branch to the very next instruction looks like one not taken; compilers make none.
            if before.cost.taken != 0 && address != before.address + before.size {
                self.add(last, Count { instructions: 0, cycles: before.cost.taken });
            }
        }
        match mark {
            None => {
                self.stage = stage.unwrap_or(self.stage);
                self.add(index, Count { instructions: 1, cycles: cost.cycles });
            }
            Some(Mark::Frame) => self.frames.push(Count::ZERO),
            Some(Mark::Line) => self.lines.push((self.frames.len().saturating_sub(1), Count::ZERO)),
            Some(Mark::Part(kind)) => self.parts.push((kind, Count::ZERO)),
            Some(Mark::Pause) => {}
        }
        if let Some(mark) = mark {
            self.counting = mark != Mark::Pause;
            self.in_line = mark == Mark::Line;
            self.in_part = matches!(mark, Mark::Part(_));
        }
    }

    /// Adds to all that is being counted.
    fn add(&mut self, site: usize, count: Count) {
        if !self.counting {
            return;
        }
        self.sites[site].count.add(count);
        self.stages[self.stage].add(count);
        if let Some(frame) = self.frames.last_mut() {
            frame.add(count);
        }
        if let Some((_, line)) = self.lines.last_mut().filter(|_| self.in_line) {
            line.add(count);
        }
        if let Some((_, part)) = self.parts.last_mut().filter(|_| self.in_part) {
            part.add(count);
        }
    }

    /// The result, as the head of this file describes it.
    fn report(&self) -> Result<String, std::fmt::Error> {
        let mut text = String::new();
        for Count { instructions, cycles } in &self.frames {
            writeln!(text, "frame {instructions} {cycles}")?;
        }
        for (frame, Count { instructions, cycles }) in &self.lines {
            writeln!(text, "line {frame} {instructions} {cycles}")?;
        }
        for (kind, Count { instructions, cycles }) in &self.parts {
            writeln!(text, "part {kind} {instructions} {cycles}")?;
        }
        for (stage, Count { instructions, cycles }) in self.stages.iter().enumerate() {
            writeln!(text, "stage {stage} {instructions} {cycles}")?;
        }
        for Site { address, count: Count { instructions, cycles }, .. } in self.known.values().map(|&site| &self.sites[site]) {
            if *instructions > 0 {
                writeln!(text, "pc {address:x} {instructions} {cycles}")?;
            }
        }
        Ok(text)
    }
}

/// One line of the file of stages.
fn range(line: &str) -> Option<(u64, u64, usize)> {
    let mut words = line.split_whitespace();
    let mut address = || u64::from_str_radix(words.next()?, 16).ok();
    let (start, end) = (address()?, address()?);
    let stage = words.next()?.parse().ok()?;
    (stage < STAGES).then_some((start, end, stage))
}
