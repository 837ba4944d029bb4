//! Which known name did the user most likely mean?

use super::quote;

/// Letters of a name that are compared: a hostile name of a megabyte costs no more than a short one.
const COMPARED: usize = 64;
/// Known names that are compared; a scene with more has them from a program.
const CANDIDATES: usize = 4096;
/// Known names that are listed where none is near.
const LISTED: usize = 20;

/// The known name that takes the fewest edits to reach from `name` (Damerau-Levenshtein; the first
/// of equals), if they are at most half as many as its letters.
fn nearest<'a>(name: &str, known: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    let name: String = name.chars().take(COMPARED).collect();
    let edits = |candidate: &str| {
        let candidate: String = candidate.chars().take(COMPARED).collect();
        strsim::damerau_levenshtein(&name, &candidate)
    };
    let best = known
        .take(CANDIDATES)
        .map(|candidate| (edits(candidate), candidate))
        .min_by_key(|&(edits, _)| edits);
    best.filter(|&(edits, _)| 2 * edits <= name.chars().count())
        .map(|(_, candidate)| candidate)
}

/// "unknown KIND 'NAME'; the nearest known one is 'X'", or the list of known ones.
pub(crate) fn unknown<'a>(
    kind: &str,
    name: &str,
    known: impl IntoIterator<Item = &'a str>,
) -> String {
    let known: Vec<&str> = known.into_iter().collect();
    let shown = quote::short(name);
    if known.is_empty() {
        return format!("unknown {kind} '{shown}'; there is none here");
    }
    if let Some(near) = nearest(name, known.iter().copied()) {
        let near = quote::short(near);
        return format!("unknown {kind} '{shown}'; the nearest known one is '{near}'");
    }
    let listed = known.iter().take(LISTED);
    let listed: Vec<String> = listed
        .map(|name| format!("'{}'", quote::short(name)))
        .collect();
    let more = match known.len() - listed.len() {
        0 => String::new(),
        more => format!(" and {more} more"),
    };
    format!(
        "unknown {kind} '{shown}'; known are {}{more}",
        listed.join(", ")
    )
}

/// A message of the TOML parser or of serde in the words of this program. A list of expected names
/// ("unknown field `a`, expected one of `b`, `c`") becomes the nearest one; any other message
/// passes, on one line.
pub(super) fn reword(message: &str) -> String {
    for (start, kind) in [("unknown field `", "key"), ("unknown variant `", "value")] {
        if let Some((name, expected)) = message
            .strip_prefix(start)
            .and_then(|rest| rest.split_once('`'))
        {
            // The names stand between backticks: every second piece.
            let known = expected.split('`').skip(1).step_by(2);
            return unknown(kind, name, known);
        }
    }
    // The parser's u64 and i128, which no number of a scene is read from.
    if let Some((number, _)) = message
        .strip_prefix("invalid type: integer `")
        .and_then(|rest| rest.split_once('`'))
        .filter(|(number, _)| number.parse::<i64>().is_err())
    {
        let number = quote::short(number);
        return format!("the integer {number} is too large: write it with a decimal point");
    }
    if ["integer number overflowed", "u64 value was too large"].contains(&message) {
        return "the integer is too large: write it with a decimal point".to_owned();
    }
    // The parser has two words for it: one for tables, without a place, and one for arrays.
    if message.contains("recursion") || message.contains("recurse") {
        return "tables or arrays nest too deep".to_owned();
    }
    quote::message(message)
}
