//! The format: pairs of a code and a value in lines, sections, handles.
//!
//! The file has all that R2007 asks for: tables with one entry each, the blocks of model space and
//! paper space, a root dictionary. Handles below [`LAYERS`] belong to these.

use super::DECIMALS;
use std::fmt::{Display, Write};

/// Handle of the block record that entities of the drawing belong to.
const MODEL_SPACE: u32 = 0x1F;
/// Handle of the first layer; those of the others and of the entities follow.
const LAYERS: u32 = 0x100;

/// Pairs in the order of the file, and the next handle of an entity.
#[derive(Default)]
pub(super) struct Writer {
    text: String,
    handle: u32,
}

impl Writer {
    /// For entities, whose handles follow those of the layers.
    pub(super) fn beyond(layers: usize) -> Writer {
        Writer {
            text: String::new(),
            handle: LAYERS + 1 + layers as u32,
        }
    }

    pub(super) fn pair(&mut self, code: u32, value: impl Display) {
        write!(self.text, "{code:>3}\r\n{value}\r\n").expect("a string");
    }

    /// A number without needless zeros.
    pub(super) fn number(&mut self, code: u32, x: f64) {
        let text = format!("{x:.*}", DECIMALS as usize);
        let text = text.trim_end_matches('0');
        let zero = if text.ends_with('.') { "0" } else { "" };
        self.pair(code, format_args!("{text}{zero}"));
    }

    /// The coordinates of the point of that number, in the plane z = 0.
    pub(super) fn point(&mut self, number: u32, [x, y]: [f64; 2]) {
        self.number(10 + number, x);
        self.number(20 + number, y);
        self.number(30 + number, 0.0);
    }

    /// Begins an entity of model space.
    pub(super) fn entity(&mut self, kind: &str, layer: &str, class: &str) {
        let handle = self.handle;
        self.object(kind, handle, MODEL_SPACE);
        self.handle += 1;
        self.pair(100, "AcDbEntity");
        self.pair(8, layer);
        self.pair(100, class);
    }

    /// Begins what has a handle and an owner.
    fn object(&mut self, kind: &str, handle: u32, owner: u32) {
        self.pair(0, kind);
        self.pair(5, format_args!("{handle:X}"));
        self.pair(330, format_args!("{owner:X}"));
    }

    fn section(&mut self, name: &str, body: impl FnOnce(&mut Writer)) {
        self.pair(0, "SECTION");
        self.pair(2, name);
        body(self);
        self.pair(0, "ENDSEC");
    }

    /// A table with that handle and its entries: for each a handle, a name, and what follows.
    fn table(&mut self, name: &str, handle: u32, class: &str, entries: &[Entry]) {
        self.pair(0, "TABLE");
        self.pair(2, name);
        self.pair(5, format_args!("{handle:X}"));
        self.pair(330, 0);
        self.pair(100, "AcDbSymbolTable");
        self.pair(70, entries.len());
        for (handle_of_entry, label, rest) in entries {
            self.object(name, *handle_of_entry, handle);
            self.pair(100, "AcDbSymbolTableRecord");
            self.pair(100, class);
            self.pair(2, label);
            rest.iter()
                .for_each(|(code, value)| self.pair(*code, value));
        }
        self.pair(0, "ENDTAB");
    }

    /// The block of a record, without entities of its own.
    fn block(&mut self, name: &str, record: u32, handle: u32) {
        for (k, (kind, class)) in [("BLOCK", "AcDbBlockBegin"), ("ENDBLK", "AcDbBlockEnd")]
            .into_iter()
            .enumerate()
        {
            self.object(kind, handle + k as u32, record);
            self.pair(100, "AcDbEntity");
            self.pair(8, 0);
            self.pair(100, class);
            if k == 0 {
                self.pair(2, name);
                self.pair(70, 0);
                self.point(0, [0.0; 2]);
                self.pair(3, name);
                self.pair(1, "");
            }
        }
    }
}

/// Handle, name, and pairs of an entry of a table.
type Entry<'a> = (u32, &'a str, Vec<(u32, String)>);

fn pairs(of: &[(u32, &str)]) -> Vec<(u32, String)> {
    of.iter()
        .map(|(code, value)| (*code, value.to_string()))
        .collect()
}

/// The file in a unit of that number.
pub(super) fn whole(unit: u32, layers: &[(String, u8)], entities: &Writer) -> Vec<u8> {
    let mut out = Writer::default();
    out.section("HEADER", |out| {
        for (name, code, value) in [
            ("$ACADVER", 1, "AC1021".to_string()),
            ("$HANDSEED", 5, format!("{:X}", entities.handle)),
            ("$INSUNITS", 70, unit.to_string()),
        ] {
            out.pair(9, name);
            out.pair(code, value);
        }
    });
    out.section("TABLES", |out| tables(out, layers));
    out.section("BLOCKS", |out| {
        out.block("*Model_Space", MODEL_SPACE, 0x20);
        out.block("*Paper_Space", 0x1B, 0x1C);
    });
    out.section("ENTITIES", |out| out.text += &entities.text);
    out.section("OBJECTS", |out| {
        for (handle, owner) in [(0xC, 0), (0xD, 0xC)] {
            out.object("DICTIONARY", handle, owner);
            out.pair(100, "AcDbDictionary");
            out.pair(281, 1);
            if owner == 0 {
                out.pair(3, "ACAD_GROUP");
                out.pair(350, "D");
            }
        }
    });
    out.pair(0, "EOF");
    out.text.into_bytes()
}

fn tables(out: &mut Writer, layers: &[(String, u8)]) {
    out.table("VPORT", 0x8, "AcDbViewportTableRecord", &[]);
    let solid = pairs(&[(70, "0"), (3, ""), (72, "65"), (73, "0"), (40, "0.0")]);
    let types = [(0x14, "ByBlock"), (0x15, "ByLayer"), (0x16, "Continuous")];
    let types = types.map(|(handle, name)| (handle, name, solid.clone()));
    out.table("LTYPE", 0x5, "AcDbLinetypeTableRecord", &types);
    let named = layers.iter().map(|(name, colour)| (name.as_str(), *colour));
    let all = [("0", 7)].into_iter().chain(named);
    let entries: Vec<Entry> = all
        .enumerate()
        .map(|(k, (name, colour))| {
            let rest = vec![
                (70, "0".to_string()),
                (62, colour.to_string()),
                (6, "Continuous".to_string()),
            ];
            (LAYERS + k as u32, name, rest)
        })
        .collect();
    out.table("LAYER", 0x2, "AcDbLayerTableRecord", &entries);
    let style = pairs(&[
        (70, "0"),
        (40, "0.0"),
        (41, "1.0"),
        (50, "0.0"),
        (71, "0"),
        (42, "2.5"),
        (3, "txt"),
        (4, ""),
    ]);
    out.table(
        "STYLE",
        0x3,
        "AcDbTextStyleTableRecord",
        &[(0x11, "Standard", style)],
    );
    out.table("VIEW", 0x6, "AcDbViewTableRecord", &[]);
    out.table("UCS", 0x7, "AcDbUCSTableRecord", &[]);
    let application = pairs(&[(70, "0")]);
    out.table(
        "APPID",
        0x9,
        "AcDbRegAppTableRecord",
        &[(0x12, "ACAD", application)],
    );
    out.table("DIMSTYLE", 0xA, "AcDbDimStyleTable", &[]);
    let record = pairs(&[(340, "0")]);
    let records = [
        (MODEL_SPACE, "*Model_Space", record.clone()),
        (0x1B, "*Paper_Space", record),
    ];
    out.table("BLOCK_RECORD", 0x1, "AcDbBlockTableRecord", &records);
}
