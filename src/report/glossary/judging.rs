//! Columns of audits and of everything else that is judged.

use super::{Topic, column};

#[rustfmt::skip]
pub const AUDIT: Topic = Topic {
    key: "audit",
    title: "Columns of an audit",
    columns: &[
        column("method | candidate", "", "method of the program, and the code that was judged"),
        column("region | output", "", "part of the domain and output; `all` stands for all of them"),
        column("budget", "", "error that is allowed"),
        column("cases | passed | over", "", "cases, those that pass, those over budget"),
        column("failed", "", "cases that do not pass, for whatever reason"),
        column("recorded", "", "cases over budget by no more than is recorded"),
        column("undecided", "", "cases that the reference could not decide"),
        column("reference_failed", "", "cases at which the reference failed"),
        column("verdict", "", "pass, or why not"),
        column("values", "", "numbers with an error"),
        column("wrong kind | wrong", "", "answers of the wrong kind: NaN, a refusal, no answer, …"),
        column("p99 | p99_ulps", "ulps", "error that 99 of 100 do not exceed"),
        column("median | median_ulps", "ulps", "error that half of them do not exceed"),
        column("RMS | rms_ulps", "ulps", "root mean square of the errors"),
        column("beyond_ulps", "", "errors that no number of ulps in a double holds"),
        column("worst_ulps | * ulps | ulps", "ulps", "largest error found"),
        column("u(1+cond) | worst_u(1+cond) | *_u_1_plus_cond", "",
            "error in multiples of u(1 + condition), what a backward stable code reaches"),
        column("norm, u | *_normwise_u", "u",
            "norm of the errors of all outputs together over the norm of the outputs"),
        column("of_budget | max_of_budget | worst_output_of_budget", "",
            "largest error over the error allowed, and the output that has it: above 1 it fails"),
        column("condition | worst_condition | max_condition", "",
            "largest condition number met: relative change of the output over that of the input"),
        column("input | unit | decimal | hexadecimal", "", "numbers of the case, in both forms"),
        column("due | reference | got", "", "certified value, and the answer of the code"),
        column("case", "", "opens the case with all that is known of it"),
        column("reason, or the command", "", "why it fails, and the command that judges it again"),
        column("regions: worst share of the budget", "", "a cell for each region"),
        column("interrupted | seed | cases_per_region", "", "the run: ended early, its seed, its size"),
        column("reproduce_worst", "", "command that judges the worst case again"),
        column("nan | infinity", "", "answers NaN or infinite where a number is due"),
        column("finite | wrong_zero", "", "numbers where infinity is due; zeros of the wrong sign"),
        column("refusal | value", "", "refusals where values are due, and the reverse"),
        column("missing | unreadable | unanswered", "", "answers without values, unreadable, or none"),
    ],
};

#[rustfmt::skip]
pub const CAMPAIGN: Topic = Topic {
    key: "campaign",
    title: "Columns of a campaign",
    columns: &[
        column("part", "", "part of the plan"),
        column("hunts | evaluations | failures", "", "hunts done, cases judged in them, cases that fail"),
        column("output", "", "output that the hunt was for"),
        column("of budget", "", "largest error found over the error allowed"),
        column("found | again", "", "the worst input and the command that judges it again"),
        column("formula", "", "formula of the solver"),
        column("boxes | open", "", "boxes of the proof, and those that are not proved"),
        column("norm", "2⁻⁵²", "proved bound on the error of the norm"),
        column("Re | Im", "ulps", "proved bounds on the errors of the parts"),
    ],
};

#[rustfmt::skip]
pub const COMPARISON: Topic = Topic {
    key: "compare",
    title: "Columns of a comparison",
    columns: &[
        column("method | region", "", "method and part of its domain"),
        column("candidate | code | what it is", "", "code that was judged"),
        column("verdict", "", "pass, or why not"),
        column("best", "", "whether no other code does better in the region"),
        column("cases | failed | wrong", "", "cases, those that fail, those of the wrong kind"),
        column("of_budget | *_of_budget", "", "largest error over the error allowed"),
        column("times_the_best", "", "that share over the share of the best code"),
        column("worst_ulps | rms_ulps", "ulps", "largest error found, and the root mean square"),
        column("ns_per_answer | ns an answer", "ns", "time an answer"),
        column("start_up_ms | start-up, ms", "ms", "time until the first answer"),
        column("change | of | figure", "", "better or worse, of which code, and which figure"),
        column("output", "", "output that has changed"),
        column("before | now", "", "the figure in the baseline and in this run"),
    ],
};

#[rustfmt::skip]
pub const CONVERGENCE: Topic = Topic {
    key: "converge",
    title: "Columns of a convergence",
    columns: &[
        column("total", "", "error of the result"),
        column("method", "", "part of it that exact arithmetic would have"),
        column("rounding", "", "part of it that is due to rounding"),
        column("order", "", "order between this level and the one before"),
        column("Richardson", "", "order that three levels show without the reference"),
    ],
};

#[rustfmt::skip]
pub const PAPER: Topic = Topic {
    key: "paper",
    title: "Columns of a paper's tables",
    columns: &[
        column("table | row | column", "", "place of a printed number"),
        column("printed | recomputed", "", "the number as printed, and the certified one"),
        column("variant | data", "", "data that it is recomputed from"),
        column("deviation", "", "printed less recomputed, as a bar"),
        column("verdict", "", "agrees, rounding, misprint or unexplained"),
        column("units_in_last_digit | deviations by row, ±2 units", "",
            "deviation in the last printed digit"),
        column("entries", "", "printed numbers of the column"),
        column("within ½ | within 1 | within_½_unit", "", "of them off by at most half a unit, one unit"),
        column("worst_units | worst_deviation", "", "the largest deviation in units, and itself"),
    ],
};

#[rustfmt::skip]
pub const PUBLISHED: Topic = Topic {
    key: "judge",
    title: "Columns of a judged table",
    columns: &[
        column("line | output", "", "line of the file, and output"),
        column("printed | reference", "", "the entry, and the certified value"),
        column("units off", "", "their difference in the last printed digit"),
    ],
};

#[rustfmt::skip]
pub const PROOF: Topic = Topic {
    key: "prove",
    title: "Columns of a proof",
    columns: &[
        column("formula", "", "formula of the solver"),
        column("boxes | intervals", "", "parts that its domain is cut into"),
        column("norm", "2⁻⁵²", "bound on the error of the norm"),
        column("Re | Im", "ulps", "bounds on the errors of the parts"),
        column("C", "ulps", "bound on the error of a real function"),
        column("from | to | attained in", "", "the ends of its range; the part with the largest bound"),
    ],
};

#[rustfmt::skip]
pub const DESCRIBE: Topic = Topic {
    key: "describe",
    title: "Columns of a description",
    columns: &[
        column("input | output", "", "name of an input or output"),
        column("length | unit | note", "", "how many numbers it has, their unit, what they have to fulfil"),
        column("budget", "", "error that is allowed"),
    ],
};

#[rustfmt::skip]
pub const HARD: Topic = Topic {
    key: "hunt",
    title: "Columns of hard cases",
    columns: &[
        column("of budget | found", "", "worst error over the error allowed, and how it was found"),
        column("share", "", "error over the error allowed when it was found, rounded up"),
        column("output", "", "output that has it"),
        column("reason", "", "why the case is recorded"),
        column("input", "", "hexadecimal floats, separated by blanks"),
    ],
};

#[rustfmt::skip]
pub const VALUES: Topic = Topic {
    key: "values",
    title: "Columns of reference/values",
    columns: &[
        column("region | case", "", "part of the domain, and number of the case in it"),
        column("input", "", "hexadecimal floats, separated by blanks"),
        column("value | radius", "", "certified value, and a bound on its error"),
        column("condition", "", "condition number of the value"),
    ],
};
