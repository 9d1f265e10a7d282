/// Red, green and blue of sRGB.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Colour(pub [u8; 3]);

impl std::fmt::Display for Colour {
    /// `#rrggbb`.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Colour([r, g, b]) = self;
        write!(f, "#{r:02x}{g:02x}{b:02x}")
    }
}

/// Every 15th entry of Crameri's `lipari`, from its light end; the darkest two are reserved for
/// values beyond the scale.
///
/// Source: F. Crameri, Scientific colour maps, doi:10.5281/zenodo.1243862, MIT licence.
const LIPARI: [[u8; 3]; 16] = [
    [253, 245, 218],
    [241, 221, 185],
    [232, 198, 156],
    [229, 177, 134],
    [232, 158, 119],
    [234, 138, 105],
    [224, 116, 96],
    [202, 103, 95],
    [176, 99, 100],
    [152, 97, 106],
    [131, 96, 111],
    [113, 95, 116],
    [96, 94, 120],
    [76, 90, 122],
    [47, 78, 115],
    [21, 59, 94],
];

/// Returns the grey of t ∈ [0, 1] (clamped): pale at 0 and medium at 1, so that [`super::MARK`]
/// contrasts with all of it.
pub(super) fn grey(t: f64) -> Colour {
    let level = (246.0 - 96.0 * t.clamp(0.0, 1.0)).round() as u8;
    Colour([level; 3])
}

/// Returns the colour of t ∈ [0, 1] (clamped), from pale at 0 to dark at 1.
///
/// Lightness decreases monotonically, so that the scale is readable in greyscale and with any
/// colour vision. It interpolates linearly between the entries of the table, within 2/255 of the
/// full map.
pub fn error_colour(t: f64) -> Colour {
    let last = LIPARI.len() - 1;
    let s = t.clamp(0.0, 1.0) * last as f64;
    let i = (s as usize).min(last - 1);
    let u = s - i as f64;
    Colour(std::array::from_fn(|c| {
        let (a, b) = (f64::from(LIPARI[i][c]), f64::from(LIPARI[i + 1][c]));
        (a + (b - a) * u).round() as u8
    }))
}
