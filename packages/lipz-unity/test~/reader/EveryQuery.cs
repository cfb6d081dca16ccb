using System.Linq;

namespace Lipz.Tests
{
    /// <summary>Makes every query of a bank, which may be damaged. None may throw.</summary>
    internal static class EveryQuery
    {
        private const int MostClips = 200;
        private const int MostSegments = 64;

        private static readonly ClipTime[] Times =
        {
            ClipTime.Micros(-1), ClipTime.Micros(0), ClipTime.Micros(500000), ClipTime.Micros(long.MaxValue),
            ClipTime.Samples(24000, 48000), ClipTime.Samples(long.MaxValue, 1), ClipTime.Samples(1, 0),
            ClipTime.Seconds(0.3), ClipTime.Seconds(0.3f), ClipTime.Seconds(double.PositiveInfinity),
            ClipTime.Seconds(double.NaN),
        };

        /// <summary>The times of queries, fewer if thousands of banks are opened.</summary>
        private static ClipTime[] times = Times;

        internal static void Of(Bank bank, bool isShort)
        {
            times = isShort ? Times.Take(3).ToArray() : Times;
            int mostClips = isShort ? 4 : MostClips;
            foreach (BankLocale locale in bank.Locales) bank.Locale(locale.Tag);
            bank.Clip("act1/blair");
            bank.ClipsUnder("act1/").Take(MostClips).Count();
            foreach (BankVoice voice in bank.Voices) bank.Voice(voice.Tag);
            foreach (BabbleProfile profile in bank.BabbleProfiles) profile.At(Times[2], 0.5f);
            foreach (FaceProfile profile in bank.FaceProfiles) profile.IdleAt(Times[2], 7);
            foreach (Clip clip in bank.Clips.Take(mostClips)) Of(bank, clip.OrFps(24).OrVisemeType(VisemeType.Blair));
            for (uint slot = 0; slot < bank.ClipCount && slot < mostClips; slot++) Of(bank, bank.ClipAt(slot));
        }

        private static void Of(Bank bank, Clip clip)
        {
            bank.Clip(clip.Key);
            clip.HoldFrames(16667);
            foreach (BankVoice voice in bank.Voices) clip.InVoice(voice, out VoiceSource _);
            var values = new object[]
            {
                clip.Fps, clip.DurationUs, clip.Voice, clip.Original, clip.Recording, clip.HasEvents,
            };
            foreach (Segment segment in clip.Segments.Take(MostSegments)) Of(bank, segment);
            foreach (Curve curve in clip.Curves)
            {
                for (int i = 0; i < curve.KeyCount && i < MostSegments; i++) curve.KeyThousandths(i);
                foreach (ClipTime time in times) curve.ValueAt(time);
            }
            for (int i = 0; i < clip.Phones.Count && i < MostSegments; i++) values[0] = clip.Phones[i];
            ClipCursor cursor = clip.Cursor("amy");
            foreach (ClipTime time in times) Of(bank, clip, time, cursor);
        }

        private static void Of(Bank bank, Segment segment)
        {
            var values = new object[] { segment.StartUs, segment.EndUs, segment.Event };
            foreach (ClipEvent happened in segment.Events) values[0] = happened.ToString();
            foreach (BankLocale locale in bank.Locales) segment.Text(locale);
        }

        private static void Of(Bank bank, Clip clip, ClipTime time, ClipCursor cursor)
        {
            clip.VisemeAt(time);
            clip.SegmentAt(time);
            clip.OpennessAt(time);
            clip.EmotionsAt(time);
            clip.EmotionsAt(time, Who.Other("mara"));
            clip.FaceAt(time, Who.Speaker("mara"));
            clip.ArticulationAt(time);
            foreach (ArticulationProfile profile in bank.ArticulationProfiles) clip.ArticulationAt(time, profile);
            foreach (FaceProfile profile in bank.FaceProfiles) clip.FaceAt(time, Who.Other("mara"), profile);
            foreach (Rig rig in bank.Rigs) clip.WeightsAt(time, rig);
            if (cursor == null) return;
            cursor.LeadUs = 41667;
            cursor.HoldFrames = 2;
            foreach (ClipEvent happened in cursor.AdvanceTo(time).Events) happened.ToString();
            foreach (ClipEvent happened in cursor.LoopTo(time).Events) happened.ToString();
            cursor.Seek(time);
            var values = new object[] { cursor.Viseme, cursor.Openness, cursor.Segment, cursor.Frame };
            values[0] = cursor.State();
            values[0] = cursor.Characters();
            cursor.Finish();
        }
    }
}
