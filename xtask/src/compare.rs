//! Other renderers beside the library: on the standard scene, on the same emulated cores, against the same reference.

use crate::cycles::{self, Measured, Report};
use crate::firmware::{Target, COMPARE, MEASURE, TARGETS};
use crate::gallery::{Canvas, LABEL};
use crate::install::{self, Need};
use crate::project::{self, progress};
use crate::{process, table};
use anyhow::{ensure, Context, Result};
use beamshade::{DuffBarycentric, Gouraud, Hybrid, Light};
use embedded_graphics::pixelcolor::{raw::RawU16, Rgb565, Rgb888};
use embedded_graphics::prelude::*;
use host_tests::accuracy::{Draw, Row, Truth};
use host_tests::library::{self, Meshes};
use host_tests::reference::{render, Mesh, Options};
use host_tests::scenes::{self, FRAMES, ORANGE};
use host_tests::{accuracy, image, Format, Measures, Owner, Picture};
use serde_json::json;

/// Run the peers that crates.io offers on the standard scene, on the same emulated cores, and the library beside them.
///
/// Every fifth of the 60 frames of T880 at 240×240 is drawn in Rgb565. Instructions and cycles (Cortex-M0+, zero wait states) are the
/// mean of these; RAM is all state with picture and depth buffers, the mesh being in flash; the heap counts with the most bytes that
/// were in use at once. PSNR is that of the worst frame against the f64 reference, over the pixels that show the same triangle.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// Print one JSON object a line.
    #[arg(long)]
    json: bool,
    /// Only these peers and methods: those with this in their name.
    #[arg(long, value_name = "TEXT", conflicts_with = "picture")]
    only: Option<String>,
    /// Draw docs/peers.png too, all pictures side by side.
    #[arg(long)]
    picture: bool,
}

/// A renderer and how it shades.
struct Entry {
    peer: &'static str,
    method: &'static str,
    /// The feature of its firmware.
    feature: &'static str,
    /// Draws a frame, if it is the library.
    library: Option<Draw<Rgb565>>,
}

const fn ours(method: &'static str, draw: Draw<Rgb565>) -> Entry {
    Entry { peer: "beamshade", method, feature: method, library: Some(draw) }
}

const fn theirs(peer: &'static str, method: &'static str, feature: &'static str) -> Entry {
    Entry { peer, method, feature, library: None }
}

const RETROFIRE: &str = "retrofire-core 0.4.0";
const EMBEDDED_3DGFX: &str = "embedded-3dgfx 0.7.2";

const ENTRIES: [Entry; 7] = [
    ours("duff-barycentric", library::draw::<Rgb565, DuffBarycentric, 1, Light>),
    ours("hybrid", library::draw::<Rgb565, Hybrid, 1, Light>),
    ours("gouraud", library::draw::<Rgb565, Gouraud, 1, Light>),
    theirs(RETROFIRE, "phong", "retrofire-phong"),
    theirs(RETROFIRE, "gouraud", "retrofire-gouraud"),
    theirs(EMBEDDED_3DGFX, "gouraud", "embedded-3dgfx-gouraud"),
    theirs(EMBEDDED_3DGFX, "blinn-phong", "embedded-3dgfx-blinn-phong"),
];

/// Every so many frames one is drawn, as in xtask/compare.
const STEP: usize = 5;
const SIDE: usize = 240;

fn steps() -> impl Iterator<Item = u32> {
    (0..FRAMES).step_by(STEP)
}

/// What became of one of them.
struct Outcome {
    entry: &'static Entry,
    /// On each core.
    measured: Vec<Measured>,
    /// The frames.
    pictures: Vec<Picture<Rgb565>>,
    /// The worst frame, measure by measure.
    worst: Measures,
}

impl Outcome {
    /// The cores that are compared: Cortex-M0+ and Cortex-M4F.
    const TARGETS: &'static [Target] = TARGETS.split_at(2).0;

    fn new(entry: &'static Entry, mesh: &Mesh) -> Result<Self> {
        progress(format!("{}, {}", entry.peer, entry.method));
        let (package, scene) = if entry.library.is_some() { (MEASURE, Some("t880")) } else { (COMPARE, None) };
        let features: Vec<_> = ["firmware"].into_iter().chain(scene).chain([entry.feature]).collect();
        let mut measured =
            Self::TARGETS.iter().map(|target| Measured::of(package, target, &features)).collect::<Result<Vec<_>>>()?;
        let pictures = match entry.library {
            Some(draw) => {
                // Of all frames keep those that the others draw.
                measured.iter_mut().for_each(|one| {
                    let frames = std::mem::take(&mut one.counts.frames);
                    one.counts.frames = frames.into_iter().step_by(STEP).collect();
                });
                let meshes = Meshes::of(&scenes::standard(mesh, ORANGE, 0))?;
                steps().map(|frame| draw(&scenes::standard(mesh, ORANGE, frame), &meshes)).collect::<Result<Vec<_>>>()?
            }
            None => frames_of_peer(entry, &measured)?,
        };
        ensure!(pictures.len() == steps().count() && measured.iter().all(|one| one.counts.frames.len() == pictures.len()));
        let rows = steps().zip(&pictures).map(|(frame, drawn)| row(mesh, frame, drawn)).collect::<Vec<_>>();
        let worst = accuracy::worst(&rows.iter().collect::<Vec<_>>()).context("no frame")?;
        Ok(Self { entry, measured, pictures, worst })
    }
}

/// Compares a frame.
fn row(mesh: &Mesh, frame: u32, drawn: &Picture<Rgb565>) -> Row {
    let scene = scenes::standard(mesh, ORANGE, frame);
    let reference = render(&scene, Options::default());
    let measures = Measures::between(&reference.round::<Rgb888>(), drawn, &scene.triangles());
    Row { output: "rgb565", truth: Truth::Ideal, frame, measures, rounding_db: None }
}

/// The frames of a peer, drawn by this machine: the firmware's, as their checksum tells.
fn frames_of_peer(entry: &Entry, measured: &[Measured]) -> Result<Vec<Picture<Rgb565>>> {
    let path = project::target()?.join("counts").join(entry.feature).with_extension("frames");
    let said = process::output(cycles::host_program(COMPARE, &["host", entry.feature])?.arg(&path))?;
    let checksum = Report::parse(&said)?.checksum;
    for one in measured {
        ensure!(one.report.checksum == checksum, "{} draws other pixels on {}", entry.feature, one.target.triple);
    }
    let bytes = std::fs::read(&path).with_context(|| path.display().to_string())?;
    let (words, _) = bytes.as_chunks();
    let words: Vec<_> = words.iter().map(|&word| u16::from_le_bytes(word)).collect();
    let frame = |words: &[u16]| {
        let (color, owner) = words.split_at(SIDE * SIDE);
        let shown = |&number: &u16| number.checked_sub(1).map(|triangle| Owner { object: 0, triangle: triangle.into() });
        Picture {
            width: SIDE,
            height: SIDE,
            color: color.iter().map(|&pixel| RawU16::new(pixel).into()).collect(),
            owner: owner.iter().map(shown).collect(),
        }
    };
    Ok(words.chunks_exact(2 * SIDE * SIDE).map(frame).collect())
}

/// `cargo xtask compare`.
pub(crate) fn run(arguments: &Arguments) -> Result<()> {
    let outcomes = outcomes(arguments.only.as_deref())?;
    if arguments.json {
        outcomes.iter().for_each(print_json);
    } else {
        println!("{}\n", text(&outcomes)?);
    }
    if arguments.picture {
        draw(&outcomes)?;
    }
    Ok(())
}

/// The table for README and docs; docs/peers.png is drawn too.
///
/// # Errors
/// If something cannot be built, run or drawn.
pub(crate) fn summary() -> Result<String> {
    let outcomes = outcomes(None)?;
    draw(&outcomes)?;
    text(&outcomes)
}

fn outcomes(only: Option<&str>) -> Result<Vec<Outcome>> {
    install::ensure(&[Need::FirmwareCompiler, Need::Qemu])?;
    let mesh = scenes::teapot_880()?;
    let wanted = |entry: &&Entry| only.is_none_or(|text| format!("{}, {}", entry.peer, entry.method).contains(text));
    let outcomes = ENTRIES.iter().filter(wanted).map(|entry| Outcome::new(entry, &mesh)).collect::<Result<Vec<_>>>()?;
    ensure!(!outcomes.is_empty(), "there are {}", ENTRIES.map(|entry| format!("{}, {}", entry.peer, entry.method)).join("; "));
    Ok(outcomes)
}

fn print_json(outcome: &Outcome) {
    for one in &outcome.measured {
        let mean = one.counts.mean();
        println!(
            "{}",
            json!({
                "peer": outcome.entry.peer, "method": outcome.entry.method, "target": one.target.triple,
                "instructions": mean.instructions, "cycles": one.cycles(mean.cycles), "ram_bytes": one.report.ram_bytes(),
                "psnr_db": outcome.worst.psnr_db, "stack_bytes": one.report.stack_bytes, "code_bytes": one.code_bytes(),
                "same_owner_share": outcome.worst.same_owner_share, "frames": outcome.pictures.len(),
            })
        );
    }
}

/// The table, with what Rgb565 itself allows below it.
fn text(outcomes: &[Outcome]) -> Result<String> {
    let millions = |number: u64| format!("{:.2}", number as f64 / 1e6);
    let lines = outcomes.iter().map(|Outcome { entry, measured, worst, pictures }| {
        let [m0, m4] = &measured[..] else { unreachable!("both targets were measured") };
        vec![
            format!("{}, {}", entry.peer, entry.method),
            millions(m4.counts.mean().instructions),
            millions(m0.counts.mean().instructions),
            millions(m0.counts.mean().cycles),
            table::number(m0.report.ram_bytes()),
            table::number(m0.report.stack_bytes),
            table::number(m0.code_bytes()),
            format!("{:.1}", worst.psnr_db),
            format!("{:.2}", 100.0 * worst.same_owner_share),
            format!("{:.0}", worst.wrong_owner as f64 / pictures.len() as f64),
        ]
    });
    let head = [
        "renderer, method",
        "M4F instr., M",
        "M0+ instr., M",
        "M0+ cycles, M",
        "RAM",
        "stack",
        "code",
        "PSNR dB",
        "same owner %",
        "wrong owner",
    ];
    let table = table::text(&head, lines.collect());
    let mesh = scenes::teapot_880()?;
    let rounded = |frame| row(&mesh, frame, &render(&scenes::standard(&mesh, ORANGE, frame), Options::default()).round());
    let bound = steps().map(|frame| rounded(frame).measures.psnr_db).fold(f64::INFINITY, f64::min);
    let frames = steps().count();
    Ok(format!("{table}\n\nMean of {frames} of the {FRAMES} frames, every fifth; PSNR of the worst, of which Rgb565 itself allows {bound:.1} dB."))
}

/// Draws docs/peers.png: the first frame of the reference and of each.
fn draw(outcomes: &[Outcome]) -> Result<()> {
    const CUT: usize = 16;
    let tile = Size::new(SIDE as u32, LABEL as u32 + (SIDE - 2 * CUT) as u32);
    let mut canvas = Canvas::new(tile, outcomes.len() as u32 + 1);
    let mesh = scenes::teapot_880()?;
    let truth = render(&scenes::standard(&mesh, ORANGE, 0), Options::default()).round::<Rgb888>();
    canvas.label(0, "f64 reference");
    canvas.show(0, Point::new(0, LABEL), &truth, CUT);
    for (tile, Outcome { entry, pictures, .. }) in (1..).zip(outcomes) {
        let name = entry.peer.split(' ').next().unwrap_or_default();
        canvas.label(tile, &format!("{name} {}", entry.method));
        let wide = pictures[0].map(|pixel| pixel.levels()).map(|[red, green, blue]| Rgb888::new(red, green, blue));
        canvas.show(tile, Point::new(0, LABEL), &wide, CUT);
    }
    let path = project::root().join("docs/peers.png");
    image::write(&path, &canvas.picture)?;
    progress(format!("{} is drawn", project::shown(&path)));
    Ok(())
}
