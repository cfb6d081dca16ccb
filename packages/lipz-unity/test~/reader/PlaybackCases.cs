using System;
using System.Collections.Generic;
using System.Globalization;
using System.IO;
using System.Linq;

namespace Lipz.Tests
{
    /// <summary>The cases of fixtures/playback/cases.txt.</summary>
    internal sealed partial class PlaybackCases
    {
        private static readonly string[] Features =
        {
            "articulation", "babble", "curves", "emotions", "faces", "hold", "lead", "refresh", "states", "text-banks",
            "voices",
        };

        private readonly string banks;
        private Bank bank;
        private BankLocale locale;
        private Clip clip;
        private ClipCursor cursor;

        private PlaybackCases(string banks)
        {
            this.banks = banks;
        }

        internal static string Play(string fixtures)
        {
            var file = new AnswerFile(Path.Combine(fixtures, "playback/cases.txt"), Features);
            file.Play(new PlaybackCases(Path.Combine(fixtures, "banks/v1")).Answer);
            return file.Played + " commands, " + file.Skipped + " skipped";
        }

        private IEnumerable<string> Answer(string[] words)
        {
            switch (words[0])
            {
                case "bank": return Open(words[1]);
                case "texts":
                    bank.OpenTexts(File.ReadAllBytes(Path.Combine(banks, words[1] + ".lipztexts")));
                    return None;
                case "locale":
                    locale = bank.Locale(words[1]);
                    return locale == null ? One("no locale") : None;
                case "variant":
                    locale = bank.Variant(locale, words[1]);
                    return One(locale.Tag);
                case "clip": return Start(words[1], words.Skip(2));
                case "speaker":
                    cursor = clip.Resume(cursor, words[1]);
                    return None;
                case "lead":
                    cursor.LeadUs = LeadOf(words[1]);
                    return None;
                case "hold":
                    cursor.HoldFrames = HoldOf(words.Skip(1));
                    return None;
                case "advance": return Moved(cursor.AdvanceTo(TimeOf(words, 1)));
                case "loop": return Moved(cursor.LoopTo(TimeOf(words, 1)));
                case "finish": return Moved(cursor.Finish());
                case "seek":
                    cursor.Seek(TimeOf(words, 1));
                    return One(Shown());
                case "state": return One(StateOf(cursor.State(words[1] == "-" ? null : words[1])));
                case "characters": return cursor.Characters().Select(StateOf);
                case "voices": return bank.Voices.Select(voice => voice.Tag);
                case "voice": return One(VoiceOf(words[1]));
                default: return OfMotion(words);
            }
        }

        private IEnumerable<string> Open(string name)
        {
            bank = Bank.Open(File.ReadAllBytes(Path.Combine(banks, name + ".lipzbank")));
            bank.VerifyChecksum();
            locale = null;
            clip = clip == null ? null : bank.Clip(clip.Id);
            if (clip != null && cursor != null)
            {
                cursor = clip.Resume(cursor);
                clip = cursor.Clip;
            }
            return None;
        }

        private IEnumerable<string> Start(string key, string[] given)
        {
            clip = bank.Clip(key);
            for (int at = 0; at < given.Length; at += 2)
            {
                uint[] rate = given[at] == "rate" ? given[at + 1].Split('/').Select(uint.Parse).ToArray() : null;
                clip = rate == null ? clip.OrVisemeType(TypeOf(given[at + 1])) : clip.OrFps(rate[0], rate[1]);
            }
            cursor = clip.Cursor();
            return cursor == null ? One("no frame rate") : None;
        }

        private static VisemeType TypeOf(string name)
        {
            return (VisemeType)Enum.Parse(typeof(VisemeType), name, true);
        }

        private uint LeadOf(string word)
        {
            if (word == "one") return (uint)clip.StartOfFrameUs(1).Value;
            return word == "two" ? (uint)clip.StartOfFrameUs(2).Value : uint.Parse(word);
        }

        private byte HoldOf(string[] words)
        {
            if (words[0] == "display") return clip.HoldFrames(uint.Parse(words[1]));
            return words[0] == "readable" ? clip.HoldFrames() : byte.Parse(words[0]);
        }

        private IEnumerable<string> Moved(DueSegments due)
        {
            var answers = new List<string> { Shown() };
            foreach (Segment segment in due)
            {
                string text = segment.Event;
                string colon = text == null ? "" : text == "" ? ":" : ": ";
                answers.Add("due " + segment.Index + colon + text);
            }
            foreach (ClipEvent happened in due.Events) answers.Add("event " + happened);
            return answers;
        }

        private string Shown()
        {
            string frame = cursor.Frame == null ? (cursor.IsOver ? "over" : "waiting") : cursor.Frame.ToString();
            string shown = "frame " + frame + ", viseme " + cursor.Viseme;
            if (cursor.Openness != null) shown += ", open " + Math.Round(cursor.Openness.Value * 10000);
            if (cursor.Segment == null) return shown;
            shown += ", segment " + cursor.Segment.Value.Index;
            SegmentText? text = cursor.Segment.Value.Text(locale);
            return text == null ? shown : shown + ": " + text + (text.Value.IsFallback ? " (fallback)" : "");
        }

        private static string StateOf(CharacterState state)
        {
            return (state.Name ?? "-") + ": feels " + (state.Feels ?? "-") + ", stares " + (state.StaresAt ?? "-")
                + ", points " + (state.PointsAt ?? "-");
        }

        private string VoiceOf(string tag)
        {
            BankVoice voice = bank.Voice(tag);
            if (voice == null) return "no voice";
            Clip played = clip.InVoice(voice, out VoiceSource source);
            string words = source == VoiceSource.OtherDub ? "other dub" : source.ToString().ToLowerInvariant();
            return words + ": " + played.Key + ", spoken in " + played.Voice.Tag;
        }

        /// <summary>The time at a place of words.</summary>
        private static ClipTime TimeOf(string[] words, int at)
        {
            string value = words[at + 1];
            switch (words[at])
            {
                case "us": return ClipTime.Micros(long.Parse(value));
                case "samples": return ClipTime.Samples(long.Parse(value), uint.Parse(words[at + 2]));
                case "seconds": return ClipTime.Seconds(NumberOf(value));
                case "f32": return ClipTime.Seconds((float)NumberOf(value));
                default: throw new Exception("no time: " + words[at]);
            }
        }

        private static double NumberOf(string word)
        {
            if (word == "nan") return double.NaN;
            if (word == "inf") return double.PositiveInfinity;
            return word == "-inf" ? double.NegativeInfinity : double.Parse(word, CultureInfo.InvariantCulture);
        }

        private static readonly string[] None = new string[0];

        private static string[] One(string answer)
        {
            return new[] { answer };
        }
    }
}
