use crate::io::error::{Defect, Fault, quote};
use crate::io::token::{Syntax, Tokens, integer, line_end_at};

/// The declarations before `end_header`.
pub(super) struct PlyHeader {
    pub encoding: Encoding,
    pub elements: Vec<Element>,
    /// Byte offset of the first element.
    pub end: usize,
}

#[derive(Clone, Copy, PartialEq)]
pub(super) enum Encoding {
    Ascii,
    LittleEndian,
    BigEndian,
}

pub(super) struct Element {
    pub name: String,
    pub count: u64,
    pub properties: Vec<Property>,
}

pub(super) struct Property {
    pub name: String,
    pub kind: PropertyType,
}

#[derive(Clone, Copy)]
pub(super) enum PropertyType {
    Scalar(Scalar),
    List { count: Scalar, item: Scalar },
}

#[derive(Clone, Copy, PartialEq)]
pub(super) enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Scalar {
    fn named(word: &[u8]) -> Option<Scalar> {
        Some(match word {
            b"char" | b"int8" => Scalar::I8,
            b"uchar" | b"uint8" => Scalar::U8,
            b"short" | b"int16" => Scalar::I16,
            b"ushort" | b"uint16" => Scalar::U16,
            b"int" | b"int32" => Scalar::I32,
            b"uint" | b"uint32" => Scalar::U32,
            b"float" | b"float32" => Scalar::F32,
            b"double" | b"float64" => Scalar::F64,
            _ => return None,
        })
    }

    pub fn bytes(self) -> usize {
        match self {
            Scalar::I8 | Scalar::U8 => 1,
            Scalar::I16 | Scalar::U16 => 2,
            Scalar::I32 | Scalar::U32 | Scalar::F32 => 4,
            Scalar::F64 => 8,
        }
    }

    pub fn is_float(self) -> bool {
        matches!(self, Scalar::F32 | Scalar::F64)
    }
}

impl Element {
    /// The size of the shortest record, with empty lists: in bytes, or in ascii a character and a
    /// blank per value.
    pub fn shortest(&self, encoding: Encoding) -> u64 {
        let bytes = |p: &Property| match (encoding, p.kind) {
            (Encoding::Ascii, _) => 2,
            (_, PropertyType::Scalar(s)) => s.bytes() as u64,
            (_, PropertyType::List { count, .. }) => count.bytes() as u64,
        };
        self.properties.iter().map(bytes).sum()
    }
}

impl PlyHeader {
    pub fn read(bytes: &[u8]) -> Result<PlyHeader, Fault> {
        let mut tokens = Tokens::new(bytes, Syntax::Plain);
        let mut encoding = None;
        let mut elements: Vec<Element> = Vec::new();
        let mut lines = 1;
        match tokens.next_on_line() {
            Some(b"ply" | b"PLY") => {}
            None if tokens.clone().next().is_none() => return Err(Fault::whole(Defect::Empty)),
            word => {
                let found = quote(word.unwrap_or_default());
                return Err(tokens.fault(Defect::Unexpected { found, wanted: "the keyword `ply`" }));
            }
        }
        let carriage_return_ends_lines =
            line_end_at(bytes, tokens.line_end()) == 1 && bytes[tokens.line_end()] == b'\r';
        loop {
            tokens.end_line();
            if tokens.left() == 0 {
                let wanted = "end_header";
                return Err(tokens.fault(Defect::OpenEnd { wanted, what: "header lines", done: lines }));
            }
            lines += 1;
            match tokens.next_on_line() {
                Some(b"format") => encoding = Some(format(&mut tokens)?),
                Some(b"element") => elements.push(element(&mut tokens)?),
                Some(b"property") => {
                    let property = property(&mut tokens)?;
                    let wanted = "an element before its properties";
                    let found = "property".to_owned();
                    let element = elements.last_mut();
                    element
                        .ok_or_else(|| tokens.fault(Defect::Unexpected { found, wanted }))?
                        .properties
                        .push(property);
                }
                Some(b"end_header") => break,
                None | Some(b"comment" | b"obj_info") => {}
                Some(word) => {
                    let wanted = "format, comment, element, property or end_header";
                    return Err(tokens.fault(Defect::Unexpected { found: quote(word), wanted }));
                }
            }
        }
        let encoding = encoding.ok_or_else(|| tokens.fault(Defect::HeaderLacks { what: "line `format …`" }))?;
        let line_end = tokens.line_end();
        // After a lone carriage return, a newline would be the first byte of binary data.
        let length = if carriage_return_ends_lines { 1 } else { line_end_at(bytes, line_end) };
        Ok(PlyHeader { encoding, elements, end: (line_end + length).min(bytes.len()) })
    }
}

fn format(tokens: &mut Tokens) -> Result<Encoding, Fault> {
    match tokens.next_on_line() {
        Some(b"ascii") => Ok(Encoding::Ascii),
        Some(b"binary_little_endian") => Ok(Encoding::LittleEndian),
        Some(b"binary_big_endian") => Ok(Encoding::BigEndian),
        word => {
            let wanted = "ascii, binary_little_endian or binary_big_endian";
            Err(tokens.fault(Defect::Unexpected { found: quote(word.unwrap_or_default()), wanted }))
        }
    }
}

fn element(tokens: &mut Tokens) -> Result<Element, Fault> {
    let name = name(tokens, "the name of an element")?;
    let word = tokens.next_on_line().unwrap_or_default();
    let count = integer(word).and_then(|n| u64::try_from(n).ok());
    let wanted = "the number of elements";
    let count = count.ok_or_else(|| tokens.fault(Defect::NotANumber { token: quote(word), wanted }))?;
    Ok(Element { name, count, properties: Vec::new() })
}

fn property(tokens: &mut Tokens) -> Result<Property, Fault> {
    let kind = match tokens.next_on_line() {
        Some(b"list") => {
            let count = scalar(tokens)?;
            if count.is_float() {
                return Err(tokens.fault(Defect::Unexpected {
                    found: "a fractional type".to_owned(),
                    wanted: "a whole type for the length of a list",
                }));
            }
            PropertyType::List { count, item: scalar(tokens)? }
        }
        word => PropertyType::Scalar(scalar_named(tokens, word)?),
    };
    Ok(Property { name: name(tokens, "the name of a property")?, kind })
}

fn scalar(tokens: &mut Tokens) -> Result<Scalar, Fault> {
    let word = tokens.next_on_line();
    scalar_named(tokens, word)
}

fn scalar_named(tokens: &Tokens, word: Option<&[u8]>) -> Result<Scalar, Fault> {
    let word = word.unwrap_or_default();
    let wanted = "char, uchar, short, ushort, int, uint, float or double";
    Scalar::named(word).ok_or_else(|| tokens.fault(Defect::Unexpected { found: quote(word), wanted }))
}

fn name(tokens: &mut Tokens, wanted: &'static str) -> Result<String, Fault> {
    match tokens.next_on_line() {
        Some(word) => Ok(quote(word)),
        None => Err(tokens.fault(Defect::Unexpected { found: "the line's end".to_owned(), wanted })),
    }
}
