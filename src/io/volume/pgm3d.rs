use super::fill::{Filler, Volume, count};
use crate::io::error::{Defect, Fault, quote};
use crate::io::token::{Syntax, Tokens, integer, number};

/// Reads PGM in three dimensions.
///
/// The header is `P3D` (DGtal) or `P5`, the sizes along x, y, z, the largest value, and one blank.
/// It is followed by one byte per voxel, x fastest, or two bytes, big-endian, if the largest value
/// exceeds 255. With `P2` the values are text. `#` begins a comment in the header. Blanks can
/// follow the last value.
pub(super) fn read(bytes: &[u8], threshold: f64) -> Result<Volume, Fault> {
    let mut tokens = Tokens::new(bytes, Syntax::Comments);
    let text = match tokens.next() {
        Some(b"P3D" | b"P3d" | b"P5") => false,
        Some(b"P2") => true,
        Some(other) => {
            let wanted = "`P3D`, `P5` or `P2`";
            return Err(tokens.fault(Defect::Unexpected { found: quote(other), wanted }));
        }
        None => return Err(Fault::whole(Defect::Empty)),
    };
    let mut header = [0_usize; 4];
    for (done, (slot, wanted)) in header.iter_mut().zip(HEADER).enumerate() {
        let Some(token) = tokens.next() else {
            let (what, done) = ("header numbers", done as u64);
            return Err(tokens.fault(Defect::UnexpectedEnd { wanted, what, done, expected: 4 }));
        };
        let value = integer(token).ok_or_else(|| Defect::NotANumber { token: quote(token), wanted });
        let value = value.map_err(|defect| tokens.fault(defect))?;
        let wrong = || tokens.fault(Defect::NotACount { value: value as f64, wanted });
        *slot = usize::try_from(value).ok().filter(|&n| n > 0).ok_or_else(wrong)?;
    }
    let [x, y, z, largest] = header;
    let values = count([x, y, z]).map_err(|defect| tokens.fault(defect))?;
    let mut filler = Filler::new([x, y, z], threshold);
    if text {
        as_text(&mut tokens, values, &mut filler)?;
    } else {
        if largest > 65_535 {
            let wanted = "a largest value up to 65535";
            return Err(tokens.fault(Defect::Unexpected { found: largest.to_string(), wanted }));
        }
        binary(bytes, tokens.position() + 1, values, largest > 255, &mut filler)?;
    }
    Ok(filler.finish([0.0; 3]))
}

const HEADER: [&str; 4] =
    ["number of voxels along x", "number of voxels along y", "number of voxels along z", "largest value"];

fn binary(bytes: &[u8], start: usize, values: u64, wide: bool, filler: &mut Filler) -> Result<(), Fault> {
    let data = bytes.get(start..).unwrap_or_default();
    let (left, bytes_each) = (data.len() as u64, if wide { 2 } else { 1 });
    if left < values * bytes_each {
        let what = "voxels".to_string();
        return Err(Fault::binary(start, Defect::Truncated { what, count: values, bytes_each, left }));
    }
    let (data, rest) = data.split_at((values * bytes_each) as usize);
    if !rest.iter().all(u8::is_ascii_whitespace) {
        return Err(Fault::binary(start + data.len(), Defect::TrailingBytes { bytes: rest.len() as u64 }));
    }
    if wide {
        data.as_chunks().0.iter().for_each(|&b| filler.push(f64::from(u16::from_be_bytes(b))));
    } else {
        data.iter().for_each(|&b| filler.push(f64::from(b)));
    }
    Ok(())
}

fn as_text(tokens: &mut Tokens, values: u64, filler: &mut Filler) -> Result<(), Fault> {
    let wanted = "the value of a voxel";
    for done in 0..values {
        let Some(token) = tokens.next() else {
            return Err(tokens.fault(Defect::UnexpectedEnd { wanted, what: "voxels", done, expected: values }));
        };
        let value = number(token, wanted).and_then(|value| {
            if value.is_nan() { Err(Defect::NotANumber { token: quote(token), wanted }) } else { Ok(value) }
        });
        filler.push(value.map_err(|defect| tokens.fault(defect))?);
    }
    match tokens.next() {
        None => Ok(()),
        Some(token) => Err(tokens.fault(Defect::Trailing { token: quote(token) })),
    }
}
