use tiny_skia::{Pixmap, PixmapPaint, Transform};

use super::palette::encode_indexed;
use super::raster::{blank_sheet, encode_png};
use super::{FigureError, style};

/// Composes finished pictures on one sheet, row by row, each centred in its column.
///
/// # Errors
/// No pictures; a picture that is not a PNG file of 8-bit RGB pixels; a sheet that is too large.
pub fn compose(pictures: &[Vec<u8>], columns: usize) -> Result<Vec<u8>, FigureError> {
    let panels: Vec<SheetPicture> = pictures.iter().map(|png| SheetPicture::decode(png)).collect::<Result<_, _>>()?;
    let Some(first) = panels.first() else { return Err(FigureError::NoPanels) };
    let columns = columns.clamp(1, panels.len());
    let mut widths = vec![0; columns];
    let mut heights = vec![0; panels.len().div_ceil(columns)];
    for (i, panel) in panels.iter().enumerate() {
        widths[i % columns] = panel.pixels.width().max(widths[i % columns]);
        heights[i / columns] = panel.pixels.height().max(heights[i / columns]);
    }
    let mut sheet = blank_sheet(widths.iter().sum(), heights.iter().sum())?;
    for (i, panel) in panels.iter().enumerate() {
        let (column, row) = (i % columns, i / columns);
        let x = widths[..column].iter().sum::<u32>() + (widths[column] - panel.pixels.width()) / 2;
        let y = heights[..row].iter().sum::<u32>() + (heights[row] - panel.pixels.height()) / 2;
        let place = Transform::identity();
        sheet.draw_pixmap(x as i32, y as i32, panel.pixels.as_ref(), &PixmapPaint::default(), place, None);
    }
    encode_png(&sheet, first.zoom)
}

/// Makes a copy for screens: at most `width` pixels wide, in 256 colours.
///
/// # Errors
/// As for [`compose`].
pub fn small_copy(png: &[u8], width: u32) -> Result<Vec<u8>, FigureError> {
    let SheetPicture { pixels, .. } = SheetPicture::decode(png)?;
    let factor = f64::from(pixels.width()) / f64::from(width.max(1));
    if factor <= 1.0 {
        return encode_indexed(&pixels);
    }
    let height = (f64::from(pixels.height()) / factor).round().max(1.0) as u32;
    let mut small = blank_sheet(width, height)?;
    let columns = shares(pixels.width(), width);
    let rows = shares(pixels.height(), height);
    let source = pixels.data();
    for (pixel, i) in small.data_mut().chunks_exact_mut(4).zip(0..) {
        let (columns, rows) = (&columns[i % width as usize], &rows[i / width as usize]);
        let mut sum = [0.0; 3];
        for &(row, down) in rows {
            for &(column, across) in columns {
                let at = (row * pixels.width() as usize + column) * 4;
                (0..3).for_each(|k| sum[k] += down * across * f64::from(source[at + k]));
            }
        }
        (0..3).for_each(|k| pixel[k] = sum[k].round() as u8);
    }
    encode_indexed(&small)
}

/// Returns for each of `to` cells the cells of `from` that it covers, with their shares.
fn shares(from: u32, to: u32) -> Vec<Vec<(usize, f64)>> {
    let width = f64::from(from) / f64::from(to);
    let of_cell = |cell: u32| {
        let (low, high) = (f64::from(cell) * width, (f64::from(cell) + 1.0) * width);
        let covered = low as usize..(high.ceil() as usize).min(from as usize);
        let share = |k: usize| (high.min(k as f64 + 1.0) - low.max(k as f64)).max(0.0) / width;
        covered.map(|k| (k, share(k))).collect()
    };
    (0..to).map(of_cell).collect()
}

/// A finished figure.
struct SheetPicture {
    pixels: Pixmap,
    /// Pixels per unit of paper.
    zoom: u32,
}

impl SheetPicture {
    fn decode(png: &[u8]) -> Result<SheetPicture, FigureError> {
        let mut reader = png::Decoder::new(std::io::Cursor::new(png)).read_info()?;
        let info = reader.info();
        let (width, height) = (info.width, info.height);
        let zoom = info.pixel_dims.map_or(1, |dims| (dims.xppu / style::PIXELS_PER_METRE).max(1));
        if (info.color_type, info.bit_depth) != (png::ColorType::Rgb, png::BitDepth::Eight) {
            return Err(FigureError::Panel);
        }
        let mut rgb = vec![0; reader.output_buffer_size().ok_or(FigureError::Sheet { width, height })?];
        reader.next_frame(&mut rgb)?;
        let mut pixels = blank_sheet(width, height)?;
        for (pixel, colour) in pixels.data_mut().chunks_exact_mut(4).zip(rgb.chunks_exact(3)) {
            pixel[..3].copy_from_slice(colour);
        }
        Ok(SheetPicture { pixels, zoom })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plain(width: u32, height: u32, colour: [u8; 3]) -> Vec<u8> {
        let mut sheet = blank_sheet(width, height).unwrap();
        sheet.data_mut().chunks_exact_mut(4).for_each(|p| p[..3].copy_from_slice(&colour));
        encode_png(&sheet, 2).unwrap()
    }

    #[test]
    fn panels_stand_in_the_middle_of_rows_and_columns() {
        let (red, blue) = ([200, 0, 0], [0, 0, 200]);
        let sheet = compose(&[plain(10, 10, red), plain(4, 6, blue), plain(6, 2, blue)], 2).unwrap();
        let SheetPicture { pixels, zoom } = SheetPicture::decode(&sheet).unwrap();
        assert_eq!((pixels.width(), pixels.height(), zoom), (14, 12, 2));
        let at = |x: usize, y: usize| &pixels.data()[(y * 14 + x) * 4..][..3];
        assert_eq!((at(0, 0), at(9, 9), at(10, 2), at(2, 10)), (&red[..], &red[..], &blue[..], &blue[..]));
        assert_eq!((at(10, 1), at(1, 10), at(12, 11)), (&[255; 3][..], &[255; 3][..], &[255; 3][..]));
        assert!(matches!(compose(&[], 2), Err(FigureError::NoPanels)));
        assert!(compose(&[b"no picture".to_vec()], 1).is_err());
    }

    #[test]
    fn shares_of_every_cell_add_up_to_one() {
        for (from, to) in [(7, 3), (3482, 900), (10, 10), (5, 1)] {
            for cell in shares(from, to) {
                assert!((cell.iter().map(|(_, share)| share).sum::<f64>() - 1.0).abs() < 1e-12, "{from} {to}");
            }
        }
    }

    #[test]
    fn a_small_copy_has_the_mean_colours_of_its_source() {
        let sheet = compose(&[plain(600, 400, [200, 30, 10]), plain(600, 400, [10, 30, 200])], 2).unwrap();
        let small = small_copy(&sheet, 300).unwrap();
        assert!(small.len() < sheet.len());
        let mut decoder = png::Decoder::new(std::io::Cursor::new(&small));
        decoder.set_transformations(png::Transformations::EXPAND);
        let mut reader = decoder.read_info().unwrap();
        let mut rgb = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut rgb).unwrap();
        assert_eq!((info.width, info.height), (300, 100));
        assert_eq!((&rgb[..3], &rgb[299 * 3..300 * 3]), (&[200, 30, 10][..], &[10, 30, 200][..]));
    }
}
