use super::fill::{Filler, Volume, count};
use crate::io::error::{Defect, Fault, quote};
use crate::surface::digital::Solid;

/// Reads NumPy's `.npy`: an array of three axes of booleans, integers or floats, in C or Fortran
/// order.
///
/// Element `a[i, j, k]` is the voxel at (i, j, k): the axes are x, y, z, consistent with the
/// vertices of scikit-image's `marching_cubes`. An array indexed as `a[z, y, x]` gives the mirror
/// image; `a.transpose(2, 1, 0)` corrects this.
pub(super) fn read(bytes: &[u8], threshold: f64) -> Result<Volume, Fault> {
    let header = NpyHeader::read(bytes)?;
    let size = header.size;
    let values = count(size).map_err(|defect| Fault::binary(header.at, defect))?;
    let data = &bytes[header.data..];
    let (left, bytes_each) = (data.len() as u64, header.kind.bytes as u64);
    let wanted = values.saturating_mul(bytes_each);
    if left < wanted {
        let what = "values".to_string();
        return Err(Fault::binary(header.data, Defect::Truncated { what, count: values, bytes_each, left }));
    }
    if left > wanted {
        let end = header.data + wanted as usize;
        return Err(Fault::binary(end, Defect::TrailingBytes { bytes: left - wanted }));
    }
    let mut number_of_nan = None;
    let values = data.chunks_exact(header.kind.bytes).enumerate().map(|(n, raw)| {
        let value = header.kind.value(raw);
        if value.is_nan() {
            number_of_nan.get_or_insert(n);
        }
        value
    });
    let volume = if header.fortran { fortran(values, size, threshold) } else { c(values, size, threshold) };
    match number_of_nan {
        None => Ok(volume),
        Some(n) => {
            let (token, wanted) = ("NaN".to_string(), "the value of a voxel");
            let place = header.data + n * header.kind.bytes;
            Err(Fault::binary(place, Defect::NotANumber { token, wanted }))
        }
    }
}

/// Reads values with the first index fastest.
fn fortran(values: impl Iterator<Item = f64>, size: [usize; 3], threshold: f64) -> Volume {
    let mut filler = Filler::new(size, threshold);
    values.for_each(|value| filler.push(value));
    filler.finish([0.0; 3])
}

/// Reads values with the last index fastest. All of them are present, so the box is allocated at
/// once.
fn c(mut values: impl Iterator<Item = f64>, size: [usize; 3], threshold: f64) -> Volume {
    let mut solid = Solid::empty(size, [0.0; 3]);
    let (mut count, mut most) = (0, f64::NEG_INFINITY);
    for i in 0..size[0] as i32 {
        for j in 0..size[1] as i32 {
            for (k, value) in (0..size[2] as i32).zip(&mut values) {
                count += 1;
                most = most.max(value);
                if value > threshold {
                    solid.insert([i, j, k]);
                }
            }
        }
    }
    Volume { solid, values: count, most }
}

/// The storage format of a value.
#[derive(Clone, Copy)]
struct NpyType {
    /// The type: `b`, `u`, `i` or `f`.
    letter: u8,
    bytes: usize,
    big_endian: bool,
}

impl NpyType {
    /// Parses a type such as `<u2`, `|b1`, `>f8`.
    fn read(text: &[u8]) -> Option<Self> {
        let &[order @ (b'<' | b'>' | b'=' | b'|'), letter, digit] = text else { return None };
        let bytes = match (letter, digit) {
            (b'b', b'1') | (b'u' | b'i', b'1' | b'2' | b'4' | b'8') | (b'f', b'4' | b'8') => usize::from(digit - b'0'),
            _ => return None,
        };
        Some(NpyType { letter, bytes, big_endian: order == b'>' })
    }

    #[inline]
    fn value(self, raw: &[u8]) -> f64 {
        let mut word = [0; 8];
        word[..raw.len()].copy_from_slice(raw);
        if self.big_endian {
            word[..raw.len()].reverse();
        }
        let bits = u64::from_le_bytes(word);
        let unused = 64 - 8 * self.bytes as u32;
        match (self.letter, self.bytes) {
            (b'f', 4) => f64::from(f32::from_bits(bits as u32)),
            (b'f', _) => f64::from_bits(bits),
            // Shifting to the top bits and back extends the sign.
            (b'i', _) => ((bits << unused) as i64 >> unused) as f64,
            _ => bits as f64,
        }
    }
}

struct NpyHeader {
    kind: NpyType,
    fortran: bool,
    size: [usize; 3],
    /// Offsets of the dictionary and of the values.
    at: usize,
    data: usize,
}

impl NpyHeader {
    /// Reads `\x93NUMPY`, two bytes of version, the length of the dictionary in 2 bytes (version 1)
    /// or 4, and the dictionary.
    fn read(bytes: &[u8]) -> Result<Self, Fault> {
        if bytes.is_empty() {
            return Err(Fault::whole(Defect::Empty));
        }
        if !bytes.starts_with(b"\x93NUMPY") {
            let found = quote(&bytes[..bytes.len().min(6)]);
            return Err(Fault::binary(0, Defect::Unexpected { found, wanted: "`\\x93NUMPY`" }));
        }
        let too_short = || {
            let (wanted, what) = ("the version and the length of the header", "bytes");
            Fault::binary(bytes.len(), Defect::UnexpectedEnd { wanted, what, done: bytes.len() as u64, expected: 10 })
        };
        let word = |at: usize| bytes.get(at).map(|&b| usize::from(b)).ok_or_else(too_short);
        let (length, at) = match word(6)? {
            1 => (word(8)? | word(9)? << 8, 10),
            2 | 3 => (word(8)? | word(9)? << 8 | word(10)? << 16 | word(11)? << 24, 12),
            version => {
                let wanted = "version 1, 2 or 3";
                return Err(Fault::binary(6, Defect::Unexpected { found: version.to_string(), wanted }));
            }
        };
        let Some(text) = bytes.get(at..).and_then(|rest| rest.get(..length)) else {
            let (count, left) = (length as u64, bytes.len().saturating_sub(at) as u64);
            let what = "characters of the header".to_string();
            return Err(Fault::binary(at, Defect::Truncated { what, count, bytes_each: 1, left }));
        };
        let value =
            |key: &'static str| entry(text, key).ok_or_else(|| Fault::binary(at, Defect::HeaderLacks { what: key }));
        let wrong = |found: &[u8], wanted| Fault::binary(at, Defect::Unexpected { found: quote(found), wanted });

        let stored = value("'descr'")?;
        let name = stored.strip_prefix(b"'").and_then(|rest| rest.split(|&b| b == b'\'').next());
        let Some(kind) = name.and_then(NpyType::read) else {
            let what = "an array of this type";
            let advice = "save booleans, integers or floats of 4 or 8 bytes: numpy.save(file, a.astype(numpy.float32))";
            return Err(Fault::binary(at, Defect::Unsupported { what, advice }));
        };
        let order = value("'fortran_order'")?;
        let fortran = match () {
            () if order.starts_with(b"True") => true,
            () if order.starts_with(b"False") => false,
            () => return Err(wrong(order, "True or False for fortran_order")),
        };
        let shape = value("'shape'")?;
        let inner = shape.strip_prefix(b"(").and_then(|rest| rest.split(|&b| b == b')').next());
        let size = inner.and_then(three).ok_or_else(|| wrong(shape, "a shape of three lengths, 1 or more each"))?;
        Ok(NpyHeader { kind, fortran, size, at, data: at + length })
    }
}

/// Returns the text after `key:` in a dictionary.
fn entry<'a>(text: &'a [u8], key: &str) -> Option<&'a [u8]> {
    let at = text.windows(key.len()).position(|window| window == key.as_bytes())?;
    text[at + key.len()..].trim_ascii_start().strip_prefix(b":").map(<[u8]>::trim_ascii_start)
}

/// Parses `3, 4, 5` with an optional trailing comma.
fn three(text: &[u8]) -> Option<[usize; 3]> {
    let mut parts: Vec<&[u8]> = text.split(|&b| b == b',').map(<[u8]>::trim_ascii).collect();
    if parts.last().is_some_and(|last| last.is_empty()) {
        parts.pop();
    }
    let [x, y, z] = parts[..] else { return None };
    let length = |part: &[u8]| std::str::from_utf8(part).ok()?.parse().ok().filter(|&n| n > 0);
    Some([length(x)?, length(y)?, length(z)?])
}
