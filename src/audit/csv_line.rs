//! Lines of CSV files.

/// The line, counted from 1, of the record or header that a CSV reader began to look for at `from`:
/// comments (`#`) and empty lines may come first.
pub fn csv_line(text: &[u8], from: &csv::Position) -> u64 {
    let mut line = from.line();
    let mut comment = false;
    for byte in text.iter().skip(from.byte() as usize) {
        match byte {
            b'\n' => {
                line += 1;
                comment = false;
            }
            b'\r' => {}
            b'#' => comment = true,
            _ if comment => {}
            _ => break,
        }
    }
    line
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_and_empty_lines_are_counted() {
        let text = "# head\n\na,b\n1,2\n\n# a\n# b, c\n4,5#\n#\n\n#\n\n1,1";
        for end in ["\n", "\r\n"] {
            let text = text.replace('\n', end);
            let mut reader = csv::ReaderBuilder::new()
                .comment(Some(b'#'))
                .from_reader(text.as_bytes());
            let records = reader.records().map(Result::unwrap);
            let lines = records.map(|r| csv_line(text.as_bytes(), r.position().unwrap()));
            assert_eq!(lines.collect::<Vec<_>>(), [4, 8, 13], "{end:?}");
        }
        assert_eq!(csv_line(b"#a\n#b\nx,y", &csv::Position::new()), 3);
    }
}
