//! Wavefront OBJ: polygons with materials.

use std::path::Path;

use super::{bytes, mtl, numbers};
use crate::error::Error;
use crate::soup::{Corner, Face, Soup};
use crate::surface::Surface;
use crate::vector::Vector;

/// Keywords that say nothing about the shape of a polygon mesh.
const IGNORED: &[&str] = &[
    "vt",
    "vp",
    "p",
    "l",
    "o",
    "g",
    "s",
    "mg",
    "bevel",
    "c_interp",
    "d_interp",
    "lod",
    "shadow_obj",
    "trace_obj",
    "maplib",
    "usemap",
];

/// Reads polygons (`v`, `vn`, `f`) and materials (`mtllib`, `usemtl`). Points and lines are left out.
pub(crate) fn read(path: &Path, bytes: &[u8]) -> Result<Soup, Error> {
    let mut obj = Obj { soup: Soup { files: vec![path.into()], ..Soup::default() }, ..Obj::default() };
    let text = String::from_utf8_lossy(bytes);
    for (line, text) in lines(text.trim_start_matches('\u{feff}')) {
        obj.line(path, line, &text).map_err(|reason| Error::line(path, line, reason))?;
    }
    obj.finish(path)
}

/// Lines with their numbers, those that end in a backslash joined to the next, comments cut off.
fn lines(text: &str) -> impl Iterator<Item = (usize, String)> + '_ {
    let mut lines = text.lines().enumerate();
    std::iter::from_fn(move || {
        let (number, first) = lines.next()?;
        let mut joined = first.to_string();
        while joined.ends_with('\\') {
            joined.pop();
            joined += " ";
            joined += lines.next().map_or("", |(_, line)| line);
        }
        joined.truncate(joined.find('#').unwrap_or(joined.len()));
        Some((number + 1, joined))
    })
}

#[derive(Default)]
struct Obj {
    soup: Soup,
    normals: Vec<Vector>,
    /// Number of texture coordinates.
    textures: usize,
    /// The faces with their lines; corners are checked when all vertices are known.
    faces: Vec<(usize, Vec<Reference>, usize)>,
    /// Number of the surface in use; none before the first `usemtl`.
    surface: Option<usize>,
    /// The line where each surface is first named; 0 for the one without a name.
    named: Vec<usize>,
    library: Vec<Surface>,
    has_library: bool,
}

/// A corner as a face names it: numbers from 0, of the position and, perhaps, the normal.
struct Reference {
    position: usize,
    normal: Option<usize>,
}

impl Obj {
    fn line(&mut self, path: &Path, line: usize, text: &str) -> Result<(), String> {
        let (keyword, rest) = text.trim().split_once(char::is_whitespace).unwrap_or((text.trim(), ""));
        let mut words = rest.split_whitespace();
        match keyword {
            "" => {}
            "v" => self.soup.positions.push(numbers(&mut words)?),
            "vn" => self.normals.push(numbers(&mut words)?),
            "f" => {
                let corners = words.map(|word| self.reference(word)).collect::<Result<Vec<_>, _>>()?;
                if corners.len() < 3 {
                    return Err(format!("a face of {} corners", corners.len()));
                }
                let surface = self.surface.unwrap_or_else(|| self.surface_named("", 0));
                self.faces.push((line, corners, surface));
            }
            "usemtl" => self.surface = Some(self.surface_named(rest.trim(), line)),
            "mtllib" => self.load_library(path, rest.trim())?,
            _ if IGNORED.contains(&keyword) => self.textures += usize::from(keyword == "vt"),
            _ => return Err(format!("unknown keyword `{}`", keyword.escape_debug())),
        }
        Ok(())
    }

    /// `position`, `position/texture`, `position//normal` or `position/texture/normal`.
    fn reference(&self, word: &str) -> Result<Reference, String> {
        let mut parts = word.split('/');
        let mut number = |what: &str, count: usize| match parts.next() {
            None | Some("") => Ok(None),
            Some(number) => index(number, count).map(Some).map_err(|reason| format!("{what} of corner `{word}` {reason}")),
        };
        let position =
            number("position", self.soup.positions.len())?.ok_or_else(|| format!("corner `{word}` has no position"))?;
        number("texture", self.textures)?;
        let normal = number("normal", self.normals.len())?;
        match parts.next() {
            None => Ok(Reference { position, normal }),
            Some(_) => Err(format!("corner `{word}` has more than three numbers")),
        }
    }

    fn surface_named(&mut self, name: &str, line: usize) -> usize {
        let surfaces = &mut self.soup.surfaces;
        surfaces.iter().position(|surface| surface.name == name).unwrap_or_else(|| {
            surfaces.push(Surface { name: name.into(), ..Surface::default() });
            self.named.push(line);
            surfaces.len() - 1
        })
    }

    /// Reads one library whose name has spaces, or several.
    fn load_library(&mut self, path: &Path, names: &str) -> Result<(), String> {
        let folder = path.parent().unwrap_or(Path::new(""));
        let names = if folder.join(names).is_file() { vec![names] } else { names.split_whitespace().collect() };
        for name in names {
            let library = folder.join(name);
            let bytes = bytes(&library).map_err(|error| format!("the material library cannot be read: {error}"))?;
            let surfaces = mtl::read(&library, &bytes).map_err(|error| error.to_string())?;
            self.library.extend(surfaces);
            self.soup.files.push(library);
            self.has_library = true;
        }
        Ok(())
    }

    fn finish(self, path: &Path) -> Result<Soup, Error> {
        let Self { mut soup, normals, faces, named, library, has_library, .. } = self;
        for (line, corners, surface) in faces {
            let corner = |Reference { position, normal }: Reference| {
                if position >= soup.positions.len() {
                    return Err(format!("position {} of {}", position + 1, soup.positions.len()));
                }
                let look_up =
                    |normal: usize| normals.get(normal).ok_or_else(|| format!("normal {} of {}", normal + 1, normals.len()));
                Ok(Corner { position, normal: normal.map(look_up).transpose()?.copied() })
            };
            let corners = corners.into_iter().map(corner).collect::<Result<_, _>>();
            let corners = corners.map_err(|what| Error::line(path, line, format!("a corner has {what}")))?;
            soup.faces.push(Face { corners, surface });
        }
        for (surface, line) in soup.surfaces.iter_mut().zip(named) {
            // The last one of a name counts, as if it had been read over the others.
            match library.iter().rfind(|known| known.name == surface.name) {
                Some(known) => surface.clone_from(known),
                None if has_library && line > 0 => {
                    return Err(Error::line(path, line, format!("no material library has `{}`", surface.name.escape_debug())));
                }
                None => {}
            }
        }
        Ok(soup)
    }
}

/// A number from 1, or from −1 backwards from what has been read so far, as a number from 0.
fn index(word: &str, count: usize) -> Result<usize, String> {
    let number: i64 = word.parse().map_err(|_| "is not a whole number")?;
    let index = match number {
        0 => return Err("is 0, but the first is 1".into()),
        1.. => number - 1,
        _ => number.saturating_add(i64::try_from(count).unwrap_or(i64::MAX)),
    };
    usize::try_from(index).map_err(|_| format!("is {number}, but only {count} come before"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn indices_count_from_one_or_backwards() {
        assert_eq!(index("1", 5), Ok(0));
        assert_eq!(index("-1", 5), Ok(4));
        assert_eq!(index("-5", 5), Ok(0));
        for wrong in ["0", "-6", "x", "", "1.5", "-9223372036854775808"] {
            assert!(index(wrong, 5).is_err(), "{wrong}");
        }
    }

    #[test]
    fn continued_lines_keep_their_number() {
        let lines: Vec<_> = lines("a # b\nc \\\nd\r\n\ne\\").collect();
        assert_eq!(lines, [(1, "a ".into()), (2, "c  d".into()), (4, String::new()), (5, "e ".into())]);
    }
}
