using System;
using System.IO;

namespace Lipz.Tests
{
    /// <summary>Tests the reader: <c>reader.exe ROOT</c>, with the root of the repository.</summary>
    internal static class Program
    {
        private static int failures;

        private static int Main(string[] arguments)
        {
            string root = arguments[0];
            string fixtures = Path.Combine(root, "fixtures");
            string formatPage = Path.Combine(root, "docs/reference/bank-format.md");
            Test("playback cases", () => PlaybackCases.Play(fixtures));
            Test("golden dumps", () => GoldenDumps.Compare(fixtures, formatPage));
            Test("damaged banks", () => DamagedBanks.Play(fixtures));
            Test("exact times", ExactTimes.Compare);
            Test("words of errors", () => ErrorWords.Compare(formatPage));
            Test("shapes of models", () => ShapesOfModels.Recognise(fixtures));
            Test("memory and speed", () => Speed.Measure(fixtures));
            return failures == 0 ? 0 : 1;
        }

        private static void Test(string name, Func<string> test)
        {
            try
            {
                Console.WriteLine("{0}: {1}", name, test());
            }
            catch (Exception error)
            {
                failures++;
                Console.WriteLine("FAILED {0}: {1}", name, error);
            }
        }
    }
}
