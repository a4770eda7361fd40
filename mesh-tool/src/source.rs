//! The mesh as Rust source.

use std::fmt::{Display, Write};

use crate::quantized::Quantized;

impl Quantized {
    /// A `pub static` of that name, which ought to be in upper case: const data throughout, checked by the compiler.
    ///
    /// It needs nothing but `beamshade` among the dependencies of the crate that includes it.
    #[must_use]
    pub fn rust_source(&self, name: &str) -> String {
        let Self { extent, center, radius, positions, normals, triangles, edges, parts, surfaces, report, .. } = self;
        let file = self.name.escape_debug();
        let mut source = format!(
            "// Made by beamshade-mesh; what is changed here is lost with the next build.\n\n\
             /// `{file}`: {} vertices, {} triangles; {} bytes.\n\
             #[rustfmt::skip]\n\
             pub static {name}: beamshade::Mesh<'static> = {{\n",
            report.vertices, report.triangles, report.flash
        );
        array(&mut source, "POSITIONS", "[i16; 3]", positions.iter().map(triple));
        array(&mut source, "NORMALS", "[i16; 3]", normals.iter().map(triple));
        array(&mut source, "TRIANGLES", "[u16; 3]", triangles.iter().map(triple));
        array(&mut source, "EDGES", "[u16; 3]", edges.iter().map(triple));
        array(&mut source, "PARTS", "[u16; 2]", parts.iter().map(|[count, material]| format!("[{count}, {material}]")));
        array(&mut source, "MATERIALS", "beamshade::Material", surfaces.iter().map(|surface| surface.rust()));
        let bits = extent.to_bits();
        let center = triple(center);
        let _ = write!(
            source,
            "    match beamshade::Mesh::new(beamshade::MeshData {{\n\
             \x20       extent: beamshade::Length::from_bits({bits}),\n\
             \x20       center: {center},\n\
             \x20       radius: {radius},\n\
             \x20       positions: &POSITIONS,\n\
             \x20       normals: &NORMALS,\n\
             \x20       triangles: &TRIANGLES,\n\
             \x20       edges: &EDGES,\n\
             \x20       parts: &PARTS,\n\
             \x20       materials: &MATERIALS,\n\
             \x20   }}) {{\n\
             \x20       Ok(mesh) => mesh,\n\
             \x20       Err(_) => panic!(\"the mesh is not valid\"),\n\
             \x20   }}\n}};\n"
        );
        source
    }
}

fn triple<T: Display>([a, b, c]: &[T; 3]) -> String {
    format!("[{a}, {b}, {c}]")
}

/// A static array, as many elements to a line as fit.
fn array(source: &mut String, name: &str, element: &str, elements: impl ExactSizeIterator<Item = String>) {
    const WIDTH: usize = 118;
    let _ = write!(source, "    static {name}: [{element}; {}] = [", elements.len());
    let mut column = WIDTH;
    for element in elements {
        if column + element.len() > WIDTH {
            source.push_str("\n       ");
            column = 7;
        }
        let _ = write!(source, " {element},");
        column += element.len() + 2;
    }
    source.push_str("\n    ];\n");
}
