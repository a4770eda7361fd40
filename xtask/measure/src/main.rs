//! The measuring firmware: renders the scene in an emulator, marks what is to be counted, and tells the rest in words.
//!
//! It prints, one record a line:
//! ```text
//! frame STEP CHECKSUM      of the rows of this frame
//! checksum CHECKSUM        of the rows of all frames
//! ram TYPE BYTES           what lies in RAM, by type
//! mesh BYTES               the part of the flash that is the mesh
//! full STEP                something had no room in this frame
//! stack BYTES              the deepest stack below `main`
//! ```
//! With the feature `parts` the parts of the shading method are marked instead of frames and lines. It links only if no path
//! leads to a panic.
#![no_std]
#![no_main]

mod semihosting;
mod stack;

use beamshade_measure::{mark, Checksum, Scene};
use semihosting::{print, Word::*};

static mut SCENE: Scene = Scene::new();

#[cfg_attr(target_arch = "arm", cortex_m_rt::entry)]
#[cfg_attr(target_arch = "riscv32", riscv_rt::entry)]
fn main() -> ! {
    // SAFETY: `main` runs once, and nothing else names this static: the only reference to it is this one.
    let scene = unsafe { &mut *&raw mut SCENE };
    let stack = stack::Watch::begin();

    let mut all = Checksum::new();
    for step in 0..Scene::FRAMES {
        let mut sum = Checksum::new();
        if !cfg!(feature = "parts") {
            mark::frame();
        }
        let mut fits = scene.prepare(step);
        mark::pause();
        #[cfg(feature = "ways")]
        {
            fits &= scene.draw_all_ways(step, |row| {
                sum.row(row);
                all.row(row);
            });
        }
        #[cfg(feature = "ahead")]
        {
            fits &= scene.draw_ahead(|row| {
                sum.row(row);
                all.row(row);
            });
        }
        #[cfg(not(any(feature = "ahead", feature = "ways")))]
        let (mut lines, row) = scene.lines();
        #[cfg(not(any(feature = "ahead", feature = "ways")))]
        for y in 0..Scene::LINES {
            if !cfg!(feature = "parts") {
                mark::line();
            }
            let line = Scene::shade(&mut lines, y, row);
            mark::pause();
            fits &= line.dropped == 0;
            sum.row(row);
            all.row(row);
        }
        if !fits {
            print(&[Text("full "), Decimal(step.into())]);
        }
        print(&[Text("frame "), Decimal(step.into()), Text(" "), Hexadecimal(sum.value())]);
    }
    print(&[Text("checksum "), Hexadecimal(all.value())]);
    for &(name, bytes) in Scene::RAM {
        print(&[Text("ram "), Text(name), Text(" "), Decimal(bytes)]);
    }
    print(&[Text("mesh "), Decimal(Scene::MESH_BYTES)]);
    print(&[Text("stack "), Decimal(stack.deepest())]);

    #[cfg(feature = "bad")]
    print(&[Decimal([1, 2, 3][core::hint::black_box(stack.deepest())])]);

    semihosting::exit()
}

/// What a panic would call: nothing has this name, so the linker refuses a program in which a panic is possible.
#[panic_handler]
fn panic(_: &core::panic::PanicInfo) -> ! {
    unsafe extern "C" {
        fn a_path_leads_to_a_panic() -> !;
    }
    // SAFETY: never runs: the program does not link if it could.
    unsafe { a_path_leads_to_a_panic() }
}
