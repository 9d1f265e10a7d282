use std::io::Read;

use super::fill::{Filler, Volume, count};
use crate::io::error::{Defect, Fault, quote};
use crate::io::token::{Syntax, Tokens, integer};

/// The two formats, which differ in the width of values.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum VolKind {
    /// `.vol`: bytes.
    Vol,
    /// `.longvol`: 8 bytes, little-endian.
    Longvol,
}

impl VolKind {
    fn size_key(self) -> &'static str {
        match self {
            VolKind::Vol => "Voxel-Size",
            VolKind::Longvol => "Lvoxel-Size",
        }
    }

    fn bytes(self) -> usize {
        match self {
            VolKind::Vol => 1,
            VolKind::Longvol => 8,
        }
    }
}

/// Reads DGtal's `.vol` and `.longvol`: lines `Key: value` up to a line `.`, then the values, x
/// fastest.
///
/// With `Version` 2 the values follow directly, with 3 they are compressed by zlib. Without a
/// version they follow the three sizes as binary numbers and a line end. As in DGtal, `Center-X`
/// places the first voxel at `Center-X − (X − 1)/2`, rounded toward zero; the default is 0.
pub(super) fn read(bytes: &[u8], kind: VolKind, threshold: f64) -> Result<Volume, Fault> {
    let header = VolHeader::read(bytes)?;
    let size = [header.size("X")?, header.size("Y")?, header.size("Z")?];
    let values = count(size).map_err(|defect| Fault::text(header.end.saturating_sub(1), defect))?;
    let (at, width) = header.required(kind.size_key())?;
    if width != kind.bytes() as i64 {
        let wanted = if kind == VolKind::Vol { "values of 1 byte" } else { "values of 8 bytes" };
        return Err(Fault::text(at, Defect::Unexpected { found: width.to_string(), wanted }));
    }
    let start = header.end;
    let mut filler = Filler::new(size, threshold);
    match header.find("Version")? {
        None => raw(bytes, first_version(bytes, start, size)?, values, kind, &mut filler)?,
        Some((_, 2)) => raw(bytes, start, values, kind, &mut filler)?,
        Some((_, 3)) => compressed(bytes, start, values, kind, &mut filler)?,
        Some((at, version)) => {
            let wanted = "version 2 (plain) or 3 (compressed)";
            return Err(Fault::text(at, Defect::Unexpected { found: version.to_string(), wanted }));
        }
    }
    let mut origin = [0.0; 3];
    if header.find("Center-X")?.is_some() {
        for (k, key) in ["Center-X", "Center-Y", "Center-Z"].into_iter().enumerate() {
            let centre = header.find(key)?.map_or(0, |(_, centre)| centre);
            origin[k] = (centre - (size[k] as i64 - 1) / 2) as f64;
        }
    }
    Ok(filler.finish(origin))
}

/// The fields of a header.
struct VolHeader<'a> {
    /// Key, value, byte offset of the value.
    fields: Vec<(&'a [u8], &'a [u8], usize)>,
    /// Offset of the data.
    end: usize,
}

impl<'a> VolHeader<'a> {
    fn read(bytes: &'a [u8]) -> Result<Self, Fault> {
        let mut fields = Vec::new();
        let mut position = 0;
        loop {
            let lines = Tokens::at(bytes, position, Syntax::Plain);
            let end = lines.line_end();
            let line = &bytes[position..end];
            if line == b"." {
                // Only one line end, because what follows can be data.
                let data = end + if bytes[end..].starts_with(b"\r\n") { 2 } else { 1 };
                return Ok(VolHeader { fields, end: data.min(bytes.len()) });
            }
            if end >= bytes.len() {
                let wanted = "a line `Key: value`, or `.` at the end of the header";
                let done = fields.len() as u64;
                return Err(Fault::text(position, Defect::OpenEnd { wanted, what: "header lines", done }));
            }
            let Some(colon) = line.iter().position(|&b| b == b':') else {
                let wanted = "a line `Key: value`, or `.` at the end of the header";
                return Err(Fault::text(position, Defect::Unexpected { found: quote(line), wanted }));
            };
            fields.push((line[..colon].trim_ascii(), line[colon + 1..].trim_ascii(), position + colon + 1));
            let mut next = lines;
            next.end_line();
            position = next.position();
        }
    }

    /// Returns the integer value of a key and its byte offset.
    fn find(&self, key: &'static str) -> Result<Option<(usize, i64)>, Fault> {
        let Some(&(_, value, at)) = self.fields.iter().find(|field| field.0 == key.as_bytes()) else {
            return Ok(None);
        };
        match integer(value) {
            Some(number) => Ok(Some((at, number))),
            None => Err(Fault::text(at, Defect::NotANumber { token: quote(value), wanted: key })),
        }
    }

    fn required(&self, key: &'static str) -> Result<(usize, i64), Fault> {
        let lacks = || Fault::text(self.end.saturating_sub(1), Defect::HeaderLacks { what: key });
        self.find(key)?.ok_or_else(lacks)
    }

    fn size(&self, key: &'static str) -> Result<usize, Fault> {
        let (at, value) = self.required(key)?;
        let wanted = "number of voxels, 1 or more";
        let wrong = || Fault::text(at, Defect::NotACount { value: value as f64, wanted });
        usize::try_from(value).ok().filter(|&n| n > 0).ok_or_else(wrong)
    }
}

/// Returns the offset of the values in a file without version: after the sizes and a line end.
fn first_version(bytes: &[u8], start: usize, size: [usize; 3]) -> Result<usize, Fault> {
    for (k, &n) in size.iter().enumerate() {
        let at = start + 4 * k;
        let word = bytes.get(at..at + 4).and_then(|word| word.try_into().ok());
        let word: [u8; 4] = word.ok_or_else(|| {
            let wanted = "the sizes as binary numbers, as there is no `Version`";
            Fault::binary(at, Defect::UnexpectedEnd { wanted, what: "sizes", done: k as u64, expected: 3 })
        })?;
        if ![u32::from_le_bytes(word), u32::from_be_bytes(word)].contains(&(n as u32)) {
            let wanted = "the size of the header again, as there is no `Version`";
            return Err(Fault::binary(at, Defect::Unexpected { found: u32::from_le_bytes(word).to_string(), wanted }));
        }
    }
    match bytes.get(start + 12) {
        Some(b'\n') => Ok(start + 13),
        other => {
            let found = other.map_or_else(String::new, |&b| quote(&[b]));
            Err(Fault::binary(start + 12, Defect::Unexpected { found, wanted: "a line end" }))
        }
    }
}

fn raw(bytes: &[u8], start: usize, values: u64, kind: VolKind, filler: &mut Filler) -> Result<(), Fault> {
    let data = bytes.get(start..).unwrap_or_default();
    let (left, bytes_each) = (data.len() as u64, kind.bytes() as u64);
    let wanted = values.saturating_mul(bytes_each);
    if left < wanted {
        let what = "voxels".to_string();
        return Err(Fault::binary(start, Defect::Truncated { what, count: values, bytes_each, left }));
    }
    if left > wanted {
        return Err(Fault::binary(start + wanted as usize, Defect::TrailingBytes { bytes: left - wanted }));
    }
    push_all(data, kind, filler);
    Ok(())
}

fn compressed(bytes: &[u8], start: usize, values: u64, kind: VolKind, filler: &mut Filler) -> Result<(), Fault> {
    let mut decoder = flate2::bufread::ZlibDecoder::new(bytes.get(start..).unwrap_or_default());
    let mut buffer = vec![0; 1 << 16];
    // Number of bytes of an incomplete value.
    let mut kept = 0;
    loop {
        let result = decoder.read(&mut buffer[kept..]);
        let at = start + decoder.total_in() as usize;
        let read = result.map_err(|error| Fault::binary(at, Defect::Compressed { reason: error.to_string() }))?;
        let full = kept + read;
        let whole = full - full % kind.bytes();
        let (done, more) = (filler.values, (whole / kind.bytes()) as u64);
        if read == 0 {
            if done < values || kept > 0 {
                let wanted = "the value of a voxel";
                return Err(Fault::binary(
                    at,
                    Defect::UnexpectedEnd { wanted, what: "voxels", done, expected: values },
                ));
            }
            break;
        }
        if done + more > values {
            let token = "a value".to_string();
            return Err(Fault::binary(at, Defect::Trailing { token }));
        }
        push_all(&buffer[..whole], kind, filler);
        buffer.copy_within(whole..full, 0);
        kept = full - whole;
    }
    let end = start + decoder.total_in() as usize;
    match bytes.len().saturating_sub(end) {
        0 => Ok(()),
        left => Err(Fault::binary(end, Defect::TrailingBytes { bytes: left as u64 })),
    }
}

fn push_all(data: &[u8], kind: VolKind, filler: &mut Filler) {
    match kind {
        VolKind::Vol => data.iter().for_each(|&b| filler.push(f64::from(b))),
        VolKind::Longvol => data.as_chunks().0.iter().for_each(|&b| filler.push(u64::from_le_bytes(b) as f64)),
    }
}
