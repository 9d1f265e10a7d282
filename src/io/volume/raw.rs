use super::Sample;
use super::fill::{Filler, Volume, count};
use crate::io::error::{Defect, Fault};

/// Reads values without a header, x fastest.
pub(super) fn read(bytes: &[u8], size: [usize; 3], sample: Sample, threshold: f64) -> Result<Volume, Fault> {
    if bytes.is_empty() {
        return Err(Fault::whole(Defect::Empty));
    }
    let values = count(size).map_err(Fault::whole)?;
    let bytes_each = match sample {
        Sample::U8 => 1,
        Sample::U16 => 2,
    };
    let found = bytes.len() as u64;
    if found != values * bytes_each {
        return Err(Fault::whole(Defect::Length { size, bytes_each, found }));
    }
    let mut filler = Filler::new(size, threshold);
    match sample {
        Sample::U8 => bytes.iter().for_each(|&b| filler.push(f64::from(b))),
        Sample::U16 => bytes.as_chunks().0.iter().for_each(|&b| filler.push(f64::from(u16::from_le_bytes(b)))),
    }
    Ok(filler.finish([0.0; 3]))
}
