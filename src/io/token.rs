use super::error::{Defect, Fault, quote};

/// The words of a text file. Lines end with `\n`, `\r\n` or `\r`; blanks are those of ASCII. Bytes
/// need not be UTF-8.
#[derive(Clone)]
pub(super) struct Tokens<'a> {
    bytes: &'a [u8],
    position: usize,
    start: usize,
    syntax: Syntax,
    continued: bool,
}

/// The comment and continuation syntax of a text format.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Syntax {
    /// Neither comments nor continuation lines.
    Plain,
    /// `#` begins a comment.
    Comments,
    /// `#` begins a comment, `\` before a line end continues the line.
    CommentsAndContinuation,
}

impl<'a> Tokens<'a> {
    pub fn new(bytes: &'a [u8], syntax: Syntax) -> Self {
        let position = if bytes.starts_with(b"\xef\xbb\xbf") { 3 } else { 0 };
        Tokens { bytes, position, start: position, syntax, continued: false }
    }

    /// Starts at a byte offset.
    pub fn at(bytes: &'a [u8], position: usize, syntax: Syntax) -> Self {
        Tokens { bytes, position, start: position, syntax, continued: false }
    }

    /// Byte offset of the end of the last word.
    pub fn position(&self) -> usize {
        self.position
    }

    /// Number of bytes after the last word.
    pub fn left(&self) -> usize {
        self.bytes.len() - self.position
    }

    /// Returns the last `length` bytes of the last word to the stream, as the next word.
    pub fn step_back(&mut self, length: usize) {
        self.position = self.position.saturating_sub(length).max(self.start);
    }

    /// Byte offset of the beginning of the last word.
    pub fn start(&self) -> usize {
        self.start
    }

    /// Whether the words since the last [`Tokens::end_line`] come from several lines joined by `\`.
    pub fn continued(&self) -> bool {
        self.continued
    }

    /// Makes a fault at the last word.
    pub fn fault(&self, defect: Defect) -> Fault {
        Fault::text(self.start, defect)
    }

    /// Returns the next word, on this line or a later one; `None` at the end of the file.
    pub fn next(&mut self) -> Option<&'a [u8]> {
        loop {
            if let Some(token) = self.next_on_line() {
                return Some(token);
            }
            if self.position >= self.bytes.len() {
                return None;
            }
            self.end_line();
        }
    }

    /// Returns the next word of this line; `None` at its end or at a comment.
    #[inline]
    pub fn next_on_line(&mut self) -> Option<&'a [u8]> {
        let bytes = self.bytes;
        let mut i = self.position;
        loop {
            match bytes.get(i) {
                Some(b' ' | b'\t' | 0x0b | 0x0c) => i += 1,
                Some(b'\\') if self.syntax == Syntax::CommentsAndContinuation => match line_end_at(bytes, i + 1) {
                    0 => break,
                    length => {
                        self.continued = true;
                        i += 1 + length;
                    }
                },
                _ => break,
            }
        }
        self.start = i;
        self.position = i;
        match bytes.get(i) {
            None | Some(b'\n' | b'\r') => return None,
            Some(b'#') if self.syntax != Syntax::Plain => return None,
            Some(_) => i += 1,
        }
        while let Some(&b) = bytes.get(i) {
            match b {
                b' ' | b'\t'..=b'\r' => break,
                b'#' if self.syntax != Syntax::Plain => break,
                b'\\' if self.syntax == Syntax::CommentsAndContinuation => break,
                _ => i += 1,
            }
        }
        self.position = i;
        Some(&bytes[self.start..i])
    }

    /// Advances to the beginning of the next line.
    pub fn end_line(&mut self) {
        let bytes = self.bytes;
        self.continued = false;
        loop {
            let end = self.line_end();
            let line = &bytes[self.position..end];
            self.position = end + line_end_at(bytes, end);
            let joined =
                self.syntax == Syntax::CommentsAndContinuation && line.last() == Some(&b'\\') && !line.contains(&b'#');
            if !joined || self.position >= bytes.len() {
                return;
            }
        }
    }

    /// Byte offset of the end of this line.
    pub fn line_end(&self) -> usize {
        let rest = self.bytes.get(self.position..).unwrap_or_default();
        self.position + rest.iter().position(|&b| b == b'\n' || b == b'\r').unwrap_or(rest.len())
    }

    /// Whether only blanks (and a comment) are left on this line.
    pub fn at_line_end(&self) -> bool {
        self.clone().next_on_line().is_none()
    }
}

/// Returns the length of the line end at `i`: 2 for `\r\n`, 1 for `\n` and `\r`, otherwise 0.
pub(super) fn line_end_at(bytes: &[u8], i: usize) -> usize {
    match (bytes.get(i), bytes.get(i + 1)) {
        (Some(b'\r'), Some(b'\n')) => 2,
        (Some(b'\r' | b'\n'), _) => 1,
        _ => 0,
    }
}

/// Parses a number, possibly NaN or infinite.
pub(super) fn number(token: &[u8], wanted: &'static str) -> Result<f64, Defect> {
    let parsed = std::str::from_utf8(token).ok().and_then(|s| s.parse().ok());
    parsed.ok_or_else(|| Defect::NotANumber { token: quote(token), wanted })
}

/// Parses a finite number.
pub(super) fn coordinate(token: &[u8]) -> Result<f64, Defect> {
    let x = number(token, "a coordinate")?;
    if x.is_finite() { Ok(x) } else { Err(Defect::NotFinite { token: quote(token) }) }
}

/// Parses an integer with an optional sign.
pub(super) fn integer(token: &[u8]) -> Option<i64> {
    let (negative, digits) = match token {
        [b'-', rest @ ..] => (true, rest),
        [b'+', rest @ ..] => (false, rest),
        _ => (false, token),
    };
    // 18 digits cannot overflow; longer numbers cannot be indices.
    if digits.is_empty() || digits.len() > 18 {
        return None;
    }
    let mut value = 0;
    for &d in digits {
        if !d.is_ascii_digit() {
            return None;
        }
        value = 10 * value + i64::from(d - b'0');
    }
    Some(if negative { -value } else { value })
}
