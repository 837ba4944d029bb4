//! Which known name did the user most likely mean?

/// Letters of a name that are compared: a hostile name of a megabyte costs no more than a short one.
const COMPARED: usize = 64;

/// The known name that takes the fewest edits to reach from `name` (Damerau-Levenshtein; the first
/// of equals). None where nothing is known.
pub(super) fn nearest<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let name: String = name.chars().take(COMPARED).collect();
    known.into_iter().min_by_key(|candidate| {
        let candidate: String = candidate.chars().take(COMPARED).collect();
        strsim::damerau_levenshtein(&name, &candidate)
    })
}

/// "unknown KIND 'NAME'; the nearest known one is 'X'".
pub(super) fn unknown<'a>(
    kind: &str,
    name: &str,
    known: impl IntoIterator<Item = &'a str>,
) -> String {
    match nearest(name, known) {
        Some(near) => format!("unknown {kind} '{name}'; the nearest known one is '{near}'"),
        None => format!("unknown {kind} '{name}'; there is none here"),
    }
}

/// Rewrites serde's list of expected names ("unknown field `a`, expected one of `b`, `c`") as the
/// nearest one; any other message passes unchanged, on one line.
pub(super) fn shorten(message: &str) -> String {
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
    message.lines().collect::<Vec<_>>().join("; ")
}
