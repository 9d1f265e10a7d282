//! Maps of the program of Boundary First Flattening (Sawhney and Crane 2017), `bff-command-line IN.obj OUT.obj`.

use std::path::Path;

use num_complex::Complex64;

/// Reads the map of a disc of `vertices` vertices from the texture coordinates of an OBJ file: the `vt` of every corner `v/vt`.
///
/// # Errors
/// The defect, with its line: a file that cannot be read, numbers that are none or not finite, indices
/// out of range, vertices with two places or none.
pub(super) fn read(path: &Path, vertices: usize) -> Result<Vec<Complex64>, String> {
    let text = std::fs::read_to_string(path).map_err(|error| format!("its map cannot be read: {error}"))?;
    let mut coordinates = Vec::new();
    let mut map = vec![None; vertices];
    for (line, text) in text.lines().enumerate() {
        let defect = |what: &str| format!("line {} of its map has {what}: `{text}`", line + 1);
        let mut words = text.split_ascii_whitespace();
        match words.next() {
            Some("vt") => {
                let mut number = || words.next()?.parse::<f64>().ok().filter(|x| x.is_finite());
                let place = number().zip(number()).ok_or_else(|| defect("no two finite numbers"))?;
                coordinates.push(Complex64::new(place.0, place.1));
            }
            Some("f") => {
                for corner in words {
                    let (v, t) = indices(corner).ok_or_else(|| defect("a corner without v/vt"))?;
                    let place = coordinates.get(t).copied();
                    let (of_vertex, place) =
                        map.get_mut(v).zip(place).ok_or_else(|| defect("an index out of range"))?;
                    if of_vertex.replace(place).is_some_and(|earlier| earlier != place) {
                        return Err(defect("a second place for a vertex"));
                    }
                }
            }
            _ => {}
        }
    }
    let placed =
        |(v, place): (usize, Option<_>)| place.ok_or_else(|| format!("its map has no place for vertex {v} (0-based)"));
    map.into_iter().enumerate().map(placed).collect()
}

/// The 0-based indices of vertex and texture coordinate of a corner `v/vt` or `v/vt/vn`.
fn indices(corner: &str) -> Option<(usize, usize)> {
    let mut parts = corner.split('/').map(|part| part.parse::<usize>().ok()?.checked_sub(1));
    Some((parts.next()??, parts.next()??))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(text: &str) -> Result<Vec<Complex64>, String> {
        let file = tempfile::NamedTempFile::new().expect("a file");
        std::fs::write(file.path(), text).expect("written");
        read(file.path(), 3)
    }

    #[test]
    fn places_are_those_of_the_corners() {
        let map = of("v 0 0 0\nvt 0 1\nvt 2 3\nvt 4 5e-1\nf 1/3 2/1 3/2/1\n").expect("a map");
        assert_eq!(map, [(4.0, 0.5), (0.0, 1.0), (2.0, 3.0)].map(|(x, y)| Complex64::new(x, y)));
    }

    #[test]
    fn defects_are_named_with_their_lines() {
        let three = "vt 0 0\nvt 1 0\nvt 0 1\n";
        for (rest, words) in [
            ("", "no place for vertex 0"),
            ("vt 1 nan\n", "line 4 of its map has no two finite numbers"),
            ("f 1 2 3\n", "without v/vt"),
            ("f 1/1 2/2 4/3\n", "out of range"),
            ("f 1/1 2/2 3/4\n", "out of range"),
            ("f 0/1 2/2 3/3\n", "without v/vt"),
            ("f 1/1 2/2 3/3\nf 1/2 2/2 3/3\n", "line 5 of its map has a second place"),
        ] {
            let error = of(&format!("{three}{rest}")).expect_err("defective");
            assert!(error.contains(words), "{rest}: {error}");
        }
    }
}
