using System;
using System.Collections.Generic;
using System.IO;

namespace Lipz.Tests
{
    /// <summary>A file of commands and answers, which a test prints again with the answers of this reader.</summary>
    internal sealed class AnswerFile
    {
        private readonly string path;
        private readonly HashSet<string> features;

        internal int Played { get; private set; }

        internal int Skipped { get; private set; }

        internal AnswerFile(string path, params string[] features)
        {
            this.path = path;
            this.features = new HashSet<string>(features);
        }

        /// <summary>Plays all commands, and compares each line. Sections that need more features are skipped.</summary>
        internal void Play(Func<string[], IEnumerable<string>> answers)
        {
            string[] expected = File.ReadAllText(path).TrimEnd('\n').Split('\n');
            var found = new List<string>();
            bool isSkipped = false;
            for (int at = 0; at < expected.Length; at++)
            {
                string line = expected[at];
                if (line.StartsWith("## ")) isSkipped = false;
                if (line.StartsWith("needs ")) isSkipped = !features.IsSupersetOf(line.Split(' ').Skip(1));
                bool isAnswer = line.StartsWith("  ");
                if (isAnswer && !isSkipped) continue;
                Add(found, line, expected);
                if (isAnswer || line == "" || line.StartsWith("#") || line.StartsWith("needs ")) continue;
                if (isSkipped)
                {
                    Skipped++;
                    continue;
                }
                Played++;
                foreach (string answer in answers(line.Split(' '))) Add(found, "  " + answer, expected);
            }
            if (found.Count != expected.Length) throw new Exception(path + ": answers are missing at the end");
        }

        private void Add(List<string> found, string line, string[] expected)
        {
            string wanted = found.Count < expected.Length ? expected[found.Count] : "nothing";
            found.Add(line);
            if (line == wanted) return;
            throw new Exception(path + ":" + found.Count + "\n    found    " + line + "\n    expected " + wanted);
        }
    }

    internal static class Words
    {
        internal static string[] Skip(this string[] words, int count)
        {
            var rest = new string[words.Length - count];
            Array.Copy(words, count, rest, 0, rest.Length);
            return rest;
        }
    }
}
