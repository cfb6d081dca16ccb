//! Detection of objects that do not belong together.

use super::linked_object::LinkedObject;
use super::plan::MAKER;
use crate::files::path::display;
use lipz_diagnostics::{Code, Report, escape};

/// Returns reports about objects, sorted by shard, that do not belong together.
pub(super) fn misfits(objects: &[LinkedObject]) -> Vec<Report> {
    let Some(first) = objects.first() else { return Vec::new() };
    let mut reports = Vec::new();
    let mut refuse = |object: &LinkedObject, message: String, help: &str| {
        reports.push(Report::failure(display(&object.path), Code::ObjectMisfit, message, help));
    };
    for object in objects {
        let (one, other) = (&object.export, &first.export);
        let name = display(&first.path);
        let help = "pack all shards of one plan with one version of lipz";
        if one.lipz != MAKER {
            let (theirs, own) = (escape::text(&one.lipz).into_owned(), MAKER);
            refuse(object, format!("the object was made by lipz {theirs}, but this is lipz {own}"), help);
        } else if one.shards != other.shards || one.shard >= one.shards {
            let message =
                format!("the object is shard {} of {}, but `{name}` is one of {}", one.shard, one.shards, other.shards);
            refuse(object, message, help);
        } else if one.options != other.options || one.settings != other.settings {
            refuse(object, format!("the object and `{name}` were made with different settings"), help);
        }
    }
    if !reports.is_empty() {
        return reports;
    }
    let mut expected = 0;
    let mut missing = Vec::new();
    for object in objects {
        let shard = object.export.shard;
        if shard < expected {
            reports.push(Report::failure(
                display(&object.path),
                Code::ObjectMisfit,
                format!("shard {shard} appears twice"),
                "name each object once",
            ));
            continue;
        }
        missing.extend(expected..shard);
        expected = shard + 1;
    }
    missing.extend(expected..first.export.shards);
    if !missing.is_empty() {
        let shown: Vec<String> = missing.iter().take(10).map(u16::to_string).collect();
        let more = if missing.len() > shown.len() {
            format!(" and {} more", missing.len() - shown.len())
        } else {
            String::new()
        };
        let what = if missing.len() == 1 { "the object of shard" } else { "the objects of shards" };
        let message = format!(
            "{what} {}{more} of {} missing",
            shown.join(", "),
            if missing.len() == 1 {
                format!("{} is", first.export.shards)
            } else {
                format!("{} are", first.export.shards)
            }
        );
        reports.push(Report::failure("", Code::ObjectMissing, message, "name the objects of all shards"));
    }
    reports
}
