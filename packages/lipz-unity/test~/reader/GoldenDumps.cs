using System;
using System.IO;
using System.Linq;

namespace Lipz.Tests
{
    /// <summary>Compares the answers of all golden banks with their dumps.</summary>
    internal static class GoldenDumps
    {
        private static readonly string[] Own =
        {
            "curves", "drama", "dubbed", "faces", "long", "phones", "recorded", "rigs", "small", "specials",
            "variants", "wide",
        };

        internal static string Compare(string fixtures, string formatPage)
        {
            string folder = Path.Combine(fixtures, "banks/v1");
            string[] phoneNames = PhoneNames(formatPage);
            foreach (string name in Own) Compare(Open(folder, name), phoneNames, folder, name);
            Compare(Open(folder, "stripped"), phoneNames, folder, "small");
            Bank split = Open(folder, "split");
            foreach (string tag in new[] { "en-us", "de-de" })
            {
                split.OpenTexts(File.ReadAllBytes(Path.Combine(folder, "split." + tag + ".lipztexts")));
            }
            Compare(split, phoneNames, folder, "small");
            int layers = Directory.GetFiles(folder, "*.dump").Length - Own.Length;
            return Own.Length + 2 + " banks, " + layers + " dumps of patched banks skipped";
        }

        private static Bank Open(string folder, string name)
        {
            Bank bank = Bank.Open(File.ReadAllBytes(Path.Combine(folder, name + ".lipzbank")));
            bank.VerifyChecksum();
            return bank;
        }

        private static void Compare(Bank bank, string[] phoneNames, string folder, string name)
        {
            string path = Path.Combine(folder, name + ".dump");
            string[] expected = File.ReadAllText(path).Split('\n');
            string[] found = Dump.Of(bank, phoneNames).Split('\n');
            for (int i = 0; i < Math.Max(expected.Length, found.Length); i++)
            {
                string wanted = i < expected.Length ? expected[i] : "nothing";
                string line = i < found.Length ? found[i] : "nothing";
                if (line == wanted) continue;
                throw new Exception(path + ":" + (i + 1) + "\n    found    " + line + "\n    expected " + wanted);
            }
        }

        /// <summary>Returns the names of all phones, from the table in the page of the bank format.</summary>
        private static string[] PhoneNames(string formatPage)
        {
            return File.ReadLines(formatPage)
                .SkipWhile(line => !line.StartsWith("| number | ARPAbet |"))
                .Skip(2)
                .TakeWhile(line => line.StartsWith("|"))
                .Select(line => line.Split('|').Select(cell => cell.Trim(' ', '`')).ToArray())
                .Select(cells => cells[2] == "" ? cells[3] : cells[2])
                .ToArray();
        }
    }
}
