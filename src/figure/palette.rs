use std::collections::HashMap;

use tiny_skia::Pixmap;

use super::FigureError;

/// Largest number of colours of a palette: those that one byte can number.
const COLOURS: usize = 256;

/// Encodes an opaque sheet as a PNG file of at most 256 colours, found by median cut.
///
/// The box of colours with the largest variance is cut where this reduces its variance most, until
/// there are enough boxes; each is represented by its mean.
pub(super) fn encode_indexed(sheet: &Pixmap) -> Result<Vec<u8>, FigureError> {
    let mut counts: HashMap<[u8; 3], u64> = HashMap::new();
    for pixel in sheet.data().chunks_exact(4) {
        *counts.entry([pixel[0], pixel[1], pixel[2]]).or_default() += 1;
    }
    let mut colours: Vec<([u8; 3], u64)> = counts.into_iter().collect();
    // Sorted, because the order of a hash map differs between runs.
    colours.sort_unstable();
    let mut number: HashMap<[u8; 3], u8> = HashMap::with_capacity(colours.len());
    let mut palette = Vec::with_capacity(3 * COLOURS);
    for (i, colours) in boxes(&mut colours).iter().enumerate() {
        palette.extend(mean(colours).map(|x| x.round() as u8));
        number.extend(colours.iter().map(|(colour, _)| (*colour, i as u8)));
    }
    let pixels: Vec<u8> = sheet.data().chunks_exact(4).map(|p| number[&[p[0], p[1], p[2]]]).collect();
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, sheet.width(), sheet.height());
    encoder.set_color(png::ColorType::Indexed);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_palette(palette);
    encoder.set_compression(png::Compression::High);
    // Colour indices are not intensities that filters could predict.
    encoder.set_filter(png::Filter::NoFilter);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&pixels)?;
    writer.finish()?;
    Ok(bytes)
}

/// Colours with their numbers of pixels.
type Counted = [([u8; 3], u64)];

/// Divides colours into at most [`COLOURS`] boxes.
fn boxes(colours: &mut Counted) -> Vec<&Counted> {
    let mut boxes: Vec<(f64, &mut Counted)> = vec![(scatter(colours), colours)];
    while boxes.len() < COLOURS {
        // Of equal ones the last.
        let widest = (0..boxes.len()).max_by(|&a, &b| boxes[a].0.total_cmp(&boxes[b].0)).unwrap_or_default();
        if boxes.is_empty() || boxes[widest].0 == 0.0 {
            break;
        }
        let (_, colours) = boxes.swap_remove(widest);
        for part in cut(colours) {
            boxes.push((scatter(part), part));
        }
    }
    boxes.into_iter().map(|(_, colours)| &*colours).collect()
}

/// Cuts a box of at least two colours across the channel of largest variance, where the total
/// variance of both parts is smallest.
fn cut(colours: &mut Counted) -> [&mut Counted; 2] {
    let channel = (0..3).max_by(|&a, &b| spread(colours, a).total_cmp(&spread(colours, b))).unwrap_or_default();
    colours.sort_unstable_by_key(|(colour, _)| (colour[channel], *colour));
    let total: (f64, f64) = colours.iter().fold((0.0, 0.0), |s, c| weighed(s, c, channel));
    let (mut below, mut best, mut at) = ((0.0, 0.0), f64::NEG_INFINITY, 1);
    for i in 0..colours.len() - 1 {
        below = weighed(below, &colours[i], channel);
        // The reduction of the sum of squares is the weighted sum of the squares of both means, up
        // to a constant.
        let above = (total.0 - below.0, total.1 - below.1);
        let gain = below.1 * below.1 / below.0 + above.1 * above.1 / above.0;
        if colours[i].0[channel] != colours[i + 1].0[channel] && gain > best {
            (best, at) = (gain, i + 1);
        }
    }
    let (low, high) = colours.split_at_mut(at);
    [low, high]
}

fn weighed((count, sum): (f64, f64), (colour, n): &([u8; 3], u64), channel: usize) -> (f64, f64) {
    (count + *n as f64, sum + *n as f64 * f64::from(colour[channel]))
}

/// The sum over all pixels of the squared difference from the mean, in one channel.
fn spread(colours: &Counted, channel: usize) -> f64 {
    let mean = mean(colours)[channel];
    colours.iter().map(|(colour, n)| *n as f64 * (f64::from(colour[channel]) - mean).powi(2)).sum()
}

/// The largest [`spread`] of a channel; 0 for a single colour.
fn scatter(colours: &Counted) -> f64 {
    if colours.len() < 2 { 0.0 } else { (0..3).map(|channel| spread(colours, channel)).fold(0.0, f64::max) }
}

fn mean(colours: &Counted) -> [f64; 3] {
    let pixels: u64 = colours.iter().map(|(_, n)| n).sum();
    let sum = |k: usize| colours.iter().map(|(colour, n)| *n as f64 * f64::from(colour[k])).sum::<f64>();
    [0, 1, 2].map(|k| sum(k) / pixels.max(1) as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_colours_stay_as_they_are_and_many_come_close() {
        let mut few: Vec<_> = (0..200u8).map(|i| ([i, 255 - i, 7], 1 + u64::from(i))).collect();
        for part in boxes(&mut few) {
            assert_eq!(part.len(), 1);
        }
        // A small stand-in for a surface in two hues; all 16 million colours would give 256 boxes
        // of 40³.
        let mut many: Vec<_> = (0..5000u32).map(|i| ([(i % 251) as u8, (i % 83) as u8, (i / 20) as u8], 1)).collect();
        let parts = boxes(&mut many);
        assert_eq!(parts.len(), COLOURS);
        assert_eq!(parts.iter().map(|part| part.len()).sum::<usize>(), 5000);
        let worst = parts.iter().flat_map(|part| {
            let mean = mean(part);
            part.iter()
                .map(move |(colour, _)| (0..3).map(|k| (f64::from(colour[k]) - mean[k]).abs()).fold(0.0, f64::max))
        });
        assert!(worst.fold(0.0, f64::max) < 40.0);
    }
}
