using System;
using System.Collections.Generic;
using System.Linq;
using System.Text.RegularExpressions;

namespace Lipz
{
    /// <summary>The forms in which names of shapes are compared.</summary>
    internal static class ShapeNames
    {
        /// <summary>The place of the bare name among the forms: without path and prefix.</summary>
        private const int Bare = 2;

        /// <summary>The number of letters of a known name per letter that may differ.</summary>
        private const int LettersPerChange = 3;

        /// <summary>The names of meshes before that of a shape: <c>blendShape1.jawOpen</c>.</summary>
        private static readonly Regex MeshPath = new Regex(@"^.*(?:[.:|/](?!\z)|(?=Fcl_))");

        /// <summary>The kind of a shape before its name: <c>viseme_aa</c>, <c>Fcl_MTH_A</c>.</summary>
        private static readonly Regex Prefix = new Regex(
            @"^(?:arkit|fcl_mth|lipsync|mouth|mth|phoneme|v|viseme)[_ -]",
            RegexOptions.IgnoreCase | RegexOptions.CultureInvariant);

        /// <summary>The short form of a side at the end of a name: <c>mouthSmile_L</c>, <c>jawL</c>.</summary>
        private static readonly Regex Side = new Regex(@"(?:[_. -]([lrLR])|(?<=[a-z])([LR]))\z");

        /// <summary>Returns the letters and digits in lower case, which alone are compared.</summary>
        internal static string LettersOf(string name)
        {
            // A hyphen is the code of rest.
            if (name == "-") return name;
            return string.Concat(name.Where(IsLetter)).ToLowerInvariant();
        }

        /// <summary>Returns the forms of a name, in the order of their similarity to it.</summary>
        internal static string[] FormsOf(string name)
        {
            string plain = MeshPath.Replace(name, "");
            string sided = MeshPath.Replace(Side.Replace(name, side => SideOf(side.Value)), "");
            string[] forms = { name, plain, Prefix.Replace(plain, ""), sided, Prefix.Replace(sided, "") };
            return forms.Select(LettersOf).ToArray();
        }

        /// <summary>Returns the forms of a weight that a model may have: the bare name comes last.</summary>
        internal static IEnumerable<string> KnownForms(string weight, string[] also)
        {
            return new[] { weight }.Concat(also).Select(LettersOf).Concat(new[] { FormsOf(weight)[Bare] });
        }

        /// <summary>Returns the nearest name; null if too many letters differ.</summary>
        internal static string Nearest(string known, IEnumerable<string> names)
        {
            string letters = LettersOf(known), best = null;
            int least = letters.Length / LettersPerChange + 1;
            foreach (string name in names)
            {
                int distance = Distance(LettersOf(name), letters);
                if (distance >= least) continue;
                least = distance;
                best = name;
            }
            return best;
        }

        private static string SideOf(string end)
        {
            return char.ToLowerInvariant(end[end.Length - 1]) == 'l' ? "Left" : "Right";
        }

        private static bool IsLetter(char letter)
        {
            return char.IsLetter(letter) || char.IsNumber(letter) || char.IsSurrogate(letter);
        }

        /// <summary>Returns the number of letters that are missing, wrong, extra or swapped with the next.</summary>
        private static int Distance(string a, string b)
        {
            var before = new int[b.Length + 1];
            int[] last = Enumerable.Range(0, b.Length + 1).ToArray();
            for (int i = 1; i <= a.Length; i++)
            {
                var row = new int[b.Length + 1];
                row[0] = i;
                for (int j = 1; j <= b.Length; j++)
                {
                    int changed = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
                    row[j] = Math.Min(changed, Math.Min(last[j], row[j - 1]) + 1);
                    bool isSwapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
                    if (isSwapped) row[j] = Math.Min(row[j], before[j - 2] + 1);
                }
                before = last;
                last = row;
            }
            return last[b.Length];
        }
    }
}
