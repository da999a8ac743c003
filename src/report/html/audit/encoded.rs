//! Errors of a map as one character each: what a colour and a reading need, in a hundredth of the
//! room.

use crate::audit::ErrorMap;
use serde::Serialize;

/// Sixty-four levels; the script finds a level by its place here.
pub const LEVELS: &str = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";
/// Level 1 is up to 2⁻⁵ ulps; each further one a quarter of an octave.
const FIRST: f64 = -5.0;
const PER_OCTAVE: f64 = 4.0;

/// Names, then runs of cells: the number of a name and how many cells have it.
type Runs = (Vec<String>, Vec<(usize, usize)>);

/// An error map.
#[derive(Serialize)]
pub struct Map<'a> {
    columns: usize,
    rows: usize,
    corner: [f64; 2],
    side: f64,
    /// Where the columns and the rows were judged.
    at: [Vec<f64>; 2],
    /// For each output, rows from below.
    outputs: Vec<(&'a str, String)>,
    /// Upper end of each level in ulps; nothing for "no number".
    ends: Vec<Option<f64>>,
    levels: &'a str,
    /// The formula of each cell, where the method tells.
    branches: Option<Runs>,
}

fn level(ulps: f64) -> usize {
    if ulps.is_nan() {
        return 0;
    }
    let quarter = ((ulps.log2() - FIRST) * PER_OCTAVE).ceil();
    1 + quarter.clamp(0.0, (LEVELS.len() - 2) as f64) as usize
}

fn end(level: usize) -> Option<f64> {
    let end = ((level as f64 - 1.0) / PER_OCTAVE + FIRST).exp2();
    // All that is beyond is in the last.
    (level > 0).then_some(if level + 1 == LEVELS.len() {
        f64::MAX
    } else {
        end
    })
}

impl<'a> Map<'a> {
    /// Of a map, with the formulas that the method of that name uses.
    pub fn of(map: &'a ErrorMap, method: &str) -> Map<'a> {
        let letter = |k: usize| char::from(LEVELS.as_bytes()[k]);
        let outputs = map.outputs.iter();
        let outputs = outputs.map(|o| (o.name, o.ulps.iter().map(|u| letter(level(*u))).collect()));
        Map {
            columns: map.columns,
            rows: map.rows,
            corner: map.corner,
            side: map.side,
            at: [
                (0..map.columns).map(|c| map.at(c, 0)[0]).collect(),
                (0..map.rows).map(|r| map.at(0, r)[1]).collect(),
            ],
            outputs: outputs.collect(),
            ends: (0..LEVELS.len()).map(end).collect(),
            levels: LEVELS,
            branches: branches(map, method),
        }
    }
}

/// The formula at the point of each cell.
fn branches(map: &ErrorMap, method: &str) -> Option<Runs> {
    let method = crate::methods::find(method)?;
    let mut names: Vec<String> = Vec::new();
    let mut runs: Vec<(usize, usize)> = Vec::new();
    for row in 0..map.rows {
        for column in 0..map.columns {
            let name = method.branch(&map.at(column, row))?.branch?;
            let k = names.iter().position(|n| *n == name);
            let k = k.unwrap_or_else(|| {
                names.push(name);
                names.len() - 1
            });
            match runs.last_mut() {
                Some((of, n)) if *of == k => *n += 1,
                _ => runs.push((k, 1)),
            }
        }
    }
    Some((names, runs))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_error_is_within_its_level() {
        assert_eq!(
            (level(f64::NAN), level(0.0), level(f64::INFINITY)),
            (0, 1, 63)
        );
        for ulps in [1e-9, 0.03125, 0.1, 0.5, 1.0, 1.1, 3.999, 4.0, 700.0, 1e300] {
            let k = level(ulps);
            assert!(ulps <= end(k).unwrap(), "{ulps}");
            assert!(k == 1 || ulps > end(k - 1).unwrap(), "{ulps}");
        }
    }

    /// Each level is a quarter of an octave, the first up to 2⁻⁵ ulps.
    #[test]
    fn levels_end_at_quarters_of_octaves() {
        for (ulps, due) in [
            (0.031_25, 1),
            (0.031_26, 2),
            (1.0, 21),
            (1.1, 22),
            (2f64.powf(10.25), 62),
            (2f64.powf(10.26), 63),
            (1e9, 63),
        ] {
            assert_eq!(level(ulps), due, "{ulps}");
        }
        assert_eq!((end(0), end(1), end(21)), (None, Some(0.031_25), Some(1.0)));
        assert_eq!((end(62), end(63)), (Some(2f64.powf(10.25)), Some(f64::MAX)));
    }

    #[test]
    fn a_map_has_a_letter_for_each_cell_and_runs_of_formulas() {
        let ulps = vec![f64::NAN, 0.0, 1.0, f64::INFINITY, 0.5, 0.01];
        let map = ErrorMap {
            columns: 3,
            rows: 2,
            corner: [-9.0, -6.5],
            side: 6.0,
            outputs: vec![crate::audit::MapOutput { name: "Re W", ulps }],
            not_passed: 0,
        };
        let written = serde_json::to_value(Map::of(&map, "faddeeva")).unwrap();
        // Nothing, nought, 2^0 and all that is beyond; 2^-1 is four levels before 2^0.
        assert_eq!(written["outputs"][0][1], "ABV_RB");
        assert_eq!(
            (&written["columns"], &written["rows"]),
            (&3.into(), &2.into())
        );
        assert_eq!(written["ends"].as_array().unwrap().len(), 64);
        let at = |k: usize, n: usize| written["at"][k][n].as_f64().unwrap();
        for (k, n) in [(0, 3), (1, 2)] {
            assert_eq!(written["at"][k].as_array().unwrap().len(), n);
            for i in 1..n {
                assert!((at(k, i) - at(k, i - 1) - 6.0).abs() < 1e-12);
            }
            assert!((map.corner[k]..map.corner[k] + 6.0).contains(&at(k, 0)));
        }
        let (names, runs) = branches(&map, "faddeeva").unwrap();
        let method = crate::methods::find("faddeeva").unwrap();
        let due = (0..6).map(|k| {
            method
                .branch(&map.at(k % 3, k / 3))
                .unwrap()
                .branch
                .unwrap()
        });
        let seen = runs.iter().flat_map(|(k, n)| vec![names[*k].clone(); *n]);
        assert!(seen.eq(due), "{names:?} {runs:?}");
        assert!(runs.windows(2).all(|w| w[0].0 != w[1].0), "{runs:?}");
        let mut sorted = names.clone();
        sorted.sort();
        sorted.dedup();
        assert!(sorted.len() == names.len() && names.len() > 1, "{names:?}");
        assert!(branches(&map, "four-bar").is_none() && branches(&map, "none").is_none());
    }
}
