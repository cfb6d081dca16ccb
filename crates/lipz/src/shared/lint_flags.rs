//! `--allow`, `--warn` and `--deny`: levels of lints, in the order of the command line.

use clap::{Arg, ArgAction, ArgMatches, Args, Command, Error, FromArgMatches};
use lipz_compiler::Options;
use lipz_compiler::settings::lint::{LEVELS, Selection, refusal, suggestion};
use lipz_diagnostics::Severity;

/// Levels with the lints that they apply to. Later ones take precedence.
#[derive(Clone, Debug, Default)]
pub(crate) struct LintFlags(Vec<(Selection, Option<Severity>)>);

impl LintFlags {
    /// Whether the command line sets a level.
    pub(crate) fn is_used(&self) -> bool {
        !self.0.is_empty()
    }

    /// Overrides the levels of the project.
    pub(crate) fn apply(&self, options: &mut Options) {
        for (selection, level) in &self.0 {
            selection.codes().into_iter().for_each(|code| options.overrule(code, *level));
        }
    }
}

/// Implemented by hand, because derived arguments do not record their order across flags.
impl FromArgMatches for LintFlags {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, Error> {
        let mut flags = LintFlags::default();
        flags.update_from_arg_matches(matches)?;
        Ok(flags)
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), Error> {
        let mut found = Vec::new();
        for (name, level) in LEVELS {
            let selections = matches.get_many::<Selection>(name).into_iter().flatten().cloned();
            let places = matches.indices_of(name).into_iter().flatten();
            found.extend(places.zip(selections).map(|(place, selection)| (place, selection, level)));
        }
        found.sort_by_key(|(place, ..)| *place);
        self.0.extend(found.into_iter().map(|(_, selection, level)| (selection, level)));
        Ok(())
    }
}

impl Args for LintFlags {
    fn augment_args(command: Command) -> Command {
        LEVELS.into_iter().fold(command, |command, (name, level)| {
            let help = match level {
                None => "Do not report a lint, by name or code: unknown-emotion, LZ0702",
                Some(Severity::Warning) => "Report a lint as a warning",
                Some(Severity::Error) => "Report a lint as an error; `warnings` means all warnings",
            };
            let flag = Arg::new(name).long(name).value_name("LINT").action(ArgAction::Append).help(help);
            let parse = move |text: &str| parse(text, level);
            command.arg(flag.value_delimiter(',').value_parser(parse).help_heading("Lints"))
        })
    }

    fn augment_args_for_update(command: Command) -> Command {
        LintFlags::augment_args(command)
    }
}

fn parse(text: &str, level: Option<Severity>) -> Result<Selection, String> {
    let selection = Selection::named(text).ok_or_else(|| match suggestion(text) {
        Some(known) => format!("the lint does not exist; did you mean `{known}`?"),
        None => "the lint does not exist; diagnostics show their code in brackets: LZ0702".to_owned(),
    })?;
    match &selection {
        Selection::One(code) => match refusal(*code, level) {
            Some(why) => Err(format!("an error that cannot be lowered: {why}")),
            None => Ok(selection),
        },
        Selection::Warnings => Ok(selection),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lipz_diagnostics::Code;

    #[test]
    fn later_flags_win() {
        let command = LintFlags::augment_args(Command::new("lipz"));
        let words = "lipz --allow LZ0702 --deny warnings,segment-count --warn LZ0601 --allow unknown-locale";
        let matches = command.try_get_matches_from(words.split(' ')).unwrap();
        let mut options = Options::new();
        LintFlags::from_arg_matches(&matches).unwrap().apply(&mut options);
        assert_eq!(options.get_levels().severity(Code::UnknownEmotion), Some(Severity::Error));
        assert_eq!(options.get_levels().severity(Code::SegmentCount), Some(Severity::Warning));
        assert_eq!(options.get_levels().severity(Code::UnknownLocale), None);
    }
}
