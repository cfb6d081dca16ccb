//! The bytes between the values of a file, which are usually the same as in the previous file.

use super::elements::CleanRole;
use super::members::{Members, UncleanFile, control_count};

/// The gap before each value of the previous files, by the number of the value.
#[derive(Default)]
pub(super) struct Gaps(Vec<Gap>);

/// The bytes before a value: the end of the previous value, a clean name, and white space.
struct Gap {
    spelled: String,
    control_count: usize,
    role: CleanRole,
}

impl Gaps {
    /// Moves to the value with this number and returns its role, or `None` after the last value. Calls `role` with the
    /// name of an element only if the gap has changed.
    pub(super) fn next(
        &mut self,
        number: usize,
        members: &mut Members<'_>,
        role: impl FnOnce(&str) -> Result<CleanRole, UncleanFile>,
    ) -> Result<Option<CleanRole>, UncleanFile> {
        let known = self.0.get_mut(number);
        if let Some(gap) = &known
            && members.pass(&gap.spelled, gap.control_count)
        {
            return Ok(Some(gap.role));
        }
        let Some((name, spelled)) = members.name()? else { return Ok(None) };
        let role = role(name)?;
        let control_count = control_count(spelled.as_bytes());
        match known {
            Some(gap) => {
                spelled.clone_into(&mut gap.spelled);
                (gap.control_count, gap.role) = (control_count, role);
            }
            None => self.0.push(Gap { spelled: spelled.to_owned(), control_count, role }),
        }
        Ok(Some(role))
    }
}
