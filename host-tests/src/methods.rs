//! The list of all shading methods.

/// Calls a macro with the name and the type of every shading method, the most exact first.
#[macro_export]
macro_rules! every_method {
    ($with:ident) => {
        $with! {
            "phong" beamshade::Phong,
            "phong-planes" beamshade::PhongPlanes,
            "duff-direct" beamshade::DuffDirect,
            "duff-differences" beamshade::DuffDifferences,
            "duff-barycentric" beamshade::DuffBarycentric,
            "hybrid" beamshade::Hybrid,
            "hybrid-8" beamshade::Hybrid<8>,
            "quadratic-dots" beamshade::QuadraticDots,
            "bishop-weimer" beamshade::BishopWeimer,
            "angular-trapezia" beamshade::AngularTrapezia,
            "angular-triangle" beamshade::AngularTriangle,
            "quadratic-intensity" beamshade::QuadraticIntensity,
            "gouraud-phong" beamshade::GouraudPhong,
            "linear-angle" beamshade::LinearAngle,
            "linear-angle-byte" beamshade::LinearAngle<beamshade::shade::linear_angle::Byte>,
            "gouraud" beamshade::Gouraud,
            "flat" beamshade::Flat,
        }
    };
}
