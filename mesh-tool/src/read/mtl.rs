//! Wavefront MTL: the materials of an OBJ file.

use std::path::Path;

use super::{number, numbers};
use crate::error::Error;
use crate::surface::Surface;
use crate::vector::{dot, Vector};

/// Reads the materials.
///
/// `Kd` is the base colour. `Ks` is the highlight: its strongest channel the coefficient, its hue the colour. `Ka` is what
/// ambient light finds, so it scales the ambient coefficient by its share of `Kd`, up to 1. `Ns` is the exponent. What is
/// missing stays as [`Surface::default`] has it; `d`, or `1 − Tr`, is the opacity; textures and the like are left out.
pub(crate) fn read(path: &Path, bytes: &[u8]) -> Result<Vec<Surface>, Error> {
    let mut materials: Vec<Entry> = Vec::new();
    for (line, text) in String::from_utf8_lossy(bytes).trim_start_matches('\u{feff}').lines().enumerate() {
        read_line(&mut materials, text).map_err(|reason| Error::line(path, line + 1, reason))?;
    }
    Ok(materials.into_iter().map(Entry::surface).collect())
}

#[derive(Default)]
struct Entry {
    name: String,
    ambient: Option<Vector>,
    diffuse: Option<Vector>,
    specular: Option<Vector>,
    exponent: Option<f64>,
    opacity: Option<f64>,
}

fn read_line(materials: &mut Vec<Entry>, line: &str) -> Result<(), String> {
    let (keyword, rest) = line.trim().split_once(char::is_whitespace).unwrap_or((line.trim(), ""));
    if keyword == "newmtl" {
        materials.push(Entry { name: rest.trim().into(), ..Entry::default() });
        return Ok(());
    }
    if !["Ka", "Kd", "Ks", "Ns", "d", "Tr"].contains(&keyword) {
        return Ok(());
    }
    let material = materials.last_mut().ok_or_else(|| format!("`{keyword}` before the first `newmtl`"))?;
    match keyword {
        "Ka" => material.ambient = Some(color(rest)?),
        "Kd" => material.diffuse = Some(color(rest)?),
        "Ks" => material.specular = Some(color(rest)?),
        "Ns" => material.exponent = Some(first(rest)?),
        // `d -halo`, opaque in the middle alone, is none.
        "d" if rest.trim_start().starts_with('-') => {}
        "d" => material.opacity = Some(first(rest)?),
        // Some write both, and `Tr` the wrong way round.
        _ => material.opacity = material.opacity.or(Some(1.0 - first(rest)?)),
    }
    Ok(())
}

/// The first number of what follows a keyword.
fn first(rest: &str) -> Result<f64, String> {
    number(rest.split_whitespace().next().unwrap_or_default())
}

/// Three numbers, or one that stands for all three.
fn color(rest: &str) -> Result<Vector, String> {
    let mut words = rest.split_whitespace();
    match (words.next(), words.next()) {
        (Some(grey), None) => Ok([number(grey)?; 3]),
        _ => numbers(&mut rest.split_whitespace()),
    }
}

impl Entry {
    fn surface(self) -> Surface {
        let mut surface = Surface { name: self.name, ..Surface::default() };
        if let Some(diffuse) = self.diffuse {
            surface.base = diffuse;
        }
        if let Some(specular) = self.specular {
            let strongest = specular.iter().copied().fold(0.0, f64::max);
            surface.specular = strongest.min(1.0);
            if strongest > 0.0 {
                surface.highlight = specular.map(|channel| channel.max(0.0) / strongest);
            }
        }
        if let Some(ambient) = self.ambient {
            let base = dot(surface.base, surface.base);
            let share = if base > 0.0 { dot(ambient, surface.base) / base } else { 1.0 };
            surface.ambient *= share.clamp(0.0, 1.0);
        }
        if let Some(exponent) = self.exponent {
            surface.exponent = exponent.round().clamp(1.0, Surface::MAX_EXPONENT) as u16;
        }
        if let Some(opacity) = self.opacity {
            surface.opacity = opacity.clamp(0.0, 1.0);
        }
        surface
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_material_in_full_and_an_empty_one() {
        let text = b"# two\nnewmtl deep red\nKa 0.25 0 0\nKd 0.5 0 0\nKs 0.2 0.4 0.4\nNs 1000\nmap_Kd x.png\n\nnewmtl plain\n";
        let [red, plain] = &read(Path::new("a.mtl"), text).unwrap()[..] else { panic!("two materials") };
        assert_eq!(*plain, Surface { name: "plain".into(), ..Surface::default() });
        let expected = Surface {
            name: "deep red".into(),
            base: [0.5, 0.0, 0.0],
            highlight: [0.5, 1.0, 1.0],
            ambient: 0.075,
            specular: 0.4,
            exponent: 256,
            ..Surface::default()
        };
        assert_eq!(*red, expected);
    }

    #[test]
    fn dissolve_and_its_opposite_are_opacity() {
        let text = b"newmtl a\nd 0.25\nnewmtl b\nTr 0.25\nnewmtl c\nd -halo 0.5\nnewmtl d\nd 7\nTr 0.5\n";
        let opacities: Vec<_> = read(Path::new("a.mtl"), text).unwrap().iter().map(|surface| surface.opacity).collect();
        assert_eq!(opacities, [0.25, 0.75, 1.0, 1.0]);
    }

    #[test]
    fn broken_lines_are_named() {
        for (text, message) in [
            ("Kd 1 1 1", "a.mtl:1: `Kd` before the first `newmtl`"),
            ("newmtl a\nKd 1 1", "a.mtl:2: 2 numbers where 3 are needed"),
            ("newmtl a\n\nNs nan", "a.mtl:3: `nan` is not a finite number"),
        ] {
            assert_eq!(read(Path::new("a.mtl"), text.as_bytes()).unwrap_err().to_string(), message);
        }
    }
}
