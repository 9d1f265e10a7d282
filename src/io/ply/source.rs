use super::header::{Encoding, Scalar};
use crate::io::error::{Defect, Fault, quote};
use crate::io::token::{Syntax, Tokens, integer, number};

/// A stream of the values of a PLY body. `None` means that the file has ended.
pub(super) trait ValueSource<'a> {
    /// Returns the next value.
    fn scalar(&mut self, kind: Scalar) -> Result<Option<f64>, Fault>;

    /// Returns the next value, which must be an integer.
    fn whole(&mut self, kind: Scalar) -> Result<Option<i64>, Fault>;

    /// Skips values; false if the file has ended.
    fn skip(&mut self, kind: Scalar, values: u64) -> bool;

    /// The text of the last value; empty in binary files.
    fn text(&self) -> &'a [u8];

    /// Makes a fault at the last value.
    fn fault(&self, defect: Defect) -> Fault;

    /// Checks that the record of an element ends here.
    fn end_record(&mut self, element: &str) -> Result<(), Fault>;

    /// Checks that the file ends here.
    fn end(&mut self) -> Result<(), Fault>;

    /// Number of bytes that are left.
    fn left(&self) -> u64;
}

pub(super) struct Ascii<'a> {
    tokens: Tokens<'a>,
    last: &'a [u8],
}

impl<'a> Ascii<'a> {
    pub fn new(bytes: &'a [u8], start: usize) -> Self {
        Ascii { tokens: Tokens::at(bytes, start, Syntax::Plain), last: b"" }
    }
}

impl<'a> ValueSource<'a> for Ascii<'a> {
    fn scalar(&mut self, _: Scalar) -> Result<Option<f64>, Fault> {
        let Some(word) = self.tokens.next() else {
            return Ok(None);
        };
        self.last = word;
        number(word, "a value").map(Some).map_err(|e| self.fault(e))
    }

    fn whole(&mut self, _: Scalar) -> Result<Option<i64>, Fault> {
        let Some(word) = self.tokens.next() else {
            return Ok(None);
        };
        self.last = word;
        let wanted = "a whole number";
        let value = integer(word).ok_or_else(|| self.fault(Defect::NotANumber { token: quote(word), wanted }))?;
        Ok(Some(value))
    }

    fn skip(&mut self, _: Scalar, values: u64) -> bool {
        (0..values).all(|_| self.tokens.next().is_some())
    }

    fn text(&self) -> &'a [u8] {
        self.last
    }

    fn fault(&self, defect: Defect) -> Fault {
        self.tokens.fault(defect)
    }

    fn end_record(&mut self, element: &str) -> Result<(), Fault> {
        match self.tokens.next_on_line() {
            None => Ok(()),
            Some(word) => Err(self.fault(Defect::ExtraValue { token: quote(word), element: element.to_owned() })),
        }
    }

    fn end(&mut self) -> Result<(), Fault> {
        match self.tokens.next() {
            None => Ok(()),
            Some(word) => Err(self.fault(Defect::Trailing { token: quote(word) })),
        }
    }

    fn left(&self) -> u64 {
        // The last value need not be followed by a blank.
        self.tokens.left() as u64 + 1
    }
}

pub(super) struct Binary<'a> {
    bytes: &'a [u8],
    position: usize,
    last: usize,
    big_endian: bool,
}

impl<'a> Binary<'a> {
    pub fn new(bytes: &'a [u8], start: usize, encoding: Encoding) -> Self {
        Binary { bytes, position: start, last: start, big_endian: encoding == Encoding::BigEndian }
    }

    #[inline]
    fn take<const N: usize>(&mut self) -> Option<[u8; N]> {
        let mut taken = *self.bytes.get(self.position..)?.first_chunk::<N>()?;
        self.last = self.position;
        self.position += N;
        if self.big_endian {
            taken.reverse();
        }
        Some(taken)
    }

    #[inline]
    fn integer(&mut self, kind: Scalar) -> Option<i64> {
        Some(match kind {
            Scalar::I8 => i64::from(i8::from_le_bytes(self.take()?)),
            Scalar::U8 => i64::from(u8::from_le_bytes(self.take()?)),
            Scalar::I16 => i64::from(i16::from_le_bytes(self.take()?)),
            Scalar::U16 => i64::from(u16::from_le_bytes(self.take()?)),
            Scalar::I32 => i64::from(i32::from_le_bytes(self.take()?)),
            Scalar::U32 | Scalar::F32 | Scalar::F64 => i64::from(u32::from_le_bytes(self.take()?)),
        })
    }
}

impl<'a> ValueSource<'a> for Binary<'a> {
    #[inline]
    fn scalar(&mut self, kind: Scalar) -> Result<Option<f64>, Fault> {
        Ok(match kind {
            Scalar::F32 => self.take().map(|b| f64::from(f32::from_le_bytes(b))),
            Scalar::F64 => self.take().map(f64::from_le_bytes),
            whole => self.integer(whole).map(|i| i as f64),
        })
    }

    #[inline]
    fn whole(&mut self, kind: Scalar) -> Result<Option<i64>, Fault> {
        Ok(self.integer(kind))
    }

    #[inline]
    fn skip(&mut self, kind: Scalar, values: u64) -> bool {
        let bytes = values.saturating_mul(kind.bytes() as u64);
        if bytes > self.left() {
            return false;
        }
        self.position += bytes as usize;
        true
    }

    fn text(&self) -> &'a [u8] {
        b""
    }

    fn fault(&self, defect: Defect) -> Fault {
        Fault::binary(self.last, defect)
    }

    fn end_record(&mut self, _: &str) -> Result<(), Fault> {
        Ok(())
    }

    /// Some writers add a final line end, which is not data.
    fn end(&mut self) -> Result<(), Fault> {
        let rest = self.bytes.get(self.position..).unwrap_or_default();
        if rest.iter().all(u8::is_ascii_whitespace) {
            return Ok(());
        }
        Err(Fault::binary(self.position, Defect::TrailingBytes { bytes: rest.len() as u64 }))
    }

    fn left(&self) -> u64 {
        self.bytes.len().saturating_sub(self.position) as u64
    }
}
