using System;
using System.IO;
using System.Linq;

namespace Lipz.Tests
{
    /// <summary>Compares the numbers and messages of errors with the table in the page of the bank format.</summary>
    internal static class ErrorWords
    {
        internal static string Compare(string formatPage)
        {
            string[][] rows = File.ReadLines(formatPage)
                .SkipWhile(line => line != "| number | kind | message |")
                .Select(line => line.Split('|').Select(cell => cell.Trim(' ', '`')).ToArray())
                .TakeWhile(cells => cells.Length == 5)
                .ToArray();
            var kinds = (BankErrorKind[])Enum.GetValues(typeof(BankErrorKind));
            foreach (BankErrorKind kind in kinds)
            {
                string[] row = rows.FirstOrDefault(cells => cells[2] == kind.ToString());
                string problem = BankException.ProblemOf(kind);
                if (row == null || row[1] != ((int)kind).ToString() || row[3] != problem)
                {
                    throw new Exception(kind + " is " + (int)kind + ", \"" + problem + "\", but not in the table");
                }
            }
            return kinds.Length + " kinds";
        }
    }
}
