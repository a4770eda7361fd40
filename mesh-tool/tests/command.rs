//! The command as a user calls it.

mod folder;

use std::path::Path;
use std::process::{Command, Output};

use folder::Folder;

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

fn run(folder: &Folder, arguments: &[&str]) -> Output {
    let program = env!("CARGO_BIN_EXE_beamshade-mesh");
    Command::new(program).current_dir(folder.path("")).args(arguments).output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.into()).unwrap()
}

#[test]
fn source_and_binary_and_a_report() {
    let folder = Folder::new();
    folder.write("3d thing.obj", TRIANGLE);
    for output in ["a.rs", "a.bin"] {
        let output =
            run(&folder, &["3d thing.obj", "-o", output, "--fit", "--base", "1,0.5,0", "--exponent", "9", "--double-sided"]);
        assert!(output.status.success(), "{}", text(&output.stderr));
        assert!(text(&output.stdout).contains("triangles                1   without area, dropped: 0\n"));
    }
    assert_eq!(folder.names(), ["3d thing.obj", "a.bin", "a.rs"]);
    let source = std::fs::read_to_string(folder.path("a.rs")).unwrap();
    assert!(source.contains("pub static _3D_THING: beamshade::Mesh<'static>"));
    assert!(source.contains("Color([32768, 16384, 0])") && source.contains(".exponent(9).double_sided()"));
    assert!(std::fs::read(folder.path("a.bin")).unwrap().starts_with(b"BSHM"));
}

#[test]
fn without_an_output_there_is_only_the_report() {
    let folder = Folder::new();
    folder.write("a.obj", TRIANGLE);
    let output = run(&folder, &["a.obj"]);
    assert!(output.status.success());
    assert_eq!(folder.names(), ["a.obj"]);
}

#[test]
fn failures_leave_nothing_behind() {
    let folder = Folder::new();
    folder.write("a.obj", TRIANGLE);
    folder.write("broken.obj", "v 0 0 0\nf 1 2 3\n");
    folder.write("old.rs", "what was there");
    std::fs::create_dir(folder.path("folder.rs")).unwrap();
    let before = folder.names();
    for (arguments, message) in [
        (["broken.obj", "-o", "new.rs"], "broken.obj:2: a corner has position 2 of 1\n"),
        (["broken.obj", "-o", "old.rs"], "broken.obj:2: a corner has position 2 of 1\n"),
        (["missing.obj", "-o", "new.rs"], "missing.obj: No such file"),
        (["a.obj", "-o", "new.txt"], "new.txt: a mesh can be written as .rs or .bin\n"),
        (["a.obj", "-o", "nowhere/new.rs"], "nowhere/new.rs: No such file"),
        (["a.obj", "-o", "folder.rs"], "folder.rs: "),
        (["a.obj", "--name=tea pot", "-onew.rs"], "new.rs: `tea pot` is no name of a static"),
    ] {
        let output = run(&folder, &arguments);
        assert_eq!(output.status.code(), Some(1));
        assert!(text(&output.stderr).starts_with(message), "{}", text(&output.stderr));
    }
    assert_eq!(folder.names(), before);
    assert_eq!(std::fs::read_to_string(Path::new(&folder.path("old.rs"))).unwrap(), "what was there");
}

#[test]
fn wrong_arguments_are_refused() {
    let folder = Folder::new();
    folder.write("a.obj", TRIANGLE);
    for argument in ["--base=1,1", "--base=1,2,1", "--specular=nan", "--exponent=0", "--crease=x"] {
        assert_eq!(run(&folder, &["a.obj", argument]).status.code(), Some(2), "{argument}");
    }
}
