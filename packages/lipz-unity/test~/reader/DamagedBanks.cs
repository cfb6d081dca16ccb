using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using System.Text;

namespace Lipz.Tests
{
    /// <summary>The damaged banks of fixtures/banks/damaged.txt.</summary>
    internal sealed class DamagedBanks
    {
        private readonly string folder;
        private byte[] bank;
        private readonly List<string[]> damage = new List<string[]>();

        private DamagedBanks(string folder)
        {
            this.folder = folder;
        }

        internal static string Play(string fixtures)
        {
            var file = new AnswerFile(Path.Combine(fixtures, "banks/damaged.txt"), "checksum", "text-banks");
            file.Play(new DamagedBanks(Path.Combine(fixtures, "banks/v1")).Answer);
            return file.Played + " commands, " + file.Skipped + " skipped";
        }

        private IEnumerable<string> Answer(string[] words)
        {
            switch (words[0])
            {
                case "bank":
                    bank = File.ReadAllBytes(Path.Combine(folder, words[1] + ".lipzbank"));
                    damage.Clear();
                    return new string[0];
                case "open": return new[] { Opened(Damaged(bank), isShort: false) };
                case "verify": return new[] { Said("verified", () => Bank.Open(Damaged(bank)).VerifyChecksum()) };
                case "texts":
                    byte[] texts = Damaged(File.ReadAllBytes(Path.Combine(folder, words[1] + ".lipztexts")));
                    return new[] { Said("opens", () => Bank.Open(bank).OpenTexts(texts)) };
                case "each-byte": return new[] { EachByte(Damaged(bank)) };
                default:
                    damage.Add(words);
                    return new string[0];
            }
        }

        /// <summary>Opens a bank and, if it opens, makes all queries.</summary>
        private static string Opened(byte[] bytes, bool isShort)
        {
            return Said("opens", () => EveryQuery.Of(Bank.Open(bytes), isShort));
        }

        private static string Said(string fine, Action action)
        {
            try
            {
                action();
                return fine;
            }
            catch (BankException error)
            {
                return error.Kind + " at " + error.OffsetBytes;
            }
        }

        private static string EachByte(byte[] bytes)
        {
            int opened = 0, refused = 0;
            var lines = new StringBuilder();
            for (int at = 0; at < bytes.Length; at++)
            {
                bytes[at] ^= 0xFF;
                string said = Opened(bytes, isShort: true);
                if (said == "opens") opened++;
                else lines.Append(at).Append(": ").Append(said).Append('\n');
                refused += said == "opens" ? 0 : 1;
                bytes[at] ^= 0xFF;
            }
            string hash = Fnv.Of(Encoding.ASCII.GetBytes(lines.ToString()));
            return opened + " open, " + refused + " refused, fnv " + hash;
        }

        private byte[] Damaged(byte[] file)
        {
            byte[] bytes = (byte[])file.Clone();
            foreach (string[] words in damage)
            {
                switch (words[0])
                {
                    case "cut":
                        Array.Resize(ref bytes, Math.Min(bytes.Length, int.Parse(words[1])));
                        break;
                    case "append":
                        bytes = bytes.Concat(BytesOf(words[1])).ToArray();
                        break;
                    case "put":
                        Put(bytes, int.Parse(words[1]), words[2]);
                        break;
                    case "section":
                        int entry = EntryOf(file, words[1]);
                        Put(bytes, (int)LittleEndian.U32(file, entry + 4) + int.Parse(words[2]), words[3]);
                        break;
                    case "entry":
                        Put(bytes, EntryOf(file, words[1]) + int.Parse(words[2]), words[3]);
                        break;
                    default: throw new Exception("no command: " + words[0]);
                }
            }
            return bytes;
        }

        private static int EntryOf(byte[] file, string tag)
        {
            for (int entry = 64; ; entry += 16)
            {
                if (Encoding.ASCII.GetString(file, entry, 4) == tag) return entry;
            }
        }

        private static void Put(byte[] bytes, int at, string hex)
        {
            BytesOf(hex).CopyTo(bytes, at);
        }

        private static byte[] BytesOf(string hex)
        {
            var pairs = Enumerable.Range(0, hex.Length / 2).Select(i => hex.Substring(2 * i, 2));
            return pairs.Select(pair => Convert.ToByte(pair, 16)).ToArray();
        }
    }
}
