//! Writing of a TextGrid in Praat's long text form.

use super::TextGrid;
use crate::Time;
use std::fmt::Write;

impl TextGrid {
    /// Returns the file, in UTF-8.
    pub fn write(&self) -> String {
        let mut file = String::from("File type = \"ooTextFile\"\nObject class = \"TextGrid\"\n\n");
        let (start, end) = (seconds(self.start), seconds(self.end));
        // Writing to a string cannot fail.
        let _ =
            writeln!(file, "xmin = {start} \nxmax = {end} \ntiers? <exists> \nsize = {} \nitem []: ", self.tiers.len());
        for (number, tier) in (1..).zip(&self.tiers) {
            let (class, what) = if tier.has_points { ("TextTier", "points") } else { ("IntervalTier", "intervals") };
            let _ = writeln!(file, "    item [{number}]:\n        class = \"{class}\" ");
            let _ = writeln!(
                file,
                "        name = {} \n        xmin = {start} \n        xmax = {end} ",
                quoted(&tier.name)
            );
            let _ = writeln!(file, "        {what}: size = {} ", tier.intervals.len());
            for (number, interval) in (1..).zip(&tier.intervals) {
                let (from, to, label) = (seconds(interval.start), seconds(interval.end), quoted(&interval.label));
                let _ = writeln!(file, "        {what} [{number}]:");
                let _ = match tier.has_points {
                    true => writeln!(file, "            number = {from} \n            mark = {label} "),
                    false => {
                        writeln!(
                            file,
                            "            xmin = {from} \n            xmax = {to} \n            text = {label} "
                        )
                    }
                };
            }
        }
        file
    }
}

/// Returns seconds with all digits needed to read the same number.
fn seconds(time: Time) -> String {
    time.as_f64().to_string()
}

fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('"', "\"\""))
}
