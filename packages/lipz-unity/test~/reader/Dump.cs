using System;
using System.Collections.Generic;
using System.Globalization;
using System.IO;
using System.Linq;
using System.Text;

namespace Lipz.Tests
{
    /// <summary>The answers of a bank to every query, as in the golden dumps.</summary>
    internal sealed class Dump
    {
        private const int LongestBytes = 400;

        private readonly Bank bank;
        private readonly string[] phoneNames;
        private readonly StringBuilder text = new StringBuilder();

        private Dump(Bank bank, string[] phoneNames)
        {
            this.bank = bank;
            this.phoneNames = phoneNames;
        }

        internal static string Of(Bank bank, string[] phoneNames)
        {
            var dump = new Dump(bank, phoneNames);
            dump.Write();
            return dump.text.ToString();
        }

        private void Line(string line)
        {
            text.Append(line).Append('\n');
        }

        private void Write()
        {
            Line("format 1, " + bank.ClipCount + " clips");
            foreach (BankLocale locale in bank.Locales)
            {
                Line("locale " + locale.Tag + (locale.IsDefault ? " default" : ""));
            }
            foreach (BankVoice voice in bank.Voices) Line("voice " + voice.Tag + (voice.IsOriginal ? " original" : ""));
            foreach (FaceProfile profile in bank.FaceProfiles)
            {
                string intervals = string.Join(" ", profile.BlinkIntervalMs);
                Line("face " + Quoted(profile.Name) + ", blinks " + intervals + " ms, each " + profile.BlinkLengthMs
                    + ", " + profile.DoubleBlinkPercent + " % double, head " + profile.HeadMotion + " "
                    + profile.HeadFollows + ", pose " + profile.PoseMs + " ms, glances " + profile.GlancePercent
                    + " %, fixation " + profile.FixationMs + " ms");
            }
            foreach (Clip clip in bank.Clips) WriteClip(clip);
        }

        private void WriteClip(Clip clip)
        {
            Line("\nclip " + clip.Key + " " + clip.Id.ToString("x16"));
            string rate = clip.Fps == null ? "unspecified" : "Fps(" + clip.Fps + ")";
            string type = clip.VisemeType == VisemeType.Unspecified ? "unspecified" : clip.VisemeType.ToString();
            Line("  rate " + rate + ", type " + type);
            Line("  visemes " + Bool(clip.HasVisemes) + ", events " + Bool(clip.HasEvents));
            var codes = new StringBuilder();
            for (uint frame = 0; frame < clip.FrameCount; frame++) codes.Append(clip.Viseme(frame));
            Line("  " + clip.FrameCount + " frames " + codes + ", " + Some(clip.DurationUs) + " us");
            Line("  at 24 fps, each 50 ms: " + Sampled(clip.OrFps(24)));
            if (clip.Original != null) Line("  dub of " + clip.Original.Key + " in " + clip.Voice.Tag);
            foreach (BankVoice voice in bank.Voices.Where(_ => clip.Original == null))
            {
                Clip played = clip.InVoice(voice, out VoiceSource source);
                if (source != VoiceSource.Original) Line("  in " + voice.Tag + " " + played.Key + " (" + source + ")");
            }
            WriteMotion(clip);
            foreach (Segment segment in clip.Segments) WriteSegment(segment);
        }

        private void WriteMotion(Clip clip)
        {
            if (clip.Recording != null)
            {
                Recording recording = clip.Recording.Value;
                Line("  recording " + recording.LengthUs + " us, content " + recording.ContentHash.ToString("x16"));
            }
            foreach (Curve curve in clip.Curves)
            {
                Curve played = clip.OrFps(24).Curve(curve.Name);
                var values = Enumerable.Range(0, 20)
                    .Select(step => Decimal(played.ThousandthsAt(ClipTime.Micros(step * 50000)).Value));
                Line("  curve " + Quoted(curve.Name) + KeysOf(curve, raw: false) + ", each 50 ms: "
                    + string.Join(" ", values));
            }
            foreach (FaceProfile profile in bank.FaceProfiles)
            {
                string faces = "";
                for (int step = 0; step < 67; step++)
                {
                    faces += ": " + FaceWords(clip.FaceAt(ClipTime.Micros(step * 150000), profile: profile));
                }
                Line("  face " + Quoted(profile.Name) + ", each 150 ms" + faces);
            }
            foreach (ArticulationProfile profile in bank.ArticulationProfiles) WriteArticulation(clip, profile);
        }

        private void WriteArticulation(Clip clip, ArticulationProfile profile)
        {
            Phones phones = clip.Phones;
            var spans = Enumerable.Range(0, phones.Count)
                .Select(i => NameOf(phones[i].Number) + "@" + phones[i].StartMs);
            string level = phones.LevelDb == null ? "None" : "Some(" + phones.LevelDb + ")";
            Line("  phones " + string.Join(" ", spans) + ", certain " + Bool(phones.AreCertain) + ", " + level + " dB");
            string mouths = "";
            for (int step = 0; step < 20; step++)
            {
                Articulation mouth = clip.ArticulationAt(ClipTime.Micros(step * 50000), profile);
                mouths += ": " + string.Join(" ", mouth.Thousandths);
            }
            Line("  articulation " + Quoted(profile.Name) + ", each 50 ms" + mouths);
            foreach (Rig rig in bank.Rigs)
            {
                float[] weights = clip.WeightsAt(ClipTime.Micros(500000), rig, profile: profile);
                var named = rig.WeightNames
                    .Select((name, i) => " " + name + " " + Decimal((int)Math.Round(weights[i] * 1000)));
                Line("  rig " + Quoted(rig.Name) + string.Concat(named));
            }
        }

        private string NameOf(int phone)
        {
            return phone < phoneNames.Length ? phoneNames[phone] : "?";
        }

        private void WriteSegment(Segment segment)
        {
            Line("  segment " + segment.Index + " frames " + segment.StartFrame + ".." + segment.EndFrame + " us "
                + Some(segment.StartUs) + ".." + Some(segment.EndUs));
            if (segment.Event != null) Line("    event " + Quoted(segment.Event));
            foreach (ClipEvent happened in segment.Events) Line("    typed \"" + Escaped(happened.ToString()) + "\"");
            foreach (BankLocale locale in bank.Locales)
            {
                SegmentText? found = segment.Text(locale);
                if (found == null) continue;
                string origin = found.Value.IsFallback ? " (fallback)" : "";
                Line("    " + locale.Tag + " " + Quoted(found.Value.Text) + origin);
            }
        }

        private static string Sampled(Clip clip)
        {
            string sampled = "";
            int? before = null;
            for (int step = 0; step < 200; step++)
            {
                ClipTime time = ClipTime.Micros(step * 50000);
                Segment? segment = clip.SegmentAt(time);
                int? index = segment == null ? default(int?) : segment.Value.Index;
                if (index != before) sampled += index == null ? "[end]" : "[" + index + "]";
                before = index;
                if (index == null) break;
                sampled += clip.VisemeAt(time);
            }
            return sampled;
        }

        internal static string KeysOf(Curve curve, bool raw)
        {
            string keys = "";
            for (int i = 0; i < curve.KeyCount; i++)
            {
                int value = curve.KeyThousandths(i);
                keys += " " + curve.KeyFrame(i) + ":" + (raw ? value.ToString() : Decimal(value));
            }
            return keys;
        }

        private static string FaceWords(Face face)
        {
            int[] values =
            {
                face.BlinkThousandths, face.HeadPitchThousandths, face.HeadYawThousandths, face.HeadRollThousandths,
                face.EyePitchThousandths, face.EyeYawThousandths, face.BrowsThousandths, face.ShrugThousandths,
                face.BreathThousandths,
            };
            return string.Join(" ", values.Select(Decimal));
        }

        private static string Decimal(int thousandths)
        {
            return ((decimal)thousandths / 1000).ToString("0.###", CultureInfo.InvariantCulture);
        }

        private static string Bool(bool value)
        {
            return value ? "true" : "false";
        }

        private static string Some(ulong? value)
        {
            return value == null ? "None" : "Some(" + value + ")";
        }

        private static string Quoted(string text)
        {
            byte[] bytes = Encoding.UTF8.GetBytes(text);
            if (bytes.Length <= LongestBytes) return "\"" + Escaped(text) + "\"";
            return "\"" + Escaped(text.Substring(0, 40)) + "\"... " + bytes.Length + " bytes, fnv " + Fnv.Of(bytes);
        }

        private static string Escaped(string text)
        {
            var escaped = new StringBuilder();
            foreach (char letter in text)
            {
                bool isPlain = !char.IsControl(letter) && "\"\\\u00A0\u200B\u202F".IndexOf(letter) < 0;
                escaped.Append(isPlain ? letter.ToString() : "\\u{" + ((int)letter).ToString("x") + "}");
            }
            return escaped.ToString();
        }
    }

    internal static class Fnv
    {
        /// <summary>Returns the 64-bit FNV-1a hash in hexadecimal.</summary>
        internal static string Of(byte[] bytes)
        {
            ulong hash = 0xCBF29CE484222325;
            foreach (byte each in bytes) hash = (hash ^ each) * 0x100000001B3;
            return hash.ToString("x16");
        }
    }
}
