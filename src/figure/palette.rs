use std::collections::HashMap;

use tiny_skia::Pixmap;

use super::FigureError;

/// Colours of a palette at most: what one byte can number.
const COLOURS: usize = 256;

/// An opaque sheet as a PNG file of at most 256 colours, found by median cut: the box of colours in which most varies is
/// cut where its variance falls most, until there are enough, and each stands for its mean.
pub(super) fn encode_indexed(sheet: &Pixmap) -> Result<Vec<u8>, FigureError> {
    let mut counts: HashMap<[u8; 3], u64> = HashMap::new();
    for pixel in sheet.data().chunks_exact(4) {
        *counts.entry([pixel[0], pixel[1], pixel[2]]).or_default() += 1;
    }
    let mut colours: Vec<([u8; 3], u64)> = counts.into_iter().collect();
    // The order of a hash map differs from run to run.
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
    // Numbers of colours are no intensities that filters could predict.
    encoder.set_filter(png::Filter::NoFilter);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&pixels)?;
    writer.finish()?;
    Ok(bytes)
}

/// Colours with their numbers of pixels.
type Counted = [([u8; 3], u64)];

/// At most [`COLOURS`] boxes.
fn boxes(colours: &mut Counted) -> Vec<&Counted> {
    let mut boxes: Vec<(f64, &mut Counted)> = vec![(scatter(colours), colours)];
    while boxes.len() < COLOURS {
        // The last of equals.
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

/// Cuts a box of two colours or more across the channel that varies most, where both parts together vary least.
fn cut(colours: &mut Counted) -> [&mut Counted; 2] {
    let channel = (0..3).max_by(|&a, &b| spread(colours, a).total_cmp(&spread(colours, b))).unwrap_or_default();
    colours.sort_unstable_by_key(|(colour, _)| (colour[channel], *colour));
    let total: (f64, f64) = colours.iter().fold((0.0, 0.0), |s, c| weighed(s, c, channel));
    let (mut below, mut best, mut at) = ((0.0, 0.0), f64::NEG_INFINITY, 1);
    for i in 0..colours.len() - 1 {
        below = weighed(below, &colours[i], channel);
        // The sum of squares falls by what the squares of both means weigh.
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

/// Sum over all pixels of the squared distance to the mean, in one channel.
fn spread(colours: &Counted, channel: usize) -> f64 {
    let mean = mean(colours)[channel];
    colours.iter().map(|(colour, n)| *n as f64 * (f64::from(colour[channel]) - mean).powi(2)).sum()
}

/// The same in the channel where it is largest; 0 for a single colour.
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
        // 16 million colours would be 256 boxes of 40³; a surface in two hues is less.
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
