/// The scale of values ≥ 1 (1: conformal) on a colour bar from 1 to [`Scale::upper`].
///
/// The upper end is the 99th percentile of the finite values, rounded up to a round number, so that
/// a few bad faces do not determine the scale; if the largest value is not much larger, it is
/// included. The scale is linear up to 10 and logarithmic above. Values that equal 1 up to rounding
/// get the range 1 … 1.001.
#[derive(Clone, Debug, PartialEq)]
pub struct Scale {
    upper: f64,
    step: f64,
    logarithmic: bool,
    exceeded: bool,
}

/// Shortest range of a scale; smaller differences are not significant.
const SHORTEST: f64 = 1e-3;
/// Largest upper end of a linear scale; with a larger one most values would have the first colour.
const LARGEST_LINEAR: f64 = 10.0;
/// The largest value is included if its distance from 1 is within this factor of the percentile's.
const STRETCH: f64 = 1.5;
/// Mantissas of ranges, each with a tick step that divides it evenly.
const RANGES: [(f64, f64); 11] = [
    (1.0, 0.2),
    (1.2, 0.2),
    (1.5, 0.25),
    (2.0, 0.5),
    (2.5, 0.5),
    (3.0, 0.5),
    (4.0, 1.0),
    (5.0, 1.0),
    (6.0, 1.0),
    (8.0, 2.0),
    (10.0, 2.0),
];

impl Scale {
    /// Makes the scale of `values`; +∞ is beyond it, negative values and NaN are ignored.
    pub fn for_errors(values: impl IntoIterator<Item = f64>) -> Scale {
        let (mut finite, mut infinite) = (Vec::new(), false);
        for v in values {
            if v == f64::INFINITY {
                infinite = true;
            } else if v >= 0.0 {
                finite.push(v.max(1.0));
            }
        }
        finite.sort_unstable_by(f64::total_cmp);
        let largest = finite.last().copied().unwrap_or(1.0);
        let percentile = finite.get((finite.len() * 99).div_ceil(100).max(1) - 1).copied().unwrap_or(1.0);

        let wanted = if largest - 1.0 <= STRETCH * (percentile - 1.0).max(SHORTEST) { largest } else { percentile };
        let (upper, step, logarithmic) = if wanted > LARGEST_LINEAR {
            (round_up_in_decade(wanted), 0.0, true)
        } else {
            let (range, step) = round_up_range((wanted - 1.0).max(SHORTEST));
            (1.0 + range, step, false)
        };
        // A value that exceeds the upper end only by rounding is on the scale.
        let exceeded = infinite || largest - 1.0 > (upper - 1.0) * (1.0 + 1e-9);
        Scale { upper, step, logarithmic, exceeded }
    }

    /// Makes the scale from 1 to a given upper end (> 1), which some of `values` can exceed.
    pub fn up_to(upper: f64, values: impl IntoIterator<Item = f64>) -> Scale {
        let logarithmic = upper > LARGEST_LINEAR;
        Scale { upper, step: (upper - 1.0) / 5.0, logarithmic, exceeded: values.into_iter().any(|v| v > upper) }
    }

    /// The largest value on the scale.
    pub fn upper(&self) -> f64 {
        self.upper
    }

    /// Whether some value lies beyond the upper end.
    pub fn exceeded(&self) -> bool {
        self.exceeded
    }

    /// The position on the bar: 0 at value 1 (and below), 1 at the upper end, `None` beyond it.
    pub fn position(&self, value: f64) -> Option<f64> {
        let t = if self.logarithmic { value.ln() / self.upper.ln() } else { (value - 1.0) / (self.upper - 1.0) };
        (t <= 1.0 + 1e-9).then(|| t.clamp(0.0, 1.0))
    }

    /// Positions and labels of the tick marks, the first at 1, the last at the upper end.
    pub fn ticks(&self) -> Vec<(f64, String)> {
        if self.logarithmic {
            return self.logarithmic_ticks();
        }
        let count = ((self.upper - 1.0) / self.step).round() as usize;
        let decimals = decimals_of(self.step);
        (0..=count).map(|k| (k as f64 / count as f64, format!("{:.decimals$}", 1.0 + k as f64 * self.step))).collect()
    }

    /// The label of the upper end.
    pub fn upper_label(&self) -> String {
        self.ticks().pop().map(|(_, label)| label).unwrap_or_default()
    }

    /// Ticks at 1, 2, 5 of every decade if there are at most three; otherwise at decades, thinned
    /// to about eight.
    fn logarithmic_ticks(&self) -> Vec<(f64, String)> {
        let decades = self.upper.log10();
        let mantissas: &[f64] = if decades <= 3.0 + 1e-9 { &[1.0, 2.0, 5.0] } else { &[1.0] };
        let thin = (decades / 8.0).ceil().max(1.0) as usize;
        let mut values = Vec::new();
        for decade in (0..=decades.floor() as i32).step_by(thin) {
            values.extend(mantissas.iter().map(|m| m * 10f64.powi(decade)).filter(|v| *v <= self.upper * (1.0 + 1e-9)));
        }
        let mut ticks: Vec<_> = values.iter().map(|v| (v.log10() / decades, power_label(*v))).collect();
        match ticks.last() {
            Some((t, _)) if *t > 1.0 - 1e-9 => {}
            last => {
                // Labels closer than this would touch.
                if last.is_some_and(|(t, _)| *t > 0.94) {
                    ticks.pop();
                }
                ticks.push((1.0, power_label(self.upper)));
            }
        }
        ticks
    }
}

/// Returns the smallest mantissa × power of ten that is at least `range`, and a step that divides
/// it.
fn round_up_range(range: f64) -> (f64, f64) {
    let power = 10f64.powf(range.log10().floor());
    let (mantissa, step) =
        RANGES.into_iter().find(|(m, _)| range <= m * power * (1.0 + 1e-9)).unwrap_or(RANGES[RANGES.len() - 1]);
    (mantissa * power, step * power)
}

/// Returns the smallest of 1, 2, 5 × power of ten that is at least `value`, or the largest float.
fn round_up_in_decade(value: f64) -> f64 {
    let power = 10f64.powf(value.log10().floor());
    let rounded = [1.0, 2.0, 5.0, 10.0].into_iter().map(|m| m * power).find(|v| value <= v * (1.0 + 1e-9));
    rounded.unwrap_or(f64::MAX).min(f64::MAX)
}

/// Number of decimals of multiples of `step`.
pub(super) fn decimals_of(step: f64) -> usize {
    (0..15)
        .find(|d| {
            let scaled = step * 10f64.powi(*d);
            (scaled - scaled.round()).abs() < 1e-6 * scaled.max(1.0) && scaled.round() >= 1.0
        })
        .unwrap_or(15) as usize
}

/// Formats powers: `2000` for small numbers, `5×10⁴` for large ones.
fn power_label(value: f64) -> String {
    if value < 9999.0 { format!("{value:.0}") } else { exponent_label(value, 0) }
}

/// Formats a number as a mantissa with `digits` decimals times a power of ten in superscripts; a
/// mantissa of 1 is omitted.
pub(super) fn exponent_label(value: f64, digits: usize) -> String {
    let written = format!("{value:.digits$e}");
    let (mantissa, exponent) = written.split_once('e').unwrap_or((&written, "0"));
    let raised: String = exponent.chars().map(superscript).collect();
    match mantissa {
        "1" => format!("10{raised}"),
        "-1" => format!("−10{raised}"),
        _ => format!("{}×10{raised}", mantissa.replace('-', "−")),
    }
}

/// Converts `2.50e-26` to `2.50×10⁻²⁶`; anything but a number with an exponent is unchanged.
pub fn power_of_ten(number: &str) -> String {
    match number.split_once('e') {
        Some((mantissa, exponent)) if mantissa.parse::<f64>().is_ok() && exponent.parse::<i32>().is_ok() => {
            let raised: String = exponent.chars().map(superscript).collect();
            format!("{}×10{raised}", mantissa.replace('-', "−"))
        }
        _ => number.to_owned(),
    }
}

fn superscript(c: char) -> char {
    match c {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        '0' | '4'..='9' => char::from_u32('⁰' as u32 + c as u32 - '0' as u32).unwrap_or(c),
        _ => c,
    }
}
