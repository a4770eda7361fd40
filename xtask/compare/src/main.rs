//! The firmware: draws the frames in an emulator, marks what is to be counted, and tells the rest in words, as the measuring
//! firmware does.
#![no_std]
#![no_main]

#[path = "../../measure/src/semihosting.rs"]
mod semihosting;
#[path = "../../measure/src/stack.rs"]
mod stack;

mod heap;

use beamshade_compare::{mark, Checksum, Scene, STEPS};
use semihosting::{print, Word::*};

static mut SCENE: Scene = Scene::new();

#[cortex_m_rt::entry]
fn main() -> ! {
    // SAFETY: `main` runs once, and nothing else names this static: the only reference to it is this one.
    let scene = unsafe { &mut *&raw mut SCENE };
    let stack = stack::Watch::begin();

    let mut all = Checksum::new();
    for (frame, &step) in STEPS.iter().enumerate() {
        let mut sum = Checksum::new();
        mark::frame();
        scene.draw(frame);
        mark::pause();
        for pixel in scene.pixels() {
            sum.row(&[pixel]);
            all.row(&[pixel]);
        }
        print(&[Text("frame "), Decimal(step.into()), Text(" "), Hexadecimal(sum.value())]);
    }
    print(&[Text("checksum "), Hexadecimal(all.value())]);
    for &(name, bytes) in Scene::RAM {
        print(&[Text("ram "), Text(name), Text(" "), Decimal(bytes)]);
    }
    print(&[Text("ram heap "), Decimal(heap::most())]);
    print(&[Text("mesh "), Decimal(Scene::MESH_BYTES)]);
    print(&[Text("stack "), Decimal(stack.deepest())]);
    semihosting::exit()
}

#[panic_handler]
fn panic(information: &core::panic::PanicInfo) -> ! {
    if let Some(place) = information.location() {
        print(&[Text("panic in "), Text(place.file()), Text(" line "), Decimal(place.line() as usize)]);
    }
    semihosting::exit()
}
