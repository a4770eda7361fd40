//! The measured scene on a PC: prints the same records as the firmware, as far as they make sense here.

use beamshade_measure::{Checksum, Scene};

fn main() {
    let mut scene = Scene::new();
    let mut all = Checksum::new();
    for step in 0..Scene::FRAMES {
        let mut sum = Checksum::new();
        assert!(scene.prepare(step), "frame {step} has no room");
        #[cfg(feature = "ways")]
        let fits = scene.draw_all_ways(step, |row| {
            sum.row(row);
            all.row(row);
        });
        #[cfg(feature = "ahead")]
        let fits = scene.draw_ahead(|row| {
            sum.row(row);
            all.row(row);
        });
        #[cfg(any(feature = "ahead", feature = "ways"))]
        assert!(fits, "frame {step} has no room");
        #[cfg(not(any(feature = "ahead", feature = "ways")))]
        let (mut lines, row) = scene.lines();
        #[cfg(not(any(feature = "ahead", feature = "ways")))]
        for y in 0..Scene::LINES {
            let line = Scene::shade(&mut lines, y, row);
            assert_eq!(line.dropped, 0, "frame {step}, line {y}");
            sum.row(row);
            all.row(row);
        }
        println!("frame {step} {:08x}", sum.value());
    }
    println!("checksum {:08x}", all.value());
}
