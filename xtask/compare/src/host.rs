//! The same frames on a PC: prints the firmware's records, and writes to the file that is named first, for each frame, its pixels and
//! the triangles that they show (one more than the number, 0 for none), two bytes each, the low one first.

use beamshade_compare::{Checksum, Scene, STEPS};
use embedded_graphics::pixelcolor::IntoStorage;
use std::io::Write;

fn main() -> std::io::Result<()> {
    let path = std::env::args_os().nth(1).expect("a file to write to");
    let mut file = std::io::BufWriter::new(std::fs::File::create(path)?);
    let (mut scene, mut all) = (Box::new(Scene::new()), Checksum::new());
    for (frame, step) in STEPS.iter().enumerate() {
        scene.draw(frame);
        let mut sum = Checksum::new();
        for pixel in scene.pixels() {
            sum.row(&[pixel]);
            all.row(&[pixel]);
            file.write_all(&pixel.into_storage().to_le_bytes())?;
        }
        for owner in Scene::owners(frame) {
            file.write_all(&owner.to_le_bytes())?;
        }
        println!("frame {step} {:08x}", sum.value());
    }
    println!("checksum {:08x}", all.value());
    file.flush()
}
