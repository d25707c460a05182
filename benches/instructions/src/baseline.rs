//! The kept counts: their text, and how others differ from them.

use std::collections::BTreeSet;
use std::fmt::{self, Display};
use std::str::FromStr;

use crate::conditions::Conditions;
use crate::counts::Counts;

/// How far a count may be from the kept one, up or down.
pub(crate) const TOLERANCE_PERCENT: u64 = 2;

/// Counts, and the conditions they were counted under.
///
/// As text: a line is a name and a value with a tab between them, or a comment after `#`. Conditions come first, then an
/// empty line, then the counts.
#[derive(PartialEq, Eq, Debug)]
pub(crate) struct Baseline {
    pub(crate) conditions: Conditions,
    pub(crate) counts: Counts,
}

impl Baseline {
    /// Which conditions are others here, in words.
    pub(crate) fn other_conditions(&self, here: &Conditions) -> Vec<String> {
        let kept = |name: &str| self.conditions.get(name).map_or("", String::as_str);
        let others = here.iter().filter(|(name, value)| kept(name) != *value);
        others.map(|(name, value)| format!("{name}: `{}` in the baseline, `{value}` here", kept(name))).collect()
    }

    /// Which counts are further from the kept ones than allowed, or stand on one side only, in words.
    pub(crate) fn changes(&self, now: &Counts) -> Vec<String> {
        let stages: BTreeSet<_> = self.counts.keys().chain(now.keys()).collect();
        let change = |stage: &String| match (self.counts.get(stage), now.get(stage)) {
            (Some(kept), Some(now)) if 100 * kept.abs_diff(*now) <= TOLERANCE_PERCENT * kept => None,
            (Some(kept), Some(now)) => {
                let percent = 100.0 * (*now as f64 / *kept as f64 - 1.0);
                Some(format!("{stage}: {kept} instructions in the baseline, {now} now, {percent:+.1} %"))
            }
            (Some(_), None) => Some(format!("{stage}: in the baseline, but not counted now")),
            (None, _) => Some(format!("{stage}: counted now, but not in the baseline")),
        };
        stages.into_iter().filter_map(change).collect()
    }
}

impl Display for Baseline {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "# Instructions by stage, and what they were counted with. Written by: cargo run -p instructions -- move"
        )?;
        self.conditions.iter().try_for_each(|(name, value)| writeln!(f, "{name}\t{value}"))?;
        writeln!(f)?;
        self.counts.iter().try_for_each(|(stage, count)| writeln!(f, "{stage}\t{count}"))
    }
}

impl FromStr for Baseline {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (conditions, counts) = text.split_once("\n\n").ok_or("no empty line between conditions and counts")?;
        let pair = |line: &str| {
            let (name, value) = line.split_once('\t').ok_or_else(|| format!("no tab in `{line}`"))?;
            Ok((name.to_string(), value.to_string()))
        };
        let count = |line: &str| {
            let (stage, count) = pair(line)?;
            Ok((stage, count.parse().map_err(|_| format!("no count in `{line}`"))?))
        };
        Ok(Self {
            conditions: conditions
                .lines()
                .filter(|line| !line.starts_with('#'))
                .map(pair)
                .collect::<Result<_, String>>()?,
            counts: counts.lines().map(count).collect::<Result<_, String>>()?,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn kept() -> Baseline {
        "# what it is\ncompiler\trustc 1\nvalgrind\t3\n\nbuild/torus\t1000\nread/off\t50\n".parse().unwrap()
    }

    #[test]
    fn text_and_baseline_are_the_same() {
        assert_eq!(kept().counts["read/off"], 50);
        assert_eq!(kept().to_string().parse(), Ok(kept()));
        let error = |text: &str| text.parse::<Baseline>().unwrap_err();
        assert_eq!(error("compiler\t1\n"), "no empty line between conditions and counts");
        assert_eq!(error("compiler 1\n\n"), "no tab in `compiler 1`");
        assert_eq!(error("compiler\t1\n\nread\tmany"), "no count in `read\tmany`");
    }

    #[test]
    fn other_conditions_are_told() {
        let mut here = kept().conditions;
        assert!(kept().other_conditions(&here).is_empty());
        here.insert("valgrind".into(), String::new());
        here.insert("libc".into(), "glibc".into());
        let told = ["libc: `` in the baseline, `glibc` here", "valgrind: `3` in the baseline, `` here"];
        assert_eq!(kept().other_conditions(&here), told);
    }

    #[test]
    fn two_percent_pass_and_more_fails() {
        let changes = |counts: &[(&str, u64)]| {
            kept().changes(&counts.iter().map(|&(stage, count)| (stage.to_string(), count)).collect())
        };
        for allowed in [980, 1000, 1020] {
            assert!(changes(&[("build/torus", allowed), ("read/off", 50)]).is_empty(), "{allowed}");
        }
        let told = |now, percent| [format!("build/torus: 1000 instructions in the baseline, {now} now, {percent} %")];
        assert_eq!(changes(&[("build/torus", 1021), ("read/off", 50)]), told(1021, "+2.1"));
        assert_eq!(changes(&[("build/torus", 979), ("read/off", 50)]), told(979, "-2.1"));
        let told = ["disk: counted now, but not in the baseline", "read/off: in the baseline, but not counted now"];
        assert_eq!(changes(&[("build/torus", 1000), ("disk", 1)]), told);
    }
}
