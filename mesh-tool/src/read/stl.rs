//! STL, binary or ASCII: loose triangles without materials.

use std::io::{Cursor, ErrorKind};
use std::path::Path;

use stl_io::create_stl_reader;

use crate::error::Error;
use crate::soup::{Corner, Face, Soup};
use crate::surface::Surface;

/// Bytes before the first triangle of a binary file: a free text and the number of triangles.
const HEADER: usize = 84;
/// Bytes of a triangle in a binary file.
const TRIANGLE: usize = 50;

/// Reads the triangles of all solids. The normals of the facets are left out: they only repeat the order of the corners.
pub(crate) fn read(path: &Path, bytes: &[u8]) -> Result<Soup, Error> {
    let mut soup = Soup { surfaces: vec![Surface::default()], files: vec![path.into()], ..Soup::default() };
    if is_binary(bytes) {
        binary(path, bytes, &mut soup)?;
    } else {
        ascii(path, &String::from_utf8_lossy(bytes), &mut soup)?;
    }
    Ok(soup)
}

/// A binary file may begin with "solid", too; then its length tells.
fn is_binary(bytes: &[u8]) -> bool {
    let count = bytes.get(HEADER - 4..HEADER).map(|count| u32::from_le_bytes([count[0], count[1], count[2], count[3]]));
    let has_length = |count: u32| bytes.len() as u64 == HEADER as u64 + TRIANGLE as u64 * u64::from(count);
    !bytes.trim_ascii_start().starts_with(b"solid") || count.is_some_and(has_length)
}

fn binary(path: &Path, bytes: &[u8], soup: &mut Soup) -> Result<(), Error> {
    if bytes.len() < HEADER {
        return Err(Error::file(path, format!("{} bytes are neither a binary nor an ASCII STL", bytes.len())));
    }
    // The reader takes whatever begins with "solid" for ASCII.
    let mut bytes = bytes.to_vec();
    bytes[..HEADER - 4].fill(0);
    let mut reader = Cursor::new(bytes);
    for triangle in create_stl_reader(&mut reader).map_err(|error| Error::file(path, error))? {
        let number = soup.faces.len();
        let triangle = triangle.map_err(|error| match error.kind() {
            ErrorKind::UnexpectedEof => Error::element(path, format!("triangle {number}"), "the file ends here"),
            _ => Error::element(path, format!("triangle {number}"), error),
        })?;
        push(soup, triangle).map_err(|reason| Error::element(path, format!("triangle {number}"), reason))?;
    }
    Ok(())
}

/// The reader stops at the end of the first solid, so each gets one of its own.
fn ascii(path: &Path, text: &str, soup: &mut Soup) -> Result<(), Error> {
    let lines: Vec<&str> = text.lines().map(str::trim).collect();
    let mut first = 0;
    while let Some(start) = (first..lines.len()).find(|&line| !lines[line].is_empty()) {
        if !lines[start].starts_with("solid") {
            return Err(Error::line(path, start + 1, "no `solid` begins here"));
        }
        let is_end = |&line: &usize| lines[line].starts_with("endsolid");
        let end = (start..lines.len()).find(is_end).map_or(lines.len(), |end| end + 1);
        solid(path, start, &lines[start..end], soup)?;
        first = end;
    }
    Ok(())
}

fn solid(path: &Path, start: usize, lines: &[&str], soup: &mut Soup) -> Result<(), Error> {
    // The reader wants a space after "solid"; names are of no use.
    let mut reader = Cursor::new(["solid \n", &lines[1..].join("\n")].concat());
    // Where the facets begin, for messages: the reader gives no lines.
    let mut facets = (start..).zip(lines).filter(|(_, line)| line.starts_with("facet")).map(|(line, _)| line + 1);
    let last = start + lines.len();
    for triangle in create_stl_reader(&mut reader).map_err(|error| Error::line(path, start + 1, error))? {
        let line = facets.next().unwrap_or(last);
        let triangle = triangle.map_err(|error| Error::line(path, line, format!("facet {}: {error}", soup.faces.len())))?;
        push(soup, triangle).map_err(|reason| Error::line(path, line, reason))?;
    }
    Ok(())
}

fn push(soup: &mut Soup, triangle: stl_io::Triangle) -> Result<(), &'static str> {
    let first = soup.positions.len();
    for vertex in triangle.vertices {
        if !vertex.0.iter().all(|x| x.is_finite()) {
            return Err("a coordinate is not a finite number");
        }
        soup.positions.push(vertex.0.map(f64::from));
    }
    let corner = |position| Corner { position, normal: None };
    soup.faces.push(Face { corners: (first..first + 3).map(corner).collect(), surface: 0 });
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    const SOLID: &str =
        "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n";

    #[test]
    fn two_solids_without_names() {
        let soup = read(Path::new("a.stl"), [SOLID, "\n", SOLID].concat().as_bytes()).unwrap();
        assert_eq!((soup.faces.len(), soup.positions[4]), (2, [1.0, 0.0, 0.0]));
    }

    #[test]
    fn a_binary_file_may_begin_like_an_ascii_one() {
        let mut bytes = [b"solid ".as_slice(), &[b' '; 74], &1u32.to_le_bytes(), &[0; 50]].concat();
        assert_eq!(read(Path::new("a.stl"), &bytes).unwrap().faces.len(), 1);
        bytes.pop();
        assert!(read(Path::new("a.stl"), &bytes).is_err());
    }
}
