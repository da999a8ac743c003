//! Definitions of `[let]`: expressions, lists, formulas with an index, and names that `let` gives.

use super::document::{Item, Value};
use super::error::StudyError;
use super::read::{Names, is_name};
use mechaudit_symbolic::{Bound, Expr};

/// Definitions with their items, and the names of lists among them.
type Definitions = (Vec<(String, Item)>, Vec<String>);

/// Definitions, of which a list and a formula with an index stand for several: `a = ["1/2", "3"]`
/// for `a_1` and `a_2`, `a = { is = "1/n", n = [0, 9] }` for `a_0` to `a_9`; and the names that
/// take an index.
pub(super) fn definitions(stated: &[(String, Item)]) -> Result<Definitions, StudyError> {
    let (mut all, mut listed) = (Vec::new(), Vec::new());
    for (name, item) in stated {
        let one = |k: i64, value: Value| {
            let place = item.place;
            (format!("{name}_{k}"), Item { place, value })
        };
        match &item.value {
            Value::List(items) => {
                all.extend((1..).zip(items).map(|(k, x)| one(k, x.value.clone())));
            }
            Value::Table(entries) if index_of(entries).is_some_and(|e| e.1.list().is_ok()) => {
                let (index, range) = index_of(entries).unwrap_or(&entries[0]);
                for k in indices(range)? {
                    let number = Item {
                        place: range.place,
                        value: Value::Number(k.to_string()),
                    };
                    let mut own = entries.clone();
                    own.retain(|e| e.0 != *index);
                    own.push((index.clone(), number));
                    all.push(one(k, Value::Table(own)));
                }
            }
            _ => {
                all.push((name.clone(), item.clone()));
                continue;
            }
        }
        listed.push(name.clone());
    }
    Ok((all, listed))
}

/// The entry of a definition's index: the key that is no other.
fn index_of(entries: &[(String, Item)]) -> Option<&(String, Item)> {
    let known = ["is", "unit", "of"];
    entries.iter().find(|e| !known.contains(&e.0.as_str()))
}

/// The integers from the first number of a range to the second.
fn indices(range: &Item) -> Result<std::ops::RangeInclusive<i64>, StudyError> {
    /// The most definitions of one formula.
    const MOST: i64 = 1000;
    let ends: Result<Vec<Option<i64>>, StudyError> = range
        .list()?
        .iter()
        .map(|end| Ok(end.text()?.parse().ok()))
        .collect();
    match ends?[..] {
        [Some(from), Some(to)] if 0 <= from && from <= to && to < MOST => Ok(from..=to),
        _ => Err(range.fault(format!(
            "an index goes from one integer to another, both from 0 to {}",
            MOST - 1
        ))),
    }
}

impl Names {
    /// A definition: an expression, or a table of it, its unit, the names that `let` gives it where
    /// it is used, and an index with its number.
    pub(super) fn definition(&self, name: &str, item: &Item) -> Result<Expr, StudyError> {
        let Value::Table(entries) = &item.value else {
            return self.expression(item);
        };
        let is = item.get("is");
        let is = is.ok_or_else(|| item.fault(format!("{name} needs is = ...")))?;
        let mut given = Vec::new();
        for name in item.get("of").map_or(Ok(&[][..]), Item::list)? {
            is_name(name.text()?, name)?;
            given.push(name.text()?);
        }
        let Some((index, number)) = index_of(entries) else {
            return self.expression_with(is, &given);
        };
        given.push(index);
        item.only(&["is", "unit", "of", index])?;
        is_name(index, number)?;
        let Value::Number(k) = &number.value else {
            return Err(number.fault(format!("{name} has the unknown key {index:?}")));
        };
        // A sum of one term gives the index its number.
        Ok(Expr::Sum(Box::new(Bound {
            var: index.clone(),
            from: Expr::Num(k.clone()),
            to: Expr::Num(k.clone()),
            body: self.expression_with(is, &given)?,
        })))
    }
}
