//! What the user wants done to a model on the way in.

use crate::surface::Surface;

/// How a model is read; the default leaves it as the file has it.
///
/// ```
/// let options = beamshade_mesh::Options { fit: true, base: Some([0.85, 0.45, 0.20]), ..Default::default() };
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// Positions that are no farther apart than this, in units of the file, become one. 0: only identical ones.
    pub weld: f64,
    /// Where a file has no normals, they are averaged across the edges at which two faces meet at an angle of no more than
    /// this, in degrees. 0: flat faces; 180: no creases at all.
    pub crease: f64,
    /// Moves and scales the model so that its bounding sphere has its centre at the origin and the radius 1.
    pub fit: bool,
    /// Base colour of all materials, red, green and blue from 0 to 1, linear.
    pub base: Option<[f64; 3]>,
    /// Colour of all highlights, likewise.
    pub highlight: Option<[f64; 3]>,
    /// Ambient coefficient of all materials, 0 to 1.
    pub ambient: Option<f64>,
    /// Diffuse coefficient of all materials, 0 to 1.
    pub diffuse: Option<f64>,
    /// Specular coefficient of all materials, 0 to 1.
    pub specular: Option<f64>,
    /// Exponent of all materials.
    pub exponent: Option<u16>,
    /// All materials can be seen from behind.
    pub double_sided: bool,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            weld: 0.0,
            crease: 60.0,
            fit: false,
            base: None,
            highlight: None,
            ambient: None,
            diffuse: None,
            specular: None,
            exponent: None,
            double_sided: false,
        }
    }
}

impl Options {
    /// What the options say about materials, over what the file says.
    pub(crate) fn override_surface(&self, surface: Surface) -> Surface {
        Surface {
            base: self.base.unwrap_or(surface.base),
            highlight: self.highlight.unwrap_or(surface.highlight),
            ambient: self.ambient.unwrap_or(surface.ambient),
            diffuse: self.diffuse.unwrap_or(surface.diffuse),
            specular: self.specular.unwrap_or(surface.specular),
            exponent: self.exponent.unwrap_or(surface.exponent),
            double_sided: self.double_sided || surface.double_sided,
            opacity: surface.opacity,
            name: surface.name,
        }
    }
}
