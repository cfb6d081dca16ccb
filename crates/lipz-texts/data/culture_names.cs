// Prints data/culture_names.tsv without its first line: `mcs culture_names.cs && mono culture_names.exe` (Debian's mono-mcs).
using System;
using System.Globalization;
using System.Linq;

class CultureNames {
    static void Main() {
        var cultures = CultureInfo.GetCultures(CultureTypes.AllCultures).Where(culture => culture.Name != "");
        foreach (var culture in cultures.OrderBy(culture => culture.Name, StringComparer.Ordinal)) {
            Console.WriteLine(culture.Name + "\t" + culture.EnglishName);
        }
    }
}
