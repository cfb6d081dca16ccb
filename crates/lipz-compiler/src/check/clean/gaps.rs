//! What stands between the values of files: usually just what stood there in the file before.

use super::elements::Role;
use super::members::{Members, Unclean, control_count};

/// What stood before each value of the last files, by place.
#[derive(Default)]
pub(super) struct Gaps(Vec<Gap>);

/// What stood before a value: the end of the one before it, a clean name, and white space.
struct Gap {
    spelled: String,
    control_count: usize,
    role: Role,
}

impl Gaps {
    /// Goes to the value with this number; its role, or `None` behind the last one. `role` is asked for that of a name.
    pub(super) fn next(
        &mut self,
        number: usize,
        members: &mut Members<'_>,
        role: impl FnOnce(&str) -> Result<Role, Unclean>,
    ) -> Result<Option<Role>, Unclean> {
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
