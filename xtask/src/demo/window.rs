//! The turntable in a window.

use super::turntable::Turntable;
use anyhow::{ensure, Result};
use beamshade::Shade;

/// Without a display SDL would draw where nobody sees it.
pub(super) fn ensure_display() -> Result<()> {
    let is_set = |name| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    let has_display = !cfg!(target_os = "linux") || is_set("DISPLAY") || is_set("WAYLAND_DISPLAY");
    ensure!(has_display, "no display for the window: neither DISPLAY nor WAYLAND_DISPLAY is set");
    Ok(())
}

/// Turns the model in a window until that is closed.
#[cfg(feature = "window")]
pub(super) fn show<S: Shade<1>>(turntable: &mut Turntable<'_, S>, frames: u16) -> Result<()> {
    use super::animation;
    use beamshade::Turn;
    use embedded_graphics::{pixelcolor::Rgb888, prelude::*};
    use embedded_graphics_simulator::{sdl2::Keycode, OutputSettings, SimulatorDisplay, SimulatorEvent, Window};
    use std::time::Instant;

    let size = turntable.lines(Turn(0))?.viewport().size;
    let mut display = SimulatorDisplay::<Rgb888>::new(size);
    let mut row = vec![Rgb888::BLACK; size.width as usize];
    let mut window = Window::new("beamshade", &OutputSettings::default());
    let seconds = f64::from(frames) * f64::from(animation::DELAY) / 100.0;
    let begin = Instant::now();
    loop {
        let turns = begin.elapsed().as_secs_f64() / seconds;
        let angle = Turn((turns.fract() * f64::from(u32::MAX)) as u32);
        let Ok(()) = turntable.lines(angle)?.draw(&mut row, &mut display);
        window.update(&display);
        let ends = |event| matches!(event, SimulatorEvent::Quit | SimulatorEvent::KeyDown { keycode: Keycode::Escape, .. });
        if window.events().any(ends) {
            return Ok(());
        }
    }
}

/// Runs this very command again, built with the window.
#[cfg(not(feature = "window"))]
pub(super) fn show<S: Shade<1>>(_: &mut Turntable<'_, S>, _: u16) -> Result<()> {
    use crate::{process, project};
    use anyhow::Context;

    let cargo = |command| {
        let mut cargo = project::cargo();
        cargo.args([command, "--profile", "tool", "--package", "xtask", "--features", "window"]);
        cargo.arg("--manifest-path").arg(project::root().join("Cargo.toml"));
        cargo
    };
    process::run(&mut cargo("build")).context(
        "the window needs SDL2 with what links against it: libsdl2-dev on Debian and Ubuntu, SDL2-devel on Fedora, \
         sdl2 with pacman or brew",
    )?;
    process::run(cargo("run").args(["--quiet", "--"]).args(std::env::args_os().skip(1)))
}
