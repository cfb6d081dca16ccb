using System;
using System.Collections.Generic;
using System.Linq;

namespace Lipz.Tests
{
    /// <summary>The cases of curves, emotions, articulation, faces and babble.</summary>
    internal sealed partial class PlaybackCases
    {
        private IEnumerable<string> OfMotion(string[] words)
        {
            switch (words[0])
            {
                case "curves": return clip.Curves.Select(curve => curve.Name + ":" + Dump.KeysOf(curve, raw: true));
                case "curve": return One(CurveAnswer(words));
                case "emotions": return One(EmotionsAnswer(words.Skip(1)));
                case "articulation": return One(ArticulationAnswer(words[1], TimeOf(words, 2)));
                case "weights": return One(WeightsAnswer(words[1], words[2], TimeOf(words, 3)));
                case "face": return One(FaceAnswer(words.Skip(1), isIdle: false));
                case "idle": return One(FaceAnswer(words.Skip(1), isIdle: true));
                case "babble": return One(BabbleAnswer(words));
                default: throw new Exception("no command: " + words[0]);
            }
        }

        private string CurveAnswer(string[] words)
        {
            Curve curve = clip.Curve(words[1]);
            if (curve == null) return "no curve";
            if (words[2] == "frame") return curve.Thousandths(uint.Parse(words[3])).ToString();
            int? value = curve.ThousandthsAt(TimeOf(words, 2));
            return value == null ? "no frame rate" : value.ToString();
        }

        private string EmotionsAnswer(string[] words)
        {
            Who who = WhoOf(ref words);
            Emotions emotions = clip.EmotionsAt(TimeOf(words, 0), who);
            string told = "";
            for (int i = 0; i < Emotions.Names.Length; i++)
            {
                if (emotions.Thousandths[i] != 0) told += Emotions.Names[i] + " " + emotions.Thousandths[i] + ", ";
            }
            string strongest = emotions.Strongest == null ? "neutral" : emotions.Strongest.ToString();
            return told + "strongest " + strongest.ToLowerInvariant() + ", sum " + Math.Round(emotions.Sum * 1000);
        }

        private string ArticulationAnswer(string profile, ClipTime time)
        {
            if (!HasArticulation(profile)) return "no profile";
            Articulation found = clip.ArticulationAt(time, ArticulationOf(profile));
            return string.Join(", ", Articulation.Names.Select((name, i) => name + " " + found.Thousandths[i]));
        }

        private string WeightsAnswer(string name, string profile, ClipTime time)
        {
            Rig rig = bank.Rig(name);
            if (rig == null) return "no rig";
            if (!HasArticulation(profile)) return "no profile";
            float[] weights = clip.WeightsAt(time, rig, profile: ArticulationOf(profile));
            var named = rig.WeightNames.Select((weight, i) => weight + " " + Math.Round(weights[i] * 1000));
            return string.Join(", ", named);
        }

        private bool HasArticulation(string profile)
        {
            return profile == "default" || bank.ArticulationProfile(profile) != null;
        }

        private ArticulationProfile ArticulationOf(string profile)
        {
            return profile == "default" ? null : bank.ArticulationProfile(profile);
        }

        private string FaceAnswer(string[] words, bool isIdle)
        {
            Who who = WhoOf(ref words);
            FaceProfile profile = words[0] == "default" ? bank.DefaultFaceProfile : bank.FaceProfile(words[0]);
            if (profile == null) return "no profile";
            LookAt look = default(LookAt);
            string kind = words[1];
            words = words.Skip(2);
            if (kind != "ahead")
            {
                look = LookAt.OfThousandths(int.Parse(words[0]), int.Parse(words[1]), kind == "point");
                words = words.Skip(2);
            }
            return FaceWords(isIdle
                ? profile.IdleAt(TimeOf(words, 1), ulong.Parse(words[0]), look)
                : clip.FaceAt(TimeOf(words, 0), who, profile, look));
        }

        private static string FaceWords(Face face)
        {
            return "blink " + face.BlinkThousandths + ", head " + face.HeadPitchThousandths + " "
                + face.HeadYawThousandths + " " + face.HeadRollThousandths + ", eyes " + face.EyePitchThousandths + " "
                + face.EyeYawThousandths + ", brows " + face.BrowsThousandths + ", shrug " + face.ShrugThousandths
                + ", breath " + face.BreathThousandths;
        }

        private string BabbleAnswer(string[] words)
        {
            BabbleProfile profile = words[1] == "default" ? bank.DefaultBabbleProfile : bank.BabbleProfile(words[1]);
            if (profile == null) return "no profile";
            double value = NumberOf(words[words.Length - 1]);
            // A level is a power in 65,536ths, which is exact.
            float power = (float)(words[words.Length - 2] == "level" ? value / 65536 : value);
            BabbleWeights weights = profile.At(TimeOf(words, 2), power);
            return "ooh " + Math.Round(weights.Ooh * 10000) + ", aah " + Math.Round(weights.Aah * 10000);
        }

        private static Who WhoOf(ref string[] words)
        {
            string kind = words[0];
            if (kind != "of" && kind != "speaker") return default(Who);
            string name = words[1];
            words = words.Skip(2);
            return kind == "of" ? Who.Other(name) : Who.Speaker(name);
        }
    }
}
